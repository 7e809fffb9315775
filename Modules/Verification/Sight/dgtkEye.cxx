// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEye.h"

namespace dgtk
{

namespace
{
std::shared_ptr<const CameraModel> linearModel(const CameraRecord& camera)
{
  if (camera.model == "pinhole")
  {
    return makePinhole(camera.width, camera.height, camera.K);
  }
  const double viewHeight = camera.height / camera.K(1, 1);
  return makeOrthographic(camera.width, camera.height, viewHeight, camera.width / camera.K(0, 0) / viewHeight);
}
} // namespace

Eye::Eye(const CameraRecord& record, std::shared_ptr<const CameraModel> model)
  : Record(record)
  , Pinhole(record.model == "pinhole" && record.numbers.count("distortion") == 0)
  , Parallel(record.model == "orthographic")
  , Lens(Pinhole || Parallel ? nullptr : EyeLens::of(record))
{
  this->TheView.name = record.name;
  this->TheView.model = this->linear() ? linearModel(record) : std::move(model);
  this->TheView.camera_from_world = { record.R, record.t };
  this->TheView.near = record.near;
  this->TheView.far = record.far;
}

CameraRay Eye::ray(const Eigen::Vector2d& pixel) const
{
  if (!this->linear())
  {
    return this->TheView.model->rayThrough(pixel);
  }
  const Eigen::Matrix3d& K = this->Record.K;
  const double y = (pixel.y() - K(1, 2)) / K(1, 1);
  const double x = (pixel.x() - K(0, 2) - K(0, 1) * y) / K(0, 0);
  return this->Pinhole ? CameraRay{ { 0, 0, 0 }, { x, y, 1 } } : CameraRay{ { x, y, 0 }, { 0, 0, 1 } };
}

Eigen::Vector3d Eye::at(const Eigen::Vector2d& pixel, double depth) const
{
  const CameraRay ray = this->ray(pixel);
  return ray.origin + (depth - ray.origin.z()) / ray.direction.z() * ray.direction;
}

bool Eye::project(const Eigen::Vector3d& x, Eigen::Vector2d& pixel) const
{
  if (!this->linear())
  {
    const bool seen = this->TheView.model->project(x, pixel);
    if (seen && this->Lens)
    {
      pixel = this->Lens->project({ x }).front();
    }
    return seen;
  }
  if (this->Pinhole ? !(x.z() > 0) : !(x.z() >= 0))
  {
    return false;
  }
  const Eigen::Vector3d h = this->Pinhole ? x : Eigen::Vector3d(x.x(), x.y(), 1);
  pixel = (this->Record.K * h).head<2>() / h.z();
  return true;
}

double Eye::range(const Eigen::Vector2d& pixel, const Eigen::Vector3d& x) const
{
  const CameraRay ray = this->ray(pixel);
  return this->linear() ? x.z() : (x - ray.origin).dot(ray.direction) / ray.direction.squaredNorm();
}

Eigen::Vector2d Eye::reach(double angle, const Eigen::Vector3d& x) const
{
  const Eigen::Vector2d focal = this->Record.K.diagonal().head<2>();
  if (!this->linear())
  {
    return angle * focal.cwiseMax(Eigen::Vector2d(this->width(), this->height()));
  }
  return angle * (this->Pinhole ? 1 : x.z()) * focal;
}

bool Eye::sees(const Eigen::Vector2d& pixel, const Eigen::Vector3d& x) const
{
  const double range = this->range(pixel, x);
  return pixel.x() >= 0 && pixel.x() <= this->width() && pixel.y() >= 0 && pixel.y() <= this->height() &&
         range >= this->Record.near && range <= this->Record.far;
}

} // namespace dgtk
