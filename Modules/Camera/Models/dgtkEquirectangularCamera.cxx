// SPDX-License-Identifier: BSD-3-Clause
// All directions: longitude from -pi to pi from left to right, latitude from pi / 2 to -pi / 2 from top to bottom;
// forward is the middle.
#include "dgtkCameraEntry.h"
#include "dgtkPortableMath.h"

#include <cmath>

namespace dgtk
{

namespace
{
class Equirectangular final : public RowsOf<Equirectangular>
{
public:
  explicit Equirectangular(const CameraParameters& of)
    : RowsOf(of)
  {
  }
  std::string name() const override { return "equirectangular"; }
  bool isCentral() const override { return true; }
  CameraRay rayThrough(const Eigen::Vector2d& pixel) const override
  {
    const double right = pixel.x() / this->width();
    const double down = pixel.y() / this->height();
    if (!(right >= 0 && right <= 1 && down >= 0 && down <= 1))
    {
      return { Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero() };
    }
    const portable::SineCosine longitude = portable::sinCos((right - 0.5) * (2 * pi));
    const portable::SineCosine below = portable::sinCos((down - 0.5) * pi);
    return { Eigen::Vector3d::Zero(),
      Eigen::Vector3d(below.cosine * longitude.sine, below.sine, below.cosine * longitude.cosine) };
  }
  /// The poles are seen in the middle of the first and the last row.
  bool project(const Eigen::Vector3d& x, Eigen::Vector2d& pixel) const override
  {
    const double across = std::sqrt(x.x() * x.x() + x.z() * x.z());
    if (!(across + std::abs(x.y()) > 0))
    {
      return false;
    }
    pixel = { (portable::atan2(x.x(), x.z()) / (2 * pi) + 0.5) * this->width(),
      (portable::atan2(x.y(), across) / pi + 0.5) * this->height() };
    return true;
  }
};

std::shared_ptr<const CameraModel> makeEquirectangularModel(const CameraParameters& of)
{
  return std::make_shared<Equirectangular>(of);
}
} // namespace

extern const CameraEntry cameraEquirectangular;
const CameraEntry cameraEquirectangular = { {}, &makeEquirectangularModel };

} // namespace dgtk
