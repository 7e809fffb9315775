// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetView.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkFileTable.h"
#include "dgtkFolder.h"
#include "dgtkHash.h"
#include "dgtkJournal.h"
#include "dgtkLongDocuments.h"
#include "dgtkPinholeTwins.h"
#include "dgtkText.h"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <mutex>
#include <set>
#include <tuple>

namespace dgtk
{

namespace
{
/// Of which formats of a layer values are taken: the exact ones first. A .png of depths is a picture for people.
const std::vector<std::string>& usualExtensions(Meaning meaning)
{
  static const std::vector<std::string> all{ "npy", "dgd", "exr", "pfm", "flo", "png", "ppm", "json", "txt" };
  static const std::vector<std::string> ofDepths{ "npy", "dgd", "exr", "pfm" };
  return meaning == Meaning::Depth || meaning == Meaning::Distance ? ofDepths : all;
}

bool isOneOf(const std::string& word, const std::vector<std::string>& words)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool holdsFrame(const DatasetSelection& selection, int frame)
{
  return !selection.someFrames ||
         (frame >= selection.first && frame <= selection.last && (frame - selection.first) % selection.step == 0);
}

/// The folder's own name of a file: "correspondence_right" of "left/correspondence_right/000000.npy".
std::string folderOf(const std::string& path)
{
  const std::size_t end = path.rfind('/');
  const std::size_t begin = end == std::string::npos || end == 0 ? std::string::npos : path.rfind('/', end - 1);
  return end == std::string::npos ? "" : path.substr(begin + 1, end - begin - 1);
}
} // namespace

/// poses.json, which is read when poses are first asked for.
class DatasetView::Poses
{
public:
  std::vector<PoseRecord> at(const std::string& folder, int frame)
  {
    std::call_once(this->Once,
      [&]
      {
        const dgtk::Folder place(folder);
        if (place.look(posesName) == EntryKind::File)
        {
          this->Index.emplace(place.fileAt(posesName));
        }
      });
    return this->Index ? this->Index->at(frame) : std::vector<PoseRecord>();
  }

private:
  std::once_flag Once;
  std::optional<PoseIndex> Index;
};

DatasetView::DatasetView(const std::string& folder, const DatasetSelection& selection, const SceneOfMany& scene)
  : Folder(folder)
  , Scene(scene)
  , Files(std::make_unique<FileTable>())
  , AllPoses(std::make_unique<Poses>())
{
  const dgtk::Folder place(folder);
  this->ManifestHash = Sha256::ofFile(place.fileAt(manifestName));
  this->Objects = readObjects(place.fileAt("objects.json"));
  this->Classes = readClasses(place.fileAt("objects.json"));
  this->readShots(selection);
  this->readFiles();
  this->chooseUnit(selection.metresPerUnit);
}

DatasetView::~DatasetView() = default;

void DatasetView::readShots(const DatasetSelection& selection)
{
  std::set<std::string> known;
  std::deque<CameraRecord> meant;
  std::vector<DatasetShot> all; // for twins, which may be of any name
  readCameras(dgtk::Folder(this->Folder).fileAt("cameras.json"),
    [&](CameraRecord&& camera)
    {
      known.insert(camera.name);
      if (holdsFrame(selection, camera.frame) && selection.pinholeTwins)
      {
        all.push_back({ 0, camera });
      }
      if ((selection.cameras.empty() || isOneOf(camera.name, selection.cameras)) && holdsFrame(selection, camera.frame))
      {
        meant.push_back(std::move(camera));
      }
    });
  for (const std::string& name : selection.cameras)
  {
    if (known.count(name) == 0)
    {
      const std::string near = nearest(name, { known.begin(), known.end() });
      throw UsageError("cameras: the dataset has no camera " + quoted(name) +
                       (near.empty() ? "" : ", did you mean " + quoted(near) + "?"));
    }
  }
  if (meant.empty())
  {
    throw UsageError("frames: none of the dataset's pictures is meant");
  }
  this->Shots.reserve(meant.size());
  for (; !meant.empty(); meant.pop_front()) // never twice in memory
  {
    this->Shots.push_back({ 0, std::move(meant.front()) });
  }
  if (selection.pinholeTwins)
  {
    this->Shots = withTwins(this->Shots, all);
  }
  std::sort(this->Shots.begin(), this->Shots.end(),
    [](const DatasetShot& a, const DatasetShot& b)
    { return std::tie(a.camera.name, a.camera.frame) < std::tie(b.camera.name, b.camera.frame); });
  const bool many = !this->Scene.name.empty();
  for (std::size_t i = 0; i < this->Shots.size(); ++i)
  {
    DatasetShot& shot = this->Shots[i];
    shot.index = i;
    shot.number = this->Scene.shotsBefore + i;
    shot.part = many ? this->Scene.place : shot.frame();
    shot.camera.name = this->nameOf(shot.camera.name);
  }
}

void DatasetView::chooseUnit(double given)
{
  constexpr double tolerance = 1e-6; // as of a scene's `metresPerUnit`
  const double said = this->TheManifest.metresPerUnit;
  if (given > 0 && said > 0 && std::abs(given / said - 1) > tolerance)
  {
    throw UsageError("unit_metres: the dataset says how long its unit is (expected " + shortest(said) + ", found " +
                     shortest(given) + ')');
  }
  this->MetresPerUnit = given > 0 ? given : said;
}

/// Of a camera, among those of all scenes.
std::string DatasetView::nameOf(const std::string& camera) const
{
  return this->Scene.name.empty() ? camera : this->Scene.name + '/' + camera;
}

void DatasetView::readFiles()
{
  this->TheManifest = readManifestIn(this->Folder,
    [this](DatasetFile&& file)
    {
      const DatasetShot* owner = file.layer.empty() ? nullptr : this->shot(this->nameOf(file.camera), file.frame);
      this->Files->add(file, owner ? static_cast<std::uint32_t>(owner->index) : FileTable::noShot);
      const bool earlier = this->FirstFrame < 0 || file.frame < this->FirstFrame;
      this->FirstFrame = file.frame >= 0 && earlier ? file.frame : this->FirstFrame;
    });
  this->Files->finish();
}

const DatasetShot* DatasetView::shot(const std::string& camera, int frame) const
{
  const auto found = std::lower_bound(this->Shots.begin(), this->Shots.end(), std::tie(camera, frame),
    [](const DatasetShot& one, const std::tuple<const std::string&, const int&>& place)
    { return std::tie(one.camera.name, one.camera.frame) < place; });
  const bool there = found != this->Shots.end() && found->name() == camera && found->frame() == frame;
  return there ? &*found : nullptr;
}

bool DatasetView::has(const std::string& layer) const { return !layer.empty() && this->Files->hasLayer(layer); }

std::vector<std::string> DatasetView::cameras() const
{
  std::set<std::string> names;
  for (const DatasetShot& shot : this->Shots)
  {
    names.insert(shot.name());
  }
  return { names.begin(), names.end() };
}

std::vector<int> DatasetView::frames() const
{
  std::set<int> frames;
  for (const DatasetShot& shot : this->Shots)
  {
    frames.insert(shot.frame());
  }
  return { frames.begin(), frames.end() };
}

std::vector<const DatasetShot*> DatasetView::shotsOf(const std::string& camera) const
{
  auto shot = std::lower_bound(this->Shots.begin(), this->Shots.end(), camera,
    [](const DatasetShot& one, const std::string& name) { return one.name() < name; });
  std::vector<const DatasetShot*> found;
  for (; shot != this->Shots.end() && shot->name() == camera; ++shot)
  {
    found.push_back(&*shot);
  }
  return found;
}

std::vector<const DatasetShot*> DatasetView::shotsAt(int frame) const
{
  std::vector<const DatasetShot*> found;
  for (const DatasetShot& shot : this->Shots)
  {
    if (shot.frame() == frame)
    {
      found.push_back(&shot);
    }
  }
  return found;
}

const ObjectRecord* DatasetView::object(std::uint32_t id) const
{
  const auto found = std::find_if(
    this->Objects.begin(), this->Objects.end(), [&](const ObjectRecord& object) { return object.id == id; });
  return found == this->Objects.end() ? nullptr : &*found;
}

std::uint32_t DatasetView::largestObject() const
{
  std::uint32_t largest = this->Scene.largestObject;
  for (const ObjectRecord& object : this->Objects)
  {
    largest = std::max(largest, object.id);
  }
  return largest;
}

Meaning DatasetView::meaningOf(const std::string& layer) const
{
  const std::vector<LayerRecord>& all = this->TheManifest.layers;
  const auto found =
    std::find_if(all.begin(), all.end(), [&](const LayerRecord& one) { return one.spec.name == layer; });
  return found == all.end() ? Meaning::Unknown : found->spec.meaning;
}

std::string DatasetView::file(const DatasetShot& shot, const std::string& layer,
  const std::vector<std::string>& extensions, const std::string& folder) const
{
  const std::vector<std::uint32_t> files = this->Files->ofShot(static_cast<std::uint32_t>(shot.index), layer);
  for (const std::string& extension : extensions.empty() ? usualExtensions(this->meaningOf(layer)) : extensions)
  {
    for (const std::uint32_t number : files)
    {
      std::string path = this->Files->pathOf(number);
      if (extensionOf(path) == extension && (folder.empty() || folderOf(path) == folder))
      {
        return path;
      }
    }
  }
  return {};
}

DatasetFile DatasetView::describedFile(std::uint32_t number) const
{
  DatasetFile file = this->Files->at(number);
  if (this->Files->shotOf(number) != FileTable::noShot)
  {
    const DatasetShot& owner = this->Shots[this->Files->shotOf(number)];
    file.camera = owner.name();
    file.frame = owner.frame();
  }
  return file;
}

std::vector<DatasetFile> DatasetView::filesOf(const DatasetShot& shot) const
{
  std::vector<DatasetFile> files;
  for (const std::uint32_t number : this->Files->ofShot(static_cast<std::uint32_t>(shot.index)))
  {
    files.push_back(this->describedFile(number));
  }
  std::stable_sort(files.begin(), files.end(),
    [](const DatasetFile& a, const DatasetFile& b) { return std::tie(a.layer, a.path) < std::tie(b.layer, b.path); });
  return files;
}

DatasetFile DatasetView::listed(const std::string& file) const
{
  const std::optional<std::uint32_t> number = this->Files->find(file);
  if (!number)
  {
    throw InputError(this->Folder, "the manifest does not list " + quoted(file));
  }
  return this->describedFile(*number);
}

std::string DatasetView::pathOf(const std::string& file) const
{
  std::string path = dgtk::Folder(this->Folder).fileAt(file);
  std::error_code code;
  if (std::filesystem::file_size(path, code) != this->listed(file).bytes)
  {
    throw InputError(path, "is not the file that the manifest lists: its size differs");
  }
  return path;
}

std::string DatasetView::bytesOf(const std::string& file) const
{
  const std::string source = dgtk::Folder(this->Folder).fileAt(file);
  std::string bytes = readFile(source);
  if (Sha256::of(bytes) != this->listed(file).sha256)
  {
    throw InputError(source, "is not the file that the manifest lists: its hash differs");
  }
  return bytes;
}

std::unique_ptr<RowReader> DatasetView::open(
  const DatasetShot& shot, const std::string& layer, const std::vector<std::string>& extensions) const
{
  const std::string name = this->file(shot, layer, extensions);
  if (name.empty())
  {
    throw InputError(this->Folder,
      "camera " + quoted(shot.name()) + " has no file of layer " + layer + " at frame " + std::to_string(shot.frame()));
  }
  const std::string path = this->pathOf(name);
  std::unique_ptr<RowReader> reader = openLayerFile(path);
  const auto sizeOf = [](const auto& one) { return std::to_string(one.width) + " x " + std::to_string(one.height); };
  if (sizeOf(reader->info()) != sizeOf(shot.camera))
  {
    throw InputError(path, "size differs from the camera's", sizeOf(shot.camera), sizeOf(reader->info()));
  }
  return reader;
}

ImageData DatasetView::read(
  const DatasetShot& shot, const std::string& layer, const std::vector<std::string>& extensions) const
{
  const std::unique_ptr<RowReader> reader = this->open(shot, layer, extensions);
  ImageData data;
  data.info = reader->info();
  data.pixels = reader->read(reader->info().height);
  return data;
}

namespace
{
std::string documentOf(const DatasetView& dataset, const DatasetShot& shot, const std::string& layer)
{
  const std::string name = dataset.file(shot, layer, { "json" });
  if (name.empty())
  {
    throw InputError(dataset.folder(),
      "camera " + quoted(shot.name()) + " has no file of layer " + layer + " at frame " + std::to_string(shot.frame()));
  }
  return dataset.pathOf(name);
}
} // namespace

std::vector<BoxRecord> DatasetView::boxes(const DatasetShot& shot) const
{
  return readBoxes(documentOf(*this, shot, "boxes"));
}

AmodalMasks DatasetView::amodal(const DatasetShot& shot) const { return readAmodal(documentOf(*this, shot, "amodal")); }

std::vector<PoseRecord> DatasetView::poses(int frame) const { return this->AllPoses->at(this->Folder, frame); }

std::vector<TrackPoint> DatasetView::trackPoints() const { return readTrackPoints(this->pathOf(trackPointsFile)); }

double DatasetView::seconds(int frame) const
{
  if (this->TheManifest.fps <= 0)
  {
    throw UsageError("the dataset does not say how many frames a second it has; the format needs times");
  }
  return frame / this->TheManifest.fps;
}

double DatasetView::metres() const
{
  if (this->MetresPerUnit <= 0)
  {
    throw UsageError("unit_metres: the dataset does not say how long its unit is; the format needs metres");
  }
  return this->MetresPerUnit;
}

} // namespace dgtk
