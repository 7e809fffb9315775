// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEdgeMarks.h"
#include "dgtkExactReference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
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

TEST(EdgeMarks, PolygonsAreClippedAtAPlaneThatTheirCornersMayLieIn)
{
  const auto clip = [](const std::array<double, 3>& depths, double side)
  {
    dgtk::SmallPolygon<dgtk::Vector3> triangle;
    triangle.add({ 0, 0, depths[0] });
    triangle.add({ 8, 0, depths[1] });
    triangle.add({ 0, 8, depths[2] });
    const auto kept = dgtk::clipped(triangle, side, 2);
    double area = 0; // in x and y
    for (int i = 0; i < kept.count; ++i)
    {
      const dgtk::Vector3& a = kept[i];
      const dgtk::Vector3& b = kept[(i + 1) % kept.count];
      EXPECT_GE(side * (a.z - 2), 0);
      area += (a.x * b.y - a.y * b.x) / 2;
    }
    return area;
  };
  EXPECT_DOUBLE_EQ(clip({ 4, 4, 4 }, 1), 32);
  EXPECT_DOUBLE_EQ(clip({ 1, 1, 1 }, 1), 0);
  EXPECT_DOUBLE_EQ(clip({ 2, 4, 4 }, 1), 32); // a corner in the plane
  EXPECT_DOUBLE_EQ(clip({ 2, 2, 4 }, 1), 32);
  EXPECT_DOUBLE_EQ(clip({ 2, 2, 2 }, 1), 32);
  EXPECT_DOUBLE_EQ(clip({ 4, 0, 2 }, 1), 16);
  EXPECT_DOUBLE_EQ(clip({ 0, 4, 4 }, 1), 24); // half of both edges
  EXPECT_DOUBLE_EQ(clip({ 4, 0, 0 }, 1), 8);
  EXPECT_DOUBLE_EQ(clip({ 4, 0, 0 }, -1), 24);
}

TEST(SettleEdges, LeavesAnExactBufferAlone)
{
  const auto state = mixedScene();
  dgtk::View view = makeView({ 160, 120, 45, { 2, 2, 5 }, { 0, 0, 0 }, { 0, 1, 0 }, 0.1, 100 });
  for (const auto& model : { dgtk::makePinholeFromFov(160, 120, 45, 0), dgtk::makeOrthographic(160, 120, 5, 0) })
  {
    view.model = model;
    const dgtk::VisibilityBuffer exact = bruteForce(*state, view);
    dgtk::VisibilityBuffer buffer = exact;
    EXPECT_EQ(dgtk::settleEdges(*state, view, buffer), 0u);
    EXPECT_EQ(differences(buffer, exact), 0u);
  }
}

TEST(SettleEdges, RestoresPixelsThatARoundingErrorMoved)
{
  const auto state = mixedScene();
  dgtk::View view = makeView({ 320, 240, 45, { 2, 2, 5 }, { 0, 0, 0 }, { 0, 1, 0 }, 0.1, 100 });
  Eigen::Matrix3d skewed;
  skewed << 290, 60, 160, 0, 280, 120, 0, 0, 1;
  for (const auto& model : { dgtk::makePinholeFromFov(320, 240, 45, 0), dgtk::makeOrthographic(320, 240, 5, 0),
         dgtk::makePinhole(320, 240, skewed) })
  {
    view.model = model;
    const dgtk::VisibilityBuffer exact = bruteForce(*state, view);
    dgtk::VisibilityBuffer buffer = exact;
    EXPECT_GT(disturb(*state, view, 1.0 / 64, exact, buffer), 40u);
    dgtk::settleEdges(*state, view, buffer);
    EXPECT_EQ(differences(buffer, exact), 0u);
  }
}

// Slivers and needles whose triangles no pixel around records: what is behind them must not be taken instead.
TEST(SettleEdges, FindsSurfacesThatNoPixelRecords)
{
  const auto state = SceneBuilder()
                       .add(makeSoup({ 400, 1.5, 0.02, 5 }))
                       .add(makeSphere({ { 0, 0, 0 }, 0.8, 40, 60 }))
                       .add(makeQuad({ { -9, -9, -3 }, { 18, 0, 0 }, { 0, 18, 0 }, 3, 3 }))
                       .state();
  const dgtk::View view = makeView({ 96, 72, 45, { 0.3, 0.2, 5 }, { 0, 0, 0 }, { 0, 1, 0 }, 0.1, 100 });
  const dgtk::VisibilityBuffer exact = bruteForce(*state, view);
  dgtk::VisibilityBuffer buffer = exact;
  std::size_t lost = 0;
  for (int y = 0; y < 72; ++y)
  {
    for (int x = 0; x < 96; ++x)
    {
      const dgtk::Hit own = exact.at(x, y);
      if (edgeDistance(*state, view, own, { x + 0.5, y + 0.5 }) < 1.0 / 64)
      {
        buffer.at(x, y) = { 3, 0 };
        ++lost;
      }
    }
  }
  EXPECT_GT(lost, 80u);
  EXPECT_GE(dgtk::settleEdges(*state, view, buffer), lost - 5); // some were of the far wall
  EXPECT_EQ(differences(buffer, exact), 0u);
}

TEST(SettleEdges, PartsOfTheImageAreThePartsOfTheWhole)
{
  const auto state = mixedScene();
  const dgtk::View view = makeView({ 160, 120, 45, { 2, 2, 5 }, { 0, 0, 0 }, { 0, 1, 0 }, 0.1, 100 });
  const dgtk::VisibilityBuffer exact = bruteForce(*state, view);
  dgtk::VisibilityBuffer disturbed = exact;
  disturb(*state, view, 1.0 / 64, exact, disturbed);
  dgtk::VisibilityBuffer part;
  part.resize({ 50, 40, 64, 48 });
  for (int y = 40; y < 88; ++y)
  {
    for (int x = 50; x < 114; ++x)
    {
      part.at(x, y) = disturbed.at(x, y);
    }
  }
  EXPECT_GT(dgtk::settleEdges(*state, view, part), 5u);
  for (int y = 40; y < 88; ++y)
  {
    for (int x = 50; x < 114; ++x)
    {
      EXPECT_EQ(part.at(x, y), exact.at(x, y)) << x << ' ' << y;
    }
  }
}

// Far from all edges, where a surface was drawn that lies behind another one.
TEST(SettleEdges, PartsOfTheImageKnowHowFarTheirSurfacesAre)
{
  const auto state = SceneBuilder()
                       .add(makeQuad({ { -3, -3, 0 }, { 6, 0, 0 }, { 0, 6, 0 }, 1, 1 }))
                       .add(makeQuad({ { -3, -3, 0.3 }, { 6, 0, -0.6 }, { 0, 6, 0 }, 1, 1 })) // behind on the right
                       .state();
  const dgtk::View view = makeView();
  dgtk::VisibilityBuffer part;
  part.resize({ 32, 0, 32, 48 });
  for (int y = 0; y < 48; ++y)
  {
    for (int x = 32; x < 64; ++x)
    {
      part.at(x, y) = bruteForce(*state, view, { x, y, 1, 1 }).hits[0];
    }
  }
  const dgtk::Hit seen = part.at(50, 30);
  ASSERT_EQ(seen.object, 1u);
  part.at(50, 30) = { 2, seen.triangle };
  EXPECT_EQ(dgtk::settleEdges(*state, view, part), 1u);
  EXPECT_EQ(part.at(50, 30), seen);
}

/// A triangle of which two edges, in the image, pass through the centres of pixels as well as double precision can say.
std::shared_ptr<dgtk::Model> throughCentres(const dgtk::View& view, std::mt19937& random)
{
  auto model = makeSoup({ 1, 0.1, 0.1, 1 });
  auto geometry = std::make_shared<dgtk::Geometry>(*model->rest);
  const int x = int(random() % 30), y = int(random() % 20), side = int(4 + random() % 24);
  const int corner[3][2] = { { x, y }, { x + 2 * side, y + side }, { x, y + side } };
  for (std::size_t i = 0; i < 3; ++i)
  {
    const dgtk::CameraRay ray = view.model->rayThrough({ corner[i][0] + 0.5, corner[i][1] + 0.5 });
    const double depth = 3 + double(random() % 1000) / 300;
    geometry->positions[i] = view.camera_from_world.inverse() * (ray.origin + depth * ray.direction);
  }
  model->rest = geometry;
  return model;
}

/// The pixels of a scene's only triangle, whose edges belong to it.
dgtk::VisibilityBuffer inExactArithmetic(const dgtk::SceneState& state, const dgtk::View& view)
{
  dgtk::VisibilityBuffer buffer;
  buffer.resize({ 0, 0, view.model->width(), view.model->height() });
  for (int i = 0; i < int(buffer.hits.size()); ++i)
  {
    const ReferencePoint at =
      referencePoint(state, view, { 1, 0 }, i % buffer.rect.width + 0.5, i / buffer.rect.width + 0.5);
    const bool inside = at.second >= 0 && at.third >= 0 && at.second + at.third <= 1;
    buffer.hits[std::size_t(i)] = inside ? dgtk::Hit{ 1, 0 } : dgtk::Hit{};
  }
  return buffer;
}

TEST(SettleEdges, CentresOnEdgesAreDecidedExactly)
{
  dgtk::View view = makeView({ 64, 48, 45, { 2.1, 1.7, 5.3 }, { 0.1, 0.2, 0 }, { 0.1, 1, 0 }, 0.1, 100 });
  Eigen::Matrix3d skewed;
  skewed << 58, 9, 31, 0, 57, 22, 0, 0, 1;
  for (const auto& model : { dgtk::makePinholeFromFov(64, 48, 45, 0), dgtk::makeOrthographic(64, 48, 5, 0),
         dgtk::makePinhole(64, 48, skewed) })
  {
    view.model = model;
    std::mt19937 random(7);
    for (int i = 0; i < 40; ++i)
    {
      const auto state = SceneBuilder().add(throughCentres(view, random)).state();
      const dgtk::VisibilityBuffer exact = inExactArithmetic(*state, view);
      dgtk::VisibilityBuffer buffer = exact;
      dgtk::settleEdges(*state, view, buffer);
      EXPECT_EQ(differences(buffer, exact), 0u) << i;
    }
  }
}

TEST(SettleEdges, FillsBackgroundBesideASurface)
{
  const auto state = SceneBuilder().add(makeQuad()).state();
  ViewOptions options;
  options.width = options.height = 48; // the diagonal goes through the centres of pixels
  const dgtk::View view = makeView(options);
  const dgtk::VisibilityBuffer exact = bruteForce(*state, view);
  dgtk::VisibilityBuffer buffer = exact;
  std::size_t removed = 0;
  for (std::size_t i = 0; i < exact.hits.size(); ++i)
  {
    const Eigen::Vector2d centre(double(i % 48) + 0.5, double(i / 48) + 0.5);
    if (exact.hits[i].object && edgeDistance(*state, view, exact.hits[i], centre) < 1.0 / 64)
    {
      buffer.hits[i] = {};
      ++removed;
    }
  }
  EXPECT_GT(removed, 20u); // the diagonal
  EXPECT_EQ(dgtk::settleEdges(*state, view, buffer), removed);
  EXPECT_EQ(differences(buffer, exact), 0u);
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
  buffer.at(32, 30) = exact.at(31, 30); // missed on its edge
  EXPECT_EQ(dgtk::settleEdges(*state, view, buffer), 1u);
  EXPECT_EQ(buffer.at(32, 30), exact.at(32, 30));
}

// Coincident surfaces are those within a few roundings, not what looks alike to a depth buffer.
TEST(SettleEdges, TheNearerOfTwoThatAreAlmostAtTheSamePlaceIsSeen)
{
  const auto far = makeQuad({ { -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1 });
  ViewOptions options;
  options.width = options.height = 48; // the diagonal goes through the centres of pixels
  const dgtk::View view = makeView(options);
  for (const double gap : { 1e-6, 1e-8, 1e-10 }) // of a depth of 5
  {
    const auto near = makeQuad({ { -1, -1, gap }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1 });
    const auto state = SceneBuilder().add(far).add(near).state();
    dgtk::VisibilityBuffer buffer = bruteForce(*state, view);
    for (const int i : { 20, 22, 24 })
    {
      ASSERT_EQ(buffer.at(i, 47 - i).object, 2u);
      buffer.at(i, 47 - i) = { 1, 0 };
    }
    EXPECT_EQ(dgtk::settleEdges(*state, view, buffer), 3u) << gap;
    EXPECT_EQ(buffer.at(22, 25).object, 2u) << gap;
  }
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
  dgtk::settleEdges(*state, view, buffer);
  for (const int i : { 20, 22, 24 })
  {
    EXPECT_EQ(buffer.at(i, 47 - i), (dgtk::Hit{ 1, 0 }));
  }
}

// Whose depths differ by roundings, away from all edges.
TEST(SettleEdges, CoincidentSurfacesOfDifferentTrianglesGoToTheLowestObject)
{
  const auto state = SceneBuilder()
                       .add(makeQuad({ { -3, -3, 0.1 }, { 6, 0, 0.7 }, { 0, 6, 0.3 }, 2, 3 }))
                       .add(makeQuad({ { -3, -3, 0.1 }, { 6, 0, 0.7 }, { 0, 6, 0.3 }, 1, 1 }))
                       .state();
  const dgtk::View view = makeView();
  const dgtk::VisibilityBuffer exact = bruteForce(*state, view);
  dgtk::VisibilityBuffer buffer = exact;
  for (std::size_t i = 0; i < buffer.hits.size(); ++i)
  {
    ASSERT_EQ(exact.hits[i].object, 1u);
    const int x = int(i % 64), y = int(i / 64);
    for (const std::uint32_t triangle : { 0u, 1u })
    {
      const Eigen::Vector2d weights =
        dgtk::surfacePointAt(*state, view, { x + 0.5, y + 0.5 }, { 2, triangle }).barycentrics;
      buffer.hits[i] = weights.minCoeff() >= 0 && weights.sum() <= 1 ? dgtk::Hit{ 2, triangle } : buffer.hits[i];
    }
  }
  dgtk::settleEdges(*state, view, buffer);
  EXPECT_EQ(differences(buffer, exact), 0u);
}

TEST(SettleEdges, RemovesImpossibleDepths)
{
  // A plane that is seen edge on but for a breath: beside it its plane is anywhere.
  const auto state = SceneBuilder().add(makeQuad({ { 0, -1, -50 }, { 1e-4, 0, 49 }, { 0, 2, 0 }, 1, 1 })).state();
  ViewOptions options;
  options.width = 65;
  const dgtk::View view = makeView(options);
  const dgtk::VisibilityBuffer exact = bruteForce(*state, view);
  dgtk::VisibilityBuffer buffer = exact;
  const dgtk::Hit drawn = exact.at(32, 24).object ? dgtk::Hit{} : dgtk::Hit{ 1, 0 };
  buffer.at(32, 24) = drawn;
  EXPECT_EQ(dgtk::settleEdges(*state, view, buffer), 1u);
  EXPECT_EQ(buffer.at(32, 24), exact.at(32, 24));
}

// As in the ray engine: between near and far means both included.
TEST(SettleEdges, SurfacesAtNearAndAtFarAreSeen)
{
  const auto state = SceneBuilder().add(makeQuad()).state();
  ViewOptions options;
  for (const double shift : { 0.0, 1e-9, -1e-9 })
  {
    for (const bool atFar : { false, true })
    {
      options.near = atFar ? 0.1 : 5 + shift;
      options.far = atFar ? 5 + shift : 100;
      const dgtk::View view = makeView(options);
      const bool seen = atFar ? shift >= 0 : shift <= 0;
      const dgtk::VisibilityBuffer whole = bruteForce(*state, makeView());
      const dgtk::VisibilityBuffer exact = bruteForce(*state, view);
      ASSERT_EQ(exact.at(20, 20).object, seen ? 1u : 0u);
      dgtk::VisibilityBuffer buffer = whole;
      buffer.hits = seen ? std::vector<dgtk::Hit>(whole.hits.size()) : whole.hits;
      dgtk::settleEdges(*state, view, buffer);
      EXPECT_EQ(differences(buffer, exact), 0u) << shift << ' ' << atFar;
    }
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
  buffer.at(32, 24) = { 2, 0 };
  dgtk::settleEdges(*state, view, buffer);
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
  EXPECT_EQ(dgtk::settleEdges(*state, view, buffer), 0u);
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
  dgtk::settleEdges(*state, view, buffer);
  EXPECT_EQ(differences(buffer, exact), 0u);
}

// Where a texel ends beside a pixel's centre, far from all edges.
TEST(SettleEdges, BordersOfMissingTexelsAreSettled)
{
  auto model = makeQuad({ { -1, -1, 0 }, { 2, 0, 0 }, { 0, 2, 0 }, 1, 1 });
  addCutOut(*model, 24, 4);
  const auto state =
    SceneBuilder().add(model).add(makeQuad({ { -9, -9, -1 }, { 18, 0, 0 }, { 0, 18, 0 }, 1, 1 })).state();
  ViewOptions options;
  options.width = 163;
  options.height = 121;
  options.eye = { 0.01, 0.013, 3 };
  options.lookAt = { 0.01, 0.013, 0 };
  options.up = { 0.3, 1, 0 };
  const dgtk::View view = makeView(options);
  const dgtk::VisibilityBuffer exact = bruteForce(*state, view);
  dgtk::View shifted = view; // by a rounding of drawing
  Eigen::Matrix3d K = view.model->linear()->K;
  K(0, 2) += 1.0 / 150;
  K(1, 2) -= 1.0 / 180;
  shifted.model = dgtk::makePinhole(163, 121, K);
  dgtk::VisibilityBuffer buffer = bruteForce(*state, shifted);
  EXPECT_GT(differences(buffer, exact), 5u);
  dgtk::settleEdges(*state, view, buffer);
  EXPECT_EQ(differences(buffer, exact), 0u);
}

TEST(SettleEdges, TrianglesWithoutAreaAreRemoved)
{
  auto model = makeSoup({ 1, 0.1, 0.1, 1 });
  auto geometry = std::make_shared<dgtk::Geometry>(*model->rest);
  geometry->positions = { { -1, 0, 0 }, { 0, 0, 0 }, { 1, 0, 0 } };
  model->rest = geometry;
  const auto state = SceneBuilder().add(model).state();
  ViewOptions options;
  options.height = 49; // the line goes through the centres of row 24
  const dgtk::View view = makeView(options);
  dgtk::VisibilityBuffer buffer;
  buffer.resize({ 0, 0, 64, 49 });
  buffer.at(32, 24) = buffer.at(33, 24) = { 1, 0 };
  EXPECT_EQ(dgtk::settleEdges(*state, view, buffer), 2u);
}
