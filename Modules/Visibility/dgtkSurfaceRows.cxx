// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceRows.h"

#include "dgtkInstantSource.h"
#include "dgtkTriangleSolver.h"

#include <algorithm>

namespace dgtk
{

namespace
{

/// A row of a linear lens: affine directions, no virtual call.
template <LensKind Kind, bool WithBarycentrics>
void linearRow(TriangleSolver& solver, const PixelRect& rect, int row, const Hit* hits, double* t, double* barycentrics)
{
  const Lens& lens = solver.lens();
  const double v = row + 0.5;
  const double dy = lens.directionY(v);
  const double skew = lens.Skew * dy;
  const double skewX = std::abs(skew * lens.InverseFx);
  const Plane* plane = nullptr;
  for (int i = 0; i < rect.width; ++i)
  {
    PlanePoint point;
    if (hits[i].object != 0)
    {
      if (!plane || plane->hit != hits[i])
      {
        plane = &solver.plane(hits[i]);
      }
      const double u = rect.x + i + 0.5;
      if (plane->state != Plane::State::None &&
          !evaluate<Kind, WithBarycentrics>(*plane, lens.directionX(u, skew), dy, skewX, point))
      {
        point = solver.exactPoint(hits[i], u, v);
      }
    }
    t[i] = point.t;
    if (WithBarycentrics)
    {
      barycentrics[2 * i] = point.second;
      barycentrics[2 * i + 1] = point.third;
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
