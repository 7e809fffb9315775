// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkResponse.h"

#include "dgtkPortableMath.h"

#include <algorithm>

namespace dgtk::sensor
{

double Response::curve(double v) const
{
  switch (this->Parameters.response)
  {
    case ResponseCurve::Srgb:
      return portable::srgbFromLinear(v);
    case ResponseCurve::Gamma:
      return portable::pow(v, 1 / this->Parameters.gamma);
    case ResponseCurve::Table:
    {
      const std::vector<double>& table = this->Parameters.table;
      const double at = v * double(table.size() - 1);
      const std::size_t i = std::min(static_cast<std::size_t>(at), table.size() - 2);
      return table[i] + (at - double(i)) * (table[i + 1] - table[i]);
    }
    default:
      return v;
  }
}

void Response::apply(int y, std::vector<float>& rgb) const
{
  for (float& v : rgb)
  {
    v = static_cast<float>(this->curve(std::min(std::max(double(v), 0.0), 1.0)));
  }
  const double pepper = this->Parameters.pepper;
  const double either = pepper + this->Parameters.salt;
  if (either == 0)
  {
    return;
  }
  for (std::size_t x = 0; x < rgb.size() / 3; ++x)
  {
    const double u = this->Random.uniform(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 0);
    if (u < either)
    {
      std::fill_n(rgb.begin() + static_cast<std::ptrdiff_t>(3 * x), 3, u < pepper ? 0.0f : 1.0f);
    }
  }
}

} // namespace dgtk::sensor
