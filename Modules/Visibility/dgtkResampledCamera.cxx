// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkResampledCamera.h"

#include "dgtkFinerCamera.h"

#include <cmath>
#include <utility>

namespace dgtk
{

namespace
{
class ResampledCamera final : public CameraModel
{
public:
  ResampledCamera(
    std::shared_ptr<const CameraModel> model, int width, int height, double scale, const Eigen::Vector2d& offset)
    : CameraModel(width, height)
    , Model(std::move(model))
    , Scale(scale)
    , Offset(offset)
  {
  }
  std::string name() const override { return this->Model->name(); }
  CameraRay rayThrough(const Eigen::Vector2d& pixel) const override
  {
    return this->Model->rayThrough(this->Scale * pixel + this->Offset);
  }
  bool project(const Eigen::Vector3d& x_in_camera, Eigen::Vector2d& pixel) const override
  {
    Eigen::Vector2d point;
    if (!this->Model->project(x_in_camera, point))
    {
      return false;
    }
    pixel = (point - this->Offset) / this->Scale;
    return true;
  }
  /// That of the pixel of the other image.
  double timeAt(const Eigen::Vector2d& pixel) const override
  {
    const Eigen::Vector2d point = this->Scale * pixel + this->Offset;
    return this->Model->timeAt({ std::floor(point.x()) + 0.5, std::floor(point.y()) + 0.5 });
  }
  TimeSpan times() const override { return this->Model->times(); }
  bool isCentral() const override { return this->Model->isCentral(); }
  std::optional<LinearProjection> linear() const override
  {
    std::optional<LinearProjection> projection = this->Model->linear();
    if (projection)
    {
      projection->K.topRightCorner<2, 1>() -= this->Offset;
      projection->K.topRows<2>() /= this->Scale;
    }
    return projection;
  }

private:
  std::shared_ptr<const CameraModel> Model;
  double Scale;
  Eigen::Vector2d Offset;
};
} // namespace

std::shared_ptr<const CameraModel> resampledCamera(
  std::shared_ptr<const CameraModel> model, int width, int height, double scale, const Eigen::Vector2d& offset)
{
  const int times = width / model->width();
  if (offset.isZero(0) && scale * times == 1 && times * model->width() == width && times * model->height() == height)
  {
    if (auto finer = finerCamera(*model, times))
    {
      return finer;
    }
  }
  return std::make_shared<ResampledCamera>(std::move(model), width, height, scale, offset);
}

} // namespace dgtk
