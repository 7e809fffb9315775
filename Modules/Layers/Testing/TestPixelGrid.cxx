// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPixelGrid.h"
#include "dgtkSyntheticScene.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

using namespace dgtk;
using namespace dgtk::test;

namespace
{
std::set<std::pair<int, int>> near(const PixelGrid& grid, const Eigen::Vector2d& pixel)
{
  std::set<std::pair<int, int>> found;
  grid.forNear(pixel, [&](int column, int row) { EXPECT_TRUE(found.emplace(column, row).second); });
  return found;
}
} // namespace

TEST(PixelGrid, HasEveryStepthPixelFromHalfAStepOn)
{
  struct Case
  {
    int width, height, step, columns, rows;
    double first;
  };
  for (const Case& c :
    { Case{ 20, 9, 1, 20, 9, 0.5 }, { 20, 9, 4, 5, 2, 2.5 }, { 19, 10, 4, 5, 2, 2.5 }, { 18, 11, 4, 4, 3, 2.5 },
      { 20, 9, 5, 4, 2, 2.5 }, { 20, 9, 16, 1, 1, 8.5 }, { 20, 8, 16, 1, 0, 8.5 }, { 20, 9, 64, 0, 0, 32.5 } })
  {
    ViewOptions options;
    options.width = c.width;
    options.height = c.height;
    const PixelGrid grid(*makeView(options).model, c.step);
    EXPECT_EQ(grid.columns(), c.columns) << c.width << ' ' << c.step;
    EXPECT_EQ(grid.rows(), c.rows) << c.height << ' ' << c.step;
    EXPECT_EQ(grid.centre(0, 0), Eigen::Vector2d(c.first, c.first));
    EXPECT_EQ(grid.centre(3, 2), Eigen::Vector2d(c.first + 3 * c.step, c.first + 2 * c.step));
  }
}

/// Points inside, on and beyond the picture's border, on pixels of the grid and in the middle between two or four.
TEST(PixelGrid, NearAreThePixelsWithinHalfAStep)
{
  ViewOptions options;
  options.width = 21;
  options.height = 14;
  for (const int step : { 1, 4, 5 })
  {
    const PixelGrid grid(*makeView(options).model, step);
    std::size_t most = 0;
    for (int j = -32; j <= 88; ++j)
    {
      for (int i = -32; i <= 116; ++i)
      {
        const double x = 0.25 * i;
        const double y = 0.25 * j;
        std::set<std::pair<int, int>> expected;
        for (int row = 0; row < grid.rows(); ++row)
        {
          for (int column = 0; column < grid.columns(); ++column)
          {
            if (std::hypot(grid.centre(column, row).x() - x, grid.centre(column, row).y() - y) <= 0.5 * step)
            {
              expected.emplace(column, row);
            }
          }
        }
        ASSERT_EQ(near(grid, { x, y }), expected) << step << ": " << x << ' ' << y;
        most = std::max(most, expected.size());
      }
    }
    EXPECT_EQ(most, 2u) << step;
  }
}
