// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRaySource.h"

#include "dgtkInstantSource.h"
#include "dgtkMovingOccluders.h"
#include "dgtkOccluderTracer.h"
#include "dgtkRayScene.h"
#include "dgtkWorkTime.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <shared_mutex>

namespace dgtk
{

namespace
{
/// Scenes kept placed, by pose of the camera.
constexpr std::size_t mostPoses = 16;
constexpr std::size_t mostMoving = 2; ///< by instants
/// All surfaces that single precision finds along up to 16 rays, a list a ray.
void collectCandidates(
  const RayScene& scene, const ExactRay* rays, std::size_t count, bool coherent, std::vector<Hit>* candidates)
{
  RayContext context;
  rtcInitIntersectContext(&context.context);
  context.context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  context.context.filter = rayFilter;
  context.scene = &scene;
  context.mode = RayContext::Mode::Collect;
  context.found = candidates;
  traceRays(scene, rays, (1U << count) - 1, context);
}

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
    this->allHits(view, &pixel, 1, &hits);
  }

  void allHits(
    const View& view, const Eigen::Vector2d* pixels, std::size_t count, std::vector<Hit>* hits) const override
  {
    for (std::size_t first = 0; view.instants && first < count;)
    {
      const double time = view.model->timeAt(pixels[first]);
      std::size_t last = first + 1;
      while (last < count && view.model->timeAt(pixels[last]) == time)
      {
        ++last;
      }
      const SeenInstant now = instantOf(view, time);
      this->allHitsIn(
        *this->scene(now.state, now.view.camera_from_world), now.view, pixels + first, last - first, hits + first);
      first = last;
    }
    if (!view.instants)
    {
      this->allHitsIn(*this->scene(this->State, view.camera_from_world), view, pixels, count, hits);
    }
  }

  static void allHitsIn(
    const RayScene& scene, const View& view, const Eigen::Vector2d* pixels, std::size_t count, std::vector<Hit>* hits)
  {
    const WorkTime time(WorkStage::Trace);
    const bool coarse = isCoarse(scene, view);
    constexpr std::size_t lanes = OccluderTracer::lanes;
    ExactRay rays[lanes];
    std::vector<Hit> candidates[lanes];
    std::vector<RayHit> found;
    std::optional<SeenTriangles> triangles;
    if (count > 1)
    {
      triangles.emplace(scene);
    }
    for (std::size_t first = 0; first < count; first += lanes)
    {
      const std::size_t many = std::min(count - first, lanes);
      for (std::size_t i = 0; i < many; ++i)
      {
        rays[i] = rayOf(view, pixels[first + i]);
        candidates[i].clear();
      }
      if (!coarse)
      {
        collectCandidates(scene, rays, many, isCoherent(view), candidates);
      }
      for (std::size_t i = 0; i < many; ++i)
      {
        if (coarse)
        {
          scene.collectExactly(rays[i], false, found);
        }
        else
        {
          settleHits(scene, rays[i], false, triangles ? &*triangles : nullptr, candidates[i], found);
        }
        hits[first + i].clear();
        for (const RayHit& hit : found)
        {
          hits[first + i].push_back(hit.hit);
        }
      }
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
    const WorkTime time(WorkStage::Trace);
    OccluderTracer tracer(this->scene(this->State, view.camera_from_world), view);
    for (std::size_t first = 0; first < count; first += OccluderTracer::lanes)
    {
      tracer.trace(x_in_world + first, targets + first, std::min(count - first, OccluderTracer::lanes), found + first);
    }
  }

  void occludersAt(const View& view, const double* frames, const Eigen::Vector3d* x_in_world, const Hit* targets,
    std::size_t count, Hit* found) const override
  {
    this->moving(view)->trace(view, frames, x_in_world, targets, count, found);
  }

private:
  std::shared_ptr<const MovingOccluders> moving(const View& view) const
  {
    const std::unique_lock<std::shared_mutex> lock(this->Lock);
    for (const std::shared_ptr<const MovingOccluders>& known : this->Moving)
    {
      if (known->isOf(view))
      {
        return known;
      }
    }
    if (this->Moving.size() == mostMoving)
    {
      this->Moving.erase(this->Moving.begin());
    }
    this->Moving.push_back(std::make_shared<const MovingOccluders>(this->Device, view));
    return this->Moving.back();
  }

  std::shared_ptr<const RayScene> scene(const std::shared_ptr<const SceneState>& state, const Rigid3& pose) const
  {
    const auto find = [&]() -> std::shared_ptr<const RayScene>
    {
      const auto it = std::find_if(this->Scenes.begin(), this->Scenes.end(),
        [&](const auto& s) { return &s->state() == state.get() && samePose(s->pose(), pose); });
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
    placed->place(state, pose);
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
  mutable std::vector<std::shared_ptr<const MovingOccluders>> Moving;
};

} // namespace

std::unique_ptr<OcclusionQuery> makeOcclusionQuery() { return std::make_unique<EmbreeQuery>(); }

} // namespace dgtk
