// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkNormal.h"

#include "dgtkPortableMath.h"
#include "dgtkRandom.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
double density(double x) { return portable::exp(-x * x / 2) / std::sqrt(2 * pi); }

/// Of a uniform between the tails of two numbers; the smaller tail keeps its digits.
double inverse(double uniform, double upperOfLeast, double upperOfMost)
{
  const double p = upperOfLeast - uniform * (upperOfLeast - upperOfMost);
  return -normalQuantile(std::clamp(p, 0x1p-1000, 1 - 0x1p-53));
}
} // namespace

double normalTail(double x)
{
  if (x < 0)
  {
    return 1 - normalTail(-x);
  }
  if (x < 3)
  {
    // Marsaglia, "Evaluating the normal distribution", J. Stat. Softw. 11(4), 2004: x + x^3/3 + x^5/15 + ...
    double term = x;
    double sum = x;
    for (int i = 3; i < 120; i += 2)
    {
      term *= x * x / i;
      sum += term;
    }
    return 0.5 - sum * density(x);
  }
  // Laplace's continued fraction of Mills's ratio.
  double fraction = x;
  for (int i = 200; i > 0; --i)
  {
    fraction = x + i / fraction;
  }
  return density(x) / fraction;
}

double truncatedNormal(double uniform, double least, double most)
{
  // On the side where the tails are small.
  const bool mirrored = least + most < 0;
  const double value = mirrored ? -inverse(1 - uniform, normalTail(-most), normalTail(-least))
                                : inverse(uniform, normalTail(least), normalTail(most));
  return std::clamp(value, least, most);
}

} // namespace dgtk
