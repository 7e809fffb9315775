// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMovingOccluders.h"

#include "dgtkOccluderTracer.h"
#include "dgtkWorkTime.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
/// Around the vertices of an object that keeps its shape.
MovingBall ballOf(const Geometry* geometry)
{
  Eigen::AlignedBox3d box;
  for (std::size_t v = 0; geometry && v < geometry->positions.size(); ++v)
  {
    box.extend(geometry->positions[v]);
  }
  return box.isEmpty() ? MovingBall{} : MovingBall{ 0, box.center(), box.diagonal().norm() / 2 };
}
} // namespace

MovingOccluders::MovingOccluders(std::shared_ptr<RayDevice> device, const View& view)
  : TheView(view)
  , Device(std::move(device))
  , Still(std::make_shared<RayScene>(Device, false))
{
  const std::vector<InstantSource::Motion>& motions = view.instants->motions();
  const InstantSource::Instant now = view.instants->at(view.instants->frame());
  for (std::size_t i = 0; i < motions.size(); ++i)
  {
    if (motions[i] == InstantSource::Motion::None)
    {
      continue;
    }
    const bool rigid = motions[i] == InstantSource::Motion::Rigid;
    const MovingBall ball = rigid ? ballOf(now.state->instances[i].geometry.get()) : this->ballInTime(i);
    this->Moving.push_back({ std::uint32_t(i + 1), ball.centre, ball.radius });
  }
  auto still = std::make_shared<SceneState>();
  still->instances = now.state->instances;
  for (const MovingBall& ball : this->Moving)
  {
    still->instances[ball.object - 1] = {};
  }
  this->Still->place(still, view.camera_from_world);
}

MovingOccluders::~MovingOccluders() = default;

/// Around the vertices of an object at all times of the shutter: those of some instants, and as far around as they go
/// from one to the next.
MovingBall MovingOccluders::ballInTime(std::size_t instance) const
{
  constexpr int steps = 32;
  const TimeSpan times = this->TheView.model->times();
  Eigen::AlignedBox3d box;
  double farthest = 0;
  std::shared_ptr<const Geometry> before;
  for (int step = 0; step <= steps; ++step)
  {
    const double time = times.first + (times.last - times.first) * step / steps;
    const std::shared_ptr<const Geometry> geometry =
      this->TheView.instants->instanceAt(this->TheView.instants->frame() + time, std::uint32_t(instance + 1)).geometry;
    for (std::size_t v = 0; geometry && v < geometry->positions.size(); ++v)
    {
      box.extend(geometry->positions[v]);
      farthest = before ? std::max(farthest, (geometry->positions[v] - before->positions[v]).norm()) : farthest;
    }
    before = geometry ? geometry : before;
  }
  return box.isEmpty() ? MovingBall{} : MovingBall{ 0, box.center(), box.diagonal().norm() / 2 + farthest };
}

void MovingOccluders::trace(const View& view, const double* frames, const Eigen::Vector3d* x_in_world,
  const Hit* targets, std::size_t count, Hit* found) const
{
  const WorkTime time(WorkStage::Trace);
  constexpr std::size_t lanes = OccluderTracer::lanes;
  OccluderTracer tracer(this->Still, view);
  Rigid3 poses[lanes];
  for (std::size_t first = 0; first < count; first += lanes)
  {
    const std::size_t many = std::min(count - first, lanes);
    for (std::size_t i = 0; i < many; ++i)
    {
      poses[i] = view.instants->poseAt(frames[first + i]);
    }
    tracer.trace(x_in_world + first, targets + first, many, found + first, poses);
    for (std::size_t i = 0; i < many; ++i)
    {
      const ExactRay* const ray = tracer.rayOfLane(i);
      const std::size_t at = first + i;
      if (!ray)
      {
        continue;
      }
      if (const std::vector<std::uint32_t> near = this->near(*ray, frames[at]); !near.empty())
      {
        found[at] = this->nearestMoving(near, *ray, frames[at], targets[at], found[at]);
      }
    }
  }
}

/// The moving objects that a ray may meet.
std::vector<std::uint32_t> MovingOccluders::near(const ExactRay& ray, double frame) const
{
  constexpr double slack = 1e-9;
  std::vector<std::uint32_t> objects;
  for (const MovingBall& ball : this->Moving)
  {
    const Affine3 place = this->TheView.camera_from_world * this->TheView.instants->placeAt(frame, ball.object);
    const Eigen::Vector3d way = place * ball.centre - ray.origin;
    const Eigen::Matrix3d square = place.linear.transpose() * place.linear;
    const double stretch = std::sqrt(square.cwiseAbs().rowwise().sum().maxCoeff()); // not below the largest
    const double t =
      std::clamp(way.dot(ray.direction) / ray.direction.squaredNorm(), ray.least, std::max(ray.least, ray.most));
    if ((way - t * ray.direction).norm() <= ball.radius * stretch * (1 + slack) + slack * way.norm())
    {
      objects.push_back(ball.object);
    }
  }
  return objects;
}

Hit MovingOccluders::nearestMoving(const std::vector<std::uint32_t>& objects, const ExactRay& ray, double frame,
  const Hit& target, const Hit& still) const
{
  std::unique_ptr<RayScene> scene;
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    if (!this->Idle.empty())
    {
      scene = std::move(this->Idle.back());
      this->Idle.pop_back();
    }
  }
  if (!scene)
  {
    scene = std::make_unique<RayScene>(this->Device, false);
  }
  auto state = std::make_shared<SceneState>();
  state->instances.resize(this->TheView.instants->motions().size());
  for (const std::uint32_t object : objects)
  {
    state->instances[object - 1] = this->TheView.instants->instanceAt(frame, object);
  }
  scene->place(state, this->TheView.camera_from_world);
  const Hit hit = nearestOnRay(*scene, ray, target, isCoarse(*scene, this->TheView));
  Hit nearest = hit.object == 0 ? still : hit;
  if (hit.object != 0 && still.object != 0 &&
      comesBefore(this->Still->intersectTriangle(ray, still).t, still, scene->intersectTriangle(ray, hit).t, hit))
  {
    nearest = still;
  }
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Idle.push_back(std::move(scene));
  return nearest;
}

} // namespace dgtk
