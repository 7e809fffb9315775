// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetDocuments.h"
#include "dgtkDocumentValues.h"
#include "dgtkError.h"
#include "dgtkFolder.h"
#include "dgtkJournal.h"
#include "dgtkJsonPieces.h"
#include "dgtkLongDocuments.h"
#include "dgtkRunParts.h"

#include <algorithm>
#include <climits>
#include <filesystem>
#include <limits>
#include <set>
#include <unordered_set>

namespace dgtk
{

namespace
{
PixelType typeOf(const JsonCursor& value)
{
  const std::string& name = value.text();
  for (const PixelType type :
    { PixelType::UInt8, PixelType::UInt16, PixelType::UInt32, PixelType::Float32, PixelType::Float64 })
  {
    if (name == nameOf(type))
    {
      return type;
    }
  }
  value.fail("is an unknown type", "uint8, uint16, uint32, float32 or float64", quoted(name));
}

LayerRecord layerOf(const JsonCursor& value)
{
  LayerRecord layer;
  layer.spec.name = value["name"].text();
  layer.format = value["format"].text();
  layer.spec.type = typeOf(value["type"]);
  layer.spec.channels = integerOf(value["channels"], aSize);
  layer.spec.unit = value["unit"].text();
  layer.spec.frame = value["frame"].text();
  layer.spec.invalid = value["invalid"].text();
  layer.spec.description = value["description"].text();
  layer.spec.meaning = value.has("meaning") ? meaningFromName(value["meaning"].text()) : impliedMeaning(layer.spec);
  return layer;
}

/// What is not a key of every camera belongs to its model: a number, a list of them or the name of a file.
void readParameters(const JsonCursor& value, const std::string& folder, CameraRecord& camera)
{
  static const std::set<std::string> common{ "name", "frame", "width", "height", "K", "R", "t", "model", "near", "far",
    "rollingShutter" };
  for (std::size_t i = 0; i < value.memberCount(); ++i)
  {
    const JsonCursor member = value.member(i);
    if (common.count(value.key(i)) != 0)
    {
      continue;
    }
    if (member.node().type == JsonNode::Type::String)
    {
      camera.files[value.key(i)] = (std::filesystem::path(folder) / member.text()).string();
      continue;
    }
    const bool list = member.node().type == JsonNode::Type::Array;
    std::vector<double> numbers;
    for (const JsonCursor& number : list ? member.items() : std::vector<JsonCursor>{ member })
    {
      numbers.push_back(number.number());
    }
    if (!numbers.empty())
    {
      camera.numbers[value.key(i)] = numbers;
    }
  }
}

/// About a rotation, or a reflection: how far it is from one is for the referee to say, rays need a way to the world.
Eigen::Matrix3d turnOf(const JsonCursor& value)
{
  constexpr double about = 0.01;
  const auto R = value.matrix<Eigen::Matrix3d>();
  if (!((R * R.transpose() - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= about))
  {
    value.fail("is no rotation");
  }
  return R;
}

CameraRecord cameraOf(const JsonCursor& value, const std::string& folder)
{
  CameraRecord camera;
  camera.name = value["name"].text();
  camera.frame = integerOf(value["frame"], anyFrame);
  camera.width = integerOf(value["width"], aSize);
  camera.height = integerOf(value["height"], aSize);
  camera.model = value["model"].text();
  camera.hasK = value.has("K") || camera.model == "pinhole" || camera.model == "orthographic"; // K is all they have
  camera.K = camera.hasK ? value["K"].matrix<Eigen::Matrix3d>() : camera.K;
  camera.R = turnOf(value["R"]);
  camera.t = value["t"].matrix<Eigen::Vector3d>();
  readParameters(value, folder, camera);
  if (value.has("rollingShutter"))
  {
    constexpr Range frames{ 0, 1000, false, false, "frames from 0 to 1000" };
    camera.rollingShutter.duration = value["rollingShutter"]["duration"].number(frames);
    camera.rollingShutter.direction =
      static_cast<RollingShutter::Direction>(value["rollingShutter"]["direction"].oneOf(rollingDirections()));
  }
  camera.near = value["near"].number(aboveZero);
  // JSON has no infinity
  camera.far = value["far"].isNull() ? std::numeric_limits<double>::infinity() : value["far"].number();
  return camera;
}
} // namespace

void readCameras(const std::string& path, const std::function<void(CameraRecord&&)>& visit)
{
  const std::string folder = std::filesystem::path(path).parent_path().string();
  const JsonDocument document =
    readJsonPieces(path, { { "cameras", [&](const JsonPiece& piece) { visit(cameraOf(piece.value, folder)); } } });
  JsonCursor(document)["cameras"].listSize();
}

std::vector<CameraRecord> readCameras(const std::string& path)
{
  std::vector<CameraRecord> cameras;
  readCameras(path, [&](CameraRecord&& camera) { cameras.push_back(std::move(camera)); });
  return cameras;
}

std::string faultOfName(const std::string& name)
{
  if (!Folder::isPlain(name))
  {
    return "leads out of the dataset";
  }
  std::size_t longest = 0;
  const std::string first = name.substr(0, name.find('/'));
  for (const std::filesystem::path& part : std::filesystem::path(name))
  {
    longest = std::max(longest, part.native().size());
  }
  if (longest > NAME_MAX || name.size() >= PATH_MAX)
  {
    return "is too long for a file's name";
  }
  const std::string record = journalName;
  const bool ours =
    first == record || first == partialName(record) || first == notesName || first == partsName || first == mergedName;
  return ours ? "is a name for records of the run" : "";
}

DatasetFile fileOf(const JsonCursor& value)
{
  DatasetFile file;
  file.path = value["path"].text();
  const std::string fault = faultOfName(file.path);
  if (!fault.empty())
  {
    value["path"].fail(fault, "a name beneath its folder", dgtk::quoted(file.path));
  }
  file.bytes = countOf(value["bytes"]);
  file.sha256 = hashOf(value["sha256"]);
  file.layer = value.has("layer") ? value["layer"].text() : "";
  file.camera = value.has("camera") ? value["camera"].text() : "";
  file.frame = value.has("frame") ? integerOf(value["frame"], anyFrame) : -1;
  return file;
}

namespace
{
/// Of a manifest whose files are not sorted by path, as those of DGTk are.
void refuseTwins(const std::string& path)
{
  std::unordered_set<std::string> listed;
  readJsonPieces(path, { { "files", [&](const JsonPiece& piece)
                         {
                           const JsonCursor name = piece.value["path"];
                           if (!listed.insert(name.text()).second)
                           {
                             name.fail(dgtk::quoted(name.text()) + " is listed twice");
                           }
                         } } });
}
} // namespace

Manifest readManifest(const std::string& path, const std::function<void(DatasetFile&&)>& visit)
{
  std::string last;
  bool sorted = true;
  const JsonDocument document = readJsonPieces(path, { { "files", [&](const JsonPiece& piece)
                                                       {
                                                         DatasetFile file = fileOf(piece.value);
                                                         sorted = sorted && last < file.path;
                                                         last = file.path;
                                                         visit(std::move(file));
                                                       } } });
  if (!sorted)
  {
    refuseTwins(path);
  }
  const JsonCursor root(document);
  if (!root.has("format") || root["format"].node().text != "DGTk dataset")
  {
    root.fail("is not the manifest of a DGTk dataset");
  }
  root["format_version"].number({ 1, 1, false, false, "1" });
  Manifest manifest;
  manifest.version = root["version"].text();
  manifest.requestHash = root["request_hash"].text();
  manifest.request = pairsIn(root["request"]);
  manifest.units = root["units"].text();
  const auto numberOrNone = [&root](const char* key) // not in the first datasets, nor is info
  { return root.has(key) && !root[key].isNull() ? root[key].number(aboveZero) : 0; };
  manifest.metresPerUnit = numberOrNone("metres_per_unit");
  manifest.fps = numberOrNone("fps");
  if (root.has("info"))
  {
    for (const auto& [key, value] : pairsIn(root["info"]))
    {
      manifest.info[key] = value;
    }
  }
  for (const JsonCursor& item : root["inputs"].items())
  {
    manifest.inputs.push_back({ item["path"].text(), countOf(item["bytes"]), hashOf(item["sha256"]) });
  }
  for (const JsonCursor& item : root["layers"].items())
  {
    manifest.layers.push_back(layerOf(item));
  }
  if (root.has("empty")) // not in the first datasets, nor are warnings
  {
    for (const JsonCursor& item : root["empty"].items())
    {
      manifest.empty.push_back(
        { item["layer"].text(), countOf(item["pictures"]), countOf(item["of"]), item["needs"].text() });
    }
  }
  if (root.has("warnings"))
  {
    manifest.warnings = textsIn(root["warnings"]);
  }
  root["files"].listSize();
  return manifest;
}

Manifest readManifest(const std::string& path)
{
  std::vector<DatasetFile> files;
  Manifest manifest = readManifest(path, [&](DatasetFile&& file) { files.push_back(std::move(file)); });
  manifest.files = std::move(files);
  return manifest;
}

void LinkCheck::add(const std::string& name)
{
  constexpr std::size_t together = 4096;
  this->Names.insert(name);
  if (this->Names.size() == together)
  {
    this->finish();
  }
}

void LinkCheck::finish()
{
  this->Where.look(this->Names,
    [this](const std::string& name, EntryKind kind)
    {
      if (kind != EntryKind::Nothing && kind != EntryKind::File)
      {
        this->Where.fileAt(name);
      }
    });
  this->Names.clear();
}

Manifest readManifestIn(const std::string& path, const std::function<void(DatasetFile&&)>& visit)
{
  const Folder folder(path);
  LinkCheck links(folder);
  Manifest manifest = readManifest(folder.fileAt(manifestName),
    [&](DatasetFile&& file)
    {
      links.add(file.path);
      visit(std::move(file));
    });
  links.finish();
  return manifest;
}

Manifest readManifestIn(const std::string& path)
{
  std::vector<DatasetFile> files;
  Manifest manifest = readManifestIn(path, [&](DatasetFile&& file) { files.push_back(std::move(file)); });
  manifest.files = std::move(files);
  return manifest;
}

} // namespace dgtk
