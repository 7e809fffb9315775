// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEdges.h"
#include "dgtkSyntheticScene.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dgtk;
using namespace dgtk::test;

namespace
{
using Marks = std::vector<std::vector<int>>;

/// A plane that faces the camera at a depth; object 0 is none.
PixelPlane facingPlane(std::uint32_t object, double x, double y, double depth)
{
  return { object, { x, y, depth }, { 0, 0, -1 }, depth };
}

Marks marksOf(const std::vector<std::vector<PixelPlane>>& rows)
{
  EdgeRows edges;
  Marks marks;
  const auto keep = [&marks](const std::vector<std::uint8_t>& row) { marks.emplace_back(row.begin(), row.end()); };
  for (const std::vector<PixelPlane>& row : rows)
  {
    const std::vector<std::uint8_t> above = edges.next(row);
    if (&row != &rows.front())
    {
      keep(above);
    }
  }
  keep(edges.last());
  return marks;
}

/// 4 x 4 pixels of planes that face the camera, from their objects and depths.
std::vector<std::vector<PixelPlane>> picture(const Marks& objects, double depthOfThree = 10)
{
  std::vector<std::vector<PixelPlane>> rows;
  for (std::size_t y = 0; y < objects.size(); ++y)
  {
    rows.emplace_back();
    for (std::size_t x = 0; x < objects[y].size(); ++x)
    {
      const int object = objects[y][x];
      rows.back().push_back(
        facingPlane(static_cast<std::uint32_t>(object % 3), double(x), double(y), object >= 3 ? depthOfThree : 10.0));
    }
  }
  return rows;
}
} // namespace

TEST(Edges, OfObjectsAreOnBothSides)
{
  EXPECT_EQ(marksOf(picture({ { 1, 1, 2, 2 }, { 1, 1, 2, 2 }, { 1, 1, 1, 1 }, { 1, 1, 1, 1 } })),
    (Marks{ { 0, 255, 255, 0 }, { 0, 255, 255, 255 }, { 0, 0, 255, 255 }, { 0, 0, 0, 0 } }));
}

TEST(Edges, DiagonalNeighboursAreNone)
{
  EXPECT_EQ(marksOf(picture({ { 2, 1, 1, 1 }, { 1, 1, 1, 1 }, { 1, 1, 1, 1 } })),
    (Marks{ { 255, 255, 0, 0 }, { 255, 0, 0, 0 }, { 0, 0, 0, 0 } }));
}

TEST(Edges, OfNothingAreThoseOfObjects)
{
  EXPECT_EQ(marksOf(picture({ { 0, 0, 1 }, { 0, 0, 1 } })), (Marks{ { 0, 255, 255 }, { 0, 255, 255 } }));
}

TEST(Edges, OfDepthBeginBeyondOneHundredthOfTheSmallerOne)
{
  // the objects 4 are those of object 1, at another depth
  const Marks objects{ { 1, 4, 4 }, { 1, 1, 1 } };
  EXPECT_EQ(marksOf(picture(objects, 10.0999)), (Marks{ { 0, 0, 0 }, { 0, 0, 0 } }));
  EXPECT_EQ(marksOf(picture(objects, 10.1001)), (Marks{ { 128, 128, 128 }, { 0, 128, 128 } }));
  EXPECT_EQ(marksOf(picture(objects, 9.901)), (Marks{ { 0, 0, 0 }, { 0, 0, 0 } }));
  EXPECT_EQ(marksOf(picture(objects, 9.9)), (Marks{ { 128, 128, 128 }, { 0, 128, 128 } }));
}

TEST(Edges, NeedBothPointsOffTheOthersPlane)
{
  // A corner of a room: the second pixel's plane is the other wall, which holds the first point.
  const PixelPlane wall = facingPlane(1, 0, 0, 10);
  PixelPlane other{ 1, { 0, 0, 5 }, { 1, 0, 0 }, 5 };
  EXPECT_EQ(edgeBetween(wall, other), noEdge);
  EXPECT_EQ(edgeBetween(other, wall), noEdge);
  other.point.x() = 0.0501; // by more than 1 % of 5
  EXPECT_EQ(edgeBetween(wall, other), depthEdge);
}

TEST(Edges, AreNoneOnAPlaneBehindALens)
{
  const PixelPlane one{ 1, { 0, 0, -10 }, { 0, 0, 1 }, 10 };
  const PixelPlane next{ 1, { 1, 0, -10 }, { 0, 0, 1 }, std::sqrt(101) };
  EXPECT_EQ(edgeBetween(one, next), noEdge);
}

TEST(Edges, PlanesAreThoseOfTheTriangles)
{
  QuadOptions quad;
  quad.corner = { -9, -9, 1 };
  quad.sideU = { 18, 0, 0 };
  quad.sideV = { 0, 18, 0 };
  const auto state = SceneBuilder().add(makeQuad(quad)).state();
  ViewOptions options;
  options.width = 3;
  options.height = 2;
  const View view = makeView(options);
  const std::vector<Hit> hits{ { 1, 0 }, {}, { 1, 0 } };
  SurfaceRows row;
  computeSurfaceRows(*state, view, { 0, 1, 3, 1 }, hits.data(), false, row);
  const std::vector<PixelPlane> planes = pixelPlanes(row);
  ASSERT_EQ(planes.size(), 3u);
  EXPECT_EQ(planes[1].object, 0u);
  for (const std::size_t x : { std::size_t(0), std::size_t(2) })
  {
    EXPECT_EQ(planes[x].object, 1u);
    EXPECT_NEAR(planes[x].point.z(), row.t[x], 1e-12);
    EXPECT_NEAR(std::abs(planes[x].normal.z()), 1, 1e-12);
    Eigen::Vector2d pixel;
    ASSERT_TRUE(view.model->project(planes[x].point, pixel));
    EXPECT_LE((pixel - Eigen::Vector2d(double(x) + 0.5, 1.5)).norm(), 1e-9);
  }
}
