// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDepthPicture.h"

#include "dgtkError.h"
#include "dgtkJsonText.h"
#include "dgtkText.h"

#include <cmath>

namespace dgtk
{

double portableLog(double x)
{
  // x = m 2^e with m in [sqrt(1/2), sqrt(2)); log m = 2 atanh((m - 1) / (m + 1)) by its series
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0.70710678118654752)
  {
    m *= 2;
    --exponent;
  }
  const double s = (m - 1) / (m + 1);
  const double s2 = s * s;
  double sum = 0;
  for (int k = 19; k >= 1; k -= 2)
  {
    sum = sum * s2 + 1.0 / k;
  }
  return 2 * s * sum + exponent * 0.69314718055994531;
}

DepthPicture::DepthPicture(double near, double far, const std::string& path)
  : Near(near)
  , Far(far)
{
  if (!std::isfinite(near) || !std::isfinite(far) || near >= far)
  {
    throw UsageError(
      path + ": a picture of depth needs finite near < far (found " + shortest(near) + " and " + shortest(far) + ")");
  }
  this->Scale = 254 / (near > 0 ? portableLog(far / near) : far - near);
}

unsigned char DepthPicture::operator()(double depth) const
{
  if (!std::isfinite(depth))
  {
    return 0;
  }
  if (depth <= this->Near)
  {
    return 255;
  }
  if (depth >= this->Far)
  {
    return 1;
  }
  const double steps = this->Scale * (this->Near > 0 ? portableLog(this->Far / depth) : this->Far - depth);
  return static_cast<unsigned char>(1.5 + steps);
}

} // namespace dgtk
