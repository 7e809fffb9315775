// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkComputeLayer.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

using namespace dgtk::test;

namespace
{
/// A camera at (0, 0, 5) that looks along -z at a square of side 20 in the plane z = 1, tilted by `slope` in x:
/// z = 1 + slope x.
struct TiltedPlane
{
  explicit TiltedPlane(double slope)
    : Slope(slope)
    , State(SceneBuilder()
              .add(makeQuad({ { -10, -10, 1 - 10 * slope }, { 20, 0, 20 * slope }, { 0, 20, 0 }, 4, 2 }))
              .state())
    , View(makeView())
    , Buffer(bruteForce(*State, View))
  {
  }
  /// Depth in closed form: 5 - d = 1 + slope * d * u, u = (x - cx) / f.
  double depth(int x) const
  {
    const Eigen::Matrix3d K = this->View.model->linear()->K;
    return 4 / (1 + this->Slope * (x + 0.5 - K(0, 2)) / K(0, 0));
  }
  Eigen::Vector3d pointInWorld(int x, int y) const
  {
    const Eigen::Matrix3d K = this->View.model->linear()->K;
    const double d = this->depth(x);
    return { d * (x + 0.5 - K(0, 2)) / K(0, 0), -d * (y + 0.5 - K(1, 2)) / K(1, 1), 5 - d };
  }

  double Slope;
  std::shared_ptr<dgtk::SceneState> State;
  dgtk::View View;
  dgtk::VisibilityBuffer Buffer;
};
} // namespace

TEST(ClosedForms, DepthAndDistanceOfAPlane)
{
  for (const double slope : { 0.0, 0.4, -1.1 })
  {
    const TiltedPlane plane(slope);
    const dgtk::Rows depth = computeLayer("depth", *plane.State, plane.View, plane.Buffer);
    const dgtk::Rows distance = computeLayer("distance", *plane.State, plane.View, plane.Buffer);
    for (int y = 0; y < 48; ++y)
    {
      for (int x = 0; x < 64; ++x)
      {
        ASSERT_NEAR(depth.row<double>(y)[x], plane.depth(x), 1e-13);
        ASSERT_NEAR(distance.row<double>(y)[x], (plane.pointInWorld(x, y) - Eigen::Vector3d(0, 0, 5)).norm(), 1e-13);
      }
    }
  }
}

TEST(ClosedForms, PositionObjectCoordinatesAndUvOfAPlane)
{
  TiltedPlane plane(0.4);
  const dgtk::Rows position = computeLayer("position", *plane.State, plane.View, plane.Buffer);
  const dgtk::Rows object = computeLayer("objectcoords", *plane.State, plane.View, plane.Buffer);
  const dgtk::Rows uv = computeLayer("uv", *plane.State, plane.View, plane.Buffer);
  for (int y = 0; y < 48; ++y)
  {
    for (int x = 0; x < 64; ++x)
    {
      const Eigen::Vector3d expected = plane.pointInWorld(x, y);
      ASSERT_LE((Eigen::Map<const Eigen::Vector3d>(position.row<double>(y) + 3 * x) - expected).norm(), 1e-13);
      ASSERT_LE((Eigen::Map<const Eigen::Vector3d>(object.row<double>(y) + 3 * x) - expected).norm(), 1e-13);
      ASSERT_NEAR(uv.row<double>(y)[2 * x], (expected.x() + 10) / 20, 1e-14);
      ASSERT_NEAR(uv.row<double>(y)[2 * x + 1], (expected.y() + 10) / 20, 1e-14);
    }
  }
}

TEST(ClosedForms, ObjectCoordinatesUndoThePlacement)
{
  dgtk::Affine3 world_from_object = placement({ 0.3, -0.1, 0.5 }, 1, { 1, 2, 3 }, 0.8);
  world_from_object.linear *= Eigen::Vector3d(0.5, -1.5, 2).asDiagonal();
  const auto state = SceneBuilder().add(makeBox(), world_from_object).state();
  const dgtk::View view = makeView();
  const dgtk::VisibilityBuffer buffer = bruteForce(*state, view);
  const dgtk::Rows position = computeLayer("position", *state, view, buffer);
  const dgtk::Rows object = computeLayer("objectcoords", *state, view, buffer);
  int seen = 0;
  for (int i = 0; i < 64 * 48; ++i)
  {
    if (buffer.hits[i].object)
    {
      const Eigen::Vector3d local = Eigen::Map<const Eigen::Vector3d>(object.row<double>(0) + 3 * i);
      const Eigen::Vector3d world = Eigen::Map<const Eigen::Vector3d>(position.row<double>(0) + 3 * i);
      ASSERT_LE((world_from_object * local - world).norm(), 1e-13);
      ASSERT_NEAR(local.cwiseAbs().maxCoeff(), 1, 1e-13); // on a face of the box
      ++seen;
    }
  }
  EXPECT_GT(seen, 300);
}

TEST(ClosedForms, NormalsOfABoxFaceTheCamera)
{
  const auto state = SceneBuilder().add(makeBox()).state();
  ViewOptions options;
  options.eye = { 3, 4, 5 };
  for (const bool inside : { false, true })
  {
    options.eye = inside ? Eigen::Vector3d(0.1, 0.2, 0.3) : Eigen::Vector3d(3, 4, 5);
    options.lookAt = inside ? Eigen::Vector3d(1, 0.5, -1) : Eigen::Vector3d(0, 0, 0);
    const dgtk::View view = makeView(options);
    const dgtk::VisibilityBuffer buffer = bruteForce(*state, view);
    const dgtk::Rows normal = computeLayer("normal", *state, view, buffer);
    const dgtk::Rows position = computeLayer("position", *state, view, buffer);
    for (int i = 0; i < 64 * 48; ++i)
    {
      if (!buffer.hits[i].object)
      {
        continue;
      }
      const Eigen::Vector3d world = Eigen::Map<const Eigen::Vector3d>(position.row<double>(0) + 3 * i);
      int axis = 0;
      world.cwiseAbs().maxCoeff(&axis);
      Eigen::Vector3d expected = Eigen::Vector3d::Zero();
      expected[axis] = (world[axis] > 0) == inside ? -1 : 1;
      const Eigen::Vector3d found = Eigen::Map<const Eigen::Vector3f>(normal.row<float>(0) + 3 * i).cast<double>();
      ASSERT_LE((view.camera_from_world.rotation * expected - found).norm(), 1e-7);
    }
  }
}

TEST(ClosedForms, NormalsOfAWallSeenAtAFlatAngleFaceTheRay)
{
  // The wall x = 2 + 0.3 z of the camera frame runs away from a wide view: its side towards the camera is
  // (-1, 0, 0.3), whose z points away from the camera.
  ViewOptions options;
  options.fovY = 100;
  const dgtk::View view = makeView(options);
  const Eigen::Vector3d expected = Eigen::Vector3d(-1, 0, 0.3).normalized();
  for (const bool turned : { false, true })
  {
    // In the world, z of the camera is 5 - z.
    const QuadOptions up{ { 2, -50, 5 }, { 30, 0, -100 }, { 0, 100, 0 }, 1, 1 };
    const QuadOptions down{ { 2, -50, 5 }, { 0, 100, 0 }, { 30, 0, -100 }, 1, 1 };
    const auto state = SceneBuilder().add(makeQuad(turned ? down : up)).state();
    const dgtk::VisibilityBuffer buffer = bruteForce(*state, view);
    const dgtk::Rows normal = computeLayer("normal", *state, view, buffer);
    int seen = 0;
    for (int i = 0; i < 64 * 48; ++i)
    {
      if (buffer.hits[i].object)
      {
        const Eigen::Vector3d found = Eigen::Map<const Eigen::Vector3f>(normal.row<float>(0) + 3 * i).cast<double>();
        ASSERT_LE((expected - found).norm(), 1e-7);
        ++seen;
      }
    }
    EXPECT_GT(seen, 300);
  }
}

TEST(ClosedForms, NormalsOfAMirroredStretchedSphere)
{
  dgtk::Affine3 world_from_object;
  world_from_object.linear = Eigen::Vector3d(-1, 2, 1).asDiagonal();
  const auto state = SceneBuilder().add(makeSphere({ { 0, 0, 0 }, 1, 90, 180 }), world_from_object).state();
  const dgtk::View view = makeView();
  const dgtk::VisibilityBuffer buffer = bruteForce(*state, view);
  const dgtk::Rows normal = computeLayer("normal", *state, view, buffer);
  const dgtk::Rows position = computeLayer("position", *state, view, buffer);
  for (int i = 0; i < 64 * 48; ++i)
  {
    if (buffer.hits[i].object)
    {
      const Eigen::Vector3d p = Eigen::Map<const Eigen::Vector3d>(position.row<double>(0) + 3 * i);
      const Eigen::Vector3d gradient = Eigen::Vector3d(p.x(), p.y() / 4, p.z()).normalized();
      const Eigen::Vector3d found = Eigen::Map<const Eigen::Vector3f>(normal.row<float>(0) + 3 * i).cast<double>();
      ASSERT_LE((view.camera_from_world.rotation * gradient - found).norm(), 0.05); // facets of 2 degrees, stretched
      ASSERT_NEAR(found.norm(), 1, 1e-6);
    }
  }
}

TEST(ClosedForms, NormalsStandFarFromTheOrigin)
{
  const Eigen::Vector3d far(4e6, -3e6, 5e6);
  ViewOptions options;
  options.eye = far + Eigen::Vector3d(0, 0, 5);
  options.lookAt = far;
  const auto state = SceneBuilder().add(makeTerrain({ 64, 2, 0, 1 }), placement(far, 1, { 1, 0, 0 }, 1)).state();
  const dgtk::View view = makeView(options);
  const dgtk::VisibilityBuffer buffer = bruteForce(*state, view);
  const dgtk::Rows normal = computeLayer("normal", *state, view, buffer);
  const Eigen::Vector3d expected =
    view.camera_from_world.rotation * (state->instances[0].world_from_object.linear * Eigen::Vector3d(0, 1, 0));
  int seen = 0;
  for (int i = 0; i < 64 * 48; ++i)
  {
    if (buffer.hits[i].object)
    {
      const Eigen::Vector3d found = Eigen::Map<const Eigen::Vector3f>(normal.row<float>(0) + 3 * i).cast<double>();
      ASSERT_LE((found - expected).norm(), 1e-6);
      ++seen;
    }
  }
  EXPECT_GT(seen, 200);
}

TEST(ClosedForms, IdsOfPartsAndTriangles)
{
  auto model = makeQuad({ { -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 2, 2 });
  model->parts = { { "a", 0, 0, 3 }, { "b", 0, 3, 1 }, { "c", 0, 4, 4 } };
  const auto state = SceneBuilder().add(makeBox(), placement({ 900, 0, 0 })).add(model).state();
  const dgtk::View view = makeView();
  const dgtk::VisibilityBuffer buffer = bruteForce(*state, view);
  const dgtk::Rows objects = computeLayer("objects", *state, view, buffer);
  const dgtk::Rows parts = computeLayer("parts", *state, view, buffer);
  const dgtk::Rows triangles = computeLayer("triangles", *state, view, buffer);
  const std::uint32_t part[8] = { 0, 0, 0, 1, 2, 2, 2, 2 };
  const std::uint32_t inPart[8] = { 0, 1, 2, 0, 0, 1, 2, 3 };
  int seen = 0;
  for (int i = 0; i < 64 * 48; ++i)
  {
    const dgtk::Hit hit = buffer.hits[i];
    ASSERT_EQ(objects.row<std::uint32_t>(0)[i], hit.object ? 2u : 0u);
    ASSERT_EQ(parts.row<std::uint32_t>(0)[i], hit.object ? part[hit.triangle] : 0xFFFFFFFFu);
    ASSERT_EQ(triangles.row<std::uint32_t>(0)[i], hit.object ? inPart[hit.triangle] : 0xFFFFFFFFu);
    seen |= hit.object ? 1 << hit.triangle : 0;
  }
  EXPECT_EQ(seen, 255);
}

TEST(ClosedForms, ModelsWithoutTextureCoordinatesHaveNone)
{
  auto model = makeQuad();
  model->uvs.clear();
  const auto state = SceneBuilder().add(model).state();
  const dgtk::View view = makeView();
  const dgtk::VisibilityBuffer buffer = bruteForce(*state, view);
  const dgtk::Rows uv = computeLayer("uv", *state, view, buffer);
  for (int i = 0; i < 2 * 64 * 48; ++i)
  {
    ASSERT_TRUE(std::isnan(uv.row<double>(0)[i]));
  }
}

TEST(ClosedForms, TrianglesWithoutTextureCoordinatesHaveNone)
{
  auto model = makeQuad();
  ASSERT_EQ(model->triangles.size(), 2u);
  model->unplaced = { 0, 1 };
  const auto state = SceneBuilder().add(model).state();
  const dgtk::View view = makeView();
  const dgtk::VisibilityBuffer buffer = bruteForce(*state, view);
  const dgtk::Rows uv = computeLayer("uv", *state, view, buffer);
  std::set<std::uint32_t> seen;
  for (int i = 0; i < 64 * 48; ++i)
  {
    const dgtk::Hit hit = buffer.hits[i];
    seen.insert(hit.object ? hit.triangle : 2);
    ASSERT_EQ(std::isfinite(uv.row<double>(0)[2 * i]), hit.object && hit.triangle == 0);
    ASSERT_EQ(std::isfinite(uv.row<double>(0)[2 * i + 1]), hit.object && hit.triangle == 0);
  }
  EXPECT_GE(seen.size(), 2u);
  EXPECT_EQ(seen.count(0) + seen.count(1), 2u);
}
