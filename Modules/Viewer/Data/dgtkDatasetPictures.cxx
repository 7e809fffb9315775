// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetPictures.h"

#include "dgtkCryptomatte.h"
#include "dgtkError.h"
#include "dgtkFolder.h"
#include "dgtkFolderContents.h"
#include "dgtkHash.h"
#include "dgtkJournal.h"
#include "dgtkLayerReader.h"
#include "dgtkText.h"

#include <algorithm>
#include <filesystem>

namespace dgtk
{

namespace
{
namespace fs = std::filesystem;

/// Files of values before pictures of them; colours the other way round.
int rankOf(const std::string& extension, const LayerSpec& layer)
{
  static const std::vector<std::string> values{ "ldi", "npy", "dgd", "flo", "pfm", "exr", "ppm", "png" };
  const auto at = std::find(values.begin(), values.end(), extension);
  const int rank = static_cast<int>(at - values.begin());
  return layer.meaning == Meaning::Picture ? -rank : rank;
}

bool leavesFolder(const fs::path& path)
{
  return path.is_absolute() || std::find(path.begin(), path.end(), fs::path("..")) != path.end();
}

bool isPicture(const DatasetFile& file, const LayerSpec& layer)
{
  if (file.camera.empty() || file.layer.empty() || layer.meaning == Meaning::Record || leavesFolder(file.path))
  {
    return false;
  }
  const std::string extension = extensionOf(file.path);
  return layer.meaning == Meaning::Surfaces                      ? extension == "ldi"
         : layer.meaning == Meaning::Mask && extension == "json" ? true
                                                                 : isLayerFile(file.path);
}

/// What the user calls the pictures of a file, without its format.
std::string labelOf(const DatasetFile& file)
{
  const fs::path path(file.path);
  std::string label = path.parent_path().filename().string();
  const std::string classes = "_class";
  if (file.layer.size() > classes.size() &&
      file.layer.compare(file.layer.size() - classes.size(), classes.size(), classes) == 0)
  {
    label += " class";
  }
  const std::string stem = path.stem().string();
  const std::size_t part = stem.find('_');
  if (part != std::string::npos)
  {
    std::string rest = stem.substr(part + 1);
    std::replace(rest.begin(), rest.end(), '_', ',');
    label += " " + rest;
  }
  return label;
}

/// What a file shows: a layered depth image is seen in three ways.
const std::vector<std::string>& partsOf(const LayerSpec& layer)
{
  static const std::vector<std::string> whole{ "" };
  static const std::vector<std::string> layered{ "color", "depth", "count" };
  return layer.meaning == Meaning::Surfaces ? layered : whole;
}

std::string folderOf(const std::string& given)
{
  const fs::path path(given);
  const std::string folder = path.filename() == manifestName ? path.parent_path().string() : given;
  return folder.empty() ? "." : folder;
}

std::string manifestOf(const std::string& folder) { return (fs::path(folder) / manifestName).string(); }

bool isRendered(const std::string& folder)
{
  try
  {
    return folderContents(folder, {}) == FolderContents::Running;
  }
  catch (const MachineError&)
  {
    return false;
  }
}

template <typename Read>
void attempt(std::vector<std::string>& warnings, const Read& read)
{
  try
  {
    read();
  }
  catch (const std::exception& error)
  {
    warnings.emplace_back(error.what());
  }
}
} // namespace

DatasetPictures::DatasetPictures(const std::string& folder)
  : Folder(folderOf(folder))
{
  const fs::path root = this->Folder;
  std::error_code failed;
  if (!fs::is_directory(root, failed))
  {
    throw InputError(this->Folder, "is not the folder of a dataset");
  }
  if (!fs::exists(root / manifestName, failed))
  {
    throw InputError(this->Folder, isRendered(this->Folder) ? "is being rendered: open it when that is done"
                                   : fs::exists(root / journalName, failed)
                                     ? "the dataset is not finished: render it again, to its end"
                                     : "is not the folder of a dataset: it has no manifest.json");
  }
  this->ManifestHash = hashOfFile(manifestOf(this->Folder));
  this->TheManifest = readManifest(manifestOf(this->Folder));
  this->readDocuments();
  this->index();
  if (this->Files.empty())
  {
    throw InputError(this->Folder, "the dataset has no pictures to look at");
  }
}

bool DatasetPictures::isReplaced() const
{
  try
  {
    return hashOfFile(manifestOf(this->Folder)) != this->ManifestHash; // reads it only where its age is another
  }
  catch (const InputError&)
  {
    return true;
  }
}

void DatasetPictures::readDocuments()
{
  const dgtk::Folder root(this->Folder);
  attempt(this->Warnings, [&] { this->Records = readCameras(root.fileAt("cameras.json")); });
  attempt(this->Warnings, [&] { this->Objects = readObjects(root.fileAt("objects.json")); });
  try
  {
    SceneDescription scene = readScene(root.fileAt("scene.json"));
    this->Up = scene.upAxis;
    this->SceneCameras = std::move(scene.cameras);
  }
  catch (const std::exception&)
  {
    // pictures need no scene
  }
  std::sort(this->Objects.begin(), this->Objects.end(),
    [](const ObjectRecord& a, const ObjectRecord& b) { return a.id < b.id; });
  std::vector<std::string> names;
  for (const ObjectRecord& object : this->Objects)
  {
    names.push_back(object.name);
  }
  names = distinctNames(names);
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    this->Hashes.emplace(cryptomatteId(names[i]), this->Objects[i].id);
  }
  const auto key = [](const CameraRecord& record) { return std::tie(record.name, record.frame); };
  std::sort(this->Records.begin(), this->Records.end(),
    [&](const CameraRecord& a, const CameraRecord& b) { return key(a) < key(b); });
}

void DatasetPictures::index()
{
  std::map<std::string, std::set<std::string>> formats; // extensions of a label
  for (const DatasetFile& file : this->TheManifest.files)
  {
    const LayerSpec spec = this->specOf(file);
    if (isPicture(file, spec))
    {
      formats[dgtk::labelOf(file)].insert(extensionOf(file.path));
    }
    else if (spec.meaning == Meaning::Surfaces && extensionOf(file.path) == "exr" && this->Warnings.empty())
    {
      this->Warnings.push_back(file.path + ": layered depth images are shown of .ldi files, not of OpenEXR");
    }
    else
    {
      this->addDocument(file);
    }
  }
  std::map<std::string, PictureLayer> found;
  std::set<int> frames;
  for (const DatasetFile& file : this->TheManifest.files)
  {
    const LayerSpec spec = this->specOf(file);
    if (!isPicture(file, spec))
    {
      continue;
    }
    const std::string extension = extensionOf(file.path);
    const std::set<std::string>& all = formats[dgtk::labelOf(file)];
    const std::string first = *std::min_element(
      all.begin(), all.end(), [&](const auto& a, const auto& b) { return rankOf(a, spec) < rankOf(b, spec); });
    const std::string label = dgtk::labelOf(file) + (extension == first ? "" : " ." + extension);
    for (const std::string& part : partsOf(spec))
    {
      this->add(file, label + (part.empty() ? "" : " " + part), part, found);
    }
    frames.insert(file.frame);
  }
  this->Frames.assign(frames.begin(), frames.end());
  for (const auto& [camera, labels] : this->LayersOfCamera)
  {
    this->Cameras.push_back(camera);
  }
  this->sortLayers(found);
}

/// What the manifest says of the file's layer in its format, or else in another.
LayerSpec DatasetPictures::specOf(const DatasetFile& file) const
{
  LayerSpec spec;
  spec.name = file.layer;
  bool found = false;
  for (const LayerRecord& record : this->TheManifest.layers)
  {
    if (record.spec.name == file.layer && (!found || record.format == extensionOf(file.path)))
    {
      spec = record.spec;
      found = true;
    }
  }
  return spec;
}

void DatasetPictures::addDocument(const DatasetFile& file)
{
  const std::string extension = extensionOf(file.path);
  if (leavesFolder(file.path) || file.layer.empty() || (extension != "txt" && extension != "json"))
  {
    return;
  }
  const bool ofCamera = !file.camera.empty() && file.path.compare(0, file.camera.size() + 1, file.camera + '/') == 0;
  const DatasetDocument kind = extension == "txt" ? DatasetDocument::Calibration
                               : ofCamera         ? DatasetDocument::Boxes
                                                  : DatasetDocument::Points;
  this->Documents[{ kind, ofCamera ? file.camera : "", file.frame }] = file.path;
}

void DatasetPictures::add(const DatasetFile& file, const std::string& label, const std::string& part,
  std::map<std::string, PictureLayer>& found)
{
  this->Files[{ file.camera, file.frame, label }] = file.path;
  this->LayersOfCamera[file.camera].insert(label);
  PictureLayer& layer = found[label];
  layer.label = label;
  layer.format = extensionOf(file.path);
  layer.part = part;
  layer.spec = this->specOf(file);
  if (!part.empty())
  {
    layer.spec.meaning = part == "color" ? Meaning::Picture : part == "depth" ? Meaning::Depth : Meaning::Surfaces;
  }
}

void DatasetPictures::sortLayers(std::map<std::string, PictureLayer>& found)
{
  std::map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < this->TheManifest.layers.size(); ++i)
  {
    places.emplace(this->TheManifest.layers[i].spec.name, i);
  }
  const std::string general = "scene units";
  for (auto& [label, layer] : found)
  {
    const std::size_t at = layer.spec.unit.find(general);
    if (at != std::string::npos && !this->TheManifest.units.empty())
    {
      layer.spec.unit.replace(at, general.size(), this->TheManifest.units);
    }
  }
  const auto placeOf = [&](const PictureLayer& layer)
  {
    const auto at = places.find(layer.spec.name);
    return at == places.end() ? places.size() : at->second;
  };
  for (const auto& [label, layer] : found)
  {
    this->Layers.push_back(layer);
  }
  std::stable_sort(this->Layers.begin(), this->Layers.end(),
    [&](const PictureLayer& a, const PictureLayer& b) { return placeOf(a) < placeOf(b); });
}

std::vector<std::string> DatasetPictures::layersOf(const std::string& camera) const
{
  std::vector<std::string> labels;
  const auto at = this->LayersOfCamera.find(camera);
  for (const PictureLayer& layer : this->Layers)
  {
    if (at != this->LayersOfCamera.end() && at->second.count(layer.label) > 0)
    {
      labels.push_back(layer.label);
    }
  }
  return labels;
}

const PictureLayer* DatasetPictures::layer(const std::string& label) const
{
  const auto at = std::find_if(
    this->Layers.begin(), this->Layers.end(), [&](const PictureLayer& layer) { return layer.label == label; });
  return at == this->Layers.end() ? nullptr : &*at;
}

std::string DatasetPictures::firstLayer(Meaning meaning, const std::string& camera, int frame) const
{
  const auto at = std::find_if(this->Layers.begin(), this->Layers.end(),
    [&](const PictureLayer& layer) {
      return layer.spec.meaning == meaning && this->Files.count({ camera, frame, layer.label }) > 0;
    });
  return at == this->Layers.end() ? std::string() : at->label;
}

std::string DatasetPictures::file(const PictureKey& key) const
{
  const auto at = this->Files.find(key);
  return at == this->Files.end() ? std::string() : (fs::path(this->Folder) / at->second).string();
}

std::string DatasetPictures::document(DatasetDocument kind, const std::string& camera, int frame) const
{
  const auto at = this->Documents.find({ kind, camera, frame });
  return at == this->Documents.end() ? std::string() : (fs::path(this->Folder) / at->second).string();
}

bool DatasetPictures::hasDocuments(DatasetDocument kind) const
{
  return std::any_of(
    this->Documents.begin(), this->Documents.end(), [&](const auto& one) { return std::get<0>(one.first) == kind; });
}

const CameraRecord* DatasetPictures::camera(const std::string& name, int frame) const
{
  const auto at = std::find_if(this->Records.begin(), this->Records.end(),
    [&](const CameraRecord& record) { return record.name == name && record.frame == frame; });
  return at == this->Records.end() ? nullptr : &*at;
}

const CameraDescription* DatasetPictures::sceneCamera(const std::string& name) const
{
  const auto at = std::find_if(this->SceneCameras.begin(), this->SceneCameras.end(),
    [&](const CameraDescription& camera) { return camera.name == name; });
  return at == this->SceneCameras.end() ? nullptr : &*at;
}

const ObjectRecord* DatasetPictures::object(std::uint32_t id) const
{
  const auto at = std::lower_bound(this->Objects.begin(), this->Objects.end(), id,
    [](const ObjectRecord& object, std::uint32_t value) { return object.id < value; });
  return at == this->Objects.end() || at->id != id ? nullptr : &*at;
}

std::uint32_t DatasetPictures::objectOfHash(float hash) const
{
  const auto at = this->Hashes.find(hash);
  return at == this->Hashes.end() ? 0 : at->second;
}

std::string DatasetPictures::className(std::uint32_t id) const
{
  const auto at = std::find_if(
    this->Objects.begin(), this->Objects.end(), [&](const ObjectRecord& object) { return object.classId == id; });
  return at == this->Objects.end() ? std::string() : at->objectClass;
}

} // namespace dgtk
