// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetPoints.h"

#include "dgtkPixelText.h"
#include "dgtkTestDataset.h"

#include <gtest/gtest.h>

#include <tuple>

namespace
{
using namespace dgtk;
using test::SmallDataset;

/// The direction of a pixel's ray, and what it passes the frame's origin at: a unit before it, 3 aside.
Eigen::Vector3d direction(int x, int y) { return Eigen::Vector3d(x - 5.5, y - 3, 8).normalized(); }
Eigen::Vector3d aside(int x, int y) { return 3 * direction(x, y).unitOrthogonal(); }

/// (1 + s)^2 + 3^2 = 5^2 where s = 3.
TEST(DatasetPoints, DistancesAreFromTheOriginOfTheFrameWhereverARayBegins)
{
  SmallDataset files;
  files.add("left", "rays", 0, "", "npy", { "rays", PixelType::Float64, 6, "", "", "", "" },
    [](int x, int y, int channel)
    {
      const Eigen::Vector3d d = direction(x, y);
      return channel < 3 ? Eigen::Vector3d(d + aside(x, y))[channel] : d[channel - 3];
    });
  CameraRecord camera = SmallDataset::left(0);
  camera.model = "raytable";
  camera.hasK = false;
  camera.files = { { "rays", files.path("left/rays/000000.npy") } };
  const View view = viewOf(camera);
  const double distance = 5;
  for (const auto& [x, y] : { std::pair(0, 0), std::pair(11, 6), std::pair(5, 2) })
  {
    const auto found = pointOf({ "distance", {}, 1, "", "", "", "", Meaning::Distance }, view, x, y, &distance);
    ASSERT_TRUE(found.has_value());
    const Eigen::Vector3d expected = camera.R.transpose() * (4 * direction(x, y) + aside(x, y) - camera.t);
    EXPECT_LT((*found - expected).norm(), 1e-12) << x << ' ' << y;
  }
}

/// Goes two units a frame along x, looking along z; a picture takes a frame, from the top row: by its shutter, or a
/// table of rays.
class RollingDataset : public SmallDataset
{
public:
  explicit RollingDataset(bool table = false)
  {
    CameraRecord camera = left(1);
    camera.R.setIdentity();
    camera.t = Eigen::Vector3d(-2, 0, 0);
    camera.rollingShutter.duration = table ? 0 : 1;
    if (table)
    {
      const Eigen::Matrix3d inverse = camera.K.inverse();
      this->add("left", "rays", 1, "", "npy", { "rays", PixelType::Float64, 4, "", "", "", "" },
        [&](int x, int y, int channel)
        { return channel < 3 ? inverse.row(channel).dot(Eigen::Vector3d(x + 0.5, y + 0.5, 1)) : timeOf(y); });
      camera.model = "raytable";
      camera.hasK = false;
      camera.files = { { "rays", "left/rays/000001.npy" } };
    }
    this->Cameras = { camera };
    this->add("left", "depth", 1, "", "npy", depth(), [](int x, int, int) { return 2.0 + x; });
  }
  static double timeOf(int y) { return (y + 0.5) / height - 0.5; }
  static LayerSpec depth() { return { "depth", PixelType::Float64, 1, "", "camera", "+inf", "", Meaning::Depth }; }
  DatasetPictures pictures(const std::string& lastX = "8") const
  {
    this->finish();
    writeFile(this->path("scene.json"), R"({"version": 1, "cameras": [{"name": "left", "up": [0, -1, 0],
      "eye": {"keys": [[0, [0, 0, 0]], [4, [)" +
                                          lastX + R"(, 0, 0]]]},
      "lookAt": {"keys": [[0, [0, 0, 5]], [4, [)" +
                                          lastX + R"(, 0, 5]]]}}]})");
    return DatasetPictures(this->path());
  }
  static std::optional<Eigen::Vector3d> at(const DatasetPictures& dataset, int x, int y)
  {
    const PictureKey key{ "left", 1, "depth" };
    return worldPoint(dataset, key, readPicture(dataset.file(key), *dataset.layer("depth")), x, y);
  }
  static Eigen::Vector3d expected(int x, int y, double frame)
  {
    return left(1).K.inverse() * Eigen::Vector3d(x + 0.5, y + 0.5, 1) * (2 + x) + Eigen::Vector3d(2 * frame, 0, 0);
  }
};

TEST(DatasetPoints, ARollingShutterSeesARowFromWhereTheCameraIsThen)
{
  for (const bool table : { false, true })
  {
    const RollingDataset files(table);
    const DatasetPictures dataset = files.pictures();
    ASSERT_EQ(pointLayer(dataset, "left", 1), "depth");
    PointCloud cloud;
    addPoints(cloud, dataset, "left", 1, "", 1000);
    ASSERT_EQ(cloud.points.size(), std::size_t(SmallDataset::width * SmallDataset::height));
    for (const auto& [x, y] : { std::pair(0, 0), std::pair(5, 3), std::pair(11, 6) })
    {
      const Eigen::Vector3d expected = RollingDataset::expected(x, y, 1 + RollingDataset::timeOf(y));
      EXPECT_LT((cloud.points[std::size_t(y * SmallDataset::width + x)] - expected).norm(), 1e-12)
        << table << ' ' << x << ' ' << y;
      EXPECT_LT((RollingDataset::at(dataset, x, y).value() - expected).norm(), 1e-12) << table << ' ' << x << ' ' << y;
    }
  }
}

/// Of one that stands still at the frames beside this one, all rows are seen from there.
TEST(DatasetPoints, ARollingShutterThatStandsStillNeedsNoScene)
{
  RollingDataset files;
  const CameraRecord own = files.Cameras[0];
  for (const auto& [name, frame, x] :
    { std::tuple("left", 0, -2), { "left", 3, -2 }, { "left", 4, -9 }, { "other", 0, 7 }, { "other", 2, 7 } })
  {
    files.Cameras.push_back(own);
    files.Cameras.back().name = name;
    files.Cameras.back().frame = frame;
    files.Cameras.back().t.x() = x;
  }
  const auto layer = [&]
  {
    files.finish();
    return pointLayer(DatasetPictures(files.path()), "left", 1);
  };
  EXPECT_EQ(layer(), "depth");
  for (CameraRecord* const beside : { &files.Cameras[1], &files.Cameras[2] })
  {
    const CameraRecord still = *beside;
    beside->t.z() = 1e-6;
    EXPECT_EQ(layer(), "") << still.frame;
    *beside = still;
    beside->R = SmallDataset::left(0).R;
    EXPECT_EQ(layer(), "") << still.frame;
    *beside = still;
  }
  const DatasetPictures other = files.pictures("9");
  ASSERT_EQ(pointLayer(other, "left", 1), "depth");
  for (const int y : { 0, 6 })
  {
    EXPECT_LT((RollingDataset::at(other, 5, y).value() - RollingDataset::expected(5, y, 1)).norm(), 1e-12) << y;
  }
  files.Cameras.resize(2);
  EXPECT_EQ(layer(), "depth") << "the last frame";
  files.Cameras.resize(1);
  EXPECT_EQ(layer(), "") << "the only frame";
}

/// Neither without a scene nor with that of another dataset.
TEST(DatasetPoints, WhereARollingShuttersCameraIsUnknownOnlyPositionsArePoints)
{
  RollingDataset files;
  const DatasetPictures other = files.pictures("9");
  EXPECT_EQ(pointLayer(other, "left", 1), "");
  EXPECT_FALSE(RollingDataset::at(other, 5, 2));
  files.add("left", "position", 1, "", "npy", { "position", PixelType::Float64, 3, "scene units", "world", "nan", "" },
    [](int x, int y, int channel) { return 10.0 * x + y + channel; });
  files.finish();
  std::filesystem::remove(files.path("scene.json"));
  const DatasetPictures alone(files.path());
  EXPECT_EQ(pointLayer(alone, "left", 1), "position");
  EXPECT_FALSE(RollingDataset::at(alone, 5, 2));
  PointCloud cloud;
  addPoints(cloud, alone, "left", 1, "", 1000);
  EXPECT_EQ(cloud.points.at(0), Eigen::Vector3d(0, 1, 2));
}
} // namespace
