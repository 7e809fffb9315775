// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelBuilder.h"
#include "dgtkPortableMath.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
using Points2 = std::vector<Eigen::Vector2d>;

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// Drops the coordinate along which the polygon is thinnest, keeping its direction: counter-clockwise seen from
/// `normal`.
Points2 flatten(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& normal)
{
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  const int x = (axis + 1) % 3;
  const int y = (axis + 2) % 3;
  const double sign = normal[axis] < 0 ? -1 : 1;
  Points2 flat;
  flat.reserve(points.size());
  for (const Eigen::Vector3d& p : points)
  {
    flat.emplace_back(p[x] * sign, p[y]);
  }
  return flat;
}

/// Every corner turns left, and the boundary goes round once. Corners that stand there twice count once.
bool isConvex(Points2 p)
{
  p.erase(std::unique(p.begin(), p.end()), p.end());
  if (p.front() == p.back())
  {
    p.pop_back();
  }
  double around = 0;
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i)
  {
    const Eigen::Vector2d in = p[(i + 1) % n] - p[i];
    const Eigen::Vector2d out = p[(i + 2) % n] - p[(i + 1) % n];
    const double cross = in.x() * out.y() - in.y() * out.x();
    if (cross < 0 || (cross == 0 && in.dot(out) < 0))
    {
      return false;
    }
    around += portable::atan2(cross, in.dot(out));
  }
  return around < 9.0; // 2 pi for one round, 4 pi for two
}

class EarClipper
{
public:
  EarClipper(const Points2& points, std::vector<std::array<std::uint32_t, 3>>& triangles, std::uint64_t& work,
    std::uint64_t workLimit)
    : P(points)
    , Triangles(triangles)
    , Work(work)
    , WorkLimit(workLimit)
    , Ring(points.size())
  {
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      this->Ring[i] = static_cast<std::uint32_t>(i);
    }
  }

  /// Cuts ears until a triangle is left. Of the ears in reach the first one with a positive area is taken; when there
  /// is none, a flat one, then any. False when the limit of work was reached and the rest became a fan.
  bool run()
  {
    std::size_t at = 0;
    while (this->Ring.size() > 3)
    {
      if (this->Work > this->WorkLimit)
      {
        for (std::size_t i = 2; i < this->Ring.size(); ++i)
        {
          this->Triangles.push_back({ this->Ring[0], this->Ring[i - 1], this->Ring[i] });
        }
        return false;
      }
      const std::size_t n = this->Ring.size();
      std::size_t found = n;
      std::size_t flat = n;
      for (std::size_t step = 0; step < n && found == n; ++step)
      {
        const std::size_t i = (at + step) % n;
        const double area = this->areaAt(i);
        if (area > 0 && this->isEmpty(i))
        {
          found = i;
        }
        else if (area == 0 && flat == n)
        {
          flat = i;
        }
        ++this->Work;
      }
      const std::size_t ear = found < n ? found : flat < n ? flat : at;
      this->cut(ear);
      at = ear % this->Ring.size();
    }
    this->Triangles.push_back({ this->Ring[0], this->Ring[1], this->Ring[2] });
    return true;
  }

private:
  std::uint32_t before(std::size_t i) const { return this->Ring[(i + this->Ring.size() - 1) % this->Ring.size()]; }
  std::uint32_t after(std::size_t i) const { return this->Ring[(i + 1) % this->Ring.size()]; }
  double areaAt(std::size_t i) const
  {
    return turn(this->P[this->before(i)], this->P[this->Ring[i]], this->P[this->after(i)]);
  }

  /// No other corner lies in the triangle at corner i. Corners that coincide with the triangle's own do not count:
  /// polygons with holes visit a corner twice.
  bool isEmpty(std::size_t i)
  {
    const Eigen::Vector2d& a = this->P[this->before(i)];
    const Eigen::Vector2d& b = this->P[this->Ring[i]];
    const Eigen::Vector2d& c = this->P[this->after(i)];
    this->Work += this->Ring.size();
    for (const std::uint32_t other : this->Ring)
    {
      const Eigen::Vector2d& p = this->P[other];
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0 && p != a && p != b && p != c)
      {
        return false;
      }
    }
    return true;
  }

  void cut(std::size_t i)
  {
    this->Triangles.push_back({ this->before(i), this->Ring[i], this->after(i) });
    this->Ring.erase(this->Ring.begin() + static_cast<std::ptrdiff_t>(i));
  }

  const Points2& P;
  std::vector<std::array<std::uint32_t, 3>>& Triangles;
  std::uint64_t& Work;
  std::uint64_t WorkLimit;
  std::vector<std::uint32_t> Ring;
};

void fan(std::size_t count, std::vector<std::array<std::uint32_t, 3>>& triangles)
{
  for (std::uint32_t i = 2; i < count; ++i)
  {
    triangles.push_back({ 0, i - 1, i });
  }
}
} // namespace

bool triangulate(const std::vector<Eigen::Vector3d>& points, std::vector<std::array<std::uint32_t, 3>>& triangles,
  std::uint64_t& work, std::uint64_t workLimit)
{
  triangles.clear();
  const Eigen::Vector3d normal = polygonNormal(points);
  work += points.size();
  if (points.size() == 3 || normal.isZero(0))
  {
    fan(points.size(), triangles);
    return true;
  }
  const Points2 flat = flatten(points, normal);
  if (isConvex(flat))
  {
    fan(points.size(), triangles);
    return true;
  }
  return EarClipper(flat, triangles, work, workLimit).run();
}

} // namespace dgtk
