// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportJudge.h"

#include "dgtkError.h"
#include "dgtkFolder.h"
#include "dgtkHash.h"
#include "dgtkJournal.h"
#include "dgtkLongDocuments.h"
#include "dgtkMasks.h"
#include "dgtkSceneFolders.h"
#include "dgtkText.h"

#include <algorithm>
#include <iterator>
#include <tuple>

namespace dgtk
{

namespace
{
/// Pointers to a list's entries in the order of their keys.
template <typename Entry, typename Key>
std::vector<const Entry*> sortedBy(const std::vector<Entry>& entries, const Key& key)
{
  std::vector<const Entry*> sorted;
  sorted.reserve(entries.size());
  for (const Entry& one : entries)
  {
    sorted.push_back(&one);
  }
  std::stable_sort(sorted.begin(), sorted.end(), [&](const Entry* a, const Entry* b) { return key(*a) < key(*b); });
  return sorted;
}

/// The last entry of that key; null for none.
template <typename Entry, typename Key, typename Wanted>
const Entry* foundBy(const std::vector<const Entry*>& sorted, const Key& key, const Wanted& wanted)
{
  const auto after = std::upper_bound(
    sorted.begin(), sorted.end(), wanted, [&](const Wanted& value, const Entry* one) { return value < key(*one); });
  const bool there = after != sorted.begin() && !(key(**std::prev(after)) < wanted);
  return there ? *std::prev(after) : nullptr;
}

using Place = std::tuple<const std::string&, const int&>;
Place placeOf(const ExportedName& name) { return { name.camera, name.frame }; }
Place placeOf(const CameraRecord& camera) { return { camera.name, camera.frame }; }
const std::string& nameIn(const ExportedName& name) { return name.name; }
const std::string& pathIn(const ExportedFile& file) { return file.file.path; }

std::string placeText(const std::string& camera, int frame) { return camera + " at frame " + std::to_string(frame); }

std::string objectText(const std::string& camera, int frame, std::uint32_t object)
{
  return "object " + std::to_string(object) + " of " + placeText(camera, frame);
}

template <typename Matrix>
std::string matrixText(const Matrix& matrix)
{
  std::vector<double> values;
  for (Eigen::Index i = 0; i < matrix.rows(); ++i)
  {
    for (Eigen::Index j = 0; j < matrix.cols(); ++j)
    {
      values.push_back(matrix(i, j));
    }
  }
  return numbersText(values.data(), static_cast<int>(values.size()));
}
} // namespace

ExportedFrom::ExportedFrom(const std::string& dataset, const std::string& folder)
  : DatasetFolder(dataset)
  , Folder(folder)
  , Record(readExportIn(folder))
{
  const dgtk::Folder place(dataset);
  if (Sha256::ofFile(place.fileAt(manifestName)) != this->Record.manifestHash)
  {
    throw UsageError(folder + ": was made from another dataset, or from an earlier state of " + dataset);
  }
  for (const std::string& scene : sceneFoldersIn(dataset))
  {
    this->Parts.push_back(scene + '/');
  }
  if (this->Parts.empty())
  {
    this->Parts.emplace_back();
  }
  for (const std::string& part : this->Parts)
  {
    this->addCameras(part);
  }
  std::stable_sort(this->Cameras.begin(), this->Cameras.end(),
    [](const CameraRecord& a, const CameraRecord& b) { return placeOf(a) < placeOf(b); });
  for (const std::string& part : this->Parts)
  {
    this->addPart(part);
  }
  this->Files.finish();
  this->ByPlace = sortedBy(this->Record.names, [](const ExportedName& name) { return placeOf(name); });
  this->ByName = sortedBy(this->Record.names, &nameIn);
  this->ByPath = sortedBy(this->Record.files, &pathIn);
}

std::string ExportedFrom::folderOf(const std::string& part) const
{
  return part.empty() ? this->DatasetFolder : this->DatasetFolder + '/' + part.substr(0, part.size() - 1);
}

void ExportedFrom::addCameras(const std::string& part)
{
  readCameras(dgtk::Folder(this->folderOf(part)).fileAt("cameras.json"),
    [&](CameraRecord&& camera)
    {
      camera.name = part + camera.name;
      this->Cameras.push_back(std::move(camera));
    });
}

void ExportedFrom::addPart(const std::string& part)
{
  const std::string folder = this->folderOf(part);
  this->Objects[part] = readObjects(dgtk::Folder(folder).fileAt("objects.json"));
  this->Manifests[part] = readManifestIn(folder,
    [&](DatasetFile&& file)
    {
      file.path = part + file.path;
      file.camera = file.camera.empty() ? file.camera : part + file.camera;
      this->Files.add(file, this->shotOf(file.camera, file.frame));
    });
}

std::uint32_t ExportedFrom::shotOf(const std::string& camera, int frame) const
{
  const CameraRecord* const record = this->camera(camera, frame);
  return record ? std::uint32_t(record - this->Cameras.data()) : FileTable::noShot;
}

std::optional<DatasetFile> ExportedFrom::listed(const std::string& path) const
{
  const std::optional<std::uint32_t> number = this->Files.find(path);
  return number ? std::optional<DatasetFile>(this->fileAt(*number)) : std::nullopt;
}

DatasetFile ExportedFrom::fileAt(std::uint32_t number) const
{
  DatasetFile file = this->Files.at(number);
  if (const std::uint32_t shot = this->Files.shotOf(number); shot != FileTable::noShot)
  {
    file.camera = this->Cameras[shot].name;
    file.frame = this->Cameras[shot].frame;
  }
  return file;
}

std::vector<DatasetFile> ExportedFrom::filesOf(const std::string& camera, int frame) const
{
  std::vector<DatasetFile> files;
  for (const std::uint32_t number : this->Files.ofShot(this->shotOf(camera, frame)))
  {
    files.push_back(this->fileAt(number));
  }
  return files;
}

const ExportedFile* ExportedFrom::exported(const std::string& name) const
{
  return foundBy(this->ByPath, &pathIn, name);
}

std::string ExportedFrom::partOf(const std::string& camera) const
{
  return this->Parts[0].empty() ? "" : camera.substr(0, camera.find('/') + 1);
}

std::string ExportedFrom::convention(const std::string& key) const
{
  const auto found = std::find_if(this->Record.conventions.begin(), this->Record.conventions.end(),
    [&](const auto& pair) { return pair.first == key; });
  return found == this->Record.conventions.end() ? "" : found->second;
}

const ExportedName* ExportedFrom::nameOf(const std::string& camera, int frame) const
{
  return foundBy(
    this->ByPlace, [](const ExportedName& name) { return placeOf(name); }, Place(camera, frame));
}

const ExportedName* ExportedFrom::named(const std::string& name) const { return foundBy(this->ByName, &nameIn, name); }

std::size_t ExportedFrom::picturesBelow(const std::string& folder) const
{
  return static_cast<std::size_t>(std::count_if(this->Record.names.begin(), this->Record.names.end(),
    [&](const ExportedName& one) { return one.name.rfind(folder, 0) == 0; }));
}

const CameraRecord* ExportedFrom::camera(const std::string& name, int frame) const
{
  const Place wanted(name, frame);
  const auto found = std::lower_bound(this->Cameras.begin(), this->Cameras.end(), wanted,
    [](const CameraRecord& one, const Place& place) { return placeOf(one) < place; });
  return found == this->Cameras.end() || wanted < placeOf(*found) ? nullptr : &*found;
}

const ObjectRecord* ExportedFrom::object(const std::string& camera, std::uint32_t id) const
{
  const auto part = this->Objects.find(this->partOf(camera));
  if (part == this->Objects.end())
  {
    return nullptr;
  }
  const auto found =
    std::find_if(part->second.begin(), part->second.end(), [&](const ObjectRecord& object) { return object.id == id; });
  return found == part->second.end() ? nullptr : &*found;
}

const std::vector<BoxRecord>& ExportedFrom::boxes(const std::string& camera, int frame) const
{
  const std::lock_guard<std::mutex> guard(this->Mutex);
  if (this->BoxesOf != std::make_pair(camera, frame) || this->Boxes.empty())
  {
    const std::string file = this->file(camera, frame, "boxes", { "json" });
    this->Boxes = file.empty() ? std::vector<BoxRecord>() : readBoxes(this->DatasetFolder + '/' + file);
    this->BoxesOf = { camera, frame };
  }
  return this->Boxes;
}

bool ExportedFrom::holdsDepths(const std::string& camera, const std::string& layer) const
{
  const std::vector<LayerRecord>& layers = this->manifestOf(camera).layers;
  return std::any_of(layers.begin(), layers.end(),
    [&](const LayerRecord& one)
    {
      const Meaning meaning = one.spec.meaning;
      return one.spec.name == layer && (meaning == Meaning::Depth || meaning == Meaning::Distance);
    });
}

std::string ExportedFrom::file(
  const std::string& camera, int frame, const std::string& layer, const std::vector<std::string>& extensions) const
{
  static const std::vector<std::string> usual{ "npy", "dgd", "exr", "pfm", "flo", "png", "ppm", "json" };
  const std::vector<std::uint32_t> files = this->Files.ofShot(this->shotOf(camera, frame), layer);
  for (const std::string& extension : extensions.empty() ? usual : extensions)
  {
    for (const std::uint32_t number : files)
    {
      std::string path = this->Files.pathOf(number);
      if (extensionOf(path) == extension &&
          (!extensions.empty() || extension != "png" || !this->holdsDepths(camera, layer)))
      {
        return path;
      }
    }
  }
  return {};
}

PicturePointer ExportedFrom::picture(
  const std::string& camera, int frame, const std::string& layer, const std::vector<std::string>& extensions) const
{
  const std::string name = this->file(camera, frame, layer, extensions);
  const CameraRecord* record = this->camera(camera, frame);
  if (name.empty() || !record)
  {
    throw InputError(this->DatasetFolder, "has no file of layer " + layer + " of " + placeText(camera, frame));
  }
  return std::make_shared<PictureFile>(this->DatasetFolder, name, record->width, record->height);
}

PicturePointer ExportedFrom::classesOf(const std::string& camera, int frame, const std::string& layer) const
{
  const std::string classes = layer + "_class";
  return this->file(camera, frame, classes, { "png" }).empty() ? nullptr
                                                               : this->picture(camera, frame, classes, { "png" });
}

ExportJudge::~ExportJudge()
{
  for (auto& [what, line] : this->Lines)
  {
    line.meter.Tolerance = line.tolerance;
    this->TheResults.add({ what, line.unit, { line.files.begin(), line.files.end() } }, line.meter);
  }
}

Meter& ExportJudge::meter(const std::string& what, const std::string& unit, double tolerance, const std::string& file)
{
  Line& line = this->Lines[what];
  line.unit = unit;
  line.meter.Tolerance = tolerance;
  line.tolerance = std::max(line.tolerance, tolerance);
  line.files.insert(file);
  return line.meter;
}

void ExportJudge::number(const std::string& what, const std::string& unit, const std::string& file,
  const std::string& where, double found, double expected, double tolerance)
{
  this->meter(what, unit, tolerance, file)
    .add(found == expected ? 0 : found - expected,
      [&] {
        return Offender{ file, -1, -1, numberText(found) + " (" + where + ")", numberText(expected) };
      });
}

void ExportJudge::holds(const std::string& what, const std::string& file, const std::string& where, bool right,
  const std::string& found, const std::string& expected)
{
  this->meter(what, "", 0, file)
    .equal(right,
      [&] {
        return Offender{ file, -1, -1, found + " (" + where + ")", expected };
      });
}

void ExportJudge::size(
  const std::string& file, const std::string& camera, int frame, std::int64_t width, std::int64_t height)
{
  const CameraRecord* record = this->Source.camera(camera, frame);
  const auto text = [](std::int64_t w, std::int64_t h) { return std::to_string(w) + "x" + std::to_string(h); };
  this->holds("size", file, placeText(camera, frame), record && record->width == width && record->height == height,
    text(width, height), record ? text(record->width, record->height) : "no such picture");
}

void ExportJudge::intrinsics(
  const std::string& file, const std::string& camera, int frame, const Eigen::Matrix3d& K, double tolerance)
{
  const CameraRecord* record = this->Source.camera(camera, frame);
  if (!record || !record->hasK)
  {
    this->holds("intrinsics", file, placeText(camera, frame), false, "a camera", "none that has a matrix");
    return;
  }
  this->meter("intrinsics", "px", tolerance, file)
    .add(apart(K, record->K),
      [&] {
        return Offender{ file, -1, -1, matrixText(K) + " (" + placeText(camera, frame) + ")", matrixText(record->K) };
      });
}

void ExportJudge::pose(const std::string& file, const std::string& camera, int frame, const Eigen::Matrix3d& R,
  const Eigen::Vector3d& t, double tolerance)
{
  const CameraRecord* record = this->Source.camera(camera, frame);
  if (!record)
  {
    this->holds("pose", file, placeText(camera, frame), false, "a camera", "no such picture");
    return;
  }
  const double size = std::max(1.0, record->t.norm());
  const double error = larger(apart(R, record->R), apart(t, record->t) / size);
  this->meter("pose", "1", tolerance, file)
    .add(error,
      [&]
      {
        return Offender{ file, -1, -1, matrixText(R) + " " + matrixText(t) + " (" + placeText(camera, frame) + ")",
          matrixText(record->R) + " " + matrixText(record->t) };
      });
}

void ExportJudge::box(const std::string& file, const std::string& camera, int frame, std::uint32_t object,
  const Eigen::Vector4d& box, double tolerance)
{
  const std::vector<BoxRecord>& boxes = this->Source.boxes(camera, frame);
  const auto found = std::find_if(boxes.begin(), boxes.end(), [&](const BoxRecord& one) { return one.id == object; });
  if (found == boxes.end() || !found->visible)
  {
    this->holds("box", file, objectText(camera, frame, object), false, "a box", "no visible pixel");
    return;
  }
  this->meter("box", "px", tolerance, file)
    .add(apart(box, *found->visible),
      [&]
      {
        return Offender{ file, -1, -1, matrixText(box) + " (" + objectText(camera, frame, object) + ")",
          matrixText(*found->visible) };
      });
}

void ExportJudge::mask(
  const std::string& file, const std::string& camera, int frame, std::uint32_t object, const std::vector<char>& inside)
{
  const PicturePointer ids = this->Source.picture(camera, frame, "objects");
  Meter& meter = this->meter("mask", "", 0, file);
  if (inside.size() != std::size_t(ids->width()) * ids->height())
  {
    this->holds("mask", file, objectText(camera, frame, object), false, std::to_string(inside.size()) + " pixels",
      "those of the picture");
    return;
  }
  for (int y = 0; y < ids->height(); ++y)
  {
    for (int x = 0; x < ids->width(); ++x)
    {
      const bool in = inside[std::size_t(y) * ids->width() + x] != 0;
      meter.equal(in == (ids->id(x, y) == object),
        [&]
        {
          return Offender{ file, x, y, (in ? "inside (" : "outside (") + objectText(camera, frame, object) + ")",
            "object " + std::to_string(ids->id(x, y)) };
        });
    }
  }
}

void ExportJudge::amodalMask(
  const std::string& file, const std::string& camera, int frame, std::uint32_t object, const std::vector<char>& inside)
{
  const CameraRecord* record = this->Source.camera(camera, frame);
  const std::string name = this->Source.file(camera, frame, "amodal", { "json" });
  if (!record || name.empty())
  {
    this->holds("amodal mask", file, objectText(camera, frame, object), false, "a mask", "no file of layer amodal");
    return;
  }
  const Masks masks = readMasks(this->Source.dataset() + '/' + name, record->width, record->height);
  const auto mask = masks.byId.find(object);
  this->holds("amodal mask", file, objectText(camera, frame, object),
    mask != masks.byId.end() && mask->second == inside, "other pixels", "those of " + name);
}

} // namespace dgtk
