// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRasterCamera.h"

#include "dgtkError.h"

#include <algorithm>

namespace dgtk
{

RasterCamera rasterCamera(const View& view, const PixelRect& rect, int samples, bool zeroToOne)
{
  const std::optional<LinearProjection> linear = view.model->linear();
  if (!linear || view.instants)
  {
    throw UsageError("camera " + quoted(view.name) + " (" + view.model->name() +
                     (view.instants ? ", with a rolling shutter)" : ")") + " cannot be drawn with OpenGL");
  }
  const double sx = 2.0 / rect.width;
  const double sy = 2.0 / rect.height;
  const Eigen::Matrix3d K = linear->K;
  // Rows of clip coordinates as functions of the OpenCV camera frame (x, y, z, 1).
  Eigen::Matrix4d clip_from_camera = Eigen::Matrix4d::Zero();
  const int offset = linear->perspective ? 2 : 3; // the principal point's column
  clip_from_camera(0, 0) = sx * samples * K(0, 0);
  clip_from_camera(0, 1) = sx * samples * K(0, 1);
  clip_from_camera(0, offset) = sx * (samples * K(0, 2) - rect.x) - 1;
  clip_from_camera(1, 1) = -sy * samples * K(1, 1);
  clip_from_camera(1, offset) = 1 - sy * (samples * K(1, 2) - rect.y);
  clip_from_camera(3, offset) = 1;
  const double range = view.far - view.near;
  clip_from_camera(2, 2) = -(linear->perspective ? view.near : 1.0) / range;
  clip_from_camera(2, 3) = (linear->perspective ? view.near : 1.0) * view.far / range;
  if (!zeroToOne)
  {
    clip_from_camera.row(2) = 2 * clip_from_camera.row(2) - clip_from_camera.row(3);
  }
  const Eigen::Vector4d flip(1, -1, -1, 1); // OpenCV's camera axes and OpenGL's
  RasterCamera camera;
  camera.perspective = linear->perspective;
  camera.near = view.near;
  camera.far = view.far;
  camera.focal = samples * std::max(K(0, 0), K(1, 1));
  camera.clip_from_view = clip_from_camera * flip.asDiagonal();
  camera.view_from_world.setIdentity();
  camera.view_from_world.topLeftCorner<3, 3>() = view.camera_from_world.rotation;
  camera.view_from_world.topRightCorner<3, 1>() = view.camera_from_world.translation;
  camera.view_from_world = flip.asDiagonal() * camera.view_from_world;
  return camera;
}

} // namespace dgtk
