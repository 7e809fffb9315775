// SPDX-License-Identifier: BSD-3-Clause
// Perspective: rays through a point.
#include "dgtkLinearCamera.h"

#include "dgtkError.h"
#include "dgtkPortableMath.h"
#include "dgtkText.h"

#include <cmath>

namespace dgtk
{

namespace
{
class Pinhole final : public RowsOf<Pinhole, LinearCamera>
{
public:
  Pinhole(int width, int height, const Eigen::Matrix3d& K)
    : RowsOf(width, height, K, true)
  {
  }
  std::string name() const override { return "pinhole"; }
  CameraRay rayThrough(const Eigen::Vector2d& pixel) const override
  {
    const Eigen::Vector2d p = this->onPlane(pixel);
    return { Eigen::Vector3d::Zero(), Eigen::Vector3d(p.x(), p.y(), 1) };
  }
  bool project(const Eigen::Vector3d& x, Eigen::Vector2d& pixel) const override
  {
    if (!(x.z() > 0))
    {
      return false;
    }
    pixel = this->inImage(x.x() / x.z(), x.y() / x.z());
    return true;
  }
};

std::shared_ptr<const CameraModel> make(const CameraParameters& of)
{
  return of.K ? makePinhole(of.width, of.height, *of.K)
              : makePinholeFromFov(of.width, of.height, of.number("fovY"), of.number("aspect"));
}
} // namespace

std::shared_ptr<const CameraModel> makePinhole(int width, int height, const Eigen::Matrix3d& K)
{
  return std::make_shared<Pinhole>(width, height, K);
}

std::shared_ptr<const CameraModel> makePinholeFromFov(int width, int height, double fovYDegrees, double aspect)
{
  checkCameraSize(width, height);
  if (!(fovYDegrees > 0 && fovYDegrees < 180))
  {
    throw UsageError("field of view out of range (expected more than 0 and less than 180 degrees, found " +
                     shortest(fovYDegrees) + ")");
  }
  return makePinhole(width, height, centredK(width, height, 2 * std::tan(fovYDegrees * (pi / 360)), aspect));
}

extern const CameraEntry cameraPinhole;
const CameraEntry cameraPinhole = { { fieldOfViewParameter(), aspectParameter(), matrixParameter() }, &make };

} // namespace dgtk
