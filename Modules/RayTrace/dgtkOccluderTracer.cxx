// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkOccluderTracer.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
/// Part of the distance that keeps the surface around a point from hiding it.
constexpr double pointSlack = 1e-9;
/// Pixels.
constexpr double coarseError = 1.0 / 16;

/// Where single precision cannot tell.
Hit firstAround(const RayScene& scene, const ExactRay& ray, const Hit& target, bool coarse)
{
  std::vector<RayHit> all;
  if (coarse)
  {
    scene.collectExactly(ray, false, all);
  }
  else
  {
    collectHits(scene, ray, true, all);
  }
  const auto first = std::find_if(all.begin(), all.end(), [&](const RayHit& hit) { return hit.hit != target; });
  return first == all.end() ? Hit{} : first->hit;
}
} // namespace

bool isCoarse(const RayScene& scene, const View& view) { return scene.errorInPixels(view) > coarseError; }

Hit nearestOnRay(const RayScene& scene, const ExactRay& ray, const Hit& target, bool coarse)
{
  RayContext context;
  rtcInitIntersectContext(&context.context);
  context.context.filter = rayFilter;
  context.scene = &scene;
  context.mode = RayContext::Mode::Checked;
  context.rays = &ray;
  context.skip = &target;
  context.t[0] = INFINITY;
  if (!coarse)
  {
    traceRays(scene, &ray, 1, context);
  }
  return coarse || context.marginal != 0 ? firstAround(scene, ray, target, coarse) : context.best[0];
}

OccluderTracer::OccluderTracer(std::shared_ptr<const RayScene> scene, const View& view)
  : Scene(std::move(scene))
  , TheView(view)
  , Coarse(isCoarse(*this->Scene, view))
  , Central(view.model->isCentral())
  , Triangles(*this->Scene)
{
  rtcInitIntersectContext(&this->Context.context);
  this->Context.context.flags =
    isCoherent(view) && !view.instants ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  this->Context.context.filter = rayFilter;
  this->Context.scene = this->Scene.get();
  this->Context.mode = RayContext::Mode::Checked;
  this->Context.rays = this->Rays;
  this->Context.triangles = &this->Triangles;
}

unsigned int OccluderTracer::aim(const Eigen::Vector3d* x_in_world, std::size_t count, const Rigid3* poses)
{
  Eigen::Vector3d* const x = this->Points;
  Eigen::Vector2d* const pixels = this->Pixels;
  CameraRay* const rays = this->CameraRays;
  for (std::size_t i = 0; i < count; ++i)
  {
    x[i] = (poses ? poses[i] : this->TheView.camera_from_world) * x_in_world[i];
    pixels[i].setZero();
  }
  this->TheView.model->projectAll(x, count, pixels, this->Seen);
  if (!this->Central)
  {
    this->TheView.model->raysThrough(pixels, count, rays);
  }
  unsigned int active = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    const Eigen::Vector3d origin = this->Central ? Eigen::Vector3d::Zero() : rays[i].origin;
    const Eigen::Vector3d way = x[i] - origin;
    const double t = this->Central ? way.norm() : way.dot(rays[i].direction) / rays[i].direction.squaredNorm();
    const double most = t * (1 - pointSlack);
    this->Rays[i] = { origin, way / t, this->TheView.near, most }; // whatever the projection's rounding
    if (poses)
    {
      const Rigid3 scene_from_camera = this->Scene->pose() * poses[i].inverse();
      this->Rays[i].origin = scene_from_camera * this->Rays[i].origin;
      this->Rays[i].direction = scene_from_camera.rotation * this->Rays[i].direction;
    }
    active |= unsigned(this->Seen[i] != 0 && most > this->TheView.near) << i;
  }
  return active;
}

void OccluderTracer::trace(
  const Eigen::Vector3d* x_in_world, const Hit* targets, std::size_t count, Hit* found, const Rigid3* poses)
{
  const unsigned int active = this->aim(x_in_world, count, poses);
  this->Active = active;
  std::fill(this->Context.t, this->Context.t + lanes, INFINITY);
  std::fill(this->Context.best, this->Context.best + lanes, Hit{});
  this->Context.skip = targets;
  this->Context.marginal = this->Coarse ? active : 0;
  traceRays(*this->Scene, this->Rays, this->Coarse ? 0 : active, this->Context);
  for (std::size_t i = 0; i < count; ++i)
  {
    found[i] = (this->Context.marginal >> i & 1U) != 0
                 ? firstAround(*this->Scene, this->Rays[i], targets[i], this->Coarse)
                 : this->Context.best[i];
  }
}

} // namespace dgtk
