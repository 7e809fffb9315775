// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSeenInTime.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dgtk
{

namespace
{
constexpr int mostSteps = 12;
constexpr int mostPlainSteps = 60;
constexpr int coarseSteps = 64;
constexpr int mostHalvings = 60;
constexpr double settled = 1e-12; ///< of the shutter's duration
constexpr double jump = 1e-6;     ///< likewise; halving leaves less of what has no gap

class PointInTime
{
public:
  PointInTime(const View& view, const PointAt& pointAt)
    : TheView(view)
    , ThePoint(pointAt)
  {
  }

  /// How much later than tau the image point is seen that shows the point at tau; not-a-number where none does.
  double lateness(double tau)
  {
    const InstantSource::Point point = this->ThePoint(tau);
    this->Seen.frame = tau;
    this->Seen.x_in_world = point.x_in_world;
    this->Seen.x_in_camera = point.camera_from_world * point.x_in_world;
    this->Seen.seen = this->TheView.model->project(this->Seen.x_in_camera, this->Seen.pixel);
    return this->Seen.seen ? this->TheView.instants->frame() - tau + this->TheView.model->timeAt(this->Seen.pixel)
                           : std::numeric_limits<double>::quiet_NaN();
  }

  /// Of the last lateness().
  const SeenInTime& seen() const { return this->Seen; }

private:
  const View& TheView;
  const PointAt& ThePoint;
  SeenInTime Seen;
};

enum class Way
{
  Secant,
  Plain ///< iteration; slower, and goes on where times have corners
};

/// Whether a way from the picture's own time settles within the shutter's time.
bool settles(PointInTime& point, double frame, const TimeSpan& times, double most, Way way)
{
  double before = frame;
  double lateBefore = point.lateness(before);
  double tau = before + lateBefore;
  for (int step = 0; step < (way == Way::Secant ? mostSteps : mostPlainSteps) && std::abs(lateBefore) > most; ++step)
  {
    tau = std::min(std::max(tau, times.first), times.last);
    const double late = point.lateness(tau);
    const double slope = (late - lateBefore) / (tau - before);
    before = tau;
    lateBefore = late;
    const bool falls = slope < 0 && slope > -std::numeric_limits<double>::infinity();
    tau += way == Way::Secant && falls ? -late / slope : late;
  }
  return std::abs(lateBefore) <= most;
}

/// Whether halving finds a time; the first one between equal steps.
bool bisects(PointInTime& point, const TimeSpan& times, double most)
{
  double low = times.first;
  double lateLow = point.lateness(low);
  for (int i = 1; i <= coarseSteps && !(std::abs(lateLow) <= most); ++i)
  {
    double high = times.first + (times.last - times.first) * i / coarseSteps;
    const double lateHigh = point.lateness(high);
    const bool between = lateLow > 0 && lateHigh <= 0;
    for (int halving = 0; between && halving < mostHalvings; ++halving)
    {
      const double middle = low + (high - low) / 2;
      const double late = point.lateness(middle);
      if (std::isnan(late) || std::abs(late) <= most)
      {
        return !std::isnan(late);
      }
      (late > 0 ? low : high) = middle;
    }
    // The sign also changes where a point jumps, and is seen at no time.
    if (between && std::abs(point.lateness(high)) <= jump * (times.last - times.first))
    {
      return true;
    }
    low = high;
    lateLow = lateHigh;
  }
  return std::abs(lateLow) <= most;
}
} // namespace

SeenInTime seenInTime(const View& view, const Hit& hit, const Eigen::Vector2d& barycentrics)
{
  return seenInTime(
    view, [&](double tau) { return view.instants->pointAt(tau, hit.object, hit.triangle, barycentrics); });
}

SeenInTime seenInTime(const View& view, const PointAt& pointAt)
{
  PointInTime point(view, pointAt);
  const double frame = view.instants->frame();
  const TimeSpan offsets = view.model->times();
  const TimeSpan times{ frame + offsets.first, frame + offsets.last };
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon(); // frames have 16 digits, too
  const double most =
    std::max(settled * (times.last - times.first), rounding * std::max(std::abs(times.first), std::abs(times.last)));
  const bool found = settles(point, frame, times, most, Way::Secant) ||
                     settles(point, frame, times, most, Way::Plain) || bisects(point, times, most);
  return found ? point.seen() : SeenInTime{};
}

} // namespace dgtk
