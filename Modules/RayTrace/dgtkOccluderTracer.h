// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkOccluderTracer_h
#define dgtkOccluderTracer_h

#include "dgtkRayScene.h"

#include <memory>

namespace dgtk
{

/// Whether single precision is too coarse for the pixels of a view: its error is above 1/16 of one, as in an image
/// 30,000 pixels wide. Rays are followed in double precision then.
bool isCoarse(const RayScene& scene, const View& view);

/// The first surface on a ray that is not `target`; object 0 when there is none. `coarse`: see isCoarse().
Hit nearestOnRay(const RayScene& scene, const ExactRay& ray, const Hit& target, bool coarse);

/// What stands between a camera and points, up to 16 at a time. One thread.
class OccluderTracer
{
public:
  static constexpr std::size_t lanes = 16;

  OccluderTracer(std::shared_ptr<const RayScene> scene, const View& view);

  /// OcclusionQuery::occluder() of `count` <= 16 points; what is found for one does not depend on the others. `poses`:
  /// camera_from_world of each, where they are others than that of the scene.
  void trace(const Eigen::Vector3d* x_in_world, const Hit* targets, std::size_t count, Hit* found,
    const Rigid3* poses = nullptr);
  /// The ray that trace() asked last for a point, in the frame of the scene; null where there is none.
  const ExactRay* rayOfLane(std::size_t i) const { return (this->Active >> i & 1U) != 0 ? &this->Rays[i] : nullptr; }

private:
  /// Sets the lanes' rays, from the camera through the points and a little less far; returns the bits of those that
  /// there are.
  unsigned int aim(const Eigen::Vector3d* x_in_world, std::size_t count, const Rigid3* poses);
  std::shared_ptr<const RayScene> Scene;
  const View& TheView;
  bool Coarse;
  bool Central;
  SeenTriangles Triangles;
  RayContext Context;
  unsigned int Active = 0; ///< bits of the lanes that have a ray
  ExactRay Rays[lanes];
  // Of the points, in the frame of the camera.
  Eigen::Vector3d Points[lanes];
  Eigen::Vector2d Pixels[lanes];
  std::uint8_t Seen[lanes];
  CameraRay CameraRays[lanes];
};

} // namespace dgtk

#endif
