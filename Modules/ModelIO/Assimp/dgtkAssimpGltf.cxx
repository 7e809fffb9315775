// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAssimpGltf.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <map>

namespace dgtk::import
{

namespace
{
using Json = nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t mostGltfNodes = 1'000'000;

[[noreturn]] void fail(const char* what) { throw std::runtime_error(what); }

std::size_t littleWord(const std::string& bytes, std::size_t at)
{
  std::size_t value = 0;
  for (std::size_t i = 4; i-- > 0;)
  {
    value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  }
  return value;
}

/// RFC 4648
std::string fromBase64(const std::string& text, std::size_t begin)
{
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t group = 0;
  int bits = 0;
  for (std::size_t i = begin; i < text.size() && text[i] != '='; ++i)
  {
    const std::size_t digit = digits.find(text[i]);
    if (digit == std::string::npos)
    {
      fail("a buffer is not base64");
    }
    group = group << 6 | static_cast<std::uint32_t>(digit);
    bits += 6;
    if (bits >= 8)
    {
      bits -= 8;
      bytes += static_cast<char>(group >> bits & 255);
    }
  }
  return bytes;
}

class GltfFile
{
public:
  GltfFile(const std::string& path, const ReadContents& contentsOf)
    : Folder(fs::path(path).parent_path())
    , ContentsOf(contentsOf)
  {
    const std::string bytes = contentsOf(path);
    if (bytes.compare(0, 4, "glTF") != 0)
    {
      this->Root = Json::parse(bytes);
      return;
    }
    const std::size_t length = littleWord(bytes, 12);
    this->Root = Json::parse(bytes.substr(20, length));
    const std::size_t binary = 20 + (length + 3) / 4 * 4;
    if (binary + 8 <= bytes.size())
    {
      this->Binary = bytes.substr(binary + 8, littleWord(bytes, binary));
    }
  }

  const Json& root() const { return this->Root; }

  /// Item `index` of a list of the file.
  const Json& item(const char* list, std::size_t index) const { return this->Root.at(list).at(index); }

  /// All components of an accessor, normalised integers in [-1, 1].
  std::vector<double> numbers(std::size_t index, std::size_t components)
  {
    const Json& accessor = this->item("accessors", index);
    static const std::map<std::string, std::size_t> widths = { { "SCALAR", 1 }, { "VEC2", 2 }, { "VEC3", 3 },
      { "VEC4", 4 }, { "MAT4", 16 } };
    if (accessor.contains("sparse") || widths.at(accessor.at("type")) != components)
    {
      fail("an accessor is sparse or of an unexpected type");
    }
    const Json& view = this->item("bufferViews", accessor.at("bufferView"));
    const std::string& buffer = this->buffer(view.at("buffer"));
    const int type = accessor.at("componentType");
    const std::size_t size = type == 5126 || type == 5125 ? 4 : type == 5122 || type == 5123 ? 2 : 1;
    const std::size_t count = accessor.at("count");
    const std::size_t stride = view.value("byteStride", size * components);
    const std::size_t begin = view.value("byteOffset", std::size_t(0)) + accessor.value("byteOffset", std::size_t(0));
    if (count > buffer.size() || stride > 4096 || begin > buffer.size() ||
        (count > 0 && (count - 1) * stride + size * components > buffer.size() - begin))
    {
      fail("an accessor reaches beyond its buffer");
    }
    std::vector<double> numbers;
    for (std::size_t i = 0; i < count * components; ++i)
    {
      numbers.push_back(number(buffer.data() + begin + i / components * stride + i % components * size, type));
    }
    return numbers;
  }

private:
  static double number(const char* from, int type)
  {
    const auto as = [from](auto value)
    {
      std::memcpy(&value, from, sizeof value);
      return static_cast<double>(value);
    };
    switch (type)
    {
      case 5120:
        return std::max(as(std::int8_t(0)) / 127, -1.0);
      case 5121:
        return as(std::uint8_t(0)) / 255;
      case 5122:
        return std::max(as(std::int16_t(0)) / 32767, -1.0);
      case 5123:
        return as(std::uint16_t(0)) / 65535;
      case 5126:
        return as(float(0));
      default:
        fail("an accessor is of an unexpected type");
    }
  }

  const std::string& buffer(std::size_t index)
  {
    const auto known = this->Buffers.find(index);
    if (known != this->Buffers.end())
    {
      return known->second;
    }
    const Json& buffer = this->item("buffers", index);
    const std::string uri = buffer.value("uri", "");
    const std::size_t comma = uri.find(',');
    std::string& bytes = this->Buffers[index];
    bytes = uri.empty()                  ? this->Binary
            : uri.rfind("data:", 0) == 0 ? fromBase64(uri, comma == std::string::npos ? uri.size() : comma + 1)
                                         : this->ContentsOf((this->Folder / uri).string());
    return bytes;
  }

  fs::path Folder;
  ReadContents ContentsOf;
  Json Root;
  std::string Binary;
  std::map<std::size_t, std::string> Buffers;
};

/// Node of the file -> node of the scene, by the shape of the tree: names need not be unique.
class NodeMatch
{
public:
  NodeMatch(const GltfFile& file, const Scene& scene)
    : File(file)
    , Whole(scene)
    , Children(scene.nodes.size())
  {
    for (std::size_t i = 1; i < scene.nodes.size(); ++i)
    {
      this->Children[static_cast<std::size_t>(scene.nodes[i].parent)].push_back(i);
    }
    const Json& roots = file.item("scenes", file.root().value("scene", std::size_t(0))).at("nodes");
    if (roots.size() == 1)
    {
      this->match(roots[0], 0);
      return;
    }
    this->matchAll(roots, this->Children[0]);
  }

  std::int32_t of(std::size_t node) const
  {
    const auto found = this->Index.find(node);
    return found == this->Index.end() ? noIndex : found->second;
  }

private:
  void match(std::size_t node, std::size_t index)
  {
    const Json& from = this->File.item("nodes", node);
    if (this->Index.size() > mostGltfNodes || !this->Index.emplace(node, static_cast<std::int32_t>(index)).second)
    {
      fail("a node has two parents");
    }
    const std::string name = from.value("name", "");
    if (!name.empty() && name != this->Whole.nodes[index].name)
    {
      fail("nodes are not as expected");
    }
    this->matchAll(from.value("children", Json::array()), this->Children[index]);
  }
  void matchAll(const Json& nodes, const std::vector<std::size_t>& indices)
  {
    if (nodes.size() != indices.size())
    {
      fail("nodes are not as expected");
    }
    for (std::size_t i = 0; i < indices.size(); ++i)
    {
      this->match(nodes[i], indices[i]);
    }
  }

  const GltfFile& File;
  const Scene& Whole;
  std::vector<std::vector<std::size_t>> Children;
  std::map<std::size_t, std::int32_t> Index;
};

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
    fail("keys and values of an animation do not match");
  }
  sampler.width = sampler.rows.size() / rows;
  if (components != 1 && sampler.width != components)
  {
    fail("keys and values of an animation do not match");
  }
  return sampler;
}

/// Calls use(key) for every key that is later than the one before.
template <class Use>
void forKeys(const Sampler& sampler, Use use)
{
  double last = -1;
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

Animation readAnimation(GltfFile& file, const Json& from, const NodeMatch& nodes)
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
    to.duration = std::max(to.duration, *std::max_element(sampler.times.begin(), sampler.times.end()));
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

void repairJoints(const GltfFile& file, const NodeMatch& nodes, Scene& scene)
{
  const Json none = Json::array();
  const Json& list = file.root().contains("nodes") ? file.root().at("nodes") : none;
  for (std::size_t n = 0; n < list.size(); ++n)
  {
    const std::int32_t index = nodes.of(n);
    if (index == noIndex || !list[n].contains("skin"))
    {
      continue;
    }
    const Json& joints = file.item("skins", list[n].at("skin")).at("joints");
    for (const std::uint32_t m : scene.nodes[static_cast<std::size_t>(index)].meshes)
    {
      std::vector<Bone>& bones = scene.meshes.at(m).bones;
      for (std::size_t i = 0; bones.size() == joints.size() && i < bones.size(); ++i)
      {
        bones[i].node = nodes.of(joints[i]);
      }
    }
  }
}

void warnOfAnimations(Scene& scene, const char* why)
{
  if (!scene.animations.empty())
  {
    scene.warnings.push_back(std::string("animations are taken from the importer, without steps and splines: ") + why);
  }
}
} // namespace

void repairGltf(const std::string& path, const ReadContents& contentsOf, Scene& scene)
{
  try
  {
    GltfFile file(path, contentsOf);
    const NodeMatch nodes(file, scene);
    repairJoints(file, nodes, scene);
    if (file.root().contains("animations"))
    {
      std::vector<Animation> animations;
      for (const Json& animation : file.root().at("animations"))
      {
        animations.push_back(readAnimation(file, animation, nodes));
      }
      scene.animations = std::move(animations);
    }
  }
  catch (const std::bad_alloc&)
  {
    throw;
  }
  catch (const Json::exception&)
  {
    warnOfAnimations(scene, "something of the file is missing or of an unexpected type");
  }
  catch (const std::exception& error)
  {
    warnOfAnimations(scene, error.what());
  }
}

} // namespace dgtk::import
