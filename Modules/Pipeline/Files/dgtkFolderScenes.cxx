// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFolderScenes.h"

#include "dgtkError.h"
#include "dgtkSceneFile.h"
#include "dgtkText.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;

/// Of a file that cannot be read as a scene: one, that says so when it is rendered, and keeps no other from it.
SceneOutline outlineOrFailing(const std::string& path)
{
  try
  {
    return outlineOf(path);
  }
  catch (const InputError&)
  {
    SceneOutline failing;
    failing.isScene = true;
    return failing;
  }
}

/// Numbers the classes of all scenes of a folder.
class ClassNumbers
{
public:
  /// Throws InputError where two scenes fix other numbers.
  void add(const std::string& path, const SceneOutline& outline)
  {
    this->Names.insert(outline.classNames.begin(), outline.classNames.end());
    if (outline.classes.empty())
    {
      this->Free = true;
      return;
    }
    if (!this->Fixed.empty() && classesText(this->Fixed) != classesText(outline.classes))
    {
      throw InputError(path, "fixes other numbers of classes than " + this->By,
        "the same \"classes\" in all scenes of a folder, or in none");
    }
    this->By = this->Fixed.empty() ? path : this->By;
    this->Fixed = outline.classes;
  }

  /// Those that scenes fix, else all names in their order, else nothing: no object has a class.
  std::vector<ClassDescription> table(const std::string& folder) const
  {
    if (!this->Fixed.empty() || !this->Free || (this->Names.size() == 1 && this->Names.count("") == 1))
    {
      return this->Fixed;
    }
    std::vector<ClassDescription> numbered;
    if (this->Names.size() > std::size_t(largestClassId))
    {
      throw InputError(folder, "has objects of too many classes", "at most " + std::to_string(largestClassId),
        std::to_string(this->Names.size()));
    }
    for (const std::string& name : this->Names)
    {
      numbered.push_back({ name, static_cast<int>(numbered.size()) + 1 });
    }
    return numbered;
  }

private:
  std::set<std::string> Names;
  std::vector<ClassDescription> Fixed;
  std::string By;
  bool Free = false;
};
} // namespace

FolderScenes scenesIn(const std::string& folder)
{
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
  {
    const std::string name = entry.path().filename().string();
    const std::string extension = extensionOf(name);
    if (entry.is_regular_file() && (extension == "json" || extension == "scene"))
    {
      names.push_back(name);
    }
  }
  std::sort(names.begin(), names.end());
  FolderScenes files;
  ClassNumbers classes;
  std::map<std::string, std::string> byName;
  for (const std::string& name : names)
  {
    const std::string path = folder + '/' + name;
    const bool isOfMac = name.rfind("._", 0) == 0; // what macOS writes beside a file
    const SceneOutline outline = isOfMac ? SceneOutline() : outlineOrFailing(path);
    if (!outline.isScene)
    {
      files.leftOut.push_back(name);
      continue;
    }
    classes.add(path, outline);
    const std::string stem = name.substr(0, name.rfind('.'));
    if (!byName.emplace(stem, name).second)
    {
      throw UsageError(
        folder + ": " + dgtk::quoted(byName[stem]) + " and " + dgtk::quoted(name) + " would become one dataset");
    }
    files.scenes.emplace_back(stem, path);
  }
  std::sort(files.scenes.begin(), files.scenes.end());
  if (files.scenes.empty())
  {
    throw InputError(folder, "is a directory without scenes", "files in .json or .scene");
  }
  files.classes = classes.table(folder);
  return files;
}

} // namespace dgtk
