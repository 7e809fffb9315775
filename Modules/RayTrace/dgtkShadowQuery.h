// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkShadowQuery_h
#define dgtkShadowQuery_h

#include "dgtkRayTraceModule.h"

#include "dgtkVisibility.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>

namespace dgtk
{

/// The way from a point of a surface to a light, in the frame of a camera, scene units.
struct LightPath
{
  Eigen::Vector3d origin;    ///< off its surface by more than ShadowQuery::precision()
  Eigen::Vector3d direction; ///< unit vector
  double length = std::numeric_limits<double>::infinity();
};

/// Asks what stands in the light of a scene at one instant. In single precision, which shadows need no more than,
/// but where lengths are beyond it.
/// Thread-safe.
class DGTKRAYTRACE_EXPORT ShadowQuery
{
public:
  static constexpr std::size_t mostPaths = 16;
  virtual ~ShadowQuery() = default;
  /// Bit i is set when something opaque stands in path i of `count` <= mostPaths; missing texels of cut-outs do not,
  /// nor do translucent surfaces. Those that follow each other should be neighbours.
  virtual unsigned int blocked(const LightPath* paths, std::size_t count) const = 0;
  /// How far off the surface of an object may be, at a distance from the camera.
  virtual double precision(std::uint32_t object, double distance) const = 0;
};

/// Of a state, for paths in the frame of `camera_from_world`. What the scene's other engines have built is shared.
/// Throws MachineError when Embree cannot work (no memory).
DGTKRAYTRACE_EXPORT std::shared_ptr<const ShadowQuery> makeShadowQuery(
  const std::shared_ptr<const SceneState>& state, const Rigid3& camera_from_world);

} // namespace dgtk

#endif
