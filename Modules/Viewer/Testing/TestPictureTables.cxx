// SPDX-License-Identifier: BSD-3-Clause
// A picture of every layer: the text of its pixels, their colours and the legend.
#include "dgtkCameraText.h"
#include "dgtkPictureColors.h"
#include "dgtkPixelText.h"
#include "dgtkTestDataset.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <limits>
#include <string>
#include <vector>

namespace
{
using namespace dgtk;
using test::SmallDataset;

constexpr double notANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double infinite = std::numeric_limits<double>::infinity();

using Pixel = std::vector<double>;

std::string hex(std::uint32_t color)
{
  char text[16];
  std::snprintf(text, sizeof text, "%06x", color & 0xffffff);
  return (color >> 24) == 0xff ? text : std::string("clear");
}

std::string textOf(const PictureLegend& legend, const PictureValues& picture)
{
  static const char* const kinds[] = { "none", "ramp", "swatches", "wheel", "axes" };
  std::string all = kinds[int(legend.kind)];
  const auto range = [](const PictureRange& r)
  { return numberText(r.low, PixelType::Float64) + " to " + numberText(r.high, PixelType::Float64); };
  if (legend.hasRange)
  {
    all += " " + range(legend.range) + " of " + range(legend.found);
    all += legendIsLogarithmic(picture, legend) ? " logarithmic" : "";
  }
  all += legend.unit.empty() ? "" : " [" + legend.unit + "]";
  for (const PictureLegend::Swatch& swatch : legend.swatches)
  {
    all += "; " + swatch.text;
  }
  all += legend.hidden > 0 ? "; and " + std::to_string(legend.hidden) : "";
  return all + (legend.text.empty() ? "" : ": " + legend.text);
}

/// The first two pixels of the first row and all others, which are alike: texts and colours; then the legend, and the
/// colours for a range of 1 to 3.
std::string told(
  const LayerSpec& spec, const std::string& format, const Pixel& first, const Pixel& second, const Pixel& rest)
{
  SmallDataset files;
  files.add("left", spec.name, 0, "", format, spec,
    [&](int x, int y, int c) {
      return (y > 0 || x > 1 ? rest : x == 0 ? first : second)[std::size_t(c)];
    });
  files.finish();
  const DatasetPictures dataset(files.path());
  const PictureLayer& layer = dataset.layers().front();
  const PictureValues picture = readPicture(dataset.file({ "left", 0, layer.label }), layer);
  const PictureColors colors = colorPicture(dataset, picture);
  const PictureColors chosen = colorPicture(dataset, picture, PictureRange{ 1, 3 });
  EXPECT_EQ(colors.pixels.size(), std::size_t(SmallDataset::width * SmallDataset::height));
  std::string all = "\n";
  for (const int x : { 0, 1, 2 })
  {
    all += valueText(dataset, picture, x, 0) + " #" + hex(colors.pixels[std::size_t(x)]) + " #" +
           hex(chosen.pixels[std::size_t(x)]) + "\n";
  }
  EXPECT_EQ(colors.pixels.back(), colors.pixels[2]);
  EXPECT_EQ(valueText(dataset, picture, 2, 0), valueText(dataset, picture, 11, 6));
  EXPECT_EQ(chosen.legend.found, colors.legend.found);
  return all + textOf(colors.legend, picture);
}

struct LayerRow
{
  LayerSpec spec;
  const char* format;
  Pixel first, second, rest;
  const char* told;
};
const LayerRow layerTable[] = {
  { { "depth", PixelType::Float64, 1, "scene units", "camera", "+inf", "", Meaning::Depth }, "npy", { 2 }, { infinite },
    { 4 }, R"(
2 metre #faf5aa #bf4555
inf #28282c #28282c
4 metre #4e1d66 #4e1d66
ramp 2 to 4 of 2 to 4 logarithmic [metre])" },
  { { "distance", PixelType::Float64, 1, "scene units", "", "+inf", "", Meaning::Distance }, "pfm", { 2 }, { infinite },
    { 0.1 }, R"(
2 metre #4e1d66 #bf4555
inf #28282c #28282c
0.1 metre #faf5aa #faf5aa
ramp 0.10000000149011612 to 2 of 0.10000000149011612 to 2 logarithmic [metre])" },
  { { "inversedepth", PixelType::Float64, 1, "1 / scene units", "camera", "0", "", Meaning::InverseDepth }, "npy",
    { 0.5 }, { 0 }, { 0.25 }, R"(
0.5 1 / metre #faf5aa #180f3d
0 1 / metre #28282c #28282c
0.25 1 / metre #4e1d66 #180f3d
ramp 0.25 to 0.5 of 0.25 to 0.5 [1 / metre])" },
  { { "normal", PixelType::Float32, 3, "1", "camera", "nan", "", Meaning::Direction }, "npy", { 0, 0, -1 },
    { notANumber, notANumber, notANumber }, { 1, -0.5, 0.25 }, R"(
(0, 0, -1) #8080ff #8080ff
(nan, nan, nan) #28282c #28282c
(1, -0.5, 0.25) #ffbf60 #ffbf60
axes: red right, green up, blue towards the camera)" },
  { { "uv", PixelType::Float64, 2, "1", "", "nan", "", Meaning::TextureCoordinates }, "npy", { 1.25, -0.25 },
    { notANumber, notANumber }, { 0.5, 0.75 }, R"(
(1.25, -0.25) #40bf40 #40bf40
(nan, nan) #28282c #28282c
(0.5, 0.75) #80bf40 #80bf40
axes: red u, green v, without whole numbers)" },
  { { "position", PixelType::Float64, 3, "scene units", "world", "nan", "", Meaning::Point }, "npy", { 1, 2, 3 },
    { notANumber, notANumber, notANumber }, { 5, 4, 3.5 }, R"(
(1, 2, 3) metre #000000 #000000
(nan, nan, nan) #28282c #28282c
(5, 4, 3.5) metre #ffffff #ffffff
axes [metre]: red x, green y, blue z, over the range of each)" },
  { { "barycentrics", PixelType::Float64, 3, "1", "", "nan", "", Meaning::Weights }, "npy", { 0.25, 0.5, 0.25 },
    { 1, 0, 0 }, { 0.5, 0.25, 0.25 }, R"(
(0.25, 0.5, 0.25) #00ffff #00ffff
(1, 0, 0) #ff0000 #ff0000
(0.5, 0.25, 0.25) #5580ff #5580ff
axes: red x, green y, blue z, over the range of each)" },
  { { "flow_forward", PixelType::Float32, 2, "pixels", "image", "nan", "", Meaning::Displacement }, "npy", { 3, 4 },
    { notANumber, notANumber }, { 0, -2.5 }, R"(
(3, 4) pixels, 5 long #ffe200 #ffe200
(nan, nan) #28282c #28282c
(0, -2.5) pixels, 2.5 long #bf80ff #952aff
wheel 0 to 5 of 0 to 5 [pixels])" },
  { { "sceneflow", PixelType::Float64, 3, "scene units", "camera", "nan", "", Meaning::Displacement }, "npy",
    { 3, 4, 0 }, { 0, 0, 0 }, { 1, 1, 1 }, R"(
(3, 4, 0) metre #ffff00 #ffff00
(0, 0, 0) metre #000000 #000000
(1, 1, 1) metre #5540ff #5540ff
axes [metre]: red x, green y, blue z, over the range of each)" },
  { { "correspondence", PixelType::Float64, 2, "pixels", "image of the other camera", "nan", "", Meaning::Point },
    "npy", { 3.5, 4.25 }, { notANumber, notANumber }, { 1, 8 }, R"(
(3.5, 4.25) pixels #ff0040 #ff0040
(nan, nan) #28282c #28282c
(1, 8) pixels #00ff40 #00ff40
axes [pixels]: red x, green y, over the range of each)" },
  { { "disparity", PixelType::Float64, 1, "pixels", "image", "nan", "", Meaning::Displacement }, "pfm", { -3 },
    { notANumber }, { 2 }, R"(
-3 pixels #4e1d66 #180f3d
nan #28282c #28282c
2 pixels #faf5aa #dc6042
ramp -3 to 2 of -3 to 2 [pixels])" },
  { { "objects", PixelType::UInt32, 1, "id", "", "0", "", Meaning::Id }, "npy", { 2 }, { 0 }, { 70000 }, R"(
2 mill (building) #8dd626 #8dd626
0 background #28282c #28282c
70000 #42bb63 #42bb63
swatches [id]; 70000; 0 background; 2 mill)" },
  { { "objects", PixelType::UInt32, 1, "id", "", "0", "", Meaning::Id }, "png", { 3 }, { 0 }, { 1 }, R"(
3 tree (plant) #f158de #f158de
0 background #28282c #28282c
1 floor (ground) #1547be #1547be
swatches [id]; 1 floor; 0 background; 3 tree)" },
  { { "classes", PixelType::UInt32, 1, "id", "", "0", "", Meaning::Class }, "png", { 2 }, { 0 }, { 9 }, R"(
2 building #8dd626 #8dd626
0 background #28282c #28282c
9 #1683c5 #1683c5
swatches [id]; 9; 0 background; 2 building)" },
  { { "parts", PixelType::UInt32, 1, "id", "", "65535", "", Meaning::Index }, "png", { 2 }, { 65535 }, { 0 }, R"(
2 #f158de #f158de
nothing #28282c #28282c
0 #1547be #1547be
swatches [id]; 0; 2)" },
  { { "triangles", PixelType::UInt32, 1, "id", "", "4294967295", "", Meaning::Index }, "npy", { 2 }, { 4294967295.0 },
    { 0 }, R"(
2 #f158de #f158de
nothing #28282c #28282c
0 #1547be #1547be
swatches [id]; 0; 2)" },
  { { "edges", PixelType::UInt8, 1, "1", "image", "0", "", Meaning::Mask }, "png", { 255 }, { 0 }, { 128 }, R"(
255 #ffffff #ffffff
0 #000000 #000000
128 #808080 #808080
none)" },
  { { "alpha", PixelType::UInt8, 4, "id", "image", "0", "", Meaning::Id }, "png", { 0, 0, 2, 128 }, { 0, 0, 0, 255 },
    { 1, 1, 1, 255 }, R"(
2 mill (building), coverage 128 / 255 #466b13 #466b13
0 background, coverage 255 / 255 #28282c #28282c
65793, coverage 255 / 255 #5fe549 #5fe549
swatches [id]; 65793; 0 background; 2 mill)" },
  { { "flow_forward_class", PixelType::UInt8, 1, "class", "image", "0", "", Meaning::Visibility }, "png", { 2 }, { 0 },
    { 4 }, R"(
2 occluded by another object #8dd626 #8dd626
0 no surface #28282c #28282c
4 outside the image #34ae99 #34ae99
swatches [class]; 4 outside the image; 0 no surface; 2 occluded by another object)" },
  { { "matting_alpha", PixelType::UInt16, 1, "1/65535", "image", "none", "", Meaning::Coverage }, "png", { 65535 },
    { 0 }, { 32768 }, R"(
65535 1/65535 #ffffff #ffffff
0 1/65535 #000000 #000000
32768 1/65535 #808080 #808080
none [1/65535])" },
  { { "matting_trimap", PixelType::UInt8, 1, "class", "image", "none", "", Meaning::Mask }, "png", { 255 }, { 0 },
    { 128 }, R"(
255 #ffffff #ffffff
0 #000000 #000000
128 #808080 #808080
none [class])" },
  { { "color", PixelType::UInt8, 3, "sRGB", "image", "none", "", Meaning::Picture }, "png", { 1, 2, 3 },
    { 255, 0, 128 }, { 0, 0, 0 }, R"(
(1, 2, 3) #010203 #010203
(255, 0, 128) #ff0080 #ff0080
(0, 0, 0) #000000 #000000
none [sRGB])" },
  { { "color", PixelType::Float32, 3, "linear sRGB", "image", "none", "", Meaning::Picture }, "exr", { 0.5, 1, 2 },
    { 0, 0.25, -1 }, { 0, 0, 0 }, R"(
(0.5, 1, 2) #bcffff #bcffff
(0, 0.25, -1) #008900 #008900
(0, 0, 0) #000000 #000000
none [linear sRGB])" },
  { { "matting_foreground", PixelType::UInt16, 3, "sRGB", "image", "0", "", Meaning::Picture }, "png",
    { 65535, 257, 0 }, { 32768, 0, 514 }, { 0, 0, 0 }, R"(
(65535, 257, 0) #ff0100 #ff0100
(32768, 0, 514) #800002 #800002
(0, 0, 0) #000000 #000000
none [sRGB])" },
};

TEST(PictureTables, OfEveryKindOfLayer)
{
  for (const LayerRow& row : layerTable)
  {
    EXPECT_EQ(told(row.spec, row.format, row.first, row.second, row.rest), row.told)
      << row.spec.name << ' ' << row.format;
  }
}

TEST(CameraText, HasTheMatricesInColumns)
{
  SmallDataset files;
  files.add("left", "depth", 0, "", "npy", { "depth", PixelType::Float64, 1, "", "camera", "+inf", "", Meaning::Depth },
    [](int, int, int) { return 2.0; });
  CameraRecord camera = SmallDataset::left(0);
  camera.R.setIdentity();
  files.Cameras = { camera };
  files.finish();
  EXPECT_EQ(cameraText(DatasetPictures(files.path()), "left", 0).toStdString(), R"(left, frame 0
Size: 12 x 7 pixels
Lens: pinhole
Distortion: none
Near, far: 0.1, 100

K (pixels from camera axes)
  11  0.25   5.5
   0    12  3.75
   0     0     1

R (x_camera = R x_world + t)
  1  0  0
  0  1  0
  0  0  1

t
  0.5
   -2
    4
)");
  EXPECT_EQ(cameraText(DatasetPictures(files.path()), "a%2", 7).section('\n', 0, 0).toStdString(), "a%2, frame 7");
}
} // namespace
