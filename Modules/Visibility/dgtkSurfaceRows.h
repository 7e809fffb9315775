// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSurfaceRows_h
#define dgtkSurfaceRows_h

#include "dgtkVisibility.h"

#include <Eigen/Core>

#include <functional>
#include <limits>
#include <vector>

namespace dgtk
{

/// What is computed once per pixel and shared by all representations of a strip of full-width rows: the exact
/// intersection, in double precision, of the ray through the pixel's centre with the plane of the triangle that it
/// hits.
struct SurfaceRows
{
  const SceneState* state = nullptr;
  const View* view = nullptr;
  PixelRect rect;            ///< full-width rows, or a part of them that is seen at one instant
  const Hit* hits = nullptr; ///< rect.width * rect.height
  /// Parameter t of CameraModel::rayThrough(pixel centre) at the surface; for linear cameras the depth. +inf where
  /// there is nothing.
  std::vector<double> t;
  /// Barycentric coordinates of the triangle's second and third corner, perspective-correct, 2 per pixel; empty unless
  /// asked for. NaN where there is nothing.
  std::vector<double> barycentrics;
  /// Rays through the pixels' centres, one a pixel; empty for linear cameras.
  std::vector<CameraRay> rays;
};

/// Computes `t` and `rays`, and `barycentrics` when wanted, of rows. Thread-safe.
DGTKVISIBILITY_EXPORT void computeSurfaceRows(const SceneState& state, const View& view, const PixelRect& rect,
  const Hit* hits, bool barycentrics, SurfaceRows& rows);

/// Gets computeSurfaceRows() of the parts of full-width rows, which are seen at one instant each: of a view without
/// `instants` they are one part. Takes `hits` of all rows. Thread-safe.
DGTKVISIBILITY_EXPORT void forSurfaceRows(const SceneState& state, const View& view, const PixelRect& rect,
  const Hit* hits, bool barycentrics, const std::function<void(const SurfaceRows&)>& body);

/// SurfaceRows::t of any number of surfaces along the ray of each pixel of `rect`: those of pixel i, rows top to
/// bottom, are hits[first[i] - first[0]] up to hits[first[i + 1] - first[0]]. A view without `instants`. Thread-safe.
DGTKVISIBILITY_EXPORT void computeSurfaceLists(const SceneState& state, const View& view, const PixelRect& rect,
  const std::uint32_t* first, const Hit* hits, std::vector<double>& t);

/// Where the ray through an image point meets the plane of a triangle.
struct SurfacePoint
{
  /// As SurfaceRows::t; +inf where the ray misses the plane.
  double t = std::numeric_limits<double>::infinity();
  Eigen::Vector2d barycentrics{ 0, 0 }; ///< of the second and third corner
};

/// The same as computeSurfaceRows() for one image point (pixels, need not be a pixel's centre), of a view with
/// `instants` in the scene of the point's own time. hit.object != 0. Thread-safe.
DGTKVISIBILITY_EXPORT SurfacePoint surfacePointAt(
  const SceneState& state, const View& view, const Eigen::Vector2d& pixel, const Hit& hit);

/// World position of the corners of the triangle of `hit` (object != 0).
DGTKVISIBILITY_EXPORT void triangleInWorld(const SceneState& state, const Hit& hit, Eigen::Vector3d corners[3]);

/// Whether a point of a triangle of the instance is a missing texel: its material is cut out and the texel in column
/// floor(u w) mod w and, from the bottom, row floor(v h) mod h has alpha below 128. `barycentrics` of the second and
/// third corner. The one rule of all engines. Thread-safe.
DGTKVISIBILITY_EXPORT bool isCutOut(
  const Instance& instance, std::uint32_t triangle, const Eigen::Vector2d& barycentrics);

/// Settles the pixels of a drawn buffer at which drawing may be wrong: those whose centre is within 1/64 pixel of an
/// edge of any triangle between near and far; where a triangle that was not drawn is not clearly behind the one that
/// was (by 4e-6 of the depth); where the texel of what was drawn is missing; and where a surface is at near or far but
/// for 2e-6 of it. They get the nearest surface of all triangles that contain the centre (edges included) within near
/// and far (both included), at a texel that is there, in exact arithmetic (nearest within a relative 1e-12: the lowest
/// object, then triangle), or none. Triangles without area are never hit. Linear cameras. Returns how many pixels
/// changed.
DGTKVISIBILITY_EXPORT std::size_t settleEdges(const SceneState& state, const View& view, VisibilityBuffer& buffer);

} // namespace dgtk

#endif
