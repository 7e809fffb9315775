// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneDescription.h"

#include "dgtkSceneTracks.h"

#include <algorithm>

namespace dgtk
{

namespace
{
void sortUnique(std::vector<int>& frames)
{
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
}

/// First and last key frame, 0 without; asked of every picture, so that only the ends of tracks are looked at.
std::pair<int, int> spanOf(const SceneDescription& scene)
{
  std::vector<int> ends;
  if (!scene.extraKeyFrames.empty())
  {
    const auto [least, most] = std::minmax_element(scene.extraKeyFrames.begin(), scene.extraKeyFrames.end());
    ends = { *least, *most };
  }
  forEachTrack(scene,
    [&ends](const auto& track, bool)
    {
      if (track.animated())
      {
        const int first = track.keys.front().frame;
        const int last = track.keys.back().frame;
        ends = ends.empty() ? std::vector<int>{ first, last }
                            : std::vector<int>{ std::min(ends[0], first), std::max(ends[1], last) };
      }
    });
  return ends.empty() ? std::pair(0, 0) : std::pair(ends[0], ends[1]);
}
} // namespace

std::vector<int> SceneDescription::keyFrames() const
{
  std::vector<int> frames = this->extraKeyFrames;
  const auto add = [&frames](const auto& track, bool)
  {
    for (const auto& key : track.keys)
    {
      frames.push_back(key.frame);
    }
  };
  forEachTrackOfScene(*this, add);
  for (const SceneItem& item : this->items())
  {
    forEachTrackOf(*this, item, add);
    sortUnique(frames); // bounded by the longest tracks, not by their sum
  }
  sortUnique(frames);
  return frames;
}

int SceneDescription::firstFrame() const { return spanOf(*this).first; }

int SceneDescription::lastFrame() const { return spanOf(*this).second; }

int SceneDescription::classIdOf(const std::string& className) const
{
  const auto found = std::find_if(
    this->classes.begin(), this->classes.end(), [&](const ClassDescription& one) { return one.name == className; });
  return found == this->classes.end() ? 0 : found->id;
}

double SceneDescription::metres() const
{
  return this->metresPerUnit > 0 ? this->metresPerUnit : metresOfUnit(this->units);
}

std::string SceneDescription::title() const { return this->file.empty() ? "scene" : this->file; }

std::vector<SceneItem> SceneDescription::items() const
{
  if (!this->order.empty())
  {
    return this->order;
  }
  std::vector<SceneItem> all;
  const auto append = [&all](SceneItem::Kind kind, std::size_t count)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      all.push_back({ kind, i });
    }
  };
  append(SceneItem::Kind::Object, this->objects.size());
  append(SceneItem::Kind::Light, this->lights.size());
  append(SceneItem::Kind::Camera, this->cameras.size());
  return all;
}

std::string SceneDescription::resolve(const std::string& path) const
{
  return this->folder.empty() || path.empty() || path[0] == '/' ? path : this->folder + '/' + path;
}

} // namespace dgtk
