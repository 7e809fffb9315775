// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRollingCamera.h"

namespace dgtk
{

namespace
{
CameraParameters with(CameraParameters of, const RollingShutter& shutter)
{
  of.rollingShutter = shutter;
  return of;
}

class RollingCamera final : public CameraModel
{
public:
  RollingCamera(std::shared_ptr<const CameraModel> camera, const RollingShutter& shutter)
    : CameraModel(with(camera->parameters(), shutter))
    , Camera(std::move(camera))
    , Shutter(shutter)
  {
  }
  std::string name() const override { return this->Camera->name(); }
  CameraRay rayThrough(const Eigen::Vector2d& pixel) const override { return this->Camera->rayThrough(pixel); }
  bool project(const Eigen::Vector3d& x, Eigen::Vector2d& pixel) const override
  {
    return this->Camera->project(x, pixel);
  }
  void raysThrough(const Eigen::Vector2d* pixels, std::size_t count, CameraRay* rays) const override
  {
    this->Camera->raysThrough(pixels, count, rays);
  }
  void projectAll(
    const Eigen::Vector3d* x, std::size_t count, Eigen::Vector2d* pixels, std::uint8_t* seen) const override
  {
    this->Camera->projectAll(x, count, pixels, seen);
  }
  double timeAt(const Eigen::Vector2d& pixel) const override
  {
    return this->Shutter.timeAt(pixel, this->width(), this->height()) + this->Camera->timeAt(pixel);
  }
  TimeSpan times() const override
  {
    const TimeSpan own = this->Camera->times();
    return { own.first - this->Shutter.duration / 2, own.last + this->Shutter.duration / 2 };
  }
  bool isCentral() const override { return this->Camera->isCentral(); }
  std::optional<LinearProjection> linear() const override { return this->Camera->linear(); }

private:
  std::shared_ptr<const CameraModel> Camera;
  RollingShutter Shutter;
};
} // namespace

std::shared_ptr<const CameraModel> withRollingShutter(
  std::shared_ptr<const CameraModel> camera, const RollingShutter& shutter)
{
  return shutter.duration > 0 ? std::make_shared<RollingCamera>(std::move(camera), shutter) : camera;
}

} // namespace dgtk
