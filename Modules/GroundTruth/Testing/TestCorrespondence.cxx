// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPairValues.h"
#include "dgtkRaySource.h"
#include "dgtkSyntheticScene.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace dgtk;
using namespace dgtk::test;

constexpr int pairWidth = 64;
constexpr int pairHeight = 48;
constexpr double pairFocal = 32;

/// Looks along the world's +z from `centre`, x right, y down; the principal point is the image's middle.
View pairViewAt(const Eigen::Vector3d& centre, double near = 0.5, double far = 100)
{
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
  K(0, 0) = K(1, 1) = pairFocal;
  K(0, 2) = pairWidth / 2.0;
  K(1, 2) = pairHeight / 2.0;
  View view;
  view.model = makePinhole(pairWidth, pairHeight, K);
  view.camera_from_world.translation = -centre;
  view.near = near;
  view.far = far;
  return view;
}

/// A wall of two triangles across the plane z, x and y from -32 to 32: barycentrics of whole numbers are exact.
std::shared_ptr<Model> wallAt(double z) { return makeQuad({ { -32, -32, z }, { 64, 0, 0 }, { 0, 64, 0 }, 1, 1 }); }

/// The barycentrics of a point (x, y) of the wall's first or second triangle.
struct OnWall
{
  Hit hit;
  Eigen::Vector2d barycentrics;
};
OnWall onWall(const SceneState& state, std::uint32_t object, const Eigen::Vector2d& at)
{
  for (const std::uint32_t triangle : { 0u, 1u })
  {
    Eigen::Vector3d corner[3];
    triangleInWorld(state, { object, triangle }, corner);
    Eigen::Matrix2d edges;
    edges << (corner[1] - corner[0]).head<2>(), (corner[2] - corner[0]).head<2>();
    const Eigen::Vector2d found = edges.inverse() * (at - corner[0].head<2>());
    if (found.minCoeff() >= 0 && found.sum() <= 1)
    {
      return { { object, triangle }, found };
    }
  }
  ADD_FAILURE() << "not on the wall";
  return {};
}

/// A wall at z = 8 (object 1) and whatever `more` adds, seen by another camera.
class Other
{
public:
  explicit Other(const View& view, const std::function<void(SceneBuilder&)>& more = {})
  {
    SceneBuilder builder;
    builder.add(wallAt(8));
    if (more)
    {
      more(builder);
    }
    this->State = builder.state();
    this->Query = makeOcclusionQuery();
    this->Query->setScene(this->State);
    this->Seen = { this->State.get(), view, this->Query.get() };
  }
  const OtherView& operator*() const { return this->Seen; }
  Correspondence of(const Eigen::Vector2d& at, std::uint32_t object = 1) const
  {
    const OnWall point = onWall(*this->State, object, at);
    return correspond(this->Seen, point.hit, point.barycentrics);
  }

private:
  std::shared_ptr<SceneState> State;
  std::unique_ptr<OcclusionQuery> Query;
  OtherView Seen;
};
} // namespace

TEST(Correspond, APointOfAWallIsWhereTheOtherCameraProjectsIt)
{
  const Other other(pairViewAt({ 1, -0.5, 0 }));
  const Correspondence found = other.of({ 3, 2 });
  EXPECT_EQ(found.visibility, VisibilityClass::Visible);
  EXPECT_NEAR(found.pixel.x(), pairFocal * (3 - 1) / 8 + 32, 1e-12);
  EXPECT_NEAR(found.pixel.y(), pairFocal * (2 + 0.5) / 8 + 24, 1e-12);
}

TEST(Correspond, WhatStandsBeforeThePointNamesTheClass)
{
  // A pane at z = 4 of another object hides; of the own object it is the own one that hides.
  const auto pane = makeQuad({ { -1, -1, 4 }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1 });
  const Other another(pairViewAt({ 0, 0, 0 }), [&](SceneBuilder& scene) { scene.add(pane); });
  EXPECT_EQ(another.of({ 0, 0 }).visibility, VisibilityClass::OccludedByOther);
  EXPECT_EQ(another.of({ 0, 0 }).pixel, Eigen::Vector2d(32, 24)) << "hidden points are somewhere, too";
  EXPECT_EQ(another.of({ 3, 0 }).visibility, VisibilityClass::Visible);

  auto folded = std::make_shared<Model>(*wallAt(8));
  auto rest = std::make_shared<Geometry>(*folded->rest);
  for (const Eigen::Vector3d& corner : { Eigen::Vector3d(-1, -1, 4), { 1, -1, 4 }, { 0, 2, 4 } })
  {
    rest->positions.push_back(corner);
    rest->normals.push_back(rest->normals[0]);
    folded->uvs.push_back(folded->uvs[0]);
  }
  folded->rest = rest;
  folded->triangles.push_back({ 4, 5, 6 });
  folded->parts[0].triangles = 3;
  const Other own(pairViewAt({ 0, 0, 0 }), [&](SceneBuilder& scene) { scene.add(folded, placement({ 0, 0, 0.5 })); });
  EXPECT_EQ(own.of({ 0, 0 }, 2).visibility, VisibilityClass::OccludedByOwn) << "the fold stands before the wall at 8";
  EXPECT_EQ(own.of({ 4, 0 }, 2).visibility, VisibilityClass::OccludedByOther) << "by the wall at 8";
  EXPECT_EQ(own.of({ 0, 0 }, 1).visibility, VisibilityClass::OccludedByOther) << "by the fold at 4.5";
  const Other alone(pairViewAt({ 0, 0, 0 }), [&](SceneBuilder& scene) { scene.add(folded, placement({ 0, 0, -1 })); });
  EXPECT_EQ(alone.of({ 0, 0 }, 2).visibility, VisibilityClass::OccludedByOwn);
  EXPECT_EQ(alone.of({ 4, 0 }, 2).visibility, VisibilityClass::Visible);
}

TEST(Correspond, TheBordersOfTheImageBelongToIt)
{
  // x = 8 is at column 64 of 64, y = 6 at row 48 of 48, exactly.
  const Other other(pairViewAt({ 0, 0, 0 }));
  for (const Eigen::Vector2d& at : { Eigen::Vector2d(8, 0), { -8, 0 }, { 0, 6 }, { 0, -6 } })
  {
    EXPECT_EQ(other.of(at).visibility, VisibilityClass::Visible) << at.transpose();
    const Correspondence beyond = other.of(at * (1 + 1e-9));
    EXPECT_EQ(beyond.visibility, VisibilityClass::Outside) << at.transpose();
    EXPECT_TRUE(beyond.pixel.allFinite()) << "points outside are somewhere, too";
  }
}

TEST(Correspond, NearerThanNearAndFartherThanFarAreOutside)
{
  EXPECT_EQ(Other(pairViewAt({ 0, 0, 0 }, 0.5, 8)).of({ 0, 0 }).visibility, VisibilityClass::Visible) << "at far";
  EXPECT_EQ(Other(pairViewAt({ 0, 0, 0 }, 8, 9)).of({ 0, 0 }).visibility, VisibilityClass::Visible) << "at near";
  EXPECT_EQ(Other(pairViewAt({ 0, 0, 0 }, 0.5, 7.999)).of({ 0, 0 }).visibility, VisibilityClass::Outside);
  EXPECT_EQ(Other(pairViewAt({ 0, 0, 0 }, 8.001, 9)).of({ 0, 0 }).visibility, VisibilityClass::Outside);
}

// A fisheye sees sideways and back: near and far are distances.
TEST(Correspond, NearAndFarOfALensAreDistances)
{
  const auto lens = [](double z, double near, double far)
  {
    View view = pairViewAt({ 0, 0, z }, near, far);
    view.model = makeEquidistant(pairWidth, pairHeight, 10); // 3.2 radians to the sides
    return view;
  };
  const double distance = std::sqrt(16 * 16 + 0.25 * 0.25);
  for (const double z : { 8 - 0.25, 8 + 0.25 }) // beside the wall, and past it
  {
    const Other other(lens(z, 0.5, distance + 1e-6));
    EXPECT_EQ(other.of({ 16, 0 }).visibility, VisibilityClass::Visible) << z;
    EXPECT_EQ(Other(lens(z, 0.5, distance - 1e-6)).of({ 16, 0 }).visibility, VisibilityClass::Outside) << z;
    EXPECT_EQ(Other(lens(z, distance + 1e-6, 99)).of({ 16, 0 }).visibility, VisibilityClass::Outside) << z;
  }
}

TEST(Correspond, BehindTheCameraIsNowhere)
{
  const Correspondence found = Other(pairViewAt({ 0, 0, 9 })).of({ 0, 0 });
  EXPECT_EQ(found.visibility, VisibilityClass::Behind);
  EXPECT_TRUE(found.pixel.array().isNaN().all());
}

namespace
{
/// Barycentrics of all pixels of a view.
SurfaceRows surfaceOf(const SceneState& state, const View& view, const VisibilityBuffer& buffer)
{
  SurfaceRows rows;
  computeSurfaceRows(state, view, buffer.rect, buffer.hits.data(), true, rows);
  return rows;
}
} // namespace

TEST(CorrespondRows, AStepToTheRightMovesTheWallToTheLeft)
{
  const auto state = SceneBuilder().add(makeQuad({ { -4, -40, 8 }, { 80, 0, 0 }, { 0, 80, 0 }, 1, 1 })).state();
  const View own = pairViewAt({ 0, 0, 0 });
  const VisibilityBuffer buffer = bruteForce(*state, own);
  const SurfaceRows rows = surfaceOf(*state, own, buffer);
  const std::unique_ptr<OcclusionQuery> query = makeOcclusionQuery();
  query->setScene(state);
  std::vector<double> pixels(buffer.hits.size() * 2);
  std::vector<std::uint8_t> classes(buffer.hits.size());
  correspondRows(rows, { state.get(), pairViewAt({ 1, 0, 0 }), query.get() }, pixels.data(), classes.data());
  for (int y = 0; y < pairHeight; ++y)
  {
    for (int x = 0; x < pairWidth; ++x)
    {
      const std::size_t i = std::size_t(y) * pairWidth + x;
      if (x + 0.5 < 16) // left of the wall's edge
      {
        ASSERT_EQ(classes[i], 0) << x << ' ' << y;
        ASSERT_TRUE(std::isnan(pixels[2 * i]) && std::isnan(pixels[2 * i + 1]));
        continue;
      }
      ASSERT_EQ(classes[i], 1) << x << ' ' << y;
      ASSERT_NEAR(pixels[2 * i], x + 0.5 - pairFocal / 8, 1e-12);
      ASSERT_NEAR(pixels[2 * i + 1], y + 0.5, 1e-12);
    }
  }
}

TEST(CorrespondPoints, ManyAtOnceAreWhatEachIs)
{
  // A pane hides the middle of the wall; what is farther to the right is beside the image.
  const auto pane = makeQuad({ { -1, -1, 4 }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1 });
  const auto state = SceneBuilder().add(wallAt(8)).add(pane).state();
  const std::unique_ptr<OcclusionQuery> query = makeOcclusionQuery();
  query->setScene(state);
  const OtherView other{ state.get(), pairViewAt({ 0, 0, 0 }), query.get() };
  std::vector<FixedPoint> points;
  for (int i = -40; i <= 40; ++i)
  {
    const OnWall point = onWall(*state, 1, { i / 4.0 + 0.125, 0.25 });
    points.push_back({ point.hit, point.barycentrics });
  }
  std::vector<Correspondence> found(points.size());
  correspondPoints(other, points.data(), points.size(), found.data());
  for (int i = -40; i <= 40; ++i)
  {
    const Correspondence& one = found[std::size_t(i + 40)];
    const double x = i / 4.0 + 0.125;
    EXPECT_NEAR(one.pixel.x(), 32 + pairFocal * x / 8, 1e-12);
    EXPECT_NEAR(one.pixel.y(), 24 + pairFocal * 0.25 / 8, 1e-12);
    EXPECT_EQ(one.visibility, std::abs(x) > 8    ? VisibilityClass::Outside
                              : std::abs(x) <= 2 ? VisibilityClass::OccludedByOther
                                                 : VisibilityClass::Visible)
      << x;
  }
  correspondPoints(other, nullptr, 0, nullptr);
}

TEST(SceneFlowRows, IsTheMotionInTheAxesOfTheCamera)
{
  // A wall that moves by (0.5, -0.25, 1) in the world, seen by a camera turned by a quarter about z.
  const auto state = SceneBuilder().add(wallAt(8)).state();
  const auto next = SceneBuilder().add(wallAt(8), placement({ 0.5, -0.25, 1 })).state();
  View view = pairViewAt({ 0, 0, 0 });
  view.camera_from_world.rotation << 0, 1, 0, -1, 0, 0, 0, 0, 1;
  VisibilityBuffer buffer = bruteForce(*state, view);
  buffer.hits[0] = {};
  std::vector<double> motion(buffer.hits.size() * 3);
  sceneFlowRows(surfaceOf(*state, view, buffer), { next.get(), view, nullptr }, motion.data());
  EXPECT_TRUE(std::isnan(motion[0]) && std::isnan(motion[1]) && std::isnan(motion[2]));
  for (std::size_t i = 1; i < buffer.hits.size(); ++i)
  {
    ASSERT_LE((Eigen::Map<const Eigen::Vector3d>(&motion[3 * i]) - Eigen::Vector3d(-0.25, -0.5, 1)).norm(), 1e-12);
  }
}

namespace
{
/// pairRows() of a wall at depth 8, in the rows 1 and 2, seen again by a camera at `place`.
std::vector<double> pairOf(PairValue value, const Eigen::Vector3d& place, std::vector<std::uint8_t>& classes)
{
  const auto state = SceneBuilder().add(wallAt(8)).state();
  const View own = pairViewAt({ 0, 0, 0 });
  const VisibilityBuffer buffer = bruteForce(*state, own);
  SurfaceRows rows;
  computeSurfaceRows(*state, own, { 0, 1, pairWidth, 2 }, buffer.hits.data() + pairWidth, true, rows);
  const std::unique_ptr<OcclusionQuery> query = makeOcclusionQuery();
  query->setScene(state);
  std::vector<double> values(rows.t.size() * std::size_t(channelsOf(value)));
  classes.assign(rows.t.size(), 99);
  const OtherView other{ state.get(), pairViewAt(place), query.get() };
  if (value == PairValue::Motion)
  {
    sceneFlowRows(rows, other, values.data());
    return values;
  }
  std::vector<double> pixels(2 * rows.t.size());
  correspondRows(rows, other, pixels.data(), classes.data());
  pairRows(rows.rect, pixels.data(), value, values.data());
  return values;
}
} // namespace

TEST(PairRows, ValuesAreRelatedToThePixelsCentre)
{
  // The other camera stands 0.5 to the right and 0.25 below (y down): everything moves to the left and up.
  constexpr double left = 0.5 * pairFocal / 8;
  constexpr double up = 0.25 * pairFocal / 8;
  std::vector<std::uint8_t> classes;
  const Eigen::Vector3d place(0.5, 0.25, 0);
  const std::vector<double> position = pairOf(PairValue::Position, place, classes);
  const std::vector<double> displacement = pairOf(PairValue::Displacement, place, classes);
  const std::vector<double> fromLeft = pairOf(PairValue::FromLeft, place, classes);
  const std::vector<double> fromRight = pairOf(PairValue::FromRight, place, classes);
  ASSERT_EQ(position.size(), 4u * pairWidth);
  ASSERT_EQ(fromLeft.size(), 2u * pairWidth);
  for (int i = 0; i < 2 * pairWidth; ++i)
  {
    const double x = i % pairWidth + 0.5;
    const double y = 1 + i / pairWidth + 0.5;
    ASSERT_NE(classes[std::size_t(i)], 99);
    ASSERT_NEAR(position[std::size_t(2 * i)], x - left, 1e-11);
    ASSERT_NEAR(position[std::size_t(2 * i + 1)], y - up, 1e-11);
    ASSERT_NEAR(displacement[std::size_t(2 * i)], -left, 1e-11);
    ASSERT_NEAR(displacement[std::size_t(2 * i + 1)], -up, 1e-11);
    ASSERT_NEAR(fromLeft[std::size_t(i)], left, 1e-11);
    ASSERT_NEAR(fromRight[std::size_t(i)], -left, 1e-11);
  }
}

TEST(PairRows, MotionHasNoClasses)
{
  std::vector<std::uint8_t> classes;
  const std::vector<double> motion = pairOf(PairValue::Motion, { 0.5, 0.25, 0 }, classes);
  EXPECT_EQ(motion, std::vector<double>(6 * pairWidth, 0.0));
  EXPECT_EQ(classes, std::vector<std::uint8_t>(2 * pairWidth, 99));
}

TEST(RectifiedBaseline, IsThatOfCamerasSideBySideOnly)
{
  const View own = pairViewAt({ 0, 0, 0 });
  EXPECT_NEAR(rectifiedBaseline(own, pairViewAt({ 0.5, 0, 0 })), 0.5, 1e-15);
  EXPECT_NEAR(rectifiedBaseline(own, pairViewAt({ -2, 0, 0 })), -2, 1e-15);
  EXPECT_EQ(rectifiedBaseline(own, own), 0);
  EXPECT_EQ(rectifiedBaseline(own, pairViewAt({ 0.5, 1e-6, 0 })), 0);
  EXPECT_EQ(rectifiedBaseline(own, pairViewAt({ 0.5, 0, 1e-6 })), 0);
  View turned = pairViewAt({ 0.5, 0, 0 });
  turned.camera_from_world.rotation = Eigen::AngleAxisd(1e-6, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  EXPECT_EQ(rectifiedBaseline(own, turned), 0);
  const View far = pairViewAt({ 0, 5e6, 5e6 }); // 1e-9 is the step of such a number
  EXPECT_EQ(rectifiedBaseline(far, pairViewAt({ 0.5, 5e6 + 3e-9, 5e6 - 3e-9 })), 0.5);
  EXPECT_EQ(rectifiedBaseline(pairViewAt({ 0.5, 5e6 + 3e-9, 5e6 - 3e-9 }), far), -0.5);
  EXPECT_EQ(rectifiedBaseline(far, pairViewAt({ 0.5, 5e6 + 1e-7, 5e6 })), 0);
  EXPECT_EQ(rectifiedBaseline(far, pairViewAt({ 1e-9, 5e6, 5e6 })), 0) << "one place";
  const auto with = [](double fx, double fy, int width, int height)
  {
    View view = pairViewAt({ 0.5, 0, 0 });
    Eigen::Matrix3d K = view.model->linear()->K;
    K(0, 0) *= fx;
    K(1, 1) *= fy;
    K(0, 2) += 3;
    view.model = makePinhole(pairWidth * width, pairHeight * height, K);
    return view;
  };
  EXPECT_NEAR(rectifiedBaseline(own, with(1, 1, 1, 1)), 0.5, 1e-15) << "another cx";
  EXPECT_EQ(rectifiedBaseline(own, with(2, 1, 1, 1)), 0);
  EXPECT_EQ(rectifiedBaseline(own, with(1, 2, 1, 1)), 0);
  EXPECT_EQ(rectifiedBaseline(own, with(1, 1, 2, 1)), 0);
  EXPECT_EQ(rectifiedBaseline(own, with(1, 1, 1, 2)), 0);
}
