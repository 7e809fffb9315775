// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTexturePyramid.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dgtk;

namespace
{
/// Largest difference relative to the exact value, over values of x from `first` to `last` by a constant factor.
template <typename Own, typename Exact>
double worstRelative(double first, double last, const Own& own, const Exact& exact)
{
  double worst = 0;
  constexpr int steps = 100000;
  for (int i = 0; i < steps; ++i)
  {
    const double x = first * std::pow(last / first, double(i) / steps);
    const double expected = exact(double(float(x)));
    worst = std::max(worst, std::abs(double(own(float(x))) - expected) / std::abs(expected));
  }
  return worst;
}

std::shared_ptr<Image> checked(int width, int height)
{
  auto image = std::make_shared<Image>();
  image->width = width;
  image->height = height;
  for (int i = 0; i < width * height; ++i)
  {
    const auto value = std::uint8_t((i % width + i / width) % 2 ? 255 : 0);
    image->rgba.insert(image->rgba.end(), { value, std::uint8_t(40 * (i % 5)), 90, 255 });
  }
  return image;
}
} // namespace

/// A number among others, of which none may touch it.
Float4 amongOthers(float x) { return float4(-1e30F, x, std::nanf(""), 300); }

TEST(ShadingMath, ElementaryFunctionsAreRightToSinglePrecision)
{
  EXPECT_LT(
    worstRelative(
      1e-30, 1e30, [](float x) { return portable::log2(x) + 200; }, [](double x) { return std::log2(x) + 200; }),
    2e-7);
  EXPECT_LT(
    worstRelative(
      1e-3, 100, [](float x) { return (portable::exp2(amongOthers(x)) * portable::exp2(-0.5F * amongOthers(x)))[1]; },
      [](double x) { return std::exp2(0.5 * x); }),
    2e-6);
  EXPECT_LT(worstRelative(
              1e-6, 50, [](float x) { return portable::exp(-x); }, [](double x) { return std::exp(-x); }),
    1e-5);
  EXPECT_LT(worstRelative(
              1e-4, 1, [](float x) { return portable::pow(amongOthers(x), float4(5.5F))[1]; },
              [](double x) { return std::pow(x, 5.5); }),
    2e-5);
  EXPECT_LT(worstRelative(
              1e-5, 1, [](float x) { return toLinear(toDisplay(amongOthers(x)))[1]; }, [](double x) { return x; }),
    3e-6);
  EXPECT_LT(worstRelative(
              0.0032, 4, [](float x) { return toDisplay(amongOthers(x))[1]; },
              [](double x) { return 1.055 * std::pow(x, 1 / 2.4) - 0.055; }),
    2e-6);
  const Float4 powers = portable::pow(float4(0, 0, 1, std::nanf("")), float4(0, 3, 1e9F, 2));
  const Float4 ends = portable::exp2(float4(-300, 300, 128, std::nanf("")));
  const float expectedPowers[4] = { 1, 0, 1, 0 };
  const float expectedEnds[4] = { 0, INFINITY, INFINITY, 0 };
  for (int i = 0; i < 4; ++i)
  {
    EXPECT_EQ(powers[i], expectedPowers[i]) << i;
    EXPECT_EQ(ends[i], expectedEnds[i]) << i;
  }
  for (int i = 0; i < 1000; ++i)
  {
    const double angle = (i - 499.5) / 500 * M_PI;
    const double radius = std::pow(10, i % 7 - 3);
    EXPECT_NEAR(double(portable::atan2(float(radius * std::sin(angle)), float(radius * std::cos(angle)))), angle, 1e-6);
  }
}

TEST(ShadingMath, PicturesRepeat)
{
  EXPECT_EQ(repeated(0, 0.25)[0], 0.0F);
  EXPECT_FLOAT_EQ(repeated(0, -0.25)[1], 0.75F);
  EXPECT_FLOAT_EQ(repeated(1e6 + 0.5, 0)[2], 0.5F);
  EXPECT_EQ(repeated(-1e-20, 0)[0], 0.0F); // not 1
  EXPECT_EQ(repeated(std::nan(""), 0.25)[0], 0.0F);
  EXPECT_EQ(repeated(0, 1e300)[3], 0.0F);
}

// Every level has the mean of the picture, whatever its size.
TEST(TexturePyramid, SmallerLevelsAreMeansByArea)
{
  for (const auto& [width, height] : { std::pair(8, 8), { 7, 5 }, { 1, 9 }, { 64, 3 }, { 13, 1 }, { 1, 1 } })
  {
    const auto image = checked(width, height);
    double mean[3] = {};
    for (std::size_t i = 0; i < image->rgba.size(); ++i)
    {
      mean[i % 4 % 3] += i % 4 < 3 ? image->rgba[i] / 255.0 / (width * height) : 0;
    }
    const TexturePyramid pyramid(*image, {});
    const Float4 whole = pyramid.at({ 0.3, 0.8, 4, 0, 0, 4 }); // four pictures wide
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(double(whole[c]), mean[c], 2.5 / 255) << width << 'x' << height << " channel " << c;
    }
  }
}

TEST(TexturePyramid, EnlargedTexelsAreInterpolatedAndWrapAround)
{
  const auto image = std::make_shared<Image>();
  image->width = 2;
  image->height = 2; // from the top: red, green / blue, white
  image->rgba = { 255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 255 };
  const TexturePyramid pyramid(*image, {});
  const auto expect = [&](double u, double v, Float4 color)
  {
    const Float4 found = pyramid.at({ u, v, 0.01F, 0, 0, 0.01F });
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_NEAR(double(found[c]), double(color[c]), 1e-6) << u << ' ' << v << " channel " << c;
    }
  };
  expect(0.25, 0.75, float4(1, 0, 0));
  expect(0.75, 0.75, float4(0, 1, 0));
  expect(0.25, 0.25, float4(0, 0, 1));
  expect(0.75, 0.25, float4(1, 1, 1));
  expect(0.5, 0.75, float4(0.5F, 0.5F, 0));
  expect(0, 0.75, float4(0.5F, 0.5F, 0)); // between the last column and the first
  expect(-3.75, 5.75, float4(1, 0, 0));
  expect(0.25, 0, float4(0.5F, 0, 0.5F));
}

TEST(TexturePyramid, OthersThanSmoothOnesAreWhatIsAtTheirPoint)
{
  const auto image = std::make_shared<Image>();
  image->width = 2;
  image->height = 1; // red, green
  image->rgba = { 255, 0, 0, 255, 0, 255, 0, 255 };
  const Footprint wide{ 0.4, 0.5, 8, 0, 0, 8 };
  const TexturePyramid nearest(*image, { false, TextureFilter::Nearest, {} });
  EXPECT_EQ(nearest.at(wide)[0], 1);
  EXPECT_EQ(nearest.at({ 0.6, 0.5, 0, 0, 0, 0 })[1], 1);
  EXPECT_EQ(nearest.at({ 1.1, 0.5, 0, 0, 0, 0 })[0], 1) << "it repeats";
  const TexturePyramid linear(*image, { false, TextureFilter::Linear, { TextureWrap::Clamp, TextureWrap::Clamp } });
  EXPECT_NEAR(double(linear.at(wide)[0]), 0.7, 1e-6);
  EXPECT_EQ(linear.at({ 1.4, 0.5, 0, 0, 0, 0 })[1], 1) << "its border goes on";
  EXPECT_EQ(linear.at({ -3, 0.5, 0, 0, 0, 0 })[0], 1);
  const TexturePyramid mirrored(*image, { false, TextureFilter::Linear, { TextureWrap::Mirror, TextureWrap::Repeat } });
  for (const double u : { 0.4, -0.4, 1.6, 2.4, -1.6, 100.4 })
  {
    EXPECT_NEAR(double(mirrored.at({ u, 0.5, 0, 0, 0, 0 })[0]), 0.7, 1e-5) << u;
  }
  EXPECT_EQ(mirrored.at({ 1, 0.5, 0, 0, 0, 0 })[1], 1) << "the last texel beside itself";
  EXPECT_EQ(mirrored.at({ -0.2, 0.5, 0, 0, 0, 0 })[0], 1);
}

// A grating that a pixel sees lengthwise stays sharp across while it is averaged along.
TEST(TexturePyramid, ProbesFollowTheLongerAxis)
{
  const auto image = std::make_shared<Image>();
  image->width = image->height = 64;
  for (int i = 0; i < 64 * 64; ++i)
  {
    const auto value = std::uint8_t(i % 64 / 8 % 2 ? 255 : 0); // stripes along v, 8 texels wide
    image->rgba.insert(image->rgba.end(), { value, value, value, 255 });
  }
  const TexturePyramid pyramid(*image, {});
  const double inStripe = 9.0 / 64; // white; a texel beside black
  EXPECT_NEAR(double(pyramid.at({ inStripe, 0.5, 1.0F / 64, 0, 0, 4.0F / 64 })[0]), 1, 1e-6);   // four texels along
  EXPECT_LT(double(pyramid.at({ inStripe, 0.5, 16.0F / 64, 0, 0, 16.0F / 64 })[0]), 0.9);       // as wide: blurred
  EXPECT_NEAR(double(pyramid.at({ inStripe, 0.5, 16.0F / 64, 0, 0, 4.0F / 64 })[0]), 0.5, 0.2); // along u: averaged
}
