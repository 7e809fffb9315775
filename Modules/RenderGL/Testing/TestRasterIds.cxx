// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTestScene.h"

#include "dgtkRasterSource.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dgtk;
using namespace dgtk::test;

namespace
{

/// Ids differ from the exact ones only where an edge passes within 1/128 pixel of the centre: rasterizers round
/// vertices to 1/256 pixel.
constexpr double EdgeTolerance = 1.0 / 128;

int comparedWithRays(const SceneState& state, const View& view, const VisibilityBuffer& hits, int step = 1)
{
  int differing = 0;
  for (int y = 0; y < hits.rect.height; y += step)
  {
    for (int x = 0; x < hits.rect.width; x += step)
    {
      const Reference expected = castRay(state, view, hits.rect.x + x, hits.rect.y + y);
      const Hit found = hits.at(hits.rect.x + x, hits.rect.y + y);
      if (found != expected.hit)
      {
        ++differing;
        EXPECT_LT(expected.margin, EdgeTolerance)
          << "pixel " << x << ", " << y << ": object " << found.object << " triangle " << found.triangle
          << ", expected " << expected.hit.object << ' ' << expected.hit.triangle;
      }
    }
  }
  return differing;
}

RasterSource& source()
{
  static std::unique_ptr<RasterSource> one = makeRasterSource();
  return *one;
}

VisibilityBuffer render(std::shared_ptr<const SceneState> state, const View& view)
{
  VisibilityBuffer hits;
  source().setScene(std::move(state), view);
  source().render(whole(view), hits);
  return hits;
}

} // namespace

TEST(RasterIds, BoxAndSphere)
{
  auto state = std::make_shared<SceneState>();
  ModelBuilder box;
  box.part(flat({ 1, 0, 0 }));
  box.box({ -1, -1, -1 }, { 1, 1, 1 });
  ModelBuilder ball;
  ball.part(matte({ 0, 1, 0 }));
  ball.sphere(10);
  state->instances = { instanceOf(box.finish()), instanceOf(ball.finish(), { 1.5, 0.5, 0.5 }) };
  state->lights.emplace_back();
  state->lights.back().kind = LightState::Kind::Head;
  const View view = viewOf(makePinholeFromFov(160, 120, 45, 0), { 3, 2, 5 }, { 0, 0, 0 });
  const VisibilityBuffer hits = render(state, view);
  savePicture("dgtk-ids", hits);
  EXPECT_LT(comparedWithRays(*state, view, hits), 20);
  ColorBuffer colors;
  VisibilityBuffer same;
  source().renderColor(whole(view), 1, colors, &same);
  savePicture("dgtk-colors", colors);
  EXPECT_EQ(hits.hits, same.hits);
}
