// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneFile.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkJson.h"
#include "dgtkNamedFile.h"
#include "dgtkSceneFromText.h"
#include "dgtkSceneJson.h"
#include "dgtkText.h"
#include "dgtkThesisScene.h"
#include "dgtkWorkTime.h"

#include <filesystem>

namespace dgtk
{

using namespace scenefile;

namespace
{
constexpr std::uint64_t largestFile = std::uint64_t(256) << 20;

std::string folderOf(const std::string& path) { return std::filesystem::path(path).parent_path().string(); }
} // namespace

SceneDescription readScene(const std::string& path)
{
  const WorkTime load(WorkStage::Load);
  const std::string extension = extensionOf(path);
  const std::string contents = readFile(path, largestFile);
  if (extension == "scene")
  {
    return readThesisScene(path, folderOf(path), contents);
  }
  if (extension == "json")
  {
    return readJsonScene(path, folderOf(path), contents);
  }
  throw InputError(path, "is no scene", "a name in .scene or .json", extension.empty() ? "none" : '.' + extension);
}

namespace
{
/// Scenes are written with a version; those by hand have cameras at least beside something else that is seen. Records
/// of samples have a version, too, and documents of datasets cameras.
bool isSceneRoot(const JsonNode& root)
{
  if (root.type != JsonNode::Type::Object || root.find("samples") != nullptr)
  {
    return false;
  }
  const JsonNode* const version = root.find("version");
  const auto has = [&](const char* key) { return root.find(key) != nullptr; };
  const bool isVersioned = version != nullptr && version->type == JsonNode::Type::Number;
  const bool isSeen = has("objects") || has("lights") || has("environment") || has("background");
  return isVersioned ? isSeen || has("cameras") : isSeen && has("cameras");
}

/// Of an object that has an id, unless its model has no surfaces.
void addClassName(const JsonNode& object, std::set<std::string>& names)
{
  const JsonNode* const name = object.find("class");
  const JsonNode* const visible = object.find("visible");
  const bool never = visible && visible->type == JsonNode::Type::Boolean && !visible->boolean;
  if (name ? name->type == JsonNode::Type::String : !never)
  {
    names.insert(name ? name->text : "");
  }
}
} // namespace

SceneOutline outlineOf(const std::string& path)
{
  SceneOutline outline;
  const std::string extension = extensionOf(path);
  if (extension != "json")
  {
    outline.isScene = extension == "scene";
    outline.classNames.insert("");
    return outline;
  }
  const JsonDocument document = parseJson(path, readFile(path, largestFile));
  const JsonNode& root = document.root;
  const JsonNode* const objects = root.find("objects");
  outline.isScene = isSceneRoot(root);
  if (!outline.isScene)
  {
    return outline;
  }
  SceneDescription scene;
  scene.folder = folderOf(path);
  readClassesOf(JsonCursor(document), scene);
  outline.classes = std::move(scene.classes);
  for (std::size_t i = 0; objects && i < objects->children.size(); ++i)
  {
    addClassName(objects->children[i], outline.classNames);
  }
  return outline;
}

SceneDescription readSceneText(const std::string& json, const std::string& folder)
{
  return readJsonScene({}, folder, json);
}

void writeScene(const SceneDescription& scene, const std::string& path)
{
  const std::string extension = extensionOf(path);
  if (extension != "scene" && extension != "json")
  {
    throw UsageError("a scene cannot be written as " + quoted(path) + " (expected a name in .scene or .json)");
  }
  namespace fs = std::filesystem;
  const auto folderOfFile = [](const std::string& file)
  { return fs::weakly_canonical(fs::absolute(file).parent_path()); };
  if (folderOfFile(linkedPath(path)) != folderOfFile(path))
  {
    throw MachineError(path + ": cannot be written: is a link into another folder, where paths of models are others");
  }
  writeNamedFile(path, extension == "json" ? toJson(scene, folderOf(path)) : toThesisScene(scene, folderOf(path)));
}

} // namespace dgtk
