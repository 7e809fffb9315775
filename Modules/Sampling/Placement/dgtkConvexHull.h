// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkConvexHull_h
#define dgtkConvexHull_h

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace dgtk
{

/// The half space normal . x <= offset.
struct HalfSpace
{
  Eigen::Vector3d normal{ 0, 1, 0 }; ///< unit length
  double offset = 0;
  double above(const Eigen::Vector3d& x) const { return this->normal.dot(x) - this->offset; }
};

/// The convex hull of points. Points in a plane (to 1e-4 of their size) or fewer than four have no faces and no volume.
struct ConvexHull
{
  std::vector<Eigen::Vector3d> points; ///< its corners; of a flat one all points
  std::vector<HalfSpace> faces;        ///< which it lies in
  double volume = 0;
  double left = 0;                    ///< how far what it stands for may be above its faces: see simplifiedHull()
  std::vector<Eigen::Vector3d> whole; ///< the corners of what it stands for, where it is simplified
};

/// `shrink`: its faces are moved inward by that, at most by a half of what the hull bears.
ConvexHull convexHull(const std::vector<Eigen::Vector3d>& points, double shrink = 0);

/// The hull of some of its corners, above whose faces the others are by no more than `left`, at most `tolerance`.
ConvexHull simplifiedHull(const ConvexHull& hull, double tolerance);

/// A surface cut into pieces whose convex hulls are true to it: no point of the surface lies deeper than `tolerance`
/// below its piece's hull, unless that needed more than `most` pieces. `inside` says which points are within a closed
/// surface: corners of cuts, which no surface has, belong to the pieces then.
std::vector<ConvexHull> convexPieces(const std::vector<Eigen::Vector3d>& points,
  const std::vector<std::array<std::uint32_t, 3>>& triangles, double tolerance, std::size_t most,
  const std::function<bool(const Eigen::Vector3d&)>& inside);

} // namespace dgtk

#endif
