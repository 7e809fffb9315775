// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCorrespondence.h"

#include "dgtkInView.h"
#include "dgtkPixelBlocks.h"
#include "dgtkSeenInTime.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace dgtk
{

namespace
{
constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

VisibilityClass classOf(std::uint32_t object, std::uint32_t before)
{
  return before == 0        ? VisibilityClass::Visible
         : before == object ? VisibilityClass::OccludedByOwn
                            : VisibilityClass::OccludedByOther;
}

/// Follows surface points into another view, any number at a time.
class Follower
{
public:
  explicit Follower(const OtherView& other)
    : Other(other)
    , Linear(other.view.model->linear().has_value())
  {
  }

  /// One point, which follow() answers under `index`.
  void add(std::size_t index, const Hit& hit, const Eigen::Vector2d& barycentrics)
  {
    this->Indices.push_back(index);
    this->Hits.push_back(hit);
    if (!this->Other.view.instants)
    {
      this->Worlds.push_back(carriedPoint(*this->Other.state, hit, barycentrics));
      this->Points.emplace_back(this->Other.view.camera_from_world * this->Worlds.back());
      return;
    }
    const SeenInTime seen = seenInTime(this->Other.view, hit, barycentrics);
    this->Worlds.push_back(seen.x_in_world);
    this->Points.push_back(seen.x_in_camera);
    this->Pixels.push_back(seen.pixel);
    this->Seen.push_back(seen.seen ? 1 : 0);
    this->Frames.push_back(seen.frame);
  }

  /// Where they are: answer(index, pixel, class), with a pixel that is not-a-number where there is none.
  template <class Answer>
  void follow(const Answer& answer)
  {
    const std::size_t count = this->Points.size();
    if (!this->Other.view.instants)
    {
      this->Pixels.assign(count, Eigen::Vector2d(nowhere, nowhere));
      this->Seen.resize(count);
      this->Other.view.model->projectAll(this->Points.data(), count, this->Pixels.data(), this->Seen.data());
    }
    std::size_t asked = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      const bool isThere = this->isThere(i);
      if (!isThere || this->Seen[i] == 0 || !isInView(this->Other.view, this->Linear, this->Points[i], this->Pixels[i]))
      {
        answer(this->Indices[i], this->Pixels[i],
          !isThere             ? VisibilityClass::NoSurface
          : this->Seen[i] == 0 ? VisibilityClass::Behind
                               : VisibilityClass::Outside);
        continue;
      }
      this->Indices[asked] = this->Indices[i];
      this->Hits[asked] = this->Hits[i];
      this->Worlds[asked] = this->Worlds[i];
      this->Pixels[asked] = this->Pixels[i];
      if (this->Other.view.instants)
      {
        this->Frames[asked] = this->Frames[i];
      }
      ++asked;
    }
    this->Before.resize(asked);
    this->findOccluders(asked);
    for (std::size_t i = 0; i < asked; ++i)
    {
      answer(
        this->Indices[i], this->Pixels[i], classOf(this->objectOf(this->Hits[i]), this->objectOf(this->Before[i])));
    }
    this->Indices.clear();
    this->Hits.clear();
    this->Worlds.clear();
    this->Points.clear();
    this->Pixels.clear();
    this->Seen.clear();
    this->Frames.clear();
  }

private:
  /// What a rolling shutter sees at no time has no time at which it might be visible.
  bool isThere(std::size_t i) const
  {
    const std::uint32_t object = this->Hits[i].object;
    return this->Other.view.instants
             ? this->Seen[i] == 0 || this->Other.view.instants->isVisibleAt(this->Frames[i], object)
             : this->Other.state->instances[object - 1].visible;
  }
  std::uint32_t objectOf(const Hit& hit) const
  {
    return this->Other.view.instants ? hit.object : this->Other.state->objectOf(hit.object); // no copies roll
  }
  void findOccluders(std::size_t count)
  {
    const View& view = this->Other.view;
    if (this->Other.occlusion == nullptr)
    {
      std::fill(this->Before.begin(), this->Before.end(), Hit());
      return;
    }
    const OcclusionQuery& query = *this->Other.occlusion;
    if (view.instants)
    {
      query.occludersAt(view, this->Frames.data(), this->Worlds.data(), this->Hits.data(), count, this->Before.data());
      return;
    }
    query.occluders(view, this->Worlds.data(), this->Hits.data(), count, this->Before.data());
  }
  const OtherView& Other;
  bool Linear;
  // Of the points that were added ...
  std::vector<std::size_t> Indices;
  std::vector<Hit> Hits;
  std::vector<Eigen::Vector3d> Worlds;
  std::vector<Eigen::Vector3d> Points; ///< in the frame of the camera
  std::vector<Eigen::Vector2d> Pixels;
  std::vector<std::uint8_t> Seen;
  std::vector<double> Frames; ///< of a view with instants
  // ... and of those that are asked for
  std::vector<Hit> Before;
};
} // namespace

Eigen::Vector3d carriedPoint(const SceneState& state, const Hit& hit, const Eigen::Vector2d& barycentrics)
{
  const Instance& instance = state.instances[hit.object - 1];
  const auto& corners = instance.model->triangles[hit.triangle];
  const std::vector<Eigen::Vector3d>& p = instance.geometry->positions;
  const Eigen::Vector3d& first = p[corners[0]];
  return instance.world_from_object *
         (first + barycentrics.x() * (p[corners[1]] - first) + barycentrics.y() * (p[corners[2]] - first));
}

Correspondence correspond(const OtherView& other, const Hit& hit, const Eigen::Vector2d& barycentrics)
{
  Correspondence result;
  Follower follower(other);
  follower.add(0, hit, barycentrics);
  follower.follow(
    [&result](std::size_t, const Eigen::Vector2d& pixel, VisibilityClass visibility)
    {
      result.pixel = pixel;
      result.visibility = visibility;
    });
  return result;
}

void correspondPoints(const OtherView& other, const FixedPoint* points, std::size_t count, Correspondence* found)
{
  Follower follower(other);
  for (std::size_t i = 0; i < count; ++i)
  {
    follower.add(i, points[i].hit, points[i].barycentrics);
  }
  follower.follow(
    [found](std::size_t i, const Eigen::Vector2d& pixel, VisibilityClass visibility) {
      found[i] = { pixel, visibility };
    });
}

Correspondence correspondPixel(const SceneState& state, const View& view, const OcclusionQuery& occlusion,
  const Eigen::Vector2d& pixel, const OtherView& other, Hit* hit)
{
  std::vector<Hit> hits;
  occlusion.allHits(view, pixel, hits);
  const Hit first = hits.empty() ? Hit{} : hits.front();
  if (hit)
  {
    *hit = first;
  }
  if (first.object == 0)
  {
    return {};
  }
  const SurfacePoint point = surfacePointAt(state, view, pixel, first);
  return std::isfinite(point.t) ? correspond(other, first, point.barycentrics) : Correspondence{};
}

void correspondRows(const SurfaceRows& in, const OtherView& other, double* pixels, std::uint8_t* classes)
{
  Follower follower(other);
  const int width = in.rect.width;
  const auto add = [&](int x, int y)
  {
    const std::size_t i = std::size_t(y - in.rect.y) * std::size_t(width) + std::size_t(x);
    if (std::isfinite(in.t[i]))
    {
      follower.add(i, in.hits[i], { in.barycentrics[2 * i], in.barycentrics[2 * i + 1] });
      return;
    }
    pixels[2 * i] = pixels[2 * i + 1] = nowhere;
    classes[i] = static_cast<std::uint8_t>(VisibilityClass::NoSurface);
  };
  for (int top = 0; top < in.rect.height; top += rowsOfBlocks(in.rect.y + top, in.rect.height - top))
  {
    forPixelBlocks({ 0, in.rect.y + top, width, rowsOfBlocks(in.rect.y + top, in.rect.height - top) }, add);
    follower.follow(
      [&](std::size_t i, const Eigen::Vector2d& pixel, VisibilityClass visibility)
      {
        pixels[2 * i] = pixel.x();
        pixels[2 * i + 1] = pixel.y();
        classes[i] = static_cast<std::uint8_t>(visibility);
      });
  }
}

void sceneFlowRows(const SurfaceRows& in, const OtherView& next, double* motion)
{
  const Eigen::Matrix3d& rotation = in.view->camera_from_world.rotation;
  for (std::size_t i = 0; i < in.t.size(); ++i)
  {
    Eigen::Map<Eigen::Vector3d> value(motion + 3 * i);
    value.setConstant(nowhere);
    if (!std::isfinite(in.t[i]))
    {
      continue;
    }
    const Eigen::Vector2d barycentrics(in.barycentrics[2 * i], in.barycentrics[2 * i + 1]);
    const Eigen::Vector3d now = carriedPoint(*in.state, in.hits[i], barycentrics);
    if (!next.view.instants)
    {
      value = rotation * (carriedPoint(*next.state, in.hits[i], barycentrics) - now);
    }
    else if (const SeenInTime then = seenInTime(next.view, in.hits[i], barycentrics); then.seen)
    {
      value = rotation * (then.x_in_world - now);
    }
  }
}

} // namespace dgtk
