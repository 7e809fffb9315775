// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPortableMath.h"
#include "dgtkViewHandles.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr double mostParallel = 0.998; // cosine between a ray and an axis that can still be pulled
constexpr double flattest = 0.2;       // cosine at which the plane of a ring is still seen openly
constexpr double leastFactor = 0.01;
constexpr double angleStep = 15; // degrees
constexpr double factorStep = 0.1;

/// The multiple of a step; exactly the decimal number where the step is a tenth, a half or such.
double snapped(double value, double step)
{
  const double inverse = std::round(1 / step);
  return step < 1 && std::abs(inverse * step - 1) < 1e-9 ? std::round(value * inverse) / inverse + 0.0
                                                         : std::round(value / step) * step + 0.0;
}
} // namespace

HandleDrag::HandleDrag(const HandlePlace& place, const Handle& handle, const Eigen::Vector3d& grasped,
  const ViewCamera& camera, double width, double height, const Eigen::Vector2d& start)
  : Place(place)
  , Grasped(handle)
  , Anchor(grasped)
  , Camera(camera)
  , Width(width)
  , Height(height)
  , Start(start)
  , Size(ViewHandles::length() * camera.unit(place.pivot, height))
{
  this->constrain(handle);
}

void HandleDrag::constrain(const Handle& handle)
{
  this->Grip = handle;
  this->Raw = 0;
  this->Turned = 0;
  this->Last = {};
  this->Last.mode = this->Place.mode;
  this->Last.pivot = this->Place.pivot;
  this->Last.axes = this->Place.axes;
  this->Last.axis = this->axis();
}

WorldRay HandleDrag::ray(const Eigen::Vector2d& pixel) const
{
  return this->Camera.ray(pixel.x(), pixel.y(), this->Width, this->Height);
}

Eigen::Vector3d HandleDrag::axis() const
{
  return this->Grip.kind == Handle::Kind::Free ? Eigen::Vector3d(-this->Camera.forward())
                                               : Eigen::Vector3d(this->Place.axes.col(this->Grip.axis));
}

std::optional<double> HandleDrag::alongLine(
  const WorldRay& ray, const Eigen::Vector3d& point, const Eigen::Vector3d& along) const
{
  const Eigen::Vector3d d = ray.direction.normalized();
  const double cosine = d.dot(along);
  if (std::abs(cosine) > mostParallel)
  {
    return std::nullopt;
  }
  const Eigen::Vector3d w = ray.origin - point;
  return (w.dot(along) - w.dot(d) * cosine) / (1 - cosine * cosine);
}

std::optional<Eigen::Vector3d> HandleDrag::inPlane(
  const WorldRay& ray, const Eigen::Vector3d& point, const Eigen::Vector3d& normal) const
{
  const double slope = ray.direction.dot(normal);
  const double t = (point - ray.origin).dot(normal) / slope;
  if (std::abs(slope) < 1e-9 * ray.direction.norm() || t < ray.least)
  {
    return std::nullopt;
  }
  return ray.origin + t * ray.direction;
}

const WorldMotion& HandleDrag::motion(const Eigen::Vector2d& pixel, double step)
{
  switch (this->Place.mode)
  {
    case HandleMode::Rotate:
      this->rotate(pixel, step);
      break;
    case HandleMode::Scale:
      this->scale(pixel, step);
      break;
    default:
      this->move(pixel, step);
      break;
  }
  return this->Last;
}

void HandleDrag::move(const Eigen::Vector2d& pixel, double step)
{
  const Eigen::Vector2d way = pixel - this->Start;
  Eigen::Vector3d translation = this->Camera.motion(this->Anchor, way.x(), way.y(), this->Height);
  if (this->Grip.kind != Handle::Kind::Free)
  {
    // An arrow is grasped where it is; a thing at its own depth.
    const bool byHandle = this->Grip == this->Grasped;
    const WorldRay first = this->ray(this->Start);
    const WorldRay now = this->ray(pixel);
    const Eigen::Vector3d point = byHandle ? this->Place.pivot : this->Anchor;
    const Eigen::Vector3d axis = this->axis();
    if (this->Grip.kind == Handle::Kind::Axis)
    {
      const std::optional<double> from = this->alongLine(first, point, axis);
      const std::optional<double> to = this->alongLine(now, point, axis);
      translation = from && to ? Eigen::Vector3d((*to - *from) * axis) : this->Last.translation;
    }
    else
    {
      const std::optional<Eigen::Vector3d> from = this->inPlane(first, point, axis);
      const std::optional<Eigen::Vector3d> to = this->inPlane(now, point, axis);
      translation = from && to ? Eigen::Vector3d(*to - *from) : this->Last.translation;
      translation -= translation.dot(axis) * axis;
    }
  }
  for (int i = 0; i < 3 && step > 0; ++i)
  {
    translation[i] = snapped(translation[i], step);
  }
  this->Last.translation = translation;
}

std::optional<double> HandleDrag::rawAngle(const Eigen::Vector2d& pixel) const
{
  const Eigen::Vector3d axis = this->axis();
  const std::optional<Eigen::Vector3d> from = this->inPlane(this->ray(this->Start), this->Place.pivot, axis);
  const std::optional<Eigen::Vector3d> to = this->inPlane(this->ray(pixel), this->Place.pivot, axis);
  if (!from || !to)
  {
    return std::nullopt;
  }
  const Eigen::Vector3d a = *from - this->Place.pivot;
  const Eigen::Vector3d b = *to - this->Place.pivot;
  return std::atan2(axis.dot(a.cross(b)), a.dot(b));
}

void HandleDrag::rotate(const Eigen::Vector2d& pixel, double step)
{
  const Eigen::Vector3d axis = this->axis();
  const Eigen::Vector3d toEye = this->Camera.towardsEye(this->Place.pivot);
  if (std::abs(axis.dot(toEye)) < flattest)
  {
    // Seen from its edge, a ring is turned like a wheel: by the way along its rim.
    const Eigen::Vector2d way = pixel - this->Start;
    const Eigen::Vector3d motion = this->Camera.motion(this->Place.pivot, way.x(), way.y(), this->Height);
    this->Turned = motion.dot(axis.cross(toEye).normalized()) / this->Size;
  }
  else if (const std::optional<double> raw = this->rawAngle(pixel))
  {
    this->Turned += std::remainder(*raw - this->Raw, 2 * pi);
    this->Raw = *raw;
  }
  const double degrees = this->Turned * 180 / pi;
  this->Last.degrees = step > 0 ? snapped(degrees, angleStep) : degrees;
}

double HandleDrag::rawFactor(const Eigen::Vector2d& pixel) const
{
  const Eigen::Vector2d way = pixel - this->Start;
  if (this->Grip.kind != Handle::Kind::Axis)
  {
    // Up and to the right is larger.
    return 1 + (way.x() - way.y()) / std::sqrt(2.0) / ViewHandles::length();
  }
  const std::optional<double> from = this->alongLine(this->ray(this->Start), this->Place.pivot, this->axis());
  const std::optional<double> to = this->alongLine(this->ray(pixel), this->Place.pivot, this->axis());
  if (!from || !to)
  {
    return this->Last.factors[this->Grip.axis];
  }
  const bool byHandle = this->Grip == this->Grasped && *from > 0;
  return byHandle ? *to / *from : 1 + (*to - *from) / this->Size;
}

void HandleDrag::scale(const Eigen::Vector2d& pixel, double step)
{
  double factor = this->rawFactor(pixel);
  factor = step > 0 ? std::max(snapped(factor, factorStep), factorStep) : std::max(factor, leastFactor);
  this->Last.factors = Eigen::Vector3d(1, 1, 1);
  for (int i = 0; i < 3; ++i)
  {
    const bool its =
      this->Grip.kind == Handle::Kind::Free || (this->Grip.kind == Handle::Kind::Axis) == (i == this->Grip.axis);
    this->Last.factors[i] = its ? factor : 1.0;
  }
}

} // namespace dgtk
