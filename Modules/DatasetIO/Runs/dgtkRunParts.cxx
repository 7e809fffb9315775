// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRunParts.h"

#include "dgtkDocumentValues.h"
#include "dgtkError.h"
#include "dgtkFolderContents.h"
#include "dgtkJournal.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>

#include <unistd.h>

namespace dgtk
{

namespace
{
constexpr const char* runFormat = "DGTk run in parts";
constexpr const char* datasetsFormat = "DGTk datasets";
constexpr const char* workersStem = "workers-";
constexpr std::size_t usualBlocks = 256;
constexpr std::size_t largestBlock = 64;
constexpr Range anyCount{ 0, 9007199254740991.0, false, false, "a whole number from 0 to 2^53 - 1" };

std::string runFile() { return std::string(partsName) + "/run.json"; }

std::string runText(const RunParts& run)
{
  JsonObject object(2);
  object.text("format", runFormat)
    .integer("format_version", 1)
    .text("version", run.version)
    .text("request_hash", run.requestHash)
    .integer("items", std::int64_t(run.items))
    .boolean("contact_sheet", run.contactSheet)
    .raw("scenes", listText(run.scenes, jsonString))
    .raw("request", pairsText(run.request))
    .raw("left_out", listText(run.leftOut, jsonString));
  if (!run.exporter.empty())
  {
    object.text("exporter", run.exporter).text("dataset", run.dataset);
  }
  return object.block() + '\n';
}

std::string datasetsText(const DatasetsManifest& manifest)
{
  const auto text = [](const DatasetFile& file) { return fileObject(file).line(); };
  return JsonObject(2)
           .text("format", datasetsFormat)
           .integer("format_version", 1)
           .text("version", manifest.version)
           .text("request_hash", manifest.requestHash)
           .raw("request", pairsText(manifest.request))
           .raw("left_out", listText(manifest.leftOut, jsonString))
           .raw("datasets", arrayText(manifest.datasets, text))
           .block() +
         '\n';
}

bool isFormat(const JsonCursor& root, const char* format)
{
  return root.has("format") && root["format"].node().text == format;
}

/// Under a name of this process alone, then in place: others may write the same at the same time.
void writeBeside(const Folder& folder, const std::string& name, const std::string& text)
{
  char host[256] = {};
  ::gethostname(host, sizeof host - 1);
  const std::string own = name + '.' + host + '.' + std::to_string(::getpid());
  writeFileDurably(FilePlace(folder.path(), own), text);
  folder.rename(own, name);
}
} // namespace

std::size_t RunParts::blockSize() const
{
  return std::clamp<std::size_t>((this->items + usualBlocks - 1) / usualBlocks, 1, largestBlock);
}

std::size_t RunParts::blocks() const { return (this->items + this->blockSize() - 1) / this->blockSize(); }

std::string partName(std::size_t block)
{
  char number[32];
  std::snprintf(number, sizeof number, "/%06zu", block);
  return partsName + std::string(number);
}

bool hasParts(const std::string& folder) { return Folder(folder).look(runFile()) == EntryKind::File; }

bool holdsParts(const std::string& folder)
{
  const std::string place = folder + '/' + partsName;
  std::error_code code;
  const std::filesystem::directory_iterator entries(place, code);
  if (code)
  {
    return Folder(folder).look(partsName) != EntryKind::Nothing;
  }
  const std::string unfinished = std::filesystem::path(runFile()).filename().string() + '.';
  return std::any_of(begin(entries), end(entries),
    [&](const auto& entry) { return entry.path().filename().string().rfind(unfinished, 0) != 0; });
}

RunParts readParts(const std::string& path)
{
  const JsonDocument document = readJson(Folder(path).fileAt(runFile()));
  const JsonCursor root(document);
  if (!isFormat(root, runFormat))
  {
    root.fail("is not a run of DGTk in parts");
  }
  root["format_version"].number({ 1, 1, false, false, "1" });
  RunParts run;
  run.version = root["version"].text();
  run.requestHash = hashOf(root["request_hash"]);
  run.items = std::size_t(root["items"].wholeNumber(anyCount));
  run.contactSheet = root["contact_sheet"].boolean();
  run.scenes = textsIn(root["scenes"]);
  run.request = pairsIn(root["request"]);
  run.leftOut = textsIn(root["left_out"]);
  if (root.has("exporter"))
  {
    run.exporter = root["exporter"].text();
    run.dataset = root["dataset"].text();
  }
  for (const std::string& scene : run.scenes)
  {
    if (!Folder::isPlain(scene))
    {
      root["scenes"].fail("leads out of the folder: " + quoted(scene));
    }
  }
  return run;
}

void requireRoomForParts(const std::string& folder, const std::string& requestHash)
{
  // Looked for before and after: another process may begin them meanwhile.
  const FolderContents contents = hasParts(folder) ? FolderContents::Nothing : folderContents(folder, requestHash);
  if (contents != FolderContents::Nothing && !hasParts(folder))
  {
    throw FolderError(folder, contents);
  }
}

void beginParts(const std::string& path, const RunParts& run, std::size_t workers, bool replace)
{
  makeFolders(path);
  const Folder folder(path);
  const std::string text = runText(run);
  if (replace || !hasParts(path))
  {
    folder.makeParents(runFile());
    writeBeside(folder, runFile(), text);
  }
  if (const RunParts there = readParts(path); runText(there) != text)
  {
    throw UsageError(path + ": " + describe(FolderContents::UnfinishedOther) + ", in parts; remove " +
                     (there.scenes.empty() ? std::string("its ") + partsName : "it") + ", or name another folder");
  }
  const auto noteOf = [](std::size_t count)
  { return std::string(partsName) + '/' + workersStem + std::to_string(count); };
  if (replace)
  {
    for (const std::size_t count : workersOf(path))
    {
      folder.remove(noteOf(count));
    }
  }
  const std::string note = noteOf(workers);
  if (folder.look(note) == EntryKind::Nothing)
  {
    writeBeside(folder, note, "");
  }
}

DatasetsManifest readDatasets(const std::string& path)
{
  const JsonDocument document = readJson(Folder(path).fileAt(manifestName));
  const JsonCursor root(document);
  if (!isFormat(root, datasetsFormat))
  {
    root.fail("is not the manifest of a folder of DGTk datasets");
  }
  root["format_version"].number({ 1, 1, false, false, "1" });
  DatasetsManifest manifest;
  manifest.version = root["version"].text();
  manifest.requestHash = hashOf(root["request_hash"]);
  manifest.request = pairsIn(root["request"]);
  manifest.leftOut = textsIn(root["left_out"]);
  std::set<std::string> there;
  for (const JsonCursor& item : root["datasets"].items())
  {
    manifest.datasets.push_back(fileOf(item));
    const std::filesystem::path file(manifest.datasets.back().path);
    if (file.filename() != manifestName || !file.has_parent_path() || !there.insert(file.string()).second)
    {
      item["path"].fail("is not the manifest of a further dataset", "FOLDER/manifest.json", quoted(file.string()));
    }
  }
  return manifest;
}

std::string datasetsManifestText(const DatasetsManifest& manifest) { return datasetsText(manifest); }

std::vector<std::size_t> workersOf(const std::string& folder)
{
  std::set<std::size_t> counts;
  const std::filesystem::path parts = std::filesystem::path(folder) / partsName;
  for (const auto& entry : std::filesystem::directory_iterator(parts))
  {
    const std::string name = entry.path().filename().string();
    const std::string number = name.rfind(workersStem, 0) == 0 ? name.substr(std::string(workersStem).size()) : "";
    if (!number.empty() && number.find_first_not_of("0123456789") == std::string::npos && number.size() < 10)
    {
      counts.insert(std::stoul(number));
    }
  }
  return { counts.begin(), counts.end() };
}

} // namespace dgtk
