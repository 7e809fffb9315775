// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkUprightBox.h"

#include "dgtkPortableMath.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
/// Directions of the box's own axes in the camera frame; nothing where they are not perpendicular.
std::optional<Eigen::Matrix3d> axesOf(const Eigen::Matrix3d& edges)
{
  constexpr double rounding = 1e-6;
  Eigen::Matrix3d axes = edges;
  const double largest = edges.colwise().norm().maxCoeff();
  int flat = -1;
  for (int k = 0; k < 3; ++k)
  {
    const double length = edges.col(k).norm();
    if (length > 1e-12 * largest)
    {
      axes.col(k) /= length;
    }
    else if (flat < 0)
    {
      flat = k;
    }
    else
    {
      return std::nullopt;
    }
  }
  if (flat >= 0)
  {
    axes.col(flat) = axes.col((flat + 1) % 3).cross(axes.col((flat + 2) % 3));
  }
  const Eigen::Matrix3d apart = axes.transpose() * axes - Eigen::Matrix3d::Identity();
  return apart.cwiseAbs().maxCoeff() < rounding ? std::optional<Eigen::Matrix3d>(axes) : std::nullopt;
}

/// The rotation about y that is nearest to x, y, z axes given as columns.
double nearestYaw(const Eigen::Matrix3d& box) { return portable::atan2(box(0, 2) - box(2, 0), box(0, 0) + box(2, 2)); }
} // namespace

std::optional<UprightBox> uprightBox(const BoxRecord& box, const std::string& front)
{
  Eigen::Matrix3d edges;
  for (int k = 0; k < 3; ++k)
  {
    edges.col(k) = (box.corners.row(1 << k) - box.corners.row(0)).transpose();
  }
  const std::optional<Eigen::Matrix3d> axes = axesOf(edges);
  if (!axes)
  {
    return std::nullopt;
  }
  const int ahead = front.back() - 'x';
  int down = (ahead + 1) % 3;
  int side = (ahead + 2) % 3;
  if (std::abs((*axes)(1, side)) > std::abs((*axes)(1, down)))
  {
    std::swap(down, side);
  }
  Eigen::Matrix3d turned;
  turned.col(0) = front[0] == '-' ? Eigen::Vector3d(-axes->col(ahead)) : Eigen::Vector3d(axes->col(ahead));
  turned.col(1) = (*axes)(1, down) < 0 ? Eigen::Vector3d(-axes->col(down)) : Eigen::Vector3d(axes->col(down));
  turned.col(2) = turned.col(0).cross(turned.col(1));
  UprightBox upright;
  upright.length = edges.col(ahead).norm();
  upright.height = edges.col(down).norm();
  upright.width = edges.col(side).norm();
  upright.yaw = nearestYaw(turned);
  upright.bottom = box.corners.colwise().mean().transpose() + Eigen::Vector3d(0, upright.height / 2, 0);
  const double cosine = portable::cos(upright.yaw);
  const double sine = portable::sin(upright.yaw);
  Eigen::Matrix3d yawed;
  yawed << cosine, 0, sine, 0, 1, 0, -sine, 0, cosine;
  upright.tilt = 2 * portable::asin(std::min(1.0, (yawed - turned).norm() / std::sqrt(8.0)));
  return upright;
}

} // namespace dgtk
