// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSurfaceDistance_h
#define dgtkSurfaceDistance_h

#include "dgtkRayTraceModule.h"

#include "dgtkSceneState.h"

#include <Eigen/Core>

#include <array>
#include <memory>

namespace dgtk
{

/// How far points are from the surfaces of a scene at one instant. Thread-safe once made. Holes that textures cut count
/// as surface; objects that are not visible do not. Embree finds which triangles come into question, what they are away
/// is computed in double precision. Throws MachineError when Embree cannot work (no memory).
class DGTKRAYTRACE_EXPORT SurfaceDistance
{
public:
  explicit SurfaceDistance(std::shared_ptr<const SceneState> state);
  ~SurfaceDistance();
  SurfaceDistance(const SurfaceDistance&) = delete;
  SurfaceDistance& operator=(const SurfaceDistance&) = delete;

  /// Scene units from a point of the world to the nearest surface; infinite when there is none.
  double at(const Eigen::Vector3d& x_in_world) const;

private:
  struct Impl;
  std::unique_ptr<Impl> Self;
};

/// From a point to a triangle.
DGTKRAYTRACE_EXPORT double distanceToTriangle(const Eigen::Vector3d& x, const std::array<Eigen::Vector3d, 3>& corners);

} // namespace dgtk

#endif
