// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPacking.h"

#include "dgtkError.h"
#include "dgtkPathNames.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;

const std::string inputsFolder = "inputs";

fs::path wholePath(const std::string& path) { return fs::absolute(path).lexically_normal(); }

/// The deepest folder that all files are below.
fs::path commonFolder(const std::vector<std::string>& files)
{
  fs::path common = wholePath(files.front()).parent_path();
  for (const std::string& file : files)
  {
    const fs::path other = wholePath(file).parent_path();
    fs::path shared;
    for (auto a = common.begin(), b = other.begin(); a != common.end() && b != other.end() && *a == *b; ++a, ++b)
    {
      shared /= *a;
    }
    common = shared;
  }
  return common;
}

class Planner
{
public:
  Planner(const Stage& stage, const std::string& folder)
    : Source(stage)
    , Home(wholePath((fs::path(stage.description().folder) / "scene").string()).parent_path())
  {
    this->Plan.scene = stage.description();
    this->Plan.scene.folder = folder;
    this->Plan.scene.file = folder + "/scene.json";
  }

  Packing run()
  {
    SceneDescription& scene = this->Plan.scene;
    const SceneDescription& from = this->Source.description();
    if (!from.file.empty())
    {
      this->place({ from.file });
    }
    PathNames names;
    std::map<std::string, std::shared_ptr<const Model>> models;
    for (const std::shared_ptr<const Model>& model : this->Source.models())
    {
      models[names.of(model->path)] = model;
      this->addModel(*model);
    }
    for (ObjectDescription& object : scene.objects)
    {
      const Model& model = *models.at(names.of(from.resolve(object.model)));
      object.model = this->Plan.copies.at(model.path);
      this->renamePictures(object);
    }
    for (CameraDescription& camera : scene.cameras)
    {
      for (auto& [name, value] : camera.parameters)
      {
        this->rename(value.file);
      }
    }
    this->rename(scene.environment.image);
    this->rename(scene.classFile);
    return std::move(this->Plan);
  }

private:
  /// A file and what it names, which keep their places to each other.
  void place(const std::vector<std::string>& files)
  {
    const fs::path root = commonFolder(files);
    const std::string name = this->nameOf(root);
    for (const std::string& file : files)
    {
      this->Plan.copies.emplace(
        file, inputsFolder + '/' + name + '/' + wholePath(file).lexically_relative(root).generic_string());
    }
  }

  /// One folder of the dataset for each folder of files, called as the scene's way to it ends.
  std::string nameOf(const fs::path& root)
  {
    const auto known = this->Names.find(root);
    if (known != this->Names.end())
    {
      return known->second;
    }
    const fs::path way = root.lexically_relative(this->Home);
    const std::string last = way.empty() ? "" : std::prev(way.end())->string();
    const std::string stem = last == "." || last.empty() ? "scene" : last == ".." ? "above" : last;
    std::string name = stem;
    for (int number = 2; !this->Taken.insert(name).second; ++number)
    {
      name = stem + '-' + std::to_string(number);
    }
    this->Names[root] = name;
    return name;
  }

  /// How many of a model's textures the scene has added, at the end.
  std::size_t addedTextures(const Model& model) const
  {
    std::set<std::string> added;
    PathNames names;
    const std::string file = names.of(model.path);
    for (ObjectDescription object : this->Source.description().objects)
    {
      if (names.of(this->Source.description().resolve(object.model)) != file)
      {
        continue;
      }
      for (MaterialOverride& material : object.materials)
      {
        for (const auto picture : materialPictures)
        {
          added.insert((material.*picture).value_or(""));
        }
      }
    }
    added.erase("");
    return added.size();
  }

  void addModel(const Model& model)
  {
    std::vector<std::string> files{ model.path };
    files.insert(files.end(), model.companions.begin(), model.companions.end());
    const std::size_t own = model.textures.size() - this->addedTextures(model);
    for (std::size_t i = 0; i < model.textures.size(); ++i)
    {
      const Texture& texture = model.textures[i];
      if (i < own && !texture.path.empty())
      {
        files.push_back(texture.path);
      }
    }
    this->place(files);
    for (std::size_t i = own; i < model.textures.size(); ++i)
    {
      const Texture& texture = model.textures[i];
      if (!texture.path.empty())
      {
        this->place({ texture.path });
        this->Pictures[texture.name] = texture.path;
      }
    }
  }

  /// One that was not found keeps its name, and is not found again.
  void renamePictures(ObjectDescription& object)
  {
    for (MaterialOverride& material : object.materials)
    {
      for (const auto picture : materialPictures)
      {
        const auto found = this->Pictures.find((material.*picture).value_or(""));
        if (found != this->Pictures.end())
        {
          material.*picture = this->Plan.copies.at(found->second);
        }
      }
    }
  }

  void rename(std::string& written)
  {
    if (!written.empty())
    {
      const std::string file = this->Source.description().resolve(written);
      this->place({ file });
      written = this->Plan.copies.at(file);
    }
  }

  const Stage& Source;
  const fs::path Home; ///< of the scene
  Packing Plan;
  std::map<fs::path, std::string> Names; ///< folder -> name below `inputs`
  std::set<std::string> Taken;
  std::map<std::string, std::string> Pictures; ///< as a material names them -> file
};
} // namespace

void refuseOwnInputs(const Stage& stage, const std::string& folder)
{
  PathNames names;
  const std::string own = names.of(folder) + '/' + inputsFolder + '/';
  for (const std::string& file : stage.inputFiles())
  {
    if (names.of(file).compare(0, own.size(), own) == 0)
    {
      throw UsageError(folder + ": holds what the scene is loaded from; choose another folder");
    }
  }
}

Packing planPacking(const Stage& stage, const std::string& folder)
{
  for (const std::string& camera : stage.cameraNames())
  {
    if (camera == inputsFolder)
    {
      throw InputError(stage.description().title(), "cannot be packed: a camera has the name of the folder of inputs",
        "another name", quoted(camera));
    }
  }
  return Planner(stage, folder).run();
}

std::vector<InputRecord> recordedInputs(
  const Stage& stage, const std::string& folder, const Packing* packing, RunSession& session)
{
  std::vector<InputRecord> inputs = inputsOf(stage, folder, session);
  if (packing == nullptr) // a file may have two spellings, here and below
  {
    std::set<std::string> listed;
    inputs.erase(std::remove_if(inputs.begin(), inputs.end(),
                   [&](const InputRecord& input) { return !listed.insert(input.path).second; }),
      inputs.end());
    return inputs;
  }
  const std::vector<std::string> files = stage.inputFiles();
  std::map<std::string, InputRecord> copies;
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    const std::string& to = packing->copies.at(files[i]);
    copies.emplace(to, InputRecord{ to, inputs[i].bytes, inputs[i].sha256 });
  }
  std::vector<InputRecord> records;
  records.reserve(copies.size());
  for (const auto& [path, record] : copies)
  {
    records.push_back(record);
  }
  return records;
}

void checkPacking(const Packing& packing, const Stage& stage)
{
  const auto fail = [&](const std::string& file)
  {
    throw InputError(stage.description().title(),
      "cannot be packed: a model would not find the same files elsewhere (it names one by an absolute path?): " + file);
  };
  std::shared_ptr<const Stage> packed;
  try
  {
    packed = Stage::load(packing.scene);
  }
  catch (const InputError& error)
  {
    fail(error.what());
  }
  std::set<std::string> expected;
  for (const std::string& file : stage.inputFiles())
  {
    expected.insert(wholePath(packing.scene.resolve(packing.copies.at(file))).string());
  }
  for (const std::string& file : packed->inputFiles())
  {
    if (file != packing.scene.file && expected.count(wholePath(file).string()) == 0)
    {
      fail(file);
    }
  }
  for (std::size_t i = 0; i < stage.models().size(); ++i)
  {
    const Model& from = *stage.models()[i];
    const Model& to = *packed->models().at(i);
    for (std::size_t k = 0; k < from.textures.size(); ++k)
    {
      const std::string& file = from.textures[k].path;
      const bool same =
        k < to.textures.size() &&
        (file.empty() ? to.textures[k].path.empty()
                      : wholePath(to.textures[k].path) == wholePath(packing.scene.resolve(packing.copies.at(file))));
      if (!same)
      {
        fail(from.path + ": " + from.textures[k].name);
      }
    }
  }
}

} // namespace dgtk
