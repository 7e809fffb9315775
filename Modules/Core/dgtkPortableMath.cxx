// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPortableMath.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dgtk::portable
{

namespace
{
constexpr double ln2 = 0.693147180559945309417;
constexpr double halfPi = 1.57079632679489661923;
constexpr double halfLogTwoPi = 0.918938533204672741780;

// Series of the inverse sine; |x| <= 1/2.
double asinSmall(double x)
{
  const double xx = x * x;
  double power = x;
  double sum = x;
  for (int k = 1; k < 28; ++k)
  {
    power *= xx * (2 * k - 1) / (2 * k);
    sum += power / (2 * k + 1);
  }
  return sum;
}
} // namespace

double log(double x)
{
  int exponent = 0;
  double m = std::frexp(x, &exponent); // [1/2, 1)
  if (m < 0.70710678118654752)
  {
    m *= 2;
    --exponent;
  }
  const double s = (m - 1) / (m + 1);
  const double ss = s * s;
  double sum = 0;
  for (int n = 25; n >= 1; n -= 2) // 2 artanh(s), from the smallest term
  {
    sum = sum * ss + 1.0 / n;
  }
  return exponent * ln2 + 2 * s * sum;
}

double exp(double x)
{
  if (x < -700)
  {
    return 0;
  }
  x = std::min(x, 700.0);
  constexpr double ln2High = 0.693147180369123816490; // 33 bits: times a small integer it is exact
  constexpr double ln2Low = 1.90821492927058770002e-10;
  const double k = std::floor(x / ln2 + 0.5);
  const double r = (x - k * ln2High) - k * ln2Low;
  double sum = 1;
  for (int n = 15; n >= 1; --n)
  {
    sum = 1 + sum * r / n;
  }
  return std::ldexp(sum, static_cast<int>(k));
}

double pow(double x, double y) { return x > 0 ? exp(y * log(x)) : 0; }

double acos(double c)
{
  return c <= 0.5 ? halfPi - asinSmall(c) : 2 * asinSmall(std::sqrt((1 - std::min(c, 1.0)) / 2));
}

double logFactorial(double n)
{
  if (n < 10)
  {
    static constexpr std::array<double, 10> factorial{ 1, 1, 2, 6, 24, 120, 720, 5040, 40320, 362880 };
    return log(factorial[static_cast<std::size_t>(n)]);
  }
  const double r = 1 / n; // Stirling's series
  return (n + 0.5) * log(n) - n + halfLogTwoPi +
         r * (1.0 / 12 - r * r * (1.0 / 360 - r * r * (1.0 / 1260 - r * r / 1680)));
}

double linearFromSrgb(double v)
{
  v = std::min(std::max(v, 0.0), 1.0);
  return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4);
}

double srgbFromLinear(double v)
{
  v = std::min(std::max(v, 0.0), 1.0);
  return v <= 0.0031308 ? v * 12.92 : 1.055 * pow(v, 1 / 2.4) - 0.055;
}

} // namespace dgtk::portable
