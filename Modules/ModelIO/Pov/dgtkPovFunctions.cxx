// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovFunctions.h"

#include "dgtkPortableMath.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace dgtk
{

namespace
{
using Arguments = std::vector<PovNumber>;

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t any = 1000;

PovNumber number(double value)
{
  PovNumber of;
  of.v[0] = value;
  return of;
}

PovNumber number(const Eigen::Vector3d& value)
{
  PovNumber of;
  of.size = 3;
  std::copy(value.begin(), value.end(), of.v.begin());
  return of;
}

Eigen::Vector3d vector(const PovNumber& argument)
{
  const std::array<double, 5> v = promoted(argument, 3);
  return { v[0], v[1], v[2] };
}

template <double (*F)(double)>
PovNumber ofOne(const Arguments& a)
{
  return number(F(a[0].v[0]));
}

template <double (*F)(double, double)>
PovNumber ofTwo(const Arguments& a)
{
  return number(F(a[0].v[0], a[1].v[0]));
}

double cosine(double x) { return std::abs(x) <= 1 ? (x < 0 ? pi - portable::acos(-x) : portable::acos(x)) : none; }
double sine(double x) { return std::abs(x) <= 1 ? portable::asin(x) : none; }
double logarithm(double x) { return x > 0 ? portable::log(x) : none; }
double decimal(double x) { return logarithm(x) / portable::log(10); }
double degrees(double x) { return x * 180 / pi; }
double radians(double x) { return x * pi / 180; }
double absolute(double x) { return std::abs(x); }
double rounded(double x) { return std::floor(x); }
double raised(double x) { return std::ceil(x); }
double whole(double x) { return std::trunc(x); }
double root(double x) { return std::sqrt(x); }
double quotient(double x, double y) { return std::trunc(x / y); }
double rest(double x, double y) { return std::fmod(x, y); }

/// Whole powers are products, of any sign.
double power(double x, double y)
{
  if (y != std::trunc(y) || std::abs(y) > 1024)
  {
    return x < 0 || (x == 0 && y < 0) ? none : portable::pow(x, y);
  }
  double product = x == 0 && y == 0 ? none : 1;
  for (double i = 0; i < std::abs(y); ++i)
  {
    product *= x;
  }
  return y < 0 ? 1 / product : product;
}

template <bool IsMost>
PovNumber extreme(const Arguments& a)
{
  const auto less = [](const PovNumber& x, const PovNumber& y) { return x.v[0] < y.v[0]; };
  return number(
    (IsMost ? std::max_element(a.begin(), a.end(), less) : std::min_element(a.begin(), a.end(), less))->v[0]);
}

/// By the sign of the first: the second below 0, the third otherwise; of four the third at 0, the last above.
PovNumber select(const Arguments& a)
{
  const double sign = a[0].v[0];
  return sign < 0 ? a[1] : sign > 0 && a.size() == 4 ? a[3] : a[2];
}

PovNumber turned(const Arguments& a)
{
  const Eigen::Vector3d v = vector(a[0]);
  const Eigen::Vector3d axis = vector(a[1]).normalized();
  const double angle = radians(a[2].v[0]);
  const double c = portable::cos(angle);
  return number(Eigen::Vector3d(v * c + axis.cross(v) * portable::sin(angle) + axis * (axis.dot(v) * (1 - c))));
}

/// Rotation by degrees about an axis.
Eigen::Matrix3d rotation(double angle, int axis)
{
  const double turns = std::remainder(angle, 360.0) / 90;
  double c = portable::cos(turns * (pi / 2));
  double s = portable::sin(turns * (pi / 2));
  if (turns == std::nearbyint(turns))
  {
    c = std::nearbyint(c);
    s = std::nearbyint(s);
  }
  const int y = (axis + 1) % 3;
  const int z = (axis + 2) % 3;
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(y, y) = c;
  matrix(y, z) = -s;
  matrix(z, y) = s;
  matrix(z, z) = c;
  return matrix;
}
} // namespace

const PovFunction* povFunction(const std::string& name)
{
  static const std::map<std::string, PovFunction> functions = { { "abs", { 1, 1, ofOne<absolute> } },
    { "acos", { 1, 1, ofOne<cosine> } }, { "asin", { 1, 1, ofOne<sine> } },
    { "atan2", { 2, 2, ofTwo<portable::atan2> } }, { "ceil", { 1, 1, ofOne<raised> } },
    { "cos", { 1, 1, ofOne<portable::cos> } }, { "degrees", { 1, 1, ofOne<degrees> } },
    { "div", { 2, 2, ofTwo<quotient> } }, { "exp", { 1, 1, ofOne<portable::exp> } },
    { "floor", { 1, 1, ofOne<rounded> } }, { "int", { 1, 1, ofOne<whole> } }, { "ln", { 1, 1, ofOne<logarithm> } },
    { "log", { 1, 1, ofOne<decimal> } }, { "max", { 1, any, extreme<true> } }, { "min", { 1, any, extreme<false> } },
    { "mod", { 2, 2, ofTwo<rest> } }, { "pow", { 2, 2, ofTwo<power> } }, { "radians", { 1, 1, ofOne<radians> } },
    { "select", { 3, 4, select } }, { "sin", { 1, 1, ofOne<portable::sin> } }, { "sqrt", { 1, 1, ofOne<root> } },
    { "tan", { 1, 1, ofOne<portable::tan> } }, { "vaxis_rotate", { 3, 3, turned } },
    { "vcross", { 2, 2, [](const Arguments& a) { return number(vector(a[0]).cross(vector(a[1])).eval()); } } },
    { "vdot", { 2, 2, [](const Arguments& a) { return number(vector(a[0]).dot(vector(a[1]))); } } },
    { "vlength", { 1, 1, [](const Arguments& a) { return number(vector(a[0]).norm()); } } },
    { "vnormalize", { 1, 1, [](const Arguments& a) { return number(vector(a[0]).normalized().eval()); } } },
    { "vrotate",
      { 2, 2, [](const Arguments& a) { return number((povRotation(vector(a[1])) * vector(a[0])).eval()); } } } };
  const auto found = functions.find(name);
  return found == functions.end() ? nullptr : &found->second;
}

std::array<double, 5> promoted(const PovNumber& number, int to)
{
  std::array<double, 5> v = number.v;
  if (number.size == 1)
  {
    std::fill(v.begin() + 1, v.begin() + std::max(to, 1), v[0]);
  }
  return v;
}

Eigen::Matrix3d povRotation(const Eigen::Vector3d& degrees)
{
  return rotation(degrees[2], 2) * rotation(degrees[1], 1) * rotation(degrees[0], 0);
}

} // namespace dgtk
