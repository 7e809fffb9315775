// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkGradientNoise.h"

#include <cmath>

namespace dgtk::sensor
{

namespace
{
double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

double slope(std::uint32_t bits, double dx, double dy)
{
  constexpr double root2 = 1.41421356237309504880;
  switch (bits & 7u)
  {
    case 0:
      return dx + dy;
    case 1:
      return dx - dy;
    case 2:
      return dy - dx;
    case 3:
      return -dx - dy;
    case 4:
      return root2 * dx;
    case 5:
      return -root2 * dx;
    case 6:
      return root2 * dy;
    default:
      return -root2 * dy;
  }
}
} // namespace

double GradientNoise::octave(double u, double v, std::uint32_t draw) const
{
  const double column = std::floor(u);
  const double row = std::floor(v);
  const double dx = u - column;
  const double dy = v - row;
  const auto corner = [&](std::uint32_t i, std::uint32_t j)
  {
    const PhiloxCounter bits = this->Random.block(std::uint32_t(column) + i, std::uint32_t(row) + j, draw);
    return slope(bits[0], dx - i, dy - j);
  };
  const double s = fade(dx);
  const double t = fade(dy);
  const double top = corner(0, 0) * (1 - s) + corner(1, 0) * s;
  const double bottom = corner(0, 1) * (1 - s) + corner(1, 1) * s;
  return top * (1 - t) + bottom * t;
}

double GradientNoise::at(int x, int y) const
{
  double amplitude = this->Parameters.amplitude;
  double frequency = 1 / this->Parameters.period;
  double sum = 0;
  for (int i = 0; i < this->Parameters.octaves; ++i)
  {
    sum += amplitude * this->octave((x + 0.5) * frequency, (y + 0.5) * frequency, static_cast<std::uint32_t>(i));
    amplitude *= this->Parameters.persistence;
    frequency *= 2;
  }
  return sum;
}

} // namespace dgtk::sensor
