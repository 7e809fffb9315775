// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCoverage.h"
#include "dgtkMatte.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <random>

using namespace dgtk;

namespace
{
constexpr double infinite = std::numeric_limits<double>::infinity();

// Section 4.7.2 of the thesis.
const std::uint32_t thesisIds[16] = { 9, 10, 10, 10, 9, 10, 10, 10, 9, 9, 10, 10, 9, 10, 10, 10 };
const double thesisDepths[16] = { 1, 1, 0.8, 1, 0.8, 1, 0.8, 1, 1, 0.5, 0.8, 1, 0.5, 1, 0.8, 1 };
} // namespace

TEST(Alpha, TheWorkedExampleOfTheThesis)
{
  const SampleCount found = nearestCoverage(thesisIds, thesisDepths, 16);
  EXPECT_EQ(found.id, 9u);
  EXPECT_EQ(found.count, 5u); // of 16
}

TEST(Alpha, BackgroundIsInfinitelyFar)
{
  const std::uint32_t ids[4] = { 0, 0, 7, 0 };
  const double depths[4] = { infinite, infinite, 1e30, infinite };
  EXPECT_EQ(nearestCoverage(ids, depths, 4), (SampleCount{ 7, 1 }));
  const std::uint32_t nothing[4] = { 0, 0, 0, 0 };
  const double far[4] = { infinite, infinite, infinite, infinite };
  EXPECT_EQ(nearestCoverage(nothing, far, 4), (SampleCount{ 0, 4 }));
}

TEST(Alpha, EquallyNearObjectsAreDecidedByTheirIdNotByTheirOrder)
{
  const double depths[3] = { 2, 2, 3 };
  const std::uint32_t one[3] = { 5, 4, 4 };
  const std::uint32_t other[3] = { 4, 5, 4 };
  EXPECT_EQ(nearestCoverage(one, depths, 3), (SampleCount{ 4, 2 }));
  EXPECT_EQ(nearestCoverage(other, depths, 3), (SampleCount{ 4, 2 }));
  const double rounded[3] = { 2, 2 * (1 + 1e-15), 3 }; // of a floor, whose rows have one depth each
  EXPECT_EQ(nearestCoverage(one, rounded, 3), (SampleCount{ 4, 2 }));
  const double apart[3] = { 2, 2 * (1 + 1e-8), 3 };
  EXPECT_EQ(nearestCoverage(one, apart, 3), (SampleCount{ 5, 1 }));
}

TEST(Coverage, Equation411OfTheExample)
{
  std::vector<SampleCount> ranks;
  rankCoverages(thesisIds, 16, ranks);
  EXPECT_EQ(ranks, (std::vector<SampleCount>{ { 10, 11 }, { 9, 5 } }));
}

TEST(Coverage, SumsToAllSamplesAndIsSorted)
{
  std::mt19937 random(3);
  for (int round = 0; round < 500; ++round)
  {
    const int samples = 1 + static_cast<int>(random() % 256);
    std::vector<std::uint32_t> ids(samples);
    for (std::uint32_t& id : ids)
    {
      id = random() % 12;
    }
    std::vector<SampleCount> ranks;
    rankCoverages(ids.data(), samples, ranks);
    int sum = 0;
    for (std::size_t i = 0; i < ranks.size(); ++i)
    {
      sum += static_cast<int>(ranks[i].count);
      EXPECT_EQ(std::count(ids.begin(), ids.end(), ranks[i].id), ranks[i].count);
      if (i > 0)
      {
        EXPECT_TRUE(ranks[i - 1].count > ranks[i].count ||
                    (ranks[i - 1].count == ranks[i].count && ranks[i - 1].id < ranks[i].id));
      }
    }
    EXPECT_EQ(sum, samples);
  }
}

TEST(SampleOffset, IsCentredAndEven)
{
  for (int count = 1; count <= 16; ++count)
  {
    double sum = 0;
    for (int i = 0; i < count; ++i)
    {
      sum += sampleOffset(i, count);
      EXPECT_NEAR(sampleOffset(i, count), -sampleOffset(count - 1 - i, count), 1e-16);
    }
    EXPECT_NEAR(sum, 0, 1e-14);
    if (count % 2 == 1)
    {
      EXPECT_EQ(sampleOffset(count / 2, count), 0.0);
    }
  }
}

TEST(Matte, TheEquationHoldsWithinOneStep)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<float> value(-0.1f, 1.1f);
  constexpr std::size_t pixels = 5000;
  constexpr int samples = 5;
  std::vector<std::uint16_t> count(pixels);
  std::vector<float> F(pixels * 3);
  std::vector<float> B(pixels * 3);
  for (std::size_t i = 0; i < pixels; ++i)
  {
    count[i] = random() % 26;
  }
  for (std::size_t c = 0; c < pixels * 3; ++c)
  {
    F[c] = value(random);
    B[c] = value(random);
  }
  std::vector<std::uint16_t> f(pixels * 3), b(pixels * 3), a(pixels), composite(pixels * 3);
  composeMatte(count.data(), F.data(), B.data(), samples, pixels, f.data(), b.data(), a.data(), composite.data());
  for (std::size_t c = 0; c < pixels * 3; ++c)
  {
    const double alpha = a[c / 3] / 65535.0;
    EXPECT_NEAR(alpha, count[c / 3] / 25.0, 0.5 / 65535 + 1e-8);
    EXPECT_LE(std::abs(alpha * f[c] + (1 - alpha) * b[c] - composite[c]), 0.5 + 1e-9);
    EXPECT_NEAR(f[c], 65535 * std::min(1.0, std::max(0.0, double(F[c]))), 0.5 + 1e-6);
  }
}

TEST(Matte, TheTrimapIsUnknownWithinTwoPixelsOfAnEdge)
{
  // columns 0..5 background, 6 half, 7.. foreground
  constexpr int width = 16;
  Matte matte(width, 2);
  std::vector<std::uint16_t> row(width, 4);
  std::fill(row.begin(), row.begin() + 6, 0);
  row[6] = 2;
  for (int y = 0; y < 3; ++y)
  {
    matte.addRows(row.data(), 1);
  }
  std::vector<std::uint8_t> trimap(width);
  matte.trimapRow(1, trimap.data());
  for (int x = 0; x < width; ++x)
  {
    EXPECT_EQ(trimap[x], x < 4 ? trimapBackground : x > 8 ? trimapForeground : trimapUnknown) << x;
  }
}

TEST(Matte, TheTrimapLooksUpAndDownAndStopsAtTheBorder)
{
  constexpr int width = 3;
  Matte matte(width, 1);
  for (int y = 0; y < 8; ++y)
  {
    matte.addRows(std::vector<std::uint16_t>(width, y < 4 ? 0 : 1).data(), 1);
  }
  for (int y = 0; y < 8; ++y)
  {
    std::uint8_t trimap[width];
    matte.trimapRow(y, trimap);
    const std::uint8_t expected = y < 2 ? trimapBackground : y > 5 ? trimapForeground : trimapUnknown;
    EXPECT_EQ(trimap[0], expected) << y;
    EXPECT_EQ(trimap[2], expected) << y;
  }
}
