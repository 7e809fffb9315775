// SPDX-License-Identifier: BSD-3-Clause
// OpenCV's omnidirectional camera: C. Mei, P. Rives, "Single view point omnidirectional camera calibration from planar
// grids", ICRA 2007, section II: the unit sphere, seen from xi behind its centre, and the distortion of what is seen.
#include "dgtkCentrePoints.h"
#include "dgtkDistortion.h"
#include "dgtkLensCamera.h"
#include "dgtkPortableMath.h"

#include <cmath>

namespace dgtk
{

namespace
{
/// Seen from outside of the sphere, its nearer side.
bool isSeen(double xi, double cosine) { return xi <= 1 ? cosine + xi > 0 : 1 + xi * cosine > 0; }

class Omnidirectional final : public RowsOf<Omnidirectional, LensCamera>
{
public:
  Omnidirectional(const CameraParameters& of, const Eigen::Matrix3d& K)
    : RowsOf(of, K)
    , Xi(of.number("xi"))
    , Lens(of.numbers.at("distortion"), this->imageRadius())
    , Centres(CentrePoints::of(of, K))
  {
  }
  std::string name() const override { return "omnidirectional"; }
  CameraRay rayThrough(const Eigen::Vector2d& pixel) const override
  {
    Eigen::Vector2d p;
    const auto undo = [this](const Eigen::Vector2d& at, Eigen::Vector2d& found)
    { return this->Lens.undo(this->plane().onPlane(at), found); };
    if (!this->Centres->point(pixel, undo, p))
    {
      return noRay();
    }
    const double square = p.squaredNorm();
    const double root = this->rootAt(square);
    if (!(root >= leastStretch))
    {
      return noRay();
    }
    const double scale = (this->Xi + root) / (1 + square);
    return { Eigen::Vector3d::Zero(), Eigen::Vector3d(scale * p.x(), scale * p.y(), scale - this->Xi) };
  }
  bool project(const Eigen::Vector3d& x, Eigen::Vector2d& pixel) const override
  {
    const double distance = std::sqrt(x.squaredNorm());
    if (!(distance > 0) || !isSeen(this->Xi, x.z() / distance))
    {
      return false;
    }
    const Eigen::Vector2d p = x.head<2>() / (x.z() + this->Xi * distance);
    Eigen::Vector2d distorted;
    if (!(this->rootAt(p.squaredNorm()) >= leastStretch * (1 - rootSlack)) || !this->Lens.apply(p, distorted))
    {
      return false;
    }
    pixel = this->plane().inImage(distorted.x(), distorted.y());
    return true;
  }

private:
  /// Zero where a ray touches the sphere.
  double rootAt(double square) const { return std::sqrt(1 + (1 - this->Xi * this->Xi) * square); }

  double Xi;
  Distortion Lens;
  std::shared_ptr<const CentrePoints> Centres;
};

std::shared_ptr<const CameraModel> makeOmnidirectional(const CameraParameters& of)
{
  const auto radius = [xi = of.number("xi")](double angle)
  {
    const portable::SineCosine at = portable::sinCos(angle);
    return isSeen(xi, at.cosine) ? at.sine / (at.cosine + xi) : 0;
  };
  return std::make_shared<Omnidirectional>(of, lensMatrix(of, radius));
}
} // namespace

extern const CameraEntry cameraOmnidirectional;
const CameraEntry cameraOmnidirectional = { { fieldOfViewParameter(), aspectParameter(), matrixParameter(),
                                              { "xi", "", "distance of the centre of projection from the sphere's",
                                                { 0, 1e3, false, false, "a number from 0 to 1000" }, { 1 }, { 1 },
                                                true },
                                              distortionParameter("OpenCV's k1, k2, p1, p2", { 4 }) },
  &makeOmnidirectional };

} // namespace dgtk
