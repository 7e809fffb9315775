// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneEdits.h"

#include "dgtkSceneTracks.h"

#include <cstddef>
#include <set>

namespace dgtk
{

namespace
{
/// A track that loses its last key keeps that value.
template <typename T>
void removeKey(Track<T>& track, int frame)
{
  for (std::size_t i = 0; i < track.keys.size(); ++i)
  {
    if (track.keys[i].frame == frame)
    {
      track.value = track.keys.size() == 1 ? track.keys[i].value : track.value;
      track.keys.erase(track.keys.begin() + std::ptrdiff_t(i));
      return;
    }
  }
}

template <typename T>
void copyKey(Track<T>& track, int from, int to, bool move)
{
  for (const Key<T>& key : track.keys)
  {
    if (key.frame == from && from != to)
    {
      Key<T> copy = key;
      copy.frame = to;
      setTrackAt(track, to, copy.value);
      std::find_if(track.keys.begin(), track.keys.end(), [to](const Key<T>& k) { return k.frame == to; })
        ->interpolation = copy.interpolation;
      if (move)
      {
        removeKey(track, from);
      }
      return;
    }
  }
}

void copyKeys(SceneDescription& scene, const SceneItem& item, int from, int to, bool move)
{
  forEachTrackOf(scene, item, [&](auto& track, bool) { copyKey(track, from, to, move); });
}

void dropExtra(SceneDescription& scene, int frame)
{
  std::vector<int>& extra = scene.extraKeyFrames;
  extra.erase(std::remove(extra.begin(), extra.end(), frame), extra.end());
}

void addExtra(SceneDescription& scene, int frame)
{
  std::vector<int>& extra = scene.extraKeyFrames;
  const auto at = std::lower_bound(extra.begin(), extra.end(), frame);
  if (at == extra.end() || *at != frame)
  {
    extra.insert(at, frame);
  }
}

/// A key frame of the scene alone, which no track has, goes along.
void copyFrame(SceneDescription& scene, int from, int to, bool move)
{
  forEachTrack(scene, [&](auto& track, bool) { copyKey(track, from, to, move); });
  const std::vector<int>& extra = scene.extraKeyFrames;
  if (std::binary_search(extra.begin(), extra.end(), from) && from != to)
  {
    addExtra(scene, to);
    if (move)
    {
      dropExtra(scene, from);
    }
  }
}

/// Whether a track of an item is a colour, if it is of vectors.
bool isColor(const SceneDescription& scene, const SceneItem& item, const void* track, bool pose)
{
  if (item.kind != SceneItem::Kind::Light)
  {
    return item.kind == SceneItem::Kind::Object && !pose;
  }
  const LightDescription& light = scene.lights[item.index];
  return track == &light.ambient || track == &light.diffuse || track == &light.specular;
}
} // namespace

void makeKeyFrame(SceneDescription& scene, int frame)
{
  const auto make = [frame](auto& track, bool always, bool color)
  {
    if (always || track.animated())
    {
      const auto value = valueAt(track, frame, color);
      if (!track.animated())
      {
        track.keys.push_back({ frame, value });
      }
      setTrackAt(track, frame, value);
    }
  };
  forEachTrackOfScene(scene, [&](auto& track, bool) { make(track, false, true); });
  for (const SceneItem& item : scene.items())
  {
    forEachTrackOf(scene, item, [&](auto& track, bool pose) { make(track, pose, isColor(scene, item, &track, pose)); });
  }
  const std::vector<int> frames = scene.keyFrames();
  if (!std::binary_search(frames.begin(), frames.end(), frame))
  {
    addExtra(scene, frame);
  }
}

void removeKeyFrame(SceneDescription& scene, int frame)
{
  forEachTrack(scene, [frame](auto& track, bool) { removeKey(track, frame); });
  dropExtra(scene, frame);
}

void removeItemKeys(SceneDescription& scene, const SceneItem& item, int frame)
{
  forEachTrackOf(scene, item, [frame](auto& track, bool) { removeKey(track, frame); });
}

void copyKeyFrame(SceneDescription& scene, int from, int to) { copyFrame(scene, from, to, false); }
void moveKeyFrame(SceneDescription& scene, int from, int to) { copyFrame(scene, from, to, true); }

void copyItemKeys(SceneDescription& scene, const SceneItem& item, int from, int to)
{
  copyKeys(scene, item, from, to, false);
}

void moveItemKeys(SceneDescription& scene, const SceneItem& item, int from, int to)
{
  copyKeys(scene, item, from, to, true);
}

void setKeyInterpolation(
  SceneDescription& scene, const SceneItem& item, int frame, std::optional<Interpolation> interpolation)
{
  forEachTrackOf(scene, item,
    [&](auto& track, bool)
    {
      for (auto& key : track.keys)
      {
        key.interpolation = key.frame == frame ? interpolation : key.interpolation;
      }
    });
}

std::optional<KeyInterpolation> keyInterpolationOf(const SceneDescription& scene, const SceneItem& item, int frame)
{
  std::optional<KeyInterpolation> found;
  forEachTrackOf(scene, item,
    [&](const auto& track, bool)
    {
      for (std::size_t i = 0; i < track.keys.size() && !found; ++i)
      {
        if (track.keys[i].frame == frame)
        {
          found = KeyInterpolation{ track.interpolationAfter(i), track.keys[i].interpolation.has_value() };
        }
      }
    });
  return found;
}

void setInterpolation(SceneDescription& scene, const SceneItem& item, Interpolation interpolation)
{
  forEachTrackOf(scene, item,
    [interpolation](auto& track, bool)
    {
      track.interpolation = track.animated() ? interpolation : track.interpolation;
      for (auto& key : track.keys)
      {
        key.interpolation.reset();
      }
    });
}

Interpolation interpolationOf(const SceneDescription& scene, const SceneItem& item)
{
  Interpolation found = Interpolation::Linear;
  bool any = false;
  forEachTrackOf(scene, item,
    [&](const auto& track, bool)
    {
      found = track.animated() && !any ? track.interpolation : found;
      any = any || track.animated();
    });
  return found;
}

std::vector<int> keyFramesOf(const SceneDescription& scene, const SceneItem& item)
{
  std::set<int> frames;
  forEachTrackOf(scene, item,
    [&](const auto& track, bool)
    {
      for (const auto& key : track.keys)
      {
        frames.insert(key.frame);
      }
    });
  return { frames.begin(), frames.end() };
}

} // namespace dgtk
