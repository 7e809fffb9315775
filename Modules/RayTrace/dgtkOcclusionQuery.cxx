// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRaySource.h"

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
/// Part of the distance that keeps the surface around a point from hiding it.
constexpr double pointSlack = 1e-9;

/// Pixels: with a larger error of single precision, rays are looked around at once; an image that needs it is 30,000
/// pixels wide.
constexpr double coarseError = 1.0 / 16;

bool isCoarse(const RayScene& scene, const View& view) { return scene.errorInPixels(view) > coarseError; }

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
    std::vector<std::shared_ptr<const RayMesh>> meshes;
    for (const Instance& instance : state->instances)
    {
      meshes.push_back(this->Device->mesh(instance, false));
    }
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
    const Eigen::Vector3d x = view.camera_from_world * x_in_world;
    Eigen::Vector2d pixel;
    if (!view.model->project(x, pixel))
    {
      return {};
    }
    ExactRay ray = rayOf(view, pixel);
    const double t = (x - ray.origin).dot(ray.direction) / ray.direction.squaredNorm();
    ray.direction = (x - ray.origin) / t; // through the point, whatever the projection's rounding
    ray.most = t * (1 - pointSlack);
    if (!(ray.most > ray.least))
    {
      return {};
    }
    const std::shared_ptr<const RayScene> scene = this->scene(view.camera_from_world);
    return nearest(*scene, ray, target, isCoarse(*scene, view));
  }

private:
  static Hit nearest(const RayScene& scene, const ExactRay& ray, const Hit& skip, bool nearby)
  {
    RayContext context;
    rtcInitIntersectContext(&context.context);
    context.scene = &scene;
    context.mode = RayContext::Mode::Checked;
    context.context.filter = rayFilter;
    context.ray = &ray;
    context.skip = skip;
    context.marginal = nearby;
    context.t[0] = INFINITY;
    alignas(16) RTCRayHit query = makeQuery(ray);
    rtcIntersect1(scene.handle(), &context.context, &query);
    if (!context.marginal)
    {
      return context.best[0];
    }
    std::vector<RayHit> found;
    collectHits(scene, ray, true, found);
    const auto first = std::find_if(found.begin(), found.end(), [&](const RayHit& hit) { return hit.hit != skip; });
    return first == found.end() ? Hit{} : first->hit;
  }

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
