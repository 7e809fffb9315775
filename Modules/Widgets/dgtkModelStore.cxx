// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelStore.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace dgtk
{

namespace
{
/// A description of the object alone, at rest in the world.
ObjectDescription bare(const ObjectDescription& object)
{
  ObjectDescription alone = object;
  alone.parent.clear();
  alone.visible = true;
  alone.position = {};
  alone.orientation = {};
  alone.scale = Eigen::Vector3d(1, 1, 1);
  return alone;
}

bool plain(const AnimationDescription& animation)
{
  const AnimationDescription usual;
  return animation.sequence.empty() && animation.start == usual.start && animation.offset == usual.offset &&
         animation.rate == usual.rate && animation.loop == usual.loop;
}
} // namespace

std::string ModelStore::keyOf(const SceneDescription& scene, const ObjectDescription& object)
{
  std::string key = scene.resolve(object.model) + '\n' + std::to_string(scene.fps);
  if (!object.materials.empty() || !object.skin.empty() || !plain(object.animation))
  {
    SceneDescription one;
    one.folder = scene.folder;
    one.objects.push_back(bare(object));
    one.objects.front().name = "object";
    one.objects.front().className.clear();
    key += '\n' + scene.folder + '\n' + toJson(one, scene.folder);
  }
  return key;
}

void ModelStore::load(const SceneDescription& scene)
{
  SceneDescription wanted;
  wanted.file = scene.file;
  wanted.folder = scene.folder;
  wanted.fps = scene.fps;
  std::vector<std::string> keys;
  for (const ObjectDescription& object : scene.objects)
  {
    const std::string key = keyOf(scene, object);
    if (this->Entries.count(key) == 0 && std::find(keys.begin(), keys.end(), key) == keys.end())
    {
      keys.push_back(key);
      wanted.objects.push_back(bare(object));
    }
  }
  if (keys.empty())
  {
    return;
  }
  std::vector<std::string> names;
  for (const ObjectDescription& object : wanted.objects)
  {
    names.push_back(object.name);
  }
  const std::shared_ptr<const Stage> stage = Stage::load(std::move(wanted));
  const std::vector<std::string> present = stage->objectNames();
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    const auto at = std::find(present.begin(), present.end(), names[i]);
    this->Entries[keys[i]] = { stage, std::size_t(at - present.begin()), at == present.end() };
  }
}

Instance ModelStore::at(const SceneDescription& scene, const ObjectDescription& object, double frame) const
{
  const auto found = this->Entries.find(keyOf(scene, object));
  if (found == this->Entries.end() || found->second.empty)
  {
    return {};
  }
  return found->second.stage->at(frame)->instances[found->second.instance];
}

} // namespace dgtk
