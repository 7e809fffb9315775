// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTimedSight.h"

#include "dgtkRaySource.h"

#include <cmath>

namespace dgtk
{

namespace
{
constexpr int mostTimeSteps = 200;
constexpr double settled = 1e-14; ///< of a frame

double part(double at, int size) { return at <= 0 ? 0 : at >= size ? 1 : at / size; }
} // namespace

TimedSight::TimedSight(std::shared_ptr<const Sight> middle, std::shared_ptr<const InstantSource> instants,
  std::shared_ptr<const CameraModel> table)
  : Middle(std::move(middle))
  , Instants(std::move(instants))
  , Table(std::move(table))
{
}

double TimedSight::timeAt(const Eigen::Vector2d& pixel) const
{
  if (!this->rolls())
  {
    return 0;
  }
  if (this->Table)
  {
    return this->Table->timeAt(pixel);
  }
  const CameraRecord& record = this->Middle->eye().record();
  const double half = 0.5 * record.rollingShutter.duration;
  switch (record.rollingShutter.direction)
  {
    case RollingShutter::Direction::Down:
      return half * (2 * part(pixel.y(), record.height) - 1);
    case RollingShutter::Direction::Up:
      return half * (1 - 2 * part(pixel.y(), record.height));
    case RollingShutter::Direction::Right:
      return half * (2 * part(pixel.x(), record.width) - 1);
    case RollingShutter::Direction::Left:
      return half * (1 - 2 * part(pixel.x(), record.width));
  }
  return 0;
}

Eye TimedSight::eyeAt(double time) const
{
  const Eye& middle = this->Middle->eye();
  return this->rolls() ? middle.movedTo(this->Instants->poseAt(this->Instants->frame() + time)) : middle;
}

std::shared_ptr<const Sight> TimedSight::at(double time) const
{
  if (!this->rolls())
  {
    return this->Middle;
  }
  const InstantSource::Instant now = this->Instants->at(this->Instants->frame() + time);
  std::shared_ptr<OcclusionQuery> query = makeOcclusionQuery();
  query->setScene(now.state);
  return std::make_shared<Sight>(this->eyeAt(time), now.state, std::move(query));
}

Eigen::Vector3d TimedSight::pointAt(double time, const Hit& hit, const Eigen::Vector3d& weights) const
{
  return this->rolls()
           ? this->Instants->pointAt(this->Instants->frame() + time, hit.object, hit.triangle, weights.tail<2>())
               .x_in_world
           : pointOf(this->Middle->instance(hit.object), hit, weights);
}

TimedSight::Search TimedSight::findTime(const Hit& hit, const Eigen::Vector3d& weights, double& time) const
{
  for (int step = 0; this->rolls() && step < mostTimeSteps; ++step)
  {
    const Eye eye = this->eyeAt(time);
    Eigen::Vector2d pixel;
    if (!eye.project(eye.toCamera(this->pointAt(time, hit, weights)), pixel))
    {
      return Search::Behind;
    }
    const double next = this->timeAt(pixel);
    if (std::abs(next - time) <= settled)
    {
      return Search::Settled;
    }
    time = next;
  }
  return this->rolls() ? Search::Unsettled : Search::Settled;
}

} // namespace dgtk
