// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEdgeMarks.h"
#include "dgtkSurfaceRows.h"
#include "dgtkTriangleSolver.h"

#include <algorithm>
#include <optional>
#include <tuple>

namespace dgtk
{

namespace
{

/// Pixels: a centre this close to an edge may have been drawn on its other side. Vertices are snapped to 1/256 pixel,
/// or coarser steps for triangles that are left uncut; see RenderGL.
constexpr double lookDistance = 1.0 / 64;
/// Relative difference of t below which surfaces count as equally near: a few roundings of the intersection.
constexpr double sameDistance = 1e-12;
/// Part of a depth by which a surface in front may have been drawn as if it were behind.
constexpr double sameDepth = 4e-6;
/// Part of near and far within which drawing may decide either way.
constexpr double limitSlack = 2e-6;
/// Values of a line in double-double below this part of their terms are zero.
constexpr double exactZero = 0x1p-70;

/// Signed lines of a triangle; a point is inside where the three values have one sign.
struct Edges
{
  Vector3 line[3];
  double error; ///< a larger value has a certain sign
};

/// A surface at the centre of a pixel.
struct Candidate
{
  std::size_t pixel;
  double t;
  Hit hit;
};

class Settler
{
public:
  Settler(const SceneState& state, const dgtk::View& view, VisibilityBuffer& buffer)
    : State(state)
    , TheView(view)
    , Buffer(buffer)
    , Marks(buffer.rect)
    , Solver(state, view)
  {
  }

  std::size_t run()
  {
    this->measure();
    this->forTriangles(
      [this](const Hit& hit, const SmallPolygon<Vector3>& polygon, bool cutOut) { this->look(hit, polygon, cutOut); });
    this->Marks.pack();
    this->forTriangles(
      [this](const Hit& hit, const SmallPolygon<Vector3>& polygon, bool) { this->collect(hit, polygon); });
    return this->decide();
  }

private:
  void measure()
  {
    this->Drawn.assign(this->Buffer.hits.size(), std::numeric_limits<double>::infinity());
    const PixelRect& rect = this->Buffer.rect;
    for (std::size_t i = 0; i < this->Drawn.size(); ++i)
    {
      if (this->Buffer.hits[i].object != 0)
      {
        const double u = rect.x + double(i % std::size_t(rect.width)) + 0.5;
        const double v = rect.y + double(i / std::size_t(rect.width)) + 0.5;
        this->Drawn[i] = this->Solver.point(this->Buffer.hits[i], u, v, false).t;
      }
    }
  }

  /// Calls body(hit, polygon, cutOut) with what each triangle has within near and far, a little widened.
  template <typename Body>
  void forTriangles(const Body& body)
  {
    for (std::size_t i = 0; i < this->State.instances.size(); ++i)
    {
      const Instance& instance = this->State.instances[i];
      if (!instance.visible)
      {
        continue;
      }
      const std::vector<Material>& materials = instance.materials ? *instance.materials : instance.model->materials;
      for (const Part& part : instance.model->parts)
      {
        const bool cutOut = !materials.empty() && materials[std::size_t(part.material)].cutOut;
        for (std::uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangles; ++t)
        {
          const Hit hit{ std::uint32_t(i + 1), t };
          const SmallPolygon<Vector3> polygon = this->withinLimits(hit);
          if (polygon.count > 0)
          {
            body(hit, polygon, cutOut);
          }
        }
      }
    }
  }

  SmallPolygon<Vector3> withinLimits(const Hit& hit)
  {
    Vector3 corner[3];
    this->Solver.corners(hit, corner);
    SmallPolygon<Vector3> polygon;
    for (const Vector3& x : corner)
    {
      polygon.add(x);
    }
    polygon =
      this->isBeyond(corner, 1, this->least(-limitSlack)) ? clipped(polygon, 1, this->least(-limitSlack)) : polygon;
    return this->isBeyond(corner, -1, this->most(limitSlack)) ? clipped(polygon, -1, this->most(limitSlack)) : polygon;
  }

  double least(double slack) const { return this->TheView.near + slack * std::abs(this->TheView.near); }
  double most(double slack) const { return this->TheView.far + slack * std::abs(this->TheView.far); }

  /// Whether some corner is on the wrong side of a plane, or not a number.
  static bool isBeyond(const Vector3 corner[3], double side, double limit)
  {
    return std::any_of(corner, corner + 3, [&](const Vector3& x) { return !(side * (x.z - limit) >= 0); });
  }

  SmallPolygon<ImagePoint> project(const SmallPolygon<Vector3>& polygon) const
  {
    const Lens& lens = this->Solver.lens();
    SmallPolygon<ImagePoint> projected;
    for (int i = 0; i < polygon.count; ++i)
    {
      const double scale = lens.Kind == LensKind::Perspective ? 1 / polygon[i].z : 1;
      const double x = polygon[i].x * scale;
      const double y = polygon[i].y * scale;
      projected.add({ lens.Fx * x + lens.Skew * y + lens.Cx, lens.Fy * y + lens.Cy });
    }
    return projected;
  }

  /// Marks the pixels at which drawing may have taken a triangle's part wrongly.
  void look(const Hit& hit, const SmallPolygon<Vector3>& polygon, bool cutOut)
  {
    const SmallPolygon<ImagePoint> image = this->project(polygon);
    for (int i = 0; i < image.count; ++i)
    {
      this->Marks.markSegment(image[i], image[(i + 1) % image.count], lookDistance);
    }
    this->lookAtLimit(clipped(polygon, -1, this->least(limitSlack)));
    this->lookAtLimit(clipped(polygon, 1, this->most(-limitSlack)));
    this->Marks.forPixels(image, lookDistance,
      [&](int x, int y)
      {
        if (!this->Marks.isMarked(x, y) && this->mayDecide(hit, cutOut, x, y))
        {
          this->Marks.mark(x, y);
        }
      });
  }

  /// Whether a triangle is not clearly behind what was drawn, which is another, or was drawn where its texel is
  /// missing.
  bool mayDecide(const Hit& hit, bool cutOut, int x, int y)
  {
    const std::size_t pixel = this->Marks.index(x, y);
    const bool drawn = this->Buffer.hits[pixel] == hit;
    if (drawn && !cutOut)
    {
      return false;
    }
    const PlanePoint point = this->Solver.point(hit, x + 0.5, y + 0.5, cutOut);
    return drawn ? isCutOut(this->State.instances[hit.object - 1], hit.triangle, { point.second, point.third })
                 : point.t <= this->Drawn[pixel] * (1 + sameDepth);
  }

  void lookAtLimit(const SmallPolygon<Vector3>& slab)
  {
    if (slab.count > 0)
    {
      this->Marks.forPixels(this->project(slab), lookDistance, [this](int x, int y) { this->Marks.mark(x, y); });
    }
  }

  /// Adds what a triangle has at the centres of marked pixels.
  void collect(const Hit& hit, const SmallPolygon<Vector3>& polygon)
  {
    std::optional<Edges> edges;
    this->Marks.forMarked(this->project(polygon), lookDistance,
      [&](int x, int y)
      {
        if (!edges)
        {
          edges = this->makeEdges(hit);
        }
        const double t = this->meets(hit, *edges, x, y);
        if (t < std::numeric_limits<double>::infinity())
        {
          this->Candidates.push_back({ this->Marks.index(x, y), t, hit });
        }
      });
  }

  Edges makeEdges(const Hit& hit)
  {
    const Lens& lens = this->Solver.lens();
    Vector3 corner[3];
    this->Solver.corners(hit, corner);
    const double reach = std::max({ sumNorm(corner[0]), sumNorm(corner[1]), sumNorm(corner[2]) });
    const double rounding = 32 * unitRoundoff * this->Solver.condition(hit) * reach;
    Edges e;
    e.error = rounding * reach * lens.LargestDirection;
    if (lens.Kind == LensKind::Parallel)
    {
      corner[0].z = corner[1].z = corner[2].z = 1;
      e.error = rounding * (reach + 1 + lens.LargestDirection);
    }
    for (int i = 0; i < 3; ++i)
    {
      e.line[i] = cross(corner[(i + 1) % 3], corner[(i + 2) % 3]);
    }
    return e;
  }

  /// t of a triangle's surface at a pixel's centre, +inf where there is none.
  double meets(const Hit& hit, const Edges& edges, int x, int y)
  {
    constexpr double nowhere = std::numeric_limits<double>::infinity();
    const double u = x + 0.5;
    const double v = y + 0.5;
    if (!this->contains(hit, edges, u, v))
    {
      return nowhere;
    }
    const PlanePoint point = this->Solver.point(hit, u, v, true);
    const bool seen = point.t >= this->TheView.near && point.t <= this->TheView.far &&
                      !isCutOut(this->State.instances[hit.object - 1], hit.triangle, { point.second, point.third });
    return seen ? point.t : nowhere;
  }

  bool contains(const Hit& hit, const Edges& edges, double u, double v)
  {
    const Lens& lens = this->Solver.lens();
    const double dy = lens.directionY(v);
    const double dx = lens.directionX(u, lens.Skew * dy);
    int positive = 0, negative = 0;
    for (const Vector3& line : edges.line)
    {
      const double value = line.x * dx + line.y * dy + line.z;
      positive += value > edges.error;
      negative += -value > edges.error;
    }
    if (positive > 0 && negative > 0)
    {
      return false;
    }
    return positive == 3 || negative == 3 || this->containsExactly(hit, lens.exactDirection(u, v));
  }

  bool containsExactly(const Hit& hit, const Vector3dd& direction)
  {
    const ExactTriangle& triangle = this->Solver.exact(hit);
    if (!triangle.valid)
    {
      return false;
    }
    int positive = 0, negative = 0;
    for (const Vector3dd& l : triangle.lines)
    {
      const double value = dot(l, direction).hi;
      const double zero = exactZero * (std::abs(l.x.hi * direction.x.hi) + std::abs(l.y.hi * direction.y.hi) +
                                        std::abs(l.z.hi * direction.z.hi));
      positive += value > zero;
      negative += -value > zero;
    }
    return (positive > 0) != (negative > 0);
  }

  /// Gives the marked pixels their nearest surface; returns how many change.
  std::size_t decide()
  {
    std::sort(this->Candidates.begin(), this->Candidates.end(),
      [](const Candidate& a, const Candidate& b) { return std::tie(a.pixel, a.t) < std::tie(b.pixel, b.t); });
    std::size_t changed = 0;
    auto at = this->Candidates.begin();
    for (int y = 0; y < this->Buffer.rect.height; ++y)
    {
      for (int x = 0; x < this->Buffer.rect.width; ++x)
      {
        const std::size_t pixel = std::size_t(y) * std::size_t(this->Buffer.rect.width) + std::size_t(x);
        if (this->Marks.isMarked(this->Buffer.rect.x + x, this->Buffer.rect.y + y))
        {
          const Hit hit = this->nearest(pixel, at);
          changed += hit != this->Buffer.hits[pixel] ? 1 : 0;
          this->Buffer.hits[pixel] = hit;
        }
      }
    }
    return changed;
  }

  /// The first of a pixel's candidates from `at`, which goes on to the next pixel's; of equally near ones the lowest.
  Hit nearest(std::size_t pixel, std::vector<Candidate>::iterator& at) const
  {
    Hit best;
    const double limit = at != this->Candidates.end() ? at->t * (1 + sameDistance) : 0;
    for (; at != this->Candidates.end() && at->pixel == pixel; ++at)
    {
      const bool lower =
        best.object == 0 || std::tie(at->hit.object, at->hit.triangle) < std::tie(best.object, best.triangle);
      best = at->t <= limit && lower ? at->hit : best;
    }
    return best;
  }

  const SceneState& State;
  const dgtk::View& TheView;
  VisibilityBuffer& Buffer;
  PixelMarks Marks;
  TriangleSolver Solver;
  std::vector<double> Drawn; ///< t of the surfaces that were drawn
  std::vector<Candidate> Candidates;
};

} // namespace

std::size_t settleEdges(const SceneState& state, const View& view, VisibilityBuffer& buffer)
{
  return Settler(state, view, buffer).run();
}

} // namespace dgtk
