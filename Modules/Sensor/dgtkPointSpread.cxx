// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPointSpread.h"

#include "dgtkPortableMath.h"

#include <cmath>

namespace dgtk::sensor
{

namespace
{
std::vector<double> gaussianWeights(double sigma, int radius)
{
  std::vector<double> weights;
  for (int i = -radius; i <= radius; ++i)
  {
    weights.push_back(i == 0 ? 1 : portable::exp(-0.5 * i * i / (sigma * sigma)));
  }
  return weights;
}

// Part of each pixel that the disc covers, of 32 x 32 points in it.
std::vector<double> discWeights(double disc, int radius)
{
  constexpr int points = 32;
  std::vector<double> weights;
  for (int y = -radius; y <= radius; ++y)
  {
    for (int x = -radius; x <= radius; ++x)
    {
      int covered = 0;
      for (int i = 0; i < points * points; ++i)
      {
        const double px = x - 0.5 + (i % points + 0.5) / points;
        const double py = y - 0.5 + (i / points + 0.5) / points;
        covered += px * px + py * py <= disc * disc ? 1 : 0;
      }
      weights.push_back(covered);
    }
  }
  return weights;
}

void normalise(std::vector<double>& weights)
{
  double sum = 0;
  for (const double w : weights)
  {
    sum += w;
  }
  for (double& w : weights)
  {
    w /= sum;
  }
}
} // namespace

PointSpread::PointSpread(const PointSpreadParameters& parameters)
{
  if (parameters.gaussian > 0)
  {
    this->Radius = static_cast<int>(std::ceil(4 * parameters.gaussian));
    this->Weights = gaussianWeights(parameters.gaussian, this->Radius);
  }
  else if (parameters.disc > 0)
  {
    this->Separable = false;
    this->Radius = static_cast<int>(std::ceil(parameters.disc - 0.5));
    this->Weights = discWeights(parameters.disc, this->Radius);
  }
  else if (!parameters.kernel.empty())
  {
    this->Separable = false;
    this->Radius = (static_cast<int>(std::sqrt(double(parameters.kernel.size()))) - 1) / 2;
    // A convolution turns the kernel over.
    this->Weights.assign(parameters.kernel.rbegin(), parameters.kernel.rend());
  }
  normalise(this->Weights);
}

void PointSpread::addRow(const std::vector<float>& row, const double* weights, std::vector<double>& sum) const
{
  const int width = static_cast<int>(row.size() / 3);
  for (int x = 0; x < width; ++x)
  {
    for (int i = -this->Radius; i <= this->Radius; ++i)
    {
      const double weight = weights[i + this->Radius];
      const float* from = row.data() + std::size_t(std::min(std::max(x + i, 0), width - 1)) * 3;
      double* to = sum.data() + std::size_t(x) * 3;
      to[0] += weight * from[0];
      to[1] += weight * from[1];
      to[2] += weight * from[2];
    }
  }
}

std::vector<float> PointSpread::prepare(std::vector<float> row) const
{
  if (this->Radius == 0 || !this->Separable)
  {
    return row;
  }
  std::vector<double> sum(row.size(), 0.0);
  this->addRow(row, this->Weights.data(), sum);
  return { sum.begin(), sum.end() };
}

std::vector<float> PointSpread::blur(const RowWindow<float>& rows, int y) const
{
  if (this->Radius == 0)
  {
    return rows.at(y);
  }
  const int side = 2 * this->Radius + 1;
  std::vector<double> sum(rows.at(y).size(), 0.0);
  for (int j = 0; j < side; ++j)
  {
    const std::vector<float>& row = rows.clamped(y + j - this->Radius);
    if (!this->Separable)
    {
      this->addRow(row, this->Weights.data() + std::size_t(j) * side, sum);
      continue;
    }
    const double weight = this->Weights[static_cast<std::size_t>(j)];
    for (std::size_t i = 0; i < sum.size(); ++i)
    {
      sum[i] += weight * row[i];
    }
  }
  return { sum.begin(), sum.end() };
}

} // namespace dgtk::sensor
