// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkExactRay_h
#define dgtkExactRay_h

#include "dgtkExactSide.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace dgtk
{

/// A ray in the camera frame with the range of its parameter, ends included.
struct ExactRay
{
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;
  double least = 0;
  double most = 0;
};

/// Where a ray meets a triangle, in double precision.
struct ExactHit
{
  bool inside = false;
  double t = 0;
  Eigen::Vector2d barycentrics{ 0, 0 }; ///< of the second and third corner
};

/// The error of a position in single precision: of `distance` from the ray's origin, and of the sizes that took part.
constexpr double rayPrecision = 1e-6;

namespace exact
{

inline Eigen::Vector3d cross(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return { a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x() };
}

} // namespace exact

/// A triangle as seen from a point: what rays from there have in common.
struct TriangleFrom
{
  TriangleFrom() = default;
  TriangleFrom(const Eigen::Vector3d& origin, const Eigen::Vector3d corners[3])
    : x{ corners[0] - origin, corners[1] - origin, corners[2] - origin }
  {
    for (int i = 0; i < 3; ++i)
    {
      this->line[i] = exact::cross(this->x[(i + 1) % 3], this->x[(i + 2) % 3]);
      this->edge[i] = (this->x[(i + 1) % 3] - this->x[i]).squaredNorm();
      this->square[i] = this->x[i].squaredNorm();
    }
  }
  Eigen::Vector3d x[3];    ///< corners
  Eigen::Vector3d line[3]; ///< normals of the planes through the point and the edges opposite of the corners
  double edge[3];          ///< squares of the lengths from each corner to the next
  double square[3];        ///< of the distances of the corners
};

/// A triangle as a ray meets it.
struct SeenTriangle
{
  SeenTriangle(const ExactRay& ray, const TriangleFrom& origin)
    : from(origin)
  {
    constexpr double rounding = 0x1p-49; // of a volume, parts of the product of its sides
    const double limit = rounding * rounding * ray.direction.squaredNorm();
    int along = 0; // edges that the ray meets but for a rounding
    for (int i = 0; i < 3; ++i)
    {
      const int j = (i + 1) % 3;
      const int k = (i + 2) % 3;
      this->volume[i] = origin.line[i].dot(ray.direction);
      const double square = this->volume[i] * this->volume[i];
      if (square > limit * origin.square[j] * origin.square[k])
      {
        this->sides += this->volume[i] > 0 ? 1 : -1;
        continue;
      }
      ++along;
      const int side = exactSide(ray.direction, origin.x[j], origin.x[k]);
      this->sides += side;
      this->volume[i] = side * this->volume[i] > 0 ? this->volume[i] : 0;
    }
    if (along == 3 && this->isEdgeOn(ray.direction, rounding))
    {
      this->sides = 0; // it has no area
    }
  }
  const TriangleFrom& from;
  double volume[3]; ///< six times that of the ray's direction and the edge opposite of a corner
  int sides = 0;    ///< of the edges on which the ray passes, summed: 3 or -3 inside

private:
  /// Whether the triangle leans to the ray by no more than the rounding of its corners.
  bool isEdgeOn(const Eigen::Vector3d& direction, double rounding) const
  {
    const double lean =
      exact::cross(this->from.x[1] - this->from.x[0], this->from.x[2] - this->from.x[0]).dot(direction);
    const double size = *std::max_element(this->from.edge, this->from.edge + 3);
    const double distance = *std::max_element(this->from.square, this->from.square + 3);
    return lean * lean <= rounding * rounding * size * distance * direction.squaredNorm();
  }
};

inline ExactHit intersectExactly(const ExactRay& ray, const SeenTriangle& seen)
{
  ExactHit hit;
  const double sum = seen.volume[0] + seen.volume[1] + seen.volume[2];
  hit.inside = (seen.sides == 3 || seen.sides == -3) && sum != 0;
  const Eigen::Vector3d* const x = seen.from.x;
  const Eigen::Vector3d point = seen.volume[0] * x[0] + seen.volume[1] * x[1] + seen.volume[2] * x[2];
  hit.t = point.dot(ray.direction) / (sum * ray.direction.squaredNorm());
  hit.barycentrics = { seen.volume[1] / sum, seen.volume[2] / sum };
  return hit;
}

/// The edges that a ray passes at a distance below `slack`, in units of the scene at t: bit i for the one from corner i
/// to the next.
inline unsigned int marginalEdges(const ExactRay& ray, const SeenTriangle& seen, double slack)
{
  const double limit = slack * slack * ray.direction.squaredNorm();
  unsigned int edges = 0;
  for (int i = 0; i < 3; ++i)
  {
    const double volume = seen.volume[(i + 2) % 3];
    edges |= unsigned(!(volume * volume > limit * seen.from.edge[i])) << i;
  }
  return edges;
}

} // namespace dgtk

#endif
