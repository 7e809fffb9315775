// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSeenSurfaces_h
#define dgtkSeenSurfaces_h

#include "dgtkSceneState.h"

#include <Eigen/Geometry>

#include <functional>
#include <vector>

namespace dgtk
{

/// A convex polygon, world frame.
using Polygon = std::vector<Eigen::Vector3d>;

/// Cuts off where plane . (x, 1) < 0 (Sutherland and Hodgman 1974). `spare` is any polygon, whose memory is used.
void cutPolygon(Polygon& polygon, const Eigen::Vector4d& plane, Polygon& spare);

/// What lies in the frustum of a camera's whole image, and a little around it for the pixel filters, hidden or not.
class SeenSurfaces
{
public:
  /// Throws UsageError for a camera that is not linear.
  explicit SeenSurfaces(const View& view);

  /// Depth in the camera frame.
  double depthOf(const Eigen::Vector3d& x_in_world) const { return this->Depth.dot(x_in_world.homogeneous()); }
  /// Height of the image at a depth, scene units.
  double heightAt(double depth) const { return this->Perspective ? this->Height * depth : this->Height; }
  /// Visits all triangles, cut to the frustum and at the depths 2^(k / 2): slice k is from there to the next one.
  void visit(const SceneState& state, const std::function<void(int slice, const Polygon&)>& visitor);

private:
  void visitTriangle(const std::function<void(int slice, const Polygon&)>& visitor);

  bool Perspective;
  double Height; // of the image, at depth 1 for a perspective
  Eigen::Vector4d Depth;
  Eigen::Matrix<double, 6, 4> Sides; // of the frustum, positive inside
  Polygon Whole;
  Polygon Part;
  Polygon Spare;
};

} // namespace dgtk

#endif
