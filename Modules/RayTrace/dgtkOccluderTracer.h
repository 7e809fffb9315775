// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkOccluderTracer_h
#define dgtkOccluderTracer_h

#include "dgtkRayScene.h"

#include <memory>

namespace dgtk
{

/// Whether single precision is too coarse for the pixels of a view: its error is above 1/16 of one, as in an image
/// 30,000 pixels wide. Rays are looked around at once then.
bool isCoarse(const RayScene& scene, const View& view);

/// What stands between a camera and points, up to 16 at a time. One thread.
class OccluderTracer
{
public:
  static constexpr std::size_t lanes = 16;

  OccluderTracer(std::shared_ptr<const RayScene> scene, const View& view);

  /// OcclusionQuery::occluder() of `count` <= 16 points; what is found for one does not depend on the others.
  void trace(const Eigen::Vector3d* x_in_world, const Hit* targets, std::size_t count, Hit* found);

private:
  /// Sets the lanes' rays, from the camera through the points and a little less far; returns the bits of those that
  /// there are.
  unsigned int aim(const Eigen::Vector3d* x_in_world, std::size_t count);
  /// Where single precision cannot tell.
  Hit traceAround(const ExactRay& ray, const Hit& target) const;

  std::shared_ptr<const RayScene> Scene;
  const View& TheView;
  bool Coarse;
  RayContext Context;
  ExactRay Rays[lanes];
  // Of the points, in the frame of the camera.
  Eigen::Vector3d Points[lanes];
  Eigen::Vector2d Pixels[lanes];
  std::uint8_t Seen[lanes];
  CameraRay CameraRays[lanes];
};

} // namespace dgtk

#endif
