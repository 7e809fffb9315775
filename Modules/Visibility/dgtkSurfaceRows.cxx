// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceRows.h"

#include "dgtkInstantSource.h"
#include "dgtkTriangleSolver.h"

#include <algorithm>

namespace dgtk
{

namespace
{

/// The pixels of a row of a linear lens: affine directions, no virtual call.
template <LensKind Kind, bool WithBarycentrics>
class LinearRow
{
public:
  LinearRow(TriangleSolver& solver, int row)
    : Solver(solver)
    , V(row + 0.5)
    , Dy(solver.lens().directionY(V))
    , Skew(solver.lens().Skew * Dy)
    , SkewX(std::abs(Skew * solver.lens().InverseFx))
  {
  }
  PlanePoint point(int column, const Hit& hit)
  {
    PlanePoint point;
    if (!this->Last || this->Last->hit != hit)
    {
      this->Last = &this->Solver.plane(hit);
    }
    const double u = column + 0.5;
    if (this->Last->state != Plane::State::None &&
        !evaluate<Kind, WithBarycentrics>(
          *this->Last, this->Solver.lens().directionX(u, this->Skew), this->Dy, this->SkewX, point))
    {
      point = this->Solver.exactPoint(hit, u, this->V);
    }
    return point;
  }

private:
  TriangleSolver& Solver;
  double V;
  double Dy;
  double Skew;
  double SkewX;
  const Plane* Last = nullptr;
};

template <LensKind Kind, bool WithBarycentrics>
void linearRow(TriangleSolver& solver, const PixelRect& rect, int row, const Hit* hits, double* t, double* barycentrics)
{
  LinearRow<Kind, WithBarycentrics> pixels(solver, row);
  for (int i = 0; i < rect.width; ++i)
  {
    const PlanePoint point = hits[i].object != 0 ? pixels.point(rect.x + i, hits[i]) : PlanePoint();
    t[i] = point.t;
    if (WithBarycentrics)
    {
      barycentrics[2 * i] = point.second;
      barycentrics[2 * i + 1] = point.third;
    }
  }
}

template <LensKind Kind>
void linearLists(TriangleSolver& solver, const PixelRect& rect, const std::uint32_t* first, const Hit* hits, double* t)
{
  const std::uint32_t start = *first;
  std::uint32_t i = 0;
  for (int y = rect.y; y < rect.y + rect.height; ++y)
  {
    LinearRow<Kind, false> pixels(solver, y);
    for (int x = rect.x; x < rect.x + rect.width; ++x)
    {
      for (const std::uint32_t end = *++first - start; i < end; ++i)
      {
        t[i] = pixels.point(x, hits[i]).t;
      }
    }
  }
}

void generalRows(
  TriangleSolver& solver, const Hit* hits, const std::vector<CameraRay>& rays, double* t, double* barycentrics)
{
  for (std::size_t i = 0; i < rays.size(); ++i)
  {
    const PlanePoint point =
      hits[i].object != 0 ? solver.pointOnRay(hits[i], rays[i], barycentrics != nullptr) : PlanePoint{};
    t[i] = point.t;
    if (barycentrics)
    {
      barycentrics[2 * i] = point.second;
      barycentrics[2 * i + 1] = point.third;
    }
  }
}

/// Through the centres of the pixels.
void raysOf(const CameraModel& model, const PixelRect& rect, std::vector<CameraRay>& rays)
{
  const std::size_t width = std::size_t(rect.width);
  std::vector<Eigen::Vector2d> centres(width);
  rays.resize(width * std::size_t(rect.height));
  for (int y = 0; y < rect.height; ++y)
  {
    for (int x = 0; x < rect.width; ++x)
    {
      centres[std::size_t(x)] = { rect.x + x + 0.5, rect.y + y + 0.5 };
    }
    model.raysThrough(centres.data(), width, rays.data() + std::size_t(y) * width);
  }
}

} // namespace

SurfacePoint surfacePointAt(const SceneState& state, const View& view, const Eigen::Vector2d& pixel, const Hit& hit)
{
  if (view.instants)
  {
    const SeenInstant now = instantOf(view, view.model->timeAt(pixel));
    return surfacePointAt(*now.state, now.view, pixel, hit);
  }
  TriangleSolver solver(state, view);
  const PlanePoint point = solver.point(hit, pixel.x(), pixel.y(), true);
  return { point.t, { point.second, point.third } };
}

void computeSurfaceRows(const SceneState& state, const View& view, const PixelRect& rect, const Hit* hits,
  bool barycentrics, SurfaceRows& rows)
{
  const std::size_t pixels = std::size_t(rect.width) * rect.height;
  rows.state = &state;
  rows.view = &view;
  rows.rect = rect;
  rows.hits = hits;
  rows.t.resize(pixels);
  rows.barycentrics.resize(barycentrics ? 2 * pixels : 0);
  TriangleSolver solver(state, view);
  const LensKind kind = solver.lens().Kind;
  double* const coordinates = barycentrics ? rows.barycentrics.data() : nullptr;
  rows.rays.clear();
  if (kind == LensKind::General)
  {
    raysOf(*view.model, rect, rows.rays);
    generalRows(solver, hits, rows.rays, rows.t.data(), coordinates);
    return;
  }
  const auto body =
    kind == LensKind::Perspective
      ? (barycentrics ? linearRow<LensKind::Perspective, true> : linearRow<LensKind::Perspective, false>)
      : (barycentrics ? linearRow<LensKind::Parallel, true> : linearRow<LensKind::Parallel, false>);
  for (int y = 0; y < rect.height; ++y)
  {
    const std::size_t first = std::size_t(y) * rect.width;
    body(
      solver, rect, rect.y + y, hits + first, rows.t.data() + first, coordinates ? coordinates + 2 * first : nullptr);
  }
}

void computeSurfaceLists(const SceneState& state, const View& view, const PixelRect& rect, const std::uint32_t* first,
  const Hit* hits, std::vector<double>& t)
{
  const std::size_t pixels = std::size_t(rect.width) * std::size_t(rect.height);
  t.resize(first[pixels] - first[0]);
  TriangleSolver solver(state, view);
  const LensKind kind = solver.lens().Kind;
  if (kind != LensKind::General)
  {
    (kind == LensKind::Perspective ? linearLists<LensKind::Perspective> : linearLists<LensKind::Parallel>)(solver, rect,
      first, hits, t.data());
    return;
  }
  std::vector<CameraRay> rays;
  raysOf(*view.model, rect, rays);
  for (std::size_t i = 0; i < pixels; ++i)
  {
    for (std::uint32_t k = first[i] - first[0]; k < first[i + 1] - first[0]; ++k)
    {
      t[k] = solver.pointOnRay(hits[k], rays[i], false).t;
    }
  }
}

void forSurfaceRows(const SceneState& state, const View& view, const PixelRect& rect, const Hit* hits,
  bool barycentrics, const std::function<void(const SurfaceRows&)>& body)
{
  SurfaceRows rows;
  if (!view.instants)
  {
    computeSurfaceRows(state, view, rect, hits, barycentrics, rows);
    body(rows);
    return;
  }
  std::vector<Hit> own;
  for (const TimedRect& part : timedRects(*view.model, rect))
  {
    own.clear();
    for (int y = part.rect.y; y < part.rect.y + part.rect.height; ++y)
    {
      const Hit* const first = hits + std::size_t(y - rect.y) * rect.width + (part.rect.x - rect.x);
      own.insert(own.end(), first, first + part.rect.width);
    }
    const SeenInstant now = instantOf(view, part.time);
    computeSurfaceRows(*now.state, now.view, part.rect, own.data(), barycentrics, rows);
    body(rows);
  }
}

} // namespace dgtk
