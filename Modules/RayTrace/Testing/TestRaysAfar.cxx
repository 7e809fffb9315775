// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRaySource.h"
#include "dgtkShadowQuery.h"

#include "dgtkRayTestScenes.h"
#include "dgtkThreadPool.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>

namespace
{
using namespace dgtk;
using namespace dgtk::test;

std::shared_ptr<SceneState> scaledState(double unit)
{
  std::shared_ptr<SceneState> state = mixedScene();
  for (Instance& instance : state->instances)
  {
    instance.world_from_object.linear *= unit;
    instance.world_from_object.translation *= unit;
  }
  return state;
}

View scaledView(double unit)
{
  ViewOptions options{ 64, 48, 50, unit * Eigen::Vector3d(0.4, 0.8, 5) };
  options.near = 0.1 * unit;
  options.far = 1000 * unit;
  return makeView(options);
}

/// Telescopes for which single precision is a pixel off, and twenty; lengths that it cannot hold.
std::vector<RayCase> casesBeyondSingle()
{
  std::vector<RayCase> cases;
  const Eigen::Vector3d away(0.43, 0.9, 0.13);
  for (const double distance : { 5e4, 1e6 })
  {
    const std::string from = " from " + std::to_string(distance);
    ViewOptions options{ 64, 48, 250 / distance, distance * away };
    options.far = 10 * distance;
    const View view = makeView(options);
    cases.push_back({ "mixed" + from, mixedScene(), view, view });
    cases.push_back({ "lens" + from, cutOutScene(), withModel(view, hideLinear(view.model)), view });
    const View parallel = withModel(view, makeOrthographic(64, 48, 4.2, 0));
    cases.push_back({ "orthographic" + from, mixedScene(), parallel, parallel });
    SceneBuilder deep;
    deep.add(makeSphere({ { 0, 0, 0 }, 1, 12, 20 }), placement(0.99999 * distance * away + away.unitOrthogonal()));
    deep.add(makeSoup({ 1500, 1.5, 0.4, 3 }));
    deep.add(makeBox(), placement(-distance * away, 1.5));
    cases.push_back({ "near and far" + from, deep.state(), view, view });
  }
  for (const double unit : { 1e-60, 1e-16, 1e-13, 1e13, 1e24 })
  {
    const View view = scaledView(unit);
    cases.push_back({ "unit 1e" + std::to_string(std::log10(unit)), scaledState(unit), view, view });
  }
  SceneBuilder both; // one that single precision can hold, in front of one that it cannot
  both.add(makeBox(), scaled({ 1e14, 1e14, 1e13 }, { 0, 0, -1e14 }));
  both.add(makeSphere({ { 0, 0, 0 }, 1, 12, 20 }));
  ViewOptions options;
  options.far = 1e15;
  const View view = makeView(options);
  cases.push_back({ "small before large", both.state(), view, view });
  return cases;
}

VisibilityBuffer seenAfar(VisibilitySource& source, const RayCase& c)
{
  source.setScene(c.state, c.view);
  VisibilityBuffer buffer;
  source.render({ 0, 0, c.view.model->width(), c.view.model->height() }, buffer);
  return buffer;
}

/// Pixels: double precision decides about rays that are nearer to an edge.
constexpr double afarReach = 1e-6;
} // namespace

TEST(RaysAfar, AViewSeesWhatTryingEveryTriangleSees)
{
  ThreadPool pool(2);
  const auto source = makeRaySource(pool);
  const auto query = makeOcclusionQuery();
  for (const RayCase& c : casesBeyondSingle())
  {
    const VisibilityBuffer reference = bruteForce(*c.state, c.view);
    const VisibilityBuffer buffer = seenAfar(*source, c);
    query->setScene(c.state);
    EXPECT_GT(
      std::count_if(reference.hits.begin(), reference.hits.end(), [](const Hit& h) { return h.object != 0; }), 300)
      << c.name;
    std::vector<Hit> all;
    for (int y = 0; y < c.view.model->height(); ++y)
    {
      for (int x = 0; x < c.view.model->width(); ++x)
      {
        const Hit hit = buffer.at(x, y);
        for (const Hit& other : { hit, reference.at(x, y) })
        {
          if (hit != reference.at(x, y) && other.object != 0)
          {
            ASSERT_LE(edgeDistance(*c.state, c.linearView, other, { x + 0.5, y + 0.5 }), afarReach)
              << c.name << " at " << x << ", " << y;
            break;
          }
        }
        query->allHits(c.view, { x + 0.5, y + 0.5 }, all);
        ASSERT_EQ(all.empty() ? Hit{} : all.front(), hit) << c.name << " at " << x << ", " << y;
      }
    }
  }
}

TEST(RaysAfar, OnlyWhatStandsBeforeAPointHidesIt)
{
  const auto query = makeOcclusionQuery();
  for (const double distance : { 5e4, 1e7 })
  {
    // Panes side by side in every other place, half a unit before a wall.
    constexpr double width = 0.05;
    SceneBuilder scene;
    scene.add(makeQuad({ { -8, -8, 0 }, { 16, 0, 0 }, { 0, 16, 0 } }));
    const auto pane = makeQuad({ { 0, -8, 0.5 }, { width, 0, 0 }, { 0, 16, 0 } });
    constexpr int places = 80;
    for (int i = 0; i < places; i += 2)
    {
      scene.add(pane, placement({ i * width, 0, 0 }));
    }
    query->setScene(scene.state());
    const View view = makeView({ 64, 64, 900 / distance, { 0, 0, distance }, { 0, 0, 0 }, { 0, 1, 0 }, 1, 2e7 });
    for (int i = 0; i < places; ++i)
    {
      for (const double part : { 0.25, 0.75 })
      {
        const Hit by = query->occluder(view, { (i + part) * width, 0.3, 0 }, { 1, 0 });
        EXPECT_EQ(by.object, i % 2 == 0 ? std::uint32_t(i / 2 + 2) : 0) << distance << ' ' << i + part;
      }
    }
  }
}

TEST(RaysAfar, LengthsBeyondSinglePrecisionCastShadows)
{
  for (const double unit : { 1e-16, 1.0, 1e14 })
  {
    SceneBuilder scene;
    scene.add(makeQuad(), scaled({ unit, unit, unit }, { 0, 0, 0 }));
    const auto query = makeShadowQuery(scene.state(), {});
    const Eigen::Vector3d up(0, 0, 1);
    const LightPath paths[] = { { unit * Eigen::Vector3d(0.3, 0.4, -1), up },
      { unit * Eigen::Vector3d(1.3, 0.4, -1), up }, { unit * Eigen::Vector3d(0.3, 0.4, 1), up },
      { unit * Eigen::Vector3d(0.3, 0.4, -1), up, 0.5 * unit } };
    EXPECT_EQ(query->blocked(paths, 4), 1U) << unit;
  }
}

// A scene that was placed for Embree once, and is not any more, and again.
TEST(RaysAfar, ScenesMayComeAndGoInAnyUnit)
{
  ThreadPool pool(1);
  const auto source = makeRaySource(pool);
  const View plain = scaledView(1);
  const auto expected = seenAfar(*source, { "", scaledState(1), plain, plain }).hits;
  for (const double unit : { 1e-16, 1.0, 1e13, 1e-16, 1.0, 8.0 })
  {
    const View view = scaledView(unit);
    const auto hits = seenAfar(*source, { "", scaledState(unit), view, view }).hits;
    std::size_t differing = 0;
    for (std::size_t i = 0; i < hits.size(); ++i)
    {
      differing += hits[i] != expected[i];
    }
    EXPECT_LE(differing, hits.size() / 50) << unit; // on edges
  }
}
