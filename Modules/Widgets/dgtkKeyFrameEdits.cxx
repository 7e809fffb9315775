// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneEdits.h"

#include <cstddef>
#include <set>

namespace dgtk
{

namespace
{
/// Calls function(track, whether a key frame holds it) for every track of an item.
template <typename Scene, typename Function>
void forEachTrackOf(Scene& scene, const SceneItem& item, Function&& function)
{
  switch (item.kind)
  {
    case SceneItem::Kind::Object:
    {
      auto& object = scene.objects[item.index];
      function(object.position, true);
      function(object.orientation, true);
      function(object.scale, true);
      break;
    }
    case SceneItem::Kind::Light:
    {
      auto& light = scene.lights[item.index];
      function(light.position, true);
      function(light.target, false);
      function(light.unused.orientation, false);
      function(light.unused.scale, false);
      break;
    }
    case SceneItem::Kind::Camera:
    {
      auto& camera = scene.cameras[item.index];
      function(camera.eye, !camera.posed);
      function(camera.lookAt, !camera.posed);
      function(camera.position, camera.posed);
      function(camera.orientation, camera.posed);
      function(camera.up, false);
      function(camera.fovY, false);
      function(camera.viewHeight, false);
      function(camera.lens.focus, false);
      for (auto* unused : { &camera.unusedEye, &camera.unusedLookAt })
      {
        function(unused->orientation, false);
        function(unused->scale, false);
      }
      break;
    }
  }
}
} // namespace

void makeKeyFrame(SceneDescription& scene, int frame)
{
  for (const SceneItem& item : scene.items())
  {
    forEachTrackOf(scene, item,
      [frame](auto& track, bool always)
      {
        if (always || track.animated())
        {
          const auto value = track.at(frame);
          if (!track.animated())
          {
            track.keys.push_back({ frame, value });
          }
          setTrackAt(track, frame, value);
        }
      });
  }
  std::vector<int>& extra = scene.extraKeyFrames;
  const std::vector<int> frames = scene.keyFrames();
  if (!std::binary_search(frames.begin(), frames.end(), frame))
  {
    extra.insert(std::lower_bound(extra.begin(), extra.end(), frame), frame);
  }
}

void removeKeyFrame(SceneDescription& scene, int frame)
{
  for (const SceneItem& item : scene.items())
  {
    forEachTrackOf(scene, item,
      [frame](auto& track, bool)
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
      });
  }
  std::vector<int>& extra = scene.extraKeyFrames;
  extra.erase(std::remove(extra.begin(), extra.end(), frame), extra.end());
}

void copyKeyFrame(SceneDescription& scene, int from, int to)
{
  for (const SceneItem& item : scene.items())
  {
    forEachTrackOf(scene, item,
      [from, to](auto& track, bool)
      {
        for (const auto& key : track.keys)
        {
          if (key.frame == from)
          {
            const auto value = key.value;
            setTrackAt(track, to, value);
            return;
          }
        }
      });
  }
}

void setInterpolation(SceneDescription& scene, const SceneItem& item, Interpolation interpolation)
{
  forEachTrackOf(scene, item,
    [interpolation](auto& track, bool)
    { track.interpolation = track.animated() ? interpolation : track.interpolation; });
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
