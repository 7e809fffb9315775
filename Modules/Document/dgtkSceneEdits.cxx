// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneEdits.h"

#include "dgtkPathNames.h"
#include "dgtkUniqueNames.h"

#include <array>
#include <filesystem>
#include <map>

namespace dgtk
{

namespace
{
/// Items of a scene, asked for one by one.
class ItemSet
{
public:
  ItemSet(const SceneDescription& scene, const SceneItems& items)
    : Holds{ std::vector<bool>(scene.objects.size()), std::vector<bool>(scene.lights.size()),
      std::vector<bool>(scene.cameras.size()) }
  {
    for (const SceneItem& item : items)
    {
      this->Holds[std::size_t(item.kind)].at(item.index) = true;
    }
  }

  bool holds(const SceneItem& item) const { return this->Holds[std::size_t(item.kind)][item.index]; }

private:
  std::array<std::vector<bool>, 3> Holds;
};

/// Gives those from `first` on names that no other before them has: numbers of theirs that ascend go on ascending.
template <typename T>
UniqueNames nameAnew(std::vector<T>& things, std::size_t first)
{
  UniqueNames names;
  for (std::size_t i = 0; i < things.size(); ++i)
  {
    names.add(things[i].name);
    things[i].name = i < first ? things[i].name : names.rename(things[i].name);
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
  const fs::path file = from.resolve(path);
  const fs::path folder = PathNames().relative(file.parent_path().string(), to.folder);
  return (folder / file.filename()).lexically_normal().generic_string();
}

void movePaths(ObjectDescription& object, const SceneDescription& from, const SceneDescription& to)
{
  object.model = moved(object.model, from, to);
  for (MaterialOverride& material : object.materials)
  {
    for (const auto picture : materialPictures)
    {
      std::optional<std::string>& path = material.*picture;
      if (path)
      {
        path = moved(*path, from, to);
      }
    }
  }
}

void movePaths(CameraDescription& camera, const SceneDescription& from, const SceneDescription& to)
{
  for (auto& [name, value] : camera.parameters)
  {
    value.file = moved(value.file, from, to);
  }
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
    if (traitsOf(light.kind).aimed)
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

  nameAnew(scene.lights, scene.lights.size() - from.lights.size());
  nameAnew(scene.cameras, scene.cameras.size() - from.cameras.size());
  for (std::size_t i = scene.cameras.size() - from.cameras.size(); i < scene.cameras.size(); ++i)
  {
    movePaths(scene.cameras[i], from, scene);
  }
  const std::size_t first = scene.objects.size() - from.objects.size();
  const UniqueNames names = nameAnew(scene.objects, first);
  std::map<std::string, std::string> copies;
  for (std::size_t i = 0; i < from.objects.size(); ++i)
  {
    copies.emplace(from.objects[i].name, scene.objects[first + i].name);
  }
  for (std::size_t i = first; i < scene.objects.size(); ++i)
  {
    movePaths(scene.objects[i], from, scene);
    // The copy of a child belongs to the copy of its parent, or to the parent, where there is one.
    std::string& parent = scene.objects[i].parent;
    const auto copy = parent.empty() ? copies.end() : copies.find(parent);
    parent = copy != copies.end() ? copy->second : names.holds(parent) ? parent : std::string();
  }
  return added;
}

SceneItems withChildren(const SceneDescription& scene, SceneItems items)
{
  std::multimap<std::string, std::size_t> children;
  std::vector<bool> there(scene.objects.size());
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
  {
    if (!scene.objects[i].parent.empty())
    {
      children.emplace(scene.objects[i].parent, i);
    }
  }
  for (const SceneItem& item : items)
  {
    if (item.kind == SceneItem::Kind::Object)
    {
      there.at(item.index) = true;
    }
  }
  for (std::size_t i = 0; i < items.size(); ++i)
  {
    if (items[i].kind == SceneItem::Kind::Object)
    {
      const auto [begin, end] = children.equal_range(scene.objects[items[i].index].name);
      for (auto at = begin; at != end; ++at)
      {
        if (!there[at->second])
        {
          there[at->second] = true;
          items.push_back({ SceneItem::Kind::Object, at->second });
        }
      }
    }
  }
  return items;
}

SceneDescription extractItems(const SceneDescription& scene, const SceneItems& items)
{
  SceneDescription part;
  part.folder = scene.folder;
  const ItemSet wanted(scene, items);
  for (const SceneItem& item : scene.items())
  {
    if (!wanted.holds(item))
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
  const ItemSet gone(scene, withChildren(scene, items));
  const SceneItems all = scene.items();
  const SceneDescription old = scene;
  const bool listed = !scene.order.empty();
  scene.objects.clear();
  scene.lights.clear();
  scene.cameras.clear();
  scene.order.clear();
  for (const SceneItem& item : all)
  {
    if (gone.holds(item))
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
