// SPDX-License-Identifier: BSD-3-Clause
// Pictures of strangers, decoded in processes of their own: sound and damaged ones of every format.
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkModelChecks.h"
#include "dgtkTestSupport.h"
#include "dgtkTextureFile.h"

#include <OpenImageIO/imageio.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <limits>
#include <map>

#include <sys/resource.h>

using namespace dgtk::test;
using testing::HasSubstr;

namespace
{
constexpr int width = 64; // the writer of HEIF reads whole multiples of 64 bytes a row
constexpr int height = 36;

/// While it lives, files may not have more than 100 bytes.
class SmallFiles
{
public:
  SmallFiles()
    : Handler(std::signal(SIGXFSZ, SIG_IGN))
  {
    ::getrlimit(RLIMIT_FSIZE, &this->Before);
    const rlimit small{ 100, this->Before.rlim_max };
    ::setrlimit(RLIMIT_FSIZE, &small);
  }
  ~SmallFiles()
  {
    ::setrlimit(RLIMIT_FSIZE, &this->Before);
    std::signal(SIGXFSZ, this->Handler);
  }
  SmallFiles(const SmallFiles&) = delete;
  SmallFiles& operator=(const SmallFiles&) = delete;

private:
  rlimit Before{};
  void (*Handler)(int);
};

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

} // namespace

TEST(Pictures, ColoursCountWithoutTheAlphaThatMultipliesThem)
{
  const TemporaryFolder folder;
  const std::uint8_t texels[] = { 64, 128, 0, 128, 10, 20, 30, 255, 0, 0, 0, 0 };
  for (const int unassociated : { 0, 1 })
  {
    const std::string path = folder.path(std::to_string(unassociated) + ".tif");
    const auto output = OIIO::ImageOutput::create(path);
    OIIO::ImageSpec spec(3, 1, 4, OIIO::TypeDesc::UINT8);
    spec["oiio:UnassociatedAlpha"] = unassociated;
    ASSERT_TRUE(output && output->open(path, spec) && output->write_image(OIIO::TypeDesc::UINT8, texels));
    output->close();
    std::string problem;
    const auto image = dgtk::decodeTexture(path, problem);
    ASSERT_TRUE(image) << problem;
    const std::uint8_t red = unassociated ? 64 : 128; // 64 * 255 / 128 is 127.5
    const std::uint8_t green = unassociated ? 128 : 255;
    EXPECT_EQ(image->rgba, (std::vector<std::uint8_t>{ red, green, 0, 128, 10, 20, 30, 255, 0, 0, 0, 0 }));
  }
}

TEST(Pictures, ALimitOfFileSizesIsSaid)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("a.png");
  ASSERT_FALSE(written(path).empty());
  std::string problem;
  ASSERT_TRUE(dgtk::decodeTexture(path, problem)) << problem;
  const auto refusal = [&]
  {
    const SmallFiles small;
    return thrownBy<dgtk::MachineError>([&] { dgtk::decodeTexture(path, problem); });
  };
  EXPECT_THAT(refusal(), HasSubstr("bytes here (see ulimit -f)"));
}

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
    const auto image = dgtk::decodeTexture(path, problem, nullptr, dgtk::TextureUse::Data);
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

TEST(Pictures, DamagedOnesOfEveryFormatAreDecodedOrRefused)
{
  const std::uint64_t variants = sweepsAreWhole() ? 40 : 12;
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
  EXPECT_GT(refused, 2.5 * double(variants));
  EXPECT_GT(decoded, 2.5 * double(variants));
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
  EXPECT_THAT(problem, testing::StartsWith("PNG read error: IDAT: "));
  EXPECT_EQ(problem.find("library"), std::string::npos);
}

namespace
{
/// Bytes of a number, the first one highest.
std::string big(std::uint32_t value, int bytes)
{
  std::string text;
  for (int i = bytes - 1; i >= 0; --i)
  {
    text += char(value >> (8 * i));
  }
  return text;
}

/// Of a written PNG the same with another size in its header.
std::string pngOf(std::string png, std::uint32_t wide, std::uint32_t high)
{
  png.replace(16, 8, big(wide, 4) + big(high, 4));
  const auto* const chunk = reinterpret_cast<const Bytef*>(png.data()) + 12;
  return png.replace(29, 4, big(std::uint32_t(crc32(0, chunk, 17)), 4));
}

std::string jpegOf(std::string jpeg, std::uint32_t wide, std::uint32_t high)
{
  return jpeg.replace(jpeg.find("\xff\xc0") + 5, 4, big(high, 2) + big(wide, 2));
}
} // namespace

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
  // The largest side is 16384; a byte of a PNG is a thousand at most.
  const std::string png = written(folder.path("a.png"));
  const std::string jpeg = written(folder.path("a.jpg"));
  struct Row
  {
    const char* name;
    std::string bytes;
    std::string says;
  };
  const std::string pngBytes = std::to_string(png.size());
  const Row rows[] = { { "a.png", pngOf(png, 16385, 36), "is 16385 x 36 pixels, at most 16384 a side" },
    { "a.png", pngOf(png, 64, 20000), "is 64 x 20000 pixels, at most 16384 a side" },
    { "a.png", pngOf(png, 16384, 16384), "is cut short: " + pngBytes + " bytes cannot hold 16384 x 16384 pixels" },
    { "a.jpg", jpegOf(jpeg, 16385, 36), "is 16385 x 36 pixels, at most 16384 a side" },
    { "a.jpg", jpegOf(jpeg, 64, 65000), "is 64 x 65000 pixels, at most 16384 a side" } };
  for (const Row& row : rows)
  {
    dgtk::writeFile(folder.path(row.name), row.bytes);
    EXPECT_FALSE(dgtk::decodeTexture(folder.path(row.name), problem));
    EXPECT_EQ(problem, row.says);
  }
}
