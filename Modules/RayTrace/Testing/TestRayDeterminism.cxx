// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRaySource.h"

#include "dgtkRayTestScenes.h"
#include "dgtkThreadPool.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace dgtk;
using namespace dgtk::test;

VisibilityBuffer trace(VisibilitySource& source, std::shared_ptr<const SceneState> state, const View& view)
{
  source.setScene(std::move(state), view);
  VisibilityBuffer buffer;
  source.render({ 0, 0, view.model->width(), view.model->height() }, buffer);
  return buffer;
}

/// A detailed scene with surfaces that coincide in part.
std::shared_ptr<SceneState> detailed()
{
  SceneBuilder scene;
  QuadOptions fine;
  fine.cellsU = fine.cellsV = 30;
  scene.add(makeSphere({ { 0, 0, 0 }, 1, 100, 100 }), placement({ 0, 0, 0 }));
  scene.add(makeQuad(fine), placement({ 0, 0.1, 0.2 }, 1.7, { 1, 0, 0 }, -1.2));
  scene.add(makeQuad(), placement({ 0, 0.1, 0.2 }, 1.7, { 1, 0, 0 }, -1.2));
  scene.add(makeSoup({ 5000, 1.5, 0.2, 9 }));
  return scene.state();
}
} // namespace

TEST(RayDeterminism, ThreadsRebuildsAndRectanglesDoNotShow)
{
  const auto state = detailed();
  const View view = makeView({ 203, 151, 45, { 0.4, 0.8, 5 }, { 0, 0, 0 }, { 0, 1, 0 }, 0.1, 1000 });
  ThreadPool one(1);
  const VisibilityBuffer first = trace(*makeRaySource(one), state, view);
  for (const int threads : { 1, 2, 5 })
  {
    ThreadPool pool(threads);
    // New engines make their trees anew; a copy of the state shares no instance.
    const auto source = makeRaySource(pool);
    EXPECT_EQ(trace(*source, std::make_shared<SceneState>(*state), view).hits, first.hits) << threads << " threads";
    VisibilityBuffer part;
    for (const PixelRect& rect : { PixelRect{ 0, 0, 97, 61 }, PixelRect{ 97, 61, 106, 90 }, PixelRect{ 3, 150, 1, 1 },
           PixelRect{ 202, 0, 1, 151 } })
    {
      source->render(rect, part);
      ASSERT_EQ(part.hits.size(), std::size_t(rect.width) * rect.height);
      for (int y = rect.y; y < rect.y + rect.height; ++y)
      {
        for (int x = rect.x; x < rect.x + rect.width; ++x)
        {
          ASSERT_EQ(part.at(x, y), first.at(x, y)) << x << ", " << y;
        }
      }
    }
  }
}

TEST(RayDeterminism, OrderOfScenesAndViewsDoesNotShow)
{
  ThreadPool pool(2);
  const auto model = makeSphere({ { 0, 0, 0 }, 1, 16, 24 });
  const auto wall = makeQuad();
  std::vector<std::shared_ptr<SceneState>> states;
  for (int frame = 0; frame < 6; ++frame)
  {
    auto geometry = std::make_shared<Geometry>(*model->rest); // deforms
    for (Eigen::Vector3d& x : geometry->positions)
    {
      x.y() += 0.3 * frame * std::sin(3 * x.x());
    }
    SceneBuilder scene;
    scene.add(model);
    if (frame % 2 == 0) // the number of objects changes, too
    {
      scene.add(wall, placement({ 0.1 * frame, 0, 0.2 }, 1, { 0, 1, 0 }, 0.3 * frame));
    }
    scene.add(model, placement({ 0.2 * frame, 0.5, 0 }));
    states.push_back(scene.state());
    states.back()->instances[0].geometry = geometry;
  }
  std::vector<View> views;
  for (const double x : { -1.0, 2.0 })
  {
    views.push_back(makeView({ 64, 48, 45, { x, 0.8, 5 }, { 0, 0, 0 }, { 0, 1, 0 }, 0.1, 1000 }));
  }
  const auto source = makeRaySource(pool);
  for (const int frame : { 0, 1, 2, 3, 4, 5, 2, 0, 5, 5, 1 })
  {
    for (const View& view : views)
    {
      const VisibilityBuffer buffer = trace(*source, states[frame], view);
      EXPECT_EQ(buffer.hits, trace(*makeRaySource(pool), states[frame], view).hits) << "frame " << frame;
      if (&view == &views[0])
      {
        int differing = 0;
        const VisibilityBuffer reference = bruteForce(*states[frame], view);
        for (std::size_t i = 0; i < buffer.hits.size(); ++i)
        {
          differing += buffer.hits[i] != reference.hits[i];
        }
        EXPECT_EQ(differing, 0) << "frame " << frame;
      }
    }
  }
}
