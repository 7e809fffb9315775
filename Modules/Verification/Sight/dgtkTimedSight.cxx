// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTimedSight.h"

#include "dgtkRaySource.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dgtk
{

namespace
{
constexpr int mostTimeSteps = 200;
constexpr double settled = 1e-14;       ///< of a frame
constexpr double timePrecision = 1e-12; ///< of the shutter's time

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

bool TimedSight::placeAt(double time, const Hit& hit, const Eigen::Vector3d& weights, Eigen::Vector2d& pixel) const
{
  const Eye eye = this->eyeAt(time);
  return eye.project(eye.toCamera(this->pointAt(time, hit, weights)), pixel);
}

bool TimedSight::findTime(const Hit& hit, const Eigen::Vector3d& weights, double& time) const
{
  double now = time;
  Eigen::Vector2d pixel;
  for (int step = 0; this->rolls() && step < mostTimeSteps && this->placeAt(now, hit, weights, pixel); ++step)
  {
    const double next = this->timeAt(pixel);
    if (std::abs(next - now) <= settled)
    {
      time = now;
      return true;
    }
    now = next;
  }
  return !this->rolls();
}

/// Frames.
double TimedSight::timeRounding(double time) const
{
  const TimeSpan span =
    this->Table ? this->Table->times() : TimeSpan{ 0, this->Middle->eye().record().rollingShutter.duration };
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  return std::max(timePrecision * (span.last - span.first), rounding * std::abs(this->Instants->frame() + time));
}

double TimedSight::timeSlack(const Hit& hit, const Eigen::Vector3d& weights, double time, double more) const
{
  const double slack = more + this->timeRounding(time);
  Eigen::Vector2d before;
  Eigen::Vector2d after;
  return this->placeAt(time - slack, hit, weights, before) && this->placeAt(time + slack, hit, weights, after)
           ? (after - before).norm()
           : 0;
}

double TimedSight::pointSlack(const Hit& hit, const Eigen::Vector3d& weights, double time) const
{
  const double slack = this->timeRounding(time);
  return (this->pointAt(time + slack, hit, weights) - this->pointAt(time - slack, hit, weights)).norm();
}

} // namespace dgtk
