// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCameraModel.h"

#include "dgtkError.h"
#include "dgtkPortableMath.h"

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

namespace dgtk
{

namespace
{
/// Sine of the angle between up and view below which they count as parallel.
constexpr double parallelSine = 1e-12;

void checkView(const View& view)
{
  if (!view.model)
  {
    throw UsageError("view '" + view.name + "' has no camera model");
  }
  if (!(view.near > 0) || !(view.far > view.near) || !std::isfinite(view.far))
  {
    throw UsageError("near and far of view '" + view.name + "' out of range (expected 0 < near < far)");
  }
}

/// 2 tan(angle / 2) of the angle between two directions; infinite for opposite ones.
double extentBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  const double angle = portable::atan2(a.cross(b).norm(), a.dot(b));
  return a.dot(b) < 0 && a.cross(b).norm() == 0 ? std::numeric_limits<double>::infinity()
                                                : 2 * portable::tan(angle / 2);
}

} // namespace

Rigid3 lookAtPose(const Eigen::Vector3d& eye, const Eigen::Vector3d& lookAt, const Eigen::Vector3d& up)
{
  const Eigen::Vector3d view = lookAt - eye;
  if (!view.allFinite() || !up.allFinite())
  {
    throw UsageError("eye, look-at or up of a camera is not finite");
  }
  const Eigen::Vector3d forward = view.stableNormalized();
  if (!(forward.squaredNorm() > 0.5))
  {
    throw UsageError("eye and look-at of a camera coincide");
  }
  const Eigen::Vector3d sideways = forward.cross(up.stableNormalized());
  if (!(sideways.norm() > parallelSine))
  {
    throw UsageError("up vector of a camera is zero or parallel to its view");
  }
  const Eigen::Vector3d right = sideways.normalized();
  Rigid3 camera_from_world;
  camera_from_world.rotation.row(0) = right;
  camera_from_world.rotation.row(1) = forward.cross(right);
  camera_from_world.rotation.row(2) = forward;
  camera_from_world.translation = -(camera_from_world.rotation * eye);
  return camera_from_world;
}

WorldResolution worldResolution(const View& view)
{
  checkView(view);
  const CameraModel& model = *view.model;
  const double width = model.width();
  const double height = model.height();
  Eigen::Vector2d perPixel; // 2 tan(fov / 2) / pixels, or scene units of a pixel
  if (const std::optional<LinearProjection> linear = model.linear())
  {
    perPixel = { 1 / linear->K(0, 0), 1 / linear->K(1, 1) };
    if (!linear->perspective)
    {
      return { perPixel, perPixel };
    }
  }
  else
  {
    const auto direction = [&](double column, double row) { return model.rayThrough({ column, row }).direction; };
    const double x = width / 2;
    const double y = height / 2;
    perPixel = { extentBetween(direction(x - 0.5, y), direction(x + 0.5, y)),
      extentBetween(direction(x, y - 0.5), direction(x, y + 0.5)) };
  }
  return { (view.far - view.near) * perPixel, view.far * perPixel };
}

OpenGLMatrices openGLMatrices(const View& view)
{
  checkView(view);
  const std::optional<LinearProjection> linear = view.model->linear();
  if (!linear)
  {
    throw UsageError("camera '" + view.name + "' (" + view.model->name() + ") has no OpenGL matrices");
  }
  const Eigen::Matrix3d& K = linear->K;
  const double width = view.model->width();
  const double height = view.model->height();
  const double depth = view.far - view.near;
  OpenGLMatrices m;
  Eigen::Matrix4d& P = m.projection;
  P.setZero();
  P(0, 0) = 2 * K(0, 0) / width;
  P(0, 1) = -2 * K(0, 1) / width;
  P(1, 1) = 2 * K(1, 1) / height;
  const double offsetX = 2 * K(0, 2) / width - 1;
  const double offsetY = 1 - 2 * K(1, 2) / height;
  if (linear->perspective)
  {
    P(0, 2) = -offsetX;
    P(1, 2) = -offsetY;
    P(2, 2) = -(view.far + view.near) / depth;
    P(2, 3) = -2 * view.far * view.near / depth;
    P(3, 2) = -1;
  }
  else
  {
    P(0, 3) = offsetX;
    P(1, 3) = offsetY;
    P(2, 2) = -2 / depth;
    P(2, 3) = -(view.far + view.near) / depth;
    P(3, 3) = 1;
  }
  const Eigen::Vector3d gl_from_camera(1, -1, -1);
  m.modelView.setIdentity();
  m.modelView.topLeftCorner<3, 3>() = gl_from_camera.asDiagonal() * view.camera_from_world.rotation;
  m.modelView.topRightCorner<3, 1>() = gl_from_camera.asDiagonal() * view.camera_from_world.translation;
  return m;
}

} // namespace dgtk
