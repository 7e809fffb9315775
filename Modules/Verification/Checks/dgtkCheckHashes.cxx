// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"

#include "dgtkError.h"
#include "dgtkHash.h"
#include "dgtkRunParts.h"

#include <filesystem>
#include <set>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;

void checkFile(
  const Dataset& dataset, const std::string& path, std::uint64_t bytes, const std::string& sha256, Meter& meter)
{
  const std::string file = dataset.absolute(path);
  std::error_code error;
  const std::uint64_t found = fs::is_regular_file(file, error) ? fs::file_size(file, error) : 0;
  if (!fs::is_regular_file(file))
  {
    meter.equal(false, [&] { return Offender{ path, -1, -1, "no file", std::to_string(bytes) + " bytes" }; });
    return;
  }
  if (found != bytes)
  {
    meter.equal(false,
      [&] {
        return Offender{ path, -1, -1, std::to_string(found) + " bytes", std::to_string(bytes) + " bytes" };
      });
    return;
  }
  const std::string hash = Sha256::ofFile(file);
  meter.equal(hash == sha256, [&] { return Offender{ path, -1, -1, "SHA-256 " + hash, sha256 }; });
}

/// All files that the scene is made of, each once.
void checkInputs(const Dataset& dataset, Meter& meter)
{
  std::set<std::string> listed;
  for (const InputRecord& input : dataset.manifest().inputs)
  {
    meter.equal(listed.insert(input.path).second,
      [&] {
        return Offender{ input.path, -1, -1, "an input twice", "once" };
      });
    checkFile(dataset, input.path, input.bytes, input.sha256, meter);
  }
  std::set<fs::path> there;
  std::error_code code;
  for (const std::string& path : listed)
  {
    there.insert(fs::weakly_canonical(fs::path(dataset.folder()) / path, code));
  }
  const fs::path own = fs::weakly_canonical(fs::path(dataset.folder()) / "scene.json", code); // in place of the scene
  for (const std::string& file : dataset.hasStage() ? dataset.stage().inputFiles() : std::vector<std::string>())
  {
    const fs::path path = fs::weakly_canonical(file, code);
    meter.equal(path == own || there.count(path) > 0,
      [&] {
        return Offender{ file, -1, -1, "no input of the manifest", "one" };
      });
  }
}

/// Files that the manifest does not list, but for what a killed merge has left.
void checkUnlisted(const Dataset& dataset, Meter& meter)
{
  std::set<std::string> listed;
  for (const DatasetFile& file : dataset.manifest().files)
  {
    listed.insert(file.path);
  }
  std::set<std::string> present;
  for (const auto& entry : fs::recursive_directory_iterator(dataset.folder()))
  {
    const std::string path = entry.path().lexically_relative(dataset.folder()).generic_string();
    if (path.rfind(mergedName + std::string("/"), 0) == 0)
    {
      continue;
    }
    if ((entry.is_symlink() || !entry.is_directory()) && path != "manifest.json" && path != "verification.json")
    {
      present.insert(path);
    }
  }
  for (const std::string& path : present)
  {
    meter.equal(listed.count(path) > 0,
      [&] {
        return Offender{ path, -1, -1, "a file that the manifest does not list", "none" };
      });
  }
}
} // namespace

void checkHashes(Dataset& dataset, Results& results)
{
  const std::vector<DatasetFile>& files = dataset.manifest().files;
  std::vector<Meter> meters(files.size(), Meter(0));
  dataset.pool().parallelFor(static_cast<int>(files.size()),
    [&](int i) { checkFile(dataset, files[i].path, files[i].bytes, files[i].sha256, meters[i]); });
  Meter all(0);
  for (const Meter& meter : meters)
  {
    all.merge(meter);
  }
  results.add({ "files", "", {} }, all);

  Meter inputs(0);
  checkInputs(dataset, inputs);
  results.add({ "inputs", "", {} }, inputs);

  Meter unlisted(0);
  checkUnlisted(dataset, unlisted);
  results.add({ "unlisted", "", {} }, unlisted);
}

} // namespace dgtk
