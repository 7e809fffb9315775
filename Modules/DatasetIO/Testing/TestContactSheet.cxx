// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkContactSheet.h"

#include "dgtkCanvas.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkHash.h"
#include "dgtkLayerPicture.h"
#include "dgtkTestImages.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <set>

using namespace dgtk;
using namespace dgtk::test;

namespace
{
/// A sphere over a floor, as the layers of a dataset.
Manifest makeDataset(const std::string& folder, int frames)
{
  constexpr int w = 160;
  constexpr int h = 120;
  Manifest manifest;
  const struct
  {
    const char* name;
    const char* format;
    PixelType type;
    int channels;
  } layers[] = { { "color", "png", PixelType::UInt8, 3 }, { "depth", "npy", PixelType::Float64, 1 },
    { "objects", "ppm", PixelType::UInt32, 1 }, { "normal", "exr", PixelType::Float32, 3 },
    { "uv", "npy", PixelType::Float32, 2 } };
  for (const auto& layer : layers)
  {
    const LayerSpec spec = specOf(layer.type, layer.channels, layer.name);
    manifest.layers.push_back({ spec, layer.format });
    for (int frame = 0; frame < frames; ++frame)
    {
      Rows rows(spec.type, spec.channels, w, 0, h);
      for (int y = 0; y < h; ++y)
      {
        for (int x = 0; x < w; ++x)
        {
          const double nx = (x - 80 - 5 * frame) / 45.0;
          const double ny = (y - 60) / 45.0;
          const double r2 = nx * nx + ny * ny;
          const bool sphere = r2 < 1;
          const bool floor = !sphere && y > 80;
          const double nz = sphere ? -std::sqrt(1 - r2) : 0;
          const int i = (x * spec.channels);
          const double far = std::numeric_limits<double>::infinity();
          const float none = std::numeric_limits<float>::quiet_NaN();
          if (layer.type == PixelType::Float64)
          {
            rows.row<double>(y)[x] = sphere ? 5 + nz : floor ? 200.0 / (y - 60) : far;
          }
          for (int c = 0; c < spec.channels && layer.type == PixelType::UInt8; ++c)
          {
            rows.row<std::uint8_t>(y)[i + c] = std::uint8_t(sphere ? -nz * (c == 0 ? 250 : 90) : floor ? 120 : 200);
          }
          if (layer.type == PixelType::UInt32)
          {
            rows.row<std::uint32_t>(y)[x] = sphere ? 2 : floor ? 1 : 0;
          }
          for (int c = 0; c < spec.channels && layer.type == PixelType::Float32; ++c)
          {
            rows.row<float>(y)[i + c] = sphere ? float(c == 0 ? nx : c == 1 ? ny : nz) : none;
          }
        }
      }
      makeFolders(folder + "/left/" + layer.name);
      const std::string name =
        std::string("left/") + layer.name + "/00000" + std::to_string(frame) + "." + layer.format;
      const FileRecord record = writeImage(layer.format, folder + '/' + name, spec, rows, 50, {});
      manifest.files.push_back({ name, record.bytes, record.sha256, layer.name, "left", frame });
    }
  }
  return manifest;
}

TEST(LayerPicture, ValuesHaveTheColoursOfTheSheet)
{
  Rows depth(PixelType::Float64, 1, 3, 0, 1);
  depth.row<double>(0)[0] = 1;
  depth.row<double>(0)[1] = 10;
  depth.row<double>(0)[2] = std::numeric_limits<double>::infinity();
  const LayerPicture picture =
    paintLayer(depth, { "depth", PixelType::Float64, 1, "", "", "+inf", "", Meaning::Depth });
  ASSERT_EQ(picture.pixels.size(), 3u);
  EXPECT_EQ(picture.width, 3);
  EXPECT_EQ(picture.pixels[0], rampColor(1));
  EXPECT_EQ(picture.pixels[1], rampColor(0.15));
  EXPECT_EQ(picture.pixels[2], (Rgb{ 40, 40, 44 })) << "nothing";
  Rows ids(PixelType::UInt32, 1, 2, 0, 1);
  ids.row<std::uint32_t>(0)[0] = 0;
  ids.row<std::uint32_t>(0)[1] = 7;
  const LayerPicture objects = paintLayer(ids, { "objects", PixelType::UInt32, 1, "id", "", "0", "", Meaning::Id });
  EXPECT_EQ(objects.pixels[0], idColor(0));
  EXPECT_EQ(objects.pixels[1], idColor(7));
}

template <typename T>
std::vector<Rgb> painted(PixelType type, int channels, Meaning meaning, const std::vector<T>& values)
{
  Rows rows(type, channels, int(values.size()) / channels, 0, 1);
  std::copy(values.begin(), values.end(), rows.row<T>(0));
  return paintLayer(rows, { "x", type, channels, "", "", "", "", meaning }).pixels;
}

TEST(LayerPicture, PicturesHaveTheirOwnColours)
{
  const std::vector<Rgb> expected = { { 0, 128, 255 }, { 127, 1, 254 } };
  EXPECT_EQ(painted<std::uint8_t>(PixelType::UInt8, 3, Meaning::Picture, { 0, 128, 255, 127, 1, 254 }), expected);
  // 128 / 255 of 65535, half a step more and less
  EXPECT_EQ(painted<std::uint16_t>(PixelType::UInt16, 3, Meaning::Picture, { 32896, 33024, 32768 }),
    (std::vector<Rgb>{ { 128, 128, 128 } }));
  EXPECT_EQ(painted<std::uint16_t>(PixelType::UInt16, 3, Meaning::Picture, { 33025, 32767, 65535 }),
    (std::vector<Rgb>{ { 129, 127, 255 } }));
  EXPECT_EQ(painted<std::uint8_t>(PixelType::UInt8, 1, Meaning::Picture, { 9 }), (std::vector<Rgb>{ { 9, 9, 9 } }));
  EXPECT_EQ(
    painted<std::uint8_t>(PixelType::UInt8, 4, Meaning::Picture, { 9, 8, 7, 0 }), (std::vector<Rgb>{ { 9, 8, 7 } }));
  // linear light: 255 (1.055 x^(1 / 2.4) - 0.055) is 187.5, 12.92 x up to 0.0031308
  EXPECT_EQ(painted<float>(PixelType::Float32, 3, Meaning::Picture, { 0.5f, 0.002f, 4.0f, 0, -1, 1 }),
    (std::vector<Rgb>{ { 188, 7, 255 }, { 0, 0, 255 } }));
}

TEST(LayerPicture, ValuesInTheirOwnRanges)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  // normals: x to the right, y up and towards the viewer are bright
  EXPECT_EQ(painted<float>(PixelType::Float32, 3, Meaning::Direction, { 1, -1, -1, -1, 1, 1, 0, 0, 0 }),
    (std::vector<Rgb>{ { 255, 255, 255 }, { 0, 0, 0 }, { 128, 128, 128 } }));
  EXPECT_EQ(painted<double>(PixelType::Float64, 2, Meaning::TextureCoordinates, { 0.5, 2.25, -0.75, 0, nan, 0 }),
    (std::vector<Rgb>{ { 128, 64, 64 }, { 64, 0, 64 }, nothingColor }));
  // from the least to the largest of each channel
  EXPECT_EQ(painted<double>(PixelType::Float64, 3, Meaning::Point, { 1, 10, 5, 3, 30, 5, 2, 25, 5 }),
    (std::vector<Rgb>{ { 0, 0, 128 }, { 255, 255, 128 }, { 128, 191, 128 } }));
  EXPECT_EQ(painted<double>(PixelType::Float64, 1, Meaning::InverseDepth, { 4, 8, 6 }),
    (std::vector<Rgb>{ rampColor(0.15), rampColor(1), rampColor(0.575) }));
  EXPECT_EQ(painted<double>(PixelType::Float64, 2, Meaning::Point, { 1, 30, 3, 10 }),
    (std::vector<Rgb>{ { 0, 255, 64 }, { 255, 0, 64 } }));
  // depth by its logarithm: 1, 10 and 100
  EXPECT_EQ(painted<double>(PixelType::Float64, 1, Meaning::Depth, { 1, 100, 10 }),
    (std::vector<Rgb>{ rampColor(1), rampColor(0.15), rampColor(0.575) }));
  // of many values, one hundredth at either end does not count
  std::vector<double> many(200);
  for (std::size_t i = 0; i < many.size(); ++i)
  {
    many[i] = i < 2 ? -1e6 : i >= 198 ? 1e6 : double(i);
  }
  const std::vector<Rgb> robust = painted<double>(PixelType::Float64, 1, Meaning::InverseDepth, many);
  EXPECT_EQ(robust[2], rampColor(0.15));
  EXPECT_EQ(robust[197], rampColor(1));
}

TEST(LayerPicture, DepthsFromZeroOnHaveNoLogarithm)
{
  EXPECT_EQ(painted<double>(PixelType::Float64, 1, Meaning::Depth, { 0, 10, 5 }),
    (std::vector<Rgb>{ rampColor(1), rampColor(0.15), rampColor(0.575) }));
  // a range that was set for others may leave some out
  ImageInfo info;
  info.type = PixelType::Float64;
  info.channels = 1;
  LayerColors colors(LayerLook::Depth, specOf(PixelType::Float64, 1, "depth"), info);
  colors.setRange(0, 1, 100);
  const double depths[] = { -3, 0, 0.5, 1000 };
  EXPECT_EQ(colors(&depths[0]), rampColor(1));
  EXPECT_EQ(colors(&depths[1]), rampColor(1));
  EXPECT_EQ(colors(&depths[2]), rampColor(1));
  EXPECT_EQ(colors(&depths[3]), rampColor(0.15));
}

TEST(LayerPicture, IdsMayStartAtZeroAndBeDimmed)
{
  Rows ids(PixelType::UInt16, 1, 3, 0, 1);
  const std::uint16_t values[] = { 0, 6, 65535 };
  std::copy(std::begin(values), std::end(values), ids.row<std::uint16_t>(0));
  EXPECT_EQ(paintLayer(ids, { "parts", PixelType::UInt16, 1, "", "", "65535", "", Meaning::Index }).pixels,
    (std::vector<Rgb>{ idColor(1), idColor(7), nothingColor }));
  // red, green and blue are an id, the fourth channel how much of the pixel has it
  Rgb dimmed = idColor(0x010203);
  for (std::uint8_t& channel : dimmed)
  {
    channel = std::uint8_t(channel * 51 / 255);
  }
  Rows matte(PixelType::UInt8, 4, 2, 0, 1);
  const std::uint8_t bytes[] = { 1, 2, 3, 51, 1, 2, 3, 255 };
  std::copy(std::begin(bytes), std::end(bytes), matte.row<std::uint8_t>(0));
  EXPECT_EQ(paintLayer(matte, { "alpha", PixelType::UInt8, 4, "", "", "0", "", Meaning::Id }).pixels,
    (std::vector<Rgb>{ dimmed, idColor(0x010203) }));
}

TEST(LayerPicture, ColoursOfRampsWheelsAndIds)
{
  EXPECT_EQ(rampColor(-1), (Rgb{ 24, 15, 61 }));
  EXPECT_EQ(rampColor(2), (Rgb{ 250, 245, 170 }));
  EXPECT_EQ(rampColor(0.5), (Rgb{ 203, 75, 79 }));
  EXPECT_EQ(rampColor(1.0 / 12), (Rgb{ 54, 23, 84 })); // half way between two stops
  EXPECT_EQ(wheelColor(1, 0), (Rgb{ 255, 0, 0 }));
  EXPECT_EQ(wheelColor(0, 1), (Rgb{ 128, 255, 0 }));
  EXPECT_EQ(wheelColor(-1, 0), (Rgb{ 0, 255, 255 }));
  EXPECT_EQ(wheelColor(0, -1), (Rgb{ 128, 0, 255 }));
  EXPECT_EQ(wheelColor(0.5, 0), (Rgb{ 255, 128, 128 }));
  EXPECT_EQ(wheelColor(5, 0), (Rgb{ 255, 0, 0 }));
  std::set<Rgb> colors;
  for (std::uint32_t id = 0; id < 200; ++id)
  {
    colors.insert(idColor(id));
  }
  EXPECT_GE(colors.size(), 199u);
  EXPECT_EQ(idColor(0), nothingColor);
}

TEST(Thumbnail, PicturesAreAveragedAndValuesPicked)
{
  const TemporaryFolder folder;
  LayerSpec color = specOf(PixelType::UInt8, 3, "color");
  Rows rows(PixelType::UInt8, 3, 4, 0, 2);
  for (int y = 0; y < 2; ++y)
  {
    for (int i = 0; i < 12; ++i)
    {
      rows.row<std::uint8_t>(y)[i] = std::uint8_t(i / 3 * 20 + y * 100 + i % 3);
    }
  }
  writeImage("png", folder.path("a.png"), color, rows, 1, {});
  const Canvas small = makeThumbnail(folder.path("a.png"), color, 2, 1);
  EXPECT_EQ(small.pixels(), (std::vector<Rgb>{ { 60, 61, 62 }, { 100, 101, 102 } }));
  LayerSpec objects = specOf(PixelType::UInt32, 1, "objects");
  Rows ids(PixelType::UInt32, 1, 6, 0, 1);
  for (std::uint32_t i = 0; i < 6; ++i)
  {
    ids.row<std::uint32_t>(0)[i] = i + 1;
  }
  writeImage("npy", folder.path("a.npy"), objects, ids, 1, {});
  // the middle one of each three
  EXPECT_EQ(makeThumbnail(folder.path("a.npy"), objects, 2, 1).pixels(), (std::vector<Rgb>{ idColor(2), idColor(5) }));
}

TEST(Thumbnail, OfAnEvenNumberTheFirstOfTheTwoInTheMiddleIsPicked)
{
  const TemporaryFolder folder;
  LayerSpec objects = specOf(PixelType::UInt32, 1, "objects");
  for (const bool upright : { false, true })
  {
    Rows ids(PixelType::UInt32, 1, upright ? 1 : 8, 0, upright ? 8 : 1);
    for (std::uint32_t i = 0; i < 8; ++i)
    {
      ids.row<std::uint32_t>(0)[i] = i + 1;
    }
    writeImage("npy", folder.path("a.npy"), objects, ids, 1, {});
    EXPECT_EQ(makeThumbnail(folder.path("a.npy"), objects, upright ? 1 : 2, upright ? 2 : 1).pixels(),
      (std::vector<Rgb>{ idColor(2), idColor(6) }))
      << upright;
  }
}

TEST(LayerPicture, FlowHasTheColourWheel)
{
  Rows flow(PixelType::Float64, 2, 4, 0, 1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double values[] = { 3, 4, -2.5, 0, 0, 0, nan, nan };
  std::copy(std::begin(values), std::end(values), flow.row<double>(0));
  const LayerPicture picture =
    paintLayer(flow, { "flow_forward", PixelType::Float64, 2, "pixels", "", "nan", "", Meaning::Displacement });
  EXPECT_EQ(picture.longest, 5);
  EXPECT_EQ(picture.pixels[0], wheelColor(0.6, 0.8));
  EXPECT_EQ(picture.pixels[1], wheelColor(-0.5, 0));
  EXPECT_EQ(picture.pixels[2], (Rgb{ 255, 255, 255 })) << "at rest";
  EXPECT_EQ(picture.pixels[3], nothingColor);
}

TEST(LayerPicture, TheLongestHundredthOfAFlowIsNotShownInFull)
{
  Rows flow(PixelType::Float64, 2, 200, 0, 1);
  for (int i = 0; i < 200; ++i)
  {
    flow.row<double>(0)[2 * i] = 0;
    flow.row<double>(0)[2 * i + 1] = -(i + 1);
  }
  EXPECT_EQ(paintLayer(flow, specOf(PixelType::Float64, 2, "flow_forward")).longest, 198);
}
} // namespace

TEST(Canvas, TextIsCutAtThePicturesBorders)
{
  const auto drawn = [](int x, int y, int px, int py)
  {
    Canvas canvas(9, 9, { 0, 0, 0 });
    canvas.text("A", x, y, 9, { 9, 9, 9 });
    return canvas.at(px, py)[0] != 0;
  };
  for (const auto& [x, y] : { std::pair(-2, 1), { 6, 1 }, { 1, -3 }, { 1, 5 }, { 1, -9 } })
  {
    for (int py = 0; py < 9; ++py)
    {
      for (int px = 0; px < 9; ++px)
      {
        const bool inside = px >= x && px < x + 5 && py >= y && py < y + 7;
        EXPECT_EQ(drawn(x, y, px, py), inside && (glyphOf('A')[std::size_t(py - y)] >> (4 - px + x) & 1) != 0)
          << x << ' ' << y << ' ' << px << ' ' << py;
      }
    }
  }
}

TEST(Canvas, EachLetterHasItsOwnShape)
{
  std::set<std::array<std::uint8_t, 7>> shapes{ glyphOf('\x7f') };
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
  for (const char letter : letters)
  {
    EXPECT_TRUE(shapes.insert(glyphOf(letter)).second) << letter;
  }
  EXPECT_EQ(glyphOf('T')[0], 0x1f) << "a bar, and what stands below its middle";
  EXPECT_EQ(glyphOf('T')[6], 0x04);
}

TEST(ContactSheet, RowsAreFramesColumnsAreLayers)
{
  const TemporaryFolder folder;
  const Manifest manifest = makeDataset(folder.path(), 3);
  writeFile(folder.path("manifest.json"), manifestText(manifest));
  const DatasetFile file = writeContactSheet(folder.path(), "contact.png");
  EXPECT_EQ(file.path, "contact.png");
  EXPECT_EQ(file.sha256, Sha256::ofFile(folder.path("contact.png")));
  const ImageData sheet = readLayerFile(folder.path("contact.png"));
  // 5 columns of 200 pixels, 3 rows of 150, gaps of 6, room for the names
  EXPECT_EQ(sheet.info.width, 6 + 36 + 6 + 5 * 206);
  EXPECT_EQ(sheet.info.height, 13 + 6 + 3 * 156);
  // every cell shows something: more than one colour
  for (int row = 0; row < 3; ++row)
  {
    for (int column = 0; column < 5; ++column)
    {
      std::set<std::uint32_t> colors;
      for (int y = 0; y < 150; y += 7)
      {
        for (int x = 0; x < 200; x += 7)
        {
          const std::uint8_t* p =
            sheet.pixels.row<std::uint8_t>(19 + row * 156 + y) + 3 * std::size_t(48 + column * 206 + x);
          colors.insert(std::uint32_t(p[0]) << 16 | std::uint32_t(p[1]) << 8 | p[2]);
        }
      }
      EXPECT_GT(colors.size(), 2u) << row << ' ' << column;
    }
  }
  if (const char* keep = std::getenv("DGTK_KEEP_SHEET"))
  {
    writeFile(keep, contentsOf(folder.path("contact.png")));
  }
}

TEST(ContactSheet, FramesAreChosenEvenly)
{
  const TemporaryFolder folder;
  const Manifest manifest = makeDataset(folder.path(), 9);
  ContactSheetOptions options;
  options.maxFrames = 3;
  options.thumbnailWidth = 80;
  writeContactSheet(folder.path(), manifest, "contact.png", options);
  EXPECT_EQ(readLayerFile(folder.path("contact.png")).info.height, 13 + 6 + 3 * 66);
}

namespace
{
/// A dataset of one picture, of one gray.
Manifest makeGray(
  const std::string& folder, int width, int height, std::uint8_t gray, const std::string& format = "png")
{
  const LayerSpec spec = specOf(PixelType::UInt8, 3, "color");
  Rows rows(PixelType::UInt8, 3, width, 0, height);
  std::fill_n(rows.row<std::uint8_t>(0), rows.bytes(), gray);
  makeFolders(folder + "/left/color");
  const std::string name = "left/color/000000." + format;
  const FileRecord record = writeImage(format, folder + '/' + name, spec, rows, height, {});
  Manifest manifest;
  manifest.layers.push_back({ spec, format });
  manifest.files.push_back({ name, record.bytes, record.sha256, "color", "left", 0 });
  return manifest;
}

/// Red of a pixel of the only cell, whose corner is at (48, 19).
int cellRed(const ImageData& sheet, int x, int y) { return sheet.pixels.row<std::uint8_t>(19 + y)[3 * (48 + x)]; }
} // namespace

// A cell is twice as high as wide at most; pictures stand in its middle.
TEST(ContactSheet, NarrowAndWidePicturesFit)
{
  const TemporaryFolder folder;
  ContactSheetOptions options;
  options.thumbnailWidth = 4; // 16 at least
  constexpr int paper = 22;
  writeContactSheet(folder.path(), makeGray(folder.path(), 10, 100, 200), "contact.png", options);
  const ImageData high = readLayerFile(folder.path("contact.png"));
  EXPECT_EQ(high.info.width, 48 + 16 + 6);
  EXPECT_EQ(high.info.height, 19 + 32 + 6);
  for (int x = 0; x < 16; ++x) // 3 columns of 0.32 times the picture
  {
    EXPECT_EQ(cellRed(high, x, 0), x >= 6 && x < 9 ? 200 : paper) << x;
    EXPECT_EQ(cellRed(high, x, 31), x >= 6 && x < 9 ? 200 : paper) << x;
  }
  writeContactSheet(folder.path(), makeGray(folder.path(), 200, 2, 100), "contact.png", options);
  const ImageData wide = readLayerFile(folder.path("contact.png"));
  EXPECT_EQ(wide.info.height, 19 + 1 + 6);
  EXPECT_EQ(cellRed(wide, 0, 0), 100);
  EXPECT_EQ(cellRed(wide, 15, 0), 100);
}

TEST(ContactSheet, OfPicturesThatAreThereTwiceThePngIsShown)
{
  const TemporaryFolder folder;
  Manifest manifest = makeGray(folder.path(), 16, 16, 200);
  for (const char* other : { "npy", "ppm" }) // before and behind it in the alphabet
  {
    const Manifest second = makeGray(folder.path(), 16, 16, 90, other);
    manifest.files.push_back(second.files[0]);
  }
  ContactSheetOptions options;
  options.thumbnailWidth = 16;
  writeContactSheet(folder.path(), manifest, "contact.png", options);
  EXPECT_EQ(cellRed(readLayerFile(folder.path("contact.png")), 8, 8), 200);
}

TEST(ContactSheet, SharesOfRanksAreNoPicture)
{
  const TemporaryFolder folder;
  for (const int channels : { 1, 2 })
  {
    LayerSpec spec = specOf(PixelType::UInt8, channels, "alpha");
    spec.meaning = Meaning::Coverage;
    writeImage("npy", folder.path("a.npy"), spec, Rows(PixelType::UInt8, channels, 4, 0, 4), 4, {});
    Manifest manifest;
    manifest.layers.push_back({ spec, "npy" });
    manifest.files.push_back({ "a.npy", 0, "", "alpha", "left", 0 });
    if (channels == 1)
    {
      EXPECT_NO_THROW(writeContactSheet(folder.path(), manifest, "contact.png"));
    }
    else
    {
      EXPECT_THROW(writeContactSheet(folder.path(), manifest, "contact.png"), UsageError);
    }
  }
}

TEST(ContactSheet, Refusals)
{
  const TemporaryFolder folder;
  EXPECT_THROW(writeContactSheet(folder.path(), Manifest{}, "contact.png"), UsageError);
  EXPECT_THROW(writeContactSheet(folder.path(), "contact.png"), InputError);
}
