// SPDX-License-Identifier: BSD-3-Clause
// Parallel projection: rays along z.
#include "dgtkLinearCamera.h"

#include "dgtkError.h"
#include "dgtkText.h"

#include <cmath>

namespace dgtk
{

namespace
{
class Orthographic final : public RowsOf<Orthographic, LinearCamera>
{
public:
  Orthographic(int width, int height, const Eigen::Matrix3d& K)
    : RowsOf(width, height, K, false)
  {
  }
  std::string name() const override { return "orthographic"; }
  CameraRay rayThrough(const Eigen::Vector2d& pixel) const override
  {
    const Eigen::Vector2d p = this->onPlane(pixel);
    return { Eigen::Vector3d(p.x(), p.y(), 0), Eigen::Vector3d(0, 0, 1) };
  }
  bool project(const Eigen::Vector3d& x, Eigen::Vector2d& pixel) const override
  {
    if (!(x.z() >= 0))
    {
      return false;
    }
    pixel = this->inImage(x.x(), x.y());
    return true;
  }
};

/// In a dataset K says it all, in pixels a scene unit.
std::shared_ptr<const CameraModel> makeOrthographicModel(const CameraParameters& of)
{
  if (of.K)
  {
    return std::make_shared<Orthographic>(of.width, of.height, *of.K);
  }
  return makeOrthographic(of.width, of.height, of.number("viewHeight"), of.number("aspect"));
}
} // namespace

std::shared_ptr<const CameraModel> makeOrthographic(int width, int height, double viewHeight, double aspect)
{
  checkCameraSize(width, height);
  if (!(viewHeight > 0) || !std::isfinite(viewHeight))
  {
    throw UsageError("view height out of range (expected a number > 0, found " + shortest(viewHeight) + ")");
  }
  return std::make_shared<Orthographic>(width, height, centredK(width, height, viewHeight, aspect));
}

extern const CameraEntry cameraOrthographic;
const CameraEntry cameraOrthographic = { { viewHeightParameter(), aspectParameter() }, &makeOrthographicModel };

} // namespace dgtk
