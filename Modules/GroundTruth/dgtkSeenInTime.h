// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSeenInTime_h
#define dgtkSeenInTime_h

#include "dgtkGroundTruthModule.h"

#include "dgtkInstantSource.h"
#include "dgtkVisibility.h"

#include <Eigen/Core>

#include <functional>
#include <limits>

namespace dgtk
{

/// When and where a camera with a rolling shutter sees a surface point.
struct SeenInTime
{
  bool seen = false; ///< at some time it is before the camera just when the part of the image is seen that shows it
  double frame = 0;  ///< that time
  /// Also outside the image, which sees what is beside it as its border.
  Eigen::Vector2d pixel{ std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN() };
  Eigen::Vector3d x_in_world{ 0, 0, 0 };
  Eigen::Vector3d x_in_camera{ 0, 0, 0 };
};

/// Finds the time tau at which a moving point X is seen: tau = frame + timeAt(project(camera(tau) X(tau))), by the
/// secant method from the picture's own time, to a residual of 1e-12 of the shutter's duration. Motion that is slower
/// in the image than the shutter has one such time. Of faster motion, which may be seen several times, it is one of
/// them; where neither the secant method nor plain iteration settles, the first one that bisection finds between 64
/// equal steps. `view` has instants; hit.object != 0.
DGTKGROUNDTRUTH_EXPORT SeenInTime seenInTime(const View& view, const Hit& hit, const Eigen::Vector2d& barycentrics);

/// The same of any point: X and the camera at a frame.
using PointAt = std::function<InstantSource::Point(double frame)>;
DGTKGROUNDTRUTH_EXPORT SeenInTime seenInTime(const View& view, const PointAt& pointAt);

} // namespace dgtk

#endif
