// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneDescription.h"

#include <algorithm>

namespace dgtk
{

namespace
{
template <typename T>
void collect(const Track<T>& track, std::vector<int>& frames)
{
  for (const Key<T>& key : track.keys)
  {
    frames.push_back(key.frame);
  }
}

void collect(const UnusedKeys& unused, std::vector<int>& frames)
{
  collect(unused.orientation, frames);
  collect(unused.scale, frames);
}

void sortUnique(std::vector<int>& frames)
{
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
}
} // namespace

std::vector<int> SceneDescription::keyFrames() const
{
  std::vector<int> frames = this->extraKeyFrames;
  for (const ObjectDescription& object : this->objects)
  {
    collect(object.position, frames);
    collect(object.orientation, frames);
    collect(object.scale, frames);
    sortUnique(frames); // bounded by the longest track, not by their sum
  }
  for (const LightDescription& light : this->lights)
  {
    collect(light.position, frames);
    collect(light.target, frames);
    collect(light.unused, frames);
  }
  for (const CameraDescription& camera : this->cameras)
  {
    collect(camera.fovY, frames);
    collect(camera.viewHeight, frames);
    collect(camera.eye, frames);
    collect(camera.lookAt, frames);
    collect(camera.up, frames);
    collect(camera.position, frames);
    collect(camera.orientation, frames);
    collect(camera.unusedEye, frames);
    collect(camera.unusedLookAt, frames);
  }
  sortUnique(frames);
  return frames;
}

int SceneDescription::firstFrame() const
{
  const std::vector<int> frames = this->keyFrames();
  return frames.empty() ? 0 : frames.front();
}

int SceneDescription::lastFrame() const
{
  const std::vector<int> frames = this->keyFrames();
  return frames.empty() ? 0 : frames.back();
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
