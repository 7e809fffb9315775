// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCheck.h"

#include "dgtkError.h"
#include "dgtkHash.h"

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

/// Files that the manifest does not list.
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
  for (const InputRecord& input : dataset.manifest().inputs)
  {
    checkFile(dataset, input.path, input.bytes, input.sha256, inputs);
  }
  results.add({ "inputs", "", {} }, inputs);

  Meter unlisted(0);
  checkUnlisted(dataset, unlisted);
  results.add({ "unlisted", "", {} }, unlisted);
}

} // namespace dgtk
