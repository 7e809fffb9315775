// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkImagePlane.h"

#include "dgtkError.h"
#include "dgtkText.h"

#include <cmath>

namespace dgtk
{

ImagePlane::ImagePlane(const Eigen::Matrix3d& matrix)
  : K(matrix)
{
  if (!K.allFinite())
  {
    throw UsageError("K has a value that is not finite");
  }
  if (!(K(0, 0) > 0) || !(K(1, 1) > 0))
  {
    throw UsageError("focal lengths of K out of range (expected fx, fy > 0, found " + shortest(K(0, 0)) + ", " +
                     shortest(K(1, 1)) + ")");
  }
  if (K(1, 0) != 0 || K(2, 0) != 0 || K(2, 1) != 0 || K(2, 2) != 1)
  {
    throw UsageError("K is not of the form [fx s cx; 0 fy cy; 0 0 1]");
  }
}

Eigen::Matrix3d centredK(int width, int height, double viewHeight, double aspect)
{
  if (!std::isfinite(aspect))
  {
    throw UsageError("aspect is not finite");
  }
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
  K(1, 1) = height / viewHeight;
  K(0, 0) = aspect > 0 ? width / (aspect * viewHeight) : K(1, 1);
  K(0, 2) = 0.5 * width;
  K(1, 2) = 0.5 * height;
  return K;
}

} // namespace dgtk
