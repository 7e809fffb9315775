// SPDX-License-Identifier: BSD-3-Clause
// A camera model of a program of its own: an equidistant fisheye, whose image points lie at a distance from the centre
// that is proportional to the angle from the optical axis.
#include <dgtkCameraEntry.h>

#include <algorithm>
#include <cmath>

namespace
{
using namespace dgtk;

constexpr double pi = 3.14159265358979323846;

class Fisheye final : public CameraModel
{
public:
  explicit Fisheye(const CameraParameters& of)
    : CameraModel(of)
    , Centre(0.5 * of.width, 0.5 * of.height)
    , Focal(std::min(Centre.x(), Centre.y()) / (of.number("halfAngle") * pi / 180))
  {
  }
  std::string name() const override { return "equidistant"; }
  CameraRay rayThrough(const Eigen::Vector2d& pixel) const override
  {
    const Eigen::Vector2d p = (pixel - this->Centre) / this->Focal;
    const double angle = p.norm();
    const double across = angle > 0 ? std::sin(angle) / angle : 1;
    return { { 0, 0, 0 }, { across * p.x(), across * p.y(), std::cos(angle) } };
  }
  bool project(const Eigen::Vector3d& x, Eigen::Vector2d& pixel) const override
  {
    const double across = std::hypot(x.x(), x.y());
    if (across == 0 && !(x.z() > 0))
    {
      return false;
    }
    const double scale = across > 0 ? std::atan2(across, x.z()) / across : 1 / x.z();
    pixel = this->Centre + this->Focal * scale * x.head<2>();
    return true;
  }

private:
  Eigen::Vector2d Centre;
  double Focal; ///< pixels a radian
};

std::shared_ptr<const CameraModel> make(const CameraParameters& of) { return std::make_shared<Fisheye>(of); }

const CameraEntry entry = { { { "halfAngle", "degrees", "between the axis and the middle of the nearer sides",
                              { 0, 180, true, true, "degrees above 0 and below 180" }, { 90 }, { 1 }, true } },
  &make };
const bool added = addCamera({ "equidistant", "fisheye, r = f * angle", &entry }); // the row
} // namespace
