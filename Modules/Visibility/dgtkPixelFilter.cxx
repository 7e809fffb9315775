// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPixelFilter.h"

#include "dgtkError.h"
#include "dgtkPortableMath.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dgtk
{
namespace
{

struct FilterShape
{
  const char* name;
  double radius; ///< pixels
  double (*at)(double x);
};

double gaussian(double x)
{
  constexpr double variance = 0.25;
  constexpr double radius = 1.5;
  return portable::exp(-x * x / (2 * variance)) - portable::exp(-radius * radius / (2 * variance));
}

double mitchell(double x)
{
  constexpr double b = 1.0 / 3;
  constexpr double c = 1.0 / 3;
  x = std::abs(x);
  return x < 1 ? ((12 - 9 * b - 6 * c) * x * x * x + (-18 + 12 * b + 6 * c) * x * x + 6 - 2 * b) / 6
               : ((-b - 6 * c) * x * x * x + (6 * b + 30 * c) * x * x + (-12 * b - 48 * c) * x + 8 * b + 24 * c) / 6;
}

double sinc(double x) { return x == 0 ? 1 : portable::sin(pi * x) / (pi * x); }

/// In the order of PixelFilter.
constexpr FilterShape shapes[] = {
  { "box", 0.5, [](double) { return 1.0; } },
  { "triangle", 1, [](double x) { return 1 - std::abs(x); } },
  { "gaussian", 1.5, gaussian },
  { "mitchell", 2, mitchell },
  { "lanczos", 3, [](double x) { return sinc(x) * sinc(x / 3); } },
};

} // namespace

PixelFilter pixelFilterFromName(const std::string& name)
{
  for (int i = 0; i < int(std::size(shapes)); ++i)
  {
    if (name == shapes[i].name)
    {
      return PixelFilter(i);
    }
  }
  throw UsageError("unknown filter " + quoted(name) + " (expected box, triangle, gaussian, mitchell or lanczos)");
}

std::vector<double> pixelFilterWeights(PixelFilter filter, int samples, int& margin)
{
  const FilterShape& shape = shapes[int(filter)];
  margin = int(std::ceil(shape.radius - 0.5));
  std::vector<double> weights;
  for (int i = 0; i < (2 * margin + 1) * samples; ++i)
  {
    const double x = (i + 0.5) / samples - margin - 0.5; // from the pixel's centre
    weights.push_back(std::abs(x) < shape.radius ? shape.at(x) : 0.0);
  }
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  std::transform(weights.begin(), weights.end(), weights.begin(), [sum](double w) { return w / sum; });
  return weights;
}

SampleFilter::SampleFilter(PixelFilter filter, int samples, float most)
  : Filter(filter)
  , Samples(samples)
  , Most(most)
{
  this->Weights = pixelFilterWeights(filter, samples, this->Margin);
}

void SampleFilter::apply(const SampleImage& samples, const PixelRect& piece, ColorBuffer& colors) const
{
  if (this->Filter == PixelFilter::Box)
  {
    this->applyBox(samples, piece, colors);
    return;
  }
  const int width = (piece.width + 2 * this->Margin) * this->Samples;
  const int count = int(this->Weights.size());
  std::vector<double> row(std::size_t(width) * 3);
  for (int y = 0; y < piece.height; ++y)
  {
    std::fill(row.begin(), row.end(), 0.0);
    for (int k = 0; k < count; ++k)
    {
      const float* source = samples.top + samples.toNextRow * (y * this->Samples + k);
      for (int x = 0; x < width; ++x, source += samples.channels)
      {
        for (int c = 0; c < 3; ++c)
        {
          row[std::size_t(x) * 3 + c] += this->Weights[k] * this->clamped(source[c]);
        }
      }
    }
    float* target =
      colors.rgb.data() +
      (std::size_t(piece.y - colors.rect.y + y) * colors.rect.width + std::size_t(piece.x - colors.rect.x)) * 3;
    for (int x = 0; x < piece.width; ++x)
    {
      double sum[3] = { 0, 0, 0 };
      const double* source = row.data() + std::size_t(x) * this->Samples * 3;
      for (int k = 0; k < count; ++k, source += 3)
      {
        for (int c = 0; c < 3; ++c)
        {
          sum[c] += this->Weights[k] * source[c];
        }
      }
      std::transform(sum, sum + 3, target + std::size_t(x) * 3, [this](double v) { return this->clamped(v); });
    }
  }
}

void SampleFilter::applyBox(const SampleImage& samples, const PixelRect& piece, ColorBuffer& colors) const
{
  const int width = piece.width * this->Samples;
  const float weight = 1.0f / float(this->Samples * this->Samples);
  for (int y = 0; y < piece.height; ++y)
  {
    float* target =
      colors.rgb.data() +
      (std::size_t(piece.y - colors.rect.y + y) * colors.rect.width + std::size_t(piece.x - colors.rect.x)) * 3;
    std::fill_n(target, std::size_t(piece.width) * 3, 0.0f);
    for (int k = 0; k < this->Samples; ++k)
    {
      const float* source = samples.top + samples.toNextRow * (y * this->Samples + k);
      for (int x = 0; x < width; ++x, source += samples.channels)
      {
        float* pixel = target + x / this->Samples * 3;
        pixel[0] += this->clamped(source[0]);
        pixel[1] += this->clamped(source[1]);
        pixel[2] += this->clamped(source[2]);
      }
    }
    for (int i = 0; i < piece.width * 3; ++i)
    {
      target[i] *= weight;
    }
  }
}

} // namespace dgtk
