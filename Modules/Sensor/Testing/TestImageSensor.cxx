// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSensorRuns.h"

#include "dgtkPortableMath.h"
#include "dgtkThreadPool.h"

#include <gmock/gmock.h>

namespace dgtk::test
{

namespace
{
// A million pixels of three channels: a variance has a relative standard error of 0.08 %, a rate p of
// 0.1 % sqrt((1 - p) / p), a correlation of 0.0006. A quarter of them has twice that.
constexpr int sensorSide = 1000;
constexpr int sensorQuarter = 250;
constexpr double sensorPercent = 0.01;

ImageSensorSetup setupOf(const ColorSensorParameters& parameters, int frame = 0, int height = sensorSide)
{
  ImageSensorSetup setup;
  setup.parameters = parameters;
  setup.width = sensorSide;
  setup.height = height;
  setup.key = { 11, 0, frame };
  return setup;
}

auto grey(double level)
{
  return [level](int, int, int) { return level; };
}

/// Correlation of channel 1 with itself dx, dy pixels away.
double correlation(const std::vector<float>& image, int dx, int dy)
{
  double mean = 0;
  for (std::size_t i = 1; i < image.size(); i += 3)
  {
    mean += image[i] / (double(sensorSide) * sensorSide);
  }
  double own = 0;
  double product = 0;
  for (int y = 0; y + dy < sensorSide; ++y)
  {
    for (int x = 0; x + dx < sensorSide; ++x)
    {
      const double a = image[(std::size_t(y) * sensorSide + x) * 3 + 1] - mean;
      const double b = image[(std::size_t(y + dy) * sensorSide + x + dx) * 3 + 1] - mean;
      own += a * a;
      product += a * b;
    }
  }
  return product / own;
}
} // namespace

TEST(ImageSensor, WithoutEffectsThePictureStaysAsItIs)
{
  ImageSensorSetup setup = setupOf(ColorSensorParameters());
  setup.width = 256;
  setup.height = 8;
  const auto level = [](int x, int, int) { return portable::linearFromSrgb(x / 255.0); };
  const std::vector<float> out = expose(setup, level);
  ASSERT_EQ(out.size(), std::size_t(256 * 8 * 3));
  for (std::size_t i = 0; i < out.size(); ++i)
  {
    EXPECT_NEAR(out[i] * 255, double(i / 3 % 256), 1e-3);
  }
}

TEST(ImageSensor, VarianceAgainstMeanIsTheLineOfThePhotonTransferMethod)
{
  ColorSensorParameters p = idealLinear();
  p.fullWell = 4000;
  p.gain = 1.6;
  p.shotNoise = true;
  p.readNoise = 12;
  p.darkSignal = 30;
  p.blackLevel = 0.05; // keeps the noise of dark pixels above 0
  const double perElectron = p.gain / p.fullWell;
  double sumXX = 0, sumXY = 0, sumX = 0, sumY = 0, n = 0;
  for (const double level : { 0.0, 0.1, 0.5 })
  {
    const Statistics s = statisticsOf(expose(setupOf(p, 0, sensorQuarter), grey(level)));
    const double electrons = level * p.fullWell + p.darkSignal;
    EXPECT_NEAR((s.mean - p.blackLevel) / (electrons * perElectron), 1, sensorPercent) << level;
    EXPECT_NEAR(s.variance / ((electrons + p.readNoise * p.readNoise) * perElectron * perElectron), 1, sensorPercent)
      << level;
    const double x = s.mean - p.blackLevel;
    sumXX += x * x, sumXY += x * s.variance, sumX += x, sumY += s.variance, n += 1;
  }
  const double slope = (n * sumXY - sumX * sumY) / (n * sumXX - sumX * sumX);
  EXPECT_NEAR(slope / perElectron, 1, sensorPercent);
  EXPECT_NEAR(
    (sumY - slope * sumX) / n / (p.readNoise * p.readNoise * perElectron * perElectron), 1, 5 * sensorPercent);
}

TEST(ImageSensor, ShotNoiseIsWhite)
{
  ColorSensorParameters p = idealLinear();
  p.shotNoise = true;
  p.fullWell = 1000;
  const std::vector<float> image = expose(setupOf(p), grey(0.5));
  for (const auto& [dx, dy] : { std::pair(1, 0), { 0, 1 }, { 1, 1 }, { 2, 0 } })
  {
    EXPECT_NEAR(correlation(image, dx, dy), 0, 0.004) << dx << ' ' << dy;
  }
  double between = 0; // red and green of a pixel
  const Statistics s = statisticsOf(image);
  for (std::size_t i = 0; i < image.size(); i += 3)
  {
    between += (image[i] - s.mean) * (image[i + 1] - s.mean) / (double(sensorSide) * sensorSide);
  }
  EXPECT_NEAR(between / s.variance, 0, 0.004);
  const std::vector<float> next = expose(setupOf(p, 1), grey(0.5));
  double frames = 0;
  for (std::size_t i = 0; i < image.size(); ++i)
  {
    frames += (image[i] - s.mean) * (next[i] - s.mean) / double(image.size());
  }
  EXPECT_NEAR(frames / s.variance, 0, 0.004);
}

TEST(ImageSensor, BlurredLightHasTheAutocorrelationOfThePointSpread)
{
  const CounterRandom random(5, 99, 0, 0);
  const auto noise = [&](int x, int y, int c) { return random.uniform(x, y, c); };
  for (const double sigma : { 0.7, 1.5 })
  {
    ColorSensorParameters p = idealLinear();
    p.psf.gaussian = sigma;
    const std::vector<float> image = expose(setupOf(p), noise);
    std::vector<double> h;
    double sum = 0;
    const int radius = static_cast<int>(std::ceil(4 * sigma));
    for (int i = -radius; i <= radius; ++i)
    {
      h.push_back(std::exp(-0.5 * i * i / sigma / sigma));
      sum += h.back();
    }
    const auto own = [&](int lag)
    {
      double r = 0;
      for (std::size_t i = 0; i + lag < h.size(); ++i)
      {
        r += h[i] * h[i + lag] / sum / sum;
      }
      return r;
    };
    EXPECT_NEAR(statisticsOf(image).variance / (own(0) * own(0) / 12), 1, sensorPercent);
    for (const auto& [dx, dy] : { std::pair(1, 0), { 0, 1 }, { 1, 1 }, { 2, 1 } })
    {
      EXPECT_NEAR(correlation(image, dx, dy), own(dx) * own(dy) / own(0) / own(0), sensorPercent) << dx << ' ' << dy;
    }
  }
}

TEST(ImageSensor, PointSpreadsKeepLightAndHaveTheirShape)
{
  ImageSensorSetup setup = setupOf(idealLinear());
  setup.width = setup.height = 41;
  const auto point = [](int x, int y, int) { return x == 20 && y == 20 ? 1.0 : 0.0; };
  const auto moments = [&](const std::vector<float>& image)
  {
    double sum = 0, xx = 0, yy = 0;
    for (int i = 0; i < 41 * 41; ++i)
    {
      sum += image[std::size_t(i) * 3];
      xx += image[std::size_t(i) * 3] * (i % 41 - 20) * (i % 41 - 20);
      yy += image[std::size_t(i) * 3] * (i / 41 - 20) * (i / 41 - 20);
    }
    return std::vector<double>{ sum, xx / sum, yy / sum };
  };
  setup.parameters.psf.gaussian = 2;
  EXPECT_THAT(moments(expose(setup, point)), testing::Pointwise(testing::DoubleNear(0.04), { 1.0, 4.0, 4.0 }));
  setup.parameters.psf.gaussian = 1e-200;
  EXPECT_THAT(moments(expose(setup, point)), testing::Pointwise(testing::DoubleNear(1e-6), { 1.0, 0.0, 0.0 }));
  setup.parameters.psf = {};
  setup.parameters.psf.disc = 5.3; // uniform over the disc and over the pixel
  const double variance = 5.3 * 5.3 / 4 + 1.0 / 12;
  EXPECT_THAT(moments(expose(setup, point)),
    testing::Pointwise(testing::DoubleNear(0.01 * variance), { 1.0, variance, variance }));
  // Of radius 1, in pixels of side 1: the segments beyond a half, and what is left of pi for the corners.
  setup.parameters.psf.disc = 1;
  const std::vector<float> disc = expose(setup, point);
  const double beside = std::sqrt(0.75) / 2 + std::asin(0.5) - 0.5;
  const std::vector<double> parts{ 1, beside, (pi - 1) / 4 - beside };
  for (int i = 0; i < 9; ++i)
  {
    const int x = i % 3 - 1;
    const int y = i / 3 - 1;
    const double part = disc[std::size_t((20 + y) * 41 + 20 + x) * 3];
    EXPECT_NEAR(part * pi, parts[std::size_t(std::abs(x) + std::abs(y))], 4e-3) << x << ' ' << y;
    const double points = part / disc[std::size_t(20 * 41 + 20) * 3] * 1024; // 32 x 32 in the one that is all covered
    EXPECT_NEAR(points, std::round(points), 1e-3) << x << ' ' << y;
    EXPECT_EQ(part, disc[std::size_t((20 - y) * 41 + 20 - x) * 3]) << x << ' ' << y;
  }
  setup.parameters.psf = {};
  setup.parameters.psf.kernel = { 0, 0, 4, 0, 2, 2, 0, 0, 0 };
  const std::vector<float> image = expose(setup, point);
  const auto at = [&](int x, int y) { return image[std::size_t(y * 41 + x) * 3]; };
  EXPECT_FLOAT_EQ(at(21, 19), 0.5f); // the kernel itself appears
  EXPECT_FLOAT_EQ(at(20, 20), 0.25f);
  EXPECT_FLOAT_EQ(at(21, 20), 0.25f);
  EXPECT_FLOAT_EQ(at(19, 21), 0.0f);
}

TEST(ImageSensor, TheFullWellHoldsNoMoreElectrons)
{
  ColorSensorParameters p = idealLinear();
  p.gain = 0.5;
  p.exposure = 3;
  for (const float value : expose(setupOf(p, 0, sensorQuarter), grey(1)))
  {
    ASSERT_EQ(value, 0.5F);
  }
  // Read noise comes behind the saturation: it is all the noise there is.
  p.shotNoise = true;
  p.readNoise = 40;
  const Statistics full = statisticsOf(expose(setupOf(p, 0, sensorQuarter), grey(1)));
  EXPECT_NEAR(full.mean / 0.5, 1, 1e-4);
  EXPECT_NEAR(std::sqrt(full.variance) / (p.readNoise * p.gain / p.fullWell), 1, sensorPercent);
  // So does what the reading adds: offsets of pixels, rows and columns.
  p.readNoise = 0;
  p.dsnu = 40;
  const Statistics offsets = statisticsOf(expose(setupOf(p, 0, sensorQuarter), grey(1)));
  EXPECT_NEAR(offsets.mean / 0.5, 1, 1e-4);
  EXPECT_NEAR(std::sqrt(offsets.variance) / (p.dsnu * p.gain / p.fullWell), 1, sensorPercent);
  p.dsnu = 0;
  // At a mean of just the full well the upper half is cut: that leaves sqrt(F / 2 pi) less, and 1/2 - 1 / 2 pi of the
  // variance.
  p.exposure = 1;
  p.readNoise = 0;
  const Statistics half = statisticsOf(expose(setupOf(p, 0, sensorQuarter), grey(1)));
  EXPECT_NEAR((p.fullWell - half.mean / p.gain * p.fullWell) / std::sqrt(p.fullWell / (2 * pi)), 1, sensorPercent);
  EXPECT_NEAR(half.variance / (p.gain * p.gain / p.fullWell * (0.5 - 0.5 / pi)), 1, 2 * sensorPercent);
}

TEST(ImageSensor, FixedPatternIsThatOfEveryFrameAndHasItsSpread)
{
  ColorSensorParameters p = idealLinear();
  p.prnu = 0.03;
  const std::vector<float> image = expose(setupOf(p, 0, sensorQuarter), grey(0.5));
  EXPECT_EQ(image, expose(setupOf(p, 7, sensorQuarter), grey(0.5)));
  EXPECT_NEAR(std::sqrt(statisticsOf(image).variance) / (0.03 * 0.5), 1, sensorPercent);
  p = idealLinear();
  p.dsnu = 50;
  p.blackLevel = 0.2;
  const std::vector<float> dark = expose(setupOf(p, 0, sensorQuarter), grey(0));
  EXPECT_EQ(dark, expose(setupOf(p, 7, sensorQuarter), grey(0)));
  EXPECT_NEAR(std::sqrt(statisticsOf(dark).variance) / (50 / p.fullWell), 1, sensorPercent);
  ImageSensorSetup other = setupOf(p, 0, sensorQuarter);
  other.key.camera = 1;
  EXPECT_NE(dark, expose(other, grey(0)));
}

TEST(ImageSensor, RowAndColumnPatternsAreConstantAlongThem)
{
  // Tall and wide, so that there are 100,000 rows or columns: 0.2 % standard error of their standard deviation.
  for (const bool rows : { true, false })
  {
    ColorSensorParameters p = idealLinear();
    (rows ? p.rowNoise : p.columnNoise) = 100;
    ImageSensorSetup setup = setupOf(p);
    setup.width = rows ? 2 : 100000;
    setup.height = rows ? 100000 : 2;
    const std::vector<float> image = expose(setup, grey(0.5), 5000);
    EXPECT_NEAR(std::sqrt(statisticsOf(image).variance) / (100 / p.fullWell), 1, sensorPercent) << rows;
    const std::size_t step = rows ? 3 : std::size_t(setup.width) * 3;
    for (std::size_t i = 0; i < 600; ++i)
    {
      EXPECT_EQ(image[i * 3 * (rows ? 2 : 1)], image[i * 3 * (rows ? 2 : 1) + step]);
    }
  }
}

TEST(ImageSensor, QuantisationErrorIsUniform)
{
  ColorSensorParameters p = idealLinear();
  p.bits = 6;
  const auto ramp = [](int x, int y, int) { return (x + y * double(sensorSide)) / (double(sensorSide) * sensorSide); };
  const std::vector<float> image = expose(setupOf(p), ramp);
  std::vector<double> errors;
  for (std::size_t i = 0; i < image.size(); ++i)
  {
    EXPECT_NEAR(image[i] * 63, std::round(image[i] * 63), 1e-5);
    errors.push_back((image[i] - double(i / 3) / (double(sensorSide) * sensorSide)) * 63);
  }
  const Statistics s = statisticsOf(errors);
  EXPECT_NEAR(s.mean, 0, 0.003);
  EXPECT_NEAR(s.variance * 12, 1, sensorPercent);
}

TEST(ImageSensor, SaltAndPepperComeAtTheirRates)
{
  ColorSensorParameters p;
  p.salt = 0.25;
  p.pepper = 0.15;
  const std::vector<float> image = expose(setupOf(p), grey(0.2));
  double salt = 0, pepper = 0;
  for (std::size_t i = 0; i < image.size(); i += 3)
  {
    ASSERT_EQ(image[i], image[i + 2]);
    salt += image[i] == 1 ? 1e-6 : 0;
    pepper += image[i] == 0 ? 1e-6 : 0;
  }
  EXPECT_NEAR(salt / 0.25, 1, sensorPercent);
  EXPECT_NEAR(pepper / 0.15, 1, sensorPercent);
}

TEST(ImageSensor, VignettingFollowsItsFormulas)
{
  ColorSensorParameters p = idealLinear();
  p.vignetting.cos4 = 0.8;
  p.vignetting.polynomial = { -0.2, 0.05, -0.01 };
  ImageSensorSetup setup = setupOf(p);
  setup.width = 60;
  setup.height = 40;
  setup.fieldCosine = [](int x, int y)
  { return 1 / std::sqrt(1 + (x - 29.5) * (x - 29.5) / 900 + (y - 19.5) * (y - 19.5) / 900); };
  const std::vector<float> image = expose(setup, grey(0.9));
  for (int y = 0; y < 40; ++y)
  {
    for (int x = 0; x < 60; ++x)
    {
      const double dd = (x - 29.5) * (x - 29.5) + (y - 19.5) * (y - 19.5);
      const double rr = dd / (30 * 30 + 20 * 20);
      const double factor =
        (0.2 + 0.8 / std::pow(1 + dd / 900, 2)) * (1 - 0.2 * rr + 0.05 * rr * rr - 0.01 * rr * rr * rr);
      EXPECT_NEAR(image[std::size_t(y * 60 + x) * 3], 0.9 * factor, 1e-6);
    }
  }
}

TEST(ImageSensor, ResponseCurves)
{
  ImageSensorSetup setup = setupOf(ColorSensorParameters());
  setup.width = 101;
  setup.height = 1;
  const auto ramp = [](int x, int, int) { return x / 100.0; };
  setup.parameters.response = ResponseCurve::Gamma;
  setup.parameters.gamma = 1.8;
  const std::vector<float> gamma = expose(setup, ramp);
  setup.parameters.response = ResponseCurve::Table;
  setup.parameters.table = { 0.1, 0.5, 0.7 };
  const std::vector<float> table = expose(setup, ramp);
  for (int x = 0; x <= 100; ++x)
  {
    const double v = x / 100.0;
    EXPECT_NEAR(gamma[std::size_t(x) * 3], std::pow(v, 1 / 1.8), 1e-5);
    EXPECT_NEAR(table[std::size_t(x) * 3], v < 0.5 ? 0.1 + 0.8 * v : 0.3 + 0.4 * v, 1e-6);
  }
}

TEST(ImageSensor, DemosaickedShotNoiseHasTheVarianceOfItsMeans)
{
  ColorSensorParameters p = idealLinear();
  p.shotNoise = true;
  p.fullWell = 1000;
  p.bayer = BayerPattern::GRBG; // green at (0, 0), red to its right, blue below
  const std::vector<float> image = expose(setupOf(p), grey(0.4));
  const double one = 0.4 / p.fullWell;
  const auto variance = [&](int x0, int y0, int c)
  {
    std::vector<double> values;
    for (int y = y0 + 2; y < sensorSide - 2; y += 2)
    {
      for (int x = x0 + 2; x < sensorSide - 2; x += 2)
      {
        values.push_back(image[(std::size_t(y) * sensorSide + x) * 3 + c]);
      }
    }
    return statisticsOf(values).variance / one; // of 250,000 pixels: standard error 0.28 %
  };
  EXPECT_NEAR(variance(0, 0, 1), 1, sensorPercent);
  EXPECT_NEAR(variance(0, 0, 0) * 2, 1, sensorPercent);
  EXPECT_NEAR(variance(0, 0, 2) * 2, 1, sensorPercent);
  EXPECT_NEAR(variance(1, 0, 0), 1, sensorPercent);
  EXPECT_NEAR(variance(1, 0, 1) * 4, 1, sensorPercent);
  EXPECT_NEAR(variance(1, 0, 2) * 4, 1, sensorPercent);
  EXPECT_NEAR(variance(0, 1, 2), 1, sensorPercent);
}

TEST(ImageSensor, BayerCellsHaveTheirColoursInPlace)
{
  ImageSensorSetup setup = setupOf(idealLinear());
  setup.width = 9;
  setup.height = 7;
  const struct
  {
    BayerPattern pattern;
    int channels[4]; ///< (0, 0), (1, 0), (0, 1), (1, 1)
  } cells[] = { { BayerPattern::RGGB, { 0, 1, 1, 2 } }, { BayerPattern::BGGR, { 2, 1, 1, 0 } },
    { BayerPattern::GRBG, { 1, 0, 2, 1 } }, { BayerPattern::GBRG, { 1, 2, 0, 1 } } };
  for (const auto& cell : cells)
  {
    setup.parameters.bayer = cell.pattern;
    // Light of a channel falls where the cell has its photosites, and nowhere else: everything is caught.
    const auto matched = [&](int x, int y, int c) { return cell.channels[x % 2 + y % 2 * 2] == c ? 0.5 : 0.0; };
    EXPECT_THAT(expose(setup, matched), testing::Each(testing::FloatNear(0.5f, 1e-6f)));
    const auto missed = [&](int x, int y, int c) { return cell.channels[x % 2 + y % 2 * 2] == c ? 0.0 : 0.5; };
    EXPECT_THAT(expose(setup, missed), testing::Each(0.0f));
    // Means of neighbours on both sides keep a ramp.
    const auto ramp = [](int x, int y, int c) { return 0.1 + 0.02 * x + 0.03 * y + 0.1 * c; };
    const std::vector<float> image = expose(setup, ramp);
    for (int y = 1; y < 6; ++y)
    {
      for (int x = 1; x < 8; ++x)
      {
        for (int c = 0; c < 3; ++c)
        {
          EXPECT_NEAR(image[std::size_t(y * 9 + x) * 3 + c], ramp(x, y, c), 1e-6);
        }
      }
    }
  }
}

TEST(ImageSensor, PatternsStayFromFrameToFrameAndNoiseDoesNot)
{
  using Change = std::function<void(ColorSensorParameters&)>;
  const std::tuple<const char*, Change, bool> table[] = { { "prnu", [](auto& p) { p.prnu = 0.1; }, true },
    { "dsnu", [](auto& p) { p.dsnu = 500; }, true }, { "rowNoise", [](auto& p) { p.rowNoise = 500; }, true },
    { "columnNoise", [](auto& p) { p.columnNoise = 500; }, true },
    { "texture",
      [](auto& p)
      {
        p.texture.amplitude = 0.2;
        p.texture.period = 3;
        p.texture.fixed = true;
      },
      true },
    { "moving texture",
      [](auto& p)
      {
        p.texture.amplitude = 0.2;
        p.texture.period = 3;
        p.texture.fixed = false;
      },
      false },
    { "shotNoise", [](auto& p) { p.shotNoise = true; }, false },
    { "readNoise", [](auto& p) { p.readNoise = 500; }, false }, { "salt", [](auto& p) { p.salt = 0.2; }, false },
    { "pepper", [](auto& p) { p.pepper = 0.2; }, false } };
  for (const auto& [name, change, fixed] : table)
  {
    ColorSensorParameters p = idealLinear();
    change(p);
    ImageSensorSetup setup = setupOf(p);
    setup.width = setup.height = 24;
    const std::vector<float> first = expose(setup, grey(0.4));
    EXPECT_NE(*std::min_element(first.begin(), first.end()), *std::max_element(first.begin(), first.end())) << name;
    setup.key.frame += 1;
    EXPECT_EQ(expose(setup, grey(0.4)) == first, fixed) << name;
    setup.key.frame -= 1;
    setup.key.camera += 1;
    EXPECT_NE(expose(setup, grey(0.4)), first) << name;
    setup.key.camera -= 1;
    setup.key.seed += 1;
    EXPECT_NE(expose(setup, grey(0.4)), first) << name;
  }
}

TEST(ImageSensor, RowsTogetherOrApartAndThreadsGiveTheSameBytes)
{
  ColorSensorParameters p = defaultColorSensor();
  p.psf.gaussian = 1.3;
  p.texture.amplitude = 0.1;
  p.texture.octaves = 3;
  p.rowNoise = p.columnNoise = 3;
  p.salt = p.pepper = 0.01;
  p.jpegQuality = 70;
  ImageSensorSetup setup = setupOf(p);
  setup.width = 117;
  setup.height = 83;
  const CounterRandom random(5, 99, 0, 0);
  const auto noise = [&](int x, int y, int c) { return random.uniform(x, y, c); };
  const std::vector<float> whole = expose(setup, noise, setup.height);
  ASSERT_EQ(whole.size(), std::size_t(117 * 83 * 3));
  for (const int rows : { 1, 7, 16, 50 })
  {
    EXPECT_EQ(whole, expose(setup, noise, rows)) << rows;
  }
  ThreadPool pool(3);
  EXPECT_EQ(whole, expose(setup, noise, 20, &pool));
  p.psf = {};
  p.psf.disc = 2.5;
  p.jpegFullChroma = true;
  setup.parameters = p;
  EXPECT_EQ(expose(setup, noise, setup.height), expose(setup, noise, 9, &pool));
}

} // namespace dgtk::test
