// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSensorRuns.h"

#include "dgtkError.h"
#include "dgtkThreadPool.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

namespace dgtk::test
{

namespace
{
// A million pixels: a standard deviation has a relative standard error of 0.07 %; of a quarter of them, 0.14 %.
constexpr int side = 1000;
constexpr int quarter = 250;
constexpr double onePercent = 0.01;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double degree = 3.14159265358979 / 180;

DepthSensorSetup setupOf(const DepthSensorParameters& parameters, int height = side)
{
  DepthSensorSetup setup;
  setup.parameters = parameters;
  setup.width = side;
  setup.height = height;
  setup.key = { 12, 0, 0 };
  setup.focalLength = 600;
  return setup;
}

auto plane(double z)
{
  return [z](int, int) { return z; };
}

double validPart(const std::vector<double>& depth) { return statisticsOf(depth).count / double(depth.size()); }
} // namespace

TEST(DepthSensor, WithoutEffectsDepthStaysAsItIs)
{
  DepthSensorSetup setup = setupOf({});
  setup.height = 10;
  const auto ramp = [](int x, int y) { return x % 7 == 0 ? infinity : 1 + 0.1 * x + y; };
  const std::vector<double> out = measure(setup, ramp);
  ASSERT_EQ(out.size(), std::size_t(side * 10));
  for (int i = 0; i < side * 10; ++i)
  {
    EXPECT_EQ(out[std::size_t(i)], ramp(i % side, i / side));
  }
}

TEST(DepthSensor, GaussianNoiseGrowsWithDepth)
{
  DepthSensorParameters p;
  p.gaussian = { 0.01, 0.002, 0.003 };
  for (const double z : { 1.0, 4.0 })
  {
    const Statistics s = statisticsOf(measure(setupOf(p, quarter), plane(z)));
    EXPECT_NEAR(s.mean / z, 1, onePercent);
    EXPECT_NEAR(std::sqrt(s.variance) / (0.01 + 0.002 * z + 0.003 * z * z), 1, onePercent);
  }
}

TEST(DepthSensor, AxialNoiseIsThatOfThePaper)
{
  DepthSensorParameters p;
  p.kinect.axial = 1;
  p.kinect.metres = 0.1; // decimetres
  for (const double angle : { 0.0, 40.0, 70.0, 80.0 })
  {
    for (const double z : { 0.9, 3.0 })
    {
      const Statistics s = statisticsOf(measure(setupOf(p, quarter), plane(10 * z), angle * degree));
      const double rest = (90 - angle) * degree;
      const double steep = angle < 60 ? 0 : 0.0001 / std::sqrt(z) * std::pow(angle * degree / rest, 2);
      EXPECT_NEAR(std::sqrt(s.variance) / (10 * (0.0012 + 0.0019 * std::pow(z - 0.4, 2) + steep)), 1, onePercent);
      EXPECT_NEAR(s.mean / (10 * z), 1, 0.001);
    }
  }
}

// The paper has angles from 10 to 82 degrees: near 90 its formulas would have no bound.
TEST(DepthSensor, NoiseOfSteepSurfacesIsBounded)
{
  const double sixty = 60 * 0.0174532925199432957692;
  EXPECT_GT(kinectAxialSigma(1, sixty), kinectAxialSigma(1, sixty * 0.999)) << "steep from 60 degrees on";
  for (const double angle : { 86.0, 89.9, 90.0 })
  {
    EXPECT_NEAR(kinectLateralSigma(angle * degree), 0.8 + 0.035 * 85 / 5, 1e-9);
    EXPECT_NEAR(kinectAxialSigma(2.25, angle * degree), 0.0012 + 0.0019 * 1.85 * 1.85 + 0.0001 / 1.5 * 17 * 17, 1e-9);
  }
}

TEST(DepthSensor, LateralNoiseMovesAnEdgeAsThePaperSays)
{
  DepthSensorParameters p;
  p.kinect.lateral = 1;
  const auto step = [](int x, int) { return x % 100 < 50 ? 1.0 : 2.0; };
  for (const double angle : { 0.0, 75.0 })
  {
    const double sigma = 0.8 + 0.035 * angle / (90 - angle);
    const std::vector<double> depth = measure(setupOf(p), step, angle * degree);
    for (const int distance : { 0, 1, 2 }) // pixels left of the last near one
    {
      double far = 0;
      double all = 0;
      for (int y = 0; y < side; ++y)
      {
        for (int x = 49 - distance; x < side; x += 100)
        {
          far += depth[std::size_t(y) * side + x] == 2 ? 1 : 0;
          all += 1;
        }
      }
      const double expected = normalBelow(-(distance + 0.5) / sigma); // shift of at least distance + 1, rounded
      // 10,000 pixels: the limit is five standard errors
      EXPECT_NEAR(far / all, expected, 5 * std::sqrt(expected * (1 - expected) / all)) << distance;
    }
  }
}

TEST(DepthSensor, StereoDepthsAreThoseOfWholeSteps)
{
  DepthSensorParameters p;
  p.stereo.baseline = 0.1;
  p.stereo.subpixel = 0.125;
  const auto ramp = [](int x, int) { return 1 + 0.004 * x; };
  const std::vector<double> depth = measure(setupOf(p), ramp);
  std::set<double> steps;
  for (int x = 0; x < side; ++x)
  {
    const double disparity = 60 / depth[std::size_t(x)];
    EXPECT_NEAR(disparity * 8, std::round(disparity * 8), 1e-9);
    EXPECT_LE(std::abs(disparity - 60 / ramp(x, 0)), 0.0625 + 1e-12);
    steps.insert(disparity);
  }
  EXPECT_GT(steps.size(), 300u);
}

TEST(DepthSensor, StereoNoiseIsOfTheDisparity)
{
  DepthSensorParameters p;
  p.stereo.baseline = 0.1;
  p.stereo.sigma = 0.2;
  std::vector<double> disparity = measure(setupOf(p, quarter), plane(3));
  for (double& d : disparity)
  {
    d = 60 / d;
  }
  const Statistics s = statisticsOf(disparity);
  EXPECT_NEAR(s.mean, 20, 0.002);
  EXPECT_NEAR(std::sqrt(s.variance) / 0.2, 1, onePercent);
  p.stereo.subpixel = 0.25; // Sheppard: rounding adds step^2 / 12
  disparity = measure(setupOf(p, quarter), plane(3));
  for (double& d : disparity)
  {
    d = 60 / d;
  }
  EXPECT_NEAR(statisticsOf(disparity).variance / (0.2 * 0.2 + 0.25 * 0.25 / 12), 1, onePercent);
  DepthSensorSetup parallel = setupOf(p, quarter);
  parallel.focalLength = 0;
  EXPECT_THROW(measure(parallel, plane(3)), UsageError);
}

TEST(DepthSensor, DropOutComesAtItsRates)
{
  DepthSensorParameters p;
  p.dropout.random = 0.2;
  EXPECT_NEAR((1 - validPart(measure(setupOf(p, quarter), plane(2)))) / 0.2, 1, onePercent);
  p = {};
  p.dropout.grazing = 0.3;
  p.dropout.grazingAngle = 70;
  EXPECT_NEAR((1 - validPart(measure(setupOf(p, quarter), plane(2), 70.5 * degree))) / 0.3, 1, onePercent);
  EXPECT_EQ(validPart(measure(setupOf(p, quarter), plane(2), 69.5 * degree)), 1);
  p.dropout.random = 0.2; // independent of one another
  EXPECT_NEAR(validPart(measure(setupOf(p, quarter), plane(2), 80 * degree)) / (0.8 * 0.7), 1, onePercent);
}

TEST(DepthSensor, DropOutAtEdgesStaysWithinTheirRadius)
{
  DepthSensorParameters p;
  p.dropout.edge = 0.4;
  p.dropout.edgeRadius = 2;
  p.dropout.edgeJump = 0.1;
  const auto steps = [](int x, int) { return x % 10 < 5 ? 1.0 : 1.2; };
  const std::vector<double> depth = measure(setupOf(p), steps);
  double beside = 0;
  double dropped = 0;
  for (int y = 0; y < side; ++y)
  {
    for (int x = 0; x < side; ++x)
    {
      const bool near = (x % 5 != 2) && x > 1 && x < side - 2; // all but the middle of a step
      beside += near ? 1 : 0;
      const bool gone = !std::isfinite(depth[std::size_t(y) * side + x]);
      dropped += gone ? 1 : 0;
      ASSERT_TRUE(!gone || near) << x;
    }
  }
  EXPECT_NEAR(dropped / beside / 0.4, 1, onePercent); // of 800,000 pixels: standard error 0.14 %
  p.dropout.edgeJump = 0.3;
  EXPECT_EQ(validPart(measure(setupOf(p), steps)), 1);
  const auto far = [&](int x, int y) { return 10 * steps(x, y); };
  EXPECT_EQ(validPart(measure(setupOf(p), far)), 1) << "a jump is a part of the depth";
  p.dropout.edgeJump = 0.1;
  EXPECT_LT(validPart(measure(setupOf(p), far)), 1);
}

TEST(DepthSensor, ASurfaceBesideNoneIsAtAnEdge)
{
  DepthSensorParameters p;
  p.dropout.edge = 1;
  DepthSensorSetup setup = setupOf(p);
  setup.width = 100;
  setup.height = 3;
  const std::vector<double> depth = measure(setup, [](int x, int) { return x < 50 ? infinity : 2.0; });
  for (int x = 0; x < 100; ++x)
  {
    EXPECT_EQ(std::isfinite(depth[std::size_t(100 + x)]), x > 50) << x;
  }
}

// Disparities 20.4 on the right and 10.2 on the left, which is hidden; the jump is within reach of all.
TEST(DepthSensor, WhatIsHiddenAndAtAnEdgeMayDropOutForEither)
{
  DepthSensorParameters p;
  p.stereo.baseline = 0.034;
  p.dropout.occluded = 0.5;
  p.dropout.edge = 0.5;
  p.dropout.edgeRadius = 10;
  DepthSensorSetup setup = setupOf(p);
  setup.width = 20;
  const std::vector<double> depth = measure(setup, [](int x, int) { return x < 10 ? 2.0 : 1.0; });
  double left = 0;
  double right = 0;
  for (std::size_t i = 0; i < depth.size(); ++i)
  {
    (i % 20 < 10 ? left : right) += std::isfinite(depth[i]) ? 1e-4 : 0; // of 10,000 pixels each
  }
  EXPECT_NEAR(left, 0.25, 0.025); // the limits are five standard errors and more
  EXPECT_NEAR(right, 0.5, 0.025);
}

TEST(DepthSensor, WhatTheSecondViewpointCannotSeeDropsOut)
{
  // A block at 1 before a wall at 2: disparities 20.4 and 10.2, so that the 10 columns left of the block are hidden.
  DepthSensorParameters p;
  p.stereo.baseline = 0.034;
  p.dropout.occluded = 1;
  DepthSensorSetup setup = setupOf(p);
  setup.height = 3;
  const auto block = [](int x, int) { return x >= 400 && x < 600 ? 1.0 : 2.0; };
  const std::vector<double> depth = measure(setup, block);
  for (int x = 0; x < side; ++x)
  {
    EXPECT_EQ(std::isfinite(depth[std::size_t(x)]), x < 390 || x >= 400) << x;
  }
  setup.parameters.dropout.occluded = 0.3;
  setup.height = 20000;
  setup.width = 100;
  const auto narrow = [](int x, int) { return x >= 70 ? 1.0 : 2.0; };
  const double gone = 1 - validPart(measure(setup, narrow)); // of 200,000 hidden pixels: standard error 0.34 %
  EXPECT_NEAR(gone / (0.3 * 10 / 100), 1, 2 * onePercent);
}

// Disparities 2 and 3 of neighbours: the second viewpoint sees both at one place, the nearer one, on the right, hides.
TEST(DepthSensor, OfSurfacesThatTheSecondViewpointSeesAtOnePlaceTheNearerIsSeen)
{
  DepthSensorParameters p;
  p.stereo.baseline = 1;
  p.dropout.occluded = 1;
  DepthSensorSetup setup = setupOf(p);
  setup.focalLength = 6;
  setup.width = 12;
  setup.height = 1;
  const std::vector<double> depth = measure(setup, [](int x, int) { return x < 8 ? 3.0 : 2.0; });
  for (int x = 0; x < 12; ++x)
  {
    EXPECT_EQ(std::isfinite(depth[std::size_t(x)]), x != 7) << x;
  }
}

TEST(DepthSensor, RangeAndInvalidity)
{
  DepthSensorParameters p;
  p.gaussian = { 0.5, 0, 0 };
  p.least = 2;
  p.most = 4;
  const auto striped = [](int x, int) { return x % 2 == 0 ? 3.0 : infinity; };
  const std::vector<double> depth = measure(setupOf(p), striped);
  for (std::size_t i = 0; i < depth.size(); ++i)
  {
    ASSERT_TRUE(depth[i] == infinity || (i % 2 == 0 && depth[i] >= 2 && depth[i] <= 4));
  }
  EXPECT_NEAR(2 * validPart(depth) / (1 - 2 * normalBelow(-2)), 1, onePercent);
}

TEST(DepthSensor, TheEndsOfTheRangeAreMeasured)
{
  DepthSensorParameters p;
  p.least = p.most = 2;
  EXPECT_EQ(validPart(measure(setupOf(p, quarter), plane(2))), 1);
  EXPECT_EQ(validPart(measure(setupOf(p, quarter), plane(std::nextafter(2, 1)))), 0);
  EXPECT_EQ(validPart(measure(setupOf(p, quarter), plane(std::nextafter(2, 3)))), 0);
  p.least = p.most = 0; // no limits: only what noise moves behind the camera is gone
  EXPECT_EQ(validPart(measure(setupOf(p, quarter), plane(0))), 0);
  p.gaussian = { 1, 0, 0 };
  const std::vector<double> depth = measure(setupOf(p, quarter), plane(1));
  EXPECT_GT(*std::min_element(depth.begin(), depth.end()), 0);
  EXPECT_NEAR(validPart(depth) / (1 - normalBelow(-1)), 1, onePercent);
}

TEST(DepthSensor, RowsTogetherOrApartAndThreadsGiveTheSameBytes)
{
  DepthSensorParameters p = defaultDepthSensor();
  p.stereo = { 0.1, 0.125, 0.1 };
  p.dropout.edgeRadius = 3;
  DepthSensorSetup setup = setupOf(p);
  setup.width = 97;
  setup.height = 61;
  const auto steps = [](int x, int y) { return x / 9 % 3 == 0 ? infinity : 1 + 0.1 * (x / 10) + 0.01 * y; };
  const std::vector<double> whole = measure(setup, steps, 0.5, setup.height);
  ThreadPool pool(3);
  for (const int rows : { 1, 10, 40 })
  {
    EXPECT_EQ(whole, measure(setup, steps, 0.5, rows, &pool)) << rows;
  }
}

} // namespace dgtk::test
