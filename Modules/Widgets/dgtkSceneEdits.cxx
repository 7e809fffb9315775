// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneEdits.h"

#include <filesystem>
#include <set>
#include <utility>

namespace dgtk
{

namespace
{
constexpr std::size_t mostDigits = 8; // of a number that is counted on

bool holds(const SceneItems& items, const SceneItem& item)
{
  return std::find(items.begin(), items.end(), item) != items.end();
}

template <typename T>
std::vector<std::string> namesOf(const std::vector<T>& things)
{
  std::vector<std::string> names;
  for (const T& thing : things)
  {
    names.push_back(thing.name);
  }
  return names;
}

/// A path of one scene as another one writes it.
std::string moved(const std::string& path, const SceneDescription& from, const SceneDescription& to)
{
  namespace fs = std::filesystem;
  if (path.empty() || from.folder == to.folder || fs::path(path).is_absolute())
  {
    return path;
  }
  return fs::path(from.resolve(path)).lexically_relative(to.folder.empty() ? "." : to.folder).generic_string();
}

void movePaths(ObjectDescription& object, const SceneDescription& from, const SceneDescription& to)
{
  object.model = moved(object.model, from, to);
  for (MaterialOverride& material : object.materials)
  {
    for (std::optional<std::string>* path : { &material.texture, &material.normalMap, &material.bump,
           &material.metallicRoughnessMap, &material.emissionMap, &material.occlusionMap })
    {
      if (*path)
      {
        **path = moved(**path, from, to);
      }
    }
  }
}

/// Objects of `items` and all that hang on them.
SceneItems withChildren(const SceneDescription& scene, SceneItems items)
{
  std::set<std::string> gone;
  for (const SceneItem& item : items)
  {
    if (item.kind == SceneItem::Kind::Object)
    {
      gone.insert(scene.objects[item.index].name);
    }
  }
  for (bool grew = true; grew;)
  {
    grew = false;
    for (const ObjectDescription& object : scene.objects)
    {
      grew = (gone.count(object.parent) != 0 && gone.insert(object.name).second) || grew;
    }
  }
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
  {
    const SceneItem item{ SceneItem::Kind::Object, i };
    if (gone.count(scene.objects[i].name) != 0 && !holds(items, item))
    {
      items.push_back(item);
    }
  }
  return items;
}

template <typename T>
void append(std::vector<T>& to, const std::vector<T>& from, SceneItem::Kind kind, SceneItems& added)
{
  for (const T& thing : from)
  {
    added.push_back({ kind, to.size() });
    to.push_back(thing);
    to.back().line = 0;
  }
}
} // namespace

std::string uniqueName(const std::vector<std::string>& taken, const std::string& name)
{
  const auto isTaken = [&](const std::string& text)
  { return std::find(taken.begin(), taken.end(), text) != taken.end(); };
  if (!isTaken(name))
  {
    return name;
  }
  // Light0 becomes Light1, tree-2 becomes tree-3, tree becomes tree-2: the names that .scene files imply.
  const std::size_t last = name.find_last_not_of("0123456789");
  const std::size_t digits = name.size() - (last == std::string::npos ? 0 : last + 1);
  const bool counted = digits > 0 && digits <= mostDigits;
  const std::string stem = counted ? name.substr(0, name.size() - digits) : name + '-';
  for (int number = counted ? std::stoi(name.substr(name.size() - digits)) + 1 : 2;; ++number)
  {
    const std::string text = stem + std::to_string(number);
    if (!isTaken(text))
    {
      return text;
    }
  }
}

std::string itemName(const SceneDescription& scene, const SceneItem& item)
{
  switch (item.kind)
  {
    case SceneItem::Kind::Object:
      return scene.objects[item.index].name;
    case SceneItem::Kind::Light:
      return scene.lights[item.index].name;
    default:
      return scene.cameras[item.index].name;
  }
}

void renameItem(SceneDescription& scene, const SceneItem& item, const std::string& name)
{
  if (item.kind == SceneItem::Kind::Light)
  {
    scene.lights[item.index].name = name;
    return;
  }
  if (item.kind == SceneItem::Kind::Camera)
  {
    scene.cameras[item.index].name = name;
    return;
  }
  const std::string old = scene.objects[item.index].name;
  scene.objects[item.index].name = name;
  for (ObjectDescription& object : scene.objects)
  {
    object.parent = !old.empty() && object.parent == old ? name : object.parent;
  }
}

Eigen::Vector3d itemPosition(const SceneDescription& scene, const SceneItem& item, double frame)
{
  if (item.kind == SceneItem::Kind::Object)
  {
    return scene.objects[item.index].position.at(frame);
  }
  if (item.kind == SceneItem::Kind::Light)
  {
    return scene.lights[item.index].position.at(frame);
  }
  const CameraDescription& camera = scene.cameras[item.index];
  return camera.posed ? camera.position.at(frame) : camera.eye.at(frame);
}

void setItemPosition(SceneDescription& scene, const SceneItem& item, int frame, const Eigen::Vector3d& position)
{
  const Eigen::Vector3d step = position - itemPosition(scene, item, frame);
  if (item.kind == SceneItem::Kind::Object)
  {
    setTrackAt(scene.objects[item.index].position, frame, position);
  }
  else if (item.kind == SceneItem::Kind::Light)
  {
    LightDescription& light = scene.lights[item.index];
    setTrackAt(light.position, frame, position);
    if (light.kind == LightKind::Directional || light.kind == LightKind::Spot)
    {
      setTrackAt<Eigen::Vector3d>(light.target, frame, light.target.at(frame) + step);
    }
  }
  else
  {
    CameraDescription& camera = scene.cameras[item.index];
    setTrackAt(camera.posed ? camera.position : camera.eye, frame, position);
    if (!camera.posed)
    {
      setTrackAt<Eigen::Vector3d>(camera.lookAt, frame, camera.lookAt.at(frame) + step);
    }
  }
}

SceneItems appendItems(SceneDescription& scene, const SceneDescription& from)
{
  SceneItems added;
  append(scene.objects, from.objects, SceneItem::Kind::Object, added);
  append(scene.lights, from.lights, SceneItem::Kind::Light, added);
  append(scene.cameras, from.cameras, SceneItem::Kind::Camera, added);
  if (!scene.order.empty())
  {
    scene.order.insert(scene.order.end(), added.begin(), added.end());
  }

  const std::size_t first = scene.objects.size() - from.objects.size();
  for (std::size_t i = 0; i < from.objects.size(); ++i)
  {
    ObjectDescription& object = scene.objects[first + i];
    movePaths(object, from, scene);
    const std::string old = object.name;
    object.name.clear();
    object.name = uniqueName(namesOf(scene.objects), old);
  }
  for (std::size_t i = 0; i < from.objects.size(); ++i)
  {
    // The copy of a child belongs to the copy of its parent.
    for (std::size_t j = 0; j < from.objects.size() && !from.objects[i].parent.empty(); ++j)
    {
      if (from.objects[i].parent == from.objects[j].name)
      {
        scene.objects[first + i].parent = scene.objects[first + j].name;
        break;
      }
    }
  }
  for (const SceneItem& item : added)
  {
    if (item.kind == SceneItem::Kind::Light)
    {
      std::string& name = scene.lights[item.index].name;
      const std::string old = std::exchange(name, {});
      name = uniqueName(namesOf(scene.lights), old);
    }
    else if (item.kind == SceneItem::Kind::Camera)
    {
      std::string& name = scene.cameras[item.index].name;
      const std::string old = std::exchange(name, {});
      name = uniqueName(namesOf(scene.cameras), old);
    }
  }
  const std::vector<std::string> names = namesOf(scene.objects);
  for (std::size_t i = first; i < scene.objects.size(); ++i)
  {
    std::string& parent = scene.objects[i].parent;
    parent = std::find(names.begin(), names.end(), parent) == names.end() ? std::string() : parent;
  }
  return added;
}

SceneDescription extractItems(const SceneDescription& scene, const SceneItems& items)
{
  SceneDescription part;
  part.folder = scene.folder;
  for (const SceneItem& item : scene.items())
  {
    if (!holds(items, item))
    {
      continue;
    }
    switch (item.kind)
    {
      case SceneItem::Kind::Object:
        part.objects.push_back(scene.objects[item.index]);
        break;
      case SceneItem::Kind::Light:
        part.lights.push_back(scene.lights[item.index]);
        break;
      case SceneItem::Kind::Camera:
        part.cameras.push_back(scene.cameras[item.index]);
        break;
    }
  }
  return part;
}

void removeItems(SceneDescription& scene, const SceneItems& items)
{
  const SceneItems gone = withChildren(scene, items);
  const SceneItems all = scene.items();
  const SceneDescription old = scene;
  const bool listed = !scene.order.empty();
  scene.objects.clear();
  scene.lights.clear();
  scene.cameras.clear();
  scene.order.clear();
  for (const SceneItem& item : all)
  {
    if (holds(gone, item))
    {
      continue;
    }
    switch (item.kind)
    {
      case SceneItem::Kind::Object:
        scene.order.push_back({ item.kind, scene.objects.size() });
        scene.objects.push_back(old.objects[item.index]);
        break;
      case SceneItem::Kind::Light:
        scene.order.push_back({ item.kind, scene.lights.size() });
        scene.lights.push_back(old.lights[item.index]);
        break;
      case SceneItem::Kind::Camera:
        scene.order.push_back({ item.kind, scene.cameras.size() });
        scene.cameras.push_back(old.cameras[item.index]);
        break;
    }
  }
  if (!listed)
  {
    scene.order.clear();
  }
}

} // namespace dgtk
