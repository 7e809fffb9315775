// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCameraArray.h"

#include "dgtkCameraModel.h"
#include "dgtkError.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

namespace
{
using namespace dgtk;

constexpr double tolerance = 1e-12; // scene units

CameraArrayOptions optionsOf(CameraArrayKind kind)
{
  CameraArrayOptions options;
  options.kind = kind;
  options.first.name = "c";
  options.first.eye = Eigen::Vector3d(1, 3, 8);
  options.first.lookAt = Eigen::Vector3d(1, 1, 0);
  return options;
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
  EXPECT_TRUE(cameras[0].eye.value.isApprox(Eigen::Vector3d(1, 3, 8), tolerance));
  EXPECT_TRUE(cameras[2].eye.value.isApprox(Eigen::Vector3d(9, 3, 0), tolerance)) << "a quarter turn";
  EXPECT_TRUE(cameras[4].eye.value.isApprox(Eigen::Vector3d(1, 3, -8), tolerance));
}

TEST(CameraArray, HemisphereCoversEqualAreas)
{
  CameraArrayOptions options = optionsOf(CameraArrayKind::Hemisphere);
  options.count = 400;
  const auto cameras = cameraArray(options);
  expectSound(cameras);
  const double radius = std::sqrt(68.0);
  Eigen::Vector3d mean(0, 0, 0);
  for (const CameraDescription& camera : cameras)
  {
    const Eigen::Vector3d direction = (camera.eye.value - camera.lookAt.value) / radius;
    EXPECT_NEAR(direction.norm(), 1, tolerance);
    EXPECT_GT(direction.y(), 0);
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
  EXPECT_TRUE(left.rotation.isApprox(right.rotation, tolerance));
  EXPECT_TRUE((left * cameras[1].eye.value - Eigen::Vector3d(0.25, 0, 0)).norm() < tolerance);
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
  EXPECT_TRUE((middle * cameras[0].eye.value - Eigen::Vector3d(-2, -1, 0)).norm() < tolerance);
  EXPECT_TRUE((middle * cameras[5].eye.value - Eigen::Vector3d(2, 1, 0)).norm() < tolerance);
}

TEST(CameraArray, NonsenseIsRefused)
{
  CameraArrayOptions options = optionsOf(CameraArrayKind::Ring);
  options.count = 0;
  EXPECT_THROW(cameraArray(options), UsageError);
  options = optionsOf(CameraArrayKind::Stereo);
  options.spacing = 0;
  EXPECT_THROW(cameraArray(options), UsageError);
  options = optionsOf(CameraArrayKind::Grid);
  options.first.lookAt = options.first.eye;
  EXPECT_THROW(cameraArray(options), UsageError);
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
    EXPECT_TRUE(cameras[i].eye.value.isApprox(expected[i], tolerance)) << i;
    EXPECT_NEAR(cameras[i].lookAt.value.x(), expected[i].x(), tolerance) << i;
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
