// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampleRun.h"

#include "dgtkAgainError.h"
#include "dgtkFile.h"
#include "dgtkFolder.h"
#include "dgtkHash.h"
#include "dgtkSampler.h"
#include "dgtkThreadPool.h"
#include "dgtkUtf8.h"

#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <sys/file.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <mutex>
#include <vector>

namespace dgtk
{

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace
{
constexpr char recordName[] = "samples.json";

std::string fileName(int sample)
{
  char name[16];
  std::snprintf(name, sizeof name, "%06d.json", sample);
  return name;
}

bool isSampleName(const std::string& name)
{
  return name.size() == 11 && name.substr(6) == ".json" &&
         std::all_of(name.begin(), name.begin() + 6, [](char c) { return c >= '0' && c <= '9'; });
}

/// The folder's record when it is of this program's, so that its samples may go; null otherwise.
Json recordIn(const Folder& folder)
{
  if (folder.look(recordName) != EntryKind::File)
  {
    return nullptr;
  }
  Json record = Json::parse(readFile(folder.fileAt(recordName)), nullptr, false);
  return record.is_object() && record.contains("samples") && record.contains("scene_sha256") ? record : Json();
}

/// Whether a record is that of the run that begins, which did not end.
bool isOfSameRun(Json record, const Json& begun)
{
  record["samples"] = begun["samples"];
  return record == begun;
}

/// The folder for one run alone, as long as this stands: the system lets go of it when the process ends, however it
/// ends. A file system without locks knows of nobody.
FileDescriptor lockOf(const std::string& folder)
{
  makeFolders(folder);
  FileDescriptor lock(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (lock && ::flock(lock.number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
  {
    throw AgainError(folder + ": another process is writing it");
  }
  return lock;
}

/// Throws unless the folder is free, may be made so, or holds what an interrupted run of the same samples has left:
/// `begun` is the record with which a run begins.
void clearFolder(const SampleRequest& request, const Json& begun)
{
  const Folder folder(request.folder);
  std::vector<std::string> samples;
  std::string foreign;
  for (const fs::directory_entry& entry : fs::directory_iterator(request.folder))
  {
    const std::string name = entry.path().filename().string();
    const bool own = isSampleName(name) || name == recordName || name == partialName(recordName) ||
                     (name.size() == 19 && isSampleName(name.substr(0, 11)) && name == partialName(name.substr(0, 11)));
    if (!own || folder.look(name) != EntryKind::File)
    {
      foreign = foreign.empty() || name < foreign ? name : foreign;
      continue;
    }
    samples.push_back(name);
  }
  if (!foreign.empty())
  {
    throw SampleFolderError(request.folder + " holds " + dgtk::quoted(foreign) + ", which is no sample", false);
  }
  if (samples.empty() || samples == std::vector<std::string>{ partialName(recordName) }) // ended at its very beginning
  {
    return;
  }
  const Json record = recordIn(folder);
  if (record.is_null())
  {
    throw SampleFolderError(request.folder + " holds " +
                              dgtk::quoted(*std::min_element(samples.begin(), samples.end())) +
                              " but no record of samples",
      false);
  }
  if (isOfSameRun(record, begun)) // each sample is written again, or its file removed
  {
    return;
  }
  const bool isOfNone = samples == std::vector<std::string>{ recordName } && !record["samples"].is_null() &&
                        record["samples"].empty(); // its first sample failed
  if (!request.replace && !isOfNone)
  {
    throw SampleFolderError(request.folder + " holds samples already", true);
  }
  std::sort(samples.begin(), samples.end()); // the record is last
  for (const std::string& name : samples)
  {
    folder.remove(name);
  }
}

Json noteOf(const SampleNote& note)
{
  Json json{ { "path", utf8FromBytes(note.path) }, { "kept", note.kept } };
  if (!note.kept)
  {
    json["why"] = utf8FromBytes(note.why);
  }
  json["attempts"] = note.attempts;
  for (const auto& [name, value] : note.measured)
  {
    json["measured"][utf8FromBytes(name)] = value;
  }
  return json;
}

Json inputsOf(const RandomScene& scene)
{
  Json inputs = Json::array();
  for (const auto& [pattern, files] : scene.foundFiles())
  {
    std::string list;
    for (const std::string& file : files)
    {
      list += hashOfFile((fs::path(scene.folder()) / file).string()) + "  " + file + '\n';
    }
    inputs.push_back(
      { { "files", utf8FromBytes(pattern) }, { "count", files.size() }, { "sha256", Sha256::of(list) } });
  }
  return inputs;
}

class Run
{
public:
  Run(const SampleRequest& request, const SampleCallbacks& callbacks)
    : Request(request)
    , Callbacks(callbacks)
    , Source(RandomScene::read(request.scene), request.seed)
    , Records(std::size_t(request.last - request.first + 1))
  {
  }

  SampleResult all()
  {
    const Json begun = this->recordOf(false);
    const FileDescriptor lock = lockOf(this->Request.folder);
    clearFolder(this->Request, begun);
    this->write(begun);
    try
    {
      ThreadPool(this->Request.threads)
        .parallelFor(static_cast<int>(this->Records.size()), [this](int i) { this->one(i); });
    }
    catch (...)
    {
      try
      {
        this->write(this->recordOf(false));
      }
      catch (const Error&) // what failed first is what is told
      {
      }
      throw;
    }
    this->Result.interrupted = this->isCancelled();
    this->write(this->recordOf(!this->Result.interrupted));
    return this->Result;
  }

private:
  bool isCancelled() const { return this->Callbacks.cancel != nullptr && *this->Callbacks.cancel; }

  void one(int i)
  {
    if (this->isCancelled() || this->Failed)
    {
      return;
    }
    const int number = this->Request.first + i;
    Json record{ { "sample", number } };
    std::size_t leftOut = 0;
    bool refused = false;
    try
    {
      const SceneSample sample = this->Source.draw(std::uint64_t(number));
      const std::string text = toJson(sample.scene, this->Request.folder);
      writeFile(FilePlace(this->Request.folder, fileName(number)), text);
      record["file"] = fileName(number);
      record["sha256"] = Sha256::of(text);
      record["seed"] = sample.scene.seed;
      for (const SampleNote& note : sample.notes)
      {
        record["notes"].push_back(noteOf(note));
        leftOut += note.kept ? 0 : 1;
      }
    }
    catch (const SampleRefused& error)
    {
      refused = true;
      this->removeFile(number);
      record["refused"] = { { "path", utf8FromBytes(error.path()) }, { "why", utf8FromBytes(error.why()) },
        { "attempts", error.attempts() } };
    }
    catch (const InputError& error)
    {
      this->Failed = true; // of those that began, the lowest sample's is told
      throw Error(error.code(), std::string(error.what()) + ", in sample " + std::to_string(number));
    }
    catch (...)
    {
      this->Failed = true;
      throw;
    }
    const std::lock_guard<std::mutex> guard(this->Lock);
    this->Records[std::size_t(i)] = std::move(record);
    this->Result.refused += refused ? 1 : 0;
    this->Result.written += refused ? 0 : 1;
    this->Result.leftOut += leftOut;
    if (this->Callbacks.progress)
    {
      this->Callbacks.progress(this->Result.written + this->Result.refused, this->Records.size());
    }
  }

  /// What an interrupted run may have left, when a model was another one.
  void removeFile(int number) const
  {
    const Folder folder(this->Request.folder);
    if (folder.look(fileName(number)) == EntryKind::File)
    {
      folder.remove(fileName(number));
    }
  }

  Json recordOf(bool whole) const
  {
    const RandomScene& scene = this->Source.scene();
    Json record{ { "version", 1 }, { "dgtk", DGTK_VERSION }, { "complete", whole },
      { "scene", utf8FromBytes(fs::path(this->Request.scene).filename().string()) }, { "scene_sha256", scene.sha256() },
      { "seed", this->Source.seed() }, { "first", this->Request.first }, { "last", this->Request.last } };
    record["inputs"] = whole ? inputsOf(scene) : Json::array();
    record["samples"] = Json::array(); // without those that were not drawn
    std::copy_if(this->Records.begin(), this->Records.end(), std::back_inserter(record["samples"]),
      [](const Json& sample) { return !sample.is_null(); });
    return record;
  }

  void write(const Json& record) const
  {
    writeFileDurably(FilePlace(this->Request.folder, recordName), record.dump(1) + '\n');
  }

  const SampleRequest& Request;
  const SampleCallbacks& Callbacks;
  const Sampler Source;
  std::vector<Json> Records;
  std::atomic<bool> Failed{ false };
  std::mutex Lock;
  SampleResult Result;
};
} // namespace

SampleResult writeSamples(const SampleRequest& request, const SampleCallbacks& callbacks)
{
  return Run(request, callbacks).all();
}

} // namespace dgtk
