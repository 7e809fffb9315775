// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetDocuments.h"
#include "dgtkError.h"
#include "dgtkFolder.h"
#include "dgtkJournal.h"
#include "dgtkJsonValue.h"

#include <limits>
#include <map>
#include <set>

namespace dgtk
{

namespace
{
PixelType typeOf(const JsonValue& value)
{
  const std::string name = value.text();
  for (const PixelType type :
    { PixelType::UInt8, PixelType::UInt16, PixelType::UInt32, PixelType::Float32, PixelType::Float64 })
  {
    if (name == nameOf(type))
    {
      return type;
    }
  }
  value.fail("unknown type", "uint8, uint16, uint32, float32 or float64", quoted(name));
}

LayerRecord layerOf(const JsonValue& value)
{
  LayerRecord layer;
  layer.spec.name = value["name"].text();
  layer.format = value["format"].text();
  layer.spec.type = typeOf(value["type"]);
  layer.spec.channels = value["channels"].smallInteger(1);
  layer.spec.unit = value["unit"].text();
  layer.spec.frame = value["frame"].text();
  layer.spec.invalid = value["invalid"].text();
  layer.spec.description = value["description"].text();
  layer.spec.meaning = value.has("meaning") ? meaningFromName(value["meaning"].text()) : impliedMeaning(layer.spec);
  return layer;
}

DatasetFile fileOf(const JsonValue& value)
{
  DatasetFile file;
  file.path = value["path"].text();
  if (!Folder::isPlain(file.path))
  {
    value["path"].fail("leads out of the dataset", "a name beneath its folder", dgtk::quoted(file.path));
  }
  file.bytes = value["bytes"].count();
  file.sha256 = value["sha256"].hash();
  file.layer = value.has("layer") ? value["layer"].text() : "";
  file.camera = value.has("camera") ? value["camera"].text() : "";
  file.frame = value.has("frame") ? value["frame"].smallInteger(std::numeric_limits<int>::min()) : -1;
  return file;
}

CameraRecord cameraOf(const JsonValue& value)
{
  CameraRecord camera;
  camera.name = value["name"].text();
  camera.frame = value["frame"].smallInteger(std::numeric_limits<int>::min());
  camera.width = value["width"].smallInteger(1);
  camera.height = value["height"].smallInteger(1);
  camera.K = value["K"].matrix<Eigen::Matrix3d>();
  camera.R = value["R"].matrix<Eigen::Matrix3d>();
  camera.t = value["t"].matrix<Eigen::Vector3d>();
  camera.model = value["model"].text();
  for (const JsonValue& item : value["distortion"].items())
  {
    camera.distortion.push_back(item.number());
  }
  camera.near = value["near"].number();
  camera.far = value["far"].range();
  return camera;
}
} // namespace

std::vector<CameraRecord> readCameras(const std::string& path)
{
  const nlohmann::ordered_json json = readJson(path);
  std::vector<CameraRecord> cameras;
  for (const JsonValue& item : JsonValue(path, "", json)["cameras"].items())
  {
    cameras.push_back(cameraOf(item));
  }
  return cameras;
}

std::vector<ObjectRecord> readObjects(const std::string& path)
{
  const nlohmann::ordered_json json = readJson(path);
  std::vector<ObjectRecord> objects;
  for (const JsonValue& item : JsonValue(path, "", json)[objectsKey].items())
  {
    ObjectRecord object;
    object.id = std::uint32_t(item["id"].integer(1, std::numeric_limits<std::uint32_t>::max()));
    object.name = item["name"].text();
    object.objectClass = item["class"].text();
    object.classId = std::uint32_t(item["class_id"].integer(1, std::numeric_limits<std::uint32_t>::max()));
    object.model = item["model"].text();
    object.triangles = item["triangles"].count();
    objects.push_back(object);
  }
  return objects;
}

std::vector<ClassRecord> readClasses(const std::string& path)
{
  const nlohmann::ordered_json json = readJson(path);
  const JsonValue root(path, "", json);
  const bool table = root.has(classesKey); // not in the first datasets
  std::map<std::uint32_t, std::string> names;
  for (const JsonValue& item : root[table ? classesKey : objectsKey].items())
  {
    const std::int64_t id = item[table ? "id" : "class_id"].integer(1, std::numeric_limits<std::uint32_t>::max());
    names.emplace(std::uint32_t(id), item[table ? "name" : "class"].text());
  }
  std::vector<ClassRecord> classes;
  classes.reserve(names.size());
  for (const auto& [id, name] : names)
  {
    classes.push_back({ id, name });
  }
  return classes;
}

Manifest readManifest(const std::string& path)
{
  const nlohmann::ordered_json json = readJson(path);
  const JsonValue root(path, "", json);
  if (!root.has("format") || json["format"] != "DGTk dataset")
  {
    root.fail("is not the manifest of a DGTk dataset");
  }
  root["format_version"].integer(1, 1);
  Manifest manifest;
  manifest.version = root["version"].text();
  manifest.requestHash = root["request_hash"].text();
  manifest.request = root["request"].members();
  manifest.units = root["units"].text();
  for (const JsonValue& item : root["inputs"].items())
  {
    manifest.inputs.push_back({ item["path"].text(), item["bytes"].count(), item["sha256"].hash() });
  }
  for (const JsonValue& item : root["layers"].items())
  {
    manifest.layers.push_back(layerOf(item));
  }
  if (root.has("empty")) // not in the first datasets, nor are warnings
  {
    for (const JsonValue& item : root["empty"].items())
    {
      manifest.empty.push_back(
        { item["layer"].text(), item["pictures"].count(), item["of"].count(), item["needs"].text() });
    }
  }
  if (root.has("warnings"))
  {
    for (const JsonValue& item : root["warnings"].items())
    {
      manifest.warnings.push_back(item.text());
    }
  }
  for (const JsonValue& item : root["files"].items())
  {
    manifest.files.push_back(fileOf(item));
  }
  return manifest;
}

Manifest readManifestIn(const std::string& path)
{
  const Folder folder(path);
  Manifest manifest = readManifest(folder.fileAt(manifestName));
  std::set<std::string> names;
  for (const DatasetFile& file : manifest.files)
  {
    names.insert(file.path);
  }
  folder.look(names,
    [&](const std::string& name, EntryKind kind)
    {
      if (kind != EntryKind::Nothing && kind != EntryKind::File)
      {
        folder.fileAt(name);
      }
    });
  return manifest;
}

} // namespace dgtk
