// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneFile.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkJson.h"
#include "dgtkSceneFromText.h"
#include "dgtkSceneJson.h"
#include "dgtkSceneText.h"
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
  throw InputError(path, 0, "is no scene", "a name in .scene or .json", extension.empty() ? "none" : '.' + extension);
}

bool looksLikeScene(const std::string& path)
{
  const std::string extension = extensionOf(path);
  if (extension != "json")
  {
    return extension == "scene";
  }
  const JsonDocument document = parseJson(path, readFile(path, largestFile));
  const JsonNode& root = document.root;
  return root.type == JsonNode::Type::Object && root.find("cameras") != nullptr &&
         (root.find("objects") != nullptr || root.find("lights") != nullptr || root.find("environment") != nullptr);
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
  writeFileDurably(path, extension == "json" ? toJson(scene, folderOf(path)) : toThesisScene(scene, folderOf(path)));
}

} // namespace dgtk
