// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRaySource.h"

#include "dgtkOccluderTracer.h"
#include "dgtkRayScene.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <shared_mutex>

namespace dgtk
{

namespace
{
/// Scenes kept placed, by pose of the camera.
constexpr std::size_t mostPoses = 16;
bool samePose(const Rigid3& a, const Rigid3& b) { return a.rotation == b.rotation && a.translation == b.translation; }

class EmbreeQuery final : public OcclusionQuery
{
public:
  EmbreeQuery()
    : Device(RayDevice::shared())
  {
  }

  void setScene(std::shared_ptr<const SceneState> state) override
  {
    if (state == this->State)
    {
      return;
    }
    // The meshes of the state are made, and kept, before those of the last one go.
    std::vector<std::shared_ptr<const RayMesh>> meshes = this->Device->meshes(state->instances, false);
    this->Meshes.swap(meshes);
    this->Scenes.clear();
    this->State = std::move(state);
  }

  void allHits(const View& view, const Eigen::Vector2d& pixel, std::vector<Hit>& hits) const override
  {
    const std::shared_ptr<const RayScene> scene = this->scene(view.camera_from_world);
    std::vector<RayHit> found;
    collectHits(*scene, rayOf(view, pixel), isCoarse(*scene, view), found);
    hits.clear();
    for (const RayHit& hit : found)
    {
      hits.push_back(hit.hit);
    }
  }

  Hit occluder(const View& view, const Eigen::Vector3d& x_in_world, const Hit& target) const override
  {
    Hit found;
    this->occluders(view, &x_in_world, &target, 1, &found);
    return found;
  }

  void occluders(const View& view, const Eigen::Vector3d* x_in_world, const Hit* targets, std::size_t count,
    Hit* found) const override
  {
    OccluderTracer tracer(this->scene(view.camera_from_world), view);
    for (std::size_t first = 0; first < count; first += OccluderTracer::lanes)
    {
      tracer.trace(x_in_world + first, targets + first, std::min(count - first, OccluderTracer::lanes), found + first);
    }
  }

private:
  std::shared_ptr<const RayScene> scene(const Rigid3& pose) const
  {
    const auto find = [&]() -> std::shared_ptr<const RayScene>
    {
      const auto it = std::find_if(
        this->Scenes.begin(), this->Scenes.end(), [&](const auto& s) { return samePose(s->pose(), pose); });
      return it == this->Scenes.end() ? nullptr : *it;
    };
    {
      const std::shared_lock<std::shared_mutex> lock(this->Lock);
      if (std::shared_ptr<const RayScene> known = find())
      {
        return known;
      }
    }
    const std::unique_lock<std::shared_mutex> lock(this->Lock);
    if (std::shared_ptr<const RayScene> known = find())
    {
      return known;
    }
    const auto placed = std::make_shared<RayScene>(this->Device, false);
    placed->place(this->State, pose);
    if (this->Scenes.size() == mostPoses)
    {
      this->Scenes.erase(this->Scenes.begin());
    }
    this->Scenes.push_back(placed);
    return placed;
  }

  std::shared_ptr<RayDevice> Device;
  std::shared_ptr<const SceneState> State;
  std::vector<std::shared_ptr<const RayMesh>> Meshes;
  mutable std::shared_mutex Lock;
  mutable std::vector<std::shared_ptr<const RayScene>> Scenes;
};

} // namespace

std::unique_ptr<OcclusionQuery> makeOcclusionQuery() { return std::make_unique<EmbreeQuery>(); }

} // namespace dgtk
