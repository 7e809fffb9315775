// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRayTable.h"

#include "dgtkPortableMath.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

namespace dgtk
{

namespace
{
constexpr int blockSide = 4;           // cells
constexpr double widestCone = 1.4;     // radians; cones near a half space bound nothing
constexpr double coneSlack = 1e-9;     // radians
constexpr double placeSlack = 1e-9;    // cells: neighbours leave no gap
constexpr double settledTable = 1e-14; // cells
constexpr double nearlySettled = 1e-6; // cells: steps that do not shrink from there on are roundings
constexpr double farthestPlace = 8.0;  // cells: from there Newton's method does not come back
constexpr int mostTableSteps = 20;

double angleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return portable::atan2(std::sqrt(a.cross(b).squaredNorm()), a.dot(b));
}
} // namespace

RayTable::RayTable(int rows, int columns, std::vector<CameraRay> rays, std::vector<double> times)
  : Rows(rows)
  , Columns(columns)
  , Rays(std::move(rays))
  , Times(std::move(times))
{
  if (!this->Times.empty())
  {
    const auto ends = std::minmax_element(this->Times.begin(), this->Times.end());
    this->Span = { *ends.first, *ends.second };
  }
  const auto blocks = [](int cells) { return (cells + blockSide - 1) / blockSide; };
  Level level{ blocks(columns - 1), blocks(rows - 1), {} };
  for (int row = 0; row < level.rows; ++row)
  {
    for (int column = 0; column < level.columns; ++column)
    {
      level.blocks.push_back(this->boundsOfBlock(column, row));
    }
  }
  this->Levels.push_back(std::move(level));
  while (this->Levels.back().blocks.size() > 1)
  {
    this->addLevel();
  }
}

void RayTable::addLevel()
{
  const Level& below = this->Levels.back();
  Level level{ (below.columns + 1) / 2, (below.rows + 1) / 2, {} };
  for (int row = 0; row < level.rows; ++row)
  {
    for (int column = 0; column < level.columns; ++column)
    {
      std::vector<Bounds> parts;
      for (int y = 2 * row; y < std::min(2 * row + 2, below.rows); ++y)
      {
        for (int x = 2 * column; x < std::min(2 * column + 2, below.columns); ++x)
        {
          parts.push_back(below.blocks[std::size_t(y) * below.columns + x]);
        }
      }
      level.blocks.push_back(Bounds::of(parts));
    }
  }
  this->Levels.push_back(std::move(level));
}

bool RayTable::isWhole(int column, int row) const
{
  return this->at(column, row).exists() && this->at(column + 1, row).exists() && this->at(column, row + 1).exists() &&
         this->at(column + 1, row + 1).exists();
}

/// Those at the border reach half a pixel beyond their rays.
RayTable::Cell RayTable::cell(int column, int row) const
{
  return { { this->at(column, row), this->at(column + 1, row), this->at(column, row + 1),
             this->at(column + 1, row + 1) },
    { column == 0 ? -0.5 : 0.0, row == 0 ? -0.5 : 0.0 },
    { column == this->Columns - 2 ? 1.5 : 1.0, row == this->Rows - 2 ? 1.5 : 1.0 } };
}

CameraRay RayTable::Cell::at(double a, double b) const
{
  const double weights[4] = { (1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b };
  CameraRay ray{ Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero() };
  for (int i = 0; i < 4; ++i)
  {
    ray.origin += weights[i] * this->corners[i].origin;
    ray.direction += weights[i] * this->corners[i].direction;
  }
  return ray;
}

CameraRay RayTable::ray(const Eigen::Vector2d& point) const
{
  const Eigen::Vector2d at = point.array() - 0.5;
  if (at.x() >= -0.5 && at.y() >= -0.5 && at.x() <= this->Columns - 0.5 && at.y() <= this->Rows - 0.5)
  {
    const int column = std::clamp(static_cast<int>(std::floor(at.x())), 0, this->Columns - 2);
    const int row = std::clamp(static_cast<int>(std::floor(at.y())), 0, this->Rows - 2);
    // a point between two cells is of the one that is whole
    for (int y = row; y >= (at.y() == row ? std::max(row - 1, 0) : row); --y)
    {
      for (int x = column; x >= (at.x() == column ? std::max(column - 1, 0) : column); --x)
      {
        if (this->isWhole(x, y))
        {
          CameraRay ray = this->cell(x, y).at(at.x() - x, at.y() - y);
          ray.direction /= std::sqrt(ray.direction.squaredNorm());
          return ray;
        }
      }
    }
  }
  return { Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero() };
}

double RayTable::time(const Eigen::Vector2d& point) const
{
  if (this->Times.empty())
  {
    return 0;
  }
  const Eigen::Vector2d last(this->Columns - 1, this->Rows - 1);
  const Eigen::Vector2d at = Eigen::Vector2d(point.array() - 0.5).cwiseMax(0.0).cwiseMin(last);
  const int column = std::clamp(static_cast<int>(std::floor(at.x())), 0, this->Columns - 2);
  const int row = std::clamp(static_cast<int>(std::floor(at.y())), 0, this->Rows - 2);
  const double* const first = this->Times.data() + std::size_t(row) * this->Columns + column;
  // Equal times give the same one, whatever the weights round to.
  const auto between = [](double from, double to, double part) { return from + part * (to - from); };
  const double above = between(first[0], first[1], at.x() - column);
  const double below = between(first[this->Columns], first[this->Columns + 1], at.x() - column);
  return between(above, below, at.y() - row);
}

/// Where the way to the point is along the ray: Newton's method on what it is across.
bool RayTable::Cell::find(const Eigen::Vector3d& x, Eigen::Vector2d& place) const
{
  const auto& c = this->corners;
  const Eigen::Vector3d axis = this->at(0.5, 0.5).direction;
  const Eigen::Vector3d e1 = axis.unitOrthogonal();
  const Eigen::Vector3d e2 = axis.cross(e1);
  Eigen::Vector2d found(0.5, 0.5);
  double last = std::numeric_limits<double>::infinity();
  for (int steps = 0; steps < mostTableSteps; ++steps)
  {
    const double a = found.x();
    const double b = found.y();
    const CameraRay ray = this->at(a, b);
    const Eigen::Vector3d way = x - ray.origin;
    const auto slope = [&](const Eigen::Vector3d& origin, const Eigen::Vector3d& direction)
    {
      const Eigen::Vector3d turned = way.cross(direction) - origin.cross(ray.direction);
      return Eigen::Vector2d(e1.dot(turned), e2.dot(turned));
    };
    const auto along = [](double t, const Eigen::Vector3d& p0, const Eigen::Vector3d& p1, const Eigen::Vector3d& q0,
                         const Eigen::Vector3d& q1) { return Eigen::Vector3d((1 - t) * (p1 - p0) + t * (q1 - q0)); };
    const Eigen::Vector2d byA = slope(along(b, c[0].origin, c[1].origin, c[2].origin, c[3].origin),
      along(b, c[0].direction, c[1].direction, c[2].direction, c[3].direction));
    const Eigen::Vector2d byB = slope(along(a, c[0].origin, c[2].origin, c[1].origin, c[3].origin),
      along(a, c[0].direction, c[2].direction, c[1].direction, c[3].direction));
    const Eigen::Vector3d across = way.cross(ray.direction);
    const Eigen::Vector2d left(e1.dot(across), e2.dot(across));
    const double determinant = byA.x() * byB.y() - byA.y() * byB.x();
    const Eigen::Vector2d step(
      (left.x() * byB.y() - left.y() * byB.x()) / determinant, (byA.x() * left.y() - byA.y() * left.x()) / determinant);
    found -= step;
    if (!(found.cwiseAbs().maxCoeff() < farthestPlace))
    {
      return false;
    }
    const double size = step.cwiseAbs().maxCoeff();
    const bool isRounding = size <= nearlySettled && size >= last / 2;
    last = size;
    if (size <= settledTable || isRounding)
    {
      place = found.cwiseMax(this->least).cwiseMin(this->most);
      return (place - found).cwiseAbs().maxCoeff() <= placeSlack && way.dot(ray.direction) > 0;
    }
  }
  return false;
}

RayTable::Bounds RayTable::boundsOfBlock(int column, int row) const
{
  std::vector<Bounds> rays;
  for (int y = blockSide * row; y < std::min(blockSide * (row + 1), this->Rows - 1); ++y)
  {
    for (int x = blockSide * column; x < std::min(blockSide * (column + 1), this->Columns - 1); ++x)
    {
      if (!this->isWhole(x, y))
      {
        continue;
      }
      const Cell cell = this->cell(x, y);
      for (const double a : { cell.least.x(), cell.most.x() })
      {
        for (const double b : { cell.least.y(), cell.most.y() })
        {
          const CameraRay ray = cell.at(a, b);
          rays.push_back({ ray.direction.normalized(), 0, ray.origin, 0 });
        }
      }
    }
  }
  return Bounds::of(rays);
}

RayTable::Bounds RayTable::Bounds::of(const std::vector<Bounds>& parts)
{
  Bounds all;
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
  int count = 0;
  for (const Bounds& part : parts)
  {
    axis += part.angle >= 0 ? part.axis : Eigen::Vector3d(0, 0, 0);
    all.centre += part.angle >= 0 ? part.centre : Eigen::Vector3d(0, 0, 0);
    count += part.angle >= 0 ? 1 : 0;
  }
  if (count == 0)
  {
    return all;
  }
  all.centre /= count;
  all.axis = axis.isZero(0) ? Eigen::Vector3d(0, 0, 1) : Eigen::Vector3d(axis / std::sqrt(axis.squaredNorm()));
  for (const Bounds& part : parts)
  {
    if (part.angle >= 0)
    {
      all.angle = std::max(all.angle, angleBetween(all.axis, part.axis) + part.angle);
      all.radius = std::max(all.radius, std::sqrt((part.centre - all.centre).squaredNorm()) + part.radius);
    }
  }
  all.angle = all.angle > widestCone ? pi : all.angle;
  return all;
}

bool RayTable::Bounds::mayHold(const Eigen::Vector3d& x) const
{
  if (this->angle < 0)
  {
    return false;
  }
  const Eigen::Vector3d way = x - this->centre;
  const double square = way.squaredNorm();
  const double reach = this->radius * this->radius;
  if (this->angle >= pi || square <= reach)
  {
    return true;
  }
  const double turn = portable::atan2(this->radius, std::sqrt(square - reach)); // seen from anywhere in the ball
  return angleBetween(this->axis, way) <= this->angle + turn + coneSlack;
}

bool RayTable::findInBlock(int column, int row, const Eigen::Vector3d& x, Eigen::Vector2d& point) const
{
  for (int y = blockSide * row; y < std::min(blockSide * (row + 1), this->Rows - 1); ++y)
  {
    for (int i = blockSide * column; i < std::min(blockSide * (column + 1), this->Columns - 1); ++i)
    {
      Eigen::Vector2d place;
      if (this->isWhole(i, y) && this->cell(i, y).find(x, place))
      {
        point = { i + place.x() + 0.5, y + place.y() + 0.5 };
        return true;
      }
    }
  }
  return false;
}

bool RayTable::findIn(std::size_t level, int column, int row, const Eigen::Vector3d& x, Eigen::Vector2d& point) const
{
  const Level& own = this->Levels[level];
  if (!own.blocks[std::size_t(row) * own.columns + column].mayHold(x))
  {
    return false;
  }
  if (level == 0)
  {
    return this->findInBlock(column, row, x, point);
  }
  const Level& below = this->Levels[level - 1];
  for (int y = 2 * row; y < std::min(2 * row + 2, below.rows); ++y)
  {
    for (int i = 2 * column; i < std::min(2 * column + 2, below.columns); ++i)
    {
      if (this->findIn(level - 1, i, y, x, point))
      {
        return true;
      }
    }
  }
  return false;
}

bool RayTable::find(const Eigen::Vector3d& x, Eigen::Vector2d& point) const
{
  return x.allFinite() && this->findIn(this->Levels.size() - 1, 0, 0, x, point);
}

} // namespace dgtk
