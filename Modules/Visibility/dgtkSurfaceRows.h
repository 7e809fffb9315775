// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSurfaceRows_h
#define dgtkSurfaceRows_h

#include "dgtkVisibility.h"

#include <Eigen/Core>

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

/// World position of the corners of the triangle of `hit` (object != 0).
DGTKVISIBILITY_EXPORT void triangleInWorld(const SceneState& state, const Hit& hit, Eigen::Vector3d corners[3]);

/// Settles pixels whose recorded triangle does not contain the pixel's centre in exact arithmetic, from the triangles
/// of the neighbouring pixels of the buffer. `grazingOnly`: only those where the plane of the triangle would give a
/// depth outside the triangle's own range; used for raster buffers, whose colours are to stay with their labels.
/// Returns how many pixels changed.
DGTKVISIBILITY_EXPORT std::size_t settleEdges(
  const SceneState& state, const View& view, VisibilityBuffer& buffer, bool grazingOnly);

} // namespace dgtk

#endif
