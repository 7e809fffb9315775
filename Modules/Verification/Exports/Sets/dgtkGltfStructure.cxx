// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkGltfStructure.h"

#include "dgtkJsonFile.h"

#include <cstring>
#include <map>
#include <set>

namespace dgtk
{

namespace
{
using Json = nlohmann::json;

/// Which entries of the asset's lists something refers to.
struct Uses
{
  std::set<std::size_t> cameras, meshes, lights, materials, textures, images, wraps, samplers, accessors, views;
  std::set<std::size_t> vertices, indices; ///< of the accessors
};

void useMesh(const Json& mesh, Uses& uses)
{
  for (const Json& primitive : mesh.at("primitives"))
  {
    uses.materials.insert(primitive.at("material").get<std::size_t>());
    uses.indices.insert(primitive.at("indices").get<std::size_t>());
    for (const auto& [name, accessor] : primitive.at("attributes").items())
    {
      uses.vertices.insert(accessor.get<std::size_t>());
    }
  }
}

Uses usesIn(const Json& asset)
{
  Uses uses;
  for (const Json& node : asset.at("nodes"))
  {
    if (node.contains("camera"))
    {
      uses.cameras.insert(node.at("camera").get<std::size_t>());
    }
    if (node.contains("mesh"))
    {
      uses.meshes.insert(node.at("mesh").get<std::size_t>());
    }
    if (node.contains("extensions"))
    {
      uses.lights.insert(node.at("extensions").at("KHR_lights_punctual").at("light").get<std::size_t>());
    }
  }
  for (const Json& mesh : asset.value("meshes", Json::array()))
  {
    useMesh(mesh, uses);
  }
  for (const Json& material : asset.value("materials", Json::array()))
  {
    const Json& look = material.at("pbrMetallicRoughness");
    if (look.contains("baseColorTexture"))
    {
      uses.textures.insert(look.at("baseColorTexture").at("index").get<std::size_t>());
    }
  }
  for (const Json& texture : asset.value("textures", Json::array()))
  {
    uses.images.insert(texture.at("source").get<std::size_t>());
    if (texture.contains("sampler"))
    {
      uses.wraps.insert(texture.at("sampler").get<std::size_t>());
    }
  }
  uses.accessors = uses.vertices;
  uses.accessors.insert(uses.indices.begin(), uses.indices.end());
  const Json animations = asset.value("animations", Json::array());
  if (!animations.empty())
  {
    for (const Json& channel : animations[0].at("channels"))
    {
      uses.samplers.insert(channel.at("sampler").get<std::size_t>());
    }
    for (const Json& sampler : animations[0].at("samplers"))
    {
      uses.accessors.insert({ sampler.at("input").get<std::size_t>(), sampler.at("output").get<std::size_t>() });
    }
  }
  for (const Json& accessor : asset.value("accessors", Json::array()))
  {
    uses.views.insert(accessor.at("bufferView").get<std::size_t>());
  }
  return uses;
}

/// Limits are those of the numbers, where there have to be some; a view says what it is for.
bool isDescribed(const Json& asset, std::size_t index, const Eigen::MatrixXd& values, const Uses& uses)
{
  const Json& accessor = asset.at("accessors").at(index);
  const Json& view = asset.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>());
  const int target = uses.vertices.count(index) > 0 ? 34962 : uses.indices.count(index) > 0 ? 34963 : 0;
  bool right = view.value("target", 0) == target && view.contains("byteOffset");
  if (accessor.contains("min") || accessor.contains("max"))
  {
    const auto columns = static_cast<std::size_t>(values.cols());
    right = right && gltfList(accessor.at("min"), columns) == values.colwise().minCoeff().transpose() &&
            gltfList(accessor.at("max"), columns) == values.colwise().maxCoeff().transpose();
  }
  return right;
}
} // namespace

std::string gltfWrap(const Json& asset, const Json& texture)
{
  if (!texture.contains("sampler"))
  {
    return {};
  }
  const std::map<int, std::string> words{ { 10497, " repeat" }, { 33071, " clamp" }, { 33648, " mirror" } };
  const Json& sampler = asset.at("samplers").at(texture.at("sampler").get<std::size_t>());
  return words.at(sampler.at("wrapS").get<int>()) + words.at(sampler.at("wrapT").get<int>());
}

Eigen::VectorXd gltfList(const Json& list, std::size_t count)
{
  const std::vector<double> numbers = numberList(list, count);
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), Eigen::Index(numbers.size()));
}

GltfNumbers::GltfNumbers(const Json& asset, const std::string& folder, const std::string& file)
  : Asset(asset)
  , Path(folder + '/' + file)
{
  for (const Json& one : asset.value("buffers", Json::array()))
  {
    this->Buffers.push_back(readFile(folder + '/' + one.at("uri").get<std::string>()));
    this->Right = this->Right && this->Buffers.back().size() == one.at("byteLength").get<std::size_t>();
  }
  this->Right = this->Right && this->Buffers.size() <= 1;
}

Eigen::MatrixXd GltfNumbers::read(std::size_t index) const
{
  const Json& one = this->Asset.at("accessors").at(index);
  const Json& view = this->Asset.at("bufferViews").at(one.at("bufferView").get<std::size_t>());
  const std::string& buffer = this->Buffers.at(view.at("buffer").get<std::size_t>());
  const std::string type = one.at("type");
  const auto columns = static_cast<std::size_t>(type == "SCALAR" ? 1 : type.back() - '0');
  const std::size_t rows = one.at("count");
  const bool whole = one.at("componentType") == 5125;
  const std::size_t at = view.value("byteOffset", std::size_t(0)) + one.value("byteOffset", std::size_t(0));
  const std::size_t bytes = view.at("byteLength");
  const bool known = type == "SCALAR" || type == "VEC2" || type == "VEC3" || type == "VEC4";
  if (!known || (!whole && one.at("componentType") != 5126) || view.contains("byteStride") || bytes > buffer.size() ||
      at > buffer.size() - bytes || bytes % (4 * columns) != 0 || rows != bytes / (4 * columns) || rows == 0)
  {
    throw InputError(this->Path, "accessor " + std::to_string(index) + " cannot be read");
  }
  Eigen::MatrixXd values(rows, columns);
  for (std::size_t i = 0; i < rows * columns; ++i)
  {
    std::uint32_t number = 0;
    float real = 0;
    std::memcpy(&number, buffer.data() + at + 4 * i, 4);
    std::memcpy(&real, &number, 4);
    values(Eigen::Index(i / columns), Eigen::Index(i % columns)) = whole ? double(number) : double(real);
  }
  return values;
}

Eigen::MatrixXd GltfNumbers::read(std::size_t accessor, std::size_t rows, Eigen::Index columns) const
{
  Eigen::MatrixXd values = this->read(accessor);
  if (values.rows() != Eigen::Index(rows) || values.cols() != columns)
  {
    throw std::out_of_range("another shape");
  }
  return values;
}

void judgeGltfStructure(ExportJudge& judge, const std::string& file, const Json& document, const GltfNumbers& numbers)
{
  const auto holds = [&](const std::string& where, bool right)
  { judge.holds("asset", file, where, right, "another", "as the format and the dataset have it"); };
  holds("asset", document.at("asset").at("version") == "2.0" && numbers.hasRightSizes());
  holds("scenes", document.at("scene") == 0 && document.at("scenes") == Json::parse(R"([{"nodes": [0]}])"));
  const Json none = Json::array();
  const Json extensions = document.value("extensions", Json::object());
  const Json lights = extensions.empty() ? none : extensions.at("KHR_lights_punctual").at("lights");
  holds("extensionsUsed",
    document.value("extensionsUsed", none) == (lights.empty() ? none : Json{ "KHR_lights_punctual" }));
  const Uses uses = usesIn(document);
  const Json animations = document.value("animations", none);
  holds("animations", animations.size() <= 1);
  const Json samplers = animations.empty() ? none : animations[0].at("samplers");
  const auto list = [&](const char* key) { return document.value(key, none).size(); };
  holds("unused", uses.cameras.size() == list("cameras") && uses.meshes.size() == list("meshes") &&
                    uses.materials.size() == list("materials") && uses.textures.size() == list("textures") &&
                    uses.images.size() == list("images") && uses.lights.size() == lights.size() &&
                    uses.samplers.size() == samplers.size() && uses.accessors.size() == list("accessors") &&
                    uses.views.size() == list("bufferViews") && uses.wraps.size() == list("samplers"));
  for (const Json& camera : document.value("cameras", none))
  {
    holds("cameras", camera.at("type") == "perspective");
  }
  for (const Json& material : document.value("materials", none))
  {
    const Json& look = material.at("pbrMetallicRoughness");
    holds("materials", look.at("metallicFactor") == 0 && look.at("roughnessFactor") == 1 &&
                         material.at("doubleSided") == true && gltfList(look.at("baseColorFactor"), 4)[3] == 1);
  }
  for (const std::size_t accessor : uses.accessors)
  {
    holds("accessors/" + std::to_string(accessor), isDescribed(document, accessor, numbers.read(accessor), uses));
  }
  const auto limited = [&](const Json& accessor)
  { return document.at("accessors").at(accessor.get<std::size_t>()).contains("min"); };
  for (const Json& mesh : document.value("meshes", none))
  {
    for (const Json& primitive : mesh.at("primitives"))
    {
      holds("limits", limited(primitive.at("attributes").at("POSITION")));
    }
  }
  for (const Json& sampler : samplers)
  {
    holds("limits", limited(sampler.at("input")));
  }
}

} // namespace dgtk
