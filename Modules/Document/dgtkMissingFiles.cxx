// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMissingFiles.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace dgtk
{

namespace fs = std::filesystem;

namespace
{
constexpr std::size_t reportEvery = 256; // files

/// How many names at the end of two paths are the same.
std::size_t commonEnd(const fs::path& a, const fs::path& b)
{
  const std::vector<fs::path> one(a.begin(), a.end());
  const std::vector<fs::path> other(b.begin(), b.end());
  const auto end = std::mismatch(one.rbegin(), one.rend(), other.rbegin(), other.rend()).first;
  return std::size_t(end - one.rbegin());
}
} // namespace

std::vector<std::string> modelsOf(const SceneDescription& scene, const std::vector<std::size_t>& objects)
{
  std::vector<std::string> models;
  for (const std::size_t i : objects)
  {
    const std::string& model = scene.objects.at(i).model;
    if (std::find(models.begin(), models.end(), model) == models.end())
    {
      models.push_back(model);
    }
  }
  return models;
}

std::map<std::string, std::string> findModels(
  const std::vector<std::string>& models, const std::string& folder, const LoadProgress& progress)
{
  std::map<std::string, std::vector<std::string>> wanted; // by the file's name
  for (const std::string& model : models)
  {
    wanted[fs::path(model).filename().string()].push_back(model);
  }
  std::map<std::string, std::string> found;
  std::error_code error;
  std::size_t looked = 0;
  for (fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error), end;
       !error && at != end; at.increment(error))
  {
    if (progress && ++looked % reportEvery == 0 && !progress(looked, 0))
    {
      break;
    }
    const auto names = wanted.find(at->path().filename().string());
    std::error_code unreadable;
    if (names == wanted.end() || !at->is_regular_file(unreadable))
    {
      continue;
    }
    for (const std::string& model : names->second)
    {
      const std::string file = at->path().lexically_normal().string();
      std::string& best = found[model];
      const auto likeness = [&](const std::string& path) { return commonEnd(model, path); };
      if (best.empty() || likeness(file) > likeness(best) || (likeness(file) == likeness(best) && file < best))
      {
        best = file;
      }
    }
  }
  return found;
}

void replaceModels(SceneDescription& scene, const std::map<std::string, std::string>& found)
{
  for (ObjectDescription& object : scene.objects)
  {
    if (const auto file = found.find(object.model); file != found.end())
    {
      object.model = fs::absolute(file->second).lexically_normal().lexically_relative(scene.folder).generic_string();
    }
  }
}

} // namespace dgtk
