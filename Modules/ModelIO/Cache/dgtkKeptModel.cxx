// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkKeptModel.h"

#include "dgtkError.h"
#include "dgtkHash.h"
#include "dgtkHelperProcess.h"
#include "dgtkModelEntry.h"
#include "dgtkModelFiles.h"
#include "dgtkModelFolder.h"

#include <algorithm>
#include <filesystem>

#include <dlfcn.h>
#include <sys/stat.h>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;
constexpr int layout = 1; ///< of the files
constexpr std::uint64_t largestKept = std::uint64_t(1) << 32;

/// A file of the machine, by its size and times, without reading it.
std::string stampOf(const std::string& path)
{
  std::error_code code;
  const auto time = fs::last_write_time(path, code).time_since_epoch().count();
  const std::uint64_t bytes = code ? 0 : fs::file_size(path, code);
  return code ? std::string() : path + ' ' + std::to_string(bytes) + ' ' + std::to_string(time);
}

/// The library that this code is in: another one may read another model from the same bytes.
const std::string& ownStamp()
{
  static const std::string stamp = []
  {
    Dl_info info{};
    const bool known = ::dladdr(reinterpret_cast<const void*>(&ownStamp), &info) != 0 && info.dli_fname;
    return known ? stampOf(info.dli_fname) : std::string();
  }();
  return stamp;
}

std::string programPath(const ModelDependency& program)
{
  if (program.name[0] == '/')
  {
    return program.name;
  }
  const bool isOurs = program.name.rfind("dgtk-", 0) == 0;
  return isOurs ? helper::findProgram(program.name.c_str(), program.found.c_str())
                : helper::installedProgram(program.name, program.found);
}
} // namespace

KeptModel::KeptModel(std::shared_ptr<ModelCache> cache, const std::string& path, const std::string& format)
  : Cache(std::move(cache))
  , Path(path)
  , Begin(timeOfFiles())
{
  std::error_code code;
  this->Absolute = fs::absolute(path, code).string();
  const FileAge age(path);
  this->Bytes = age.bytes();
  if (!this->Cache || code || !age.isFile() || this->Bytes > largestKept || ownStamp().empty())
  {
    return;
  }
  try
  {
    Sha256 key;
    const std::string words = "model " + std::to_string(layout) + '\n' + ownStamp() + '\n' + format + '\n' +
                              fs::path(path).filename().string() + '\n' + hashOfFile(path);
    key.update(words.data(), words.size());
    this->File = this->Cache->folder() + '/' + key.hex() + ".model";
  }
  catch (const InputError&)
  {
    // the reader says so better
  }
}

/// "" for a name that led to nothing, or that leads by links to where the model may not look.
std::string KeptModel::fileOf(const ModelDependency& dependency) const
{
  const bool isNamed = dependency.kind == ModelDependency::Kind::Named;
  const std::string& name = isNamed ? dependency.found : dependency.name;
  const fs::path folder = fs::path(this->Absolute).parent_path();
  const std::string file = name.empty() ? name : (folder / name).string();
  return isNamed || liesBeneath(file, folder.parent_path().string()) ? file : std::string();
}

/// "" for a file that is not there.
std::string KeptModel::identityOf(const ModelDependency& dependency) const
{
  if (dependency.kind == ModelDependency::Kind::Program)
  {
    return stampOf(programPath(dependency));
  }
  const std::string file = this->fileOf(dependency);
  return FileAge(file).isFile() ? hashOfFile(file) : std::string();
}

/// Since reading began.
bool KeptModel::isUnchanged(const ModelDependency& dependency) const
{
  const FileAge age(this->fileOf(dependency));
  return dependency.kind == ModelDependency::Kind::Program || !age.isFile() || age.isOlderThan(this->Begin);
}

std::optional<ModelContents> KeptModel::find() const
{
  ModelEntry entry;
  if (this->File.empty() || !readModelEntry(this->File, entry))
  {
    return std::nullopt;
  }
  ModelContents& contents = entry.contents;
  ModelFiles files(this->Absolute);
  for (std::size_t i = 0; i < contents.dependencies.size(); ++i)
  {
    const ModelDependency& dependency = contents.dependencies[i];
    if ((dependency.kind == ModelDependency::Kind::Named &&
          files.relative(files.find(dependency.name)) != dependency.found) ||
        this->identityOf(dependency) != entry.identities[i])
    {
      return std::nullopt;
    }
  }
  contents.model->path = this->Path;
  contents.model->companions = files.companions(this->Path);
  const fs::path folder = fs::path(this->Path).parent_path();
  for (const ModelDependency& dependency : contents.dependencies)
  {
    if (dependency.kind == ModelDependency::Kind::Beside && !this->identityOf(dependency).empty())
    {
      contents.model->companions.push_back((folder / dependency.name).lexically_normal().string());
    }
  }
  std::sort(contents.model->companions.begin(), contents.model->companions.end());
  std::error_code code;
  fs::last_write_time(this->File, fs::file_time_type::clock::now(), code); // used just now
  return std::move(contents);
}

ModelContents KeptModel::keep(ModelContents contents) const
{
  const auto unchanged = [this](const ModelDependency& dependency) { return this->isUnchanged(dependency); };
  if (this->File.empty() || contents.keptFrom > this->Bytes ||
      !std::all_of(contents.dependencies.begin(), contents.dependencies.end(), unchanged))
  {
    return contents;
  }
  ModelEntry entry{ std::move(contents), {} };
  try
  {
    for (const ModelDependency& dependency : entry.contents.dependencies)
    {
      entry.identities.push_back(this->identityOf(dependency));
    }
    if (FileAge(this->Path).isOlderThan(this->Begin))
    {
      this->Cache->makeFolder();
      writeModelEntry(this->File, entry);
      this->Cache->added(this->File);
    }
  }
  catch (const std::exception&)
  {
    // it is read again next time
  }
  return std::move(entry.contents);
}

} // namespace dgtk
