// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMovingOccluders_h
#define dgtkMovingOccluders_h

#include "dgtkInstantSource.h"
#include "dgtkRayScene.h"

#include <memory>
#include <mutex>
#include <vector>

namespace dgtk
{

/// Around what may move of an object, in its own frame.
struct MovingBall
{
  std::uint32_t object = 0;
  Eigen::Vector3d centre{ 0, 0, 0 };
  double radius = 0; ///< of the vertices
};

/// What stands between a camera with a rolling shutter and points, each in the scene of its own time. What does not
/// move is placed once; what moves is placed anew for each point whose ray comes near it. Thread-safe.
class MovingOccluders
{
public:
  MovingOccluders(std::shared_ptr<RayDevice> device, const View& view);
  ~MovingOccluders();

  /// Whether it is of these instants.
  bool isOf(const View& view) const { return this->TheView.instants == view.instants; }
  /// OcclusionQuery::occludersAt().
  void trace(const View& view, const double* frames, const Eigen::Vector3d* x_in_world, const Hit* targets,
    std::size_t count, Hit* found) const;

private:
  MovingBall ballInTime(std::size_t instance) const;
  std::vector<std::uint32_t> near(const ExactRay& ray, double frame) const;
  /// Of some objects, and of the nearest one that does not move.
  Hit nearestMoving(const std::vector<std::uint32_t>& objects, const ExactRay& ray, double frame, const Hit& target,
    const Hit& still) const;

  View TheView; ///< whose pose all scenes are placed for
  std::shared_ptr<RayDevice> Device;
  std::vector<MovingBall> Moving;
  std::shared_ptr<RayScene> Still;
  mutable std::mutex Mutex;
  mutable std::vector<std::unique_ptr<RayScene>> Idle; ///< scenes of what moves
};

} // namespace dgtk

#endif
