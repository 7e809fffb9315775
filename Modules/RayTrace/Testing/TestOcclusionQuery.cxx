// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRaySource.h"

#include "dgtkRayTestScenes.h"
#include "dgtkThreadPool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
using namespace dgtk;
using namespace dgtk::test;

/// A surface met by a ray, by the textbook's formula in long double.
struct Met
{
  long double t;
  Hit hit;
  long double margin; ///< smallest barycentric coordinate
};

/// All triangles whose plane a ray in the camera frame meets inside or close to them, near to far.
std::vector<Met> meet(const SceneState& state, const View& view, const CameraRay& ray)
{
  using V = Eigen::Matrix<long double, 3, 1>;
  const auto cross = [](const V& a, const V& b)
  { return V(a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()); };
  constexpr long double close = -1e-6L;
  std::vector<Met> all;
  const V o = ray.origin.cast<long double>();
  const V d = ray.direction.cast<long double>();
  for (std::uint32_t object = 1; object <= state.instances.size(); ++object)
  {
    const std::size_t count = state.instances[object - 1].model->triangles.size();
    for (std::uint32_t triangle = 0; triangle < count; ++triangle)
    {
      Eigen::Vector3d world[3];
      triangleInWorld(state, { object, triangle }, world);
      V x[3];
      for (int i = 0; i < 3; ++i)
      {
        x[i] = (view.camera_from_world * world[i]).cast<long double>();
      }
      const V e1 = x[1] - x[0];
      const V e2 = x[2] - x[0];
      const V p = cross(d, e2);
      const long double determinant = p.dot(e1);
      const V s = o - x[0];
      const V q = cross(s, e1);
      const long double u = p.dot(s) / determinant;
      const long double v = q.dot(d) / determinant;
      const long double t = q.dot(e2) / determinant;
      const long double margin = std::min({ u, v, 1 - u - v });
      if (margin > close && !isCutOut(state.instances[object - 1], triangle, { double(u), double(v) }))
      {
        all.push_back({ t, { object, triangle }, margin });
      }
    }
  }
  std::sort(all.begin(), all.end(), [](const Met& a, const Met& b) { return a.t < b.t; });
  // Coincident ones by id.
  for (auto first = all.begin(); first != all.end();)
  {
    const auto last =
      std::find_if(first, all.end(), [&](const Met& m) { return m.t > first->t + 1e-9L * std::abs(first->t); });
    std::sort(first, last,
      [](const Met& a, const Met& b)
      { return a.hit.object != b.hit.object ? a.hit.object < b.hit.object : a.hit.triangle < b.hit.triangle; });
    first = last;
  }
  return all;
}

bool onEdge(const std::vector<Met>& all)
{
  return std::any_of(all.begin(), all.end(), [](const Met& m) { return m.margin < 1e-6L; });
}

Hit hit(std::uint32_t object, std::uint32_t triangle) { return { object, triangle }; }

} // namespace

// Embree ends the process over a ray that single precision cannot hold.
TEST(OcclusionQuery, RaysBeyondAllBoundsMeetNothing)
{
  ThreadPool pool(2);
  const auto state = SceneBuilder().add(makeQuad()).state();
  const auto query = makeOcclusionQuery();
  query->setScene(state);
  const auto source = makeRaySource(pool);
  for (const auto& [row, column] : { std::pair(0, 1), std::pair(0, 2), std::pair(1, 2) })
  {
    for (const double number : { 1e30, 1e300 })
    {
      Eigen::Matrix3d K;
      K << 50, 0, 32, 0, 50, 24, 0, 0, 1;
      K(row, column) = number;
      View view = makeView();
      view.model = makePinhole(64, 48, K);
      source->setScene(state, view);
      VisibilityBuffer buffer;
      source->render({ 0, 0, 64, 48 }, buffer);
      EXPECT_EQ(std::count(buffer.hits.begin(), buffer.hits.end(), Hit{}), 64 * 48) << row << column << ' ' << number;
      std::vector<Hit> hits;
      query->allHits(view, { 20.5, 30.5 }, hits);
      EXPECT_TRUE(hits.empty());
    }
  }
}

TEST(OcclusionQuery, AllHitsAreThoseOfEveryTriangle)
{
  const auto query = makeOcclusionQuery();
  std::size_t compared = 0;
  for (const RayCase& c : rayCases())
  {
    query->setScene(c.state);
    for (int y = 1; y < c.view.model->height(); y += 4)
    {
      for (int x = 1; x < c.view.model->width(); x += 4)
      {
        const Eigen::Vector2d pixel(x + 0.31, y + 0.57);
        std::vector<Hit> hits;
        query->allHits(c.view, pixel, hits);
        std::vector<Hit> expected;
        const std::vector<Met> all = meet(*c.state, c.view, c.view.model->rayThrough(pixel));
        for (const Met& m : all)
        {
          if (m.t >= c.view.near && m.t <= c.view.far)
          {
            expected.push_back(m.hit);
          }
        }
        if (!onEdge(all))
        {
          ++compared;
          ASSERT_EQ(hits, expected) << c.name << " at " << pixel.transpose();
        }
      }
    }
  }
  EXPECT_GT(compared, 1500U);
}

TEST(OcclusionQuery, TheFirstHitIsWhatTheRaySourceSees)
{
  ThreadPool pool(2);
  const auto source = makeRaySource(pool);
  const auto query = makeOcclusionQuery();
  for (const RayCase& c : rayCases())
  {
    source->setScene(c.state, c.view);
    query->setScene(c.state);
    VisibilityBuffer buffer;
    source->render({ 0, 0, c.view.model->width(), c.view.model->height() }, buffer);
    std::vector<Hit> hits;
    for (int y = 0; y < c.view.model->height(); ++y)
    {
      for (int x = 0; x < c.view.model->width(); ++x)
      {
        query->allHits(c.view, { x + 0.5, y + 0.5 }, hits);
        ASSERT_EQ(hits.empty() ? Hit{} : hits.front(), buffer.at(x, y)) << c.name << " at " << x << ", " << y;
      }
    }
  }
}

TEST(OcclusionQuery, ClosedSurfacesAreCrossedAnEvenNumberOfTimes)
{
  const auto query = makeOcclusionQuery();
  const auto scene = SceneBuilder().add(makeSphere()).add(makeBox(), placement({ 0, -3, 0 })).state();
  query->setScene(scene);
  std::vector<Hit> hits;
  // Down the axis: through the sphere's poles, where all segments meet, and diagonals of the box's faces.
  View view = makeView({ 65, 65, 60, { 0, 6, 0 }, { 0, 0, 0 }, { 0, 0, -1 }, 0.1, 1000 });
  query->allHits(view, { 32.5, 32.5 }, hits);
  ASSERT_EQ(hits.size(), 4U);
  EXPECT_EQ(hits[0].object, 1U);
  EXPECT_EQ(hits[1].object, 1U);
  EXPECT_EQ(hits[2].object, 2U);
  EXPECT_EQ(hits[3].object, 2U);
  view = makeView({ 65, 65, 60, { 0, 0, 6 }, { 0, 0, 0 }, { 0, 1, 0 }, 0.1, 1000 });
  // Rows and columns through the middle run along edges of the sphere's grid.
  for (const bool orthographic : { false, true })
  {
    if (orthographic)
    {
      view.model = makeOrthographic(65, 65, 4, 0); // also exactly through the box's sides and corners
    }
    for (int y = 0; y < 65; ++y)
    {
      for (int x = 0; x < 65; ++x)
      {
        query->allHits(view, { x + 0.5, y + 0.5 }, hits);
        EXPECT_EQ(hits.size() % 2, 0U) << x << ", " << y << (orthographic ? " orthographic" : "");
        EXPECT_TRUE(std::adjacent_find(hits.begin(), hits.end()) == hits.end());
      }
    }
  }
}

TEST(OcclusionQuery, CoincidentSurfacesComeInOrderOfIds)
{
  const auto query = makeOcclusionQuery();
  QuadOptions far;
  far.corner = { -1, -1, -1 };
  const auto quad = makeQuad();
  query->setScene(SceneBuilder().add(makeQuad(far)).add(quad).add(quad).state());
  std::vector<Hit> hits;
  query->allHits(makeView(), { 36.1, 22.2 }, hits);
  ASSERT_EQ(hits.size(), 3U);
  EXPECT_EQ(hits[0].object, 2U);
  EXPECT_EQ(hits[1].object, 3U);
  EXPECT_EQ(hits[2].object, 1U);
}

TEST(OcclusionQuery, AWallHidesWhatIsBehindIt)
{
  const auto query = makeOcclusionQuery();
  QuadOptions behind;
  behind.corner = { -1, -1, -2 };
  query->setScene(SceneBuilder().add(makeQuad()).add(makeQuad(behind)).state());
  View view = makeView(); // at z = 5; the first quad at z = 0
  const Hit target{ 2, 0 };
  EXPECT_EQ(query->occluder(view, { 0.3, 0.2, -2 }, target).object, 1U);
  EXPECT_EQ(query->occluder(view, { 0.3, 0.2, 1e-6 }, target).object, 0U) << "before the wall";
  EXPECT_EQ(query->occluder(view, { 0.3, 0.2, -1e-6 }, target).object, 1U) << "behind the wall";
  EXPECT_EQ(query->occluder(view, { 0.3, 0.2, 0 }, target).object, 0U) << "on the wall";
  EXPECT_EQ(query->occluder(view, { 2, 0, -2 }, target).object, 0U) << "beside the wall";
  EXPECT_EQ(query->occluder(view, { 0, 0, 7 }, target).object, 0U) << "behind the camera";
  const Hit wall = query->occluder(view, { 0.3, 0.2, -2 }, target);
  EXPECT_EQ(query->occluder(view, { 0.3, 0.2, -2 }, wall).object, 0U) << "the target hides nothing";
  for (const double inside : { 1e-4, 1e-7, 1e-9, 1e-12 }) // of its edge, where rays beside it are asked as well
  {
    const Eigen::Vector3d point(1.4 * (1 - inside), -0.7, -2);
    const Hit edge = query->occluder(view, point, target);
    EXPECT_EQ(edge.object, 1U) << inside;
    EXPECT_EQ(query->occluder(view, point, edge).object, 0U) << "the target hides nothing " << inside;
  }
  const auto both = makeOcclusionQuery();
  both->setScene(SceneBuilder().add(makeQuad()).add(makeQuad({ { -2, -2, -1 }, { 4, 0, 0 }, { 0, 4, 0 } })).state());
  const Eigen::Vector3d beyond(1.4 * (1 - 1e-7), -0.7, -2);
  const Hit nearer = both->occluder(view, beyond, {});
  EXPECT_EQ(nearer.object, 1U);
  EXPECT_EQ(both->occluder(view, beyond, nearer).object, 2U) << "the next one behind the target";
  view.near = 5.5;
  EXPECT_EQ(query->occluder(view, { 0.3, 0.2, -2 }, target).object, 0U) << "nearer than near";
  view = makeView();
  view.model = makeOrthographic(64, 48, 4, 0);
  EXPECT_EQ(query->occluder(view, { 0.9, 0.2, -2 }, target).object, 1U);
  EXPECT_EQ(query->occluder(view, { 1.1, 0.2, -2 }, target).object, 0U);
  view.model = hideLinear(makePinholeFromFov(64, 48, 45, 0));
  EXPECT_EQ(query->occluder(view, { 0.3, 0.2, -2 }, target).object, 1U);
  EXPECT_EQ(query->occluder(view, { 0.3, 0.2, 0 }, target).object, 0U);
}

// A principal point a million million pixels away: projections are rounded to 1e-4 pixels, 1e-5 units at the point.
TEST(OcclusionQuery, PointsAreLookedAtThroughTheRoundingOfTheirProjection)
{
  Eigen::Matrix3d K;
  K << 100, 0, 1e12, 0, 100, 24, 0, 0, 1;
  View view;
  view.model = makePinhole(64, 48, K);
  view.near = 0.1;
  view.far = 100;
  const auto query = makeOcclusionQuery();
  for (const double x : { 0.0123456, 0.0444444, 0.0777777, 0.1 / 3, 0.2 / 7 })
  {
    for (const bool covers : { false, true })
    {
      // half as far away, with an edge 1e-7 beside the way to the point
      const double edge = 0.5 * x + (covers ? 1e-7 : -1e-7);
      query->setScene(SceneBuilder().add(makeQuad({ { edge - 1, -1, 5 }, { 1, 0, 0 }, { 0, 2, 0 } })).state());
      EXPECT_EQ(query->occluder(view, { x, 0.01, 10 }, {}).object, covers ? 1U : 0U) << x;
    }
  }
}

TEST(OcclusionQuery, ASphereHidesItsOwnBack)
{
  const auto query = makeOcclusionQuery();
  const auto sphere = makeSphere({ { 0, 0, 0 }, 1, 40, 80 });
  for (const Eigen::Vector3d& offset : { Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(1e6, 0, -1e6) })
  {
    const auto state = SceneBuilder().add(sphere, placement(offset)).state();
    query->setScene(state);
    ViewOptions options;
    options.eye = offset + Eigen::Vector3d(0, 0, 5);
    options.lookAt = offset;
    const View view = makeView(options);
    for (std::uint32_t triangle = 0; triangle < sphere->triangles.size(); triangle += 7)
    {
      Eigen::Vector3d x[3];
      triangleInWorld(*state, { 1, triangle }, x);
      const Eigen::Vector3d e1 = x[1] - x[0];
      const Eigen::Vector3d e2 = x[2] - x[0];
      const Eigen::Vector3d n(
        e1.y() * e2.z() - e1.z() * e2.y(), e1.z() * e2.x() - e1.x() * e2.z(), e1.x() * e2.y() - e1.y() * e2.x());
      if (n.norm() < 1e-9)
      {
        continue; // at a pole
      }
      const double facing = n.normalized().dot((options.eye - x[0]).normalized());
      if (std::abs(facing) < 0.15)
      {
        continue; // its corners may be on the silhouette
      }
      const bool faces = facing > 0;
      for (const double w : { 0.3, 1e-3, 1e-7, 0.0 }) // towards a corner
      {
        const Eigen::Vector3d point = x[0] + w * e1 + w * e2;
        EXPECT_EQ(query->occluder(view, point, { 1, triangle }).object, faces ? 0U : 1U)
          << "triangle " << triangle << ", " << w;
      }
    }
  }
}

TEST(OcclusionQuery, WhatAViewSeesNothingHides)
{
  ThreadPool pool(2);
  const auto source = makeRaySource(pool);
  const auto query = makeOcclusionQuery();
  for (const RayCase& c : rayCases())
  {
    source->setScene(c.state, c.view);
    query->setScene(c.state);
    const PixelRect rect{ 0, 0, c.view.model->width(), c.view.model->height() };
    VisibilityBuffer buffer;
    source->render(rect, buffer);
    SurfaceRows rows;
    computeSurfaceRows(*c.state, c.view, rect, buffer.hits.data(), false, rows);
    int hidden = 0;
    for (std::size_t i = 0; i < buffer.hits.size(); ++i)
    {
      if (buffer.hits[i].object != 0)
      {
        const CameraRay ray = c.view.model->rayThrough({ double(i % rect.width) + 0.5, double(i / rect.width) + 0.5 });
        const Eigen::Vector3d x = ray.origin + rows.t[i] * ray.direction;
        const Hit by = query->occluder(c.view, c.view.camera_from_world.inverse() * x, buffer.hits[i]);
        hidden += by.object != 0;
      }
    }
    EXPECT_EQ(hidden, 0) << c.name;
  }
}

TEST(OcclusionQuery, OccludersOfAnotherViewAreThoseOfEveryTriangle)
{
  ThreadPool pool(2);
  const auto source = makeRaySource(pool);
  const auto query = makeOcclusionQuery();
  std::size_t compared = 0;
  std::size_t hidden = 0;
  for (const RayCase& c : rayCases())
  {
    if (c.name == "telephoto" || c.name == "far from the origin")
    {
      continue; // nothing else is in sight; rounding of the points
    }
    source->setScene(c.state, c.view);
    query->setScene(c.state);
    const PixelRect rect{ 0, 0, c.view.model->width(), c.view.model->height() };
    VisibilityBuffer buffer;
    source->render(rect, buffer);
    SurfaceRows rows;
    computeSurfaceRows(*c.state, c.view, rect, buffer.hits.data(), false, rows);
    View other = c.view;
    other.camera_from_world = lookAtPose({ 3, 4, 3.5 }, { 0, 0, 0 }, { 0, 1, 0 });
    std::vector<Eigen::Vector3d> points;
    std::vector<Hit> targets;
    std::vector<Hit> alone;
    for (std::size_t i = 0; i < buffer.hits.size(); i += 13)
    {
      if (buffer.hits[i].object == 0)
      {
        continue;
      }
      const CameraRay seen = c.view.model->rayThrough({ double(i % rect.width) + 0.5, double(i / rect.width) + 0.5 });
      const Eigen::Vector3d x = c.view.camera_from_world.inverse() * (seen.origin + rows.t[i] * seen.direction);
      points.push_back(x);
      targets.push_back(buffer.hits[i]);
      alone.push_back(query->occluder(other, x, buffer.hits[i]));
      const Eigen::Vector3d x_in_other = other.camera_from_world * x;
      Eigen::Vector2d pixel;
      if (!other.model->project(x_in_other, pixel))
      {
        continue;
      }
      const CameraRay ray = other.model->rayThrough(pixel);
      const double t = (x_in_other - ray.origin).dot(ray.direction) / ray.direction.squaredNorm();
      const std::vector<Met> all = meet(*c.state, other, ray);
      const auto first = std::find_if(
        all.begin(), all.end(), [&](const Met& m) { return m.t >= other.near && m.hit != buffer.hits[i]; });
      if (onEdge(all) || (first != all.end() && std::abs(double(first->t) - t) < 1e-7 * t))
      {
        continue;
      }
      const Hit expected = first != all.end() && first->t < t ? first->hit : Hit{};
      ++compared;
      hidden += expected.object != 0;
      EXPECT_EQ(alone.back(), expected) << c.name << " at " << i;
    }
    for (const std::size_t together :
      { std::size_t(1), std::size_t(2), std::size_t(16), std::size_t(17), points.size() })
    {
      std::vector<Hit> found(points.size());
      for (std::size_t first = 0; first < points.size(); first += together)
      {
        query->occluders(
          other, &points[first], &targets[first], std::min(together, points.size() - first), &found[first]);
      }
      for (std::size_t i = 0; i < found.size(); ++i)
      {
        EXPECT_EQ(found[i].object, alone[i].object) << c.name << ' ' << i << " of " << together << " together";
        EXPECT_EQ(found[i].triangle, alone[i].triangle) << c.name << ' ' << i << " of " << together << " together";
      }
    }
  }
  EXPECT_GT(compared, 1000U);
  EXPECT_GT(hidden, 200U);
}

TEST(OcclusionQuery, AllHitsOfManyPixelsAreThoseOfEach)
{
  const auto query = makeOcclusionQuery();
  std::size_t several = 0;
  for (const RayCase& c : rayCases())
  {
    query->setScene(c.state);
    std::vector<Eigen::Vector2d> pixels;
    pixels.reserve(500);
    for (int i = 0; i < 500; ++i)
    {
      pixels.emplace_back(0.5 + 0.37 * (i % 100), 0.5 + 7.3 * (i / 100));
    }
    std::vector<std::vector<Hit>> alone(pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i)
    {
      query->allHits(c.view, pixels[i], alone[i]);
      several += alone[i].size() > 1;
    }
    for (const std::size_t together :
      { std::size_t(1), std::size_t(15), std::size_t(16), std::size_t(33), pixels.size() })
    {
      std::vector<std::vector<Hit>> found(pixels.size(), { Hit{ 9, 9 } });
      for (std::size_t first = 0; first < pixels.size(); first += together)
      {
        query->allHits(c.view, &pixels[first], std::min(together, pixels.size() - first), &found[first]);
      }
      for (std::size_t i = 0; i < pixels.size(); ++i)
      {
        EXPECT_TRUE(found[i] == alone[i]) << c.name << ' ' << i << " of " << together << " together";
      }
    }
  }
  EXPECT_GT(several, 500U);
}

TEST(OcclusionQuery, ThreadsMayAskForDifferentViews)
{
  const RayCase c = rayCases().front();
  const auto query = makeOcclusionQuery();
  query->setScene(c.state);
  std::vector<std::vector<Hit>> expected(400);
  const auto viewOf = [&](int i)
  {
    View view = c.view;
    view.camera_from_world.translation.x() += 0.01 * (i % 40); // more poses than are kept
    return view;
  };
  for (int i = 0; i < 400; ++i)
  {
    query->allHits(viewOf(i), { 20.5 + 0.05 * i, 24.5 }, expected[i]);
  }
  ThreadPool pool(4);
  pool.parallelFor(400,
    [&](int i)
    {
      std::vector<Hit> hits;
      query->allHits(viewOf(i), { 20.5 + 0.05 * i, 24.5 }, hits);
      EXPECT_EQ(hits, expected[i]);
      query->occluder(viewOf(i), { 0, 0, -3 }, hit(1, 0));
    });
}
