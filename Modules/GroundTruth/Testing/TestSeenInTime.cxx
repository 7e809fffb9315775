// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSeenInTime.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

using namespace dgtk;

namespace
{
/// A point is shown at its x and y, from one frame before the picture's own at x = -1 to one after it at x = 1.
class SlowCamera : public CameraModel
{
public:
  SlowCamera()
    : CameraModel(2, 2)
  {
  }
  std::string name() const override { return "slow"; }
  CameraRay rayThrough(const Eigen::Vector2d& pixel) const override
  {
    return { { pixel.x(), pixel.y(), 0 }, { 0, 0, 1 } };
  }
  bool project(const Eigen::Vector3d& x_in_camera, Eigen::Vector2d& pixel) const override
  {
    pixel = x_in_camera.z() < 0 ? pixel : Eigen::Vector2d(x_in_camera.head<2>());
    return x_in_camera.z() >= 0;
  }
  double timeAt(const Eigen::Vector2d& pixel) const override { return std::clamp(pixel.x(), -1.0, 1.0); }
  TimeSpan times() const override { return { -1, 1 }; }
};

/// Knows its frame only.
class OwnFrame : public InstantSource
{
public:
  explicit OwnFrame(double frame)
    : Frame(frame)
  {
  }
  double frame() const override { return this->Frame; }
  Instant at(double) const override { throw std::logic_error("at"); }
  Instance instanceAt(double, std::uint32_t) const override { throw std::logic_error("instanceAt"); }
  const std::vector<Motion>& motions() const override { throw std::logic_error("motions"); }
  Rigid3 poseAt(double) const override { throw std::logic_error("poseAt"); }
  Affine3 placeAt(double, std::uint32_t) const override { throw std::logic_error("placeAt"); }
  bool isVisibleAt(double, std::uint32_t) const override { throw std::logic_error("isVisibleAt"); }
  Point pointAt(double, std::uint32_t, std::uint32_t, const Eigen::Vector2d&) const override
  {
    throw std::logic_error("pointAt");
  }

private:
  double Frame;
};

using OfTime = std::function<double(double)>; ///< of frames after the picture's own

/// A point that is shown at x and is before the camera where z is not negative; the camera is elsewhere.
SeenInTime seenAt(double frame, const OfTime& x, const OfTime& z)
{
  View view;
  view.model = std::make_shared<SlowCamera>();
  view.instants = std::make_shared<OwnFrame>(frame);
  return seenInTime(view,
    [&](double tau)
    {
      Rigid3 camera_from_world;
      camera_from_world.translation = Eigen::Vector3d(tau, 20, 3);
      return InstantSource::Point{ Eigen::Vector3d(x(tau - frame) - tau, -13, z(tau - frame) - 3), camera_from_world };
    });
}

OfTime always(double value)
{
  return [value](double) { return value; };
}
} // namespace

TEST(SeenInTime, IsWhenItsPlaceInTheImageIsSeen)
{
  struct Row
  {
    const char* what;
    OfTime x, z;
    double time; ///< not-a-number: never
  };
  const double never = std::numeric_limits<double>::quiet_NaN();
  const auto within = [](double first, double last)
  { return [=](double t) { return t >= first && t <= last ? 1.0 : -1.0; }; };
  const auto without = [](double first, double last)
  { return [=](double t) { return t > first && t < last ? -1.0 : 1.0; }; };
  const auto jumping = [](double t)
  {
    const double later = t < 0.3 ? -0.8 : 0.6;
    return t < -0.5 ? 0 : later;
  };
  const Row rows[] = {
    { "at rest", always(0.3), always(1), 0.3 },
    { "at the camera's centre", always(0.3), always(0), 0.3 },
    { "beside the image", always(3), always(1), 1 },
    { "beside it on the other side", always(-3), always(1), -1 },
    { "moves with the shutter", [](double t) { return 0.3 + 0.5 * t; }, always(1), 0.6 },
    { "moves against it", [](double t) { return 0.3 - 0.5 * t; }, always(1), 0.2 },
    { "against it, faster", [](double t) { return 0.3 - 5 * t; }, always(1), 0.05 },
    { "is accelerated", [](double t) { return 0.25 + 0.5 * t * t; }, always(1), 1 - std::sqrt(0.5) },
    { "its way has a corner", [](double t) { return t < 0.2 ? 0.5 - 0.9 * t : 0.32 - 4 * (t - 0.2); }, always(1),
      0.224 },
    { "trembles", [](double t) { return 0.3 + 0.01 * std::cos(1000 * t); }, always(1), 0.3 },
    { "behind the camera", always(0.3), always(-1), never },
    { "is there a little before", always(0.51), within(-0.1, 1), 0.51 },
    { "not at the picture's own time", always(0.51), without(-0.1, 0.1), 0.51 },
    { "only later", always(0.51), within(0.3, 1), 0.51 },
    { "only between two steps of bisection", always(0.51), within(0.505, 0.52), never },
    { "is gone when it would be seen", always(0.51), without(0.503, 0.513), never },
    { "is gone before that", always(0.51), within(0.2, 0.5), never },
    { "comes after that", always(0.51), within(0.52, 1), never },
    { "is there from that time on", always(0.5), within(0.5, 1), 0.5 },
    { "is there at the first time alone", always(-1), within(-1, -0.99), -1 },
    { "jumps past its time", [](double t) { return t < 0.1 ? 0.5 : -0.5; }, always(1), never },
    { "jumps past its time, and is seen later", jumping, always(1), 0.6 },
    { "is there at the last time alone", always(1), within(0.99, 1), 1 },
  };
  for (const double frame : { 0.0, 10.0, 999999.0 })
  {
    const double most = frame < 1e5 ? 1e-11 : 1e-9; // frames; the last have ten digits behind the point
    for (const Row& row : rows)
    {
      const SeenInTime found = seenAt(frame, row.x, row.z);
      const bool seen = !std::isnan(row.time);
      ASSERT_EQ(found.seen, seen) << row.what << " at " << frame;
      EXPECT_EQ(std::isnan(found.pixel.x()) && std::isnan(found.pixel.y()), !seen) << row.what;
      if (seen)
      {
        const double time = found.frame - frame;
        EXPECT_NEAR(std::clamp(found.pixel.x(), -1.0, 1.0), time, most) << row.what << " at " << frame;
        EXPECT_NEAR(time, row.time, std::string(row.what) == "trembles" ? 0.011 : most) << row.what << " at " << frame;
        EXPECT_NEAR(found.pixel.x(), row.x(time), most) << row.what;
        EXPECT_EQ(found.pixel, Eigen::Vector2d(found.x_in_camera.head<2>())) << row.what;
        EXPECT_EQ(found.x_in_camera, found.x_in_world + Eigen::Vector3d(found.frame, 20, 3)) << row.what;
      }
    }
  }
}
