// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRaySource.h"

#include "dgtkRayTestScenes.h"
#include "dgtkThreadPool.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

namespace
{
using namespace dgtk;
using namespace dgtk::test;

/// Pixels: a ray this close to an edge may fall on either side in double precision.
constexpr double edgeReach = 1e-6;

VisibilityBuffer traceSource(VisibilitySource& source, std::shared_ptr<const SceneState> state, const View& view)
{
  source.setScene(std::move(state), view);
  VisibilityBuffer buffer;
  source.render({ 0, 0, view.model->width(), view.model->height() }, buffer);
  return buffer;
}

/// Expects the same ids but for pixels on an edge; returns how many differ.
int compare(const RayCase& c, const VisibilityBuffer& rays, const VisibilityBuffer& reference)
{
  int differing = 0;
  for (int y = 0; y < c.view.model->height(); ++y)
  {
    for (int x = 0; x < c.view.model->width(); ++x)
    {
      if (rays.at(x, y) == reference.at(x, y))
      {
        continue;
      }
      ++differing;
      double distance = INFINITY;
      for (const Hit& hit : { rays.at(x, y), reference.at(x, y) })
      {
        if (hit.object != 0)
        {
          distance = std::min(distance, edgeDistance(*c.state, c.linearView, hit, { x + 0.5, y + 0.5 }));
        }
      }
      EXPECT_LE(distance, edgeReach) << c.name << " at " << x << ", " << y << ": rays " << rays.at(x, y).object << ":"
                                     << rays.at(x, y).triangle << ", reference " << reference.at(x, y).object << ":"
                                     << reference.at(x, y).triangle;
    }
  }
  return differing;
}

std::size_t surfaces(const VisibilityBuffer& buffer)
{
  return std::size_t(
    std::count_if(buffer.hits.begin(), buffer.hits.end(), [](const Hit& hit) { return hit.object != 0; }));
}
} // namespace

TEST(RaySource, SeesWhatTryingEveryTriangleSees)
{
  ThreadPool pool(2);
  const auto source = makeRaySource(pool);
  EXPECT_EQ(source->name(), "ray");
  for (const RayCase& c : rayCases())
  {
    const VisibilityBuffer reference = bruteForce(*c.state, c.view);
    ASSERT_GT(surfaces(reference), reference.hits.size() / 20) << c.name;
    const int differing = compare(c, traceSource(*source, c.state, c.view), reference);
    std::printf("%s: %d of %zu pixels differ, all on edges\n", c.name.c_str(), differing, reference.hits.size());
    EXPECT_LE(differing, int(reference.hits.size() / 50)) << c.name;
  }
}

TEST(RaySource, CutOutsAndClippingChangeThePicture)
{
  ThreadPool pool(1);
  const auto source = makeRaySource(pool);
  const View view = makeView();
  const auto leaf = makeQuad();
  const auto solid = SceneBuilder().add(leaf).state();
  const std::size_t whole = surfaces(traceSource(*source, solid, view));
  const auto holes = makeQuad();
  addCutOut(*holes, 16, 7);
  const std::size_t some = surfaces(traceSource(*source, SceneBuilder().add(holes).state(), view));
  EXPECT_GT(some, whole / 4);
  EXPECT_LT(some, whole * 3 / 4);
  // The scene's own materials decide: without the cut-out everything is there.
  auto overridden = SceneBuilder().add(holes).state();
  overridden->instances[0].materials = std::make_shared<std::vector<Material>>(leaf->materials);
  EXPECT_EQ(surfaces(traceSource(*source, overridden, view)), whole);
  View behind = view;
  behind.near = 5.001; // the quad is at depth 5
  EXPECT_EQ(surfaces(traceSource(*source, solid, behind)), 0U);
  View before = view;
  before.far = 4.999;
  EXPECT_EQ(surfaces(traceSource(*source, solid, before)), 0U);
}

TEST(RaySource, EmptySceneAndEmptyModelsShowNothing)
{
  ThreadPool pool(1);
  const auto source = makeRaySource(pool);
  const View view = makeView();
  EXPECT_EQ(surfaces(traceSource(*source, std::make_shared<SceneState>(), view)), 0U);
  auto nothing = std::make_shared<Model>();
  nothing->rest = std::make_shared<Geometry>();
  EXPECT_EQ(surfaces(traceSource(*source, SceneBuilder().add(nothing).state(), view)), 0U);
  const auto both = SceneBuilder().add(nothing).add(makeQuad()).state();
  const VisibilityBuffer buffer = traceSource(*source, both, view);
  EXPECT_GT(surfaces(buffer), 0U);
  EXPECT_EQ(buffer.at(32, 24).object, 2U);
  auto lost = SceneBuilder().add(makeQuad()).state();
  lost->instances[0].world_from_object.translation.x() = NAN;
  EXPECT_EQ(surfaces(traceSource(*source, lost, view)), 0U);
}

TEST(RaySource, TrianglesWithoutAreaAreNeverHit)
{
  ThreadPool pool(1);
  const auto source = makeRaySource(pool);
  auto model = std::make_shared<Model>(*makeQuad());
  auto geometry = std::make_shared<Geometry>(*model->rest);
  geometry->positions = { { -1, 0.01, 0 }, { 1, 0.01, 0 }, { 0, 0.01, 0 }, { 0.3, 0.01, 0 } };
  model->rest = geometry;
  model->triangles = { { 0, 1, 2 }, { 0, 0, 1 }, { 3, 3, 3 } };
  model->parts[0].triangles = 3;
  EXPECT_EQ(surfaces(traceSource(*source, SceneBuilder().add(model).state(), makeView())), 0U);
}

TEST(RaySource, OfCoincidentSurfacesTheLowestIdIsSeen)
{
  ThreadPool pool(2);
  const auto source = makeRaySource(pool);
  const View view = makeView({ 64, 48, 45, { 0.3, 0.2, 4 }, { 0, 0, 0 }, { 0, 1, 0 }, 0.1, 1000 });
  QuadOptions fine;
  fine.cellsU = 7;
  fine.cellsV = 5;
  const auto doubled = std::make_shared<Model>(*makeSphere({ { 0, 0, 0 }, 1, 12, 20 }));
  const std::size_t count = doubled->triangles.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto t = doubled->triangles[i];
    doubled->triangles.push_back({ t[0], t[2], t[1] });
  }
  doubled->parts[0].triangles = std::uint32_t(2 * count);
  const auto coarse = makeQuad();
  const auto tiles = makeQuad(fine);
  const auto sphere = makeSphere({ { 0, 0, 0 }, 1, 12, 20 });
  const Affine3 turned = placement({ 0.1, 0, 0 }, 1.3, { 1, 1, 0 }, 0.6);
  const std::vector<RayCase> cases = { { "coarse, fine", SceneBuilder().add(coarse).add(tiles).state(), view, view },
    { "fine, coarse", SceneBuilder().add(tiles).add(coarse).state(), view, view },
    { "turned", SceneBuilder().add(tiles, turned).add(coarse, turned).state(), view, view },
    { "turned, other way", SceneBuilder().add(coarse, turned).add(tiles, turned).state(), view, view },
    { "the same twice", SceneBuilder().add(sphere, turned).add(sphere, turned).state(), view, view },
    { "triangles from both sides", SceneBuilder().add(doubled).state(), view, view } };
  for (const RayCase& c : cases)
  {
    const VisibilityBuffer buffer = traceSource(*source, c.state, c.view);
    EXPECT_GT(surfaces(buffer), 500U) << c.name;
    int other = 0;
    for (const Hit& hit : buffer.hits)
    {
      other += hit.object > 1 || (hit.object == 1 && c.state->instances[0].model == doubled && hit.triangle >= count);
    }
    EXPECT_EQ(other, 0) << c.name;
    compare(c, buffer, bruteForce(*c.state, c.view));
  }
}

/// A few pixels of a picture, which say nothing of themselves elsewhere.
TEST(RaySource, OfAFewCoincidentPixelsTheLowestIdIsSeen)
{
  ThreadPool pool(2);
  const auto source = makeRaySource(pool);
  const View view = makeView({ 96, 96, 45, { 0.3, 0.2, 4 }, { 0, 0, 0 }, { 0, 1, 0 }, 0.1, 1000 });
  const auto quad = makeQuad();
  for (int i = 0; i < 40; ++i)
  {
    // On the same plane, one of them 2 pixels wide.
    const Eigen::Vector3d at(0.013 * i, 0.007 * i, 0.1);
    const Affine3 large = placement(at, 0.8, { 1, 1, 0 }, 0.7);
    const Affine3 small = placement(at, 0.03, { 1, 1, 0 }, 0.7);
    const auto state = SceneBuilder().add(quad, small).add(quad, large).state();
    compare({ "small, large", state, view, view }, traceSource(*source, state, view), bruteForce(*state, view));
    const auto other = SceneBuilder().add(quad, large).add(quad, small).state();
    const VisibilityBuffer buffer = traceSource(*source, other, view);
    EXPECT_EQ(std::count_if(buffer.hits.begin(), buffer.hits.end(), [](const Hit& hit) { return hit.object == 2; }), 0);
  }
}

TEST(RaySource, ThousandInstances)
{
  ThreadPool pool(2);
  const auto source = makeRaySource(pool);
  const auto box = makeBox();
  SceneBuilder scene;
  for (int i = 0; i < 1000; ++i)
  {
    scene.add(box, placement({ i % 40 - 20.0, -1.0 - i % 3, -(i / 40) - 4.0 }, 0.3, { 1, double(i % 7), 2 }, 0.01 * i));
  }
  const View view = makeView({ 48, 36, 60, { 0, 3, 2 }, { 0, -1, -12 }, { 0, 1, 0 }, 0.1, 1000 });
  const RayCase c{ "instances", scene.state(), view, view };
  const VisibilityBuffer reference = bruteForce(*c.state, view);
  EXPECT_GT(surfaces(reference), 300U);
  compare(c, traceSource(*source, c.state, view), reference);
}

TEST(RaySource, BareRaysDifferOnEdgesOnly)
{
  constexpr double singlePrecision = 1.0 / 128; // pixels
  ThreadPool pool(2);
  const auto source = makeBareRaySource(pool);
  const RayCase c = rayCases().front();
  const VisibilityBuffer reference = bruteForce(*c.state, c.view);
  const VisibilityBuffer rays = traceSource(*source, c.state, c.view);
  for (int y = 0; y < 48; ++y)
  {
    for (int x = 0; x < 64; ++x)
    {
      for (const Hit& hit : { rays.at(x, y), reference.at(x, y) })
      {
        if (rays.at(x, y) != reference.at(x, y) && hit.object != 0)
        {
          EXPECT_LE(edgeDistance(*c.state, c.view, hit, { x + 0.5, y + 0.5 }), singlePrecision) << x << ", " << y;
          break;
        }
      }
    }
  }
}

// As in the raster engine: between near and far means both included. The numbers are exact.
TEST(RaySource, SurfacesAtNearAndAtFarAreSeen)
{
  const auto state = SceneBuilder().add(makeQuad({ { -1, -1, 5 }, { 2, 0, 0 }, { 0, 2, 0 } })).state();
  ThreadPool pool(1);
  const auto source = makeRaySource(pool);
  for (const double shift : { 0.0, 1e-9, -1e-9 })
  {
    for (const bool atFar : { false, true })
    {
      View view = makeView();
      view.camera_from_world = Rigid3();
      view.near = atFar ? 0.1 : 5 + shift;
      view.far = atFar ? 5 + shift : 100;
      const bool seen = atFar ? shift >= 0 : shift <= 0;
      EXPECT_EQ(traceSource(*source, state, view).at(30, 25).object, seen ? 1u : 0u) << shift << ' ' << atFar;
    }
  }
}

// Single precision finds such surfaces anywhere around the place at which rays meet them.
TEST(RaySource, NothingNearerThanNearIsSeenAtGrazingAngles)
{
  ThreadPool pool(1);
  const auto source = makeRaySource(pool);
  View view = makeView();
  view.camera_from_world = Rigid3();
  view.near = 1;
  view.far = 100;
  for (int row = 0; row < view.model->height(); row += 3)
  {
    const Eigen::Vector3d direction = view.model->rayThrough({ 30.5, row + 0.5 }).direction;
    for (const double angle : { 1e-3, 1e-4, 1e-5 })
    {
      for (const double met : { 0.9995, 0.99998 })
      {
        const double slope = direction.y() / direction.z() - angle;
        const Eigen::Vector3d first(-50, slope * 0.3 + angle * met, 0.3);
        const auto state = SceneBuilder().add(makeQuad({ first, { 100, 0, 0 }, { 0, 60 * slope, 60 } })).state();
        const VisibilityBuffer buffer = traceSource(*source, state, view);
        for (int x = 0; x < view.model->width(); ++x)
        {
          EXPECT_EQ(buffer.at(x, row).object, 0u) << row << ' ' << x << ' ' << angle << ' ' << met;
        }
      }
    }
  }
}
