// SPDX-License-Identifier: BSD-3-Clause
// OpenCV's fisheye: J. Kannala, S. Brandt, "A generic camera model and calibration method for conventional, wide-angle,
// and fish-eye lenses", PAMI 28 (2006), equation 6 with radius = angle + k1 angle^3 + ... + k4 angle^9.
#include "dgtkGrowing.h"
#include "dgtkLensCamera.h"
#include "dgtkPortableMath.h"
#include "dgtkRadialRays.h"

#include <array>
#include <cmath>

namespace dgtk
{

namespace
{
class Radius
{
public:
  explicit Radius(const std::vector<double>& k)
    : K{ k[0], k[1], k[2], k[3] }
  {
  }
  ValueSlope operator()(double angle) const
  {
    const std::array<double, 4>& k = this->K;
    const double s = angle * angle;
    return { angle * (1 + s * (k[0] + s * (k[1] + s * (k[2] + s * k[3])))),
      1 + s * (3 * k[0] + s * (5 * k[1] + s * (7 * k[2] + s * 9 * k[3]))) };
  }

private:
  std::array<double, 4> K;
};

/// Up to all around.
double lastAngle(const Radius& radius)
{
  constexpr double step = pi / 2048;
  return growsUpTo([&](double angle) { return radius(angle).slope; }, leastStretch, pi, step, 1);
}

class Fisheye final : public RowsOf<Fisheye, LensCamera>
{
public:
  Fisheye(const CameraParameters& of, const Eigen::Matrix3d& K)
    : RowsOf(of, K)
    , Angles(Radius(of.numbers.at("distortion")), lastAngle(Radius(of.numbers.at("distortion"))), this->imageRadius())
    , Rays([this](double radius) { return this->rayAt(radius); }, std::min(this->Angles.most(), this->imageRadius()))
  {
  }
  std::string name() const override { return "fisheye"; }
  CameraRay rayThrough(const Eigen::Vector2d& pixel) const override
  {
    const Eigen::Vector2d p = this->plane().onPlane(pixel);
    const double square = p.squaredNorm();
    RadialRay ray;
    if (!this->Rays.find(square, ray))
    {
      const double radius = std::sqrt(square);
      if (!(radius <= this->Angles.most()))
      {
        return noRay();
      }
      ray = this->rayAt(radius);
    }
    return { Eigen::Vector3d::Zero(), Eigen::Vector3d(ray.across * p.x(), ray.across * p.y(), ray.z) };
  }
  bool project(const Eigen::Vector3d& x, Eigen::Vector2d& pixel) const override
  {
    const double across = std::sqrt(x.head<2>().squaredNorm());
    const double angle = portable::atan2(across, x.z());
    if (!(angle <= this->Angles.last() * (1 + edgeSlack)) || (across == 0 && !(x.z() > 0)))
    {
      return false;
    }
    const double scale = across > 0 ? this->Angles(angle).value / across : 1;
    pixel = this->plane().inImage(scale * x.x(), scale * x.y());
    return true;
  }

private:
  RadialRay rayAt(double radius) const
  {
    const portable::SineCosine angle = portable::sinCos(this->Angles.inverse(radius));
    return { radius > 0 ? angle.sine / radius : 1, angle.cosine };
  }

  Growing<Radius> Angles;
  RadialRays Rays;
};

std::shared_ptr<const CameraModel> makeFisheye(const CameraParameters& of)
{
  return std::make_shared<Fisheye>(of, lensMatrix(of, [](double angle) { return angle; }));
}
} // namespace

extern const CameraEntry cameraFisheye;
const CameraEntry cameraFisheye = { { fieldOfViewParameter(), aspectParameter(), matrixParameter(),
                                      distortionParameter("OpenCV's fisheye: k1, k2, k3, k4", { 4 }) },
  &makeFisheye };

} // namespace dgtk
