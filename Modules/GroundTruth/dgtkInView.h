// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkInView_h
#define dgtkInView_h

#include "dgtkCameraModel.h"

namespace dgtk
{

/// Parameter of a ray at a point of it.
inline double alongRay(const Eigen::Vector3d& x_in_camera, const CameraRay& ray)
{
  return (x_in_camera - ray.origin).dot(ray.direction) / ray.direction.squaredNorm();
}

/// Whether a point and the pixel that it is projected to are in the image and between near and far; `linear`: the
/// model's projection is.
inline bool isInView(const View& view, bool linear, const Eigen::Vector3d& x_in_camera, const Eigen::Vector2d& pixel)
{
  const double t = linear ? x_in_camera.z() : alongRay(x_in_camera, view.model->rayThrough(pixel));
  return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= view.model->width() && pixel.y() <= view.model->height() &&
         t >= view.near && t <= view.far;
}

} // namespace dgtk

#endif
