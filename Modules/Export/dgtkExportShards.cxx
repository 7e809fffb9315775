// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportShards.h"

#include "dgtkAgainError.h"
#include "dgtkExportDocument.h"
#include "dgtkExportRun.h"
#include "dgtkFolderContents.h"
#include "dgtkHash.h"
#include "dgtkSceneFolders.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

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

std::string sha256Of(const std::string& text)
{
  Sha256 hash;
  hash.update(text.data(), text.size());
  return hash.hex();
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
    run.requestHash = sha256Of(text);
  }
  return run;
}

/// Whether the export that a folder holds is the whole of this one. Throws where anything else is in the way of parts.
bool isWhole(const std::string& folder, const std::string& hash)
{
  std::error_code code;
  if (fs::is_regular_file(folder + '/' + exportName, code) && !hasParts(folder))
  {
    if (readExportIn(folder).requestHash == hash)
    {
      return true;
    }
    throw FolderError(folder, FolderContents::FinishedOther);
  }
  if (!hasParts(folder))
  {
    const FolderContents contents = folderContents(folder, hash);
    if (contents != FolderContents::Nothing && !hasParts(folder)) // another process may have begun it meanwhile
    {
      throw FolderError(folder, contents);
    }
  }
  return false;
}

/// Adds what a block left to what others did; false when it was interrupted.
bool add(const ExportResult& one, ExportResult& all)
{
  all.files += one.files;
  all.kept += one.kept;
  all.interrupted = one.interrupted;
  return !one.interrupted;
}

[[noreturn]] void failBusy(const std::string& folder, std::size_t blocks)
{
  throw AgainError(folder + ": another process is busy with " + std::to_string(blocks) + " of these blocks");
}

bool isExported(const ExportRequest& request, const ExportRun& run)
{
  std::error_code code;
  return fs::is_regular_file(request.folder + '/' + exportName, code) &&
         readExportIn(request.folder).requestHash == run.hash();
}

ExportResult shardOfScenes(const ExportRequest& request, const std::vector<std::string>& scenes, const RunShard& shard,
  const ExportCallbacks& callbacks)
{
  const RunParts run = partsOf(request, scenes);
  if (hasParts(request.folder) || folderContents(request.folder, {}) == FolderContents::Nothing)
  {
    beginParts(request.folder, run, shard.count);
  } // else they may be the whole already: each scene says what is in its way
  ExportResult all;
  std::size_t busy = 0;
  for (std::size_t block = shard.index; block < run.blocks(); block += shard.count)
  {
    for (std::size_t i = blockOf(run, block).first; i < blockOf(run, block).end; ++i)
    {
      ExportRequest one = sceneExport(request, scenes[i]);
      one.resume = true;
      try
      {
        ExportRun scene(one, callbacks);
        if (!isExported(one, scene) && !add(scene.execute(), all))
        {
          return all;
        }
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
  }
  if (busy > 0)
  {
    failBusy(request.folder, busy);
  }
  return all;
}

ExportResult shardOfItems(const ExportRequest& request, const RunShard& shard, const ExportCallbacks& callbacks)
{
  ExportRun whole(request, callbacks);
  if (isWhole(request.folder, whole.hash()))
  {
    return {};
  }
  RunParts run = partsOf(request, {});
  run.requestHash = whole.hash();
  run.items = whole.items();
  beginParts(request.folder, run, shard.count);
  ExportResult all;
  std::size_t busy = 0;
  for (std::size_t block = shard.index; block < run.blocks(); block += shard.count)
  {
    try
    {
      if (!add(whole.executeBlock(request.folder + '/' + partName(block), blockOf(run, block)), all))
      {
        return all;
      }
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
  if (busy > 0)
  {
    failBusy(request.folder, busy);
  }
  return all;
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
    if (isExported(one, ExportRun(one, {})))
    {
      report.files += readExportIn(one.folder).files.size();
    }
    else if (report.missing.empty() || report.missing.back() != block)
    {
      report.missing.push_back(block);
    }
  }
  report.merged = report.missing.empty();
  if (report.merged)
  {
    fs::remove_all(folder + '/' + partsName);
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
    moveUp(whole, folder);
  }
  fs::remove_all(folder + '/' + partsName);
  report.files = readExportIn(folder).files.size();
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
