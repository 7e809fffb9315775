// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceDistance.h"

#include "dgtkRandom.h"
#include "dgtkSyntheticScene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

using namespace dgtk;
using namespace dgtk::test;

namespace
{
using Corners = std::array<Eigen::Vector3d, 3>;

/// Whatever the order of the corners.
void expectDistance(const Eigen::Vector3d& x, Corners corners, double expected)
{
  std::array<int, 3> order{ 0, 1, 2 };
  do
  {
    const Corners turned{ corners[std::size_t(order[0])], corners[std::size_t(order[1])],
      corners[std::size_t(order[2])] };
    EXPECT_NEAR(distanceToTriangle(x, turned), expected, 1e-14) << x.transpose();
  } while (std::next_permutation(order.begin(), order.end()));
}

double nearestOfAll(const SceneState& state, const Eigen::Vector3d& x)
{
  double least = std::numeric_limits<double>::infinity();
  for (const Instance& instance : state.instances)
  {
    for (const auto& triangle : instance.model->triangles)
    {
      Corners corners;
      for (std::size_t k = 0; k < 3; ++k)
      {
        corners[k] = instance.world_from_object * instance.geometry->positions[triangle[k]];
      }
      least = instance.visible ? std::min(least, distanceToTriangle(x, corners)) : least;
    }
  }
  return least;
}
} // namespace

TEST(SurfaceDistance, OfATriangleIsToItsInsideItsSidesOrItsCorners)
{
  const Corners triangle{ Eigen::Vector3d(0, 0, 0), { 4, 0, 0 }, { 0, 3, 0 } };
  expectDistance({ 1, 1, 2 }, triangle, 2);
  expectDistance({ 1, 1, -2 }, triangle, 2);
  expectDistance({ 1, 1, 0 }, triangle, 0);
  expectDistance({ 2, -3, 0 }, triangle, 3);
  expectDistance({ 2, -3, 4 }, triangle, 5);
  expectDistance({ -12, 1, 5 }, triangle, 13);
  expectDistance({ 2 + 2 * 0.6, 1.5 + 2 * 0.8, 0 }, triangle, 2); // from the middle of the longest side
  expectDistance({ -3, 0, 4 }, triangle, 5);
  expectDistance({ 7, -4, 0 }, triangle, 5);
  expectDistance({ 0, 8, 12 }, triangle, 13);
  // no area
  const Corners line{ Eigen::Vector3d(0, 0, 0), { 4, 0, 0 }, { 2, 0, 0 } };
  expectDistance({ 3, 3, 4 }, line, 5);
  expectDistance({ 7, 0, 4 }, line, 5);
  expectDistance({ -3, 4, 0 }, line, 5);
  const Corners point{ Eigen::Vector3d(1, 2, 3), { 1, 2, 3 }, { 1, 2, 3 } };
  expectDistance({ 1, 5, 7 }, point, 5);
}

// Objects that are moved, squeezed and mirrored, one of them more than once.
TEST(SurfaceDistance, IsThatOfTheNearestTriangleOfAll)
{
  const auto sphere = makeSphere({ { 0, 0, 0 }, 1, 8, 12 });
  Affine3 squeezed = placement({ 4, 1, -2 }, 1.5, { 1, 2, 3 }, 0.8);
  squeezed.linear.col(0) *= 0.05;
  squeezed.linear.col(1) *= -3;
  auto state = SceneBuilder()
                 .add(sphere, placement({ -3, 0, 0 }))
                 .add(sphere, squeezed)
                 .add(sphere, placement({ 1000, 0, 0 }, 20))
                 .add(makeSoup({ 40, 2, 0.5, 3 }), placement({ 0, 3, 1 }, 0.7, { 0, 1, 0 }, 2))
                 .add(makeBox(), placement({ 0, 0, 0 }))
                 .state();
  state->instances[4].visible = false;
  const SurfaceDistance distance(state);
  const CounterRandom random(4, 1, 0, 0);
  for (std::uint32_t i = 0; i < 400; ++i)
  {
    const double reach = i % 4 == 3 ? 2000 : 6;
    const Eigen::Vector3d x(reach * (2 * random.uniform(i, 0, 0) - 1), reach * (2 * random.uniform(i, 1, 0) - 1),
      reach * (2 * random.uniform(i, 2, 0) - 1));
    const double expected = nearestOfAll(*state, x);
    ASSERT_NEAR(distance.at(x), expected, 1e-12 * (1 + expected)) << x.transpose();
  }
}

TEST(SurfaceDistance, IsInfiniteWhereThereIsNothing)
{
  auto state = SceneBuilder().add(makeBox()).state();
  EXPECT_EQ(SurfaceDistance(state).at({ 0, 0, 1e6 }), 1e6 - 1);
  state->instances[0].visible = false;
  EXPECT_EQ(SurfaceDistance(state).at({ 0, 0, 0 }), std::numeric_limits<double>::infinity());
}
