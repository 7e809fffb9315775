// SPDX-License-Identifier: BSD-3-Clause
// V. Usenko, N. Demmel, D. Cremers, "The double sphere camera model", 3DV 2018, equations 40 to 52: a point is brought
// to a unit sphere, to a second one whose centre is xi further back, and seen from alpha / (1 - alpha) behind that.
#include "dgtkUnifiedPlane.h"

#include "dgtkPortableMath.h"

#include <cmath>

namespace dgtk
{

namespace
{
class DoubleSphere final : public RowsOf<DoubleSphere, LensCamera>
{
public:
  DoubleSphere(const CameraParameters& of, const Eigen::Matrix3d& K)
    : RowsOf(of, K)
    , Xi(of.number("xi"))
    , Second(of.number("alpha"))
  {
  }
  std::string name() const override { return "double-sphere"; }
  CameraRay rayThrough(const Eigen::Vector2d& pixel) const override
  {
    Eigen::Vector3d second; // not of length 1
    if (!this->Second.pointOf(this->plane().onPlane(pixel), second))
    {
      return noRay();
    }
    const double xi = this->Xi;
    const double square = second.squaredNorm();
    const double across = second.head<2>().squaredNorm();
    const double scale = (second.z() * xi + std::sqrt(second.z() * second.z() + (1 - xi * xi) * across)) / square;
    return { Eigen::Vector3d::Zero(), scale * second - Eigen::Vector3d(0, 0, xi) };
  }
  bool project(const Eigen::Vector3d& x, Eigen::Vector2d& pixel) const override
  {
    const double distance = std::sqrt(x.squaredNorm());
    Eigen::Vector2d p;
    if (!(distance > 0) || !this->Second.project({ x.x(), x.y(), x.z() + this->Xi * distance }, p))
    {
      return false;
    }
    pixel = this->plane().inImage(p.x(), p.y());
    return true;
  }

private:
  double Xi;
  UnifiedPlane Second;
};

std::shared_ptr<const CameraModel> makeDoubleSphere(const CameraParameters& of)
{
  const auto radius = [&of](double angle)
  {
    const portable::SineCosine at = portable::sinCos(angle);
    Eigen::Vector2d p(0, 0);
    const bool seen = UnifiedPlane(of.number("alpha")).project({ at.sine, 0, at.cosine + of.number("xi") }, p);
    return seen ? p.x() : 0;
  };
  return std::make_shared<DoubleSphere>(of, lensMatrix(of, radius));
}
} // namespace

extern const CameraEntry cameraDoubleSphere;
const CameraEntry cameraDoubleSphere = { { fieldOfViewParameter(), aspectParameter(), matrixParameter(),
                                           { "xi", "", "distance of the spheres' centres",
                                             { -1, 1, true, true, "a number between -1 and 1" }, { 0 }, { 1 }, true },
                                           alphaParameter() },
  &makeDoubleSphere };

} // namespace dgtk
