// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkConvexHull.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <limits>

namespace dgtk
{

namespace
{
/// Smallest extent along the axes of inertia of the points, and the largest.
std::array<double, 2> extents(const std::vector<Eigen::Vector3d>& points)
{
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& p : points)
  {
    mean += p / double(points.size());
  }
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Eigen::Vector3d& p : points)
  {
    spread += (p - mean) * (p - mean).transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  std::array<double, 2> found = { std::numeric_limits<double>::max(), 0 };
  for (int i = 0; i < 3; ++i)
  {
    double least = std::numeric_limits<double>::max();
    double most = -least;
    for (const Eigen::Vector3d& p : points)
    {
      const double at = axes.eigenvectors().col(i).dot(p - mean);
      least = std::min(least, at);
      most = std::max(most, at);
    }
    found = { std::min(found[0], most - least), std::max(found[1], most - least) };
  }
  return found;
}

Eigen::Vector3d point(const btConvexHullComputer& hull, int vertex)
{
  const btVector3& v = hull.vertices[vertex];
  return { v.x(), v.y(), v.z() };
}
} // namespace

ConvexHull convexHull(const std::vector<Eigen::Vector3d>& points, double shrink)
{
  ConvexHull result;
  if (points.size() < 4)
  {
    result.points = points;
    return result;
  }
  const std::array<double, 2> size = extents(points);
  if (size[0] <= 1e-4 * size[1])
  {
    result.points = points;
    return result;
  }
  btConvexHullComputer hull;
  hull.compute(points.front().data(), sizeof(Eigen::Vector3d), int(points.size()), shrink, 0.5);
  if (hull.vertices.size() < 4)
  {
    result.points = points;
    return result;
  }
  for (int i = 0; i < hull.vertices.size(); ++i)
  {
    result.points.push_back(point(hull, i));
  }
  const Eigen::Vector3d origin = result.points.front();
  for (int f = 0; f < hull.faces.size(); ++f)
  {
    const btConvexHullComputer::Edge* const first = &hull.edges[hull.faces[f]];
    const Eigen::Vector3d a = point(hull, first->getSourceVertex());
    Eigen::Vector3d area = Eigen::Vector3d::Zero();
    for (const auto* edge = first->getNextEdgeOfFace(); edge->getTargetVertex() != first->getSourceVertex();
         edge = edge->getNextEdgeOfFace())
    {
      const Eigen::Vector3d b = point(hull, edge->getSourceVertex());
      const Eigen::Vector3d c = point(hull, edge->getTargetVertex());
      area += (b - a).cross(c - a);
    }
    if (area.norm() <= 0)
    {
      continue;
    }
    HalfSpace face;
    face.normal = area.normalized();
    face.offset = face.normal.dot(a);
    result.volume += area.dot(a - origin) / 6;
    result.faces.push_back(face);
  }
  // The order of a face's edges is Bullet's.
  if (result.volume < 0)
  {
    result.volume = -result.volume;
    for (HalfSpace& face : result.faces)
    {
      face = { -face.normal, -face.offset };
    }
  }
  return result;
}

ConvexHull simplifiedHull(const ConvexHull& hull, double tolerance)
{
  if (hull.faces.empty())
  {
    return hull;
  }
  // Corners are added to those that are outermost along some directions, the furthest outside first.
  std::vector<Eigen::Vector3d> left = hull.points;
  std::vector<Eigen::Vector3d> chosen;
  const auto choose = [&](const auto& height)
  {
    const auto best = std::max_element(left.begin(), left.end(),
      [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return height(a) < height(b); });
    chosen.push_back(*best);
    left.erase(best);
  };
  for (const Eigen::Vector3d& direction :
    { Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(-1, -1, 1), Eigen::Vector3d(-1, 1, -1), Eigen::Vector3d(1, -1, -1) })
  {
    choose([&](const Eigen::Vector3d& p) { return direction.dot(p); });
  }
  while (!left.empty())
  {
    ConvexHull some = convexHull(chosen);
    const auto outside = [&](const Eigen::Vector3d& p)
    {
      double height = some.faces.empty() ? (p - chosen.front()).norm() : 0;
      for (const HalfSpace& face : some.faces)
      {
        height = std::max(height, face.above(p));
      }
      return height;
    };
    const auto furthest = std::max_element(left.begin(), left.end(),
      [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return outside(a) < outside(b); });
    if (!some.faces.empty() && outside(*furthest) <= tolerance)
    {
      some.left = outside(*furthest);
      some.whole = hull.points;
      return some;
    }
    choose(outside);
  }
  return hull;
}

} // namespace dgtk
