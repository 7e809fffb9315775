// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEpipolarLine.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>

namespace dgtk
{

namespace
{
constexpr double degenerate = 1e-12; // of the sine between centre and ray: what is left is rounding

/// Homogeneous image of a point (w = 1) or direction (w = 0) of the camera frame.
Eigen::Vector3d imageOf(const LinearProjection& projection, const Eigen::Vector3d& x, double w)
{
  return projection.K * (projection.perspective ? x : Eigen::Vector3d(x.x(), x.y(), w));
}
} // namespace

std::optional<Eigen::Vector3d> epipolarLine(const View& from, const Eigen::Vector2d& pixel, const View& to)
{
  const std::optional<LinearProjection> projection = to.model->linear();
  if (!projection || !from.model->linear() || from.instants || to.instants)
  {
    return std::nullopt;
  }
  const CameraRay ray = from.model->rayThrough(pixel);
  const Rigid3 to_from_from = to.camera_from_world * from.camera_from_world.inverse();
  const Eigen::Vector3d origin = to_from_from * ray.origin;
  const Eigen::Vector3d direction = to_from_from.rotation * ray.direction.normalized();
  const double reach = from.camera_from_world.translation.norm() + to.camera_from_world.translation.norm();
  if (projection->perspective && origin.norm() <= degenerate * reach)
  {
    return std::nullopt; // one centre
  }
  const Eigen::Vector3d near = projection->perspective ? origin.stableNormalized() : origin;
  const double sine = projection->perspective ? near.cross(direction).norm() : direction.head<2>().norm();
  if (!(sine > degenerate))
  {
    return std::nullopt;
  }
  Eigen::Vector3d line = imageOf(*projection, near, 1).cross(imageOf(*projection, direction, 0));
  const double length = line.head<2>().norm();
  if (!(length > degenerate * line.norm()))
  {
    return std::nullopt; // at infinity: the ray is beside the camera, parallel to its image
  }
  line /= length;
  return line;
}

std::optional<LinePart> clippedLine(const Eigen::Vector3d& line, double width, double height)
{
  // The foot of the perpendicular from the middle, then both ways along the line.
  const Eigen::Vector2d normal = line.head<2>();
  const Eigen::Vector2d along(-normal.y(), normal.x());
  const Eigen::Vector2d middle(width / 2, height / 2);
  const Eigen::Vector2d foot = middle - (normal.dot(middle) + line.z()) * normal;
  double first = -std::numeric_limits<double>::infinity();
  double last = -first;
  for (int axis = 0; axis < 2; ++axis)
  {
    const double size = axis == 0 ? width : height;
    if (along[axis] == 0)
    {
      if (foot[axis] < 0 || foot[axis] > size)
      {
        return std::nullopt;
      }
      continue;
    }
    const double a = -foot[axis] / along[axis];
    const double b = (size - foot[axis]) / along[axis];
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  if (!(first <= last))
  {
    return std::nullopt;
  }
  return LinePart{ foot + first * along, foot + last * along };
}

} // namespace dgtk
