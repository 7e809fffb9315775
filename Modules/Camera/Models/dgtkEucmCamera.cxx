// SPDX-License-Identifier: BSD-3-Clause
// B. Khomutenko, G. Garcia, P. Martinet, "An enhanced unified camera model", RA-L 1 (2016), equations 5 to 13: an
// ellipsoid, or another quadric, in the place of the unified model's sphere.
#include "dgtkUnifiedPlane.h"

#include "dgtkPortableMath.h"

#include <cmath>

namespace dgtk
{

namespace
{
class Eucm final : public RowsOf<Eucm, LensCamera>
{
public:
  Eucm(const CameraParameters& of, const Eigen::Matrix3d& K)
    : RowsOf(of, K)
    , Quadric(of.number("alpha"), of.number("beta"))
  {
  }
  std::string name() const override { return "eucm"; }
  CameraRay rayThrough(const Eigen::Vector2d& pixel) const override
  {
    Eigen::Vector3d point;
    if (!this->Quadric.pointOf(this->plane().onPlane(pixel), point))
    {
      return noRay();
    }
    return { Eigen::Vector3d::Zero(), point / std::sqrt(point.squaredNorm()) };
  }
  bool project(const Eigen::Vector3d& x, Eigen::Vector2d& pixel) const override
  {
    Eigen::Vector2d p;
    if (!this->Quadric.project(x, p))
    {
      return false;
    }
    pixel = this->plane().inImage(p.x(), p.y());
    return true;
  }

private:
  UnifiedPlane Quadric;
};

std::shared_ptr<const CameraModel> makeEucm(const CameraParameters& of)
{
  const auto radius = [&of](double angle)
  {
    const portable::SineCosine at = portable::sinCos(angle);
    Eigen::Vector2d p(0, 0);
    const bool seen = UnifiedPlane(of.number("alpha"), of.number("beta")).project({ at.sine, 0, at.cosine }, p);
    return seen ? p.x() : 0;
  };
  return std::make_shared<Eucm>(of, lensMatrix(of, radius));
}
} // namespace

extern const CameraEntry cameraEucm;
const CameraEntry cameraEucm = { { fieldOfViewParameter(), aspectParameter(), matrixParameter(), alphaParameter(),
                                   { "beta", "", "shape of the quadric, 1: a sphere",
                                     { 0, 1e3, true, false, "a number above 0, up to 1000" }, { 1 }, { 1 }, true } },
  &makeEucm };

} // namespace dgtk
