// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAssimpGltf.h"

#include "dgtkGltfFile.h"
#include "dgtkGltfMeshes.h"
#include "dgtkGltfPlacement.h"
#include "dgtkGltfUses.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <string_view>

namespace dgtk::import
{

namespace
{
using Json = GltfFile::Json;

constexpr std::string_view skinKey = "\"skin\"";
constexpr std::string_view sparseKey = "\"sparse\"";
constexpr double mostRounding = 1e-6; ///< of the square of a rotation's length, in single precision

/// Times and rows of one sampler; a spline's rows come three a key.
struct Sampler
{
  std::vector<double> times;
  std::vector<double> rows;
  std::size_t width = 0; ///< components of a row
  Interpolation interpolation = Interpolation::Linear;

  /// Row of key `key`: 0 the tangent before it (spline), 1 its value, 2 the tangent after it.
  const double* row(std::size_t key, std::size_t which) const
  {
    const bool cubic = this->interpolation == Interpolation::Cubic;
    return &this->rows[(cubic ? 3 * key + which : key) * this->width];
  }
};

Sampler readSampler(GltfFile& file, const Json& from, std::size_t components)
{
  Sampler sampler;
  const std::string how = from.value("interpolation", "LINEAR");
  sampler.interpolation = how == "STEP"          ? Interpolation::Step
                          : how == "CUBICSPLINE" ? Interpolation::Cubic
                                                 : Interpolation::Linear;
  sampler.times = file.numbers(from.at("input"), 1);
  sampler.rows = file.numbers(from.at("output"), components);
  const std::size_t rows = sampler.times.size() * (sampler.interpolation == Interpolation::Cubic ? 3 : 1);
  if (rows == 0 || sampler.rows.size() % rows != 0 || sampler.rows.empty())
  {
    GltfFile::fail("keys and values of an animation do not match");
  }
  sampler.width = sampler.rows.size() / rows;
  if (components != 1 && sampler.width != components)
  {
    GltfFile::fail("keys and values of an animation do not match");
  }
  return sampler;
}

/// Calls use(key) for every key that is later than the one before.
template <class Use>
void forKeys(const Sampler& sampler, Use use)
{
  double last = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < sampler.times.size(); ++i)
  {
    if (sampler.times[i] > last)
    {
      last = sampler.times[i];
      use(i);
    }
  }
}

template <std::size_t N>
Keys<N> keys(const Sampler& sampler, const std::array<std::size_t, N>& order)
{
  Keys<N> to;
  to.interpolation = sampler.interpolation;
  const auto value = [&](std::size_t key, std::size_t which)
  {
    std::array<double, N> result{};
    for (std::size_t i = 0; i < N; ++i)
    {
      result[i] = sampler.row(key, which)[order[i]];
    }
    return result;
  };
  forKeys(sampler,
    [&](std::size_t key)
    {
      to.times.push_back(sampler.times[key]);
      to.values.push_back(value(key, 1));
      if (sampler.interpolation == Interpolation::Cubic)
      {
        to.in.push_back(value(key, 0));
        to.out.push_back(value(key, 2));
      }
    });
  return to;
}

MorphChannel morph(const Sampler& sampler, std::int32_t node)
{
  MorphChannel to;
  to.node = node;
  to.targets = static_cast<std::uint32_t>(sampler.width);
  to.interpolation = sampler.interpolation;
  forKeys(sampler,
    [&](std::size_t key)
    {
      const auto append = [&](std::vector<double>& list, std::size_t which)
      { list.insert(list.end(), sampler.row(key, which), sampler.row(key, which) + sampler.width); };
      to.times.push_back(sampler.times[key]);
      append(to.weights, 1);
      if (sampler.interpolation == Interpolation::Cubic)
      {
        append(to.in, 0);
        append(to.out, 2);
      }
    });
  return to;
}

/// What an animation does not move stays as the node has it.
template <std::size_t N>
void fill(Keys<N>& to, const Json& node, const char* name, std::array<double, N> value)
{
  if (!to.times.empty())
  {
    return;
  }
  if (node.contains(name))
  {
    value = node.at(name).get<std::array<double, N>>();
  }
  if constexpr (N == 4)
  {
    value = { value[3], value[0], value[1], value[2] }; // the file's order is x, y, z, w
  }
  to.times.push_back(0);
  to.values.push_back(value);
}

/// Keys that forKeys() passes over are counted in `lost`.
Animation readAnimation(GltfFile& file, const Json& from, const NodeMatch& nodes, std::size_t& lost)
{
  Animation to;
  to.name = from.value("name", "");
  std::map<std::size_t, Channel> channels;
  for (const Json& channel : from.at("channels"))
  {
    const Json& target = channel.at("target");
    const std::string path = target.value("path", "");
    const std::int32_t node = target.contains("node") ? nodes.of(target.at("node")) : noIndex;
    const std::size_t components = path == "rotation" ? 4 : path == "weights" ? 1 : 3;
    if (path != "rotation" && path != "weights" && path != "translation" && path != "scale")
    {
      continue; // of an extension
    }
    const Sampler sampler = readSampler(file, from.at("samplers").at(std::size_t(channel.at("sampler"))), components);
    lost += sampler.times.size();
    forKeys(sampler,
      [&](std::size_t key)
      {
        to.duration = std::max(to.duration, sampler.times[key]);
        --lost;
      });
    if (node == noIndex)
    {
      continue;
    }
    if (path == "weights")
    {
      to.morphs.push_back(morph(sampler, node));
      continue;
    }
    Channel& own = channels[target.at("node")];
    own.node = node;
    if (path == "rotation")
    {
      own.rotation = keys<4>(sampler, { 3, 0, 1, 2 });
    }
    else
    {
      (path == "scale" ? own.scale : own.translation) = keys<3>(sampler, { 0, 1, 2 });
    }
  }
  for (auto& [node, channel] : channels)
  {
    const Json& rest = file.item("nodes", node);
    fill<3>(channel.translation, rest, "translation", { 0, 0, 0 });
    fill<4>(channel.rotation, rest, "rotation", { 0, 0, 0, 1 });
    fill<3>(channel.scale, rest, "scale", { 1, 1, 1 });
    to.channels.push_back(channel);
  }
  return to;
}

void repairMotion(GltfFile& file, const NodeMatch& nodes, Scene& scene)
{
  if (!file.root().contains("animations"))
  {
    return;
  }
  std::vector<Animation> animations;
  std::size_t lost = 0;
  for (const Json& animation : file.root().at("animations"))
  {
    animations.push_back(readAnimation(file, animation, nodes, lost));
  }
  scene.animations = std::move(animations);
  if (lost > 0)
  {
    scene.warnings.push_back(std::to_string(lost) +
                             (lost == 1 ? " key of an animation is" : " keys of animations are") +
                             " left out: their times do not ascend");
  }
}

/// parent_from_node of a node, which the importer has in single precision.
Matrix placeOf(const Json& node)
{
  Matrix to{};
  if (node.contains("matrix"))
  {
    const auto columns = node.at("matrix").get<Matrix>();
    for (std::size_t i = 0; i < 16; ++i)
    {
      to[i] = columns[i % 4 * 4 + i / 4];
    }
    return to;
  }
  using Vector = std::array<double, 3>;
  const auto [x, y, z, w] = node.value("rotation", std::array<double, 4>{ 0, 0, 0, 1 });
  const auto translation = node.value("translation", Vector{ 0, 0, 0 });
  const auto scale = node.value("scale", Vector{ 1, 1, 1 });
  Eigen::Quaterniond rotation(w, x, y, z);
  if (std::abs(rotation.squaredNorm() - 1) > mostRounding && rotation.squaredNorm() > 0)
  {
    rotation.normalize(); // it would scale otherwise
  }
  const Eigen::Matrix3d turn = rotation.toRotationMatrix();
  for (std::size_t i = 0; i < 3; ++i)
  {
    to[4 * i + 3] = translation[i];
    for (std::size_t j = 0; j < 3; ++j)
    {
      to[4 * i + j] = turn(Eigen::Index(i), Eigen::Index(j)) * scale[j];
    }
  }
  to[15] = 1;
  return to;
}

/// A list of names at the top of the file.
std::set<std::string> extensionsOf(const GltfFile& file, const char* list)
{
  std::set<std::string> names;
  for (const Json& name : file.root().value(list, Json::array()))
  {
    names.insert(name.is_string() ? name.get<std::string>() : std::string());
  }
  return names;
}

/// Whether a node has something of that name.
bool nodesSay(const GltfFile& file, const char* name)
{
  const Json nodes = file.root().value("nodes", Json::array());
  return nodes.is_array() && // not glTF 1
         std::any_of(nodes.begin(), nodes.end(), [name](const Json& node) { return node.contains(name); });
}

/// Whether a text is somewhere in a list of the file.
bool stands(const GltfFile& file, const char* list, const char* text)
{
  return file.root().value(list, Json::array()).dump().find(text) != std::string::npos;
}

/// Whether an extension packs triangles in a way that is not read: the model would have others.
bool isPacking(const std::string& extension)
{
  return extension == "KHR_draco_mesh_compression" || extension == "EXT_meshopt_compression" ||
         extension == "KHR_meshopt_compression" || extension == "EXT_mesh_gpu_instancing";
}

std::string needs(const std::string& extension)
{
  return "needs the glTF extension " + extension + ", which is not read";
}

void requireExtension(const std::string& name, Scene& scene)
{
  const std::set<std::string> known{ textureTransform, "KHR_mesh_quantization", "KHR_lights_punctual",
    "KHR_materials_unlit", "KHR_materials_emissive_strength", "KHR_materials_pbrSpecularGlossiness" };
  if (isPacking(name))
  {
    scene.error = needs(name);
  }
  else if (known.count(name) == 0)
  {
    scene.warnings.push_back("the glTF extension \"" + name.substr(0, 100) + "\", which the file needs, is not read");
  }
}

/// What went wrong, or "".
template <class Step>
std::string problemOf(const Step& step)
{
  try
  {
    step();
    return {};
  }
  catch (const std::bad_alloc&)
  {
    throw;
  }
  catch (const Json::exception&)
  {
    return "something of the file is missing or of an unexpected type";
  }
  catch (const std::exception& error)
  {
    return error.what();
  }
}

std::string withoutSkins(std::string bytes)
{
  for (std::size_t at = 0; (at = bytes.find(skinKey, at)) != std::string::npos;)
  {
    at += skinKey.size();
    const std::size_t next = bytes.find_first_not_of(" \t\r\n", at);
    if (next != std::string::npos && bytes[next] == ':')
    {
      bytes[at - 2] = 'N';
    }
  }
  return bytes;
}

/// Of a file that cannot be parsed, although the importer reads it.
bool maySparseHaveGaps(const std::string& bytes)
{
  return bytes.find(sparseKey) != std::string::npos && bytes.find("\"byteStride\"") != std::string::npos;
}

/// A node that says nonsense stays as the importer has it.
void repairPlaces(const GltfFile& file, const NodeMatch& nodes, Scene& scene)
{
  const Json all = file.root().value("nodes", Json::array());
  for (std::size_t n = 0; n < all.size(); ++n)
  {
    const std::int32_t index = nodes.of(n);
    if (index != noIndex)
    {
      problemOf([&] { scene.nodes[static_cast<std::size_t>(index)].parent_from_node = placeOf(all[n]); });
    }
  }
}
} // namespace

std::string withoutHarm(const std::string& path, const ReadContents& contentsOf)
{
  std::string bytes;
  std::string written;
  const std::string problem = problemOf(
    [&]
    {
      bytes = contentsOf(path);
      if (bytes.find(skinKey) == std::string::npos && bytes.find(sparseKey) == std::string::npos)
      {
        return; // as most files, which are not parsed for it
      }
      const GltfFile file(path, [&bytes](const std::string&) { return bytes; });
      written = file.hasSparseGaps()     ? inOrder(path, contentsOf)
                : nodesSay(file, "skin") ? withoutSkins(bytes)
                                         : std::string();
    });
  if (!problem.empty() && maySparseHaveGaps(bytes))
  {
    throw std::runtime_error("its sparse values cannot be read: " + problem);
  }
  return written;
}

std::string inOrder(const std::string& path, const ReadContents& contentsOf)
{
  std::string written;
  problemOf([&] { written = withoutSkins(GltfFile(path, contentsOf).inOrder(contentsOf(path))); });
  return written;
}

/// Why a file of that version is refused, or "".
std::string versionProblem(const Json& root)
{
  const Json asset = root.value("asset", Json::object());
  const std::string version = asset.is_object() && asset.contains("version") && asset["version"].is_string()
                                ? asset["version"].get<std::string>()
                                : std::string();
  const bool isTwo = version == "2" || version.rfind("2.", 0) == 0; // all of which read as 2.0 unless they say so
  const std::string least = version.empty() ? version : asset.value("minVersion", isTwo ? "2.0" : version);
  return version.empty()  ? "has no asset.version (a text), without which it is no glTF"
         : least != "2.0" ? "needs a reader of glTF " + least.substr(0, 20) + "; 2.0 is read"
                          : "";
}

std::string gltfProblem(const std::string& path, const ReadContents& contentsOf)
{
  std::set<std::string> extensions;
  std::string ofVersion;
  const std::string problem = problemOf(
    [&]
    {
      const GltfFile file(path, contentsOf);
      ofVersion = versionProblem(file.root());
      extensions = extensionsOf(file, "extensionsRequired");
    });
  if (!ofVersion.empty())
  {
    return ofVersion;
  }
  const auto packing = std::find_if(extensions.begin(), extensions.end(), isPacking);
  return packing != extensions.end() ? needs(*packing) : problem;
}

void repairGltf(const std::string& path, const ReadContents& contentsOf, Scene& scene)
{
  std::optional<GltfFile> file;
  std::optional<NodeMatch> nodes;
  const std::string problem = problemOf(
    [&]
    {
      file.emplace(path, contentsOf);
      scene.error = versionProblem(file->root());
      scene.declaredMaterials = std::int64_t(file->root().value("materials", Json::array()).size());
      nodes.emplace(*file, scene);
      repairPlaces(*file, *nodes, scene);
    });
  const std::string ofMotion = nodes ? problemOf([&] { repairMotion(*file, *nodes, scene); }) : problem;
  const std::string ofMeshes = nodes ? problemOf([&] { repairMeshes(*file, *nodes, scene); }) : problem;
  const std::string ofUses = nodes ? problemOf([&] { repairUses(*file, *nodes, scene); }) : problem;
  const std::string& ofSparse = !ofMeshes.empty() ? ofMeshes : !ofUses.empty() ? ofUses : ofMotion;
  if (!ofMotion.empty() && !scene.animations.empty())
  {
    scene.warnings.push_back("animations are taken from the importer, without steps and splines: " + ofMotion);
  }
  const std::set<std::string> used = file ? extensionsOf(*file, "extensionsUsed") : std::set<std::string>();
  if (!ofMeshes.empty() && used.count("KHR_mesh_quantization") > 0)
  {
    scene.error = "its quantized vertices cannot be read: " + ofMeshes;
  }
  else if (!ofSparse.empty() && file && file->hasSparseGaps())
  {
    scene.error = "its sparse values cannot be read: " + ofSparse;
  }
  else if (!ofUses.empty() && file && (nodesSay(*file, "skin") || nodesSay(*file, "weights")))
  {
    scene.error = "its skins or weights of morph targets: " + ofUses;
  }
  else if (!ofMeshes.empty() && file &&
           (stands(*file, "meshes", "\"COLOR_0\"") || stands(*file, "materials", textureTransform)))
  {
    scene.warnings.push_back("colours of vertices and places of textures do not count: " + ofMeshes);
  }
  const std::set<std::string> required = file ? extensionsOf(*file, "extensionsRequired") : std::set<std::string>();
  for (const std::string& extension : required)
  {
    requireExtension(extension, scene);
  }
  for (const char* const extension : { "EXT_mesh_gpu_instancing", "KHR_node_visibility", "KHR_animation_pointer" })
  {
    if (used.count(extension) > 0 && required.count(extension) == 0)
    {
      scene.warnings.push_back(
        std::string("the glTF extension \"") + extension + "\", which says what is there or moves, is not read");
    }
  }
}

} // namespace dgtk::import
