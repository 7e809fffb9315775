// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkTestSupport.h"
#include "dgtkTextureFile.h"

#include <gmock/gmock.h>

#include <OpenImageIO/imageio.h>

using dgtk::decodeTexture;
using dgtk::writeFile;
using dgtk::test::TemporaryFolder;

TEST(TextureFile, ColoursOfLightAreItsCodesAndDataAreAsTheyAre)
{
  const TemporaryFolder folder;
  // two pixels of red, green, blue and alpha, which multiplies them in the file
  const float values[] = { 0.5F, 0.25F, 0, 1, 0.25F, 2, 0.125F, 0.5F };
  for (const std::string name : { "a.exr", "a.tif" })
  {
    const auto output = OIIO::ImageOutput::create(folder.path(name));
    ASSERT_TRUE(output->open(folder.path(name), OIIO::ImageSpec(2, 1, 4, OIIO::TypeDesc::FLOAT)));
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, values) && output->close());
    std::string problem;
    dgtk::TextureStore store(64); // both uses
    const auto color = decodeTexture(folder.path(name), problem, &store);
    ASSERT_TRUE(color) << problem;
    EXPECT_THAT(color->rgba, testing::ElementsAre(188, 137, 0, 255, 188, 255, 137, 128)) << name;
    const auto data = decodeTexture(folder.path(name), problem, &store, dgtk::TextureUse::Data);
    ASSERT_TRUE(data) << problem;
    EXPECT_THAT(data->rgba, testing::ElementsAre(128, 64, 0, 255, 128, 255, 64, 128)) << name;
    dgtk::TextureStore small(15);
    EXPECT_TRUE(decodeTexture(folder.path(name), problem, &small));
    EXPECT_THROW(decodeTexture(folder.path(name), problem, &small, dgtk::TextureUse::Data), dgtk::MachineError);
  }
  writeFile(folder.path("a.hdr"), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n-Y 1 +X 1\n\x80\x80\x80\x81");
  std::string problem;
  const auto color = decodeTexture(folder.path("a.hdr"), problem);
  ASSERT_TRUE(color) << problem;
  EXPECT_EQ(int(color->rgba.at(0)), 188) << "1 at an exposure of 2";
  writeFile(folder.path("a.ppm"), "P6 1 1 255\n\x64\x64\x64");
  dgtk::TextureStore one(4);
  const auto code = decodeTexture(folder.path("a.ppm"), problem, &one);
  EXPECT_EQ(code, decodeTexture(folder.path("a.ppm"), problem, &one, dgtk::TextureUse::Data)) << "both uses are one";
}

TEST(TextureFile, DataWindowsStandInTheirDisplayWindow)
{
  struct Row
  {
    int x, y, width, height; ///< of the data; the display is 4 x 3 at (10, 20)
  };
  const TemporaryFolder folder;
  std::string problem;
  for (const Row& row : { Row{ 10, 20, 4, 3 }, Row{ 11, 21, 2, 1 }, Row{ 8, 19, 7, 5 }, Row{ 12, 18, 5, 3 } })
  {
    OIIO::ImageSpec spec(row.width, row.height, 4, OIIO::TypeDesc::FLOAT);
    spec.x = row.x;
    spec.y = row.y;
    spec.full_x = 10;
    spec.full_y = 20;
    spec.full_width = 4;
    spec.full_height = 3;
    std::vector<float> values;
    for (int i = 0; i < row.width * row.height; ++i)
    {
      const float red = float(row.x + i % row.width) / 64;
      values.insert(values.end(), { red, float(row.y + i / row.width) / 64, 1, 1 });
    }
    const auto output = OIIO::ImageOutput::create(folder.path("a.exr"));
    ASSERT_TRUE(output->open(folder.path("a.exr"), spec));
    ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, values.data()) && output->close());
    const auto light = dgtk::decodeRadiance(folder.path("a.exr"), problem);
    const auto texels = decodeTexture(folder.path("a.exr"), problem);
    ASSERT_TRUE(light && texels) << problem;
    ASSERT_EQ(std::make_pair(light->width, light->height), std::make_pair(4, 3));
    ASSERT_EQ(std::make_pair(texels->width, texels->height), std::make_pair(4, 3));
    for (int i = 0; i < 12; ++i)
    {
      const int x = 10 + i % 4;
      const int y = 20 + i / 4;
      const bool there = x >= row.x && x < row.x + row.width && y >= row.y && y < row.y + row.height;
      const float* const rgb = &light->rgb.at(std::size_t(3) * i);
      EXPECT_THAT(std::vector<float>(rgb, rgb + 3),
        testing::ElementsAre(there ? float(x) / 64 : 0.0F, there ? float(y) / 64 : 0.0F, there ? 1.0F : 0.0F))
        << row.x << ' ' << i;
      EXPECT_EQ(texels->rgba.at(std::size_t(4) * i + 3), there ? 255 : 0) << row.x << ' ' << i;
    }
  }
}

TEST(TextureFile, LogarithmicColoursAreRefused)
{
  const TemporaryFolder folder;
  const auto problemOf = [&folder](int compression, int colors)
  {
    std::string bytes("II*\0\x10\0\0\0\0\0\0\0\0\0\0\0\x09\0", 18); // a pixel, then its nine tags
    const auto number = [&bytes](int value, int count)
    {
      for (int i = 0; i < count; ++i)
      {
        bytes += static_cast<char>(value >> (8 * i));
      }
    };
    for (const auto& [tag, value] :
      std::vector<std::pair<int, int>>{ { 256, 1 }, { 257, 1 }, { 258, 16 }, { 259, compression }, { 262, colors },
        { 273, 8 }, { 277, colors == 32845 ? 3 : 1 }, { 278, 1 }, { 279, 8 } })
    {
      number(tag, 2);
      number(4, 2);
      number(1, 4);
      number(value, 4);
    }
    number(0, 4);
    writeFile(folder.path("a.tif"), bytes);
    std::string problem;
    decodeTexture(folder.path("a.tif"), problem);
    return problem;
  };
  const std::string said = "has logarithmic colours (LogL, LogLuv), which are not read: save it as .hdr or .exr";
  EXPECT_EQ(problemOf(34676, 32845), said);
  EXPECT_EQ(problemOf(34676, 32844), said);
  EXPECT_EQ(problemOf(1, 1), "");
}
