// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelLibrary.h"

#include "dgtkError.h"
#include "dgtkMaterialNumbers.h"
#include "dgtkModelClock.h"
#include "dgtkPathNames.h"
#include "dgtkSceneTracks.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

namespace dgtk
{

namespace
{
/// A description of the object alone, at rest in the world; what moves of its materials is given by their tracks.
ObjectDescription bare(const ObjectDescription& object)
{
  ObjectDescription alone = object;
  alone.parent.clear();
  alone.visible = true;
  alone.position = {};
  alone.orientation = {};
  alone.scale = Eigen::Vector3d(1, 1, 1);
  alone.animation = {};
  for (MaterialOverride& material : alone.materials)
  {
    forEachTrackOf(material,
      [](auto& track)
      {
        if (track.animated())
        {
          track = {};
        }
      });
  }
  return alone;
}

bool isThere(const std::string& path)
{
  std::error_code error;
  return std::filesystem::status(path, error).type() != std::filesystem::file_type::not_found;
}

/// What stands for a model that is not there.
std::shared_ptr<const Model> makeBox()
{
  auto model = std::make_shared<Model>();
  auto geometry = std::make_shared<Geometry>();
  for (int side = 0; side < 6; ++side)
  {
    const int axis = side / 2;
    const double sign = side % 2 == 0 ? -1 : 1;
    const Eigen::Vector3d n = sign * Eigen::Vector3d::Unit(axis);
    const Eigen::Vector3d u = sign * Eigen::Vector3d::Unit((axis + 1) % 3);
    const Eigen::Vector3d v = Eigen::Vector3d::Unit((axis + 2) % 3);
    const auto first = static_cast<std::uint32_t>(geometry->positions.size());
    for (const auto& [a, b] : { std::pair(-1, -1), { 1, -1 }, { 1, 1 }, { -1, 1 } })
    {
      geometry->positions.emplace_back((n + a * u + b * v) / 2);
      geometry->normals.emplace_back(n.cast<float>());
      model->sourceVertex.push_back(first + std::uint32_t(model->sourceVertex.size() % 4));
    }
    model->triangles.push_back({ first, first + 1, first + 2 });
    model->triangles.push_back({ first, first + 2, first + 3 });
  }
  model->sourceVertices = geometry->positions.size();
  model->rest = std::move(geometry);
  model->materials.emplace_back();
  model->materials.front().ambient = model->materials.front().diffuse = Eigen::Vector3d::Constant(0.5);
  model->parts.push_back({ "missing", 0, 0, static_cast<std::uint32_t>(model->triangles.size()) });
  model->boundsMin.setConstant(-0.5);
  model->boundsMax.setConstant(0.5);
  return model;
}

std::shared_ptr<const Model> box()
{
  static const std::shared_ptr<const Model> one = makeBox();
  return one;
}

SceneDescription environmentAlone(const SceneDescription& scene)
{
  SceneDescription alone;
  alone.file = scene.file;
  alone.folder = scene.folder;
  alone.upAxis = scene.upAxis;
  alone.environment = scene.environment;
  return alone;
}
} // namespace

ModelLibrary::ModelLibrary()
  : Moving(std::make_shared<GeometryCache>())
  , Materials(std::make_shared<MaterialNumbers>())
{
}

std::string ModelLibrary::keyOf(const SceneDescription& scene, const ObjectDescription& object)
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

const ModelLibrary::Entry* ModelLibrary::find(const EntryMap& entries, const std::string& key)
{
  const auto found = entries.find(key);
  return found == entries.end() ? nullptr : &found->second;
}

void ModelLibrary::loadFile(
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

bool ModelLibrary::load(const SceneDescription& scene, const LoadProgress& progress, AbsentModel absent)
{
  struct File
  {
    SceneDescription wanted;
    std::vector<std::string> keys;
  };
  EntryMap loaded;
  std::set<std::string> boxes;
  std::vector<File> files; // in the order of their first use, as errors are reported
  std::map<std::string, std::size_t> places;
  std::set<std::string> known;
  for (const ObjectDescription& object : scene.objects)
  {
    const std::string key = keyOf(scene, object);
    const std::string path = scene.resolve(object.model);
    const Entry* const entry = find(this->Entries, key);
    if ((entry != nullptr && (entry->stage != nullptr || !isThere(path))) || !known.insert(key).second)
    {
      continue;
    }
    if ((absent == AbsentModel::Box || this->Absent.count(path) != 0) && !isThere(path))
    {
      boxes.insert(path);
      loaded[key] = { nullptr, box(), 0, false };
      continue;
    }
    const auto [place, isNew] = places.emplace(path, files.size());
    if (isNew)
    {
      files.emplace_back();
      files.back().wanted.file = scene.file;
      files.back().wanted.folder = scene.folder;
    }
    files[place->second].wanted.objects.push_back(bare(object));
    files[place->second].keys.push_back(key);
  }
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
  const std::string environment = environmentKey(scene);
  std::map<std::string, std::shared_ptr<const EnvironmentState>> surroundings;
  if (!environment.empty() && this->Environments.count(environment) == 0)
  {
    surroundings[environment] = readEnvironment(scene, [&](const std::string& line) { warnings.push_back(line); });
  }
  for (const ObjectDescription& object : scene.objects)
  {
    if (!object.animation.sequence.empty())
    {
      const std::string key = keyOf(scene, object);
      const Entry* const found = find(loaded, key);
      const Entry& entry = found == nullptr ? this->Entries.at(key) : *found;
      if (entry.stage != nullptr)
      {
        findAnimation(scene, object, *entry.model);
      }
    }
  }
  this->take(loaded);
  this->Environments.merge(surroundings);
  this->Absent.merge(boxes);
  this->addWarnings(warnings);
  return true;
}

std::string ModelLibrary::environmentKey(const SceneDescription& scene)
{
  return scene.environment.image.empty() ? std::string()
                                         : scene.folder + '\n' + toJson(environmentAlone(scene), scene.folder);
}

std::shared_ptr<const EnvironmentState> ModelLibrary::readEnvironment(
  const SceneDescription& scene, const Stage::WarningSink& warning)
{
  try
  {
    return Stage::load(environmentAlone(scene))->at(0)->environment;
  }
  catch (const InputError& error)
  {
    warning(error.what());
    return nullptr;
  }
}

std::shared_ptr<const EnvironmentState> ModelLibrary::environment(const SceneDescription& scene) const
{
  const auto found = this->Environments.find(environmentKey(scene));
  return found == this->Environments.end() ? nullptr : found->second;
}

void ModelLibrary::addWarnings(const std::vector<std::string>& lines)
{
  std::set<std::string> known(this->Warnings.begin(), this->Warnings.end());
  for (const std::string& line : lines)
  {
    const std::size_t place = line.find(": "); // of a file, the line's first words
    const std::string said = place == std::string::npos ? line : tidied(line.substr(0, place)) + line.substr(place);
    if (known.insert(said).second)
    {
      this->Warnings.push_back(said);
    }
  }
}

/// In place of boxes, too.
void ModelLibrary::take(const EntryMap& entries)
{
  for (const auto& [key, entry] : entries)
  {
    Entry& own = this->Entries[key];
    own = own.stage == nullptr ? entry : own;
  }
}

void ModelLibrary::adopt(const ModelLibrary& other)
{
  this->take(other.Entries);
  this->Environments.insert(other.Environments.begin(), other.Environments.end());
  this->Absent.insert(other.Absent.begin(), other.Absent.end());
  this->addWarnings(other.Warnings);
}

std::shared_ptr<const Model> ModelLibrary::modelOf(const SceneDescription& scene, const ObjectDescription& object) const
{
  const Entry* const entry = find(this->Entries, keyOf(scene, object));
  return entry == nullptr ? nullptr : entry->model;
}

std::vector<std::size_t> ModelLibrary::absent(const SceneDescription& scene) const
{
  std::vector<std::size_t> objects;
  for (std::size_t i = 0; i < scene.objects.size() && !this->Absent.empty(); ++i)
  {
    const Entry* const entry = find(this->Entries, keyOf(scene, scene.objects[i]));
    if (entry != nullptr && entry->stage == nullptr)
    {
      objects.push_back(i);
    }
  }
  return objects;
}

ObjectLook ModelLibrary::lookOf(const SceneDescription& scene, const ObjectDescription& object) const
{
  const Entry* const entry = find(this->Entries, keyOf(scene, object));
  if (entry == nullptr)
  {
    return {};
  }
  if (entry->stage == nullptr || entry->empty)
  {
    return { entry->model, { entry->model, &entry->model->materials }, entry->stage == nullptr };
  }
  const Instance& instance = entry->stage->at(0)->instances[entry->instance];
  return { instance.model, instance.materials };
}

Instance ModelLibrary::at(const SceneDescription& scene, const ObjectDescription& object, double frame) const
{
  const ObjectLook look = this->lookOf(scene, object);
  Instance instance;
  if (look.model != nullptr && !look.model->triangles.empty())
  {
    instance.model = look.model;
    instance.materials = this->Materials->at(object, look.materials, frame);
    instance.geometry = geometryAt(scene, object, *look.model, frame, *this->Moving);
  }
  return instance;
}

} // namespace dgtk
