// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkExactReference.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

using namespace dgtk::test;

namespace
{
/// Relative error of t that is promised.
constexpr double promisedError = 1e-12;

/// A buffer that names one triangle everywhere.
dgtk::VisibilityBuffer everywhere(const dgtk::View& view, const dgtk::Hit& hit)
{
  dgtk::VisibilityBuffer buffer;
  buffer.resize({ 0, 0, view.model->width(), view.model->height() });
  buffer.hits.assign(buffer.hits.size(), hit);
  return buffer;
}

dgtk::SurfaceRows surface(
  const dgtk::SceneState& state, const dgtk::View& view, const dgtk::VisibilityBuffer& buffer, bool barycentrics = true)
{
  dgtk::SurfaceRows rows;
  dgtk::computeSurfaceRows(state, view, buffer.rect, buffer.hits.data(), barycentrics, rows);
  return rows;
}

bool sameBits(const double* a, const double* b, std::size_t count)
{
  const auto* const bytes = reinterpret_cast<const unsigned char*>(a);
  return std::equal(bytes, bytes + count * sizeof(double), reinterpret_cast<const unsigned char*>(b));
}

ReferenceErrors check(const dgtk::SceneState& state, const dgtk::View& view, double barycentricLimit = 1e-10)
{
  const dgtk::VisibilityBuffer buffer = bruteForce(state, view);
  const ReferenceErrors errors = errorsOf(surface(state, view, buffer));
  EXPECT_GT(errors.pixels, view.model->width() * view.model->height() / 20);
  EXPECT_LE(errors.t, promisedError);
  EXPECT_LE(errors.barycentrics, barycentricLimit);
  std::printf(
    "  %d pixels, relative error of t %.1e, of barycentrics %.1e\n", errors.pixels, errors.t, errors.barycentrics);
  return errors;
}
} // namespace

TEST(SurfaceRows, PlaneAcrossTheView)
{
  const auto state = SceneBuilder().add(makeQuad({ { -9, -9, 2 }, { 18, 0, 0 }, { 0, 18, 0 }, 1, 1 })).state();
  const dgtk::View view = makeView();
  const dgtk::SurfaceRows rows = surface(*state, view, bruteForce(*state, view));
  for (const double t : rows.t)
  {
    ASSERT_NEAR(t, 3, 3e-15);
  }
}

TEST(SurfaceRows, GroundPlaneUpToTheHorizon) // near 0.1, far 100,000; closed form: height / slope of the ray
{
  constexpr double height = 1.7;
  constexpr double reach = 2e5;
  const auto state =
    SceneBuilder().add(makeQuad({ { -reach, 0, reach }, { 2 * reach, 0, 0 }, { 0, 0, -2 * reach }, 1, 1 })).state();
  ViewOptions options;
  options.width = 31;
  options.height = 2001;
  options.fovY = 3;
  options.eye = { 0, height, 0 };
  options.lookAt = { 0, height, -1 };
  options.far = 1e5;
  const dgtk::View view = makeView(options);
  const dgtk::VisibilityBuffer buffer = bruteForce(*state, view);
  const dgtk::SurfaceRows rows = surface(*state, view, buffer);
  double farthest = 0;
  for (int i = 0; i < 31 * 2001; ++i)
  {
    const double slope = ((i / 31) + 0.5 - 1000.5) / view.model->linear()->K(1, 1);
    if (buffer.hits[i].object)
    {
      ASSERT_LE(std::abs(rows.t[i] - height / slope), promisedError * height / slope);
      farthest = std::max(farthest, rows.t[i]);
    }
  }
  EXPECT_GT(farthest, 5e4);
  EXPECT_LE(errorsOf(rows).t, promisedError);
}

TEST(SurfaceRows, TiltedCameraOverAnEnormousPlane)
{
  const auto state = SceneBuilder()
                       .add(makeQuad({ { -1e5, 0, -1e5 }, { 2e5, 0, 0 }, { 0, 0, 2e5 }, 1, 1 }),
                         placement({ 3, 0.1, -2 }, 1, { 0.3, 1, 0.2 }, 0.02))
                       .state();
  ViewOptions options;
  options.eye = { 12, 2, 7 };
  options.lookAt = { -5, 1, 1 };
  options.up = { 0.2, 1, 0.1 };
  options.far = 1e5;
  check(*state, makeView(options));
}

// So far away that double precision alone is just not enough.
TEST(SurfaceRows, LowAboveEnormousPlanes)
{
  ViewOptions options;
  options.eye = { 0, 0, 0 };
  options.lookAt = { -5, -0.4, 1 };
  options.far = 1e5;
  dgtk::View view = makeView(options);
  const auto expectExact = [&view](double height, double turn)
  {
    const auto state = SceneBuilder()
                         .add(makeQuad({ { -1e7, 0, -1e7 }, { 2e7, 0, 0 }, { 0, 0, 2e7 }, 1, 1 }),
                           placement({ 0, -height, 0 }, 0.01, { 0.03, 1, 0.02 }, turn))
                         .state();
    const dgtk::VisibilityBuffer buffer = bruteForce(*state, view);
    const dgtk::SurfaceRows rows = surface(*state, view, buffer);
    EXPECT_LE(errorsOf(rows).t, promisedError) << height << ' ' << turn;
    dgtk::View lens = view;
    lens.model = hideLinear(view.model);
    const dgtk::SurfaceRows general = surface(*state, lens, buffer);
    for (std::size_t i = 0; i < rows.t.size(); ++i)
    {
      if (buffer.hits[i].object && rows.t[i] < 100) // farther away, roundings of the ray count
      {
        ASSERT_LE(std::abs(general.t[i] - rows.t[i]), 2 * promisedError * rows.t[i])
          << i << ' ' << height << ' ' << turn;
      }
    }
  };
  for (const auto& model : { view.model, dgtk::makeOrthographic(64, 48, 2, 0) })
  {
    view.model = model;
    for (const double height : { 0.9, 1.2, 1.6, 2.2, 3.0 })
    {
      for (const double turn : { 0.2, 0.7, 1.9, 2.5 })
      {
        expectExact(height, turn);
      }
    }
  }
}

TEST(SurfaceRows, SphereOfTriangles)
{
  const auto state = SceneBuilder().add(makeSphere({ { 0, 0, 0 }, 2, 40, 80 })).state();
  const dgtk::View view = makeView();
  check(*state, view);
  const dgtk::VisibilityBuffer buffer = bruteForce(*state, view);
  const dgtk::SurfaceRows rows = surface(*state, view, buffer);
  for (std::size_t i = 0; i < rows.t.size(); ++i)
  {
    const dgtk::CameraRay ray = view.model->rayThrough({ i % 64 + 0.5, double(i / 64) + 0.5 });
    if (buffer.hits[i].object) // between the sphere and the sphere inside the flat triangles
    {
      const double radius = (view.camera_from_world.inverse() * (rows.t[i] * ray.direction)).norm();
      EXPECT_LE(radius, 2 + 1e-12);
      EXPECT_GE(radius, 2 * std::cos(3.15 / 40) * std::cos(3.15 / 80));
    }
  }
}

TEST(SurfaceRows, BoxFromACorner)
{
  const auto state = SceneBuilder().add(makeBox(), placement({ 0.1, 0.2, 0.3 }, 1.3, { 1, 2, 3 }, 1)).state();
  check(*state, makeView());
}

TEST(SurfaceRows, MirroredStretchedAndShearedObject)
{
  dgtk::Affine3 sheared = placement({ 0.1, 0.2, 0.3 }, 1, { 1, 2, 3 }, 1);
  Eigen::Matrix3d stretch;
  stretch << -1, 0.5, 0, 0, 3, 0.2, 0.1, 0, 0.05;
  sheared.linear = sheared.linear * stretch;
  check(*SceneBuilder().add(makeBox(), sheared).state(), makeView());
}

TEST(SurfaceRows, DenseTerrainWithTrianglesBelowAPixel)
{
  ViewOptions options;
  options.eye = { 0, 6, 45 };
  options.lookAt = { 0, 0, 20 };
  options.width = 80;
  options.height = 60;
  check(*SceneBuilder().add(makeTerrain({ 150, 100, 1, 3 })).state(), makeView(options), 1e-9);
}

TEST(SurfaceRows, SoupAndTelephoto)
{
  ViewOptions options;
  options.fovY = 0.01;
  options.eye = { 3000, 2000, 8000 };
  options.far = 1e5;
  check(*SceneBuilder().add(makeSoup({ 3000, 1, 0.3, 5 })).state(), makeView(options), 1e-8);
}

TEST(SurfaceRows, FarFromTheOrigin)
{
  const Eigen::Vector3d far(4.5e6, 120.25, -5.3e6);
  ViewOptions options;
  options.eye = far + Eigen::Vector3d(0, 0, 5);
  options.lookAt = far;
  const dgtk::View view = makeView(options);
  check(*SceneBuilder().add(makeSphere(), placement(far, 1.5)).state(), view); // placed there
  SphereOptions sphere;
  sphere.centre = far;
  sphere.radius = 1.5;
  check(*SceneBuilder().add(makeSphere(sphere)).state(), view); // its own vertices are there
  check(*SceneBuilder().add(makeSphere(sphere), placement({ 0.5, -0.25, 0.125 })).state(), view);
}

TEST(SurfaceRows, FarFromTheOriginInAnyDirectionAndFlattened)
{
  const Eigen::Vector3d far(4.5e6, 120.25, -5.3e6);
  ViewOptions options;
  options.eye = far + Eigen::Vector3d(3, 2, 5);
  options.lookAt = far;
  const dgtk::View view = makeView(options);
  check(*SceneBuilder().add(makeSphere(), placement(far, 1.5, { 1, 2, 3 }, 0.4)).state(), view);
  dgtk::Affine3 flat = placement(far, 1.5);
  flat.linear.col(2).setZero();
  check(*SceneBuilder().add(makeSphere(), flat).state(), view);
  flat = placement({ 0, 0, far.z() }); // and its own vertices are there
  flat.linear.col(2).setZero();
  SphereOptions sphere;
  sphere.centre = far;
  check(*SceneBuilder().add(makeSphere(sphere), flat).state(), view);
}

TEST(SurfaceRows, ParallelRaysThatBeginAtASurface)
{
  const auto state = SceneBuilder().add(makeQuad({ { -3, -3, 4.99 }, { 6, 0, 0.002 }, { 0, 6, 0.02 }, 1, 1 })).state();
  ViewOptions options;
  options.near = 1e-12;
  dgtk::View view = makeView(options);
  view.model = dgtk::makeOrthographic(64, 48, 4, 0);
  check(*state, view);
  // in one row of pixels a hundred-thousandth away
  check(*SceneBuilder().add(makeQuad({ { -3, -3, 1.95832 }, { 6, 0, 0 }, { 0, 6, 6 }, 1, 1 })).state(), view);
}

TEST(SurfaceRows, SliversAndGrazingFaces)
{
  auto model = makeSoup({ 1, 0.1, 0.1, 1 });
  auto geometry = std::make_shared<dgtk::Geometry>();
  geometry->positions = { { -3, -3, 1 }, { 3, 3, 1 - 1e-7 }, { 0.2, 0.2 + 1e-9, -900 } };
  geometry->normals.resize(3);
  model->rest = geometry;
  const auto state = SceneBuilder().add(model).state();
  const dgtk::View view = makeView();
  // Nearly in its own plane: no centre is inside, the plane still has a well-defined depth at every pixel.
  const ReferenceErrors errors = errorsOf(surface(*state, view, everywhere(view, { 1, 0 }), false));
  EXPECT_LE(errors.t, 1e-9); // outside of the triangle: extrapolated
}

TEST(SurfaceRows, OrthographicAndSkewedCameras)
{
  ViewOptions options;
  options.eye = { 3, 2, 5 };
  dgtk::View view = makeView(options);
  const auto state = SceneBuilder()
                       .add(makeBox(), placement({ 0.1, 0.2, 0.3 }, 0.7, { 1, 2, 3 }, 1))
                       .add(makeSphere({ { 0, 0, 0 }, 1.2, 20, 40 }))
                       .add(makeQuad({ { -1000, -1, -1000 }, { 2000, 0, 0 }, { 0, 0, 2000 }, 1, 1 }))
                       .state();
  view.model = dgtk::makeOrthographic(64, 48, 4, 0);
  check(*state, view);
  Eigen::Matrix3d K;
  K << 60, 4, -5, 0, 45, 10, 0, 0, 1;
  view.model = dgtk::makePinhole(64, 48, K);
  check(*state, view);
}

TEST(SurfaceRows, LensesAskForRays)
{
  const auto state = SceneBuilder()
                       .add(makeBox(), placement({ 0.1, 0.2, 0.3 }, 1.3, { 1, 2, 3 }, 1))
                       .add(makeQuad({ { -9, -1, -9 }, { 18, 0, 0 }, { 0, 0, 18 }, 3, 3 }))
                       .state();
  for (const auto& model : { dgtk::makePinholeFromFov(64, 48, 45, 0), dgtk::makeOrthographic(64, 48, 4, 0) })
  {
    dgtk::View view = makeView();
    view.model = model;
    const dgtk::VisibilityBuffer buffer = bruteForce(*state, view);
    const dgtk::SurfaceRows linear = surface(*state, view, buffer);
    view.model = hideLinear(model);
    const dgtk::SurfaceRows lens = surface(*state, view, buffer);
    for (std::size_t i = 0; i < linear.t.size(); ++i)
    {
      ASSERT_EQ(std::isinf(linear.t[i]), std::isinf(lens.t[i]));
      if (buffer.hits[i].object)
      {
        ASSERT_LE(std::abs(linear.t[i] - lens.t[i]), 1e-12 * linear.t[i]);
        ASSERT_NEAR(linear.barycentrics[2 * i], lens.barycentrics[2 * i], 1e-11);
        ASSERT_NEAR(linear.barycentrics[2 * i + 1], lens.barycentrics[2 * i + 1], 1e-11);
      }
    }
  }
}

// Parallel rays cross a plane through the camera's centre; the depth of this one is twice x.
TEST(SurfaceRows, PlanesThroughTheCentreOfALens)
{
  const auto state = SceneBuilder().add(makeQuad({ { 0, -9, 0 }, { 9, 0, 18 }, { 0, 18, 0 } })).state();
  dgtk::View view;
  view.near = 1e-3;
  view.far = 100;
  for (const bool hidden : { false, true })
  {
    view.model = dgtk::makeOrthographic(8, 6, 6, 0);
    view.model = hidden ? hideLinear(view.model) : view.model;
    const dgtk::SurfaceRows rows = surface(*state, view, bruteForce(*state, view));
    for (int x = 0; x < 8; ++x)
    {
      const double t = rows.t[std::size_t(8 * 2 + x)];
      if (x < 4)
      {
        EXPECT_TRUE(std::isinf(t)) << x;
      }
      else
      {
        EXPECT_NEAR(t, 2 * (x - 3.5), 1e-14) << x;
      }
    }
  }
}

TEST(SurfaceRows, PlanesBehindTheCameraAreNotThere)
{
  const auto state = SceneBuilder().add(makeQuad({ { -9, -1, -9 }, { 18, 0, 0 }, { 0, 0, 18 }, 1, 1 })).state();
  dgtk::View view = makeView();
  const auto perspective = view.model;
  for (const auto& model : { perspective, hideLinear(perspective) })
  {
    view.model = model;
    const dgtk::SurfaceRows rows = surface(*state, view, everywhere(view, { 1, 0 }));
    for (std::size_t i = 0; i < rows.t.size(); ++i) // the horizon is between the rows in the middle
    {
      ASSERT_EQ(std::isinf(rows.t[i]), i < rows.t.size() / 2) << i;
      ASSERT_EQ(std::isnan(rows.barycentrics[2 * i]), i < rows.t.size() / 2) << i;
    }
  }
}

TEST(SurfaceRows, APixelDoesNotDependOnItsNeighbours)
{
  const auto state = SceneBuilder()
                       .add(makeTerrain({ 60, 20, 1, 3 }))
                       .add(makeQuad({ { -1e4, -0.1, -1e4 }, { 2e4, 0, 0 }, { 0, 0, 2e4 }, 1, 1 }))
                       .state();
  ViewOptions options;
  options.eye = { 0, 2, 9 };
  dgtk::View view = makeView(options);
  const dgtk::VisibilityBuffer buffer = bruteForce(*state, view);
  for (const auto& model : { view.model, hideLinear(view.model) })
  {
    view.model = model;
    const dgtk::SurfaceRows whole = surface(*state, view, buffer);
    for (int i = 0; i < 64 * 48; ++i)
    {
      dgtk::SurfaceRows one;
      dgtk::computeSurfaceRows(*state, view, { i % 64, i / 64, 1, 1 }, &buffer.hits[i], true, one);
      ASSERT_TRUE(sameBits(one.t.data(), &whole.t[i], 1));
      ASSERT_TRUE(sameBits(one.barycentrics.data(), &whole.barycentrics[2 * i], 2));
    }
  }
}

TEST(SurfaceRows, SinglePointsAreThoseOfTheRows)
{
  const auto state = SceneBuilder().add(makeSphere({ { 0, 0, 0 }, 2, 6, 9 })).state();
  const dgtk::View view = makeView();
  const dgtk::VisibilityBuffer buffer = bruteForce(*state, view);
  const dgtk::SurfaceRows rows = surface(*state, view, buffer);
  for (std::size_t i = 0; i < rows.t.size(); ++i)
  {
    if (buffer.hits[i].object)
    {
      const dgtk::SurfacePoint one =
        dgtk::surfacePointAt(*state, view, { i % 64 + 0.5, double(i / 64) + 0.5 }, buffer.hits[i]);
      ASSERT_EQ(one.t, rows.t[i]);
      ASSERT_EQ(one.barycentrics, Eigen::Vector2d(rows.barycentrics[2 * i], rows.barycentrics[2 * i + 1]));
    }
  }
}

TEST(SurfaceRows, TrianglesWithoutAreaAreNotThere)
{
  auto model = makeSoup({ 4, 0.1, 0.1, 1 });
  auto geometry = std::make_shared<dgtk::Geometry>(*model->rest);
  auto& p = geometry->positions;
  p[0] = p[1] = p[2] = { 0.1, 0.2, 0.3 };                                 // a point
  p[3] = p[4] = { -1, -1, 0 };                                            // a line
  p[6] = { 0, 0, 0 }, p[7] = { 0.1, 0.2, 0.3 }, p[8] = { 0.2, 0.4, 0.6 }; // a line
  p[9] = { std::nan(""), 0, 0 };                                          // nothing
  model->rest = geometry;
  model->triangles.push_back({ 12, 13, 14 });
  p.insert(p.end(), { { 0, 0, 1 }, { 0, 0, 2 }, { 1, 0, 0 } }); // seen from its own plane
  for (const auto& state :
    { SceneBuilder().add(model).state(), SceneBuilder().add(model, { Eigen::Matrix3d::Zero(), { 0, 0, 0 } }).state() })
  {
    for (std::uint32_t triangle = 0; triangle < 5; ++triangle)
    {
      const dgtk::View view = makeView();
      const dgtk::SurfaceRows rows = surface(*state, view, everywhere(view, { 1, triangle }));
      for (std::size_t i = 0; i < rows.t.size(); ++i)
      {
        ASSERT_EQ(rows.t[i], std::numeric_limits<double>::infinity()) << triangle << ' ' << i;
        ASSERT_TRUE(std::isnan(rows.barycentrics[2 * i]) && std::isnan(rows.barycentrics[2 * i + 1]));
      }
    }
  }
}

TEST(SurfaceRows, TrianglesAreThereFromASineOf1e15On)
{
  for (const double size : { 1e-6, 1.0, 1e6 })
  {
    for (const auto& [width, there] : { std::pair(1e-16, false), std::pair(1e-14, true) })
    {
      auto model = makeSoup({ 1, 0.1, 0.1, 1 });
      auto geometry = std::make_shared<dgtk::Geometry>(*model->rest);
      geometry->positions = { { -size, 0, 0 }, { size, 0, 0 }, { size, size * width, 0 } };
      model->rest = geometry;
      const auto state = SceneBuilder().add(model).state();
      const dgtk::View view = makeView();
      const dgtk::SurfaceRows rows = surface(*state, view, everywhere(view, { 1, 0 }), false);
      EXPECT_EQ(std::isfinite(rows.t[1000]), there) << size << ' ' << width;
    }
  }
}

TEST(SurfaceRows, RefusesTrianglesThatAreNotThere)
{
  const auto state = SceneBuilder().add(makeQuad()).state();
  const dgtk::View view = makeView();
  for (const dgtk::Hit hit : { dgtk::Hit{ 2, 0 }, dgtk::Hit{ 1, 2 } })
  {
    try
    {
      surface(*state, view, everywhere(view, hit));
      FAIL();
    }
    catch (const dgtk::UsageError& error)
    {
      EXPECT_THAT(error.what(), testing::HasSubstr("names a triangle that the scene does not have"));
    }
  }
}
