// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLensCamera.h"

#include "dgtkError.h"
#include "dgtkPortableMath.h"
#include "dgtkText.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
CameraParameters withMatrix(const CameraParameters& of, const Eigen::Matrix3d& K)
{
  CameraParameters with = of;
  with.K = K;
  for (const CameraParameter& said : { fieldOfViewParameter(), aspectParameter() })
  {
    with.numbers.erase(said.name);
  }
  return with;
}
} // namespace

LensCamera::LensCamera(const CameraParameters& of, const Eigen::Matrix3d& K)
  : CameraModel(withMatrix(of, K))
  , Plane(K)
{
}

double LensCamera::imageRadius() const
{
  double radius = 0;
  for (const double x : { 0.0, double(this->width()) })
  {
    for (const double y : { 0.0, double(this->height()) })
    {
      radius = std::max(radius, this->Plane.onPlane({ x, y }).norm());
    }
  }
  return radius;
}

Eigen::Matrix3d lensMatrix(const CameraParameters& of, const std::function<double(double)>& radius)
{
  if (of.K)
  {
    return *of.K;
  }
  const double fovY = of.number("fovY");
  const double found = radius(fovY * (pi / 360));
  if (!(found > 0) || !std::isfinite(found))
  {
    throw UsageError("fovY is beyond the field of view of the lens (found " + shortest(fovY) + " degrees)");
  }
  return centredK(of.width, of.height, 2 * found, of.number("aspect"));
}

CameraParameter distortionParameter(const std::string& help, std::vector<std::size_t> counts)
{
  CameraParameter parameter{ "distortion", "", help };
  parameter.usual.assign(counts.front(), 0);
  parameter.counts = std::move(counts);
  return parameter;
}

} // namespace dgtk
