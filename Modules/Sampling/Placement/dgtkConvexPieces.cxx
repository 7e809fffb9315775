// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkConvexHull.h"
#include "dgtkPortableMath.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>

namespace dgtk
{

namespace
{
using Inside = std::function<bool(const Eigen::Vector3d&)>;
using Polygon = std::vector<Eigen::Vector3d>;

/// A flat bit of a surface.
struct Facet
{
  Polygon corners;
  Eigen::Vector3d out{ 0, 0, 0 }; ///< unit length, away from the solid; of what bounds none, zero

  Eigen::Vector3d middle() const
  {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& p : this->corners)
    {
      sum += p;
    }
    return sum / double(this->corners.size());
  }
  Eigen::Vector3d area() const // of a triangle, twice
  {
    return (this->corners[1] - this->corners[0]).cross(this->corners[2] - this->corners[0]);
  }
};

/// The part of a surface within some cuts.
struct Piece
{
  std::vector<Facet> surface;
  std::vector<HalfSpace> cuts;
  std::vector<Eigen::Vector3d> corners; ///< where three cuts meet within the solid
  ConvexHull hull;
  double concavity = 0;
  Eigen::Vector3d deepest{ 0, 0, 0 };
};

/// How much of a hull is empty above a point of a surface: along its normal, or across the nearest face of the hull
/// where the surface bounds no solid.
double emptyAbove(const Eigen::Vector3d& x, const Eigen::Vector3d& out, const std::vector<HalfSpace>& faces)
{
  double way = std::numeric_limits<double>::max();
  for (const HalfSpace& face : faces)
  {
    const double slope = out.isZero() ? 1 : face.normal.dot(out);
    way = slope > 1e-6 ? std::min(way, -face.above(x) / slope) : way;
  }
  return faces.empty() ? 0 : std::max(way, 0.0);
}

void findHull(Piece& piece)
{
  std::vector<Eigen::Vector3d> points = piece.corners;
  for (const Facet& facet : piece.surface)
  {
    points.insert(points.end(), facet.corners.begin(), facet.corners.end());
  }
  piece.hull = convexHull(points);
}

/// Fills in the concavity, and where it is; of a piece that has its hull.
void measure(Piece& piece)
{
  piece.concavity = 0;
  const auto look = [&](const Eigen::Vector3d& x, const Eigen::Vector3d& out)
  {
    const double depth = emptyAbove(x, out, piece.hull.faces);
    if (depth > piece.concavity)
    {
      piece.concavity = depth;
      piece.deepest = x;
    }
  };
  for (const Facet& facet : piece.surface)
  {
    for (const Eigen::Vector3d& p : facet.corners)
    {
      look(p, facet.out);
    }
    look(facet.middle(), facet.out);
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
  for (const Facet& facet : piece.surface)
  {
    Facet part = { clipped(facet.corners, side), facet.out };
    if (part.corners.size() >= 3)
    {
      result.surface.push_back(std::move(part));
    }
  }
  if (!result.surface.empty())
  {
    findHull(result);
  }
  return result;
}

/// The axis about which a surface looks much the same in all directions.
struct TurningAxis
{
  Eigen::Vector3d origin{ 0, 0, 0 };
  Eigen::Vector3d direction{ 0, 1, 0 };
};

/// That of a surface whose area spreads alike along two axes; none.
std::optional<TurningAxis> turningAxis(const std::vector<Facet>& triangles)
{
  double area = 0;
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Facet& t : triangles)
  {
    const double weight = t.area().norm() / 3;
    for (std::size_t i = 0; i < 3; ++i)
    {
      // The middles of the sides: exact for what is quadratic.
      const Eigen::Vector3d p = 0.5 * (t.corners[i] + t.corners[(i + 1) % 3]);
      area += weight;
      middle += weight * p;
      spread += weight * p * p.transpose();
    }
  }
  if (area <= 0)
  {
    return {};
  }
  middle /= area;
  spread = spread / area - middle * middle.transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  const Eigen::Vector3d& moments = axes.eigenvalues();
  constexpr double alike = 0.05;
  for (const int odd : { 0, 2 })
  {
    if (std::abs(moments[odd == 0 ? 2 : 0] - moments[1]) < alike * moments[2] &&
        std::abs(moments[odd] - moments[1]) > alike * moments[2])
    {
      return TurningAxis{ middle, axes.eigenvectors().col(odd) };
    }
  }
  return {};
}

/// Heights along an axis between `rings` bands of a surface whose profiles are about equally long.
std::vector<double> bandsOf(const std::vector<Facet>& triangles, const TurningAxis& axis, std::size_t rings)
{
  std::vector<std::array<double, 2>> parts; // height, and length of profile: area by radius
  double sum = 0;
  for (const Facet& t : triangles)
  {
    const Eigen::Vector3d p = t.middle() - axis.origin;
    const double area = t.area().norm();
    const double radius = axis.direction.cross(p).norm();
    parts.push_back({ axis.direction.dot(p), radius > 0 ? area / radius : 0 });
    sum += parts.back()[1];
  }
  std::sort(parts.begin(), parts.end());
  std::vector<double> heights;
  double below = 0;
  for (const std::array<double, 2>& part : parts)
  {
    below += part[1];
    if (heights.size() + 1 < rings && below >= sum * double(heights.size() + 1) / double(rings))
    {
      heights.push_back(axis.direction.dot(axis.origin) + part[0]);
    }
  }
  return heights;
}

/// A band of a surface about an axis in sectors, alike in angle: as few as make them true. Nothing where 16 do not.
std::vector<Piece> sectorsOf(
  const Piece& band, const TurningAxis& axis, double size, double tolerance, const Inside& inside)
{
  if (band.concavity <= tolerance)
  {
    return { band };
  }
  const Eigen::Vector3d first = axis.direction.unitOrthogonal();
  const Eigen::Vector3d second = axis.direction.cross(first);
  for (const int sectors : { 3, 4, 6, 8, 10, 12, 16 })
  {
    std::vector<Piece> pieces;
    const auto side = [&](int i)
    {
      const double angle = 2 * pi * i / sectors;
      const Eigen::Vector3d normal = portable::cos(angle) * first + portable::sin(angle) * second;
      return HalfSpace{ normal, normal.dot(axis.origin) };
    };
    bool fits = true;
    for (int i = 0; i < sectors && fits; ++i)
    {
      const HalfSpace end = side(i + 1);
      Piece sector = half(half(band, side(i), size, inside), { -end.normal, -end.offset }, size, inside);
      if (!sector.surface.empty())
      {
        measure(sector);
        fits = fits && sector.concavity <= tolerance;
        pieces.push_back(std::move(sector));
      }
    }
    if (fits)
    {
      return pieces;
    }
  }
  return {};
}

/// What turns about an axis, in bands across it, each in sectors: the way with fewest pieces. Nothing where all of
/// them need more than `most`.
std::vector<Piece> turnedPieces(
  const Piece& whole, const TurningAxis& axis, double size, double tolerance, std::size_t most, const Inside& inside)
{
  constexpr std::size_t mostBands = 5;
  std::vector<Piece> best;
  for (std::size_t bands = 1; bands <= mostBands; ++bands)
  {
    std::vector<Piece> pieces;
    Piece rest = whole;
    bool fits = true;
    const std::vector<double> heights = bandsOf(whole.surface, axis, bands);
    for (std::size_t i = 0; i <= heights.size() && fits; ++i)
    {
      const bool last = i == heights.size();
      Piece band = last ? rest : half(rest, { axis.direction, heights[i] }, size, inside);
      measure(band);
      rest = last ? Piece() : half(rest, { -axis.direction, -heights[i] }, size, inside);
      std::vector<Piece> sectors = sectorsOf(band, axis, size, tolerance, inside);
      fits = !sectors.empty() && pieces.size() + sectors.size() <= most;
      std::move(sectors.begin(), sectors.end(), std::back_inserter(pieces));
    }
    if (fits && (best.empty() || pieces.size() < best.size()))
    {
      best = std::move(pieces);
    }
  }
  return best;
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

double worstOf(const std::vector<Piece>& pieces)
{
  double worst = 0;
  for (const Piece& piece : pieces)
  {
    worst = std::max(worst, piece.concavity);
  }
  return worst;
}

/// The worst piece is cut until all are true, or there are `most`, or none can be cut.
std::vector<Piece> cutPieces(const Piece& whole, double size, double tolerance, std::size_t most, const Inside& inside)
{
  std::vector<Piece> pieces{ whole };
  std::vector<char> uncut(1, 0);
  while (pieces.size() < most)
  {
    std::size_t worst = pieces.size();
    for (std::size_t i = 0; i < pieces.size(); ++i)
    {
      worst = !uncut[i] && pieces[i].concavity > tolerance &&
                  (worst == pieces.size() || pieces[i].concavity > pieces[worst].concavity)
                ? i
                : worst;
    }
    if (worst == pieces.size())
    {
      break;
    }
    std::optional<std::array<Piece, 2>> parts = bestCut(pieces[worst], size, inside);
    if (!parts)
    {
      uncut[worst] = 1; // as small as pieces get
      continue;
    }
    measure((*parts)[0]);
    measure((*parts)[1]);
    pieces[worst] = std::move((*parts)[0]);
    pieces.push_back(std::move((*parts)[1]));
    uncut.push_back(0);
  }
  return pieces;
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
    whole.surface.push_back({ { points[triangle[0]], points[triangle[1]], points[triangle[2]] }, {} });
    for (const std::uint32_t corner : triangle)
    {
      low = low.cwiseMin(points[corner]);
      high = high.cwiseMax(points[corner]);
    }
  }
  const double size = (high - low).maxCoeff();
  for (Facet& facet : whole.surface)
  {
    const Eigen::Vector3d out = facet.area().normalized();
    const bool above = inside(facet.middle() + 1e-5 * size * out);
    const bool below = inside(facet.middle() - 1e-5 * size * out);
    facet.out = above == below ? Eigen::Vector3d::Zero() : Eigen::Vector3d(below ? out : -out);
  }
  findHull(whole);
  measure(whole);
  std::vector<Piece> pieces = cutPieces(whole, size, tolerance, most, inside);
  if (const std::optional<TurningAxis> turning = pieces.size() > 1 ? turningAxis(whole.surface) : std::nullopt)
  {
    // A bowl needs fewer sectors than boxes.
    std::vector<Piece> turned;
    double allowed = tolerance;
    for (; turned.empty() && allowed < worstOf(pieces); allowed *= 1.25)
    {
      turned = turnedPieces(whole, *turning, size, allowed, most, inside);
    }
    if (!turned.empty() && (turned.size() < pieces.size() || worstOf(turned) < worstOf(pieces)))
    {
      pieces = std::move(turned);
    }
  }
  std::vector<ConvexHull> hulls;
  hulls.reserve(pieces.size());
  for (Piece& piece : pieces)
  {
    hulls.push_back(std::move(piece.hull));
  }
  return hulls;
}

} // namespace dgtk
