// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelStore.h"

#include "dgtkModelClock.h"

#include <algorithm>
#include <set>
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
  alone.animation = {};
  return alone;
}
} // namespace

ModelStore::ModelStore()
  : Moving(std::make_shared<GeometryCache>())
{
}

std::string ModelStore::keyOf(const SceneDescription& scene, const ObjectDescription& object)
{
  std::string key = scene.resolve(object.model);
  if (!object.materials.empty() || !object.skin.empty())
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

const ModelStore::Entry* ModelStore::find(const EntryMap& entries, const std::string& key)
{
  const auto found = entries.find(key);
  return found == entries.end() ? nullptr : &found->second;
}

void ModelStore::loadFile(
  SceneDescription wanted, const std::vector<std::string>& keys, EntryMap& into, const Stage::WarningSink& warning)
{
  std::vector<std::string> names;
  for (const ObjectDescription& object : wanted.objects)
  {
    names.push_back(object.name);
  }
  const std::shared_ptr<const Stage> stage = Stage::load(std::move(wanted), warning);
  const std::vector<std::string> present = stage->objectNames();
  for (std::size_t i = 0; i < keys.size(); ++i)
  {
    const auto at = std::find(present.begin(), present.end(), names[i]);
    into[keys[i]] = { stage, stage->models().front(), std::size_t(at - present.begin()), at == present.end() };
  }
}

bool ModelStore::load(const SceneDescription& scene, const LoadProgress& progress)
{
  struct File
  {
    SceneDescription wanted;
    std::vector<std::string> keys;
  };
  std::vector<File> files; // in the order of their first use, as errors are reported
  std::map<std::string, std::size_t> places;
  std::set<std::string> known;
  for (const ObjectDescription& object : scene.objects)
  {
    const std::string key = keyOf(scene, object);
    if (find(this->Entries, key) != nullptr || !known.insert(key).second)
    {
      continue;
    }
    const auto [place, isNew] = places.emplace(scene.resolve(object.model), files.size());
    if (isNew)
    {
      files.emplace_back();
      files.back().wanted.file = scene.file;
      files.back().wanted.folder = scene.folder;
    }
    files[place->second].wanted.objects.push_back(bare(object));
    files[place->second].keys.push_back(key);
  }
  EntryMap loaded;
  std::vector<std::string> warnings;
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    if (progress && !progress(i, files.size()))
    {
      return false;
    }
    loadFile(
      std::move(files[i].wanted), files[i].keys, loaded, [&](const std::string& line) { warnings.push_back(line); });
  }
  for (const ObjectDescription& object : scene.objects)
  {
    if (!object.animation.sequence.empty())
    {
      const std::string key = keyOf(scene, object);
      const Entry* const entry = find(loaded, key);
      findAnimation(scene, object, *(entry == nullptr ? this->Entries.at(key) : *entry).model);
    }
  }
  this->Entries.merge(loaded);
  this->addWarnings(warnings);
  return true;
}

void ModelStore::addWarnings(const std::vector<std::string>& lines)
{
  std::set<std::string> known(this->Warnings.begin(), this->Warnings.end());
  for (const std::string& line : lines)
  {
    if (known.insert(line).second)
    {
      this->Warnings.push_back(line);
    }
  }
}

void ModelStore::adopt(const ModelStore& other)
{
  this->Entries.insert(other.Entries.begin(), other.Entries.end());
  this->addWarnings(other.Warnings);
}

std::shared_ptr<const Model> ModelStore::modelOf(const SceneDescription& scene, const ObjectDescription& object) const
{
  const Entry* const entry = find(this->Entries, keyOf(scene, object));
  return entry == nullptr ? nullptr : entry->model;
}

Instance ModelStore::at(const SceneDescription& scene, const ObjectDescription& object, double frame) const
{
  const Entry* const entry = find(this->Entries, keyOf(scene, object));
  if (entry == nullptr || entry->empty)
  {
    return {};
  }
  Instance instance = entry->stage->at(0)->instances[entry->instance];
  const int animation = entry->model->deformation ? findAnimation(scene, object, *entry->model) : -1;
  if (animation >= 0)
  {
    instance.geometry =
      this->Moving->get(*entry->model, momentAt(object.animation, *entry->model, animation, frame, scene.fps));
  }
  return instance;
}

} // namespace dgtk
