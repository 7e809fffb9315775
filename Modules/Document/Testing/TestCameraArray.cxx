// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCameraArray.h"

#include "dgtkCameraModel.h"
#include "dgtkError.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace
{
using namespace dgtk;

using V = Eigen::Vector3d;
constexpr double arrayTolerance = 1e-12; // scene units

CameraArrayOptions optionsOf(CameraArrayKind kind)
{
  CameraArrayOptions options;
  options.kind = kind;
  options.first.name = "c";
  options.first.eye = Eigen::Vector3d(1, 3, 8);
  options.first.lookAt = Eigen::Vector3d(1, 1, 0);
  return options;
}

std::string refusalOf(const CameraArrayOptions& options)
{
  return test::thrownBy<UsageError>([&] { cameraArray(options); });
}

void expectSound(const std::vector<CameraDescription>& cameras)
{
  SceneDescription scene;
  scene.cameras = cameras;
  EXPECT_NO_THROW(validate(scene)); // names, poses
}

TEST(CameraArray, RingKeepsDistanceAndHeight)
{
  const auto cameras = cameraArray(optionsOf(CameraArrayKind::Ring));
  ASSERT_EQ(cameras.size(), 8u);
  expectSound(cameras);
  EXPECT_TRUE(cameras[0].eye.value.isApprox(Eigen::Vector3d(1, 3, 8), arrayTolerance));
  EXPECT_TRUE(cameras[2].eye.value.isApprox(Eigen::Vector3d(9, 3, 0), arrayTolerance)) << "a quarter turn";
  EXPECT_TRUE(cameras[4].eye.value.isApprox(Eigen::Vector3d(1, 3, -8), arrayTolerance));
}

TEST(CameraArray, HemisphereCoversEqualAreas)
{
  CameraArrayOptions options = optionsOf(CameraArrayKind::Hemisphere);
  options.count = 400;
  const auto cameras = cameraArray(options);
  expectSound(cameras);
  const double radius = std::sqrt(68.0);
  Eigen::Vector3d mean(0, 0, 0);
  ASSERT_EQ(cameras.size(), 400u);
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    const Eigen::Vector3d direction = (cameras[i].eye.value - cameras[i].lookAt.value) / radius;
    EXPECT_NEAR(direction.norm(), 1, arrayTolerance);
    EXPECT_NEAR(direction.y(), (i + 0.5) / 400, arrayTolerance) << i;
    mean += direction / 400;
  }
  // The centroid of a hemisphere's surface is at half its radius.
  EXPECT_NEAR(mean.y(), 0.5, 1e-4);
  EXPECT_LT(std::hypot(mean.x(), mean.z()), 0.01);
}

TEST(CameraArray, StereoPairsAreRectified)
{
  CameraArrayOptions options = optionsOf(CameraArrayKind::Stereo);
  options.spacing = 0.25;
  const auto cameras = cameraArray(options);
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_EQ(cameras[0].name, "c-left");
  const Rigid3 left = lookAtPose(cameras[0].eye.value, cameras[0].lookAt.value, cameras[0].up.value);
  const Rigid3 right = lookAtPose(cameras[1].eye.value, cameras[1].lookAt.value, cameras[1].up.value);
  EXPECT_TRUE(left.rotation.isApprox(right.rotation, arrayTolerance));
  EXPECT_TRUE((left * cameras[1].eye.value - Eigen::Vector3d(0.25, 0, 0)).norm() < arrayTolerance);
}

TEST(CameraArray, GridsAreRowsFromTheTopLeft)
{
  CameraArrayOptions options = optionsOf(CameraArrayKind::Grid);
  options.columns = 3;
  options.rows = 2;
  options.spacing = 2;
  const auto cameras = cameraArray(options);
  ASSERT_EQ(cameras.size(), 6u);
  expectSound(cameras);
  const Rigid3 middle = lookAtPose({ 1, 3, 8 }, { 1, 1, 0 }, { 0, 1, 0 });
  EXPECT_TRUE((middle * cameras[0].eye.value - Eigen::Vector3d(-2, -1, 0)).norm() < arrayTolerance);
  EXPECT_TRUE((middle * cameras[5].eye.value - Eigen::Vector3d(2, 1, 0)).norm() < arrayTolerance);
}

TEST(CameraArray, EveryRefusalAndEveryLimit)
{
  using Kind = CameraArrayKind;
  const char* const number = "number of cameras: expected 1 to 10000";
  const char* const grid = "columns and rows: expected 1 to 10000 cameras in all";
  const char* const far = "spacing: expected a number above 0";
  const char* const way = "path: expected at least two different points";
  const V a(0, 0, 1);
  const V b(1, 0, 1);
  const V o(0, 0, 0);
  const double none = std::nan("");
  struct Row
  {
    Kind kind;
    int count, columns, rows;
    double spacing;
    CameraPath path;
    const char* message;
  };
  // What a kind does not have may be anything.
  const std::vector<Row> table{
    { Kind::Ring, 0, 3, 3, 1, {}, number },
    { Kind::Ring, 1, 0, 0, 0, {}, "" },
    { Kind::Ring, 10000, 3, 3, none, {}, "" },
    { Kind::Ring, 10001, 3, 3, 1, {}, number },
    { Kind::Hemisphere, 0, 3, 3, 1, {}, number },
    { Kind::Hemisphere, 8, 0, 0, -1, {}, "" },
    { Kind::Grid, 0, 100, 100, 1, {}, "" },
    { Kind::Grid, 8, 1, 3, 1, {}, "" },
    { Kind::Grid, 8, 3, 1, 1, {}, "" },
    { Kind::Grid, 8, 0, 3, 1, {}, grid },
    { Kind::Grid, 8, 3, 0, 1, {}, grid },
    { Kind::Grid, 8, 101, 100, 1, {}, grid },
    { Kind::Grid, 8, 3, 3, 0, {}, far },
    { Kind::Stereo, 0, 0, 0, 1e-9, {}, "" },
    { Kind::Stereo, 8, 3, 3, 0, {}, far },
    { Kind::Stereo, 8, 3, 3, none, {}, far },
    { Kind::Path, 8, 0, 0, 0, {}, way },
    { Kind::Path, 8, 3, 3, 1, { { a }, { o } }, way },
    { Kind::Path, 8, 3, 3, 1, { { a, b }, { o } }, way },
    { Kind::Path, 8, 3, 3, 1, { { a, b }, { o, o } }, "" },
    { Kind::Path, 0, 3, 3, 1, { { a, b }, { o, o } }, number },
  };
  for (std::size_t i = 0; i < table.size(); ++i)
  {
    const Row& row = table[i];
    CameraArrayOptions options = optionsOf(row.kind);
    options.count = row.count;
    options.columns = row.columns;
    options.rows = row.rows;
    options.spacing = row.spacing;
    options.path = row.path;
    EXPECT_EQ(refusalOf(options), row.message) << "row " << i;
  }
  CameraArrayOptions options = optionsOf(Kind::Grid);
  options.first.lookAt = options.first.eye;
  EXPECT_NE(refusalOf(options), "") << "there is no pose";
}

TEST(CameraArray, EveryKindByNumbers)
{
  CameraArrayOptions options;
  options.first.name = "c";
  options.first.eye = V(1, 5, 3);
  options.first.lookAt = V(1, 2, -1);
  options.first.up = V(0, 2, 0);
  options.first.near = 0.5;
  options.first.far = 70;
  options.count = 4;
  options.columns = 2;
  options.rows = 3;
  options.spacing = 0.5;
  const auto expectArray = [&](CameraArrayKind kind, const std::vector<std::string>& names, const std::vector<V>& eyes,
                             const std::vector<V>& targets)
  {
    options.kind = kind;
    const std::vector<CameraDescription> cameras = cameraArray(options);
    ASSERT_EQ(cameras.size(), eyes.size());
    for (std::size_t i = 0; i < cameras.size(); ++i)
    {
      EXPECT_EQ(cameras[i].name, names[i]);
      EXPECT_LT((cameras[i].eye.value - eyes[i]).norm(), arrayTolerance) << i;
      EXPECT_LT((cameras[i].lookAt.value - targets[i]).norm(), arrayTolerance) << i;
      EXPECT_EQ(cameras[i].up.value, V(0, 2, 0));
      EXPECT_EQ(cameras[i].near, 0.5);
      EXPECT_EQ(cameras[i].far, 70);
    }
  };
  const V middle(1, 2, -1);
  expectArray(CameraArrayKind::Ring, { "c-1", "c-2", "c-3", "c-4" },
    { { 1, 5, 3 }, { 5, 5, -1 }, { 1, 5, -5 }, { -3, 5, -1 } }, { middle, middle, middle, middle });
  std::vector<V> spiral;
  for (int i = 0; i < 4; ++i)
  {
    const double high = (i + 0.5) / 4;
    const double angle = i * M_PI * (3 - std::sqrt(5.0));
    spiral.push_back(middle + 5 * V(std::sqrt(1 - high * high) * std::cos(angle), high,
                                    -std::sqrt(1 - high * high) * std::sin(angle)));
  }
  expectArray(CameraArrayKind::Hemisphere, { "c-1", "c-2", "c-3", "c-4" }, spiral, { middle, middle, middle, middle });
  // Down in the image is (0, -4, 3) / 5.
  std::vector<V> eyes;
  std::vector<V> targets;
  for (const double row : { -0.5, 0.0, 0.5 })
  {
    for (const double column : { -0.25, 0.25 })
    {
      eyes.push_back(V(1, 5, 3) + V(column, -0.8 * row, 0.6 * row));
      targets.push_back(middle + V(column, -0.8 * row, 0.6 * row));
    }
  }
  expectArray(CameraArrayKind::Grid, { "c-1", "c-2", "c-3", "c-4", "c-5", "c-6" }, eyes, targets);
  expectArray(CameraArrayKind::Stereo, { "c-left", "c-right" }, { { 0.75, 5, 3 }, { 1.25, 5, 3 } },
    { { 0.75, 2, -1 }, { 1.25, 2, -1 } });
  options.path = { { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 0, 0 }, { 1, 3, 0 } },
    { { 0, 0, 9 }, { 1, 0, 9 }, { 2, 0, 9 }, { 5, 3, 9 } } };
  options.count = 5;
  expectArray(CameraArrayKind::Path, { "c-1", "c-2", "c-3", "c-4", "c-5" },
    { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 1, 2, 0 }, { 1, 3, 0 } },
    { { 0, 0, 9 }, { 1, 0, 9 }, { 3, 1, 9 }, { 4, 2, 9 }, { 5, 3, 9 } });
  options.count = 1;
  expectArray(CameraArrayKind::Path, { "c-1" }, { { 0, 0, 0 } }, { { 0, 0, 9 } });

  CameraDescription posed;
  posed.posed = true;
  posed.position.keys = { { 2, V(1, 0, 0) }, { 4, V(3, 0, 0) } };
  posed.orientation.keys = { { 3, Quaternion{ 0, 0, 1, 0 } } };
  const CameraPath path = keyFramePath(posed);
  EXPECT_EQ(path.eyes, (std::vector<V>{ { 1, 0, 0 }, { 2, 0, 0 }, { 3, 0, 0 } }));
  EXPECT_EQ(path.targets, (std::vector<V>{ { 1, 0, -1 }, { 2, 0, -1 }, { 3, 0, -1 } }));
}

TEST(CameraArray, PathIsWalkedEvenly)
{
  CameraArrayOptions options = optionsOf(CameraArrayKind::Path);
  options.count = 5;
  options.path.eyes = { { 0, 0, 9 }, { 3, 0, 9 }, { 3, 1, 9 } };
  options.path.targets = { { 0, 0, 0 }, { 3, 0, 0 }, { 3, 0, 0 } };
  const auto cameras = cameraArray(options);
  ASSERT_EQ(cameras.size(), 5u);
  expectSound(cameras);
  const Eigen::Vector3d expected[5] = { { 0, 0, 9 }, { 1, 0, 9 }, { 2, 0, 9 }, { 3, 0, 9 }, { 3, 1, 9 } };
  for (std::size_t i = 0; i < 5; ++i)
  {
    EXPECT_TRUE(cameras[i].eye.value.isApprox(expected[i], arrayTolerance)) << i;
    EXPECT_NEAR(cameras[i].lookAt.value.x(), expected[i].x(), arrayTolerance) << i;
  }
  options.path.eyes = { { 1, 1, 1 }, { 1, 1, 1 } };
  options.path.targets.resize(2);
  EXPECT_THROW(cameraArray(options), UsageError);
}

TEST(CameraArray, APathThroughKeyFrames)
{
  CameraDescription camera;
  camera.eye.keys = { { 0, Eigen::Vector3d(0, 0, 5) }, { 10, Eigen::Vector3d(4, 0, 5) } };
  camera.lookAt.keys = { { 0, Eigen::Vector3d(0, 0, 0) }, { 5, Eigen::Vector3d(1, 0, 0) } };
  const CameraPath path = keyFramePath(camera);
  ASSERT_EQ(path.eyes.size(), 3u);
  EXPECT_EQ(path.eyes[1], Eigen::Vector3d(2, 0, 5));
  EXPECT_EQ(path.targets[2], Eigen::Vector3d(1, 0, 0));
  EXPECT_TRUE(keyFramePath(CameraDescription()).eyes.empty());
}
} // namespace
