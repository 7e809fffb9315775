// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEpipolarLine.h"
#include "dgtkLiveMatch.h"

#include "dgtkFile.h"
#include "dgtkGenerator.h"
#include "dgtkLayerReader.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <array>
#include <cmath>
#include <random>

namespace
{
using namespace dgtk;
using test::sourceFile;

constexpr double lineTolerance = 1e-8; // pixels: products of coordinates of some thousand pixels

View viewAt(const std::shared_ptr<const CameraModel>& model, const Eigen::Vector3d& eye, const Eigen::Vector3d& lookAt)
{
  View view;
  view.model = model;
  view.camera_from_world = lookAtPose(eye, lookAt, { 0, 1, 0 });
  return view;
}

double distance(const Eigen::Vector3d& line, const Eigen::Vector2d& point)
{
  return line.head<2>().dot(point) + line.z();
}

TEST(EpipolarLine, HoldsTheImagesOfAllPointsOfTheRay)
{
  Eigen::Matrix3d K;
  K << 500, 3, 310, 0, 480, 250, 0, 0, 1;
  const auto pinhole = makePinhole(640, 480, K);
  const auto parallel = makeOrthographic(400, 300, 6, 0);
  const std::array<View, 3> views{ viewAt(pinhole, { 3, 2, 7 }, { 0, 0, 0 }),
    viewAt(parallel, { -4, 3, 5 }, { 0, 1, 0 }),
    viewAt(makePinholeFromFov(320, 240, 50, 0), { -2, 1, 6 }, { 1, 0, 0 }) };
  std::mt19937 random(3);
  for (const View& from : views)
  {
    for (const View& to : views)
    {
      if (&from == &to)
      {
        continue;
      }
      for (int i = 0; i < 20; ++i)
      {
        const Eigen::Vector2d pixel(double(random() % 3000) / 10, double(random() % 2000) / 10);
        const auto line = epipolarLine(from, pixel, to);
        ASSERT_TRUE(line.has_value());
        EXPECT_NEAR(line->head<2>().norm(), 1, 1e-12);
        const CameraRay ray = from.model->rayThrough(pixel);
        for (const double t : { 0.5, 2.0, 9.0 })
        {
          const Eigen::Vector3d world = from.camera_from_world.inverse() * (ray.origin + t * ray.direction);
          Eigen::Vector2d image;
          if (to.model->project(to.camera_from_world * world, image))
          {
            EXPECT_LT(std::abs(distance(*line, image)), lineTolerance);
          }
        }
      }
    }
  }
}

/// l' = F x with F = K'^-T [t]x R K^-1 (Hartley and Zisserman, equation 9.1).
TEST(EpipolarLine, IsTheFundamentalMatrixs)
{
  Eigen::Matrix3d K;
  K << 500, 0, 310, 0, 480, 250, 0, 0, 1;
  const View from = viewAt(makePinhole(640, 480, K), { 3, 2, 7 }, { 0, 0, 0 });
  const View to = viewAt(makePinhole(640, 480, K), { 2, 2, 7 }, { 0.3, 0, 0 });
  const Rigid3 pose = to.camera_from_world * from.camera_from_world.inverse();
  Eigen::Matrix3d cross;
  cross << 0, -pose.translation.z(), pose.translation.y(), pose.translation.z(), 0, -pose.translation.x(),
    -pose.translation.y(), pose.translation.x(), 0;
  const Eigen::Matrix3d F = K.inverse().transpose() * cross * pose.rotation * K.inverse();
  const Eigen::Vector2d pixel(200.25, 310.75);
  Eigen::Vector3d expected = F * pixel.homogeneous();
  expected /= expected.head<2>().norm();
  const Eigen::Vector3d line = *epipolarLine(from, pixel, to);
  EXPECT_TRUE(line.isApprox(expected, 1e-9) || line.isApprox(-expected, 1e-9)) << line.transpose();
}

TEST(EpipolarLine, RectifiedPairsHaveTheirRow)
{
  const auto model = makePinholeFromFov(640, 480, 44, 0);
  const View left = viewAt(model, { 0, 1, 5 }, { 0, 1, 0 });
  const View right = viewAt(model, { 0.2, 1, 5 }, { 0.2, 1, 0 });
  const Eigen::Vector3d line = *epipolarLine(left, { 100.5, 77.25 }, right);
  EXPECT_NEAR(line.x(), 0, 1e-12);
  EXPECT_NEAR(-line.z() / line.y(), 77.25, 1e-9);
}

TEST(EpipolarLine, IsNothingWhereTheRayIsAPoint)
{
  const auto pinhole = makePinholeFromFov(640, 480, 44, 0);
  const auto parallel = makeOrthographic(400, 300, 6, 0);
  const View one = viewAt(pinhole, { 3, 2, 7 }, { 0, 0, 0 });
  const View turned = viewAt(pinhole, { 3, 2, 7 }, { 0, 1, 0 });
  EXPECT_FALSE(epipolarLine(one, { 10, 20 }, turned).has_value()) << "one centre";
  const View before = viewAt(pinhole, { 0, 0, 9 }, { 0, 0, 0 });
  const View behind = viewAt(pinhole, { 0, 0, 5 }, { 0, 0, 0 });
  EXPECT_FALSE(epipolarLine(before, { 320, 240 }, behind).has_value()) << "the epipole";
  EXPECT_TRUE(epipolarLine(before, { 321, 240 }, behind).has_value());
  const View along = viewAt(parallel, { 0, 0, 9 }, { 0, 0, 0 });
  const View same = viewAt(parallel, { 1, 0, 9 }, { 1, 0, 0 });
  EXPECT_FALSE(epipolarLine(along, { 10, 20 }, same).has_value()) << "parallel views along one direction";
  EXPECT_TRUE(epipolarLine(along, { 10, 20 }, before).has_value()) << "a parallel view's ray is a line for a pinhole";
  EXPECT_FALSE(epipolarLine(before, { 320, 240 }, along).has_value()) << "and the axis of a pinhole is none for it";
}

TEST(ClippedLine, EndsAtTheBorder)
{
  const auto part = clippedLine({ 0, 1, -30 }, 100, 60);
  ASSERT_TRUE(part.has_value());
  EXPECT_EQ(std::abs(part->begin.x() - part->end.x()), 100);
  EXPECT_EQ(part->begin.y(), 30);
  const double r = std::sqrt(0.5);
  const auto diagonal = clippedLine({ r, -r, 0 }, 100, 60);
  ASSERT_TRUE(diagonal.has_value());
  EXPECT_NEAR((diagonal->begin - diagonal->end).norm(), 60 * std::sqrt(2), 1e-9);
  EXPECT_FALSE(clippedLine({ 0, 1, -70 }, 100, 60).has_value());
}

/// A file of correspondences of a pair as a run makes it.
struct Rendered
{
  Rendered(const std::string& scene, const std::string& pair, const std::string& stem, int width, int height)
  {
    const test::TemporaryFolder folder;
    const int frame = std::stoi(stem.substr(stem.size() - 6));
    GeneratorRequest request;
    request.scene = scene;
    request.folder = folder.path("out");
    request.layers = { "correspondence" };
    request.options = { { "pairs", pair }, { "threads", "1" }, { "visibility", "ray" } };
    request.cameras = { pair.substr(0, pair.find(':')) };
    request.frames = FrameRange{ frame, frame, 1 };
    request.width = width;
    request.height = height;
    generate(request);
    this->places = readLayerFile(folder.path("out/" + stem + ".npy"));
    this->classes = readLayerFile(folder.path("out/" + stem + ".png"));
  }
  ImageData places;
  ImageData classes;
};

TEST(LiveMatch, IsTheDatasetsAtEveryPixel)
{
  const std::string file = sourceFile("Data/Scenes/dataset_stereo.json");
  const Rendered stored(file, "left:right", "left/correspondence_right/000000", 80, 60);
  const SceneDescription scene = readScene(file);
  ModelLibrary models;
  models.load(scene);
  const LiveScene live(scene, models);
  const auto camera = [&](const char* name)
  {
    for (const CameraDescription& one : scene.cameras)
    {
      if (one.name == name)
      {
        return MatchView{ cameraView(one, 0, 80, 60), 0 };
      }
    }
    throw std::runtime_error(name);
  };
  const MatchView left = camera("left");
  const MatchView right = camera("right");
  std::array<int, 6> seen{};
  for (int row = 0; row < 60; ++row)
  {
    for (int column = 0; column < 80; ++column)
    {
      const LiveMatch match = liveMatch(live, left, { column + 0.5, row + 0.5 }, right);
      const int kind = stored.classes.pixels.row<std::uint8_t>(row)[column];
      ASSERT_EQ(int(match.to.visibility), kind) << column << ' ' << row;
      ++seen[std::size_t(kind)];
      const double* place = stored.places.pixels.row<double>(row) + 2 * column;
      EXPECT_EQ(match.hit.object == 0, kind == 0);
      EXPECT_EQ(match.occluder.empty(), kind != 2 && kind != 3);
      if (kind != 0)
      {
        EXPECT_EQ(match.to.pixel.x(), place[0]);
        EXPECT_EQ(match.to.pixel.y(), place[1]);
        ASSERT_TRUE(match.line.has_value());
        EXPECT_LT(match.lineDistance, lineTolerance);
        ASSERT_NEAR(match.depthTo, match.depthFrom, 1e-12) << "of a rectified pair";
      }
    }
  }
  EXPECT_GT(seen[1], 1000);
  EXPECT_GT(seen[2] + seen[3], 10);
  EXPECT_GT(seen[4], 10);
  EXPECT_EQ(live.objectNames(), Stage::load(scene)->objectNames());
}

TEST(LiveMatch, APointMovesWithItsObject)
{
  const test::TemporaryFolder folder;
  writeFile(folder.path("quad.obj"), "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n");
  writeFile(folder.path("moving.json"), R"({ "objects": [{ "name": "quad", "model": "quad.obj",
    "position": { "keys": [[0, [0.25, 0, 0]], [1, [0.5, -0.25, -1]]] } }],
    "cameras": [{ "name": "c", "eye": [0, 0, 5], "lookAt": [0, 0, 0] }] })");
  const SceneDescription scene = readScene(folder.path("moving.json"));
  ModelLibrary models;
  models.load(scene);
  const LiveScene live(scene, models);
  const MatchView from{ cameraView(scene.cameras[0], 0, 40, 40), 0 };
  const MatchView to{ cameraView(scene.cameras[0], 1, 40, 40), 1 };
  const LiveMatch match = liveMatch(live, from, { 20, 20 }, to); // along the axis
  EXPECT_LT(match.worldFrom.norm(), 1e-12);
  EXPECT_LT((match.worldTo - Eigen::Vector3d(0.25, -0.25, -1)).norm(), 1e-12);
  EXPECT_NEAR(match.depthFrom, 5, 1e-12);
  EXPECT_NEAR(match.depthTo, 6, 1e-12);
}

TEST(LiveMatch, OfARollingShutterIsTheDatasets)
{
  const std::string file = sourceFile("Data/Scenes/rolling_shutter.json");
  const Rendered stored(file, "train:train+1", "train/correspondence_train+1/000002", 60, 40);
  const SceneDescription scene = readScene(file);
  ModelLibrary models;
  models.load(scene);
  const LiveScene live(scene, models);
  const MatchView from{ cameraView(scene.cameras[0], 2, 60, 40), 2 };
  const MatchView to{ cameraView(scene.cameras[0], 3, 60, 40), 3 };
  const auto state = Stage::load(scene)->at(2);
  int hidden = 0;
  bool laterPart = false;
  for (int row = 1; row < 40; row += 3)
  {
    for (int column = 0; column < 60; column += 2)
    {
      const LiveMatch match = liveMatch(live, from, { column + 0.5, row + 0.5 }, to);
      const int kind = stored.classes.pixels.row<std::uint8_t>(row)[column];
      ASSERT_EQ(int(match.to.visibility), kind) << column << ' ' << row;
      EXPECT_EQ(match.occluder.empty(), kind != 2 && kind != 3);
      EXPECT_FALSE(match.line.has_value());
      hidden += kind == 2 || kind == 3 ? 1 : 0;
      if (kind != 0)
      {
        EXPECT_EQ(match.to.pixel.x(), stored.places.pixels.row<double>(row)[2 * column]);
        EXPECT_EQ(match.to.pixel.y(), stored.places.pixels.row<double>(row)[2 * column + 1]);
        const Part& part = state->instances[match.hit.object - 1].model->parts.at(match.part);
        EXPECT_LT(match.triangle, part.triangles);
        EXPECT_EQ(match.triangle + part.firstTriangle, match.hit.triangle);
        laterPart = laterPart || match.part > 0;
      }
    }
  }
  EXPECT_GT(hidden, 3);
  EXPECT_TRUE(laterPart);
}
} // namespace
