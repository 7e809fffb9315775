// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkViewCamera.h"

#include "dgtkPortableMath.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr double viewAngle = 30;           // degrees
constexpr double margin = 1.08;            // of a framed box
constexpr double steepest = 89 * pi / 180; // of the perspective's eye above the ground
constexpr double emptyExtent = 10;         // world units shown of an empty scene
constexpr double nearestFocus = 1e-6;
constexpr double steepSine = 1e-6; // of the angle to the up axis below which a view has no horizon
constexpr double nearPart = 1e-2;  // of the focus's distance: where segments are cut

bool along(const Eigen::Vector3d& way, const Eigen::Vector3d& axis)
{
  return way.cross(axis).norm() <= steepSine * way.norm();
}

double tanHalfAngle() { return std::tan(viewAngle / 2 * pi / 180); }
} // namespace

ViewCamera::ViewCamera(ViewKind kind, UpAxis upAxis)
  : Kind(kind)
{
  const bool zUp = upAxis == UpAxis::Z;
  const Eigen::Vector3d up = zUp ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d::UnitY();
  const Eigen::Vector3d towardsFront = zUp ? Eigen::Vector3d(-Eigen::Vector3d::UnitY()) : Eigen::Vector3d::UnitZ();
  this->Up = up;
  switch (kind)
  {
    case ViewKind::Front:
      this->Eye = 10 * towardsFront;
      break;
    case ViewKind::Top:
      this->Eye = 10 * up;
      this->Up = -towardsFront;
      break;
    case ViewKind::Side:
      this->Eye = 10 * Eigen::Vector3d::UnitX();
      break;
    case ViewKind::Perspective:
      this->Eye = 10 * (towardsFront + 0.6 * up + 0.5 * Eigen::Vector3d::UnitX()).normalized();
      break;
  }
}

double ViewCamera::angle() { return viewAngle; }

double ViewCamera::height() const { return 2 * (this->Focus - this->Eye).norm() * tanHalfAngle(); }

Eigen::Vector3d ViewCamera::forward() const { return (this->Focus - this->Eye).normalized(); }
bool ViewCamera::steep() const { return along(this->Focus - this->Eye, this->Up); }
Eigen::Vector3d ViewCamera::up() const { return this->steep() ? this->SteepUp : this->Up; }
Eigen::Vector3d ViewCamera::right() const { return this->forward().cross(this->up()).normalized(); }
Eigen::Vector3d ViewCamera::upward() const { return this->right().cross(this->forward()); }

void ViewCamera::frame(const WorldBox& box, double aspect)
{
  const Eigen::Vector3d direction = this->forward();
  const Eigen::Vector3d across = this->right();
  const Eigen::Vector3d upwards = this->upward();
  this->Focus = box.empty() ? Eigen::Vector3d(0, 0, 0) : box.center();
  double extent = box.empty() ? emptyExtent : std::max(box.diagonal(), 1e-3);
  if (this->parallel() && !box.empty())
  {
    const Eigen::Vector3d size = box.max - box.min;
    extent = std::max({ std::abs(size.dot(upwards)), std::abs(size.dot(across)) / aspect, 1e-3 });
  }
  else
  {
    extent /= std::min(1.0, aspect) * std::cos(viewAngle / 2 * pi / 180); // the sphere touches the frustum
  }
  this->Eye = this->Focus - direction * (margin * extent / (2 * tanHalfAngle()));
}

bool ViewCamera::look(const Eigen::Vector3d& eye, const Eigen::Vector3d& focus, const Eigen::Vector3d& up)
{
  const Eigen::Vector3d way = focus - eye;
  if (this->parallel() || !(way.norm() > nearestFocus))
  {
    return false;
  }
  if (along(way, this->Up))
  {
    const Eigen::Vector3d tilted = this->right().cross(way);
    this->SteepUp = (along(up, this->Up) ? tilted : Eigen::Vector3d(up - up.dot(this->Up) * this->Up)).normalized();
  }
  this->Eye = eye;
  this->Focus = focus;
  return true;
}

void ViewCamera::orbit(double right, double down)
{
  if (this->parallel())
  {
    return;
  }
  const Eigen::Vector3d axis = this->right();
  Eigen::Vector3d arm = this->Eye - this->Focus;
  const double elevation = std::asin(arm.normalized().dot(this->Up));
  const double tilt = std::clamp(elevation + down * pi / 180, -steepest, steepest) - elevation;
  arm = Eigen::AngleAxisd(-tilt, axis) * arm;
  arm = Eigen::AngleAxisd(-right * pi / 180, this->Up) * arm;
  this->Eye = this->Focus + arm;
}

void ViewCamera::pan(double dx, double dy, double viewHeight)
{
  const double unit = this->height() / viewHeight;
  const Eigen::Vector3d step = unit * (dy * this->upward() - dx * this->right());
  this->Eye += step;
  this->Focus += step;
}

void ViewCamera::zoom(double factor)
{
  const Eigen::Vector3d arm = (this->Eye - this->Focus) / factor;
  if (arm.norm() > nearestFocus)
  {
    this->Eye = this->Focus + arm;
  }
}

WorldRay ViewCamera::ray(double x, double y, double width, double height) const
{
  const double unit = this->height() / height;
  const Eigen::Vector3d inPlane =
    this->Focus + unit * ((x - width / 2) * this->right() + (height / 2 - y) * this->upward());
  if (this->parallel())
  {
    // From far behind the eye: nothing is too near for a parallel view.
    return { inPlane, this->forward(), -1e15 };
  }
  return { this->Eye, (inPlane - this->Eye) / (this->Focus - this->Eye).norm(), 0 };
}

PickReach ViewCamera::reach(double pixels, double height) const
{
  if (this->parallel())
  {
    return { pixels * this->height() / height, 0 };
  }
  return { 0, pixels * 2 * tanHalfAngle() / height };
}

Eigen::Vector3d ViewCamera::towardsEye(const Eigen::Vector3d& point) const
{
  return this->parallel() ? Eigen::Vector3d(-this->forward()) : Eigen::Vector3d((this->Eye - point).normalized());
}

double ViewCamera::unit(const Eigen::Vector3d& point, double height) const
{
  const double depth = this->parallel() ? (this->Focus - this->Eye).norm() : (point - this->Eye).dot(this->forward());
  return 2 * depth * tanHalfAngle() / height;
}

std::optional<Eigen::Vector2d> ViewCamera::pixel(const Eigen::Vector3d& point, double width, double height) const
{
  const double unit = this->unit(point, height);
  if (unit <= 0)
  {
    return std::nullopt;
  }
  const Eigen::Vector3d way = (point - this->Eye) / unit;
  return Eigen::Vector2d(width / 2 + way.dot(this->right()), height / 2 - way.dot(this->upward()));
}

std::optional<std::pair<Eigen::Vector2d, Eigen::Vector2d>> ViewCamera::segment(
  const Eigen::Vector3d& from, const Eigen::Vector3d& to, double width, double height) const
{
  // Ends that are behind the eye, or nearly beside it, are moved to a plane before it.
  const double nearest = nearPart * (this->Focus - this->Eye).norm();
  const double a = (from - this->Eye).dot(this->forward());
  const double b = (to - this->Eye).dot(this->forward());
  if (this->parallel() || (a >= nearest && b >= nearest))
  {
    return std::pair(*this->pixel(from, width, height), *this->pixel(to, width, height));
  }
  if (a < nearest && b < nearest)
  {
    return std::nullopt;
  }
  const Eigen::Vector3d cut = from + (to - from) * ((nearest - a) / (b - a));
  return std::pair(
    *this->pixel(a < nearest ? cut : from, width, height), *this->pixel(b < nearest ? cut : to, width, height));
}

Eigen::Vector3d ViewCamera::motion(const Eigen::Vector3d& point, double dx, double dy, double height) const
{
  return this->unit(point, height) * (dx * this->right() - dy * this->upward());
}

} // namespace dgtk
