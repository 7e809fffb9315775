// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCameraPath.h"

#include "dgtkCameraWalk.h"
#include "dgtkPathRule.h"
#include "dgtkPortableMath.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

using namespace samplerule;

namespace
{
double fractionOf(const std::vector<int>& frames, std::size_t i)
{
  return double(frames[i] - frames.front()) / double(frames.back() - frames.front());
}

TravelledPath orbit(const JsonCursor& at, UpAxis up, bool looks)
{
  onlyKeys(at, { "center", "radius", "elevation", "azimuth", "frames", "every" });
  constexpr Range latitude{ -90, 90, true, true, "degrees between -90 and 90" };
  const Eigen::Vector3d center = at["center"].vector(coordinate);
  const FromTo radius = fromTo(at["radius"], positive);
  const FromTo elevation = at.has("elevation") ? fromTo(at["elevation"], latitude) : FromTo{ 0, 0 };
  const FromTo azimuth = at.has("azimuth") ? fromTo(at["azimuth"], degrees) : FromTo{ 0, 360 };
  const std::vector<int> frames = framesOf(at);
  TravelledPath path;
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    const double u = fractionOf(frames, i);
    const portable::SineCosine turn = portable::sinCos(azimuth.at(u) * (pi / 180));
    const portable::SineCosine height = portable::sinCos(elevation.at(u) * (pi / 180));
    const double across = height.cosine;
    const Eigen::Vector3d direction = up == UpAxis::Y
                                        ? Eigen::Vector3d(turn.sine * across, height.sine, turn.cosine * across)
                                        : Eigen::Vector3d(turn.cosine * across, turn.sine * across, height.sine);
    path.eye.push_back({ frames[i], center + radius.at(u) * direction });
    if (!looks)
    {
      path.lookAt.push_back({ frames[i], center });
    }
  }
  return path;
}

/// Catmull-Rom through points, the time between them as their distances; u from 0 to 1.
Track<Eigen::Vector3d> curveThrough(const JsonCursor& at)
{
  constexpr double parts = 1e6; // of a curve's time
  std::vector<Eigen::Vector3d> points;
  std::vector<double> lengths{ 0 };
  for (const JsonCursor& item : at.items())
  {
    points.push_back(item.vector(coordinate));
    if (points.size() > 1)
    {
      lengths.push_back(lengths.back() + (points.back() - points[points.size() - 2]).norm());
    }
  }
  if (points.size() < 2 || points.size() > 10000)
  {
    at.fail("makes no curve", "2 to 10000 points", std::to_string(points.size()));
  }
  Track<Eigen::Vector3d> curve;
  curve.interpolation = Interpolation::Smooth;
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const int frame = lengths.back() > 0 ? int(std::lround(parts * lengths[i] / lengths.back())) : 0;
    if (i > 0 && frame <= curve.keys.back().frame)
    {
      at.element(i).fail("is where the point before is", "points apart from each other");
    }
    curve.keys.push_back({ frame, points[i] });
  }
  return curve;
}

TravelledPath spline(const JsonCursor& at, bool looks)
{
  onlyKeys(at, { "points", "frames", "every" });
  const Track<Eigen::Vector3d> curve = curveThrough(at["points"]);
  const std::vector<int> frames = framesOf(at);
  const double whole = curve.keys.back().frame;
  TravelledPath path;
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    const double u = whole * fractionOf(frames, i);
    path.eye.push_back({ frames[i], curve.at(u) });
    if (!looks)
    {
      constexpr double ahead = 100;
      const Eigen::Vector3d way = curve.at(std::min(u + ahead, whole)) - curve.at(std::max(u - ahead, 0.0));
      if (way.norm() == 0)
      {
        at.fail("stands still", "a curve whose direction is defined, or a camera with lookAt");
      }
      path.lookAt.push_back({ frames[i], path.eye.back().value + way / way.norm() });
    }
  }
  return path;
}
} // namespace

TravelledPath bakedPath(
  const SampleRule& rule, SampleWorld& world, UpAxis up, const SampleDraws& draws, std::uint32_t attempt, bool looks)
{
  const JsonCursor at(rule.rule);
  onlyKeys(at, { "orbit", "spline", "walk", "otherwise" });
  isOmitted(at);
  const int kinds = int(at.has("orbit")) + int(at.has("spline")) + int(at.has("walk"));
  if (kinds != 1)
  {
    at.fail("is not one path", "one of orbit, spline, walk", std::to_string(kinds) + " of them");
  }
  if (at.has("orbit"))
  {
    return orbit(at["orbit"], up, looks);
  }
  if (at.has("spline"))
  {
    return spline(at["spline"], looks);
  }
  return walkedPath(at["walk"], rule.path + "/walk", world, up, draws, attempt, looks);
}

} // namespace dgtk
