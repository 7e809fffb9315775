// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDrawingRate.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{
using namespace dgtk;

constexpr std::size_t all = 1000000;
constexpr std::size_t usual = DrawingRate::usualTriangles;

TEST(DrawingRate, WhatIsTooSlowGetsFewerTriangles)
{
  DrawingRate rate;
  EXPECT_EQ(rate.mostTriangles(), std::numeric_limits<std::size_t>::max());
  rate.add(all, 0.3);
  EXPECT_NEAR(double(rate.mostTriangles()), 500000, 1);
  for (int i = 0; i < 10; ++i)
  {
    rate.add(all, 2);
  }
  EXPECT_EQ(rate.mostTriangles(), usual);
}

TEST(DrawingRate, ASlowDrawingAmongOthersSaysNothing)
{
  DrawingRate rate;
  rate.add(all, 0.1);
  rate.add(all, 3);
  EXPECT_GT(rate.mostTriangles(), all);
}

/// A view that had become coarse draws too few triangles to be measured by: it must be fine again nevertheless.
TEST(DrawingRate, ACoarseViewRecovers)
{
  DrawingRate rate;
  rate.add(all, 3);
  EXPECT_EQ(rate.mostTriangles(), usual);
  rate.add(usual / 3, 0.01);
  EXPECT_GT(rate.mostTriangles(), all);
}

TEST(DrawingRate, FewTrianglesSlowNothingDown)
{
  DrawingRate rate;
  rate.add(all, 0.1);
  for (int i = 0; i < 10; ++i)
  {
    rate.add(10, 0.02);
  }
  EXPECT_GT(rate.mostTriangles(), all);
}
} // namespace
