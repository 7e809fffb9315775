// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDepthPicture.h"

#include "dgtkError.h"
#include "dgtkPortableMath.h"
#include "dgtkText.h"

#include <cmath>

namespace dgtk
{

DepthPicture::DepthPicture(double near, double far, const std::string& path)
  : Near(near)
  , Far(far)
{
  if (!std::isfinite(near) || !std::isfinite(far) || near >= far)
  {
    throw UsageError(
      path + ": a picture of depth needs finite near < far (found " + shortest(near) + " and " + shortest(far) + ")");
  }
  this->Scale = 254 / (near > 0 ? portable::log(far / near) : far - near);
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
  const double steps = this->Scale * (this->Near > 0 ? portable::log(this->Far / depth) : this->Far - depth);
  return static_cast<unsigned char>(1.5 + steps);
}

} // namespace dgtk
