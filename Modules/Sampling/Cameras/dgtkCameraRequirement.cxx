// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCameraRequirement.h"

#include "dgtkPathRule.h"
#include "dgtkSampleGeometry.h"
#include "dgtkText.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace dgtk
{

using namespace samplerule;

namespace
{
constexpr std::size_t mostFrames = 32;

std::vector<int> someFrames(const std::vector<int>& frames)
{
  if (frames.size() <= mostFrames)
  {
    return frames.empty() ? std::vector<int>{ 0 } : frames;
  }
  std::vector<int> some;
  for (std::size_t i = 0; i < mostFrames; ++i)
  {
    some.push_back(frames[i * (frames.size() - 1) / (mostFrames - 1)]);
  }
  return some;
}

/// Pixels of every object of a state: seen, and met by a ray at all.
struct Pixels
{
  std::vector<std::uint32_t> seen;
  std::vector<std::uint32_t> met;
};

Pixels countPixels(const OcclusionQuery& query, const View& view, std::size_t objects)
{
  Pixels pixels{ std::vector<std::uint32_t>(objects), std::vector<std::uint32_t>(objects) };
  const int width = view.model->width();
  std::vector<Eigen::Vector2d> row(std::size_t(width), Eigen::Vector2d::Zero());
  std::vector<std::vector<Hit>> hits(row.size());
  std::vector<std::uint64_t> last(objects);
  std::uint64_t pixel = 0;
  for (int y = 0; y < view.model->height(); ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      row[std::size_t(x)] = { x + 0.5, y + 0.5 };
    }
    query.allHits(view, row.data(), row.size(), hits.data());
    for (const std::vector<Hit>& along : hits)
    {
      ++pixel;
      for (const Hit& hit : along)
      {
        std::uint64_t& known = last[hit.object - 1];
        pixels.met[hit.object - 1] += known != pixel ? 1 : 0;
        known = pixel;
      }
      if (!along.empty())
      {
        ++pixels.seen[along.front().object - 1];
      }
    }
  }
  return pixels;
}

View smallView(const CameraDescription& camera, double frame, int pixels, const std::string& folder)
{
  const double width = camera.width > 0 ? camera.width : 640;
  const double height = camera.height > 0 ? camera.height : 480;
  const double scale = pixels / std::max(width, height);
  const auto side = [scale](double size) { return std::max(1, int(std::lround(size * scale))); };
  return cameraView(camera, frame, side(width), side(height), folder);
}

void measure(CameraFit& fit, const std::string& name, double value)
{
  for (auto& [known, worst] : fit.measured)
  {
    if (known == name)
    {
      worst = std::min(worst, value);
      return;
    }
  }
  fit.measured.emplace_back(name, value);
}

void lookAt(
  CameraFit& fit, const CameraRequirement& wanted, const CameraDescription& camera, int frame, SampleWorld& world)
{
  const std::shared_ptr<const SceneState> state = world.stateAt(frame);
  const View view = smallView(camera, frame, wanted.pixels, world.scene().folder);
  const Pixels pixels = countPixels(world.queryAt(frame), view, state->instances.size());
  std::vector<std::string> names;
  for (const Instance& instance : state->instances)
  {
    names.push_back(instance.name);
  }
  for (const CameraRequirement::Visible& one : wanted.visible)
  {
    const std::vector<std::size_t> objects = objectsLike(names, one.pattern);
    double least = objects.empty() ? 0 : 1;
    for (const std::size_t object : objects)
    {
      const double share = pixels.met[object] == 0 ? 0 : double(pixels.seen[object]) / pixels.met[object];
      least = std::min(least, share);
    }
    measure(fit, "visible " + one.pattern, least);
    if (least < one.share)
    {
      fit.fits = false;
      fit.why = one.pattern + " is visible by " + plainNumber(least) + " of " + plainNumber(one.share) + " at frame " +
                std::to_string(frame);
    }
  }
}
} // namespace

CameraRequirement CameraRequirement::read(const JsonDocument& rule)
{
  const JsonCursor at(rule);
  onlyKeys(at, { "visible", "clearance", "attempts", "otherwise", "pixels" });
  constexpr Range shares{ 0, 1, false, false, "a number from 0 to 1" };
  constexpr Range sides{ 8, 2048, false, false, "a whole number from 8 to 2048" };
  CameraRequirement wanted;
  if (at.has("visible"))
  {
    const JsonCursor visible = at["visible"];
    for (std::size_t i = 0, n = visible.memberCount(); i < n; ++i)
    {
      wanted.visible.push_back({ visible.key(i), visible.member(i).number(shares) });
    }
    std::sort(wanted.visible.begin(), wanted.visible.end(),
      [](const Visible& a, const Visible& b) { return a.pattern < b.pattern; });
  }
  if (at.has("clearance"))
  {
    wanted.clear = true;
    wanted.clearance = at["clearance"].number(notNegative);
  }
  if (wanted.visible.empty() && !wanted.clear)
  {
    at.fail("asks for nothing", "visible or clearance");
  }
  wanted.attempts = attemptsOf(at);
  wanted.omit = isOmitted(at);
  wanted.pixels = at.has("pixels") ? static_cast<int>(at["pixels"].wholeNumber(sides)) : wanted.pixels;
  return wanted;
}

CameraFit fitOf(const CameraRequirement& wanted, const CameraDescription& camera, const std::vector<int>& keyFrames,
  SampleWorld& world)
{
  CameraFit fit;
  for (const int frame : someFrames(keyFrames))
  {
    const View view = smallView(camera, frame, wanted.pixels, world.scene().folder);
    if (wanted.clear)
    {
      const double distance = world.surfacesAt(frame).at(view.camera_from_world.inverse().translation);
      if (std::isfinite(distance))
      {
        measure(fit, "clearance", distance);
      }
      if (distance < wanted.clearance)
      {
        fit.fits = false;
        fit.why = "a surface is at " + plainNumber(distance) + ", nearer than " + plainNumber(wanted.clearance) +
                  ", at frame " + std::to_string(frame);
      }
    }
    if (fit.fits && !wanted.visible.empty())
    {
      lookAt(fit, wanted, camera, frame, world);
    }
    if (!fit.fits)
    {
      return fit;
    }
  }
  return fit;
}

} // namespace dgtk
