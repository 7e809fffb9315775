// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTimedSight_h
#define dgtkTimedSight_h

#include "dgtkSight.h"

#include "dgtkInstantSource.h"

#include <memory>

namespace dgtk
{

/// A camera at a frame: one sight, or, with a rolling shutter, one at the time of each image point. The law of times is
/// its own arithmetic, but for the times of a table of rays.
class TimedSight
{
public:
  /// `instants`: of the scene's camera; null without rolling shutter. `table`: the model of a table of rays, else null.
  TimedSight(std::shared_ptr<const Sight> middle, std::shared_ptr<const InstantSource> instants,
    std::shared_ptr<const CameraModel> table);

  /// At the picture's own time.
  const std::shared_ptr<const Sight>& middle() const { return this->Middle; }
  bool rolls() const { return this->Instants != nullptr; }
  /// When an image point is seen, frames after the picture's own.
  double timeAt(const Eigen::Vector2d& pixel) const;
  /// At a time; made anew.
  std::shared_ptr<const Sight> at(double time) const;
  Eye eyeAt(double time) const;
  Instance instanceAt(double time, std::uint32_t object) const
  {
    return this->rolls() ? this->Instants->instanceAt(this->Instants->frame() + time, object)
                         : this->Middle->instance(object);
  }
  /// A point of an object's triangle by weights of its corners, world frame.
  Eigen::Vector3d pointAt(double time, const Hit& hit, const Eigen::Vector3d& weights) const;
  /// When a point of an object's triangle is seen, by weights of its corners: plain iteration of time = timeAt(place at
  /// time) from a time that is given. False, with that time, where it does not settle: of what moves as fast as the
  /// shutter, and may be seen several times, and of what is at some time not before the camera.
  bool findTime(const Hit& hit, const Eigen::Vector3d& weights, double& time) const;
  /// Pixels by which the point moves in the time that a file's times may be off: 1e-12 of the shutter's, and rounding;
  /// `more` frames.
  double timeSlack(const Hit& hit, const Eigen::Vector3d& weights, double time, double more) const;
  /// The same of the point itself, in scene units.
  double pointSlack(const Hit& hit, const Eigen::Vector3d& weights, double time) const;

private:
  double timeRounding(double time) const;
  bool placeAt(double time, const Hit& hit, const Eigen::Vector3d& weights, Eigen::Vector2d& pixel) const;
  std::shared_ptr<const Sight> Middle;
  std::shared_ptr<const InstantSource> Instants;
  std::shared_ptr<const CameraModel> Table;
};

} // namespace dgtk

#endif
