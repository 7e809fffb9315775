// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampleDraws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace
{
using dgtk::SampleDraws;

// Largest distance between the distribution of numbers in [0, 1) and the uniform one.
double kolmogorov(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  double largest = 0;
  const double n = double(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    largest = std::max({ largest, values[i] - double(i) / n, double(i + 1) / n - values[i] });
  }
  return largest;
}
} // namespace

TEST(SampleDraws, AreFunctionsOfTheirKeysAlone)
{
  const SampleDraws draws(7, 700);
  EXPECT_EQ(draws.uniforms("objects/cup#3/scale"), SampleDraws(7, 700).uniforms("objects/cup#3/scale"));
  EXPECT_NE(draws.uniforms("objects/cup#3/scale"), draws.uniforms("objects/cup#4/scale"));
  EXPECT_NE(draws.uniforms("a"), SampleDraws(8, 700).uniforms("a"));
  EXPECT_NE(draws.uniforms("a"), SampleDraws(7, 701).uniforms("a"));
  EXPECT_NE(draws.uniforms("a", 0), draws.uniforms("a", 1));
  EXPECT_NE(draws.uniforms("a", 0, 0), draws.uniforms("a", 0, 1));
  EXPECT_NE(SampleDraws(1, 11).uniforms("a"), SampleDraws(11, 1).uniforms("a"));
  EXPECT_NE(SampleDraws(7, 0).uniforms("a"), SampleDraws(7, std::uint64_t(1) << 32).uniforms("a"));
}

// 100,000 numbers; the bound is exceeded once in 10,000 sets.
TEST(SampleDraws, AreUniform)
{
  constexpr int count = 100000;
  std::vector<double> overSamples;
  std::vector<double> overPaths;
  for (int i = 0; i < count; ++i)
  {
    overSamples.push_back(SampleDraws(3, std::uint64_t(i)).uniforms("parameters/n")[1]);
    overPaths.push_back(SampleDraws(3, 5).uniform("objects/cup#" + std::to_string(i) + "/scale"));
  }
  const double bound = 2.23 / std::sqrt(double(count));
  EXPECT_LT(kolmogorov(overSamples), bound);
  EXPECT_LT(kolmogorov(overPaths), bound);
}
