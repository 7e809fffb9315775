// SPDX-License-Identifier: BSD-3-Clause
// Rays that run along a plane of an instance's axes but for a rounding: the middle of a picture that has an odd size.
#include "dgtkRaySource.h"

#include "dgtkRayTestScenes.h"
#include "dgtkThreadPool.h"

#include <gtest/gtest.h>

#include <algorithm>

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
