// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkGradientNoise.h"
#include "dgtkJpegArtefacts.h"
#include "dgtkSensorRuns.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cmath>

namespace dgtk::test
{

namespace
{
using Bytes = std::vector<unsigned char>;

/// A smooth coloured picture with an edge and some noise.
Bytes picture(int width, int height, bool grey)
{
  const CounterRandom random(1, 1, 0, 0);
  Bytes bytes;
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      for (int c = 0; c < 3; ++c)
      {
        const int channel = grey ? 0 : c;
        const double v = 90 + 60 * std::sin(x * 0.05 * (channel + 1)) + 50 * std::cos(y * 0.04 + channel) +
                         (x + y > width ? 30 : 0) + 20 * random.uniform(x, y, channel);
        bytes.push_back(static_cast<unsigned char>(std::min(std::max(v, 0.0), 255.0)));
      }
    }
  }
  return bytes;
}

Bytes throughLibjpeg(const Bytes& bytes, int width, int height, int quality, const std::string& chroma)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("a.jpg");
  OIIO::ImageSpec spec(width, height, 3, OIIO::TypeDesc::UINT8);
  spec.attribute("Compression", "jpeg:" + std::to_string(quality));
  spec.attribute("jpeg:subsampling", chroma);
  const auto out = OIIO::ImageOutput::create(path);
  EXPECT_TRUE(out && out->open(path, spec) && out->write_image(OIIO::TypeDesc::UINT8, bytes.data()) && out->close());
  Bytes read(bytes.size());
  const auto in = OIIO::ImageInput::open(path);
  EXPECT_TRUE(in && in->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, read.data()));
  return read;
}

Bytes throughOwn(const Bytes& bytes, int width, int height, int quality, bool subsampled)
{
  const sensor::JpegArtefacts jpeg(quality, subsampled);
  Bytes out;
  for (int y = 0; y < height; y += jpeg.blockRows())
  {
    std::vector<std::vector<float>> rows;
    for (int r = y; r < std::min(y + jpeg.blockRows(), height); ++r)
    {
      std::vector<float> row;
      row.reserve(std::size_t(width) * 3);
      for (int i = 0; i < width * 3; ++i)
      {
        row.push_back(bytes[std::size_t(r) * width * 3 + i] / 255.0f);
      }
      rows.push_back(row);
    }
    jpeg.apply(rows);
    for (const std::vector<float>& row : rows)
    {
      for (const float v : row)
      {
        out.push_back(static_cast<unsigned char>(v * 255 + 0.5f));
      }
    }
  }
  return out;
}

double meanDifference(const Bytes& a, const Bytes& b)
{
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    sum += std::abs(int(a[i]) - int(b[i])) / double(a.size());
  }
  return sum;
}

double meanSquare(const Bytes& a, const Bytes& b)
{
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const double d = double(a[i]) - double(b[i]);
    sum += d * d / double(a.size());
  }
  return sum;
}

ImageSensorSetup partsOf(const ColorSensorParameters& parameters)
{
  ImageSensorSetup setup;
  setup.parameters = parameters;
  setup.key = { 11, 0, 0 };
  return setup;
}

auto evenly(double level)
{
  return [level](int, int, int) { return level; };
}
} // namespace

TEST(JpegArtefacts, AreThoseOfLibjpeg)
{
  constexpr int width = 203; // no multiple of a block
  constexpr int height = 155;
  const Bytes color = picture(width, height, false);
  const Bytes grey = picture(width, height, true);
  for (const int quality : { 20, 60, 90 })
  {
    SCOPED_TRACE(quality);
    // libjpeg computes in whole numbers, so that coefficients near the middle between two levels fall to the other
    // side: half a grey level on the mean. What is lost must be as much.
    const Bytes full = throughOwn(color, width, height, quality, false);
    const Bytes fullReference = throughLibjpeg(color, width, height, quality, "4:4:4");
    EXPECT_LT(meanDifference(full, fullReference), 0.5);
    EXPECT_NEAR(meanSquare(full, color) / meanSquare(fullReference, color), 1, 0.02);
    const Bytes half = throughOwn(grey, width, height, quality, true);
    const Bytes halfReference = throughLibjpeg(grey, width, height, quality, "4:2:0");
    EXPECT_LT(meanDifference(half, halfReference), 0.5);
    EXPECT_NEAR(meanSquare(half, grey) / meanSquare(halfReference, grey), 1, 0.02);
    // libjpeg smooths the chroma between its samples, here they are repeated.
    EXPECT_LT(meanDifference(throughOwn(color, width, height, quality, true),
                throughLibjpeg(color, width, height, quality, "4:2:0")),
      3);
  }
}

// T.81: of a grey block there is the mean times 8, in steps of 16, as scaled for the quality, 255 at most.
TEST(JpegArtefacts, GreyLevelsAreThoseOfTheQuality)
{
  for (const auto& [quality, step] : { std::pair(1, 255), { 3, 255 }, { 4, 200 }, { 25, 32 }, { 50, 16 }, { 75, 8 } })
  {
    const int halfway = step / 16;
    for (const int grey : { 128 + halfway - 1, 128 + halfway + 1, 40, 100, 255 })
    {
      const double level = std::round((grey - 128) * 8.0 / step) * step / 8 + 128;
      const auto expected = static_cast<unsigned char>(std::floor(std::clamp(level, 0.0, 255.0) + 0.5));
      EXPECT_EQ(throughOwn(Bytes(8 * 8 * 3, static_cast<unsigned char>(grey)), 8, 8, quality, false),
        Bytes(8 * 8 * 3, expected))
        << quality << ' ' << grey;
    }
  }
}

// Two of four pixels have a blue chroma of 1: halves are rounded down and up in turn, as in libjpeg.
TEST(JpegArtefacts, HalvesOfChromaGoDownAndUpInTurn)
{
  Bytes bytes;
  for (int i = 0; i < 16 * 16; ++i)
  {
    bytes.insert(bytes.end(), { 128, 128, static_cast<unsigned char>(i % 2 == 0 ? 128 : 130) });
  }
  const Bytes out = throughOwn(bytes, 16, 16, 100, true);
  double blue = 0;
  for (std::size_t i = 2; i < out.size(); i += 3)
  {
    blue += out[i] / 256.0;
  }
  EXPECT_NEAR(blue, 129, 0.25); // 128 + 1.772 * (0 or 1), rounded
}

// At the nodes of its lattice the noise is 0: those of all octaves but the first are where the pixels' centres are.
TEST(GradientNoise, EachOctaveHasTwiceTheFrequency)
{
  TextureParameters p;
  p.amplitude = 1;
  p.period = 1;
  p.persistence = 0.5;
  p.octaves = 1;
  const sensor::GradientNoise one(p, CounterRandom(3, 1, 0, 0));
  p.octaves = 4;
  const sensor::GradientNoise four(p, CounterRandom(3, 1, 0, 0));
  p.period = 0.5;
  const sensor::GradientNoise none(p, CounterRandom(3, 1, 0, 0));
  double largest = 0;
  for (int x = 0; x < 50; ++x)
  {
    EXPECT_EQ(four.at(x, 2 * x), one.at(x, 2 * x));
    EXPECT_EQ(none.at(x, 2 * x), 0);
    largest = std::max(largest, std::abs(one.at(x, 2 * x)));
  }
  EXPECT_GT(largest, 0.3);
}

TEST(GradientNoise, HasTheMeanAndVarianceOfItsGradients)
{
  TextureParameters p;
  p.amplitude = 1;
  p.period = 8;
  double sum = 0, square = 0, expected = 0, largest = 0;
  const int seeds = 16;
  const int side = 256; // 1024 cells for each seed
  for (int seed = 0; seed < seeds; ++seed)
  {
    const sensor::GradientNoise noise(p, CounterRandom(std::uint64_t(seed), 1, 0, 0));
    for (int y = 0; y < side; ++y)
    {
      for (int x = 0; x < side; ++x)
      {
        const double v = noise.at(x, y);
        sum += v / (seeds * side * side);
        square += v * v / (seeds * side * side);
        largest = std::max(largest, std::abs(v));
      }
    }
  }
  // Gradients of length sqrt(2) in random directions: the slope along d has the variance |d|^2.
  const auto fade = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  for (int i = 0; i < 64; ++i)
  {
    const double u = (i % 8 + 0.5) / 8, v = (i / 8 + 0.5) / 8;
    for (const double a : { 0.0, 1.0 })
    {
      for (const double b : { 0.0, 1.0 })
      {
        const double weight = (a == 0 ? 1 - fade(u) : fade(u)) * (b == 0 ? 1 - fade(v) : fade(v));
        expected += weight * weight * ((u - a) * (u - a) + (v - b) * (v - b)) / 64;
      }
    }
  }
  EXPECT_NEAR(sum, 0, 0.01);
  EXPECT_NEAR(square / expected, 1, 0.03); // 16,384 cells, each with few independent values
  EXPECT_LE(largest, 1);
  EXPECT_GT(largest, 0.7);
}

TEST(GradientNoise, OctavesAddUp)
{
  const CounterRandom random(1, 1, 0, 0);
  TextureParameters p;
  p.amplitude = 0.5;
  p.octaves = 1;
  const double first = sensor::GradientNoise(p, random).at(13, 21);
  p.octaves = 2;
  p.persistence = 0;
  EXPECT_EQ(sensor::GradientNoise(p, random).at(13, 21), first);
  p.persistence = 0.5;
  EXPECT_NE(sensor::GradientNoise(p, random).at(13, 21), first);
}

TEST(GradientNoise, HasNoJumps)
{
  TextureParameters p;
  p.amplitude = 1;
  p.octaves = 1;
  p.period = 64;
  const sensor::GradientNoise noise(p, CounterRandom(3, 1, 0, 0));
  double largest = 0;
  for (int i = 0; i < 256 * 256; ++i)
  {
    const int x = i % 256;
    const int y = i / 256;
    largest = std::max(
      { largest, std::abs(noise.at(x + 1, y) - noise.at(x, y)), std::abs(noise.at(x, y + 1) - noise.at(x, y)) });
  }
  EXPECT_LT(largest, 5.0 / 64); // gradients of the length 1.42, and what blending two of them by the fade adds
}

TEST(GradientNoise, OctavesHaveGradientsOfTheirOwn)
{
  const CounterRandom random(3, 1, 0, 0);
  TextureParameters p;
  p.amplitude = 1;
  p.persistence = 1;
  p.period = 8;
  p.octaves = 1;
  const sensor::GradientNoise first(p, random);
  p.octaves = 2;
  const sensor::GradientNoise both(p, random);
  p.octaves = 1;
  p.period = 4;
  const sensor::GradientNoise finer(p, random);
  double own = 0;
  double product = 0;
  for (int i = 0; i < 200 * 200; ++i)
  {
    const double second = both.at(i % 200, i / 200) - first.at(i % 200, i / 200);
    own += second * second;
    product += second * finer.at(i % 200, i / 200);
  }
  EXPECT_GT(own / (200 * 200), 0.05);
  EXPECT_NEAR(product / own, 0, 0.1); // of 2,500 cells
}

/// What leaves the sensor is what leaves it without a code, coded.
TEST(ImageSensor, ThePictureIsCodedLast)
{
  const CounterRandom random(5, 99, 0, 0);
  const auto noise = [&](int x, int y, int c) { return random.uniform(x, y, c); };
  for (const auto& [quality, full] : { std::pair(60, false), { 60, true }, { 1, false } })
  {
    ImageSensorSetup setup;
    setup.parameters = defaultColorSensor();
    setup.width = 37;
    setup.height = 43;
    const std::vector<float> plain = expose(setup, noise, 10);
    setup.parameters.jpegQuality = quality;
    setup.parameters.jpegFullChroma = full;
    const sensor::JpegArtefacts jpeg(quality, !full);
    std::vector<float> coded;
    const auto values = std::ptrdiff_t(3) * setup.width;
    for (int y = 0; y < setup.height; y += jpeg.blockRows())
    {
      std::vector<std::vector<float>> strip;
      for (int row = y; row < std::min(setup.height, y + jpeg.blockRows()); ++row)
      {
        strip.emplace_back(plain.begin() + row * values, plain.begin() + (row + 1) * values);
      }
      jpeg.apply(strip);
      for (const std::vector<float>& row : strip)
      {
        coded.insert(coded.end(), row.begin(), row.end());
      }
    }
    EXPECT_NE(coded, plain);
    EXPECT_EQ(expose(setup, noise, 10), coded) << full;
  }
}

// At the border neighbours are mirrored: those of a colour are of that colour, also in the smallest images.
TEST(ImageSensor, BordersOfAMosaicHaveTheirColours)
{
  ImageSensorSetup setup = partsOf(idealLinear());
  for (const auto& [width, height] : { std::pair(2, 2), { 5, 2 }, { 2, 3 }, { 6, 5 } })
  {
    setup.width = width;
    setup.height = height;
    for (const auto pattern : { BayerPattern::RGGB, BayerPattern::BGGR, BayerPattern::GRBG, BayerPattern::GBRG })
    {
      setup.parameters.bayer = pattern;
      const std::vector<float> image = expose(setup, [](int, int, int c) { return 0.25 * (c + 1); });
      for (std::size_t i = 0; i < image.size(); ++i)
      {
        ASSERT_NEAR(image[i], 0.25 * double(i % 3 + 1), 1e-6) << width << 'x' << height << " value " << i;
      }
    }
  }
  setup.width = setup.height = 1; // one photosite
  EXPECT_THAT(expose(setup, evenly(0.5)), testing::Each(testing::FloatNear(0.5f, 1e-6f)));
}

// Light is not negative: what texture adds to a corner that a lens leaves dark is seen there.
TEST(ImageSensor, CornersBeyondTheVignetteAreBlack)
{
  ImageSensorSetup setup = partsOf(idealLinear());
  setup.width = setup.height = 16;
  setup.parameters.texture.amplitude = 0.3;
  setup.parameters.texture.period = 3;
  setup.parameters.texture.multiplicative = false;
  const std::vector<float> unlit = expose(setup, evenly(0));
  EXPECT_GT(*std::max_element(unlit.begin(), unlit.end()), 0.05F);
  setup.parameters.vignetting.polynomial = { -16, 0, 0 }; // nothing from a quarter of the radius on
  const std::vector<float> lit = expose(setup, evenly(0.5));
  for (int i = 0; i < 16 * 16; ++i)
  {
    const double dx = i % 16 - 7.5;
    const double dy = i / 16 - 7.5; // NOLINT: of the row
    const bool dark = (dx * dx + dy * dy) / 128 > 1.0 / 16;
    ASSERT_GE(lit[std::size_t(i) * 3], unlit[std::size_t(i) * 3]) << i;
    ASSERT_TRUE(!dark || lit[std::size_t(i) * 3] == unlit[std::size_t(i) * 3]) << i;
  }
}

TEST(ImageSensor, TextureIsOfTheLightOrAddedToIt)
{
  ImageSensorSetup setup = partsOf(idealLinear());
  setup.width = setup.height = 12;
  setup.parameters.texture.amplitude = 0.1;
  setup.parameters.texture.period = 3;
  for (const bool multiplicative : { true, false })
  {
    setup.parameters.texture.multiplicative = multiplicative;
    const std::vector<float> bright = expose(setup, evenly(0.8));
    const std::vector<float> dim = expose(setup, evenly(0.4));
    for (std::size_t i = 0; i < bright.size(); ++i)
    {
      ASSERT_NEAR(bright[i], multiplicative ? 2 * dim[i] : dim[i] + 0.4, 1e-6) << i;
    }
  }
}

TEST(ImageSensor, OneBitIsBlackOrWhite)
{
  ImageSensorSetup setup = partsOf(idealLinear());
  setup.width = 101;
  setup.height = 1;
  setup.parameters.bits = 1;
  const std::vector<float> image = expose(setup, [](int x, int, int) { return x / 100.0 + 0.001; });
  for (std::size_t x = 0; x < 101; ++x)
  {
    EXPECT_EQ(image[3 * x], x < 50 ? 0.0F : 1.0F) << x;
  }
}

// Documentation/Formats/sensor.md
TEST(Sensor, TheDefaultsAreThoseOfTheDocumentation)
{
  const ColorSensorParameters color = defaultColorSensor();
  EXPECT_EQ(color.psf.gaussian, 0.6);
  EXPECT_EQ(color.vignetting.cos4, 1);
  EXPECT_EQ(color.fullWell, 10000);
  EXPECT_TRUE(color.shotNoise);
  EXPECT_EQ(color.prnu, 0.005);
  EXPECT_EQ(color.dsnu, 1);
  EXPECT_EQ(color.readNoise, 2.5);
  EXPECT_EQ(color.bits, 12);
  EXPECT_EQ(color.bayer, BayerPattern::RGGB);
  const DepthSensorParameters depth = defaultDepthSensor();
  EXPECT_EQ(depth.kinect.axial, 1);
  EXPECT_EQ(depth.kinect.lateral, 1);
  EXPECT_EQ(depth.least, 0.4);
  EXPECT_EQ(depth.most, 8);
  EXPECT_EQ(depth.dropout.edge, 0.5);
  EXPECT_EQ(depth.dropout.grazing, 0.5);
}

// 200 x 200 pixels: the standard error of a correlation is 0.005.
TEST(ImageSensor, TheFixedPatternsOfColoursAreIndependent)
{
  ImageSensorSetup setup = partsOf(idealLinear());
  setup.width = setup.height = 200;
  setup.parameters.prnu = 0.02;
  const std::vector<float> image = expose(setup, evenly(0.5));
  const Statistics all = statisticsOf(image);
  EXPECT_NEAR(std::sqrt(all.variance) / (0.5 * 0.02), 1, 0.02);
  double between[3] = {};
  for (std::size_t i = 0; i < image.size(); ++i)
  {
    const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
    between[i % 3] += (image[i] - all.mean) * (image[next] - all.mean) / (200 * 200);
  }
  for (const double covariance : between)
  {
    EXPECT_NEAR(covariance / all.variance, 0, 0.03);
  }
}

// Beyond the edge of an image its outermost row or column goes on.
TEST(ImageSensor, BlurRepeatsTheEdges)
{
  constexpr int size = 9;
  ImageSensorSetup setup = partsOf(idealLinear());
  setup.width = setup.height = size;
  setup.parameters.psf.gaussian = 0.6; // reaches three pixels
  const auto weight = [](int i) { return std::exp(-i * i / (2 * 0.6 * 0.6)); };
  double sum = 0;
  for (int i = -3; i <= 3; ++i)
  {
    sum += weight(i);
  }
  for (const bool across : { true, false })
  {
    for (const int lit : { 0, size - 1 })
    {
      const std::vector<float> image =
        expose(setup, [&](int x, int y, int) { return (across ? x : y) == lit ? 1.0 : 0.0; });
      for (int distance = 0; distance < size; ++distance)
      {
        double expected = 0;
        for (int i = distance; i <= 3; ++i)
        {
          expected += weight(i) / sum;
        }
        const int at = std::abs(lit - distance);
        const float found = image[std::size_t(across ? 4 * size + at : at * size + 4) * 3];
        EXPECT_NEAR(found, expected, 1e-6) << across << ' ' << lit << ' ' << distance;
      }
    }
  }
}

} // namespace dgtk::test
