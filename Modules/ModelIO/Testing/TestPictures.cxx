// SPDX-License-Identifier: BSD-3-Clause
// Pictures of strangers, decoded in processes of their own: damaged ones of every format, the budget, and what is short
// of memory.
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkModelChecks.h"
#include "dgtkModelSeeds.h"
#include "dgtkTestSupport.h"
#include "dgtkTextureFile.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>

#include <sys/resource.h>

using namespace dgtk::test;
using testing::HasSubstr;

namespace
{
constexpr int width = 64; // the writer of HEIF reads whole multiples of 64 bytes a row
constexpr int height = 36;

/// A picture as OpenImageIO writes it; "" when it cannot write the format.
std::string written(const std::string& path)
{
  const auto output = OIIO::ImageOutput::create(path);
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  if (path.find(".hdr") != std::string::npos || path.find(".exr") != std::string::npos ||
      path.find(".zfile") != std::string::npos)
  {
    spec.set_format(OIIO::TypeDesc::FLOAT);
    spec.nchannels = path.find(".zfile") != std::string::npos ? 1 : 3;
    spec.default_channel_names();
  }
  if (path.find(".rgb") != std::string::npos)
  {
    spec["compression"] = "rle";
  }
  std::vector<float> values;
  for (std::size_t i = 0; i < std::size_t(width * height * spec.nchannels); ++i)
  {
    values.push_back(float(i / 7 % 11) / 11);
  }
  if (!output || !output->open(path, spec) || !output->write_image(OIIO::TypeDesc::FLOAT, values.data()) ||
      !output->close())
  {
    OIIO::geterror();
    return {};
  }
  return contentsOf(path);
}

/// Texels as the library of pictures decodes them in this process; empty when it cannot.
std::vector<std::uint8_t> texelsOf(const std::string& path)
{
  OIIO::ImageSpec config;
  config["oiio:UnassociatedAlpha"] = 1;
  const auto input = OIIO::ImageInput::open(path, &config);
  if (!input)
  {
    OIIO::geterror();
    return {};
  }
  const int channels = std::min(input->spec().nchannels, 4);
  std::vector<std::uint8_t> raw(
    std::size_t(input->spec().width) * std::size_t(input->spec().height) * std::size_t(channels));
  if (!input->read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, raw.data()))
  {
    return {};
  }
  std::vector<std::uint8_t> texels;
  for (std::size_t i = 0; i < raw.size(); i += std::size_t(channels))
  {
    const bool grey = channels < 3;
    texels.insert(texels.end(), { raw[i], raw[i + (grey ? 0 : 1)], raw[i + (grey ? 0 : 2)],
                                  channels == 4   ? raw[i + 3]
                                  : channels == 2 ? raw[i + 1]
                                                  : std::uint8_t(255) });
  }
  return texels;
}

/// By extension: a sound picture of every format that can be written here and is read by file.
std::map<std::string, std::string> soundPictures(const TemporaryFolder& folder)
{
  std::map<std::string, std::string> pictures;
  for (const std::string extension : { "png", "jpg", "tga", "bmp", "rgb", "gif", "tif", "ppm", "exr", "hdr", "dpx",
         "fits", "ico", "iff", "jp2", "rla", "webp", "zfile", "heic" })
  {
    const std::string bytes = written(folder.path("sound." + extension));
    if (!bytes.empty())
    {
      pictures[extension] = bytes;
    }
  }
  return pictures;
}

/// A header that promises 16384 x 16384 pixels, and as many bytes as a sound file could have.
std::string hugePng()
{
  const auto big = [](std::uint32_t v) { return std::string{ char(v >> 24), char(v >> 16), char(v >> 8), char(v) }; };
  const std::string header = big(16384) + big(16384) + std::string("\x08\x02\x00\x00\x00", 5);
  // zlib's crc of "IHDR" and the header
  return "\x89PNG\r\n\x1a\n" + big(13) + "IHDR" + header + big(0x26aa87d3u) + big(900000) + "IDAT" +
         std::string(900000, '\0');
}

std::string modelWith(const std::vector<std::string>& textures)
{
  std::string text = "AC3Db\nMATERIAL \"a\" rgb 1 1 1\nOBJECT world\nkids " + std::to_string(textures.size()) + '\n';
  for (const std::string& texture : textures)
  {
    text += "OBJECT poly\ntexture \"" + texture +
            "\"\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0\nmat 0\nrefs 3\n0 0 0\n1 1 0\n2 0 1\nkids 0\n";
  }
  return text;
}

/// A run of five pixels in a row of two: OpenImageIO 2.4 ends the process.
std::string deadlySgi()
{
  std::string bytes(512, '\0');
  bytes.replace(0, 12, std::string("\x01\xda\x01\x01\0\x02\0\x02\0\x01\0\x01", 12));
  bytes[19] = '\xff';
  return bytes + std::string("\0\0\x02\x08\0\0\0\x03\x85\x01\x02", 11);
}
} // namespace

TEST(Pictures, ASoundPictureOfEveryFormatIsWhatTheLibraryReads)
{
  const TemporaryFolder folder;
  int compared = 0;
  for (const auto& [extension, bytes] : soundPictures(folder))
  {
    const std::string path = folder.path("sound." + extension);
    const std::vector<std::uint8_t> expected = texelsOf(path);
    ASSERT_FALSE(expected.empty()) << extension;
    std::string problem;
    const auto image = dgtk::decodeTexture(path, problem);
    ASSERT_TRUE(image) << extension << ": " << problem;
    EXPECT_EQ(image->width, width) << extension;
    EXPECT_EQ(image->height, height) << extension;
    EXPECT_TRUE(image->rgba == expected) << extension;
    ++compared;
  }
  EXPECT_GE(compared, 14);
}

namespace
{
/// A PNG file of a kind; `clear`: with a transparent colour, or transparent colours of the palette.
void writePng(const std::string& path, int color, int bits, bool clear, bool interlaced)
{
  std::FILE* const file = std::fopen(path.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop head = png_create_info_struct(png);
  png_init_io(png, file);
  png_set_IHDR(png, head, width, height, bits, color, interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
    PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  const int colors = 1 << std::min(bits, 8);
  std::vector<png_color> palette;
  std::vector<png_byte> alphas;
  for (int i = 0; i < colors; ++i)
  {
    palette.push_back({ png_byte(7 * i + 3), png_byte(31 * i), png_byte(255 - i) });
    alphas.push_back(png_byte(13 * i));
  }
  png_color_16 transparent{};
  transparent.red = transparent.green = transparent.blue = transparent.gray = 1;
  if (color == PNG_COLOR_TYPE_PALETTE)
  {
    png_set_PLTE(png, head, palette.data(), colors);
  }
  if (clear)
  {
    const bool isPalette = color == PNG_COLOR_TYPE_PALETTE;
    png_set_tRNS(
      png, head, isPalette ? alphas.data() : nullptr, isPalette ? colors : 0, isPalette ? nullptr : &transparent);
  }
  png_write_info(png, head);
  std::vector<png_byte> row(png_get_rowbytes(png, head));
  const int passes = interlaced ? png_set_interlace_handling(png) : 1;
  for (int pass = 0; pass < passes; ++pass)
  {
    for (int y = 0; y < height; ++y)
    {
      for (std::size_t i = 0; i < row.size(); ++i)
      {
        row[i] = png_byte((i * 37 + std::size_t(y) * 11) % 7 == 0 ? 1 : i * 53 + std::size_t(y) * 29);
      }
      png_write_row(png, row.data());
    }
  }
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &head);
  std::fclose(file);
}

void expectAsTheLibrary(const std::string& path)
{
  const std::vector<std::uint8_t> expected = texelsOf(path);
  std::string problem;
  const auto found = dgtk::decodeTexture(path, problem);
  ASSERT_TRUE(found) << path << ": " << problem;
  EXPECT_FALSE(expected.empty()) << path;
  EXPECT_TRUE(found->rgba == expected) << path;
}
} // namespace

TEST(Pictures, EveryKindOfPngIsWhatTheLibraryReads)
{
  const TemporaryFolder folder;
  const std::vector<std::pair<int, std::vector<int>>> kinds{ { PNG_COLOR_TYPE_GRAY, { 1, 2, 4, 8, 16 } },
    { PNG_COLOR_TYPE_RGB, { 8, 16 } }, { PNG_COLOR_TYPE_PALETTE, { 1, 2, 4, 8 } },
    { PNG_COLOR_TYPE_GRAY_ALPHA, { 8, 16 } }, { PNG_COLOR_TYPE_RGB_ALPHA, { 8, 16 } } };
  for (const auto& [color, depths] : kinds)
  {
    for (const int bits : depths)
    {
      for (const bool clear : { false, true })
      {
        for (const bool interlaced : { false, true })
        {
          const bool hasAlpha = (color & PNG_COLOR_MASK_ALPHA) != 0;
          if (!(clear && hasAlpha))
          {
            const std::string path = folder.path(std::to_string(color) + '-' + std::to_string(bits) +
                                                 (clear ? "-clear" : "") + (interlaced ? "-interlaced" : "") + ".png");
            writePng(path, color, bits, clear, interlaced);
            expectAsTheLibrary(path);
          }
        }
      }
    }
  }
}

TEST(Pictures, EveryKindOfJpegIsWhatTheLibraryReads)
{
  const TemporaryFolder folder;
  for (const int channels : { 1, 3 })
  {
    for (const std::string sampling : { "4:4:4", "4:2:2", "4:2:0", "4:1:1" })
    {
      for (const int progressive : { 0, 1 })
      {
        const std::string path =
          folder.path(std::to_string(channels) + sampling[2] + sampling[4] + (progressive != 0 ? "p" : "") + ".jpg");
        const auto output = OIIO::ImageOutput::create(path);
        OIIO::ImageSpec spec(width + 3, height + 1, channels, OIIO::TypeDesc::UINT8);
        spec["jpeg:subsampling"] = sampling;
        spec["jpeg:progressive"] = progressive;
        std::vector<std::uint8_t> values(std::size_t((width + 3) * (height + 1) * channels));
        for (std::size_t i = 0; i < values.size(); ++i)
        {
          values[i] = std::uint8_t(i * i / 91 + i % 5 * 40);
        }
        ASSERT_TRUE(
          output->open(path, spec) && output->write_image(OIIO::TypeDesc::UINT8, values.data()) && output->close());
        expectAsTheLibrary(path);
      }
    }
  }
}

TEST(Pictures, ChannelsAreGreyOrColourAndAlpha)
{
  const TemporaryFolder folder;
  const auto write = [&folder](const std::string& name, int channels, const std::vector<float>& values)
  {
    const auto output = OIIO::ImageOutput::create(folder.path(name));
    OIIO::ImageSpec spec(
      2, 1, channels, name.find(".exr") == std::string::npos ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT);
    spec["oiio:UnassociatedAlpha"] = 1;
    output->open(folder.path(name), spec);
    output->write_image(OIIO::TypeDesc::FLOAT, values.data());
    return output->close();
  };
  const std::vector<float> first = { 0.2f, 0.4f, 0.6f, 0.8f }; // of 255: 51, 102, 153, 204
  const std::vector<int> expected[] = { { 51, 51, 51, 255 }, { 51, 51, 51, 102 }, { 51, 102, 153, 255 },
    { 51, 102, 153, 204 } };
  for (int channels = 1; channels <= 4; ++channels)
  {
    std::vector<float> values(first.begin(), first.begin() + channels);
    values.resize(2 * std::size_t(channels), 1);
    ASSERT_TRUE(write("a.png", channels, values));
    std::string problem;
    const auto image = dgtk::decodeTexture(folder.path("a.png"), problem);
    ASSERT_TRUE(image) << problem;
    EXPECT_EQ(std::vector<int>(image->rgba.begin(), image->rgba.begin() + 4), expected[channels - 1]) << channels;
    EXPECT_EQ(std::vector<int>(image->rgba.begin() + 4, image->rgba.end()), (std::vector<int>{ 255, 255, 255, 255 }));
    EXPECT_EQ(image->hasAlpha, channels % 2 == 0) << channels;
    // light has no alpha
    ASSERT_TRUE(write("a.exr", channels, values));
    const auto light = dgtk::decodeRadiance(folder.path("a.exr"), problem);
    ASSERT_TRUE(light) << problem;
    const bool grey = channels < 3;
    EXPECT_NEAR(light->rgb.at(0), 0.2, 1e-3) << channels;
    EXPECT_NEAR(light->rgb.at(1), grey ? 0.2 : 0.4, 1e-3) << channels;
    EXPECT_NEAR(light->rgb.at(2), grey ? 0.2 : 0.6, 1e-3) << channels;
    EXPECT_NEAR(light->rgb.at(3), 1, 1e-3) << channels;
    EXPECT_NEAR(light->rgb.at(5), 1, 1e-3) << channels;
  }
  std::string problem;
  ASSERT_TRUE(write("a.exr", 3, { -0.5f, 0, 2, 1000, -0.0f, 0.25f }));
  const auto light = dgtk::decodeRadiance(folder.path("a.exr"), problem);
  ASSERT_TRUE(light) << problem;
  EXPECT_EQ(light->rgb, (std::vector<float>{ 0, 0, 2, 1000, 0, 0.25f })) << "there is no less than none";
  for (const float wrong : { std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN() })
  {
    ASSERT_TRUE(write("a.exr", 3, { 0, 0, 0, 0, 0, wrong }));
    EXPECT_FALSE(dgtk::decodeRadiance(folder.path("a.exr"), problem));
    EXPECT_EQ(problem, "has a value that is not finite");
  }
}

TEST(Pictures, APictureThatEndsItsDecoderCostsItself)
{
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path("bad.rgb"), deadlySgi());
  dgtk::writeFile(folder.path("good.ppm"), "P6 1 1 255\nabc");
  std::string problem;
  EXPECT_FALSE(dgtk::decodeTexture(folder.path("bad.rgb"), problem));
  EXPECT_EQ(problem, "is damaged: its decoder ended abnormally (signal 6, Aborted)");
  EXPECT_FALSE(dgtk::decodeRadiance(folder.path("bad.rgb"), problem));
  EXPECT_THAT(problem, HasSubstr("ended abnormally"));
  EXPECT_TRUE(dgtk::decodeTexture(folder.path("good.ppm"), problem)) << problem;
  dgtk::writeFile(folder.path("m.ac"), modelWith({ "bad.rgb", "good.ppm" }));
  const auto model = dgtk::readModel(folder.path("m.ac"));
  ASSERT_EQ(model->textures.size(), 2u);
  EXPECT_FALSE(model->textures[0].image);
  EXPECT_TRUE(model->textures[1].image);
  ASSERT_EQ(model->warnings.size(), 1u);
  EXPECT_THAT(model->warnings[0], HasSubstr("bad.rgb cannot be decoded: is damaged"));
}

TEST(Pictures, DamagedOnesOfEveryFormatAreDecodedOrRefused)
{
  constexpr std::uint64_t variants = 40;
  const TemporaryFolder folder;
  int refused = 0;
  int decoded = 0;
  for (const auto& [extension, bytes] : soundPictures(folder))
  {
    for (std::uint64_t i = 0; i < variants; ++i)
    {
      const std::string path = folder.path("damaged." + extension);
      dgtk::writeFile(path, damaged(bytes, i));
      dgtk::TextureStore budget(std::uint64_t(64) << 20);
      std::string problem;
      try
      {
        const bool light = i % 2 == 1;
        const bool good = light ? dgtk::decodeRadiance(path, problem, &budget) != nullptr
                                : dgtk::decodeTexture(path, problem, &budget) != nullptr;
        ++(good ? decoded : refused);
        EXPECT_EQ(problem.empty(), good) << extension << ' ' << i;
        EXPECT_EQ(problem.find('\n'), std::string::npos) << extension << ' ' << i << ": " << problem;
        EXPECT_EQ(problem.find("/proc/"), std::string::npos) << extension << ' ' << i << ": " << problem;
      }
      catch (const dgtk::MachineError& error)
      {
        EXPECT_THAT(error.what(), HasSubstr("more than the 64 MiB")) << extension << ' ' << i;
      }
    }
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(decoded, 100);
}

TEST(Pictures, TheTextOfTheirLibrariesIsNotForUsers)
{
  const TemporaryFolder folder;
  std::string png = written(folder.path("a.png"));
  png.replace(png.find("IDAT") + 6, 4, "XXXX");
  dgtk::writeFile(folder.path("a.png"), png);
  std::string problem;
  testing::internal::CaptureStderr();
  EXPECT_FALSE(dgtk::decodeTexture(folder.path("a.png"), problem));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_NE(problem, "");
}

TEST(Pictures, AllTexturesOfAModelHaveOneBudget)
{
  const TemporaryFolder folder;
  std::vector<std::string> names;
  for (int i = 0; i < 10; ++i)
  {
    names.push_back("huge" + std::to_string(i) + ".png");
    dgtk::writeFile(folder.path(names.back()), hugePng());
  }
  dgtk::writeFile(folder.path("m.ac"), modelWith(names));
  try
  {
    dgtk::readModel(folder.path("m.ac"));
    FAIL() << "ten textures of 1 GiB";
  }
  catch (const dgtk::MachineError& error)
  {
    EXPECT_EQ(error.what(),
      folder.path("huge4.png") +
        ": a texture of 16384 x 16384 pixels; with it, all textures take 5120 MiB of memory, more than the 4096 MiB "
        "that they may (DGTK_TEXTURE_MEMORY raises it)");
  }
  dgtk::ReadOptions located;
  located.decodeTextures = false;
  EXPECT_EQ(dgtk::readModel(folder.path("m.ac"), located)->textures.size(), 10u);
}

TEST(Pictures, AStoreIsSharedAndItsMemoryIsSet)
{
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path("a.ppm"), "P6 2 1 255\nabcdef");
  dgtk::writeFile(folder.path("m.ac"), modelWith({ "a.ppm", "A.ppm" })); // one file, once
  dgtk::ReadOptions options;
  options.textures = std::make_shared<dgtk::TextureStore>(16);
  EXPECT_TRUE(dgtk::readModel(folder.path("m.ac"), options)->textures[1].image);
  std::string problem;
  const auto image = dgtk::decodeTexture(folder.path("a.ppm"), problem, options.textures.get());
  EXPECT_EQ(image, dgtk::readModel(folder.path("m.ac"), options)->textures[1].image) << "decoded once";
  dgtk::writeFile(folder.path("b.ppm"), "P6 2 1 255\nabcdef");
  EXPECT_TRUE(dgtk::decodeTexture(folder.path("b.ppm"), problem, options.textures.get()));
  dgtk::writeFile(folder.path("c.ppm"), "P6 2 1 255\nabcdef");
  EXPECT_THROW(dgtk::decodeTexture(folder.path("c.ppm"), problem, options.textures.get()), dgtk::MachineError);
  dgtk::TextureStore none(100);
  for (int i = 0; i < 2; ++i)
  {
    EXPECT_FALSE(dgtk::decodeTexture(folder.path("d.ppm"), problem, &none)) << "each one is told";
    EXPECT_THAT(problem, HasSubstr("cannot be opened"));
  }
  dgtk::TextureStore light(23); // three floats a pixel
  EXPECT_THROW(dgtk::decodeRadiance(folder.path("a.ppm"), problem, &light), dgtk::MachineError);
  ::setenv("DGTK_TEXTURE_MEMORY", "0", 1);
  EXPECT_THROW(dgtk::readModel(folder.path("m.ac")), dgtk::MachineError);
  ::setenv("DGTK_TEXTURE_MEMORY", "1", 1);
  EXPECT_TRUE(dgtk::readModel(folder.path("m.ac"))->textures[0].image);
  ::setenv("DGTK_TEXTURE_MEMORY", "a lot", 1);
  EXPECT_THROW(dgtk::readModel(folder.path("m.ac")), dgtk::MachineError);
  ::unsetenv("DGTK_TEXTURE_MEMORY");
}

TEST(Pictures, AHeaderThatPromisesTooMuchIsRefusedBeforeAnythingIsMade)
{
  const TemporaryFolder folder;
  dgtk::writeFile(
    folder.path("sky.hdr"), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16384 +X 16384\n" + std::string(200, '\0'));
  std::string problem;
  EXPECT_FALSE(dgtk::decodeRadiance(folder.path("sky.hdr"), problem));
  EXPECT_EQ(problem, "is cut short: 253 bytes cannot hold 16384 x 16384 pixels");
  EXPECT_FALSE(dgtk::decodeTexture(folder.path("sky.hdr"), problem));
  EXPECT_THAT(problem, HasSubstr("is cut short"));
}

/// Addresses this process may take beyond those that it has, for as long as the object lives.
class FewAddresses
{
public:
  explicit FewAddresses(std::uint64_t bytes)
  {
    ::getrlimit(RLIMIT_AS, &this->Before);
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit now = this->Before;
    now.rlim_cur = pages * 4096 + bytes;
    ::setrlimit(RLIMIT_AS, &now);
  }
  ~FewAddresses() { ::setrlimit(RLIMIT_AS, &this->Before); }
  FewAddresses(const FewAddresses&) = delete;
  FewAddresses& operator=(const FewAddresses&) = delete;

private:
  rlimit Before{};
};

TEST(Pictures, TooLittleMemoryIsTheMachinesFault)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers reserve terabytes of addresses";
#endif
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path("a.pgm"), std::string("P5 16000 5000 255\n").append(80'000'000, 'x'));
  dgtk::writeFile(folder.path("m.ac"), modelWith({ "a.pgm" }));
  std::string problem;
  const FewAddresses few(std::uint64_t(200) << 20); // of 320 MB
  EXPECT_THROW(dgtk::decodeTexture(folder.path("a.pgm"), problem), dgtk::MachineError);
  EXPECT_THROW(dgtk::readModel(folder.path("m.ac")), dgtk::MachineError);
}

/// What is decoded where the machine has too little room for any picture: 0 a picture, 1 none, 2 the machine's fault.
int decodedInLittleRoom(const std::string& path)
{
  const FewAddresses few(std::uint64_t(200) << 20); // a decoder has 512 MiB
  std::string problem;
  try
  {
    return dgtk::decodeTexture(path, problem) ? 0 : 1;
  }
  catch (const dgtk::MachineError&)
  {
    return 2;
  }
}

TEST(Pictures, InTooLittleRoomNobodyCanSayThatAPictureIsDamaged)
{
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "sanitizers reserve terabytes of addresses";
#endif
  testing::FLAGS_gtest_death_test_style = "threadsafe"; // a program of its own has a decoder of its own
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path("a.png"), "no picture");
  EXPECT_EXIT(std::_Exit(decodedInLittleRoom(folder.path("a.png"))), testing::ExitedWithCode(2), "");
}
