// SPDX-License-Identifier: BSD-3-Clause
// Pictures that lack their end: refused, whatever the format, with the same words.
#include "dgtkFile.h"
#include "dgtkModelSeeds.h"
#include "dgtkTestSupport.h"
#include "dgtkTextureFile.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cstdio> // before jpeglib.h
#include <cstdlib>
#include <jpeglib.h>
#include <map>
#include <png.h>

using namespace dgtk::test;

namespace
{
constexpr int width = 64;
constexpr int height = 36;

std::uint8_t value(std::size_t i) { return std::uint8_t(i * i / 91 + i % 5 * 40); }

/// A picture of three channels as OpenImageIO writes it, an attribute set; in tiles of a side, or in none.
template <typename T = int>
std::string written(const std::string& path, const std::string& attribute = "none", const T& set = T(), int tile = 0)
{
  const auto output = OIIO::ImageOutput::create(path);
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec[attribute] = set;
  spec.tile_width = spec.tile_height = tile;
  std::vector<std::uint8_t> values;
  for (std::size_t i = 0; i < std::size_t(width * height * 3); ++i)
  {
    values.push_back(value(i));
  }
  EXPECT_TRUE(
    output && output->open(path, spec) && output->write_image(OIIO::TypeDesc::UINT8, values.data()) && output->close());
  return contentsOf(path);
}

/// A JPEG of colours that OpenImageIO does not write.
std::string jpegOf(J_COLOR_SPACE given, J_COLOR_SPACE stored)
{
  jpeg_compress_struct write{};
  jpeg_error_mgr errors{};
  write.err = jpeg_std_error(&errors);
  jpeg_create_compress(&write);
  unsigned char* bytes = nullptr;
  unsigned long count = 0;
  jpeg_mem_dest(&write, &bytes, &count);
  write.image_width = width;
  write.image_height = height;
  write.input_components = given == JCS_CMYK ? 4 : 3;
  write.in_color_space = given;
  jpeg_set_defaults(&write);
  jpeg_set_colorspace(&write, stored);
  jpeg_start_compress(&write, TRUE);
  std::vector<std::uint8_t> row(std::size_t(width) * 4);
  for (std::size_t y = 0; y < height; ++y)
  {
    for (std::size_t i = 0; i < row.size(); ++i)
    {
      row[i] = value(i + 29 * y);
    }
    JSAMPROW line = row.data();
    jpeg_write_scanlines(&write, &line, 1);
  }
  jpeg_finish_compress(&write);
  jpeg_destroy_compress(&write);
  std::string out(reinterpret_cast<const char*>(bytes), count);
  std::free(bytes);
  return out;
}

/// What the library says of a picture; "" when it is read.
std::string problemOf(const std::string& name, const std::string& bytes)
{
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path(name), bytes);
  std::string problem;
  const bool isThere = dgtk::decodeTexture(folder.path(name), problem) != nullptr;
  EXPECT_EQ(problem.empty(), isThere) << name;
  return problem;
}
} // namespace

TEST(Pictures, OnesCutShortAreRefusedNotFilled)
{
  const TemporaryFolder folder;
  const std::string jpeg = written(folder.path("a.jpg"));
  for (const std::size_t left : { jpeg.size() / 2, jpeg.size() - 10 })
  {
    EXPECT_EQ(problemOf("a.jpg", jpeg.substr(0, left)), "is cut short") << left;
  }
  EXPECT_EQ(problemOf("a.jpg", jpeg.substr(0, jpeg.size() - 2)), "") << "all pixels, without the mark of the end";
  EXPECT_EQ(problemOf("a.jpg", jpeg + "more"), "");
  const std::string progressive = written(folder.path("a.jpg"), "jpeg:progressive", 1);
  ASSERT_NE(progressive.find("\xff\xc2"), std::string::npos);
  EXPECT_EQ(problemOf("a.jpg", progressive), "");
  EXPECT_EQ(problemOf("a.jpg", progressive.substr(0, progressive.size() - 2)), "is cut short")
    << "of several scans the last ones may lack";
  const std::string png = written(folder.path("a.png"));
  EXPECT_EQ(problemOf("a.png", png.substr(0, png.size() / 2)), "is cut short");
  // an uncompressed DDS of 4 x 4 pixels of 24 bits
  std::string dds = "DDS " + u32(124) + u32(0x100f) + u32(4) + u32(4) + u32(12) + std::string(52, '\0') + u32(32) +
                    u32(0x40) + u32(0) + u32(24) + u32(0xff0000) + u32(0xff00) + u32(0xff) + u32(0) + u32(0x1000) +
                    std::string(16, '\0') + std::string(48, 'x');
  EXPECT_EQ(problemOf("a.dds", dds), "");
  EXPECT_EQ(problemOf("a.dds", dds.substr(0, dds.size() - 12)), "is cut short");
  // two rows of three pixels in three planes, one of whose bytes lacks
  std::string pcx = "\x0a\x05\x01\x08" + u16(0) + u16(0) + u16(2) + u16(1) + std::string(53, '\0') + "\x03" + u16(3);
  pcx += std::string(128 - pcx.size(), '\0') + std::string(18, '\x01');
  EXPECT_EQ(problemOf("a.pcx", pcx), "");
  EXPECT_EQ(problemOf("a.pcx", pcx.substr(0, pcx.size() - 1)), "is a PCX picture cut short");
}

TEST(Pictures, JpegsOfAllColoursAreWholeWithoutTheirEnd)
{
  struct Row
  {
    J_COLOR_SPACE given, stored;
  };
  const TemporaryFolder folder;
  for (const Row& row : { Row{ JCS_CMYK, JCS_CMYK }, Row{ JCS_CMYK, JCS_YCCK }, Row{ JCS_RGB, JCS_RGB } })
  {
    const std::string bytes = jpegOf(row.given, row.stored);
    dgtk::writeFile(folder.path("a.jpg"), bytes);
    std::vector<std::uint8_t> expected(std::size_t(width * height * 3));
    const auto library = OIIO::ImageInput::open(folder.path("a.jpg"));
    ASSERT_TRUE(library && library->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, expected.data())) << row.stored;
    dgtk::writeFile(folder.path("a.jpg"), bytes.substr(0, bytes.size() - 2));
    std::string problem;
    const auto image = dgtk::decodeTexture(folder.path("a.jpg"), problem);
    ASSERT_TRUE(image) << row.stored << ": " << problem;
    int wrong = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      wrong += image->rgba.at(i / 3 * 4 + i % 3) != expected[i] ? 1 : 0;
    }
    EXPECT_EQ(wrong, 0) << row.stored;
    for (const std::size_t left : { bytes.size() / 2, bytes.size() - 10 })
    {
      EXPECT_EQ(problemOf("a.jpg", bytes.substr(0, left)), "is cut short") << row.stored << ' ' << left;
    }
  }
}

namespace
{
void expectCutShort(const std::string& name, const std::string& bytes, std::size_t lacks)
{
  EXPECT_EQ(problemOf(name, bytes), "") << name;
  for (const std::size_t left : { bytes.size() - lacks, bytes.size() / 2, bytes.size() / 4 })
  {
    EXPECT_EQ(problemOf(name, bytes.substr(0, left)), "is cut short") << name << ' ' << left;
  }
}

/// A TIFF file of 4 x 2 pixels of a byte, all in a strip of `count` bytes, at its end; of 32 or 64 bits.
std::string tiff(bool highestFirst, bool wide, std::uint64_t count)
{
  const std::size_t word = wide ? 8 : 4;
  const auto number = [&](std::uint64_t value, std::size_t size)
  {
    std::string text;
    for (std::size_t i = 0; i < size; ++i)
    {
      text += char(value >> (8 * (highestFirst ? size - 1 - i : i)));
    }
    return text;
  };
  std::string out = (highestFirst ? "MM" : "II") + number(wide ? 43 : 42, 2);
  out += wide ? number(8, 2) + number(0, 2) + number(16, 8) : number(8, 4);
  const std::pair<int, std::uint64_t> fields[] = { { 256, 4 }, { 257, 2 }, { 258, 8 }, { 259, 1 }, { 262, 1 },
    { 273, 400 }, { 277, 1 }, { 278, 2 }, { 279, count } };
  out += number(std::size(fields), wide ? 8 : 2);
  for (const auto& [tag, value] : fields)
  {
    out += number(std::uint64_t(tag), 2) + number(wide ? 16 : 4, 2) + number(1, word) + number(value, word);
  }
  out += number(0, word);
  out.resize(400);
  return out + "abcdefgh";
}
} // namespace

TEST(Pictures, TablesThatPlaceRowsBeyondTheFileAreOfOneCutShort)
{
  const TemporaryFolder folder;
  expectCutShort("a.rgb", written(folder.path("a.rgb")), 1);
  // packed, two rows of four pixels: their places, their lengths, then each row's pixels as they are
  std::string sgi("\x01\xda\x01\x01\0\x02\0\x04\0\x02\0\x01\0\0\0\0\0\0\0\xff", 20);
  sgi.resize(512);
  sgi += std::string("\0\0\x02\x10\0\0\x02\x16\0\0\0\x06\0\0\0\x06", 16);
  sgi += std::string("\x84"
                     "abcd\0\x84"
                     "efgh\0",
    12);
  expectCutShort("a.rgb", sgi, 1);
  for (const bool wide : { false, true })
  {
    for (const bool highestFirst : { false, true })
    {
      expectCutShort("a.tif", tiff(highestFirst, wide, 8), 1);
      EXPECT_EQ(problemOf("a.tif", tiff(highestFirst, wide, 9)), "") << "its rows are there";
    }
  }
  for (const std::string compression : { "none", "lzw", "zip" })
  {
    expectCutShort("a.tif", written(folder.path("a.tif"), "compression", compression), 1);
    expectCutShort("a.tif", written(folder.path("a.tif"), "compression", compression, 16), 1);
  }
  std::string white = tiff(false, false, 8); // with a white point, at the end, in place of the samples a pixel
  white.replace(white.find(u16(277) + u16(4)), 12, u16(318) + u16(5) + u32(2) + u32(408));
  expectCutShort("a.tif", white + u32(1) + u32(3) + u32(1) + u32(3), 1);
}

namespace
{
/// Big-endian.
std::string most(std::uint32_t value, int size)
{
  std::string text;
  while (size-- > 0)
  {
    text += char(value >> (8 * size));
  }
  return text;
}

std::string repeated(const std::string& what, std::size_t times)
{
  std::string text;
  for (std::size_t i = 0; i < times; ++i)
  {
    text += what;
  }
  return text;
}
} // namespace

// Pictures of one colour are whole in very few bytes; as textures and, of those that are light, as environments.
TEST(Pictures, OnesOfOneColourAreNotCutShort)
{
  const TemporaryFolder folder;
  std::map<std::string, std::string> pictures;
  for (const std::string extension :
    { "png", "jpg", "tga", "bmp", "gif", "tif", "exr", "hdr", "webp", "jp2", "psd", "sgi", "ppm", "dds" })
  {
    const auto output = OIIO::ImageOutput::create(extension);
    OIIO::ImageSpec spec(2032, 64, 3, OIIO::TypeDesc::UINT8);
    spec["compression"] = extension == "tga" ? "rle" : "zip";
    const std::vector<std::uint8_t> values(std::size_t(2032 * 64 * 3), 188);
    if (output && output->open(folder.path("a." + extension), spec) &&
        output->write_image(OIIO::TypeDesc::UINT8, values.data()) && output->close())
    {
      pictures["a." + extension] = contentsOf(folder.path("a." + extension));
    }
    OIIO::geterror();
  }
  EXPECT_GE(pictures.size(), 9U);
  // Radiance: 16 runs of 127 bytes for each of four bytes of a pixel
  const auto plane = [](char value) { return repeated(std::string("\xff") + value, 16); };
  const std::string line = std::string("\2\2", 2) + most(2032, 2) + repeated(plane(char(0x80)), 3) + plane(char(0x81));
  pictures["runs.hdr"] = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 64 +X 2032\n" + repeated(line, 64);
  // Targa: runs of 128 pixels of a colour map of four bytes an entry
  const std::string head = std::string("\0\1\x09\0\0\1\0\x20", 8) + u16(0) + u16(0) + u16(2048) + u16(64);
  pictures["mapped.tga"] =
    head + std::string("\x08\x08\x80\x80\x80\xff", 6) + repeated(std::string("\xff\0", 2), 16 * 64);
  // SGI: all rows of all channels are one
  std::string sgi = std::string("\x01\xda\x01\x01", 4) + most(3, 2) + most(2032, 2) + most(64, 2) + most(3, 2);
  sgi.resize(512);
  const std::size_t rows = 64 * std::size_t(3);
  sgi += repeated(most(std::uint32_t(512 + 8 * rows), 4), rows) + repeated(most(33, 4), rows);
  pictures["one.rgb"] = sgi + repeated("\x7f\x80", 16) + std::string(1, '\0');
  for (const auto& [name, bytes] : pictures)
  {
    EXPECT_EQ(problemOf(name, bytes), "") << name;
    dgtk::writeFile(folder.path(name), bytes);
    std::string problem;
    EXPECT_TRUE(dgtk::decodeRadiance(folder.path(name), problem)) << name << ": " << problem;
  }
  // one bit a pixel, of which deflate makes very little, and each an entry of a palette
  const std::string path = folder.path("bits.png");
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  png_structp write = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(write);
  png_init_io(write, file);
  png_set_IHDR(write, info, 2048, 1024, 1, PNG_COLOR_TYPE_PALETTE, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
    PNG_FILTER_TYPE_DEFAULT);
  const png_color colors[] = { { 1, 2, 3 }, { 4, 5, 6 } };
  png_set_PLTE(write, info, colors, 2);
  png_write_info(write, info);
  const std::vector<png_byte> bits(256, 0);
  for (int y = 0; y < 1024; ++y)
  {
    png_write_row(write, bits.data());
  }
  png_write_end(write, info);
  png_destroy_write_struct(&write, &info);
  std::fclose(file);
  EXPECT_EQ(problemOf("bits.png", contentsOf(path)), "");
  std::string problem;
  EXPECT_TRUE(dgtk::decodeRadiance(path, problem)) << problem;
}

TEST(Pictures, RunsOfTheOldKindAreSaidNotToBeRead)
{
  const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 64\n";
  EXPECT_EQ(problemOf("a.hdr", head + repeated("\x80\x80\x80\x81\1\1\1\x3f", 2)),
    "is packed as Radiance files once were, which is not read");
  EXPECT_EQ(problemOf("a.hdr", head + repeated("\x80\x80\x80\x81", 100)), "is cut short");
}

TEST(Pictures, OnesCutShortAreSaidToBeInTheSameWords)
{
  const TemporaryFolder folder;
  for (const std::string name : { "a.gif", "a.jp2", "a.webp", "a.ppm", "a.psd", "a.bmp", "a.tga" })
  {
    if (OIIO::ImageOutput::create(name)) // otherwise it cannot be written here
    {
      const std::string bytes = written(folder.path(name));
      EXPECT_EQ(problemOf(name, bytes.substr(0, bytes.size() / 2)).substr(0, 12), "is cut short") << name;
    }
    OIIO::geterror();
  }
}

TEST(Pictures, PackedBmpOfHalfBytesAndMovesWhoseLastRowEnds)
{
  struct Row
  {
    unsigned bits, height;
    std::string packed;
    std::vector<int> reds; ///< of the picture's texels, the lowest row first
  };
  const std::string end("\0\0", 2);
  const Row rows[] = {
    // four of a kind; five as they are, whose three bytes have one more behind them
    { 4, 2, "\x05\x11" + end + std::string("\0\x05\x10\0\x10\0", 6) + end, { 2, 2, 2, 2, 2, 2, 1, 1, 1, 2 } },
    // four in two bytes, with none behind them, and one
    { 4, 2, std::string("\0\x04\x01\x10\x01\x01", 6) + end + "\x05\x01" + end, { 1, 2, 2, 1, 1, 1, 2, 1, 2, 1 } },
    // a row, a move of none along and one row up, which is left out, and the last row
    { 8, 3, "\x05\x01" + end + std::string("\0\x02\0\x01", 4) + "\x05\x01" + end,
      { 2, 2, 2, 2, 2, 1, 1, 1, 1, 1, 2, 2, 2, 2, 2 } },
  };
  for (const Row& row : rows)
  {
    const std::string head = "BM" + u32(0) + u32(0) + u32(62) + u32(40) + u32(5) + u32(row.height) + u16(1) +
                             u16(row.bits) + u32(row.bits == 4 ? 2 : 1) + u32(0) + u32(0) + u32(0) + u32(2) + u32(2) +
                             u32(0x010000) + u32(0x020000);
    const TemporaryFolder folder;
    dgtk::writeFile(folder.path("a.bmp"), head + row.packed + std::string("\0\1", 2));
    std::string problem;
    const auto image = dgtk::decodeTexture(folder.path("a.bmp"), problem);
    ASSERT_TRUE(image) << row.bits << ": " << problem;
    std::vector<int> reds;
    for (std::size_t i = 0; i < row.reds.size(); ++i)
    {
      reds.push_back(image->rgba.at(((row.height - 1 - i / 5) * 5 + i % 5) * 4));
    }
    EXPECT_EQ(reds, row.reds) << row.bits << ' ' << row.packed.size();
  }
  // a move beyond the only row
  const std::string beyond = "BM" + u32(0) + u32(0) + u32(62) + u32(40) + u32(4) + u32(1) + u16(1) + u16(8) + u32(1) +
                             u32(0) + u32(0) + u32(0) + u32(2) + u32(2) + u32(0) + u32(0) +
                             std::string("\0\2\0\5\4\1", 6) + end;
  EXPECT_EQ(problemOf("a.bmp", beyond + std::string("\0\1", 2)), "is damaged");
}
