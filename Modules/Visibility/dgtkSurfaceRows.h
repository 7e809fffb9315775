// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSurfaceRows_h
#define dgtkSurfaceRows_h

#include "dgtkVisibility.h"

#include <Eigen/Core>

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
  PixelRect rect;            ///< x = 0, width = image width
  const Hit* hits = nullptr; ///< rect.width * rect.height
  /// Parameter t of CameraModel::rayThrough(pixel centre) at the surface; for linear cameras the depth. +inf where
  /// there is nothing.
  std::vector<double> t;
  /// Barycentric coordinates of the triangle's second and third corner, perspective-correct, 2 per pixel; empty unless
  /// asked for. NaN where there is nothing.
  std::vector<double> barycentrics;
};

/// Computes `t`, and `barycentrics` when wanted, of rows. Thread-safe.
DGTKVISIBILITY_EXPORT void computeSurfaceRows(const SceneState& state, const View& view, const PixelRect& rect,
  const Hit* hits, bool barycentrics, SurfaceRows& rows);

/// Where the ray through an image point meets the plane of a triangle.
struct SurfacePoint
{
  /// As SurfaceRows::t; +inf where the ray misses the plane.
  double t = std::numeric_limits<double>::infinity();
  Eigen::Vector2d barycentrics{ 0, 0 }; ///< of the second and third corner
};

/// The same as computeSurfaceRows() for one image point (pixels, need not be a pixel's centre). hit.object != 0.
/// Thread-safe.
DGTKVISIBILITY_EXPORT SurfacePoint surfacePointAt(
  const SceneState& state, const View& view, const Eigen::Vector2d& pixel, const Hit& hit);

/// World position of the corners of the triangle of `hit` (object != 0).
DGTKVISIBILITY_EXPORT void triangleInWorld(const SceneState& state, const Hit& hit, Eigen::Vector3d corners[3]);

/// Whether a point of a triangle of the instance is a missing texel: its material is cut out and the texel in column
/// floor(u w) mod w and, from the bottom, row floor(v h) mod h has alpha below 128. `barycentrics` of the second and
/// third corner. The one rule of all engines. Thread-safe.
DGTKVISIBILITY_EXPORT bool isCutOut(
  const Instance& instance, std::uint32_t triangle, const Eigen::Vector2d& barycentrics);

/// Settles pixels whose recorded triangle does not contain the pixel's centre in exact arithmetic, or contains it
/// within 1/64 pixel of its edge, and background pixels beside a surface: of the triangles recorded in the 3 x 3
/// neighbourhood inside the buffer, those that contain the centre (edges included) within near and far, at a texel that
/// is there, the nearest is taken (nearest within a relative 1e-12: the lowest object, then triangle). When there is
/// none the pixel keeps its hit, unless the plane of its triangle would give a depth outside the triangle's own range:
/// then all triangles of the neighbourhood's objects are looked at, and where none contains the centre nothing is
/// there. Triangles without area are never hit. `grazingOnly`: only pixels whose triangle does not
/// contain the centre and whose plane would give a depth outside the triangle's own range; used for raster buffers,
/// whose colours are to stay with their labels. Every decision reads the buffer as it came in; the result does not
/// depend on the order of pixels or on `pool`, whose threads share the work when it is given. Returns how many pixels
/// changed.
DGTKVISIBILITY_EXPORT std::size_t settleEdges(
  const SceneState& state, const View& view, VisibilityBuffer& buffer, bool grazingOnly, ThreadPool* pool = nullptr);

} // namespace dgtk

#endif
