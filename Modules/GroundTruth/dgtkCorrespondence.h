// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkCorrespondence_h
#define dgtkCorrespondence_h

#include "dgtkGroundTruthModule.h"

#include "dgtkSurfaceRows.h"

#include <Eigen/Core>

#include <cstdint>

namespace dgtk
{

/// What becomes of a surface point in another view; the values of class images.
enum class VisibilityClass : std::uint8_t
{
  NoSurface = 0, ///< in the first view, or no longer: its object is not visible at the other time
  Visible = 1,
  OccludedByOther = 2, ///< another object stands before it
  OccludedByOwn = 3,   ///< its own object stands before it
  Outside = 4,         ///< beside the image, or nearer than near, or farther than far
  Behind = 5           ///< on no ray of the camera
};

/// A view of a scene, maybe at another time; the objects are those of the first view's scene.
struct OtherView
{
  const SceneState* state = nullptr; ///< of a view with `instants` it is not used
  View view;
  const OcclusionQuery* occlusion = nullptr; ///< of `state`; null: what is in view counts as visible
};

/// Where a surface point is in another view.
struct Correspondence
{
  /// Image point in pixels, the top-left corner of the image is (0, 0); NaN for Behind, and for NoSurface
  /// in the first view.
  Eigen::Vector2d pixel{ std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN() };
  VisibilityClass visibility = VisibilityClass::NoSurface;
};

/// World position, in a state, of a point of a triangle: it keeps its barycentric coordinates (of the second and third
/// corner) while vertices and object move. hit.object != 0.
DGTKGROUNDTRUTH_EXPORT Eigen::Vector3d carriedPoint(
  const SceneState& state, const Hit& hit, const Eigen::Vector2d& barycentrics);

/// The point of a triangle in another view. One ray from the camera to the point itself decides what hides it; the
/// triangle never hides its own points, and surfaces that coincide do not hide each other. Thread-safe.
DGTKGROUNDTRUTH_EXPORT Correspondence correspond(
  const OtherView& other, const Hit& hit, const Eigen::Vector2d& barycentrics);

/// A point that is fixed on its triangle.
struct FixedPoint
{
  Hit hit;                              ///< object != 0
  Eigen::Vector2d barycentrics{ 0, 0 }; ///< of the second and third corner
};

/// correspond() for many points, `found` as many. Quicker; those that follow each other should be neighbours.
DGTKGROUNDTRUTH_EXPORT void correspondPoints(
  const OtherView& other, const FixedPoint* points, std::size_t count, Correspondence* found);

/// The correspondence of an image point of `view` (pixels, anywhere inside the image); `occlusion` is of `state`.
/// `hit`, when given, receives the surface of the first view.
DGTKGROUNDTRUTH_EXPORT Correspondence correspondPixel(const SceneState& state, const View& view,
  const OcclusionQuery& occlusion, const Eigen::Vector2d& pixel, const OtherView& other, Hit* hit = nullptr);

/// correspond() for every pixel of rows whose barycentrics are computed: `pixels` gets 2, `classes` 1 value each.
DGTKGROUNDTRUTH_EXPORT void correspondRows(
  const SurfaceRows& in, const OtherView& other, double* pixels, std::uint8_t* classes);

/// Motion of the surface points of rows (barycentrics computed) to the scene of the next view:
/// camera_from_world.rotation * (X(next) - X), scene units, axes of the camera of the rows; 3 values a pixel, NaN where
/// there is nothing. Of a next view with `instants` until the point is seen there; NaN where it is not, at any time.
DGTKGROUNDTRUTH_EXPORT void sceneFlowRows(const SurfaceRows& in, const OtherView& next, double* motion);

} // namespace dgtk

#endif
