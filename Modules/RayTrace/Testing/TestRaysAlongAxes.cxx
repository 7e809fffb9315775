// SPDX-License-Identifier: BSD-3-Clause
// Rays that run along a plane of an instance's axes but for a rounding: the middle of a picture that has an odd size.
#include "dgtkRaySource.h"

#include "dgtkExactRay.h"

#include "dgtkRayTestScenes.h"
#include "dgtkThreadPool.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace
{
using namespace dgtk;
using namespace dgtk::test;

/// A ball of small triangles, somewhat beside the axis.
std::shared_ptr<const SceneState> ballState(bool scaled)
{
  return SceneBuilder()
    .add(makeSphere({ { 0, 0, 0 }, 1, 60, 120 }), placement({ 0.0137, 0.0171, 0.0213 }, scaled ? 0.99 : 1))
    .state();
}

/// Views from 8 away of which a pixel is 1 / 8192, that have the axes of the world but for `rounding`.
std::vector<View> viewsOf(double rounding, int size)
{
  Eigen::Matrix3d K;
  K << 8192, 0, 0.5 * size, 0, 8192, 0.5 * size, 0, 0, 1;
  std::vector<View> views;
  for (const double side : { -1., 1. })
  {
    for (const Eigen::Vector3d& up : { Eigen::Vector3d(side * rounding, 1, 0), Eigen::Vector3d(side, rounding, 0),
           Eigen::Vector3d(side * rounding, -1, 0) })
    {
      ViewOptions options;
      options.eye = { 0, 0, 8 * side };
      options.up = up;
      views.push_back(makeView(options));
      views.back().model = makePinhole(size, size, K);
    }
  }
  return views;
}
} // namespace

TEST(RaysAlongAxes, PrimaryRaysFindNoHoleInASurface)
{
  ThreadPool pool(2);
  const auto source = makeRaySource(pool);
  for (const bool scaled : { false, true })
  {
    const auto state = ballState(scaled);
    for (const double rounding : { 6e-17, 1e-18 })
    {
      for (const View& view : viewsOf(rounding, 1085))
      {
        source->setScene(state, view);
        VisibilityBuffer buffer;
        source->render({ 0, 0, 1085, 1085 }, buffer);
        EXPECT_EQ(
          std::count_if(buffer.hits.begin(), buffer.hits.end(), [](const Hit& hit) { return hit.object == 0; }), 0);
      }
    }
  }
}

TEST(RaysAlongAxes, BoundsOfPacketsDoNotShow)
{
  ThreadPool pool(2);
  const auto together = makeRaySource(pool);
  const auto apart = makeRaySource(pool, false);
  for (const RayCase& c : rayCases())
  {
    const PixelRect rect{ 0, 0, c.view.model->width(), c.view.model->height() };
    VisibilityBuffer one;
    VisibilityBuffer two;
    together->setScene(c.state, c.view);
    together->render(rect, one);
    apart->setScene(c.state, c.view);
    apart->render(rect, two);
    EXPECT_TRUE(one.hits == two.hits) << c.name;
  }
}

TEST(RaysAlongAxes, AllHitsOfAPacketAreThoseOfEachRay)
{
  const auto query = makeOcclusionQuery();
  query->setScene(ballState(false));
  for (const View& view : viewsOf(6e-17, 61))
  {
    std::vector<Eigen::Vector2d> pixels;
    for (int i = 0; i < 61; ++i)
    {
      for (int j = 28; j < 34; ++j)
      {
        pixels.emplace_back(i + 0.5, j + 0.5);
        pixels.emplace_back(j + 0.5, i + 0.5);
      }
    }
    std::vector<std::vector<Hit>> hits(pixels.size());
    query->allHits(view, pixels.data(), pixels.size(), hits.data());
    for (std::size_t i = 0; i < pixels.size(); ++i)
    {
      EXPECT_EQ(hits[i].size(), 2u) << pixels[i].transpose();
    }
  }
}

TEST(RaysAlongAxes, WhatABallHidesStaysHidden)
{
  const auto query = makeOcclusionQuery();
  const auto state = ballState(false);
  query->setScene(state);
  const View view = viewsOf(6e-17, 61).front();
  const Rigid3 world_from_camera = view.camera_from_world.inverse();
  for (const double tiny : { -1e-19, -3e-18, -1e-25, 0.0, 1e-19 })
  {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 16; ++i)
    {
      points.push_back(world_from_camera * Eigen::Vector3d(i % 4 == 3 ? tiny : 0.01 * (i % 4 - 3), 0.01 * (i / 4), 12));
      points.back().x() += view.camera_from_world.rotation(0, 0) * (i % 4 == 3 ? tiny : 0);
    }
    const std::vector<Hit> targets(points.size());
    std::vector<Hit> found(points.size());
    query->occluders(view, points.data(), targets.data(), points.size(), found.data());
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      EXPECT_EQ(found[i].object, 1u) << tiny << ", " << i;
    }
  }
}

/// At the pole of a ball many triangles meet, of which at most some rounded rays around it find each one.
TEST(RaysAlongAxes, APoleIsNoHole)
{
  ThreadPool pool(1);
  const auto source = makeRaySource(pool);
  const auto query = makeOcclusionQuery();
  const std::vector<std::pair<Eigen::Vector3d, double>> turns{ { { 1, 0, 0 }, 0.5 }, { { 1, 0, 0 }, -0.5 },
    { { 0, 0, 1 }, 0.5 }, { { 0, 0, 1 }, -0.5 } };
  for (const auto& [axis, turn] : turns)
  {
    for (const double size : { 1.0, 0.7, 0.1 })
    {
      for (const int segments : { 8, 20, 60, 200 })
      {
        const auto ball = makeSphere({ { 0, 0, 0 }, 1, 6, segments });
        const auto state = SceneBuilder().add(ball, placement({ 0, 0, 0 }, size, axis, turn * M_PI)).state();
        for (const double rounding : { 0.0, 1e-17, -1e-17, 1e-16, 3e-16 })
        {
          ViewOptions options;
          options.width = options.height = 9;
          options.eye = axis.x() != 0 ? Eigen::Vector3d(rounding, 0, 5) : Eigen::Vector3d(5, 0, rounding);
          const View view = makeView(options);
          source->setScene(state, view);
          VisibilityBuffer buffer;
          source->render({ 4, 4, 1, 1 }, buffer);
          EXPECT_EQ(buffer.at(4, 4).object, 1u) << segments << " triangles, " << rounding;
          query->setScene(state);
          std::vector<Hit> hits;
          query->allHits(view, Eigen::Vector2d(4.5, 4.5), hits);
          EXPECT_EQ(hits.size(), 2u) << segments << " triangles, " << rounding;
        }
      }
    }
  }
}

TEST(RaysAlongAxes, ASurfaceSeenFromItsEdgeHidesNothing)
{
  std::mt19937 random(1);
  const auto number = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
  QuadOptions floor;
  floor.corner = { -3.5, 0.5, 60 };
  floor.sideU = { 7, 0, 0 };
  floor.sideV = { 0, 0, -120 };
  floor.cellsU = floor.cellsV = 2;
  const auto query = makeOcclusionQuery();
  const auto state = SceneBuilder().add(makeQuad(floor)).state();
  query->setScene(state);
  int hidden = 0;
  for (int i = 0; i < 200; ++i)
  {
    ViewOptions options;
    options.eye = { number(), 0.5, -6 };
    options.lookAt = { number(), number(), 0 };
    const View view = makeView(options);
    const std::uint32_t triangle = std::uint32_t(i) % 8;
    Eigen::Vector3d x[3];
    triangleInWorld(*state, { 1, triangle }, x);
    for (int k = 0; k < 20; ++k)
    {
      const double u = 0.5 + 0.5 * number();
      const double v = (0.5 + 0.5 * number()) * (1 - u);
      hidden += query->occluder(view, x[0] + u * (x[1] - x[0]) + v * (x[2] - x[0]), { 1, triangle }).object != 0;
    }
  }
  EXPECT_EQ(hidden, 0);
}

TEST(ExactSide, SmallTrianglesFarAwayAreThere)
{
  for (const double distance : { 1e3, 1e6, 1e8 })
  {
    int met = 0;
    for (int i = 0; i < 32; ++i)
    {
      // A grid of cells of 1 / 256, a ray through the middle of one of the triangles.
      const Eigen::Vector3d at(i, 7 - i, distance);
      constexpr double cell = 1.0 / 256;
      const Eigen::Vector3d corners[3] = { at, at + Eigen::Vector3d(cell, 0, 0), at + Eigen::Vector3d(0, cell, 0) };
      const ExactRay ray{ { 0, 0, 0 }, (at + Eigen::Vector3d(cell, cell, 0) / 4) / distance, 0.1, 1e9 };
      const TriangleFrom from(ray.origin, corners);
      const ExactHit hit = intersectExactly(ray, SeenTriangle(ray, from));
      met += hit.inside;
      EXPECT_TRUE(!hit.inside || std::abs(hit.t - distance) <= 1e-9 * distance) << distance;
    }
    EXPECT_EQ(met, 32) << distance;
  }
}

TEST(ExactSide, IsThatOfWholeNumbers)
{
  std::mt19937_64 random(1);
  const auto vector = [&](std::int64_t range)
  {
    const auto number = [&] { return double(std::int64_t(random() % std::uint64_t(2 * range + 1)) - range); };
    return Eigen::Vector3d(number(), number(), number());
  };
  const auto side = [](const Eigen::Vector3d& d, const Eigen::Vector3d& a, const Eigen::Vector3d& b)
  {
    __int128 line[3];
    __int128 volume = 0;
    for (int i = 0; i < 3; ++i)
    {
      const int j = (i + 1) % 3;
      const int k = (i + 2) % 3;
      line[i] = __int128(a[j]) * __int128(b[k]) - __int128(a[k]) * __int128(b[j]);
      volume += __int128(d[i]) * line[i];
    }
    for (const __int128 v : { volume, line[0], line[1], line[2] })
    {
      if (v != 0)
      {
        return v > 0 ? 1 : -1;
      }
    }
    return 0;
  };
  int zeros = 0;
  for (int i = 0; i < 20000; ++i)
  {
    // Up to 2^40, and mostly all but in one plane.
    const Eigen::Vector3d a = vector(1LL << (i % 3 == 0 ? 2 : 38));
    const Eigen::Vector3d b = i % 7 == 0 ? Eigen::Vector3d(3 * a) : vector(1LL << (i % 3 == 0 ? 2 : 38));
    const Eigen::Vector3d d = i % 5 == 0 ? vector(1LL << 38) : Eigen::Vector3d(a + (i % 2) * b + vector(i % 4 / 2));
    EXPECT_EQ(exactSide(d, a, b), side(d, a, b)) << i;
    EXPECT_EQ(exactSide(d, b, a), -exactSide(d, a, b)) << i;
    zeros += d.dot(a.cross(b)) == 0;
  }
  EXPECT_GT(zeros, 1000);
}

TEST(ExactSide, RaysThroughACornerMeetOneTriangle)
{
  std::mt19937 random(1);
  const auto number = [&] { return std::uniform_real_distribution<double>(-1, 1)(random); };
  for (int i = 0; i < 3000; ++i)
  {
    const Eigen::Vector3d corner(number(), number(), 4 + number());
    std::vector<Eigen::Vector3d> around;
    const int count = 4 + i % 20;
    for (int k = 0; k < count; ++k)
    {
      const double angle = 2 * M_PI * (k + 0.4 * number()) / count;
      around.push_back(corner + 0.1 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.1 * number()));
    }
    const ExactRay ray{ { 0, 0, 0 }, corner / (i % 2 == 0 ? corner.z() : corner.norm()), 0.1, 100 };
    int inside = 0;
    for (int k = 0; k < count; ++k)
    {
      const Eigen::Vector3d corners[3] = { corner, around[std::size_t(k)], around[std::size_t((k + 1) % count)] };
      const TriangleFrom from(ray.origin, corners);
      const ExactHit hit = intersectExactly(ray, SeenTriangle(ray, from));
      inside += hit.inside;
      EXPECT_TRUE(!hit.inside || (hit.barycentrics.minCoeff() >= 0 && hit.barycentrics.sum() <= 1));
    }
    EXPECT_EQ(inside, 1) << i;
  }
}
