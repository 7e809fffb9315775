// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPortableMath.h"
#include "dgtkRandom.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace dgtk
{

namespace
{
constexpr std::uint32_t side = 1000; // a million pixels

struct Moments
{
  double mean = 0;
  double variance = 0;
  double skewness = 0;
  double kurtosis = 0;
};

template <typename Draw>
Moments momentsOf(const Draw& draw)
{
  std::vector<double> values;
  values.reserve(side * side);
  Moments m;
  for (std::uint32_t y = 0; y < side; ++y)
  {
    for (std::uint32_t x = 0; x < side; ++x)
    {
      values.push_back(draw(x, y));
      m.mean += values.back();
    }
  }
  const double n = double(values.size());
  m.mean /= n;
  for (const double v : values)
  {
    const double d = v - m.mean;
    m.variance += d * d / n;
    m.skewness += d * d * d / n;
    m.kurtosis += d * d * d * d / n;
  }
  m.skewness /= std::pow(m.variance, 1.5);
  m.kurtosis /= m.variance * m.variance;
  return m;
}

// Relative standard errors over a million pixels are at most 0.2 %.
constexpr double onePercent = 0.01;
} // namespace

TEST(Random, PhiloxGivesThePublishedAnswers) // kat_vectors of Random123
{
  const auto answer = [](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    return PhiloxCounter{ a, b, c, d };
  };
  const std::uint32_t ones = 0xffffffffu;
  EXPECT_EQ(philox({ 0, 0, 0, 0 }, { 0, 0 }), answer(0x6627e8d5u, 0xe169c58du, 0xbc57ac4cu, 0x9b00dbd8u));
  EXPECT_EQ(
    philox({ ones, ones, ones, ones }, { ones, ones }), answer(0x408f276du, 0x41c83b0eu, 0xa20bc7c6u, 0x6d5451fdu));
  EXPECT_EQ(philox({ 0x243f6a88u, 0x85a308d3u, 0x13198a2eu, 0x03707344u }, { 0xa4093822u, 0x299f31d0u }),
    answer(0xd16cfe09u, 0x94fdccebu, 0x5001e420u, 0x24126ea1u));
}

TEST(Random, EveryPartOfTheKeyAndCounterMatters)
{
  const CounterRandom random(1, 2, 3, 4);
  const double value = random.uniform(5, 6, 7);
  EXPECT_EQ(value, CounterRandom(1, 2, 3, 4).uniform(5, 6, 7));
  for (const CounterRandom& other : { CounterRandom(2, 2, 3, 4), CounterRandom(1ull << 32 | 1, 2, 3, 4),
         CounterRandom(1, 3, 3, 4), CounterRandom(1, 2, 4, 4), CounterRandom(1, 2, 3, 5) })
  {
    EXPECT_NE(value, other.uniform(5, 6, 7));
  }
  EXPECT_NE(value, random.uniform(6, 6, 7));
  EXPECT_NE(value, random.uniform(5, 7, 7));
  EXPECT_NE(value, random.uniform(5, 6, 8));
  EXPECT_NE(value, random.uniforms(5, 6, 7, 1)[0]);
}

TEST(Random, UniformsAreUniform)
{
  const CounterRandom random(1, 1, 0, 0);
  const Moments m = momentsOf([&](auto x, auto y) { return random.uniform(x, y, 0); });
  EXPECT_NEAR(m.mean, 0.5, 0.5 * onePercent);
  EXPECT_NEAR(m.variance, 1.0 / 12, onePercent / 12);
  EXPECT_NEAR(m.kurtosis, 1.8, 1.8 * onePercent);
}

TEST(Random, NormalsAreNormal)
{
  const CounterRandom random(1, 2, 0, 0);
  for (const int which : { 0, 1 })
  {
    const Moments m = momentsOf([&](auto x, auto y) { return random.normals(x, y, 0)[std::size_t(which)]; });
    EXPECT_NEAR(m.mean, 0, onePercent);
    EXPECT_NEAR(m.variance, 1, onePercent);
    EXPECT_NEAR(m.skewness, 0, onePercent); // its standard error is 0.0024
    EXPECT_NEAR(m.kurtosis, 3, 3 * onePercent);
  }
  double product = 0;
  for (std::uint32_t y = 0; y < side; ++y)
  {
    for (std::uint32_t x = 0; x < side; ++x)
    {
      const std::array<double, 2> n = random.normals(x, y, 0);
      product += n[0] * n[1] / (side * side);
    }
  }
  EXPECT_NEAR(product, 0, onePercent);
}

TEST(Random, NormalQuantileInvertsTheDistribution)
{
  for (const double p : { 1e-17, 1e-9, 0.001, 0.0749, 0.0751, 0.3, 0.5, 0.77, 0.999 })
  {
    const double z = normalQuantile(p);
    EXPECT_NEAR(0.5 * std::erfc(-z / std::sqrt(2.0)) / p, 1, 1e-12) << p;
  }
}

TEST(Random, PoissonHasItsMeanVarianceAndThirdMoment)
{
  for (const double mean : { 0.5, 3.0, 9.99, 10.0, 47.3, 900.0, 1000.0, 1e6 })
  {
    const CounterRandom random(3, 1, 0, 0);
    const Moments m = momentsOf([&](auto x, auto y) { return random.poisson(mean, x, y, 0); });
    EXPECT_NEAR(m.mean / mean, 1, onePercent) << mean;
    EXPECT_NEAR(m.variance / mean, 1, onePercent) << mean;
    EXPECT_NEAR(m.skewness, 1 / std::sqrt(mean), 0.015 / std::sqrt(std::min(mean, 1.0))) << mean;
  }
}

TEST(Random, PoissonProbabilitiesAreThoseOfTheFormula)
{
  for (const double mean : { 4.0, 12.0, 60.0 })
  {
    const CounterRandom random(4, 1, 0, 0);
    std::vector<double> count(200, 0);
    const double n = double(side) * side;
    for (std::uint32_t y = 0; y < side; ++y)
    {
      for (std::uint32_t x = 0; x < side; ++x)
      {
        count[std::size_t(random.poisson(mean, x, y, 0))] += 1;
      }
    }
    double chiSquare = 0;
    int bins = 0;
    for (std::size_t k = 0; k < count.size(); ++k)
    {
      const double expected = n * std::exp(double(k) * std::log(mean) - mean - std::lgamma(double(k) + 1));
      if (expected > 50)
      {
        chiSquare += (count[k] - expected) * (count[k] - expected) / expected;
        ++bins;
      }
    }
    EXPECT_LT(chiSquare, bins + 5 * std::sqrt(2.0 * bins)) << mean; // five standard deviations
  }
}

TEST(Random, PoissonOfNothingIsNothing)
{
  const CounterRandom random(1, 1, 0, 0);
  EXPECT_EQ(random.poisson(0, 1, 2, 3), 0);
  EXPECT_EQ(random.poisson(-1, 1, 2, 3), 0);
  EXPECT_EQ(random.poisson(std::nan(""), 1, 2, 3), 0);
}

TEST(PortableMath, AgreesWithTheLibrary)
{
  const auto relative = [](double a, double b) { return std::abs(a - b) / std::max(std::abs(b), 1e-300); };
  for (int i = 1; i < 20000; ++i)
  {
    const double x = i * 0.0137 + 1e-6;
    EXPECT_LT(std::abs(portable::log(x) - std::log(x)), 1e-14 * std::max(1.0, std::abs(std::log(x)))) << x;
    EXPECT_LT(relative(portable::exp(x - 137), std::exp(x - 137)), 1e-14) << x;
    EXPECT_LT(relative(portable::pow(x, 1 / 2.4), std::pow(x, 1 / 2.4)), 1e-14) << x;
    EXPECT_LT(relative(portable::acos(i / 20000.0), std::acos(i / 20000.0)), 1e-13) << i;
    EXPECT_LT(std::abs(portable::logFactorial(i) - std::lgamma(i + 1.0)), 1e-10 + 1e-14 * std::lgamma(i + 1.0)) << i;
  }
  EXPECT_EQ(portable::exp(-1e9), 0);
  EXPECT_EQ(portable::acos(1), 0);
}

TEST(PortableMath, AnglesAgreeWithTheLibrary)
{
  for (int i = -20000; i <= 20000; ++i)
  {
    const double x = i * 0.00137;
    const portable::SineCosine both = portable::sinCos(x);
    ASSERT_NEAR(both.sine, std::sin(x), 1e-15) << x;
    ASSERT_NEAR(both.cosine, std::cos(x), 1e-15) << x;
    const double radius = std::exp(i * 1e-3);
    ASSERT_NEAR(portable::atan2(radius * std::sin(x), radius * std::cos(x)),
      std::atan2(radius * std::sin(x), radius * std::cos(x)), 1e-15)
      << x;
  }
  EXPECT_EQ(portable::atan2(0, 0), 0);
  EXPECT_EQ(portable::atan2(0, -3), dgtk::pi);
  EXPECT_EQ(portable::atan2(-3, 0), -dgtk::pi / 2);
  EXPECT_EQ(portable::sinCos(0).sine, 0);
}

TEST(PortableMath, WhatIsAskedForOnceIsTheNearestDouble)
{
  EXPECT_EQ(portable::sin(1), 0.8414709848078965);    // 0.841470984807896506652502...
  EXPECT_EQ(portable::cos(1), 0.5403023058681398);    // 0.540302305868139717400936...
  EXPECT_EQ(portable::tan(1), 1.5574077246549023);    // 1.557407724654902230506974...
  EXPECT_EQ(portable::asin(0.5), 0.5235987755982989); // pi / 6 = 0.523598775598298873077107...
  EXPECT_EQ(portable::asin(-1), -dgtk::pi / 2);
  EXPECT_EQ(portable::atan(1), dgtk::pi / 4);
  EXPECT_EQ(portable::atan(-HUGE_VAL), -dgtk::pi / 2);
  EXPECT_TRUE(std::signbit(portable::atan(-0.0)));
  int other = 0;
  for (int i = -20000; i <= 20000; ++i)
  {
    const double x = i * 1.37e-3;
    const double arc = portable::atan(x);
    const auto expected = static_cast<double>(std::atan(static_cast<long double>(x)));
    ASSERT_LE(std::abs(arc - expected), std::nextafter(std::abs(expected), 2) - std::abs(expected)) << x;
    other += arc != expected ? 1 : 0;
    ASSERT_NEAR(portable::tan(arc), x, 4e-16 * (1 + x * x)) << x;
    ASSERT_NEAR(portable::asin(portable::sin(arc)), arc, 4e-16 * std::sqrt(1 + x * x)) << x;
    ASSERT_NEAR(portable::cos(arc), 1 / std::sqrt(1 + x * x), 3e-16) << x;
  }
  EXPECT_LE(other, 60); // of 40,001: the middle between two doubles is a matter of luck
}

TEST(PortableMath, SrgbIsThatOfTheStandard)
{
  EXPECT_EQ(portable::linearFromSrgb(0), 0);
  EXPECT_EQ(portable::linearFromSrgb(2), 1);
  EXPECT_EQ(portable::srgbFromLinear(1), 1);
  for (int i = 0; i <= 100000; ++i)
  {
    const double v = i / 100000.0;
    const double decoded = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    const double encoded = v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
    ASSERT_NEAR(portable::linearFromSrgb(v), decoded, 1e-10);
    ASSERT_NEAR(portable::srgbFromLinear(v), encoded, 1e-10);
    ASSERT_NEAR(portable::linearFromEncoded(float(v)), decoded, 1e-7);
    ASSERT_NEAR(portable::encodedFromLinear(float(v)), encoded, 1e-7 + 1e-7 * 13);
  }
  EXPECT_NEAR(portable::linearFromEncoded(2.0f), std::pow(2.055 / 1.055, 2.4), 1e-6);
  EXPECT_NEAR(portable::encodedFromLinear(4.0f), 1.055 * std::pow(4, 1 / 2.4) - 0.055, 1e-6);
}

} // namespace dgtk
