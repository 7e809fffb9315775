// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDoubleDouble_h
#define dgtkDoubleDouble_h

#include <cmath>

namespace dgtk
{

/// An unevaluated sum of two doubles, about 106 significant bits. Algorithms of Dekker (1971) and Hida, Li and Bailey
/// (2001); differences are antisymmetric to the last bit, which keeps edges shared by two triangles consistent.
struct DoubleDouble
{
  double hi;
  double lo;

  DoubleDouble() = default; // left uninitialised
  DoubleDouble(double value)
    : hi(value)
    , lo(0)
  {
  }
  DoubleDouble(double high, double low)
    : hi(high)
    , lo(low)
  {
  }
  DoubleDouble operator-() const { return { -this->hi, -this->lo }; }
};

inline DoubleDouble quickTwoSum(double a, double b)
{
  const double sum = a + b;
  return { sum, b - (sum - a) };
}

inline DoubleDouble twoSum(double a, double b)
{
  const double sum = a + b;
  const double part = sum - a;
  return { sum, (a - (sum - part)) + (b - part) };
}

inline DoubleDouble twoProduct(double a, double b)
{
  const double product = a * b;
  return { product, std::fma(a, b, -product) };
}

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b)
{
  const DoubleDouble high = twoSum(a.hi, b.hi);
  const DoubleDouble low = twoSum(a.lo, b.lo);
  const DoubleDouble sum = quickTwoSum(high.hi, high.lo + low.hi);
  return quickTwoSum(sum.hi, sum.lo + low.lo);
}

inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) { return a + (-b); }

inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b)
{
  const DoubleDouble product = twoProduct(a.hi, b.hi);
  return quickTwoSum(product.hi, product.lo + (a.hi * b.lo + a.lo * b.hi));
}

inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b)
{
  const double first = a.hi / b.hi;
  DoubleDouble rest = a - b * DoubleDouble(first);
  const double second = rest.hi / b.hi;
  rest = rest - b * DoubleDouble(second);
  return quickTwoSum(first, second) + DoubleDouble(rest.hi / b.hi);
}

struct Vector3dd
{
  DoubleDouble x, y, z;
};

inline Vector3dd operator-(const Vector3dd& a, const Vector3dd& b) { return { a.x - b.x, a.y - b.y, a.z - b.z }; }

inline DoubleDouble dot(const Vector3dd& a, const Vector3dd& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

inline Vector3dd cross(const Vector3dd& a, const Vector3dd& b)
{
  return { a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x };
}

} // namespace dgtk

#endif
