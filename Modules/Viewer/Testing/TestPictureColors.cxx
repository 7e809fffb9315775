// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPictureColors.h"

#include "dgtkCryptomatte.h"
#include "dgtkDatasetPoints.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkPixelText.h"
#include "dgtkTestDataset.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{
using namespace dgtk;
using test::SmallDataset;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double tolerance = 1e-12; // scene units, of points some units away

const LayerSpec depthSpec{ "depth", PixelType::Float64, 1, "scene units", "camera", "+inf", "", Meaning::Depth };

std::uint32_t wordOf(Rgb c) { return 0xff000000u | std::uint32_t(c[0]) << 16 | std::uint32_t(c[1]) << 8 | c[2]; }

/// A dataset of one layer, opened.
struct OneLayer
{
  OneLayer(const LayerSpec& spec, const std::string& format, const std::function<double(int, int, int)>& value)
  {
    this->Files.add("left", spec.name, 0, "", format, spec, value);
    this->Files.finish();
    this->Dataset = std::make_unique<DatasetPictures>(this->Files.path());
    const PictureLayer& layer = this->Dataset->layers().front();
    this->Picture = readPicture(this->Dataset->file({ "left", 0, layer.label }), layer);
  }
  std::string text(int x, int y) const { return valueText(*this->Dataset, this->Picture, x, y); }
  PictureColors colors(const std::optional<PictureRange>& range = {}) const
  {
    return colorPicture(*this->Dataset, this->Picture, range);
  }
  SmallDataset Files;
  std::unique_ptr<DatasetPictures> Dataset;
  PictureValues Picture;
};

TEST(PictureColors, DepthIsARampFromNearToFar)
{
  const OneLayer layer(depthSpec, "npy", [](int x, int y, int) { return y > 0 ? inf : std::pow(2.0, x); });
  const PictureColors own = layer.colors();
  EXPECT_EQ(own.legend.kind, PictureLegend::Kind::Ramp);
  EXPECT_EQ(own.legend.range, (PictureRange{ 1, 2048 }));
  EXPECT_EQ(own.pixels[0], wordOf(rampColor(1)));
  EXPECT_EQ(own.pixels[11], wordOf(rampColor(0.15)));
  EXPECT_EQ(own.pixels[12], wordOf(nothingColor));
  EXPECT_EQ(legendColor(layer.Picture, own.legend, 0), rampColor(1));
  EXPECT_EQ(wordOf(legendColor(layer.Picture, own.legend, 4.0 / 11)), own.pixels[4]);
  const PictureColors chosen = layer.colors(PictureRange{ 4, 64 });
  EXPECT_EQ(chosen.pixels[0], chosen.pixels[2]) << "nearer than the range";
  EXPECT_EQ(chosen.pixels[2], wordOf(rampColor(1)));
  EXPECT_NE(chosen.pixels[3], chosen.pixels[2]);
  EXPECT_EQ(chosen.legend.found, own.legend.range);
}

TEST(PictureColors, IdsHaveNames)
{
  const OneLayer layer({ "objects", PixelType::UInt32, 1, "id", "", "0", "" }, "ppm",
    [](int x, int, int) { return x < 7    ? 2
                                 : x < 10 ? 0
                                          : 70000; });
  const PictureColors colors = layer.colors();
  EXPECT_EQ(colors.pixels[0], wordOf(idColor(2)));
  EXPECT_EQ(colors.pixels[11], wordOf(idColor(70000)));
  ASSERT_EQ(colors.legend.swatches.size(), 3u);
  EXPECT_EQ(colors.legend.swatches[0].text, "2 mill");
  EXPECT_EQ(colors.legend.swatches[1].text, "0 background");
  EXPECT_EQ(colors.legend.swatches[2].text, "70000");
  EXPECT_EQ(layer.text(0, 0), "2 mill (building)");
  EXPECT_EQ(layer.text(8, 0), "0 background");
  EXPECT_EQ(layer.text(11, 0), "70000");
  EXPECT_EQ(layer.text(12, 0), "");
}

TEST(PictureColors, FlowIsAWheel)
{
  const OneLayer layer({ "flow_forward", PixelType::Float32, 2, "pixels", "image", "nan", "" }, "flo",
    [](int x, int y, int c) {
      return y > 0 ? nan : x == 0 ? (c == 0 ? 3.0 : 4.0) : x == 1 && c == 0 ? -5.0 : 0.0;
    });
  const PictureColors colors = layer.colors(PictureRange{ 0, 5 });
  EXPECT_EQ(colors.pixels[0], wordOf(wheelColor(0.6, 0.8)));
  EXPECT_EQ(colors.pixels[1], 0xff00ffffu) << "left is cyan";
  EXPECT_EQ(colors.pixels[2], 0xffffffffu) << "no motion is white";
  EXPECT_EQ(colors.pixels[12], wordOf(nothingColor));
  EXPECT_EQ(wheelColor(1, 0), (Rgb{ 255, 0, 0 }));
  EXPECT_EQ(layer.text(0, 0), "(3, 4) pixels, 5 long");
  EXPECT_EQ(layer.text(0, 1), "(nan, nan)");
}

TEST(PictureColors, ClassesOfVisibilityAreWords)
{
  const OneLayer layer({ "flow_forward_class", PixelType::UInt8, 1, "class", "image", "0", "" }, "png",
    [](int x, int, int) { return x % 6; });
  EXPECT_EQ(layer.text(1, 0), "1 visible");
  EXPECT_EQ(layer.text(3, 0), "3 occluded by its own object");
  EXPECT_EQ(layer.text(5, 0), "5 behind the camera");
}

TEST(PictureColors, CoverageNamesItsObjects)
{
  SmallDataset files;
  const LayerSpec spec{ "coverage", PixelType::Float32, 4, "1", "image", "0", "", Meaning::Coverage };
  const std::string name = files.place("left", "coverage", 0, "", "exr");
  CryptomatteWriter writer(
    files.path(name), spec, SmallDataset::width, SmallDataset::height, { "floor", "mill", "tree" }, 6);
  const std::uint32_t pixels = SmallDataset::width * SmallDataset::height;
  writer.add({ { 3, 0.75f }, { 2, 0.25f } }, 1);
  writer.add({ { 0, 1.0f } }, pixels - 1);
  const FileRecord record = writer.finish();
  files.list({ name, record.bytes, record.sha256, "coverage", "left", 0 }, spec, "exr");
  files.finish();
  const DatasetPictures dataset(files.path());
  const PictureValues picture = readPicture(dataset.file({ "left", 0, "coverage" }), *dataset.layer("coverage"));
  EXPECT_EQ(valueText(dataset, picture, 0, 0), "3 tree (plant): 0.75, 2 mill (building): 0.25");
  EXPECT_EQ(valueText(dataset, picture, 1, 0), "0 background: 1");
  const PictureColors colors = colorPicture(dataset, picture);
  const Rgb tree = idColor(3);
  const Rgb mill = idColor(2);
  EXPECT_NEAR(double(colors.pixels[0] >> 16 & 255), 0.75 * tree[0] + 0.25 * mill[0], 1);
}

TEST(PixelText, NumbersAreTheShortestThatReadBack)
{
  EXPECT_EQ(numberText(0.1, PixelType::Float64), "0.1");
  EXPECT_EQ(numberText(double(0.1f), PixelType::Float32), "0.1");
  EXPECT_EQ(numberText(double(0.1f), PixelType::Float64), "0.10000000149011612");
  EXPECT_EQ(numberText(4294967295.0, PixelType::UInt32), "4294967295");
  EXPECT_EQ(numberText(-inf, PixelType::Float32), "-inf");
  const OneLayer layer(depthSpec, "npy", [](int x, int, int) { return x == 0 ? inf : 1.0 / 3; });
  EXPECT_EQ(layer.text(0, 0), "inf");
  EXPECT_EQ(layer.text(1, 0), "0.3333333333333333 metre");
}

/// R^T (K^-1 p d - t), written out here.
Eigen::Vector3d expected(const CameraRecord& camera, int x, int y, double z)
{
  const Eigen::Vector3d p(x + 0.5, y + 0.5, 1);
  const Eigen::Vector3d q = camera.K.inverse() * p;
  const bool pinhole = camera.model == "pinhole";
  const Eigen::Vector3d inCamera = pinhole ? Eigen::Vector3d(q * z) : Eigen::Vector3d(q.x(), q.y(), z);
  return camera.R.transpose() * (inCamera - camera.t);
}

TEST(DatasetPoints, PixelsGoWhereTheCalibrationSays)
{
  for (const CameraRecord& camera : { SmallDataset::left(1), SmallDataset::right(0) })
  {
    const View view = viewOf(camera);
    for (const auto& [x, y] : { std::pair(0, 0), std::pair(11, 6), std::pair(5, 2) })
    {
      const double z = 3.5 + x;
      const Eigen::Vector3d point = expected(camera, x, y, z);
      const double distance = (camera.R * point + camera.t).norm();
      const double inverse = 1 / z;
      EXPECT_LT((*pointOf(depthSpec, view, x, y, &z) - point).norm(), tolerance);
      EXPECT_LT(
        (*pointOf({ "distance", {}, 1, "", "", "", "", Meaning::Distance }, view, x, y, &distance) - point).norm(),
        tolerance);
      EXPECT_LT(
        (*pointOf({ "inversedepth", {}, 1, "", "", "", "", Meaning::InverseDepth }, view, x, y, &inverse) - point)
          .norm(),
        tolerance);
      EXPECT_EQ(*pointOf({ "position", {}, 3, "", "world", "", "", Meaning::Point }, view, x, y, point.data()), point);
    }
    EXPECT_FALSE(pointOf(depthSpec, view, 0, 0, &inf));
    const double none = 0;
    EXPECT_FALSE(pointOf({ "inversedepth", {}, 1, "", "", "", "", Meaning::InverseDepth }, view, 0, 0, &none));
    EXPECT_FALSE(pointOf({ "uv", {}, 2, "", "", "", "", Meaning::TextureCoordinates }, view, 0, 0, &none));
  }
}

TEST(DatasetPoints, ACameraThatCannotBeIsRefusedWherePointsAreMade)
{
  SmallDataset files;
  files.add("left", "depth", 0, "", "npy", depthSpec, [](int, int, int) { return 2.0; });
  files.finish();
  CameraRecord wrong = SmallDataset::left(0);
  wrong.K.setZero();
  writeFile(files.path("cameras.json"), camerasText({ wrong }));
  const DatasetPictures dataset(files.path());
  EXPECT_EQ(pointLayer(dataset, "left", 0), "depth") << "is asked for by the window itself";
  PointCloud cloud;
  EXPECT_THROW(addPoints(cloud, dataset, "left", 0, "", 100), UsageError);
}

TEST(DatasetPoints, CloudsHoldEverySurfaceWithItsColour)
{
  SmallDataset files;
  files.add("left", "depth", 0, "", "npy", depthSpec, [](int x, int y, int) { return x == 3 ? inf : 2.0 + y; });
  files.add("left", "color", 0, "", "png", { "color", PixelType::UInt8, 3, "sRGB", "", "", "" },
    [](int x, int y, int c) { return 10 * x + y + 100 * (c == 2); });
  files.finish();
  const DatasetPictures dataset(files.path());
  PointCloud cloud;
  addPoints(cloud, dataset, "left", 0, "color", 1000);
  ASSERT_EQ(cloud.points.size(), std::size_t((SmallDataset::width - 1) * SmallDataset::height));
  const std::size_t at = 2 * (SmallDataset::width - 1) + 4; // x 5, y 2: x 3 is left out
  EXPECT_LT((cloud.points[at] - expected(SmallDataset::left(0), 5, 2, 4)).norm(), tolerance);
  EXPECT_EQ(cloud.colors[at], (std::array<std::uint8_t, 3>{ 52, 52, 152 }));
  PointCloud few;
  addPoints(few, dataset, "left", 0, "", 20);
  EXPECT_LE(few.points.size(), 20u);
  EXPECT_GT(few.points.size(), 5u);
  CameraRecord lens = SmallDataset::left(0);
  lens.model = "of a program";
  EXPECT_THROW(viewOf(lens), InputError);
  const PictureValues picture = readPicture(dataset.file({ "left", 0, "depth" }), *dataset.layer("depth"));
  EXPECT_LT((*worldPoint(dataset, { "left", 0, "depth" }, picture, 5, 2) - cloud.points[at]).norm(), tolerance);
  EXPECT_FALSE(worldPoint(dataset, { "left", 0, "depth" }, picture, 3, 2));
  EXPECT_FALSE(worldPoint(dataset, { "left", 7, "depth" }, picture, 5, 2)) << "no such camera";
}

TEST(DatasetPoints, LensesSeeBehindThemselves)
{
  CameraRecord record = SmallDataset::left(0);
  record.model = "fisheye";
  record.K << 2, 0, 8, 0, 2, 8, 0, 0, 1; // two pixels a radian
  record.numbers["distortion"] = { 0, 0, 0, 0 };
  const View view = viewOf(record);
  LayerSpec spec{ "depth", PixelType::Float64, 1, "", "camera", "+inf", "", Meaning::Depth };
  const Eigen::Vector3d direction(std::sin(2.25), 0, std::cos(2.25)); // 4.5 pixels from the middle
  const auto expectPoint = [&](double value)
  {
    record.K(1, 2) = 7.5;
    const auto found = pointOf(spec, viewOf(record), 12, 7, &value);
    ASSERT_TRUE(found);
    EXPECT_LT((*found - view.camera_from_world.inverse() * Eigen::Vector3d(3 * direction)).norm(), tolerance);
  };
  expectPoint(3 * direction.z()); // below 0
  spec.meaning = Meaning::Distance;
  expectPoint(3);
  const double one = 1;
  EXPECT_FALSE(pointOf(spec, view, 0, 0, &one)) << "outside of the picture";
}

TEST(DatasetPoints, PositionsNeedNoLens)
{
  SmallDataset files;
  for (CameraRecord& camera : files.Cameras)
  {
    camera.model = "of a program";
  }
  files.add("left", "depth", 0, "", "npy", depthSpec, [](int, int, int) { return 2.0; });
  files.add("left", "position", 0, "", "npy", { "position", PixelType::Float64, 3, "scene units", "world", "nan", "" },
    [](int x, int y, int c) {
      return x == 0 ? nan : c == 0 ? x : c == 1 ? y : 5.0;
    });
  files.finish();
  const DatasetPictures dataset(files.path());
  EXPECT_EQ(pointLayer(dataset, "left", 0), "position");
  const PictureValues picture = readPicture(dataset.file({ "left", 0, "position" }), *dataset.layer("position"));
  EXPECT_EQ(worldPoint(dataset, { "left", 0, "position" }, picture, 5, 2), Eigen::Vector3d(5, 2, 5));
  EXPECT_FALSE(worldPoint(dataset, { "left", 0, "position" }, picture, 0, 2));
  PointCloud cloud;
  addPoints(cloud, dataset, "left", 0, "", 1000);
  ASSERT_EQ(cloud.points.size(), std::size_t((SmallDataset::width - 1) * SmallDataset::height));
  EXPECT_EQ(cloud.points[0], Eigen::Vector3d(1, 0, 5));
}
} // namespace
