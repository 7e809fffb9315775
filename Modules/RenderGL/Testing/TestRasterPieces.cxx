// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTestScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

// Grounds that begin below the camera, whose triangles are cut before OpenGL draws them.

using namespace dgtk;
using namespace dgtk::test;

namespace
{
constexpr double exactTolerance = 2e-5;
constexpr double byteTolerance = 1.5 / 255; // colours at cuts are whole

std::shared_ptr<const Model> ground(double half, const Material& material)
{
  ModelBuilder model;
  model.part(material);
  model.quad({ -half, 0, half }, { half, 0, half }, { half, 0, -half }, { -half, 0, -half });
  return model.finish();
}

View overGround() { return viewOf(makePinholeFromFov(64, 48, 60, 0), { 0, 1, 0 }, { 0, 0.6, -3 }, 0.1, 5000); }

/// Where the ray through the middle of a pixel meets y = 0; false where it goes upwards.
bool groundAt(const View& view, int x, int y, Eigen::Vector3d& point)
{
  const CameraRay ray = view.model->rayThrough({ x + 0.5, y + 0.5 });
  const Rigid3 world_from_camera = view.camera_from_world.inverse();
  const Eigen::Vector3d origin = world_from_camera * ray.origin;
  const Eigen::Vector3d direction = world_from_camera * (ray.origin + ray.direction) - origin;
  point = origin - direction * (origin.y() / direction.y());
  return direction.y() < 0;
}

LightState noon(double diffuse)
{
  LightState light;
  light.kind = LightKind::Directional;
  light.position = { 0, 1, 0 };
  light.diffuse.setConstant(diffuse);
  return light;
}

/// The largest difference to what `expected` says of points of the ground, in pixels that show them.
template <typename Expected>
double largestError(const std::shared_ptr<SceneState>& state, double half, const Expected& expected)
{
  const View view = overGround();
  const ColorBuffer colors = renderColor(state, view);
  int seen = 0;
  double error = 0;
  Eigen::Vector3d point;
  for (int y = 0; y < 48; ++y)
  {
    for (int x = 0; x < 64; ++x)
    {
      if (groundAt(view, x, y, point) && point.cwiseAbs().maxCoeff() < 0.99 * half)
      {
        ++seen;
        error = std::max(error, (colorAt(colors, x, y) - expected(point)).cwiseAbs().maxCoeff());
      }
    }
  }
  EXPECT_GT(seen, 1500);
  return error;
}
} // namespace

TEST(RasterPieces, HaveTheColoursOfTheirVertices)
{
  constexpr double half = 500;
  for (const int alpha : { 255, 102 })
  {
    auto model = std::make_shared<Model>(*ground(half, matte({ 1, 1, 1 })));
    for (const Eigen::Vector3d& x : model->rest->positions)
    {
      model->colors.push_back(
        { std::uint8_t(x.x() < 0 ? 50 : 250), std::uint8_t(x.z() < 0 ? 240 : 40), 100, std::uint8_t(alpha) });
    }
    auto state = stateOf({ model });
    state->background = { 0.2, 0.4, 0.6 };
    state->lights.push_back(noon(1));
    const auto expected = [&](const Eigen::Vector3d& x) -> Eigen::Vector3d
    {
      const Eigen::Vector3d color(150 + 100 * x.x() / half, 140 - 100 * x.z() / half, 100);
      return color / 255 * (alpha / 255.0) + state->background * (1 - alpha / 255.0);
    };
    EXPECT_LT(largestError(state, half, expected), byteTolerance) << alpha;
    usePictures("ray");
    EXPECT_LT(largestError(state, half, expected), byteTolerance) << alpha;
    usePictures("vtk");
  }
}

TEST(RasterPieces, AreLitWhenTheirObjectIsMirrored)
{
  auto state = stateOf({ ground(1000, matte({ 0.5, 0.75, 1 })) });
  state->lights.push_back(noon(0.8));
  const auto expected = [](const Eigen::Vector3d&) { return Eigen::Vector3d(0.4, 0.6, 0.8); };
  EXPECT_LT(largestError(state, 1000, expected), exactTolerance);
  auto mirrored = std::make_shared<SceneState>(*state);
  mirrored->instances[0].world_from_object.linear = Eigen::Vector3d(-1, 1, 1).asDiagonal();
  EXPECT_LT(largestError(mirrored, 1000, expected), exactTolerance);
}

TEST(RasterPieces, GlowAsTheirMaterial)
{
  EXPECT_LT(largestError(stateOf({ ground(1000, flat({ 0.25, 0.5, 0.75 })) }), 1000,
              [](const Eigen::Vector3d&) { return Eigen::Vector3d(0.25, 0.5, 0.75); }),
    exactTolerance);
}
