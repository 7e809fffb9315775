// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSight_h
#define dgtkSight_h

#include "dgtkEye.h"
#include "dgtkVisibility.h"

#include <memory>
#include <vector>

namespace dgtk
{

/// A camera and the scene at one frame, with own intersections in double precision. Depths are z in the camera frame.
class Sight
{
public:
  Sight(Eye eye, std::shared_ptr<const SceneState> state, std::shared_ptr<const OcclusionQuery> query);

  const Eye& eye() const { return this->TheEye; }
  const SceneState& state() const { return *this->State; }
  const std::shared_ptr<const SceneState>& statePointer() const { return this->State; }

  /// Depth at which the ray through a pixel meets the plane of a triangle; infinite for no hit or no meeting.
  double depthOf(const Hit& hit, const Eigen::Vector2d& pixel) const;
  /// The same as Eye::range(): of a lens, the distance.
  double rangeOf(const Hit& hit, const Eigen::Vector2d& pixel) const;
  /// All surfaces along a ray with their ranges, near to far.
  void surfaces(const Eigen::Vector2d& pixel, std::vector<Hit>& hits, std::vector<double>& ranges) const;
  /// Weights of the corners of a triangle at a point of its plane, camera frame.
  Eigen::Vector3d weights(const Hit& hit, const Eigen::Vector3d& x_in_camera) const;
  /// Normal of a triangle by the order of its corners, camera frame, not normalised.
  Eigen::Vector3d normal(const Hit& hit) const;
  void corners(const Hit& hit, Eigen::Vector3d out[3]) const;
  const Affine3& cameraFromObject(std::uint32_t object) const { return this->Placed[object - 1]; }
  const Instance& instance(std::uint32_t object) const { return this->State->instances[object - 1]; }

private:
  double along(const Hit& hit, const CameraRay& ray) const;

  Eye TheEye;
  std::shared_ptr<const SceneState> State;
  std::shared_ptr<const OcclusionQuery> Query;
  std::vector<Affine3> Placed;
};

/// A point of a triangle by weights of its corners, world frame.
Eigen::Vector3d pointOf(const Instance& instance, const Hit& hit, const Eigen::Vector3d& weights);

/// A point of an object's surface, carried from one instant to another: by the object's placement where the model is
/// rigid, otherwise by the triangle. World frame. `ok` is false for an object that is flattened.
struct Carried
{
  bool ok = false;
  Eigen::Vector3d x_in_world{ 0, 0, 0 };
};
/// `then`: the object at the other instant.
Carried carried(const Sight& from, const Instance& then, const Hit& hit, const Eigen::Vector3d& x_in_camera);

} // namespace dgtk

#endif
