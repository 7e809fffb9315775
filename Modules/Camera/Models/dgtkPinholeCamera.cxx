// SPDX-License-Identifier: BSD-3-Clause
// Perspective: rays through a point, and OpenCV's distortion of their image.
#include "dgtkCentrePoints.h"
#include "dgtkDistortion.h"
#include "dgtkLensCamera.h"
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

class DistortedPinhole final : public RowsOf<DistortedPinhole, LensCamera>
{
public:
  DistortedPinhole(const CameraParameters& of, const Eigen::Matrix3d& K)
    : RowsOf(of, K)
    , Lens(of.numbers.at("distortion"), this->imageRadius())
    , Centres(CentrePoints::of(of, K))
  {
  }
  std::string name() const override { return "pinhole"; }
  CameraRay rayThrough(const Eigen::Vector2d& pixel) const override
  {
    Eigen::Vector2d p;
    const auto undo = [this](const Eigen::Vector2d& at, Eigen::Vector2d& found)
    { return this->Lens.undo(this->plane().onPlane(at), found); };
    if (!this->Centres->point(pixel, undo, p))
    {
      return noRay();
    }
    const double scale = 1 / std::sqrt(1 + p.squaredNorm());
    return { Eigen::Vector3d::Zero(), Eigen::Vector3d(scale * p.x(), scale * p.y(), scale) };
  }
  bool project(const Eigen::Vector3d& x, Eigen::Vector2d& pixel) const override
  {
    Eigen::Vector2d p;
    if (!(x.z() > 0) || !this->Lens.apply(x.head<2>() / x.z(), p))
    {
      return false;
    }
    pixel = this->plane().inImage(p.x(), p.y());
    return true;
  }

private:
  Distortion Lens;
  std::shared_ptr<const CentrePoints> Centres;
};

std::shared_ptr<const CameraModel> makePinholeModel(const CameraParameters& of)
{
  if (!Distortion::isNone(of.numbers.at("distortion")))
  {
    return std::make_shared<DistortedPinhole>(of, lensMatrix(of, [](double angle) { return portable::tan(angle); }));
  }
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
  return makePinhole(width, height, centredK(width, height, 2 * portable::tan(fovYDegrees * (pi / 360)), aspect));
}

extern const CameraEntry cameraPinhole;
const CameraEntry cameraPinhole = { { fieldOfViewParameter(), aspectParameter(), matrixParameter(),
                                      distortionParameter("OpenCV's k1, k2, p1, p2, k3, k4, k5, k6, s1, s2, s3, s4, "
                                                          "tx, ty; the image without it where it is zero",
                                        { 4, 5, 8, 12, 14 }) },
  &makePinholeModel };

} // namespace dgtk
