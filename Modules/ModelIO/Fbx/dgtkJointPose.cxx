// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkJointPose.h"

#include "dgtkPortableMath.h"

#include <cmath>

namespace dgtk::import
{

Transform Transform::shift(const std::array<double, 3>& by)
{
  return Transform({ 1, 0, 0, by[0], 0, 1, 0, by[1], 0, 0, 1, by[2], 0, 0, 0, 1 });
}

Transform Transform::scale(const std::array<double, 3>& by)
{
  return Transform({ by[0], 0, 0, 0, 0, by[1], 0, 0, 0, 0, by[2], 0, 0, 0, 0, 1 });
}

Transform Transform::turn(const std::array<double, 3>& degrees, const std::array<std::int32_t, 3>& order)
{
  Transform all;
  for (const std::int32_t axis : order)
  {
    const double turns = degrees[std::size_t(axis)] / 360;
    const double angle = 2 * pi * (turns - std::round(turns));
    const double c = portable::cos(angle);
    const double s = portable::sin(angle);
    const std::size_t i = (std::size_t(axis) + 1) % 3;
    const std::size_t j = (std::size_t(axis) + 2) % 3;
    Transform one;
    one.M[4 * i + i] = one.M[4 * j + j] = c;
    one.M[4 * i + j] = -s;
    one.M[4 * j + i] = s;
    all = one * all;
  }
  return all;
}

Transform Transform::operator*(const Transform& b) const
{
  Transform product;
  for (std::size_t row = 0; row < 3; ++row)
  {
    for (std::size_t column = 0; column < 4; ++column)
    {
      double sum = column == 3 ? (*this)(row, 3) : 0;
      for (std::size_t k = 0; k < 3; ++k)
      {
        sum += (*this)(row, k) * b(k, column);
      }
      product.M[4 * row + column] = sum;
    }
  }
  return product;
}

Transform Transform::inverse() const
{
  const Transform& m = *this;
  Transform result;
  const auto cofactor = [&m](std::size_t row, std::size_t column)
  {
    const std::size_t r1 = (row + 1) % 3;
    const std::size_t r2 = (row + 2) % 3;
    const std::size_t c1 = (column + 1) % 3;
    const std::size_t c2 = (column + 2) % 3;
    return m(r1, c1) * m(r2, c2) - m(r1, c2) * m(r2, c1);
  };
  const double determinant = m(0, 0) * cofactor(0, 0) + m(0, 1) * cofactor(0, 1) + m(0, 2) * cofactor(0, 2);
  if (determinant == 0 || !std::isfinite(determinant))
  {
    return result;
  }
  for (std::size_t row = 0; row < 3; ++row)
  {
    for (std::size_t column = 0; column < 3; ++column)
    {
      result.M[4 * row + column] = cofactor(column, row) / determinant;
    }
  }
  for (std::size_t row = 0; row < 3; ++row)
  {
    result.M[4 * row + 3] = -(result(row, 0) * m(0, 3) + result(row, 1) * m(1, 3) + result(row, 2) * m(2, 3));
  }
  return result;
}

} // namespace dgtk::import
