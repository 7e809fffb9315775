// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkViewHandles.h"

#include "dgtkPortableMath.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dgtk
{

namespace
{
constexpr double lengthPixels = 80;
constexpr double hitPixels = 7;
constexpr double patchPixels = 6;   // half the side of the box in the middle
constexpr double boxPixels = 5;     // at the end of an axis that scales
constexpr double tipLength = 13;    // of an arrow, pixels
constexpr double tipWidth = 5;      // half of it
constexpr double shortest = 0.2;    // share of its length at which an axis can still be pulled
constexpr double squareFrom = 0.28; // of the length
constexpr double squareTo = 0.48;
constexpr double flattestPlane = 0.2; // cosine at which a plane is still seen openly
constexpr double facing = 0.99;       // cosine from which a ring is seen whole
constexpr double outerRing = 1.22;
constexpr int ringSteps = 48; // of half a ring

double distanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  const Eigen::Vector2d way = b - a;
  const double squared = way.squaredNorm();
  const double t = squared > 0 ? std::clamp((p - a).dot(way) / squared, 0.0, 1.0) : 0.0;
  return (a + t * way - p).norm();
}

/// By the crossings of a ray to the right.
bool isInside(const Eigen::Vector2d& p, const std::vector<Eigen::Vector2d>& points)
{
  bool inside = false;
  for (std::size_t i = 0, j = points.size() - 1; i < points.size(); j = i++)
  {
    const Eigen::Vector2d& a = points[i];
    const Eigen::Vector2d& b = points[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()))
    {
      inside = !inside;
    }
  }
  return inside;
}

double distanceTo(const HandleShape& shape, const Eigen::Vector2d& p)
{
  if (shape.filled && isInside(p, shape.points))
  {
    return 0;
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = shape.closed ? 0 : 1; i < shape.points.size(); ++i)
  {
    const Eigen::Vector2d& before = shape.points[i == 0 ? shape.points.size() - 1 : i - 1];
    least = std::min(least, distanceToSegment(p, before, shape.points[i]));
  }
  return least;
}
} // namespace

double ViewHandles::length() { return lengthPixels; }

ViewHandles::ViewHandles(const HandlePlace& place, const ViewCamera& camera, double width, double height)
  : Place(place)
  , Camera(camera)
  , Width(width)
  , Height(height)
{
  const std::optional<Eigen::Vector2d> center = camera.pixel(place.pivot, width, height);
  if (!center || place.mode == HandleMode::None)
  {
    return;
  }
  this->Center = *center;
  this->Size = lengthPixels * camera.unit(place.pivot, height);
  this->ToEye = place.axes.transpose() * camera.towardsEye(place.pivot);
  switch (place.mode)
  {
    case HandleMode::Move:
      this->addMove();
      break;
    case HandleMode::Rotate:
      this->addRotate();
      break;
    default:
      this->addScale();
      break;
  }
}

Eigen::Vector2d ViewHandles::at(const Eigen::Vector3d& offset) const
{
  const Eigen::Vector3d point = this->Place.pivot + this->Place.axes * offset * this->Size;
  return this->Camera.pixel(point, this->Width, this->Height).value_or(this->Center);
}

bool ViewHandles::isLong(int axis) const
{
  return (this->at(Eigen::Vector3d::Unit(axis)) - this->Center).norm() > shortest * lengthPixels;
}

void ViewHandles::addPatch(const Handle& handle, const Eigen::Vector2d& center, double reach)
{
  HandleShape patch{ handle, {}, true, true };
  for (const auto& [x, y] : { std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1) })
  {
    patch.points.push_back(center + reach * Eigen::Vector2d(x, y));
  }
  this->Shapes.push_back(std::move(patch));
}

void ViewHandles::addSquare(int normal)
{
  if (std::abs(this->ToEye[normal]) < flattestPlane)
  {
    return;
  }
  HandleShape square{ { Handle::Kind::Plane, normal }, {}, true, true };
  const Eigen::Vector3d u = Eigen::Vector3d::Unit((normal + 1) % 3);
  const Eigen::Vector3d v = Eigen::Vector3d::Unit((normal + 2) % 3);
  for (const auto& [a, b] : { std::pair(squareFrom, squareFrom), std::pair(squareTo, squareFrom),
         std::pair(squareTo, squareTo), std::pair(squareFrom, squareTo) })
  {
    square.points.push_back(this->at(a * u + b * v));
  }
  this->Shapes.push_back(std::move(square));
}

void ViewHandles::addMove()
{
  for (int axis = 0; axis < 3; ++axis)
  {
    this->addSquare(axis);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    if (!this->isLong(axis))
    {
      continue;
    }
    const Handle handle{ Handle::Kind::Axis, axis };
    const Eigen::Vector2d end = this->at(Eigen::Vector3d::Unit(axis));
    const Eigen::Vector2d way = (end - this->Center).normalized();
    const Eigen::Vector2d across(-way.y(), way.x());
    const Eigen::Vector2d base = end - tipLength * way;
    this->Shapes.push_back({ handle, { this->Center + 2 * patchPixels * way, base }, false, false });
    this->Shapes.push_back({ handle, { base + tipWidth * across, end, base - tipWidth * across }, true, true });
  }
  this->addPatch({}, this->Center, patchPixels);
}

void ViewHandles::addRing(int axis)
{
  const Eigen::Vector3d normal = Eigen::Vector3d::Unit(axis);
  const bool whole = std::abs(this->ToEye[axis]) > facing;
  const Eigen::Vector3d towards = whole ? Eigen::Vector3d(Eigen::Vector3d::Unit((axis + 1) % 3))
                                        : Eigen::Vector3d(this->ToEye - this->ToEye[axis] * normal).normalized();
  const Eigen::Vector3d across = normal.cross(towards);
  const int steps = whole ? 2 * ringSteps : ringSteps;
  HandleShape ring{ { Handle::Kind::Axis, axis }, {}, whole, false };
  for (int i = 0; i < steps + (whole ? 0 : 1); ++i)
  {
    const double angle = (double(i) / ringSteps - 0.5) * pi; // the half that is turned to the eye
    ring.points.push_back(this->at(std::cos(angle) * towards + std::sin(angle) * across));
  }
  this->Shapes.push_back(std::move(ring));
}

void ViewHandles::addRotate()
{
  HandleShape outer{ {}, {}, true, false };
  for (int i = 0; i < 2 * ringSteps; ++i)
  {
    const double angle = i * pi / ringSteps;
    outer.points.push_back(this->Center + outerRing * lengthPixels * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
  }
  this->Shapes.push_back(std::move(outer));
  for (int axis = 0; axis < 3; ++axis)
  {
    this->addRing(axis);
  }
}

void ViewHandles::addScale()
{
  for (int axis = 0; axis < 3; ++axis)
  {
    if (this->isLong(axis))
    {
      const Handle handle{ Handle::Kind::Axis, axis };
      const Eigen::Vector2d end = this->at(Eigen::Vector3d::Unit(axis));
      const Eigen::Vector2d way = (end - this->Center).normalized();
      this->Shapes.push_back({ handle, { this->Center + 2 * patchPixels * way, end }, false, false });
      this->addPatch(handle, end, boxPixels);
    }
  }
  this->addPatch({}, this->Center, patchPixels);
}

std::optional<Handle> ViewHandles::hit(const Eigen::Vector2d& pixel) const
{
  std::optional<Handle> best;
  double least = hitPixels;
  for (const HandleShape& shape : this->Shapes)
  {
    // Later ones lie above earlier ones.
    const double distance = distanceTo(shape, pixel);
    if (distance <= least)
    {
      least = distance;
      best = shape.handle;
    }
  }
  return best;
}

} // namespace dgtk
