// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceRows.h"

#include "dgtkThreadPool.h"
#include "dgtkTriangleSolver.h"

#include <algorithm>

namespace dgtk
{

namespace
{

/// Pixels: a centre this close to an edge of its triangle is looked at.
constexpr double LookDistance = 1.0 / 64;
/// Relative difference of t below which surfaces count as equally near: a few roundings of the intersection.
constexpr double SameDistance = 1e-12;
/// Relative slack of a triangle's range of depths, for triangles parallel to the image plane.
constexpr double RangeSlack = 1e-6;
/// Values of a line in double-double below this part of their terms are zero.
constexpr double ExactZero = 0x1p-70;
constexpr int ChunkRows = 32;

/// Signed lines of a triangle; a point is inside where the three values have one sign.
struct Edges
{
  Hit hit;
  Vector3 line[3];     ///< for General lenses the corners
  double threshold[3]; ///< a larger value is farther than LookDistance and its sign is certain
  double error;        ///< a larger value has a certain sign
};

struct PixelPoint
{
  double u, v;
  double dx, dy;
};

struct Change
{
  std::size_t index;
  Hit hit;
};

class Settler
{
public:
  Settler(const SceneState& state, const dgtk::View& view, const VisibilityBuffer& buffer, bool grazingOnly)
    : State(state)
    , TheView(view)
    , Buffer(buffer)
    , GrazingOnly(grazingOnly)
    , Solver(state, view)
    , Cache(CacheCount)
  {
  }

  /// Rows [first, last) of the buffer.
  void run(int first, int last, std::vector<Change>& changes)
  {
    const int width = this->Buffer.rect.width;
    for (int y = first; y < last; ++y)
    {
      const Hit* row = this->Buffer.hits.data() + std::size_t(y) * width;
      for (int x = 0; x < width; ++x)
      {
        Hit settled;
        if (!this->isUniform(row + x, x, y) && this->settle(row + x, x, y, settled))
        {
          changes.push_back({ std::size_t(y) * width + x, settled });
        }
      }
    }
  }

private:
  static constexpr std::size_t CacheCount = 1024;

  /// Whether the 3 x 3 neighbourhood is whole and of one triangle: the centre is then deep inside it.
  bool isUniform(const Hit* at, int x, int y) const
  {
    const int width = this->Buffer.rect.width;
    if (x == 0 || y == 0 || x == width - 1 || y == this->Buffer.rect.height - 1)
    {
      return at->object == 0 && this->isLonely(at, x, y);
    }
    const Hit hit = *at;
    const Hit* above = at - width;
    const Hit* below = at + width;
    return at[1] == hit && at[-1] == hit && above[0] == hit && below[0] == hit && above[-1] == hit && above[1] == hit &&
           below[-1] == hit && below[1] == hit;
  }

  template <typename Body>
  void forNeighbours(const Hit* at, int x, int y, const Body& body) const
  {
    const int width = this->Buffer.rect.width;
    for (int dy = y > 0 ? -1 : 0; dy <= (y < this->Buffer.rect.height - 1 ? 1 : 0); ++dy)
    {
      for (int dx = x > 0 ? -1 : 0; dx <= (x < width - 1 ? 1 : 0); ++dx)
      {
        body(at[std::ptrdiff_t(dy) * width + dx]);
      }
    }
  }

  bool isLonely(const Hit* at, int x, int y) const
  {
    bool lonely = true;
    this->forNeighbours(at, x, y, [&](const Hit& hit) { lonely &= hit.object == 0; });
    return lonely;
  }

  PixelPoint pixelPoint(int x, int y) const
  {
    const Lens& lens = this->Solver.lens();
    PixelPoint p;
    p.u = this->Buffer.rect.x + x + 0.5;
    p.v = this->Buffer.rect.y + y + 0.5;
    p.dy = lens.directionY(p.v);
    p.dx = lens.directionX(p.u, lens.Skew * p.dy);
    return p;
  }

  const Edges& edges(const Hit& hit)
  {
    Edges& entry = this->Cache[TriangleSolver::slot(hit) % CacheCount];
    if (entry.hit != hit)
    {
      this->makeEdges(hit, entry);
    }
    return entry;
  }

  void makeEdges(const Hit& hit, Edges& e)
  {
    const Lens& lens = this->Solver.lens();
    Vector3 corner[3];
    this->Solver.corners(hit, corner);
    const double reach = std::max({ sumNorm(corner[0]), sumNorm(corner[1]), sumNorm(corner[2]) });
    const double rounding = 32 * UnitRoundoff * this->Solver.condition(hit) * reach;
    e.hit = hit;
    if (lens.Kind == LensKind::General)
    {
      std::copy(corner, corner + 3, e.line);
      e.error = rounding;
      return;
    }
    if (lens.Kind == LensKind::Parallel)
    {
      corner[0].z = corner[1].z = corner[2].z = 1;
      e.error = rounding * (reach + 1 + lens.LargestDirection);
    }
    else
    {
      e.error = rounding * reach * lens.LargestDirection;
    }
    for (int i = 0; i < 3; ++i)
    {
      const Vector3& line = e.line[i] = cross(corner[(i + 1) % 3], corner[(i + 2) % 3]);
      const double gradientX = line.x * lens.InverseFx;
      const double gradientY = (line.y - gradientX * lens.Skew) * lens.InverseFy;
      const double gradient = std::sqrt(gradientX * gradientX + gradientY * gradientY);
      e.threshold[i] = std::max(LookDistance * gradient, e.error);
    }
  }

  /// Values of the three lines at a pixel, and their error.
  double valuesAt(const Edges& e, const PixelPoint& p, double q[3]) const
  {
    if (this->Solver.lens().Kind != LensKind::General)
    {
      for (int i = 0; i < 3; ++i)
      {
        q[i] = e.line[i].x * p.dx + e.line[i].y * p.dy + e.line[i].z;
      }
      return e.error;
    }
    const GeneralRay ray = this->Solver.generalRay(p.u, p.v);
    const Vector3 corner[3] = { e.line[0] - ray.origin, e.line[1] - ray.origin, e.line[2] - ray.origin };
    for (int i = 0; i < 3; ++i)
    {
      q[i] = dot(cross(corner[(i + 1) % 3], corner[(i + 2) % 3]), ray.direction);
    }
    const double reach = std::max({ sumNorm(corner[0]), sumNorm(corner[1]), sumNorm(corner[2]) });
    return (e.error + 32 * UnitRoundoff * sumNorm(ray.origin)) * reach * sumNorm(ray.direction);
  }

  /// Whether the centre is certainly inside and, for linear lenses, LookDistance away from the edges.
  bool isDeepInside(const Edges& e, const PixelPoint& p) const
  {
    double q[3];
    if (this->Solver.lens().Kind != LensKind::General)
    {
      this->valuesAt(e, p, q);
      return (q[0] > e.threshold[0] && q[1] > e.threshold[1] && q[2] > e.threshold[2]) ||
             (-q[0] > e.threshold[0] && -q[1] > e.threshold[1] && -q[2] > e.threshold[2]);
    }
    return this->lensIsDeepInside(e, p);
  }

  /// The distance from the edges by differences of one pixel.
  bool lensIsDeepInside(const Edges& e, const PixelPoint& p) const
  {
    double q[3], right[3], below[3];
    const double error = this->valuesAt(e, p, q);
    this->valuesAt(e, { p.u + 1, p.v, 0, 0 }, right);
    this->valuesAt(e, { p.u, p.v + 1, 0, 0 }, below);
    int positive = 0, negative = 0;
    for (int i = 0; i < 3; ++i)
    {
      const double x = right[i] - q[i];
      const double y = below[i] - q[i];
      const double threshold = std::max(LookDistance * std::sqrt(x * x + y * y), error);
      positive += q[i] > threshold;
      negative += -q[i] > threshold;
    }
    return positive == 3 || negative == 3;
  }

  bool contains(const Hit& hit, const PixelPoint& p)
  {
    double q[3];
    const double error = this->valuesAt(this->edges(hit), p, q);
    int positive = 0, negative = 0;
    for (const double value : q)
    {
      positive += value > error;
      negative += -value > error;
    }
    if (positive > 0 && negative > 0)
    {
      return false;
    }
    return positive == 3 || negative == 3 || this->containsExactly(hit, p);
  }

  bool containsExactly(const Hit& hit, const PixelPoint& p)
  {
    const Lens& lens = this->Solver.lens();
    const ExactTriangle& triangle = this->Solver.exact(hit);
    if (!triangle.valid)
    {
      return false;
    }
    Vector3dd line[3] = { triangle.lines[0], triangle.lines[1], triangle.lines[2] };
    Vector3dd direction;
    if (lens.Kind == LensKind::General)
    {
      const GeneralRay ray = this->Solver.generalRay(p.u, p.v);
      const Vector3dd origin{ ray.origin.x, ray.origin.y, ray.origin.z };
      direction = { ray.direction.x, ray.direction.y, ray.direction.z };
      for (int i = 0; i < 3; ++i)
      {
        line[i] = cross(triangle.corners[(i + 1) % 3] - origin, triangle.corners[(i + 2) % 3] - origin);
      }
    }
    else
    {
      direction = lens.exactDirection(p.u, p.v);
    }
    int positive = 0, negative = 0;
    for (const Vector3dd& l : line)
    {
      const double value = dot(l, direction).hi;
      const double zero = ExactZero * (std::abs(l.x.hi * direction.x.hi) + std::abs(l.y.hi * direction.y.hi) +
                                        std::abs(l.z.hi * direction.z.hi));
      positive += value > zero;
      negative += -value > zero;
    }
    return (positive > 0) != (negative > 0);
  }

  double depthOf(const PixelPoint& p, double t) const
  {
    if (this->Solver.lens().Kind != LensKind::General)
    {
      return t;
    }
    const GeneralRay ray = this->Solver.generalRay(p.u, p.v);
    return ray.origin.z + t * ray.direction.z;
  }

  /// Whether the plane of a triangle gives a depth within the triangle's own.
  bool isPlausible(const Hit& hit, const PixelPoint& p)
  {
    Vector3 corner[3];
    this->Solver.corners(hit, corner);
    const double nearest = std::min({ corner[0].z, corner[1].z, corner[2].z });
    const double farthest = std::max({ corner[0].z, corner[1].z, corner[2].z });
    const double depth = this->depthOf(p, this->Solver.point(hit, p.u, p.v, false).t);
    const double slack = RangeSlack * std::abs(farthest);
    return depth >= nearest - slack && depth <= farthest + slack;
  }

  /// t of a candidate that has a surface at the pixel's centre, +inf otherwise.
  double candidate(const Hit& hit, const PixelPoint& p)
  {
    constexpr double nowhere = std::numeric_limits<double>::infinity();
    if (!this->contains(hit, p))
    {
      return nowhere;
    }
    const PlanePoint point = this->Solver.point(hit, p.u, p.v, true);
    const double depth = this->depthOf(p, point.t);
    if (!(depth >= this->TheView.near && depth <= this->TheView.far) ||
        isCutOut(this->State.instances[hit.object - 1], hit.triangle, { point.second, point.third }))
    {
      return nowhere;
    }
    return point.t;
  }

  /// The nearest surface of the neighbourhood at the centre; object 0 when there is none.
  Hit nearest(const Hit* at, int x, int y, const PixelPoint& p)
  {
    Hit distinct[9];
    double t[9];
    int count = 0;
    double least = std::numeric_limits<double>::infinity();
    this->forNeighbours(at, x, y,
      [&](const Hit& hit)
      {
        if (hit.object != 0 && std::find(distinct, distinct + count, hit) == distinct + count)
        {
          t[count] = this->candidate(hit, p);
          least = std::min(least, t[count]);
          distinct[count++] = hit;
        }
      });
    Hit best;
    for (int i = 0; i < count; ++i)
    {
      const bool near = t[i] < std::numeric_limits<double>::infinity() && t[i] <= least * (1 + SameDistance);
      const bool lower = best.object == 0 || distinct[i].object < best.object ||
                         (distinct[i].object == best.object && distinct[i].triangle < best.triangle);
      best = near && lower ? distinct[i] : best;
    }
    return best;
  }

  /// The nearest surface at the centre of all triangles of the neighbourhood's objects; object 0 when there is none.
  Hit nearestOfObjects(const Hit* at, int x, int y, const PixelPoint& p)
  {
    std::vector<std::uint32_t> objects;
    this->forNeighbours(at, x, y, [&](const Hit& hit) { objects.push_back(hit.object); });
    std::sort(objects.begin(), objects.end());
    objects.erase(std::unique(objects.begin(), objects.end()), objects.end());
    Hit best;
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t object : objects)
    {
      const std::size_t count = object == 0 ? 0 : this->State.instances[object - 1].model->triangles.size();
      for (std::size_t i = 0; i < count; ++i)
      {
        const Hit hit{ object, std::uint32_t(i) };
        const double t = this->candidate(hit, p);
        if (t < least * (1 - SameDistance))
        {
          least = t;
          best = hit;
        }
      }
    }
    return best;
  }

  /// True when the pixel changes, to `settled`.
  bool settle(const Hit* at, int x, int y, Hit& settled)
  {
    const Hit own = *at;
    const PixelPoint p = this->pixelPoint(x, y);
    if (own.object == 0)
    {
      settled = this->GrazingOnly || this->isLonely(at, x, y) ? own : this->nearest(at, x, y, p);
      return settled != own;
    }
    if (this->isDeepInside(this->edges(own), p) ||
        (this->GrazingOnly && (this->contains(own, p) || this->isPlausible(own, p))))
    {
      return false;
    }
    settled = this->nearest(at, x, y, p);
    if (settled.object == 0)
    {
      // A sliver that no neighbour shows: rare enough to look at every triangle.
      settled = this->isPlausible(own, p) ? own : this->nearestOfObjects(at, x, y, p);
    }
    return settled != own;
  }

  const SceneState& State;
  const dgtk::View& TheView;
  const VisibilityBuffer& Buffer;
  bool GrazingOnly;
  TriangleSolver Solver;
  std::vector<Edges> Cache;
};

} // namespace

std::size_t settleEdges(
  const SceneState& state, const View& view, VisibilityBuffer& buffer, bool grazingOnly, ThreadPool* pool)
{
  const int height = buffer.rect.height;
  const int chunks = (height + ChunkRows - 1) / ChunkRows;
  std::vector<std::vector<Change>> changes(std::size_t(std::max(chunks, 0)));
  const auto body = [&](int chunk)
  {
    Settler settler(state, view, buffer, grazingOnly);
    settler.run(chunk * ChunkRows, std::min(height, (chunk + 1) * ChunkRows), changes[chunk]);
  };
  if (pool)
  {
    pool->parallelFor(chunks, body);
  }
  else if (chunks > 0)
  {
    Settler settler(state, view, buffer, grazingOnly);
    settler.run(0, height, changes[0]);
  }
  std::size_t changed = 0;
  for (const std::vector<Change>& part : changes)
  {
    for (const Change& change : part)
    {
      buffer.hits[change.index] = change.hit;
    }
    changed += part.size();
  }
  return changed;
}

} // namespace dgtk
