// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMeshOverlap.h"
#include "dgtkPortableMath.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace dgtk
{

namespace
{

double sixVolumes(
  const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d)
{
  return (b - a).dot((c - a).cross(d - a));
}

/// Whether a segment goes through a triangle: its ends lie on both sides, and it has all edges on one hand.
bool pierces(const Eigen::Vector3d& p, const Eigen::Vector3d& q, const WorldTriangle& t)
{
  if (!(sixVolumes(p, t[0], t[1], t[2]) * sixVolumes(q, t[0], t[1], t[2]) < 0))
  {
    return false;
  }
  const double u = sixVolumes(p, q, t[0], t[1]);
  const double v = sixVolumes(p, q, t[1], t[2]);
  const double w = sixVolumes(p, q, t[2], t[0]);
  return (u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0);
}

bool cross(const WorldTriangle& a, const WorldTriangle& b)
{
  for (std::size_t i = 0; i < 3; ++i)
  {
    if (pierces(a[i], a[(i + 1) % 3], b) || pierces(b[i], b[(i + 1) % 3], a))
    {
      return true;
    }
  }
  return false;
}

Eigen::AlignedBox3d boxOf(const WorldTriangle& t)
{
  Eigen::AlignedBox3d box(t[0]);
  return box.extend(t[1]).extend(t[2]);
}

/// Calls visit(triangle of a, of b) for pairs whose boxes meet while `a` goes along `way`.
template <typename Visit>
void pairs(const WorldMesh& a, const WorldMesh& b, const Eigen::Vector3d& way, const Visit& visit)
{
  const auto swept = [&way](Eigen::AlignedBox3d box)
  {
    const Eigen::AlignedBox3d end(box.min() + way, box.max() + way);
    return box.extend(end);
  };
  const Eigen::AlignedBox3d whole = swept(a.box);
  std::vector<WorldTriangle> near;
  std::vector<Eigen::AlignedBox3d> boxes;
  for (const WorldTriangle& t : b.triangles)
  {
    const Eigen::AlignedBox3d box = boxOf(t);
    if (box.intersects(whole))
    {
      near.push_back(t);
      boxes.push_back(box);
    }
  }
  for (const WorldTriangle& t : a.triangles)
  {
    const Eigen::AlignedBox3d box = swept(boxOf(t));
    if (!box.intersects(b.box))
    {
      continue;
    }
    for (std::size_t i = 0; i < near.size(); ++i)
    {
      if (box.intersects(boxes[i]))
      {
        visit(t, near[i]);
      }
    }
  }
}

/// Rounding of what lies on a border, or touches already; parts of the way and of sides.
constexpr double touching = 1e-9;

/// The part of the way after which p + u (q - p) + part way = r + v (s - r), where u and v are within the sides, or,
/// of a triangle's sides from one corner, u + v is below 1 as well. 1 if there is none.
double partOfWay(const Eigen::Vector3d& u, const Eigen::Vector3d& v, const Eigen::Vector3d& way,
  const Eigen::Vector3d& apart, bool sum)
{
  Eigen::Matrix3d sides;
  sides << u, v, way;
  const double size = u.norm() * v.norm() * way.norm();
  if (!(std::abs(sides.determinant()) > 1e-12 * size))
  {
    return 1; // borders alone meet
  }
  const Eigen::Vector3d x = sides.inverse() * apart;
  const bool within = x[0] >= -touching && x[1] >= -touching && x[0] <= 1 + touching && x[1] <= 1 + touching &&
                      (!sum || x[0] + x[1] <= 1 + touching);
  return within && x[2] >= -touching ? std::clamp(x[2], 0.0, 1.0) : 1;
}

/// The part of the way after which one triangle touches the other: a corner a side, or sides each other.
double partOfWay(const WorldTriangle& a, const WorldTriangle& b, const Eigen::Vector3d& way)
{
  double part = 1;
  for (std::size_t i = 0; i < 3; ++i)
  {
    part = std::min(part, partOfWay(b[0] - b[1], b[0] - b[2], way, b[0] - a[i], true));
    part = std::min(part, partOfWay(a[1] - a[0], a[2] - a[0], way, b[i] - a[0], true));
    for (std::size_t k = 0; k < 3; ++k)
    {
      part = std::min(part, partOfWay(a[(i + 1) % 3] - a[i], b[k] - b[(k + 1) % 3], way, b[k] - a[i], false));
    }
  }
  return part;
}

/// How deep the origin lies in the convex hull of the differences of the corners: by how much the triangles must be
/// moved to come apart.
double depthOfPair(const WorldTriangle& a, const WorldTriangle& b)
{
  std::array<Eigen::Vector3d, 9> points;
  for (std::size_t i = 0; i < 9; ++i)
  {
    points[i] = a[i / 3] - b[i % 3];
  }
  double depth = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < 9; ++i)
  {
    for (std::size_t j = i + 1; j < 9; ++j)
    {
      for (std::size_t k = j + 1; k < 9; ++k)
      {
        const Eigen::Vector3d area = (points[j] - points[i]).cross(points[k] - points[i]);
        const double size = (points[j] - points[i]).norm() * (points[k] - points[i]).norm();
        if (area.norm() <= 1e-9 * size)
        {
          continue;
        }
        const Eigen::Vector3d normal = area.normalized();
        double least = std::numeric_limits<double>::max();
        double most = -least;
        for (const Eigen::Vector3d& p : points)
        {
          least = std::min(least, normal.dot(p - points[i]));
          most = std::max(most, normal.dot(p - points[i]));
        }
        const double slack = 1e-9 * std::sqrt(size);
        if (least >= -slack || most <= slack)
        {
          depth = std::min(depth, std::abs(normal.dot(points[i])));
        }
      }
    }
  }
  return depth == std::numeric_limits<double>::max() ? 0 : depth;
}

/// How often the mesh winds around a point, by the solid angles of its triangles (van Oosterom and Strackee 1983).
double winding(const Eigen::Vector3d& x, const WorldMesh& mesh)
{
  double sum = 0;
  for (const WorldTriangle& t : mesh.triangles)
  {
    const Eigen::Vector3d a = t[0] - x;
    const Eigen::Vector3d b = t[1] - x;
    const Eigen::Vector3d c = t[2] - x;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4 * pi);
}

double distanceToSegment(const Eigen::Vector3d& x, const Eigen::Vector3d& p, const Eigen::Vector3d& q)
{
  const double length = (q - p).squaredNorm();
  const double t = length > 0 ? std::clamp((x - p).dot(q - p) / length, 0.0, 1.0) : 0;
  return (x - p - t * (q - p)).norm();
}

double distanceTo(const Eigen::Vector3d& x, const WorldTriangle& t)
{
  const Eigen::Vector3d area = (t[1] - t[0]).cross(t[2] - t[0]);
  double least =
    std::min({ distanceToSegment(x, t[0], t[1]), distanceToSegment(x, t[1], t[2]), distanceToSegment(x, t[2], t[0]) });
  bool within = area.squaredNorm() > 0;
  for (std::size_t i = 0; i < 3; ++i)
  {
    within = within && area.dot((t[(i + 1) % 3] - t[i]).cross(x - t[i])) >= 0;
  }
  return within ? std::min(least, std::abs(area.normalized().dot(x - t[0]))) : least;
}

using Point = std::array<double, 3>;
Point keyOf(const Eigen::Vector3d& x) { return { x.x(), x.y(), x.z() }; }

/// The triangles of those connected parts of a mesh that have no border: only they have an inside. Corners are one
/// where they are at the same place.
WorldMesh closedParts(const WorldMesh& mesh)
{
  std::vector<std::size_t> part(mesh.triangles.size());
  std::iota(part.begin(), part.end(), std::size_t(0));
  const auto root = [&](std::size_t i)
  {
    while (part[i] != i)
    {
      i = part[i] = part[part[i]];
    }
    return i;
  };
  std::map<std::pair<Point, Point>, std::vector<std::size_t>> edges;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const Point p = keyOf(mesh.triangles[i][k]);
      const Point q = keyOf(mesh.triangles[i][(k + 1) % 3]);
      edges[p < q ? std::pair(p, q) : std::pair(q, p)].push_back(i);
    }
  }
  std::vector<bool> open(mesh.triangles.size());
  for (const auto& [edge, owners] : edges)
  {
    for (const std::size_t owner : owners)
    {
      part[root(owner)] = root(owners.front());
    }
  }
  for (const auto& [edge, owners] : edges)
  {
    open[root(owners.front())] = open[root(owners.front())] || owners.size() % 2 != 0;
  }
  WorldMesh closed;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
  {
    if (!open[root(i)])
    {
      closed.add(mesh.triangles[i]);
    }
  }
  return closed;
}

/// How far a point within a closed mesh is from its surface; 0 outside.
double depthOf(const Eigen::Vector3d& x, const WorldMesh& mesh)
{
  if (!mesh.box.contains(x) || std::abs(winding(x, mesh)) < 0.5)
  {
    return 0;
  }
  double depth = std::numeric_limits<double>::max();
  for (const WorldTriangle& t : mesh.triangles)
  {
    depth = std::min(depth, distanceTo(x, t));
  }
  return depth;
}

double deepestWithin(const WorldMesh& a, const WorldMesh& closed)
{
  double deepest = 0;
  for (const WorldTriangle& t : a.triangles)
  {
    for (const Eigen::Vector3d& x : t)
    {
      deepest = std::max(deepest, depthOf(x, closed));
    }
  }
  return deepest;
}

/// Of closed meshes with sides in one plane, which go through none of the other and have no corner within: the diameter
/// of a ball in both, on the way in from the middles of sides.
double diameterOfBall(const WorldMesh& a, const WorldMesh& b)
{
  double largest = 0;
  for (const WorldTriangle& t : a.triangles)
  {
    const Eigen::Vector3d area = (t[1] - t[0]).cross(t[2] - t[0]);
    for (const double side : { -1, 1 })
    {
      double radius = area.squaredNorm() > 0 ? 1 : 0;
      for (double way = 1e-6 * a.box.sizes().maxCoeff(); radius > 0; way *= 2)
      {
        const Eigen::Vector3d x = (t[0] + t[1] + t[2]) / 3 + side * way * area.normalized();
        radius = depthOf(x, b);
        radius = radius > 0 ? std::min(radius, depthOf(x, a)) : 0;
        largest = std::max(largest, 2 * radius);
      }
    }
  }
  return largest;
}
} // namespace

void WorldMesh::add(const WorldTriangle& triangle)
{
  this->triangles.push_back(triangle);
  this->box.extend(boxOf(triangle));
}

double freeWay(const WorldMesh& a, const WorldMesh& b, const Eigen::Vector3d& way)
{
  double part = 1;
  pairs(
    a, b, way, [&](const WorldTriangle& s, const WorldTriangle& t) { part = std::min(part, partOfWay(s, t, way)); });
  return part;
}

double overlapDepth(const WorldMesh& a, const WorldMesh& b)
{
  double deepest = 0;
  pairs(a, b, Eigen::Vector3d::Zero(),
    [&](const WorldTriangle& s, const WorldTriangle& t)
    { deepest = cross(s, t) ? std::max(deepest, depthOfPair(s, t)) : deepest; });
  const WorldMesh closedA = closedParts(a);
  const WorldMesh closedB = closedParts(b);
  deepest = std::max({ deepest, deepestWithin(a, closedB), deepestWithin(b, closedA) });
  return deepest > 0 ? deepest : std::max(diameterOfBall(closedA, closedB), diameterOfBall(closedB, closedA));
}

} // namespace dgtk
