// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPortableMath.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace dgtk::portable
{

namespace
{
constexpr double ln2 = 0.693147180559945309417;
constexpr double halfPi = 1.57079632679489661923;
constexpr double halfLogTwoPi = 0.918938533204672741780;

struct OddReciprocals // 1, 1/3, 1/5, ...
{
  double reciprocal[13]{};
  constexpr OddReciprocals()
  {
    for (int i = 0; i < 13; ++i)
    {
      this->reciprocal[i] = 1.0 / (2 * i + 1);
    }
  }
};
constexpr OddReciprocals odd;

struct FactorialReciprocals // 1 / n!
{
  double reciprocal[18]{};
  constexpr FactorialReciprocals()
  {
    double factorial = 1;
    for (int n = 0; n < 18; ++n)
    {
      factorial *= n > 0 ? n : 1;
      this->reciprocal[n] = 1 / factorial;
    }
  }
};
constexpr FactorialReciprocals factorials;

double powerOfTwo(int exponent) // of a normal number
{
  const std::uint64_t bits = static_cast<std::uint64_t>(exponent + 1023) << 52;
  double value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

/// A smooth function by Hermite's cubics between equal steps.
class CubicTable
{
public:
  template <typename Value, typename Slope>
  CubicTable(double first, double last, const Value& value, const Slope& slope)
    : First(first)
    , PerUnit(steps / (last - first))
  {
    for (int i = 0; i <= steps; ++i)
    {
      const double x = first + i / this->PerUnit;
      this->Nodes[static_cast<std::size_t>(i)] = { value(x), slope(x) / this->PerUnit };
    }
  }
  double operator()(double x) const
  {
    const double at = (x - this->First) * this->PerUnit;
    const int i = std::min(std::max(static_cast<int>(at), 0), steps - 1);
    const Node& a = this->Nodes[static_cast<std::size_t>(i)];
    const Node& b = this->Nodes[static_cast<std::size_t>(i) + 1];
    const double t = at - i;
    const double rise = b.value - a.value;
    return a.value + t * (a.slope + t * ((3 * rise - 2 * a.slope - b.slope) + t * (a.slope + b.slope - 2 * rise)));
  }

private:
  static constexpr int steps = 1024;
  struct Node
  {
    double value = 0;
    double slope = 0; ///< a step
  };
  double First;
  double PerUnit;
  std::array<Node, steps + 1> Nodes;
};

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
  for (int i = 12; i >= 0; --i) // 2 artanh(s), from the smallest term
  {
    sum = sum * ss + odd.reciprocal[i];
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
  const double rr = r * r; // two sums at a time
  double even = factorials.reciprocal[14];
  double odds = factorials.reciprocal[13];
  for (int n = 12; n > 0; n -= 2)
  {
    even = even * rr + factorials.reciprocal[n];
    odds = odds * rr + factorials.reciprocal[n - 1];
  }
  return (1 + (even * rr + r * odds)) * powerOfTwo(static_cast<int>(k));
}

double pow(double x, double y) { return x > 0 ? exp(y * log(x)) : 0; }

double acos(double c)
{
  return c <= 0.5 ? halfPi - asinSmall(c) : 2 * asinSmall(std::sqrt((1 - std::min(c, 1.0)) / 2));
}

// The C library has these in one variant for all processors of a kind, by + - * / and square roots.
double sin(double x) { return static_cast<double>(std::sin(static_cast<long double>(x))); }
double cos(double x) { return static_cast<double>(std::cos(static_cast<long double>(x))); }
double tan(double x) { return static_cast<double>(std::tan(static_cast<long double>(x))); }
double asin(double x) { return static_cast<double>(std::asin(static_cast<long double>(x))); }

double atan(double x)
{
  constexpr long double quarter = 1.57079632679489661923132169163975144L;
  const auto slope = static_cast<long double>(std::abs(x));
  const long double angle = slope <= 1 ? std::asin(slope / std::sqrt(1 + slope * slope))
                                       : quarter - std::asin(1 / std::sqrt(1 + slope * slope));
  return std::copysign(static_cast<double>(angle), x);
}

SineCosine sinCos(double x)
{
  constexpr double halfPiHigh = 1.5707963267341256; // 33 bits: times a small integer it is exact
  constexpr double halfPiLow = 6.077100506506192e-11;
  const double k = std::floor(x / halfPi + 0.5);
  const double r = (x - k * halfPiHigh) - k * halfPiLow;
  const double rr = r * r;
  double sine = factorials.reciprocal[17];
  double cosine = factorials.reciprocal[16];
  for (int n = 14; n > 0; n -= 2)
  {
    sine = factorials.reciprocal[n + 1] - rr * sine;
    cosine = factorials.reciprocal[n] - rr * cosine;
  }
  sine = r - r * rr * sine;
  cosine = 1 - rr * cosine;
  switch (static_cast<int>(k) & 3)
  {
    case 0:
      return { sine, cosine };
    case 1:
      return { cosine, -sine };
    case 2:
      return { -sine, -cosine };
    default:
      return { -cosine, sine };
  }
}

double atan2(double y, double x)
{
  const double ax = std::abs(x);
  const double ay = std::abs(y);
  const bool steep = ay > ax;
  const double near = steep ? ay : ax; // the angle to its axis is at most pi / 4
  const double off = steep ? ax : ay;
  if (near == 0)
  {
    return 0;
  }
  constexpr double tangents[] = { 0, 0.19891236737965800, 0.41421356237309505, 0.66817863791929892, 1 }; // of pi / 16
  const double slope = off / near;
  int node = 0;
  while (node < 4 && slope > 0.5 * (tangents[node] + tangents[node + 1]))
  {
    ++node;
  }
  const double t = (slope - tangents[node]) / (1 + tangents[node] * slope); // of the angle from there
  const double tt = t * t;
  double sum = 0;
  for (int i = 9; i > 0; --i)
  {
    sum = odd.reciprocal[i] - tt * sum;
  }
  double angle = node * (pi / 16) + (t - t * tt * sum);
  angle = steep ? halfPi - angle : angle;
  angle = x < 0 ? pi - angle : angle;
  return y < 0 ? -angle : angle;
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
  static const CubicTable table(
    0.04045, 1.0, // the curve and its slope
    [](double e) { return pow((e + 0.055) / 1.055, 2.4); },
    [](double e) { return 2.4 / 1.055 * pow((e + 0.055) / 1.055, 1.4); });
  v = std::min(std::max(v, 0.0), 1.0);
  return v >= 1 ? 1 : v <= 0.04045 ? v / 12.92 : table(v);
}

double srgbFromLinear(double v)
{
  // in the root of the light, of which the curve is nearly straight
  static const CubicTable table(
    std::sqrt(0.0031308), 1.0, [](double root) { return 1.055 * pow(root, 2 / 2.4) - 0.055; },
    [](double root) { return 1.055 * (2 / 2.4) * pow(root, 2 / 2.4 - 1); });
  v = std::min(std::max(v, 0.0), 1.0);
  return v >= 1 ? 1 : v <= 0.0031308 ? v * 12.92 : table(std::sqrt(v));
}

float linearFromEncoded(float v)
{
  return static_cast<float>(v <= 1 ? linearFromSrgb(double(v)) : pow((double(v) + 0.055) / 1.055, 2.4));
}

float encodedFromLinear(float v)
{
  return static_cast<float>(v <= 1 ? srgbFromLinear(double(v)) : 1.055 * pow(double(v), 1 / 2.4) - 0.055);
}

} // namespace dgtk::portable
