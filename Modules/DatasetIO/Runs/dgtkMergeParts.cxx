// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRunParts.h"

#include "dgtkContactSheet.h"
#include "dgtkError.h"
#include "dgtkExportDocument.h"
#include "dgtkFile.h"
#include "dgtkHash.h"
#include "dgtkJournal.h"
#include "dgtkLongDocuments.h"
#include "dgtkSceneFolders.h"
#include "dgtkThreadPool.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include <sys/stat.h>

namespace dgtk
{

std::string datasetsManifestText(const DatasetsManifest& manifest);

namespace
{
constexpr const char* sheetName = "contact.png";

/// Takes a dataset that is not whole away, so that it can be made again: what its manifest lists, and no other file.
void removeListed(const Folder& folder, const Manifest& manifest)
{
  namespace fs = std::filesystem;
  std::error_code code;
  for (const DatasetFile& file : manifest.files)
  {
    folder.remove(file.path);
    for (fs::path above = fs::path(file.path).parent_path(); !above.empty(); above = above.parent_path())
    {
      fs::remove(folder.pathOf(above.string()), code); // unless there is something in it
    }
  }
  folder.remove(manifestName);
  fs::remove(folder.path(), code);
}

/// At once for whoever looks: a folder without some of its files is never there. `aside` may be of one who was killed.
void removeFolder(const std::string& folder, const std::string& aside)
{
  std::error_code code;
  std::filesystem::remove_all(aside, code);
  std::filesystem::rename(folder, aside, code);
  if (code)
  {
    std::filesystem::remove_all(folder);
  }
  std::filesystem::remove_all(aside, code); // which another process may do, too
}

bool hasManifest(const Folder& folder, const std::string& in)
{
  return folder.look(in + '/' + manifestName) == EntryKind::File;
}

/// What a value says, which the request of a run of scenes may spell otherwise than those of its datasets do; empty:
/// nothing.
std::set<std::string> meaningOf(std::string value)
{
  value = value == "own" ? "camera's own" : value;
  value.erase(std::remove(value.begin(), value.end(), '\\'), value.end());
  std::set<std::string> words;
  std::istringstream list(value);
  for (std::string word; std::getline(list, word, ',');)
  {
    words.insert(word);
  }
  return words;
}

/// Whether all datasets of a run have this value of its request: which layers "all" are depends on the scene.
bool isForAll(const std::string& key, const std::string& value)
{
  return key == "layers" ? value != "all" : key == "cameras" || key == "frames" || key == "size";
}

/// A merge of pictures: files go from their parts to their places.
class Merge
{
public:
  Merge(const std::string& folder, int threads)
    : Home(folder)
    , Run(readParts(folder))
    , Pool(threads)
  {
    this->Report.blocks = this->Run.blocks();
    this->Report.workers = workersOf(folder);
  }

  MergeReport execute()
  {
    this->Run.scenes.empty() ? this->readPictures() : this->readScenes();
    if (this->Report.missing.empty() && this->Report.problems.empty())
    {
      this->Run.scenes.empty() ? this->writePictures() : this->writeScenes();
      removeParts(this->Home.path());
      this->Report.merged = true;
    }
    return this->Report;
  }

private:
  struct Place
  {
    DatasetFile file;
    std::vector<std::size_t> blocks; ///< that have it
  };

  void problem(const std::string& line) { this->Report.problems.push_back(line); }

  std::optional<Manifest> manifestOf(const std::string& in, const std::string& requestHash)
  {
    Manifest manifest = readManifest(this->Home.fileAt(in + '/' + manifestName));
    if (manifest.version != this->Run.version || (!requestHash.empty() && manifest.requestHash != requestHash))
    {
      this->problem(this->Home.pathOf(in) + ": is of another request, or of another version of DGTk");
      return std::nullopt;
    }
    return manifest;
  }

  void readPictures()
  {
    for (std::size_t block = 0; block < this->Report.blocks; ++block)
    {
      const std::string in = partName(block);
      if (!hasManifest(this->Home, in))
      {
        this->Report.missing.push_back(block);
        continue;
      }
      const std::optional<Manifest> part = this->manifestOf(in, this->Run.requestHash);
      if (!part)
      {
        continue;
      }
      for (const DatasetFile& file : part->files)
      {
        this->take(file, block);
      }
      if (block == 0)
      {
        this->Whole = *part;
      }
    }
    if (this->Report.missing.empty() && this->Report.problems.empty())
    {
      this->checkFiles();
    }
  }

  void take(const DatasetFile& file, std::size_t block)
  {
    Place& place = this->Places[file.path];
    if (!place.blocks.empty() && place.file.sha256 != file.sha256)
    {
      this->problem(this->Home.pathOf(partName(block) + '/' + file.path) + ": differs from that of another part");
    }
    place.file = file;
    place.blocks.push_back(block);
  }

  /// Each file is whole in one of its parts, or in its place after a merge that was interrupted.
  void checkFiles()
  {
    std::vector<Place*> places;
    for (auto& [path, place] : this->Places)
    {
      places.push_back(&place);
    }
    std::vector<std::string> lost(places.size());
    std::vector<std::set<std::size_t>> again(places.size());
    this->Pool.parallelFor(int(places.size()),
      [&](int i)
      {
        Place& place = *places[std::size_t(i)];
        std::vector<std::size_t> whole;
        for (const std::size_t block : place.blocks)
        {
          if (isWhole(Folder(this->Home.pathOf(partName(block))), place.file))
          {
            whole.push_back(block);
            break;
          }
        }
        const bool isThere = whole.empty() && isWhole(this->Home, place.file);
        if (whole.empty() && !isThere)
        {
          again[std::size_t(i)].insert(place.blocks.begin(), place.blocks.end());
        }
        const EntryKind kind = isThere ? EntryKind::Nothing : this->Home.look(place.file.path);
        if (kind != EntryKind::Nothing && !whole.empty() && !isWhole(this->Home, place.file))
        {
          lost[std::size_t(i)] = this->Home.pathOf(place.file.path) + ": is in the way, and no run has written it";
        }
        place.blocks = whole;
      });
    std::set<std::size_t> missing;
    for (std::size_t i = 0; i < places.size(); ++i)
    {
      missing.insert(again[i].begin(), again[i].end());
      if (!lost[i].empty())
      {
        this->problem(lost[i]);
      }
    }
    for (const std::size_t block : missing)
    {
      removeFolder(this->Home.pathOf(partName(block)), this->Home.pathOf(partsName + std::string("/damaged")));
      this->Report.missing.push_back(block);
    }
  }

  void writePictures()
  {
    for (const auto& [path, place] : this->Places)
    {
      if (!place.blocks.empty())
      {
        this->Home.makeParents(path);
        std::filesystem::rename(
          this->Home.pathOf(partName(place.blocks.front()) + '/' + path), this->Home.pathOf(path));
      }
    }
    this->Whole.files.clear();
    for (const auto& [path, place] : this->Places)
    {
      this->Whole.files.push_back(place.file);
    }
    if (this->Run.contactSheet)
    {
      this->Whole.files.push_back(writeContactSheet(this->Home.path(), this->Whole, sheetName));
    }
    this->Report.files = this->Whole.files.size();
    this->Home.syncAll();
    writeFileDurably(FilePlace(this->Home.path(), manifestName), manifestText(this->Whole));
  }

  void readScenes()
  {
    const std::size_t size = this->Run.blockSize();
    std::vector<DatasetFile> found(this->Run.scenes.size());
    std::vector<std::string> problems(this->Run.scenes.size());
    std::vector<std::vector<InputRecord>> inputs(this->Run.scenes.size());
    this->Pool.parallelFor(int(found.size()),
      [&](int i)
      {
        const std::string& scene = this->Run.scenes[std::size_t(i)];
        if (!hasManifest(this->Home, scene))
        {
          return;
        }
        const std::string path = this->Home.fileAt(scene + '/' + manifestName);
        const Manifest manifest = readManifest(path);
        if (manifest.version != this->Run.version)
        {
          problems[std::size_t(i)] = this->Home.pathOf(scene) + ": is of another version of DGTk";
        }
        else if (const std::string other = this->otherThanAsked(manifest); !other.empty())
        {
          problems[std::size_t(i)] = this->Home.pathOf(scene) + ": is of another request: " + other;
        }
        const Folder own(this->Home.pathOf(scene));
        const bool whole = std::all_of(
          manifest.files.begin(), manifest.files.end(), [&](const DatasetFile& file) { return isWhole(own, file); });
        if (!whole)
        {
          removeListed(own, manifest);
        }
        else
        {
          const std::uint64_t bytes = std::filesystem::file_size(path);
          found[std::size_t(i)] = { scene + '/' + manifestName, bytes, Sha256::ofFile(path), "", "", -1 };
          inputs[std::size_t(i)] = manifest.inputs;
        }
      });
    std::set<std::size_t> missing;
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      if (!problems[i].empty())
      {
        this->problem(problems[i]);
      }
      else if (found[i].path.empty())
      {
        missing.insert(i / size);
      }
      this->Datasets.push_back(found[i]);
    }
    this->Report.missing.assign(missing.begin(), missing.end());
    this->checkInputs(inputs);
  }

  /// The first value of a dataset's request that the run's contradicts.
  std::string otherThanAsked(const Manifest& manifest) const
  {
    const std::map<std::string, std::string> found(manifest.request.begin(), manifest.request.end());
    for (const auto& [key, value] : this->Run.request)
    {
      const auto own = found.find(key);
      if (own == found.end() || !isForAll(key, value))
      {
        continue;
      }
      const std::set<std::string> asked = meaningOf(value);
      const std::set<std::string> made = meaningOf(own->second);
      if (!asked.empty() && !made.empty() && asked != made)
      {
        return key + " (expected " + value + ", found " + own->second + ')';
      }
    }
    return {};
  }

  /// A file that several scenes name has not changed between them; copies do not say of which file they are.
  void checkInputs(const std::vector<std::vector<InputRecord>>& inputs)
  {
    std::map<std::string, std::pair<std::string, std::size_t>> known; // by path: SHA-256, and whose
    for (std::size_t i = 0; i < inputs.size(); ++i)
    {
      const std::filesystem::path scene = this->Run.scenes[i];
      for (const InputRecord& input : inputs[i])
      {
        const std::string file = (scene / input.path).lexically_normal().string();
        const auto& [sha256, first] = known.try_emplace(file, input.sha256, i).first->second;
        if (sha256 != input.sha256)
        {
          this->problem(this->Home.pathOf(scene.string()) + ": is of another version of " +
                        (this->Home.path() / std::filesystem::path(file)).lexically_normal().string() + " than " +
                        this->Home.pathOf(this->Run.scenes[first]) + "; remove one of them and make its share again");
          break;
        }
      }
    }
  }

  void writeScenes()
  {
    const DatasetsManifest manifest{ this->Run.version, this->Run.requestHash, this->Run.request, this->Run.leftOut,
      this->Datasets };
    this->Report.files = this->Datasets.size();
    writeFileDurably(FilePlace(this->Home.path(), manifestName), datasetsManifestText(manifest));
  }

  Folder Home;
  RunParts Run;
  ThreadPool Pool;
  MergeReport Report;
  Manifest Whole; ///< the first part's, which says all but the files
  std::map<std::string, Place> Places;
  std::vector<DatasetFile> Datasets;
};
} // namespace

void endScenes(const std::string& folder, const RunParts& run)
{
  DatasetsManifest manifest{ run.version, run.requestHash, run.request, run.leftOut, {} };
  const Folder home(folder);
  for (const std::string& scene : run.scenes)
  {
    const std::string name = scene + '/' + manifestName;
    const std::string path = home.fileAt(name);
    DatasetFile file;
    file.path = name;
    file.bytes = std::filesystem::file_size(path);
    file.sha256 = Sha256::ofFile(path);
    manifest.datasets.push_back(file);
  }
  writeFileDurably(FilePlace(folder, manifestName), datasetsManifestText(manifest));
  removeParts(folder);
}

void removeParts(const std::string& folder) { removeFolder(folder + '/' + partsName, folder + '/' + mergedName); }

std::string MergeReport::processes(std::size_t of) const
{
  std::set<std::size_t> numbers;
  for (const std::size_t block : this->missing)
  {
    numbers.insert(block % of);
  }
  std::string text;
  for (auto it = numbers.begin(); it != numbers.end();)
  {
    const std::size_t first = *it;
    std::size_t last = first;
    for (++it; it != numbers.end() && *it == last + 1; ++it)
    {
      last = *it;
    }
    text += (text.empty() ? "" : ",") + std::to_string(first) + (last > first ? '-' + std::to_string(last) : "");
  }
  return text;
}

namespace
{
/// Of a folder that was merged, maybe by one who was killed while the parts were removed.
MergeReport reportOfWhole(const std::string& folder)
{
  MergeReport report;
  const Folder home(folder);
  if (home.look(manifestName) == EntryKind::File)
  {
    const std::size_t scenes = sceneFoldersIn(folder).size();
    report.files = scenes > 0 ? scenes : readManifest(home.fileAt(manifestName)).files.size();
  }
  else if (home.look(exportName) == EntryKind::File)
  {
    readExportIn(
      folder, [](ExportedName&&) {}, [&](ExportedFile&&) { ++report.files; });
  }
  else if (home.look(mergedName) == EntryKind::Nothing) // exports of scenes have no document of the whole
  {
    throw UsageError(folder + ": holds no parts of a run");
  }
  std::filesystem::remove_all(home.pathOf(mergedName));
  report.merged = true;
  return report;
}
} // namespace

MergeReport mergeParts(const std::string& folder, int threads)
{
  return hasParts(folder) ? Merge(folder, threads).execute() : reportOfWhole(folder);
}

} // namespace dgtk
