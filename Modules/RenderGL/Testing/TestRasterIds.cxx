// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceRows.h"
#include "dgtkTestScene.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <fstream>
#include <unistd.h>

using namespace dgtk;
using namespace dgtk::test;

namespace
{

std::shared_ptr<SceneState> emptyState()
{
  auto state = std::make_shared<SceneState>();
  state->lights.emplace_back();
  state->lights.back().kind = LightKind::Head;
  return state;
}

std::shared_ptr<SceneState> boxAndBall()
{
  auto state = emptyState();
  ModelBuilder box;
  box.part(flat({ 1, 0, 0 }));
  box.box({ -1, -1, -1 }, { 1, 1, 1 });
  ModelBuilder ball;
  ball.part(matte({ 0, 1, 0 }));
  ball.sphere(10);
  state->instances = { instanceOf(box.finish()), instanceOf(ball.finish(), { 1.5, 0.5, 0.5 }) };
  return state;
}

/// Two triangles around the origin in the plane y = 0.
std::shared_ptr<const Model> ground(double half)
{
  ModelBuilder model;
  model.part(flat({ 0, 1, 0 }));
  model.quad({ -half, 0, half }, { half, 0, half }, { half, 0, -half }, { -half, 0, -half });
  return model.finish();
}

std::size_t residentBytes()
{
  std::ifstream file("/proc/self/statm");
  std::size_t pages = 0;
  file >> pages >> pages;
  return pages * std::size_t(::sysconf(_SC_PAGESIZE));
}

} // namespace

TEST(RasterIds, BoxAndSphere)
{
  const auto state = boxAndBall();
  const View view = viewOf(makePinholeFromFov(160, 120, 45, 0), { 3, 2, 5 }, { 0, 0, 0 });
  const VisibilityBuffer hits = render(state, view);
  savePicture("dgtk-ids", hits);
  EXPECT_LT(comparedWithRays(*state, view, hits), 20);
}

TEST(RasterIds, OffCentreUnequalFocalLengthsAndSkew)
{
  const auto state = boxAndBall();
  Eigen::Matrix3d K;
  K << 150, 7, 60, 0, 190, 75, 0, 0, 1;
  const View view = viewOf(makePinhole(160, 120, K), { 3, 2, 5 }, { 0, 0, 0 });
  EXPECT_LT(comparedWithRays(*state, view, render(state, view)), 20);
}

TEST(RasterIds, ParallelProjection)
{
  const auto state = boxAndBall();
  const View view = viewOf(makeOrthographic(160, 120, 5, 0), { 3, 2, 5 }, { 0, 0, 0 }, 2, 100);
  EXPECT_LT(comparedWithRays(*state, view, render(state, view)), 20);
}

TEST(RasterIds, MirroredAndShearedInstances)
{
  auto state = boxAndBall();
  state->instances[0].world_from_object.linear << -1, 0.3, 0, 0, 1, 0.2, 0, 0, 1;
  state->instances[1].world_from_object.linear = Eigen::Vector3d(1, -0.5, 2).asDiagonal();
  const View view = viewOf(makePinholeFromFov(160, 120, 45, 0), { 3, 2, 5 }, { 0, 0, 0 });
  EXPECT_LT(comparedWithRays(*state, view, render(state, view)), 20);
}

TEST(RasterIds, ColorPassHasTheSameIds)
{
  const auto state = boxAndBall();
  const View view = viewOf(makePinholeFromFov(321, 243, 45, 0), { 3, 2, 5 }, { 0, 0, 0 });
  VisibilityBuffer fromColor;
  renderColor(state, view, 1, &fromColor);
  settleEdges(*state, view, fromColor); // as render() does
  EXPECT_EQ(fromColor.hits, render(state, view).hits);
}

TEST(RasterIds, GroundUnderAndBehindTheCamera)
{
  for (const double half : { 50.0, 1000.0, 50000.0 })
  {
    SCOPED_TRACE(half);
    auto state = emptyState();
    state->instances = { instanceOf(ground(half)), boxAndBall()->instances[0] };
    const View view = viewOf(makePinholeFromFov(160, 120, 60, 0), { 3, 1.2, 5 }, { 0.3, 0.5, 0 }, 0.1, 100000);
    EXPECT_LT(comparedWithRays(*state, view, render(state, view)), 20);
    const View down = viewOf(makePinholeFromFov(160, 120, 60, 0), { 3, 1.2, 5 }, { 3.3, 0, 4.8 }, 0.1, 100000);
    EXPECT_LT(comparedWithRays(*state, down, render(state, down)), 20);
  }
}

TEST(RasterIds, CloseSurfacesFarAway)
{
  // Near 0.1, far 100,000, surfaces whose depths differ by 1e-5 of the depth; the nearer one is drawn last.
  for (const double depth : { 0.2, 10.0, 1000.0, 90000.0 })
  {
    SCOPED_TRACE(depth);
    auto state = emptyState();
    const auto square = [](double size)
    {
      ModelBuilder model;
      model.part(flat({ 1, 1, 1 }));
      model.quad({ -size, -size, 0 }, { size, -size, 0 }, { size, size, 0 }, { -size, size, 0 });
      return model.finish();
    };
    Eigen::Matrix3d tilt;
    tilt = Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitY());
    state->instances = { instanceOf(square(depth), { 0, 0, -depth }, tilt),
      instanceOf(square(depth), { 0, 0, -depth * (1 - 1e-5) }, tilt) };
    const View view = viewOf(makePinholeFromFov(64, 48, 40, 0), { 0, 0, 0 }, { 0, 0, -1 }, 0.1, 100000);
    EXPECT_LT(comparedWithRays(*state, view, render(state, view)), 20);
  }
}

TEST(RasterIds, OnGroundThatReachesToTheHorizon)
{
  // A tile lies 1e-4 of its distance above the ground, and the ground begins under the camera.
  for (const double distance : { 10.0, 100.0, 1000.0, 10000.0 })
  {
    SCOPED_TRACE(distance);
    auto state = emptyState();
    ModelBuilder tile;
    tile.part(flat({ 1, 0, 0 }));
    const double s = distance / 3;
    tile.quad({ -s, 0, s }, { s, 0, s }, { s, 0, -s }, { -s, 0, -s });
    const double height = distance / 5;
    state->instances = { instanceOf(ground(90000)), instanceOf(tile.finish(), { 0, 1e-4 * distance, -distance }) };
    const View view = viewOf(makePinholeFromFov(160, 120, 60, 0), { 0, height, 0 }, { 0, 0, -distance }, 0.1, 100000);
    const VisibilityBuffer hits = render(state, view);
    EXPECT_LT(comparedWithRays(*state, view, hits), 20);
    VisibilityBuffer fromColor;
    const ColorBuffer colors = renderColor(state, view, 1, &fromColor);
    settleEdges(*state, view, fromColor);
    EXPECT_EQ(fromColor.hits, hits.hits);
    for (int x = 0; x < 160; ++x)
    {
      const Eigen::Vector3d expected[3] = { { 0, 0, 0 }, { 0, 1, 0 }, { 1, 0, 0 } };
      EXPECT_LT((colorAt(colors, x, 60) - expected[hits.at(x, 60).object]).norm(), 1e-5);
    }
  }
}

TEST(RasterIds, CoincidentSurfacesKeepTheFirst)
{
  auto state = emptyState();
  ModelBuilder model;
  model.part(flat({ 1, 0, 0 }));
  model.quad({ -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 });
  model.part(flat({ 0, 1, 0 }));
  model.quad({ -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 });
  const auto made = model.finish();
  state->instances = { instanceOf(made), instanceOf(made) };
  const View view = viewOf(makePinholeFromFov(64, 48, 30, 0), { 0.3, 0.2, 4 }, { 0, 0, 0 });
  const VisibilityBuffer hits = render(state, view);
  std::size_t surfaces = 0;
  for (const Hit& hit : hits.hits)
  {
    surfaces += hit.object != 0;
    EXPECT_LE(hit.object, 1u);
    EXPECT_LT(hit.triangle, 2u);
  }
  EXPECT_GT(surfaces, 500u);
}

TEST(RasterIds, TrianglesWithoutAreaKeepTheirNumber)
{
  auto state = emptyState();
  ModelBuilder model;
  model.part(flat({ 1, 0, 0 }));
  model.triangle({ 0, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 });
  model.quad({ -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 });
  state->instances = { instanceOf(model.finish()) };
  const View view = viewOf(makePinholeFromFov(64, 48, 30, 0), { 0, 0, 4 }, { 0, 0, 0 });
  const VisibilityBuffer hits = render(state, view);
  EXPECT_EQ(hits.at(40, 30).triangle, 1u);
  EXPECT_EQ(hits.at(24, 18).triangle, 2u);
}

TEST(RasterIds, DeformedGeometryReplacesItsBuffers)
{
  auto state = boxAndBall();
  const View view = viewOf(makePinholeFromFov(96, 72, 45, 0), { 3, 2, 5 }, { 0, 0, 0 });
  render(state, view);
  for (int frame = 1; frame < 4; ++frame)
  {
    auto next = std::make_shared<SceneState>(*state);
    auto geometry = std::make_shared<Geometry>(*state->instances[0].geometry);
    for (Eigen::Vector3d& x : geometry->positions)
    {
      x.x() += 0.3 * frame * x.y();
    }
    next->instances[0].geometry = geometry;
    next->instances[1].world_from_object.translation.y() += 0.1 * frame;
    EXPECT_LT(comparedWithRays(*next, view, render(next, view)), 20);
    VisibilityBuffer fromColor;
    renderColor(next, view, 1, &fromColor);
    EXPECT_LT(comparedWithRays(*next, view, fromColor), 20);
  }
}

TEST(RasterIds, PartsOfTheImageAreThePartsOfTheWhole)
{
  // Not bit-identical by itself (that is what the canonical grid is for), but the same picture.
  const auto state = boxAndBall();
  const View view = viewOf(makePinholeFromFov(160, 120, 45, 0), { 3, 2, 5 }, { 0, 0, 0 });
  source().setScene(state, view);
  VisibilityBuffer hits;
  source().render({ 70, 40, 50, 30 }, hits);
  EXPECT_EQ(hits.rect, (PixelRect{ 70, 40, 50, 30 }));
  EXPECT_LT(comparedWithRays(*state, view, hits), 5);
}

TEST(RasterIds, InstancesShareTheirGeometry)
{
  ModelBuilder ball;
  ball.part(matte({ 0, 1, 0 }));
  ball.sphere(40); // 6,400 triangles: about 0.3 MB as floats and indices
  const auto model = ball.finish();
  const View view = viewOf(makePinholeFromFov(64, 48, 45, 0), { 0, 0, 8 }, { 0, 0, 0 });
  auto few = emptyState();
  few->instances = { instanceOf(model) };
  renderColor(few, view);
  const std::size_t before = residentBytes();
  auto many = emptyState();
  for (int i = 0; i < 1000; ++i)
  {
    many->instances.push_back(instanceOf(model, { i % 32 * 3.0 - 48, i / 32 * 3.0 - 48, -100 }));
  }
  many->instances.push_back(instanceOf(model, { 0, 0, 0 }));
  few->instances.push_back(many->instances[0]);
  const VisibilityBuffer hits = render(many, view);
  EXPECT_EQ(hits.at(32, 24).object, 1001u);
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  static_cast<void>(before); // sanitizers keep what is freed
#else
  // Mesa takes about 100 MB to sort six million triangles; a thousand copies would be 300 MB more.
  EXPECT_LT(double(residentBytes()) - double(before), 200e6);
#endif
}
