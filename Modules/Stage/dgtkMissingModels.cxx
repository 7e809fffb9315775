// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMissingModels.h"

#include "dgtkError.h"
#include "dgtkPathNames.h"

#include <filesystem>
#include <map>
#include <system_error>

namespace dgtk
{

namespace fs = std::filesystem;

namespace
{
constexpr std::size_t there = std::size_t(-1);

std::string lineOf(const SceneDescription& scene, const MissingModel& missing)
{
  const long line = scene.objects[missing.objects.front()].line;
  return line > 0 ? " (line " + std::to_string(line) + ')' : "";
}
} // namespace

std::vector<MissingModel> missingModels(const SceneDescription& scene)
{
  std::vector<MissingModel> missing;
  PathNames names;
  std::map<std::string, std::size_t> known; // a file -> its place in the list
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
  {
    const std::string path = scene.resolve(scene.objects[i].model);
    const auto [entry, isNew] = known.emplace(names.of(path), there);
    std::error_code error;
    if (isNew && fs::status(path, error).type() == fs::file_type::not_found)
    {
      entry->second = missing.size();
      missing.push_back({ scene.objects[i].model, path, {} });
    }
    if (entry->second != there)
    {
      missing[entry->second].objects.push_back(i);
    }
  }
  return missing;
}

void requireModels(const SceneDescription& scene)
{
  const std::vector<MissingModel> missing = missingModels(scene);
  if (missing.empty())
  {
    return;
  }
  if (missing.size() == 1)
  {
    const ObjectDescription& object = scene.objects[missing.front().objects.front()];
    throw InputError(scene.title(), object.line,
      "object " + quoted(object.name) + ": model: " + tidied(missing.front().path) +
        ": cannot be read: No such file or directory");
  }
  std::string names;
  for (const MissingModel& one : missing)
  {
    names += (names.empty() ? "" : ", ") + tidied(one.path) + lineOf(scene, one);
  }
  throw InputError(scene.title(), std::to_string(missing.size()) + " model files are missing: " + names);
}

} // namespace dgtk
