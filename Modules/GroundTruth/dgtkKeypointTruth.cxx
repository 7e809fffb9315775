// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkKeypointTruth.h"

#include "dgtkInView.h"
#include "dgtkSeenInTime.h"

namespace dgtk
{

namespace
{
class KeypointSight
{
public:
  KeypointSight(const SceneState& state, std::uint32_t id, const View& view, const OcclusionQuery& occlusion)
    : TheInstance(state.instances[id - 1])
    , Id(id)
    , TheView(view)
    , Occlusion(occlusion)
  {
  }

  SeenKeypoint see(std::size_t index, double depth) const
  {
    const SeenInTime seen = this->TheView.instants ? this->seenLater(index) : this->seenNow(index);
    SeenKeypoint point;
    point.x_in_camera = seen.seen ? seen.x_in_camera : this->inCameraNow(index);
    if (seen.seen)
    {
      point.pixel = seen.pixel;
    }
    point.visibility = this->classOf(seen, depth);
    return point;
  }

private:
  Eigen::Vector3d inWorldNow(std::size_t index) const
  {
    return this->TheInstance.world_from_object * this->TheInstance.keypoints[index].x_in_object;
  }
  Eigen::Vector3d inCameraNow(std::size_t index) const
  {
    return this->TheView.camera_from_world * this->inWorldNow(index);
  }

  SeenInTime seenNow(std::size_t index) const
  {
    SeenInTime seen;
    seen.x_in_world = this->inWorldNow(index);
    seen.x_in_camera = this->inCameraNow(index);
    seen.seen = this->TheView.model->project(seen.x_in_camera, seen.pixel);
    return seen;
  }
  SeenInTime seenLater(std::size_t index) const
  {
    const InstantSource& instants = *this->TheView.instants;
    return seenInTime(this->TheView,
      [&](double frame)
      {
        const Instance instance = instants.instanceAt(frame, this->Id);
        return InstantSource::Point{ instance.world_from_object * instance.keypoints[index].x_in_object,
          instants.poseAt(frame) };
      });
  }

  VisibilityClass classOf(const SeenInTime& seen, double depth) const
  {
    const bool rolls = this->TheView.instants != nullptr;
    const bool isThere =
      rolls && seen.seen ? this->TheView.instants->isVisibleAt(seen.frame, this->Id) : this->TheInstance.visible;
    if (!isThere)
    {
      return VisibilityClass::NoSurface;
    }
    if (!seen.seen)
    {
      return VisibilityClass::Behind;
    }
    if (!isInView(this->TheView, this->TheView.model->linear().has_value(), seen.x_in_camera, seen.pixel))
    {
      return VisibilityClass::Outside;
    }
    const Hit before = this->hitBefore(seen, depth);
    return before.object == 0          ? VisibilityClass::Visible
           : before.object == this->Id ? VisibilityClass::OccludedByOwn
                                       : VisibilityClass::OccludedByOther;
  }

  /// What stands between the camera and the place `depth` in front of the point.
  Hit hitBefore(const SeenInTime& seen, double depth) const
  {
    const CameraRay ray = this->TheView.model->rayThrough(seen.pixel);
    const double t = alongRay(seen.x_in_camera, ray) - depth / ray.direction.norm();
    if (!(t > this->TheView.near))
    {
      return {};
    }
    const Rigid3 camera_from_world =
      this->TheView.instants ? this->TheView.instants->poseAt(seen.frame) : this->TheView.camera_from_world;
    const Eigen::Vector3d x_in_world = camera_from_world.inverse() * Eigen::Vector3d(ray.origin + t * ray.direction);
    const Hit none;
    Hit found;
    if (this->TheView.instants)
    {
      this->Occlusion.occludersAt(this->TheView, &seen.frame, &x_in_world, &none, 1, &found);
      return found;
    }
    return this->Occlusion.occluder(this->TheView, x_in_world, none);
  }

  const Instance& TheInstance;
  std::uint32_t Id;
  const View& TheView;
  const OcclusionQuery& Occlusion;
};
} // namespace

std::vector<SeenKeypoint> seeKeypoints(
  const SceneState& state, std::uint32_t id, const View& view, const OcclusionQuery& occlusion, double depth)
{
  const KeypointSight sight(state, id, view, occlusion);
  std::vector<SeenKeypoint> points;
  for (std::size_t i = 0; i < state.instances[id - 1].keypoints.size(); ++i)
  {
    points.push_back(sight.see(i, depth));
  }
  return points;
}

} // namespace dgtk
