// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportVerification.h"

#include "dgtkError.h"
#include "dgtkExportJudge.h"
#include "dgtkExportPixels.h"
#include "dgtkFile.h"
#include "dgtkFolder.h"
#include "dgtkHash.h"
#include "dgtkRunParts.h"
#include "dgtkSceneFolders.h"
#include "dgtkText.h"

#include <filesystem>

namespace dgtk
{

void readBop(ExportJudge& judge);
void readCoco(ExportJudge& judge);
void readCocoPanoptic(ExportJudge& judge);
void readColmap(ExportJudge& judge);
void readColmapDense(ExportJudge& judge);
void readKitti2015(ExportJudge& judge);
void readKittiDepth(ExportJudge& judge);
void readKittiObject(ExportJudge& judge);
void readKittiOdometry(ExportJudge& judge);
void readStereo(ExportJudge& judge);
void readSintel(ExportJudge& judge);
void readMvsnet(ExportJudge& judge);
void readNerfSynthetic(ExportJudge& judge);
void readTapvid(ExportJudge& judge);
void readTransforms(ExportJudge& judge);
void readTum(ExportJudge& judge);
void readVoc(ExportJudge& judge);
void readYolo(ExportJudge& judge);
void readFlyingThings(ExportJudge& judge);
void readWebdataset(ExportJudge& judge);
void readImagefolder(ExportJudge& judge);
void readRosbag(ExportJudge& judge);
void readMcap(ExportJudge& judge);
void readGltf(ExportJudge& judge);
void readHdf5Frames(ExportJudge& judge);
void readSpring(ExportJudge& judge);

namespace
{
struct Reader
{
  const char* exporter;
  ReadExport read;
};
/// Each is dgtkRead<Name>.cxx.
constexpr Reader readers[] = {
  { "bop", &readBop },
  { "coco", &readCoco },
  { "coco-panoptic", &readCocoPanoptic },
  { "colmap", &readColmap },
  { "colmap-dense", &readColmapDense },
  { "kitti2015", &readKitti2015 },
  { "kitti-depth", &readKittiDepth },
  { "kitti-object", &readKittiObject },
  { "kitti-odometry", &readKittiOdometry },
  { "middlebury", &readStereo },
  { "eth3d", &readStereo },
  { "sintel", &readSintel },
  { "mvsnet", &readMvsnet },
  { "nerf-synthetic", &readNerfSynthetic },
  { "tapvid", &readTapvid },
  { "transforms", &readTransforms },
  { "tum", &readTum },
  { "voc", &readVoc },
  { "yolo", &readYolo },
  { "flyingthings", &readFlyingThings },
  { "webdataset", &readWebdataset },
  { "imagefolder", &readImagefolder },
  { "rosbag", &readRosbag },
  { "mcap", &readMcap },
  { "gltf", &readGltf },
  { "hdf5", &readHdf5Frames },
  { "spring", &readSpring },
};

/// Files that export.json lists are there and as it says, and there are no others.
void checkFiles(const ExportedFrom& source, Results& results)
{
  namespace fs = std::filesystem;
  Meter meter(0);
  std::set<std::string> listed{ exportName };
  for (const ExportedFile& one : source.record().files)
  {
    const std::string path = source.path(one.file.path);
    meter.equal(listed.insert(one.file.path).second,
      [&] {
        return Offender{ one.file.path, -1, -1, "listed twice", "once" };
      });
    std::error_code error;
    const bool there = fs::is_regular_file(path, error);
    const std::uint64_t bytes = there ? fs::file_size(path, error) : 0;
    const auto inBytes = [](std::uint64_t number) { return std::to_string(number) + " bytes"; };
    if (!there || bytes != one.file.bytes)
    {
      meter.equal(false,
        [&] {
          return Offender{ one.file.path, -1, -1, there ? inBytes(bytes) : "no file", inBytes(one.file.bytes) };
        });
      continue;
    }
    const std::string hash = Sha256::ofFile(path);
    meter.equal(hash == one.file.sha256,
      [&] {
        return Offender{ one.file.path, -1, -1, "SHA-256 " + hash, one.file.sha256 };
      });
  }
  const auto [said, right] = exportOwnHashes(source.path(exportName));
  meter.equal(said == right, [&, &said = said, &right = right] { return Offender{ exportName, -1, -1, said, right }; });
  for (const auto& entry : fs::recursive_directory_iterator(source.folder()))
  {
    const std::string name = entry.path().lexically_relative(source.folder()).generic_string();
    const bool merged = name.rfind(mergedName + std::string("/"), 0) == 0; // left by a merge that was killed
    if (!merged && (entry.is_symlink() || !entry.is_directory()))
    {
      meter.equal(listed.count(name) > 0, [&] { return Offender{ name, -1, -1, "a file", "none of this name" }; });
    }
  }
  results.add({ "export", "", {} }, meter);
}

/// What export.json says of itself, of its names and of what files show.
void checkRecord(ExportJudge& judge)
{
  const ExportedFrom& source = judge.source();
  const ExportRecord& record = source.record();
  const auto holds = [&](const std::string& where, bool right, const std::string& found, const std::string& expected)
  { judge.holds("record", exportName, where, right, found, expected); };
  holds("exporter", exportReader(record.exporter) != nullptr, record.exporter, "a format that can be read");
  std::string request = record.version + '\n' + record.exporter + '\n' + record.manifestHash;
  for (const auto& [option, value] : record.request)
  {
    request += '\n' + option + '=' + value;
  }
  holds("request_hash", record.requestHash == Sha256::of(request), record.requestHash, "that of dataset and request");
  std::map<std::string, std::set<bool>> files; // by camera: whether a name is one
  for (const ExportedName& name : record.names)
  {
    holds(name.name, source.named(name.name) == &name, "a name twice", "each once");
    holds(name.name, source.camera(name.camera, name.frame) != nullptr, "no picture", "one of the dataset");
    const ExportedFile* file = source.exported(name.name);
    files[name.camera].insert(file != nullptr);
    holds(name.name,
      !file || file->file.camera.empty() || (file->file.camera == name.camera && file->file.frame == name.frame),
      "another picture", "that of the file");
  }
  for (const auto& [camera, are] : files)
  {
    holds(camera, are.size() == 1, "some names are no files", "files, all or none");
  }
  std::set<std::pair<std::string, std::string>> layers;
  for (const LayerRounding& one : record.layers)
  {
    holds(one.layer, layers.emplace(one.layer, one.unit).second && one.withoutCode <= one.values, "a layer twice",
      "each once, with a value at least where there is a code");
  }
  for (const ExportedFile& one : record.files)
  {
    holds(one.file.path, one.file.camera.empty() || source.nameOf(one.file.camera, one.file.frame) != nullptr,
      "of a picture without a name", "one with a name");
  }
}

/// What throws is a file that cannot be used.
template <typename Body>
void attempt(const ExportedFrom& source, const std::string& layer, Results& results, const Body& body)
{
  const std::string prefix = source.folder() + '/';
  try
  {
    body();
  }
  catch (const InputError& error)
  {
    const bool own = error.file().compare(0, prefix.size(), prefix) == 0;
    results.unusable(layer, own ? error.file().substr(prefix.size()) : exportName, error.what()); // else the dataset's
  }
  catch (const UsageError& error)
  {
    results.unusable(layer, "", error.what());
  }
  catch (const std::out_of_range&)
  {
    results.unusable(layer, exportName, "names something that is not there, or a list is too short");
  }
}

std::vector<Unchecked> uncheckedOf(const ExportedFrom& source, const Results& results)
{
  std::map<std::pair<std::string, std::string>, std::uint64_t> kinds;
  for (const ExportedFile& one : source.record().files)
  {
    if (!results.compares(one.file.path))
    {
      ++kinds[{ one.file.layer.empty() ? one.file.path : one.file.layer, extensionOf(one.file.path) }];
    }
  }
  std::vector<Unchecked> unchecked;
  unchecked.reserve(kinds.size());
  for (const auto& [kind, files] : kinds)
  {
    unchecked.push_back({ kind.first, kind.second, files });
  }
  return unchecked;
}
} // namespace

ReadExport exportReader(const std::string& exporter)
{
  for (const Reader& reader : readers)
  {
    if (exporter == reader.exporter)
    {
      return reader.read;
    }
  }
  return nullptr;
}

namespace
{
/// What one export.json speaks of.
std::vector<Unchecked> judgeExport(const std::string& dataset, const std::string& folder, int threads, Results& results)
{
  const ExportedFrom source(dataset, folder);
  results.startCheck(0, "hashes");
  checkFiles(source, results);
  results.startCheck(1, "pixels");
  std::vector<const ExportedFile*> files;
  for (const ExportedFile& file : source.record().files)
  {
    if (!file.encoding.kind.empty())
    {
      files.push_back(&file);
    }
  }
  ThreadPool pool(threads);
  constexpr std::size_t block = 64;
  for (std::size_t begin = 0; begin < files.size(); begin += block)
  {
    const std::size_t count = std::min(block, files.size() - begin);
    std::vector<Results> parts(count);
    pool.parallelFor(static_cast<int>(count),
      [&](int i)
      {
        Results& part = parts[std::size_t(i)];
        const ExportedFile& file = *files[begin + std::size_t(i)];
        part.startCheck(1, "pixels");
        attempt(source, file.file.layer, part, [&] { judgePixels(source, file, part); });
      });
    for (const Results& part : parts)
    {
      results.merge(part);
    }
  }
  results.startCheck(2, "documents");
  attempt(source, "documents", results,
    [&]
    {
      ExportJudge judge(source, results);
      checkRecord(judge);
      if (const ReadExport read = exportReader(source.record().exporter))
      {
        read(judge);
      }
    });
  return uncheckedOf(source, results);
}
} // namespace

VerificationReport verifyExport(const std::string& dataset, const std::string& folder, int threads)
{
  std::vector<std::string> scenes = sceneFoldersIn(dataset);
  if (scenes.empty() || Folder(folder).look(exportName) == EntryKind::File)
  {
    scenes = { "" }; // one export of all
  }
  Results results;
  std::vector<Unchecked> unchecked;
  for (const std::string& scene : scenes)
  {
    const std::string below = scene.empty() ? "" : '/' + scene;
    Results own;
    const std::vector<Unchecked> left = judgeExport(dataset + below, folder + below, threads, own);
    results.merge(own);
    unchecked.insert(unchecked.end(), left.begin(), left.end());
  }
  VerificationReport report = results.report();
  report.unchecked = unchecked;
  return report;
}

} // namespace dgtk
