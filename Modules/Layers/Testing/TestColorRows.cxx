// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkColorRows.h"

#include "dgtkError.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

using namespace dgtk;

namespace
{
Band bandOf(const std::vector<float>& values)
{
  Band band;
  band.rect = { 0, 5, static_cast<int>(values.size() / 3), 1 };
  band.rgb = values;
  return band;
}

LayerSpec colorOf(PixelType type)
{
  LayerSpec spec;
  spec.type = type;
  spec.channels = 3;
  return spec;
}
} // namespace

TEST(Quantise, RoundsToTheNearestStepAndClamps)
{
  const Band band = bandOf({ 0.0f, 1.0f, 0.5f, -0.25f, 1.5f, 127.49f / 255 });
  const Rows bytes = quantise(band, colorOf(PixelType::UInt8), 5, 1);
  const std::uint8_t* b = bytes.row<std::uint8_t>(5);
  EXPECT_EQ(std::vector<int>(b, b + 6), (std::vector<int>{ 0, 255, 128, 0, 255, 127 }));
  const Rows words = quantise(band, colorOf(PixelType::UInt16), 5, 1);
  const std::uint16_t* w = words.row<std::uint16_t>(5);
  EXPECT_EQ(std::vector<int>(w, w + 5), (std::vector<int>{ 0, 65535, 32768, 0, 65535 }));
}

TEST(Quantise, FloatIsLinearLight)
{
  // IEC 61966-2-1: encoded 0.5 is 0.21404, encoded 0.04 is 0.04 / 12.92
  const Rows rows = quantise(bandOf({ 0.0f, 1.0f, 0.5f, 0.04f, 1.0f, 0.0f }), colorOf(PixelType::Float32), 5, 1);
  const float* v = rows.row<float>(5);
  EXPECT_EQ(v[0], 0.0f);
  EXPECT_FLOAT_EQ(v[1], 1.0f);
  EXPECT_NEAR(v[2], 0.2140411, 1e-6);
  EXPECT_NEAR(v[3], 0.04 / 12.92, 1e-8);
}

TEST(Quantise, LightAboveWhiteIsKeptForTheCurve)
{
  const auto curveOf = [](const std::string& name, const std::string& value)
  {
    LayerRequest request;
    request.options[name] = value;
    return PictureCurve(request);
  };
  const Band band = bandOf({ 0.0f, 1.0f, 0.5f, 1.5f, 3.0f, 0.04f }); // encoded 1.5 is 2.5371 of light
  const auto light = [&](const PictureCurve& curve)
  {
    const Rows rows = quantise(band, colorOf(PixelType::Float32), 5, 1, &Band::rgb, curve);
    return std::vector<float>(rows.row<float>(5), rows.row<float>(5) + 6);
  };
  const std::vector<float> plain = light({});
  const std::vector<float> darker = light(curveOf("exposure", "-1.5"));
  const std::vector<float> filmic = light(curveOf("tone", "filmic"));
  for (std::size_t i = 0; i < plain.size(); ++i)
  {
    const double x = double(plain[i]);
    EXPECT_NEAR(double(darker[i]), x * std::pow(2, -1.5), 1e-5 * x) << i;
    EXPECT_NEAR(double(filmic[i]), std::min(1.0, x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14)), 1e-5) << i;
  }
  EXPECT_NEAR(double(plain[3]), 2.5371, 1e-3);
  EXPECT_TRUE(curveOf("exposure", "32").changes());
  EXPECT_TRUE(curveOf("exposure", "-32").changes());
  for (const std::string wrong : { "33", "-33", "-32.5" })
  {
    try
    {
      curveOf("exposure", wrong);
      ADD_FAILURE() << wrong;
    }
    catch (const UsageError& error)
    {
      EXPECT_EQ(error.what(), "exposure: expected -32 to 32 stops, found " + wrong);
    }
  }
}

TEST(Quantise, EightBitsAreTheRoundingOfSixteen)
{
  std::vector<float> ramp(3000);
  for (int i = 0; i < 3000; ++i)
  {
    ramp[std::size_t(i)] = static_cast<float>(i) / 2999.0f;
  }
  const Rows bytes = quantise(bandOf(ramp), colorOf(PixelType::UInt8), 5, 1);
  const Rows words = quantise(bandOf(ramp), colorOf(PixelType::UInt16), 5, 1);
  for (int i = 0; i < 3000; ++i)
  {
    EXPECT_LE(std::abs(bytes.row<std::uint8_t>(5)[i] * 257 - words.row<std::uint16_t>(5)[i]), 129) << i;
  }
}
