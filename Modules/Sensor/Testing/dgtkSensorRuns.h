// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSensorRuns_h
#define dgtkSensorRuns_h

#include "dgtkDepthSensor.h"
#include "dgtkImageSensor.h"
#include "dgtkPortableMath.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

namespace dgtk::test
{

/// A colour sensor that answers linearly and leaves everything out.
inline ColorSensorParameters idealLinear()
{
  ColorSensorParameters p;
  p.response = ResponseCurve::Linear;
  return p;
}

/// What a sensor makes of light(x, y, channel), linear in [0, 1].
template <typename Light>
std::vector<float> expose(
  const ImageSensorSetup& setup, const Light& light, int rowsAtOnce = 64, ThreadPool* pool = nullptr)
{
  std::vector<float> out;
  ImageSensor sensor(
    setup,
    [&](int y, int height, const float* rgb)
    {
      if (std::size_t(y) * setup.width * 3 == out.size())
      {
        out.insert(out.end(), rgb, rgb + std::size_t(setup.width) * height * 3);
      }
    },
    pool);
  double last = 0; // the same again costs nothing
  float lastEncoded = static_cast<float>(portable::srgbFromLinear(last));
  for (int y = 0; y < setup.height; y += rowsAtOnce)
  {
    const int rows = std::min(rowsAtOnce, setup.height - y);
    std::vector<float> encoded;
    for (int r = y; r < y + rows; ++r)
    {
      for (int x = 0; x < setup.width; ++x)
      {
        for (int c = 0; c < 3; ++c)
        {
          const double value = light(x, r, c);
          lastEncoded = value == last ? lastEncoded : static_cast<float>(portable::srgbFromLinear(value));
          last = value;
          encoded.push_back(lastEncoded);
        }
      }
    }
    sensor.write(rows, encoded.data());
  }
  return out;
}

/// What a depth sensor makes of depth(x, y), with one angle (radians) between normal and ray.
template <typename Depth>
std::vector<double> measure(
  const DepthSensorSetup& setup, const Depth& depth, double angle = 0, int rowsAtOnce = 64, ThreadPool* pool = nullptr)
{
  std::vector<double> out;
  DepthSensor sensor(
    setup,
    [&](int y, const double* row)
    {
      if (std::size_t(y) * setup.width == out.size())
      {
        out.insert(out.end(), row, row + setup.width);
      }
    },
    pool);
  for (int y = 0; y < setup.height; y += rowsAtOnce)
  {
    const int rows = std::min(rowsAtOnce, setup.height - y);
    std::vector<double> exact;
    exact.reserve(std::size_t(rows) * std::size_t(setup.width));
    for (int i = 0; i < rows * setup.width; ++i)
    {
      exact.push_back(depth(i % setup.width, y + i / setup.width));
    }
    const std::vector<float> cosine(exact.size(), static_cast<float>(std::cos(angle)));
    sensor.write(rows, exact.data(), cosine.data());
  }
  return out;
}

/// Mean and variance of numbers, those that are not finite left out.
struct Statistics
{
  double count = 0;
  double mean = 0;
  double variance = 0;
};
template <typename Values>
Statistics statisticsOf(const Values& values)
{
  Statistics s;
  for (const auto v : values)
  {
    if (std::isfinite(v))
    {
      s.count += 1;
      s.mean += (double(v) - s.mean) / s.count;
    }
  }
  for (const auto v : values)
  {
    if (std::isfinite(v))
    {
      s.variance += (double(v) - s.mean) * (double(v) - s.mean) / s.count;
    }
  }
  return s;
}

/// Standard normal distribution function.
inline double normalBelow(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

} // namespace dgtk::test

#endif
