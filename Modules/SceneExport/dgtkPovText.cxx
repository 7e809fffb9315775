// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovText.h"

#include <charconv>

namespace dgtk
{

namespace
{
template <class Number>
std::string shortest(Number value)
{
  char text[32];
  return std::string(text, std::to_chars(text, text + sizeof text, value + Number(0)).ptr);
}
} // namespace

std::string povNumber(double value) { return shortest(value); }
std::string povNumber(float value) { return shortest(value); }

std::string povMatrix(const Affine3& target_from_source)
{
  Eigen::Matrix<double, 12, 1> rows;
  rows << target_from_source.linear.col(0), target_from_source.linear.col(1), target_from_source.linear.col(2),
    target_from_source.translation;
  return "matrix " + povVector(rows);
}

std::string povScale(double scale) { return scale == 1 ? std::string() : " scale " + povNumber(scale); }

} // namespace dgtk
