// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRunShards.h"

#include "dgtkAgainError.h"
#include "dgtkFile.h"
#include "dgtkFolder.h"
#include "dgtkFolderScenes.h"
#include "dgtkHash.h"
#include "dgtkJournal.h"
#include "dgtkRunParts.h"
#include "dgtkRunSession.h"
#include "dgtkSceneFile.h"
#include "dgtkSceneFolders.h"
#include "dgtkText.h"
#include "dgtkWorkPlan.h"

#include <algorithm>
#include <filesystem>
#include <set>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;

std::string joinedFrames(const GeneratorRequest& request)
{
  return request.frames ? std::to_string(request.frames->first) + ':' + std::to_string(request.frames->last) + ':' +
                            std::to_string(request.frames->step)
                        : "all";
}

/// What a run of many scenes was asked for. Threads and such do not count.
std::vector<std::pair<std::string, std::string>> described(const GeneratorRequest& request)
{
  std::vector<std::pair<std::string, std::string>> pairs{ { "layers", joined(request.layers, ",") },
    { "cameras", request.cameras.empty() ? "all" : joined(request.cameras, ",") }, { "frames", joinedFrames(request) },
    { "size", request.width > 0 ? std::to_string(request.width) + 'x' + std::to_string(request.height) : "own" } };
  for (const auto& [name, value] : request.options)
  {
    if (name != option::threads().name && name != option::gl().name)
    {
      pairs.emplace_back(name, value);
    }
  }
  return pairs;
}

RunParts partsOf(const GeneratorRequest& request, const FolderScenes& files)
{
  RunParts run;
  run.version = DGTK_VERSION;
  run.items = files.scenes.size();
  run.request = described(request);
  if (!request.classes.empty())
  {
    run.request.emplace_back(classesKey, classesText(request.classes));
  }
  run.leftOut = files.leftOut;
  std::string text = run.version;
  for (const auto& [key, value] : run.request)
  {
    text += '\n' + key + '=' + value;
  }
  for (const auto& [name, path] : files.scenes)
  {
    run.scenes.push_back(name);
    text += '\n' + Sha256::ofFile(path) + ' ' + name;
  }
  text += files.classes.empty() ? "" : '\n' + classesText(files.classes);
  run.requestHash = Sha256::of(text);
  return run;
}

/// Whether the folder holds the whole of this run already. Throws where it holds something else.
bool isWhole(const std::string& folder, const RunParts& run, bool replace)
{
  std::error_code code;
  const bool finished = fs::is_regular_file(folder + '/' + manifestName, code);
  if (!finished && !hasParts(folder))
  {
    requireRoomForParts(folder);
    return false;
  }
  if (finished && sceneFoldersIn(folder).empty())
  {
    throw FolderError(folder, FolderContents::FinishedOther);
  }
  const std::string hash = finished ? readDatasets(folder).requestHash : readParts(folder).requestHash;
  if (hash != run.requestHash && !replace)
  {
    throw FolderError(folder, finished ? FolderContents::FinishedOther : FolderContents::UnfinishedOther);
  }
  return finished && hash == run.requestHash;
}

/// Names of the scenes that the folder holds datasets of.
std::vector<std::string> heldScenes(const std::string& folder)
{
  if (hasParts(folder))
  {
    return readParts(folder).scenes;
  }
  return sceneFoldersIn(folder);
}

/// Datasets are replaced one by one: each that is there has to be of one of these scenes.
void requireReplacing(const std::string& folder, const RunParts& run)
{
  for (const std::string& name : heldScenes(folder))
  {
    const bool isReplaced = std::find(run.scenes.begin(), run.scenes.end(), name) != run.scenes.end();
    std::error_code code;
    if (!isReplaced && std::filesystem::exists(folder + '/' + name, code)) // not of a scene that could not be rendered
    {
      throw UsageError(folder + ": holds a dataset of another run, " + dgtk::quoted(name) +
                       ", which no scene of this one replaces; remove it, or name another folder");
    }
  }
}

/// Scenes one after another, whatever decides which.
class SceneRuns
{
public:
  SceneRuns(const GeneratorRequest& request, const FolderScenes& files, const GeneratorCallbacks& callbacks)
    : Request(request)
    , Files(files)
    , Callbacks(callbacks)
    , Session(makeRunSession())
  {
  }

  /// Throws where the dataset of a scene is of another request: models may have changed since.
  void requireSame(std::size_t scene) const
  {
    const GeneratorRequest one = this->requestOf(scene);
    if (folderContents(one.folder, requestHash(one)) == FolderContents::FinishedOther)
    {
      throw FolderError(one.folder, FolderContents::FinishedOther);
    }
  }

  /// False after an interruption.
  bool render(std::size_t scene, bool keep)
  {
    GeneratorRequest one = this->requestOf(scene);
    if (keep && this->isDone(one))
    {
      ++this->Kept;
      this->advance();
      return true;
    }
    one.resume = keep;
    one.replace = !keep && this->Request.replace;
    GeneratorCallbacks own;
    own.cancel = this->Callbacks.cancel;
    own.message = [&](const std::string& line)
    {
      if (this->Callbacks.message && this->Said.insert(line).second && this->Said.size() < mostLines)
      {
        this->Callbacks.message(this->Files.scenes[scene].first + ": " + line);
      }
    };
    try
    {
      const GeneratorResult result = generate(one, own);
      this->Result.pictures += result.pictures;
      this->Result.files += result.files;
      this->Result.kept += result.kept;
      this->Result.visibility = result.visibility;
      this->Result.interrupted = result.interrupted;
    }
    catch (const InputError& error)
    {
      this->fail(error.what());
    }
    catch (const FolderError& error)
    {
      if (error.contents() != FolderContents::Running)
      {
        throw;
      }
      ++this->Busy;
    }
    catch (const UsageError& error)
    {
      const std::string line = this->Files.scenes[scene].first + ": " + error.what();
      if (this->Done == 0)
      {
        throw UsageError(line); // the request rather than a scene
      }
      this->fail(line);
    }
    this->advance();
    return !this->Result.interrupted;
  }

  void begin(std::size_t total)
  {
    this->Total = total;
    this->report();
  }
  /// Throws for what has failed.
  void end(const std::string& folder) const
  {
    if (this->Failed > 0)
    {
      throw InputError(folder, std::to_string(this->Failed) + " of " + std::to_string(this->Total) +
                                 " scenes could not be rendered; the first: " + this->FirstFailure);
    }
    if (this->Busy > 0)
    {
      throw AgainError(folder + ": another process is writing " + std::to_string(this->Busy) + " of these datasets");
    }
  }
  GeneratorResult Result;

private:
  static constexpr std::size_t mostLines = 1000;

  GeneratorRequest requestOf(std::size_t scene) const
  {
    GeneratorRequest one = this->Request;
    one.scene = this->Files.scenes[scene].second;
    one.folder += '/' + this->Files.scenes[scene].first;
    one.session = this->Session;
    one.classes = one.classes.empty() ? this->Files.classes : one.classes;
    return one;
  }
  /// A whole dataset of the same request; its contents are compared when it is merged.
  bool isDone(const GeneratorRequest& one) const
  {
    std::error_code code;
    return fs::is_regular_file(one.folder + '/' + manifestName, code) && isFinished(one.folder, requestHash(one));
  }
  void fail(const std::string& line)
  {
    this->FirstFailure = this->Failed == 0 ? line : this->FirstFailure;
    ++this->Failed;
    if (this->Callbacks.message)
    {
      this->Callbacks.message("warning: " + line);
    }
  }
  void advance()
  {
    ++this->Done;
    this->report();
  }
  void report() const
  {
    if (this->Callbacks.progress)
    {
      this->Callbacks.progress({ this->Done, this->Total, this->Kept });
    }
  }

  const GeneratorRequest& Request;
  const FolderScenes& Files;
  const GeneratorCallbacks& Callbacks;
  std::shared_ptr<RunSession> Session;
  std::set<std::string> Said;
  std::size_t Total = 0;
  std::size_t Done = 0;
  std::size_t Kept = 0; ///< of these
  std::size_t Failed = 0;
  std::size_t Busy = 0;
  std::string FirstFailure;
};

GeneratorRequest sceneRequest(const GeneratorRequest& request)
{
  if (request.resume && request.replace)
  {
    throw UsageError("a run is either resumed or replaced");
  }
  GeneratorRequest own = request;
  while (own.folder.size() > 1 && own.folder.back() == '/')
  {
    own.folder.pop_back();
  }
  return own;
}

GeneratorResult shardOfScenes(
  const GeneratorRequest& request, const RunShard& shard, const GeneratorCallbacks& callbacks)
{
  const FolderScenes files = scenesIn(request.scene);
  const RunParts run = partsOf(request, files);
  const std::size_t size = run.blockSize();
  std::vector<std::size_t> scenes;
  for (std::size_t block = shard.index; block < run.blocks(); block += shard.count)
  {
    for (std::size_t i = block * size; i < std::min(run.items, (block + 1) * size); ++i)
    {
      scenes.push_back(i);
    }
  }
  SceneRuns runs(request, files, callbacks);
  if (isWhole(request.folder, run, false))
  {
    std::for_each(scenes.begin(), scenes.end(), [&](std::size_t scene) { runs.requireSame(scene); });
    return {};
  }
  beginParts(request.folder, run, shard.count);
  runs.begin(scenes.size());
  for (const std::size_t scene : scenes)
  {
    if (!runs.render(scene, true))
    {
      return runs.Result;
    }
  }
  runs.end(request.folder);
  return runs.Result;
}

GeneratorResult shardOfPictures(
  const GeneratorRequest& request, const RunShard& shard, const GeneratorCallbacks& callbacks)
{
  GeneratorRequest own = request;
  own.session = makeRunSession();
  const std::string hash = requestHash(own);
  if (isFinished(request.folder, hash))
  {
    return {};
  }
  requireRoomForParts(request.folder, hash);
  const auto quiet = [](const std::string&) {};
  const SceneDescription scene = request.description ? *request.description : readScene(request.scene);
  const WorkPlan plan = makeWorkPlan(request, *own.session->load(scene, quiet));
  RunParts run;
  run.version = DGTK_VERSION;
  run.requestHash = hash;
  run.items = plan.jobs.size();
  run.contactSheet = option::contactSheet().of(request.options);
  beginParts(request.folder, run, shard.count);
  GeneratorResult all;
  std::size_t busy = 0;
  std::size_t total = 0;
  for (std::size_t block = shard.index; block < run.blocks(); block += shard.count)
  {
    total += std::min(run.blockSize(), run.items - block * run.blockSize());
  }
  for (std::size_t block = shard.index; block < run.blocks() && !all.interrupted; block += shard.count)
  {
    own.block = RunBlock{ request.folder + '/' + partName(block), block * run.blockSize(), run.blockSize() };
    const GeneratorResult before = all;
    GeneratorCallbacks each = callbacks;
    each.progress = [&](const GeneratorProgress& state)
    {
      if (callbacks.progress)
      {
        callbacks.progress({ before.pictures + state.done, total, before.kept + state.kept });
      }
    };
    if (isFinished(own.block->folder, hash))
    {
      const std::size_t pictures = std::min(run.blockSize(), run.items - own.block->first);
      all.pictures += pictures;
      all.kept += pictures;
      continue;
    }
    own.resume = true;
    own.replace = false;
    try
    {
      const GeneratorResult result = generate(own, each);
      all.pictures += result.pictures;
      all.files += result.files;
      all.kept += result.kept;
      all.visibility = result.visibility;
      all.interrupted = result.interrupted;
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
    throw AgainError(request.folder + ": another process is busy with " + std::to_string(busy) + " of these blocks");
  }
  return all;
}
} // namespace

bool namesScenes(const GeneratorRequest& request)
{
  std::error_code code;
  return !request.description && fs::is_directory(request.scene, code);
}

GeneratorResult generateShard(
  const GeneratorRequest& request, const RunShard& shard, const GeneratorCallbacks& callbacks)
{
  if (shard.count < 1 || shard.index >= shard.count)
  {
    throw UsageError("a share of a run is I of N with I below N, found " + std::to_string(shard.index) + " of " +
                     std::to_string(shard.count));
  }
  if (request.replace)
  {
    throw UsageError("a share of a run replaces nothing: others may be at work in its folder");
  }
  const GeneratorRequest own = sceneRequest(request);
  requireOutsideDatasets(own.folder);
  return namesScenes(own) ? shardOfScenes(own, shard, callbacks) : shardOfPictures(own, shard, callbacks);
}

GeneratorResult generateScenes(const GeneratorRequest& request, const GeneratorCallbacks& callbacks)
{
  const GeneratorRequest own = sceneRequest(request);
  requireOutsideDatasets(own.folder);
  const FolderScenes files = scenesIn(own.scene);
  const RunParts run = partsOf(own, files);
  const bool whole = isWhole(own.folder, run, own.replace);
  const bool parts = hasParts(own.folder) && !own.replace;
  if (parts && !own.resume)
  {
    throw FolderError(own.folder, FolderContents::Unfinished);
  }
  SceneRuns runs(own, files, callbacks);
  for (std::size_t i = 0; i < files.scenes.size() && whole && !own.replace; ++i)
  {
    runs.requireSame(i);
  }
  const bool anew = whole || own.replace;
  if (anew)
  {
    requireReplacing(own.folder, run);
  }
  if (!files.leftOut.empty() && callbacks.message)
  {
    callbacks.message("left out, as they are no scenes: " + joined(files.leftOut, ", "));
  }
  beginParts(own.folder, run, 1, anew);
  if (anew) // not before there are parts, so that the folder says at any time what it holds
  {
    Folder(own.folder).remove(manifestName);
  }
  runs.begin(files.scenes.size());
  for (std::size_t i = 0; i < files.scenes.size(); ++i)
  {
    if (!runs.render(i, own.resume))
    {
      return runs.Result;
    }
  }
  runs.end(own.folder);
  endScenes(own.folder, run);
  ++runs.Result.files;
  return runs.Result;
}

} // namespace dgtk
