// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkReportSource.h"

#include "dgtkError.h"
#include "dgtkFolder.h"
#include "dgtkJournal.h"
#include "dgtkRandom.h"

#include <algorithm>
#include <filesystem>
#include <numeric>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;

constexpr std::uint32_t sceneStream = 0;
constexpr std::uint32_t pictureStream = 1;

/// Names of the folders with a manifest; links are none.
std::vector<std::string> scenesIn(const std::string& path)
{
  const Folder folder(path);
  std::vector<std::string> names;
  std::error_code failed;
  for (fs::directory_iterator at(path, failed), end; !failed && at != end; at.increment(failed))
  {
    const std::string name = at->path().filename().string();
    std::error_code unknown;
    if (at->symlink_status(unknown).type() == fs::file_type::directory &&
        folder.look(name + '/' + manifestName) == EntryKind::File)
    {
      names.push_back(name);
    }
  }
  std::sort(names.begin(), names.end());
  return names;
}

[[noreturn]] void refuse(const std::string& folder)
{
  requireFinished(folder);
  throw InputError(folder, "is not a dataset", "a folder with manifest.json, or with folders that have one");
}
} // namespace

std::vector<std::size_t> drawnOf(std::size_t total, std::size_t count, std::uint64_t seed, std::uint32_t stream)
{
  std::vector<std::size_t> all(total);
  std::iota(all.begin(), all.end(), std::size_t(0));
  if (count == 0 || count >= total)
  {
    return all;
  }
  const PhiloxKey key{ std::uint32_t(seed), std::uint32_t(seed >> 32) };
  std::vector<std::pair<std::uint64_t, std::size_t>> ranks(total);
  for (std::size_t i = 0; i < total; ++i)
  {
    const PhiloxCounter bits = philox({ std::uint32_t(i), std::uint32_t(std::uint64_t(i) >> 32), stream, 0 }, key);
    ranks[i] = { std::uint64_t(bits[0]) << 32 | bits[1], i };
  }
  std::nth_element(ranks.begin(), ranks.begin() + std::ptrdiff_t(count), ranks.end());
  all.resize(count);
  std::transform(
    ranks.begin(), ranks.begin() + std::ptrdiff_t(count), all.begin(), [](const auto& one) { return one.second; });
  std::sort(all.begin(), all.end());
  return all;
}

ReportSource::ReportSource(const ReportRequest& request)
{
  const Folder folder(request.dataset);
  const bool whole = folder.look("cameras.json") == EntryKind::File && folder.look(manifestName) != EntryKind::Nothing;
  const std::vector<std::string> names = whole ? std::vector<std::string>() : scenesIn(request.dataset);
  this->many = !names.empty();
  this->scenesFound = std::max<std::size_t>(1, names.size());
  if (!this->many)
  {
    if (folder.look(manifestName) == EntryKind::Nothing)
    {
      refuse(request.dataset);
    }
    this->scenes.push_back({ "", std::make_unique<DatasetView>(request.dataset) });
  }
  // a scene has a picture at least, so more scenes than pictures that are read would be opened in vain
  for (const std::size_t i : drawnOf(names.size(), request.read, request.seed, sceneStream))
  {
    try
    {
      this->scenes.push_back({ names[i], std::make_unique<DatasetView>(folder.pathOf(names[i])) });
    }
    catch (const Error& error)
    {
      this->notes.emplace_back(error.what());
    }
  }
  if (this->scenes.empty())
  {
    throw InputError(request.dataset, "none of its " + std::to_string(names.size()) +
                                        " scenes can be read: " + (this->notes.empty() ? "" : this->notes.front()));
  }
  for (std::size_t scene = 0; scene < this->scenes.size(); ++scene)
  {
    for (const DatasetShot& shot : this->scenes[scene].view->shots())
    {
      this->pictures.push_back({ scene, &shot });
    }
  }
  this->read = drawnOf(this->pictures.size(), request.read, request.seed, pictureStream);
  const std::size_t most = request.shown == 0 ? this->read.size() : std::min(request.shown, this->read.size());
  this->shown =
    most == this->read.size() ? this->read : drawnOf(this->pictures.size(), most, request.seed, pictureStream);
}

} // namespace dgtk
