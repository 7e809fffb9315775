// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSyntheticScene.h"
#include "dgtkThreadPool.h"

#include <gtest/gtest.h>

#include <random>

using namespace dgtk::test;

namespace
{

std::size_t differences(const dgtk::VisibilityBuffer& a, const dgtk::VisibilityBuffer& b)
{
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.hits.size(); ++i)
  {
    count += a.hits[i] != b.hits[i];
  }
  return count;
}

std::shared_ptr<dgtk::SceneState> mixedScene()
{
  return SceneBuilder()
    .add(makeSphere({ { 0, 0, 0 }, 1.1, 12, 20 }))
    .add(makeQuad({ { -40, -1, -40 }, { 80, 0, 0 }, { 0, 0, 80 }, 8, 8 }))
    .add(makeBox(), placement({ 1, 0.3, -1 }, 0.8, { 1, 1, 0 }, 0.7))
    .add(makeSoup({ 60, 1.5, 0.4, 9 }), placement({ -1, 1, 0 }))
    .state();
}

/// Gives pixels whose centre is within `distance` pixels of an edge the hit of a random neighbour.
std::size_t disturb(const dgtk::SceneState& state, const dgtk::View& view, double distance,
  const dgtk::VisibilityBuffer& exact, dgtk::VisibilityBuffer& buffer)
{
  std::mt19937 random(3);
  std::size_t disturbed = 0;
  const int width = exact.rect.width;
  for (int y = 1; y < exact.rect.height - 1; ++y)
  {
    for (int x = 1; x < width - 1; ++x)
    {
      const dgtk::Hit neighbour = exact.at(x - 1 + int(random() % 3), y - 1 + int(random() % 3));
      const dgtk::Hit own = exact.at(x, y);
      if (own.object && neighbour.object && neighbour != own &&
          edgeDistance(state, view, own, { x + 0.5, y + 0.5 }) < distance &&
          edgeDistance(state, view, neighbour, { x + 0.5, y + 0.5 }) < distance)
      {
        buffer.at(x, y) = neighbour;
        ++disturbed;
      }
    }
  }
  return disturbed;
}
} // namespace

TEST(SettleEdges, LeavesAnExactBufferAlone)
{
  const auto state = mixedScene();
  dgtk::View view = makeView({ 160, 120, 45, { 2, 2, 5 }, { 0, 0, 0 }, { 0, 1, 0 }, 0.1, 100 });
  for (const auto& model : { dgtk::makePinholeFromFov(160, 120, 45, 0), dgtk::makeOrthographic(160, 120, 5, 0),
         hideLinear(dgtk::makePinholeFromFov(160, 120, 45, 0)), hideLinear(dgtk::makeOrthographic(160, 120, 5, 0)) })
  {
    view.model = model;
    const dgtk::VisibilityBuffer exact = bruteForce(*state, view);
    for (const bool grazingOnly : { false, true })
    {
      dgtk::VisibilityBuffer buffer = exact;
      EXPECT_EQ(dgtk::settleEdges(*state, view, buffer, grazingOnly), 0u);
      EXPECT_EQ(differences(buffer, exact), 0u);
    }
  }
}

TEST(SettleEdges, RestoresPixelsThatARoundingErrorMoved)
{
  const auto state = mixedScene();
  dgtk::View view = makeView({ 320, 240, 45, { 2, 2, 5 }, { 0, 0, 0 }, { 0, 1, 0 }, 0.1, 100 });
  for (const bool lens : { false, true })
  {
    const dgtk::VisibilityBuffer exact = bruteForce(*state, view);
    dgtk::VisibilityBuffer buffer = exact;
    const std::size_t disturbed = disturb(*state, view, 1.0 / 64, exact, buffer);
    EXPECT_GT(disturbed, 50u);
    // A disturbed pixel comes back where its own triangle is still recorded beside it.
    std::size_t lost = 0;
    dgtk::VisibilityBuffer settled = buffer;
    view.model = lens ? hideLinear(view.model) : view.model;
    dgtk::settleEdges(*state, view, settled, false);
    for (int y = 0; y < 240; ++y)
    {
      for (int x = 0; x < 320; ++x)
      {
        bool recorded = false;
        for (int dy = -1; dy <= 1; ++dy)
        {
          for (int dx = -1; dx <= 1; ++dx)
          {
            const bool inside = x + dx >= 0 && y + dy >= 0 && x + dx < 320 && y + dy < 240;
            recorded |= inside && buffer.at(x + dx, y + dy) == exact.at(x, y);
          }
        }
        lost += settled.at(x, y) != exact.at(x, y) && recorded;
      }
    }
    EXPECT_EQ(lost, 0u);
  }
}

TEST(SettleEdges, FillsBackgroundBesideASurface)
{
  const auto state = SceneBuilder().add(makeQuad()).state();
  const dgtk::View view = makeView();
  const dgtk::VisibilityBuffer exact = bruteForce(*state, view);
  dgtk::VisibilityBuffer buffer = exact;
  std::size_t removed = 0;
  for (int y = 1; y < 47; ++y)
  {
    for (int x = 1; x < 63; ++x)
    {
      if (exact.at(x, y).object && !exact.at(x - 1, y).object)
      {
        buffer.at(x, y) = {};
        ++removed;
      }
    }
  }
  EXPECT_GT(removed, 10u);
  dgtk::VisibilityBuffer raster = buffer;
  EXPECT_EQ(dgtk::settleEdges(*state, view, raster, true), 0u);
  dgtk::settleEdges(*state, view, buffer, false);
  EXPECT_LE(differences(buffer, exact), 1u); // the pixel on the diagonal has no neighbour of its triangle left
}

TEST(SettleEdges, TakesTheNearerOfTwoThatContainTheCentre)
{
  const auto state = SceneBuilder()
                       .add(makeQuad({ { -9, -9, 0 }, { 18, 0, 0 }, { 0, 18, 0 }, 1, 1 }))
                       .add(makeQuad({ { 0, -1, 1 }, { 1, 0, 0 }, { 0, 2, 0 }, 1, 1 }))
                       .state();
  ViewOptions options;
  options.width = 65; // the quad's left edge goes through the centres of column 32
  const dgtk::View view = makeView(options);
  const dgtk::VisibilityBuffer exact = bruteForce(*state, view);
  ASSERT_EQ(exact.at(32, 30).object, 2u);
  dgtk::VisibilityBuffer buffer = exact;
  buffer.at(32, 30) = exact.at(31, 30);
  // The far quad's triangle contains the centre deep inside: not looked at.
  EXPECT_EQ(dgtk::settleEdges(*state, view, buffer, false), 0u);
  // A pixel recorded as the near one just outside its edge goes to the far one.
  buffer = exact;
  buffer.at(31, 30) = exact.at(32, 30);
  EXPECT_EQ(dgtk::settleEdges(*state, view, buffer, false), 1u);
  EXPECT_EQ(buffer.at(31, 30), exact.at(31, 30));
}

TEST(SettleEdges, CoincidentSurfacesGoToTheLowestObject)
{
  const auto quad = makeQuad({ { -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1 });
  const auto state = SceneBuilder().add(quad).add(quad).state();
  ViewOptions options;
  options.width = options.height = 48; // the diagonal goes through the centres of pixels
  const dgtk::View view = makeView(options);
  dgtk::VisibilityBuffer buffer = bruteForce(*state, view);
  for (const int i : { 20, 22, 24 })
  {
    buffer.at(i, 47 - i) = { 2, 1 };
  }
  dgtk::settleEdges(*state, view, buffer, false);
  for (const int i : { 20, 22, 24 })
  {
    EXPECT_EQ(buffer.at(i, 47 - i), (dgtk::Hit{ 1, 0 }));
  }
}

TEST(SettleEdges, RemovesImpossibleDepths)
{
  // A plane that is seen edge on but for a breath: beside it its plane is anywhere.
  const auto state = SceneBuilder().add(makeQuad({ { 0, -1, -50 }, { 1e-4, 0, 49 }, { 0, 2, 0 }, 1, 1 })).state();
  ViewOptions options;
  options.width = 64;
  const dgtk::View view = makeView(options);
  for (const bool grazingOnly : { false, true })
  {
    dgtk::VisibilityBuffer buffer;
    buffer.resize({ 0, 0, 64, 48 });
    buffer.at(31, 24) = { 1, 0 };
    EXPECT_EQ(dgtk::settleEdges(*state, view, buffer, grazingOnly), 1u);
    EXPECT_EQ(buffer.at(31, 24).object, 0u);
  }
}

TEST(SettleEdges, KeepsAHitWithAPossibleDepth)
{
  const auto state = SceneBuilder().add(makeQuad()).state();
  const dgtk::View view = makeView();
  const dgtk::VisibilityBuffer exact = bruteForce(*state, view);
  for (const bool grazingOnly : { false, true })
  {
    dgtk::VisibilityBuffer buffer = exact;
    int x = 0;
    while (!exact.at(x + 1, 24).object && x < 62)
    {
      ++x;
    }
    ASSERT_LT(x, 62);
    buffer.at(x, 24) = exact.at(x + 1, 24); // outside of the quad, in its plane
    EXPECT_EQ(dgtk::settleEdges(*state, view, buffer, grazingOnly), 0u);
  }
}

TEST(SettleEdges, RespectsNearAndFar)
{
  const auto state = SceneBuilder()
                       .add(makeQuad({ { -1, -1, 0 }, { 1, 0, 0 }, { 0, 2, 0 }, 1, 1 }))
                       .add(makeQuad({ { 0, -1, 1 }, { 1, 0, 0 }, { 0, 2, 0 }, 1, 1 }))
                       .state();
  ViewOptions options;
  options.width = 65;
  options.near = 4.5; // the second quad, at depth 4, is cut away
  const dgtk::View view = makeView(options);
  dgtk::VisibilityBuffer buffer = bruteForce(*state, view);
  buffer.at(32, 24) = {};
  buffer.at(33, 24) = { 2, 0 };
  dgtk::settleEdges(*state, view, buffer, false);
  EXPECT_EQ(buffer.at(32, 24).object, 1u);
}

TEST(SettleEdges, MissingTexelsDoNotCount)
{
  auto model = makeQuad({ { -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1 });
  addCutOut(*model, 8, 4);
  const auto state =
    SceneBuilder().add(model).add(makeQuad({ { -9, -9, -1 }, { 18, 0, 0 }, { 0, 18, 0 }, 1, 1 })).state();
  ViewOptions options;
  options.width = 160;
  options.height = 120;
  const dgtk::View view = makeView(options);
  const dgtk::VisibilityBuffer exact = bruteForce(*state, view);
  dgtk::VisibilityBuffer buffer = exact;
  EXPECT_EQ(dgtk::settleEdges(*state, view, buffer, false), 0u);
  std::size_t disturbed = 0;
  for (int y = 20; y < 100; ++y)
  {
    for (int x = 20; x < 140; ++x) // the quad's own diagonal, recorded on the wrong side
    {
      const dgtk::Hit own = exact.at(x, y);
      const double distance = own.object == 1 ? edgeDistance(*state, view, own, { x + 0.5, y + 0.5 }) : 1;
      if (distance < 1.0 / 64)
      {
        buffer.at(x, y).triangle ^= 1u;
        ++disturbed;
      }
    }
  }
  EXPECT_GT(disturbed, 3u);
  dgtk::settleEdges(*state, view, buffer, false);
  for (std::size_t i = 0; i < exact.hits.size(); ++i)
  {
    EXPECT_EQ(buffer.hits[i].object, exact.hits[i].object);
  }
}

TEST(SettleEdges, TrianglesWithoutAreaAreRemoved)
{
  auto model = makeSoup({ 1, 0.1, 0.1, 1 });
  auto geometry = std::make_shared<dgtk::Geometry>(*model->rest);
  geometry->positions = { { -1, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 } };
  model->rest = geometry;
  const auto state = SceneBuilder().add(model).state();
  const dgtk::View view = makeView();
  for (const bool grazingOnly : { false, true })
  {
    dgtk::VisibilityBuffer buffer;
    buffer.resize({ 0, 0, 64, 48 });
    buffer.at(32, 24) = buffer.at(0, 0) = buffer.at(33, 24) = { 1, 0 };
    EXPECT_EQ(dgtk::settleEdges(*state, view, buffer, grazingOnly), 3u);
  }
}

TEST(SettleEdges, ThreadsDoNotMatter)
{
  const auto state = mixedScene();
  const dgtk::View view = makeView({ 320, 240, 45, { 2, 2, 5 }, { 0, 0, 0 }, { 0, 1, 0 }, 0.1, 100 });
  const dgtk::VisibilityBuffer exact = bruteForce(*state, view);
  dgtk::VisibilityBuffer disturbed = exact;
  disturb(*state, view, 0.05, exact, disturbed);
  dgtk::VisibilityBuffer alone = disturbed;
  const std::size_t changed = dgtk::settleEdges(*state, view, alone, false);
  dgtk::ThreadPool pool(3);
  EXPECT_EQ(dgtk::settleEdges(*state, view, disturbed, false, &pool), changed);
  EXPECT_EQ(differences(alone, disturbed), 0u);
}
