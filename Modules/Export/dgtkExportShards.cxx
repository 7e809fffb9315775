// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportShards.h"

#include "dgtkAgainError.h"
#include "dgtkExportDocument.h"
#include "dgtkExportRun.h"
#include "dgtkFolderContents.h"
#include "dgtkHash.h"
#include "dgtkJournal.h"
#include "dgtkLongDocuments.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;

constexpr const char* framesKey = "frames";
/// Where the export is put together, on the disk of its parts.
constexpr const char* wholeName = "whole";

ItemRange blockOf(const RunParts& run, std::size_t block)
{
  return { block * run.blockSize(), std::min(run.items, (block + 1) * run.blockSize()) };
}

/// What mergeExport() repeats the request from: the options that were given but those that decide no bytes.
TextPairs given(const ExportRequest& request)
{
  TextPairs pairs;
  const DatasetSelection& frames = request.selection;
  if (frames.someFrames)
  {
    pairs.emplace_back(
      framesKey, std::to_string(frames.first) + ':' + std::to_string(frames.last) + ':' + std::to_string(frames.step));
  }
  for (const auto& [name, value] : request.options)
  {
    if (name != exported::threads().name && name != exported::link().name)
    {
      pairs.emplace_back(name, value);
    }
  }
  return pairs;
}

ExportRequest requestOf(const RunParts& run, const std::string& folder)
{
  ExportRequest request;
  request.dataset = run.dataset;
  request.folder = folder;
  request.format = run.exporter;
  request.resume = true;
  for (const auto& [name, value] : run.request)
  {
    DatasetSelection& frames = request.selection;
    if (name != framesKey)
    {
      request.options[name] = value;
    }
    else if (std::sscanf(value.c_str(), "%d:%d:%d", &frames.first, &frames.last, &frames.step) == 3)
    {
      frames.someFrames = true;
    }
  }
  return request;
}

RunParts partsOf(const ExportRequest& request, const std::vector<std::string>& scenes)
{
  RunParts run;
  run.version = DGTK_VERSION;
  run.exporter = request.format;
  run.dataset = fs::canonical(request.dataset).string();
  run.request = given(request);
  run.scenes = scenes;
  run.items = scenes.size();
  if (!scenes.empty())
  {
    std::string text = run.version + '\n' + run.exporter + '\n' + Sha256::ofFile(request.dataset + '/' + manifestName);
    for (const auto& [name, value] : run.request)
    {
      text += '\n' + name + '=' + value;
    }
    run.requestHash = Sha256::of(text);
  }
  return run;
}

/// Whether a folder holds the whole export with this hash; `intact`: its files are compared with their hashes, too.
bool holdsExport(const std::string& folder, const std::string& hash, bool intact)
{
  std::error_code code;
  if (!fs::is_regular_file(folder + '/' + exportName, code))
  {
    return false;
  }
  const Folder holder(folder);
  bool whole = true;
  const ExportRecord record = readExportIn(
    folder, [](ExportedName&&) {},
    [&](ExportedFile&& one) { whole = whole && (!intact || isWhole(holder, one.file)); });
  return whole && record.requestHash == hash;
}

std::size_t filesIn(const std::string& folder)
{
  std::size_t files = 0;
  readExportIn(
    folder, [](ExportedName&&) {}, [&](ExportedFile&&) { ++files; });
  return files;
}

/// Of the blocks of a share.
std::size_t itemsOf(const RunParts& run, const RunShard& shard)
{
  std::size_t items = 0;
  for (std::size_t block = shard.index; block < run.blocks(); block += shard.count)
  {
    items += blockOf(run, block).end - blockOf(run, block).first;
  }
  return items;
}

/// Calls work(block) for the blocks of a share, until one is interrupted.
ExportResult forBlocks(const RunParts& run, const RunShard& shard, const std::string& folder,
  const std::function<ExportResult(std::size_t block)>& work)
{
  ExportResult all;
  std::size_t busy = 0;
  for (std::size_t block = shard.index; block < run.blocks() && !all.interrupted; block += shard.count)
  {
    try
    {
      addResult(work(block), all);
    }
    catch (const FolderError& error)
    {
      if (error.contents() != FolderContents::Running)
      {
        throw;
      }
      ++busy;
    }
  }
  if (busy > 0 && !all.interrupted)
  {
    throw AgainError(folder + ": another process is busy with " + std::to_string(busy) + " of these blocks");
  }
  return all;
}

ExportResult shardOfScenes(const ExportRequest& request, const std::vector<std::string>& scenes, const RunShard& shard,
  const ExportCallbacks& callbacks)
{
  const auto isDone = [&](const std::string& name, bool intact)
  {
    const ExportRequest one = sceneExport(request, name);
    return holdsExport(one.folder, ExportRun(one, {}).hash(), intact);
  };
  if (!hasParts(request.folder) &&
      std::count_if(scenes.begin(), scenes.end(), [&](const std::string& name) { return isDone(name, false); }) ==
        std::ptrdiff_t(scenes.size())) // each is asked, so that one that cannot be said is refused before any is begun
  {
    return {};
  }
  requireRoomForParts(request.folder);
  const RunParts run = partsOf(request, scenes);
  beginParts(request.folder, run, shard.count);
  ScenePlace place;
  place.scenes = itemsOf(run, shard);
  return forBlocks(run, shard, request.folder,
    [&](std::size_t block)
    {
      ExportResult all;
      for (std::size_t i = blockOf(run, block).first; i < blockOf(run, block).end && !all.interrupted; ++i)
      {
        ExportRequest one = sceneExport(request, scenes[i]);
        one.resume = true;
        if (isDone(scenes[i], true))
        {
          ++place.keptScenes;
        }
        else
        {
          const ExportResult result = ExportRun(one, sceneCallbacks(callbacks, place)).execute();
          place.keptItems += result.kept;
          addResult(result, all);
        }
        ++place.scene;
      }
      return all;
    });
}

ExportResult shardOfItems(const ExportRequest& request, const RunShard& shard, const ExportCallbacks& callbacks)
{
  ExportRun whole(request, callbacks);
  whole.requireOneEach();
  if (!hasParts(request.folder) && holdsExport(request.folder, whole.hash(), false))
  {
    return {};
  }
  std::error_code code;
  if (!hasParts(request.folder) && fs::exists(request.folder + '/' + exportName, code))
  {
    throw FolderError(request.folder, FolderContents::FinishedOther);
  }
  requireRoomForParts(request.folder, whole.hash());
  RunParts run = partsOf(request, {});
  run.requestHash = whole.hash();
  run.items = whole.items();
  beginParts(request.folder, run, shard.count);
  whole.count(itemsOf(run, shard));
  return forBlocks(run, shard, request.folder,
    [&](std::size_t block) { return whole.executeBlock(request.folder + '/' + partName(block), blockOf(run, block)); });
}

MergeReport beginReport(const std::string& folder, const RunParts& run)
{
  MergeReport report;
  report.blocks = run.blocks();
  report.workers = workersOf(folder);
  return report;
}

MergeReport mergeScenes(const std::string& folder, const RunParts& run)
{
  MergeReport report = beginReport(folder, run);
  const ExportRequest request = requestOf(run, folder);
  for (std::size_t i = 0; i < run.items; ++i)
  {
    const ExportRequest one = sceneExport(request, run.scenes[i]);
    const std::size_t block = i / run.blockSize();
    if (holdsExport(one.folder, ExportRun(one, {}).hash(), true))
    {
      removeLeftJournal(one.folder, exportName);
      report.files += filesIn(one.folder);
    }
    else if (report.missing.empty() || report.missing.back() != block)
    {
      report.missing.push_back(block);
    }
  }
  report.merged = report.missing.empty();
  if (report.merged)
  {
    removeParts(folder);
  }
  return report;
}

/// What was put together goes where it belongs, the document of the whole last.
void moveUp(const std::string& whole, const std::string& folder)
{
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(whole))
  {
    names.push_back(entry.path().filename().string());
  }
  const auto last =
    std::partition(names.begin(), names.end(), [](const std::string& name) { return name != exportName; });
  std::sort(names.begin(), last);
  for (const std::string& name : names)
  {
    const std::string target = folder + '/' + name;
    std::error_code code;
    if (fs::symlink_status(target, code).type() != fs::file_type::not_found)
    {
      throw UsageError(target + ": is in the way of a file of the export");
    }
    fs::rename(whole + '/' + name, target, code);
    if (code)
    {
      throw MachineError(target + ": cannot be put in place: " + code.message());
    }
  }
}

MergeReport mergeItems(const std::string& folder, const RunParts& run)
{
  MergeReport report = beginReport(folder, run);
  const std::string whole = folder + '/' + partsName + '/' + wholeName;
  std::error_code code;
  if (!fs::exists(whole + '/' + exportName, code) && !fs::exists(folder + '/' + exportName, code))
  {
    const ExportRequest request = requestOf(run, whole);
    ExportRun joined(request, {});
    if (joined.hash() != run.requestHash)
    {
      throw UsageError(folder + ": the dataset has changed since its export was begun, " + run.dataset);
    }
    std::vector<std::pair<std::string, ItemRange>> blocks;
    for (std::size_t block = 0; block < run.blocks(); ++block)
    {
      blocks.emplace_back(folder + '/' + partName(block), blockOf(run, block));
      if (!joined.holdsBlock(blocks.back().first, blocks.back().second))
      {
        report.missing.push_back(block);
      }
    }
    if (!report.missing.empty())
    {
      return report;
    }
    joined.executeFrom(blocks);
  }
  if (fs::exists(whole, code))
  {
    removeLeftJournal(whole, exportName);
    moveUp(whole, folder);
  }
  removeParts(folder);
  report.files = filesIn(folder);
  report.merged = true;
  return report;
}
} // namespace

ExportResult exportShard(const ExportRequest& request, const RunShard& shard, const ExportCallbacks& callbacks)
{
  if (shard.count < 1 || shard.index >= shard.count)
  {
    throw UsageError("a share of an export is I of N with I below N, found " + std::to_string(shard.index) + " of " +
                     std::to_string(shard.count));
  }
  if (request.replace)
  {
    throw UsageError("a share of an export replaces nothing: others may be at work in its folder");
  }
  requireOutsideDatasets(request.folder);
  const std::vector<std::string> scenes = scenesApart(request);
  return scenes.empty() ? shardOfItems(request, shard, callbacks) : shardOfScenes(request, scenes, shard, callbacks);
}

MergeReport mergeExport(const std::string& folder)
{
  const RunParts run = readParts(folder);
  if (run.exporter.empty())
  {
    throw UsageError(folder + ": holds no parts of an export");
  }
  return run.scenes.empty() ? mergeItems(folder, run) : mergeScenes(folder, run);
}

} // namespace dgtk
