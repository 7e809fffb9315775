// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetDocuments.h"
#include "dgtkError.h"
#include "dgtkFile.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <limits>

namespace dgtk
{

namespace
{
using Json = nlohmann::ordered_json;

/// A value of a document with its place, for messages such as `cameras.json: cameras[3].K: is missing`.
class Value
{
public:
  Value(const std::string& file, const std::string& place, const Json& json)
    : File(file)
    , Place(place)
    , Node(json)
  {
  }

  [[noreturn]] void fail(const std::string& what, const std::string& expected = {}, const std::string& found = {}) const
  {
    throw InputError(this->File, 0, (this->Place.empty() ? what : this->Place + ": " + what), expected, found);
  }
  void require(bool right, const char* expected) const
  {
    if (!right)
    {
      const std::string text = this->Node.dump(-1, ' ', true, Json::error_handler_t::replace);
      this->fail("has the wrong type or value", expected, quoted(text));
    }
  }

  bool has(const char* key) const { return this->Node.is_object() && this->Node.contains(key); }
  Value operator[](const char* key) const
  {
    this->require(this->Node.is_object(), "an object");
    const std::string place = this->Place.empty() ? key : this->Place + "." + key;
    if (!this->Node.contains(key))
    {
      Value(this->File, place, this->Node).fail("is missing");
    }
    return { this->File, place, this->Node.at(key) };
  }
  std::vector<Value> items() const
  {
    this->require(this->Node.is_array(), "a list");
    std::vector<Value> all;
    for (std::size_t i = 0; i < this->Node.size(); ++i)
    {
      all.emplace_back(this->File, this->Place + "[" + std::to_string(i) + "]", this->Node[i]);
    }
    return all;
  }
  std::vector<std::pair<std::string, std::string>> members() const
  {
    this->require(this->Node.is_object(), "an object");
    std::vector<std::pair<std::string, std::string>> all;
    for (const auto& [key, value] : this->Node.items())
    {
      all.emplace_back(key, Value(this->File, this->Place + "." + key, value).text());
    }
    return all;
  }

  std::string text() const
  {
    this->require(this->Node.is_string(), "a text");
    return this->Node.get<std::string>();
  }
  double number() const
  {
    this->require(this->Node.is_number(), "a number");
    return this->Node.get<double>();
  }
  /// Infinite when null: JSON has no infinity.
  double range() const { return this->Node.is_null() ? std::numeric_limits<double>::infinity() : this->number(); }
  std::int64_t integer(std::int64_t least, std::int64_t most) const
  {
    const std::string expected = "an integer from " + std::to_string(least) + " to " + std::to_string(most);
    this->require(this->Node.is_number_integer() &&
                    !(this->Node.is_number_unsigned() && this->Node.get<std::uint64_t>() > std::uint64_t(most)),
      expected.c_str());
    const auto value = this->Node.get<std::int64_t>();
    this->require(value >= least && value <= most, expected.c_str());
    return value;
  }
  int smallInteger(int least = 0) const { return int(this->integer(least, std::numeric_limits<int>::max())); }
  std::uint64_t count() const { return std::uint64_t(this->integer(0, std::numeric_limits<std::int64_t>::max())); }
  std::string hash() const
  {
    const std::string value = this->text();
    this->require(
      value.size() == 64 && value.find_first_not_of("0123456789abcdef") == std::string::npos, "64 hexadecimal digits");
    return value;
  }
  template <typename M>
  M matrix() const
  {
    M out;
    const std::vector<Value> rows = this->items();
    this->require(rows.size() == std::size_t(out.rows()), "as many rows as the matrix has");
    for (int i = 0; i < out.rows(); ++i)
    {
      if constexpr (M::ColsAtCompileTime == 1)
      {
        out(i) = rows[i].number();
      }
      else
      {
        const std::vector<Value> row = rows[i].items();
        rows[i].require(row.size() == std::size_t(out.cols()), "as many columns as the matrix has");
        for (int j = 0; j < out.cols(); ++j)
        {
          out(i, j) = row[j].number();
        }
      }
    }
    return out;
  }

private:
  std::string File;
  std::string Place;
  const Json& Node;
};

Json parse(const std::string& path)
{
  const std::string text = readFile(path, std::uint64_t(1) << 30);
  try
  {
    return Json::parse(text);
  }
  catch (const Json::parse_error& error)
  {
    const std::size_t position = std::min<std::size_t>(error.byte, text.size());
    const long line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(position), '\n');
    throw InputError(path, line, "is not JSON");
  }
  catch (const Json::exception&)
  {
    throw InputError(path, 0, "is not JSON that can be used");
  }
}

PixelType typeOf(const Value& value)
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

LayerRecord layerOf(const Value& value)
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
  return layer;
}

DatasetFile fileOf(const Value& value)
{
  DatasetFile file;
  file.path = value["path"].text();
  file.bytes = value["bytes"].count();
  file.sha256 = value["sha256"].hash();
  file.layer = value.has("layer") ? value["layer"].text() : "";
  file.camera = value.has("camera") ? value["camera"].text() : "";
  file.frame = value.has("frame") ? value["frame"].smallInteger(std::numeric_limits<int>::min()) : -1;
  return file;
}

CameraRecord cameraOf(const Value& value)
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
  for (const Value& item : value["distortion"].items())
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
  const Json json = parse(path);
  std::vector<CameraRecord> cameras;
  for (const Value& item : Value(path, "", json)["cameras"].items())
  {
    cameras.push_back(cameraOf(item));
  }
  return cameras;
}

std::vector<ObjectRecord> readObjects(const std::string& path)
{
  const Json json = parse(path);
  std::vector<ObjectRecord> objects;
  for (const Value& item : Value(path, "", json)["objects"].items())
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

Manifest readManifest(const std::string& path)
{
  const Json json = parse(path);
  const Value root(path, "", json);
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
  for (const Value& item : root["inputs"].items())
  {
    manifest.inputs.push_back({ item["path"].text(), item["bytes"].count(), item["sha256"].hash() });
  }
  for (const Value& item : root["layers"].items())
  {
    manifest.layers.push_back(layerOf(item));
  }
  for (const Value& item : root["files"].items())
  {
    manifest.files.push_back(fileOf(item));
  }
  return manifest;
}

} // namespace dgtk
