// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkConvexHull.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace dgtk
{

namespace
{
using Inside = std::function<bool(const Eigen::Vector3d&)>;
using Polygon = std::vector<Eigen::Vector3d>;

/// The part of a surface within some cuts.
struct Piece
{
  std::vector<Polygon> surface;
  std::vector<HalfSpace> cuts;
  std::vector<Eigen::Vector3d> corners; ///< where three cuts meet within the solid
  ConvexHull hull;
  double concavity = 0;
  Eigen::Vector3d deepest{ 0, 0, 0 };
};

bool isCut(const Piece& piece, const HalfSpace& face, double size)
{
  return std::any_of(piece.cuts.begin(), piece.cuts.end(),
    [&](const HalfSpace& cut)
    { return cut.normal.dot(face.normal) > 1 - 1e-3 && std::abs(cut.offset - face.offset) < 1e-3 * size; });
}

/// Fills in hull and concavity: how deep below its hull the surface lies, the cuts apart, which are not surface.
void measure(Piece& piece, double size)
{
  std::vector<Eigen::Vector3d> points = piece.corners;
  for (const Polygon& polygon : piece.surface)
  {
    points.insert(points.end(), polygon.begin(), polygon.end());
  }
  piece.hull = convexHull(points);
  std::vector<HalfSpace> faces;
  for (const HalfSpace& face : piece.hull.faces)
  {
    if (!isCut(piece, face, size))
    {
      faces.push_back(face);
    }
  }
  piece.concavity = 0;
  const auto look = [&](const Eigen::Vector3d& x)
  {
    double depth = std::numeric_limits<double>::max();
    for (const HalfSpace& face : faces)
    {
      depth = std::min(depth, -face.above(x));
    }
    if (!faces.empty() && depth > piece.concavity)
    {
      piece.concavity = depth;
      piece.deepest = x;
    }
  };
  for (const Polygon& polygon : piece.surface)
  {
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : polygon)
    {
      look(p);
      middle += p / double(polygon.size());
    }
    look(middle);
  }
}

/// The part of a polygon on which above() is at most 0.
Polygon clipped(const Polygon& polygon, const HalfSpace& half)
{
  Polygon result;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Eigen::Vector3d& a = polygon[i];
    const Eigen::Vector3d& b = polygon[(i + 1) % polygon.size()];
    const double da = half.above(a);
    const double db = half.above(b);
    if (da <= 0)
    {
      result.push_back(a);
    }
    if ((da < 0 && db > 0) || (da > 0 && db < 0))
    {
      result.push_back(a + (b - a) * (da / (da - db)));
    }
  }
  return result;
}

/// Adds the points of a solid in which a further cut meets two that were made before.
void addCorners(Piece& piece, const HalfSpace& side, double size, const Inside& inside)
{
  const double slack = 1e-9 * size;
  for (std::size_t i = 0; i < piece.cuts.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      const HalfSpace& p = piece.cuts[i];
      const HalfSpace& q = piece.cuts[j];
      const double det = side.normal.dot(p.normal.cross(q.normal));
      if (std::abs(det) < 1e-6)
      {
        continue;
      }
      const Eigen::Vector3d x = (side.offset * p.normal.cross(q.normal) + p.offset * q.normal.cross(side.normal) +
                                  q.offset * side.normal.cross(p.normal)) /
                                det;
      const bool within =
        std::all_of(piece.cuts.begin(), piece.cuts.end(), [&](const HalfSpace& cut) { return cut.above(x) <= slack; });
      if (within && inside(x))
      {
        piece.corners.push_back(x);
      }
    }
  }
}

Piece half(const Piece& piece, const HalfSpace& side, double size, const Inside& inside)
{
  Piece result;
  result.cuts = piece.cuts;
  for (const Eigen::Vector3d& corner : piece.corners)
  {
    if (side.above(corner) <= 1e-9 * size)
    {
      result.corners.push_back(corner);
    }
  }
  addCorners(result, side, size, inside);
  result.cuts.push_back(side);
  for (const Polygon& polygon : piece.surface)
  {
    Polygon part = clipped(polygon, side);
    if (part.size() >= 3)
    {
      result.surface.push_back(std::move(part));
    }
  }
  if (!result.surface.empty())
  {
    measure(result, size);
  }
  return result;
}

/// Both sides of the cut, across an axis of the model, that leaves the least volume in the hulls; none that cuts
/// anything off.
std::optional<std::array<Piece, 2>> bestCut(const Piece& piece, double size, const Inside& inside)
{
  constexpr int cuts = 4;
  std::optional<std::array<Piece, 2>> best;
  double least = std::numeric_limits<double>::max();
  static const Eigen::Vector3d axes[] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
  for (const Eigen::Vector3d& axis : axes)
  {
    double low = std::numeric_limits<double>::max();
    double high = -low;
    for (const Eigen::Vector3d& p : piece.hull.points)
    {
      low = std::min(low, axis.dot(p));
      high = std::max(high, axis.dot(p));
    }
    for (int i = 0; i <= cuts; ++i)
    {
      const double at = i == cuts ? axis.dot(piece.deepest) : low + (high - low) * (i + 1) / (cuts + 1);
      if (at - low < 0.02 * size || high - at < 0.02 * size)
      {
        continue;
      }
      HalfSpace side;
      side.normal = axis;
      side.offset = at;
      std::array<Piece, 2> parts = { half(piece, side, size, inside),
        half(piece, { -side.normal, -at }, size, inside) };
      if (parts[0].surface.empty() || parts[1].surface.empty())
      {
        continue;
      }
      const double volume = parts[0].hull.volume + parts[1].hull.volume;
      if (volume < least)
      {
        least = volume;
        best = std::move(parts);
      }
    }
  }
  return best;
}
} // namespace

std::vector<ConvexHull> convexPieces(const std::vector<Eigen::Vector3d>& points,
  const std::vector<std::array<std::uint32_t, 3>>& triangles, double tolerance, std::size_t most, const Inside& inside)
{
  Piece whole;
  Eigen::Vector3d low = points[triangles.front()[0]];
  Eigen::Vector3d high = low;
  for (const auto& triangle : triangles)
  {
    whole.surface.push_back({ points[triangle[0]], points[triangle[1]], points[triangle[2]] });
    for (const std::uint32_t corner : triangle)
    {
      low = low.cwiseMin(points[corner]);
      high = high.cwiseMax(points[corner]);
    }
  }
  const double size = (high - low).maxCoeff();
  measure(whole, size);
  std::vector<Piece> pieces{ std::move(whole) };
  while (pieces.size() < most)
  {
    const auto worst = std::max_element(
      pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.concavity < b.concavity; });
    if (worst->concavity <= tolerance)
    {
      break;
    }
    std::optional<std::array<Piece, 2>> parts = bestCut(*worst, size, inside);
    if (!parts)
    {
      worst->concavity = 0; // as small as pieces get
      continue;
    }
    *worst = std::move((*parts)[0]);
    pieces.push_back(std::move((*parts)[1]));
  }
  std::vector<ConvexHull> hulls;
  for (Piece& piece : pieces)
  {
    hulls.push_back(std::move(piece.hull));
  }
  return hulls;
}

} // namespace dgtk
