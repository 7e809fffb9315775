// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkGltfFile.h"

#include "dgtkImportBase64.h"

#include <algorithm>
#include <cstring>
#include <set>
#include <tuple>
#include <utility>

namespace dgtk::import
{

namespace
{
using Json = GltfFile::Json;

constexpr std::size_t mostGltfNodes = 1'000'000;

std::size_t littleWord(const std::string& bytes, std::size_t at)
{
  std::size_t value = 0;
  for (std::size_t i = 4; i-- > 0;)
  {
    value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
  }
  return value;
}

std::string word(std::size_t value)
{
  std::string bytes;
  for (int i = 0; i < 4; ++i)
  {
    bytes += static_cast<char>(value >> (8 * i) & 0xff);
  }
  return bytes;
}

/// A file without scenes, as it may be, is one of all nodes.
Json withScene(Json root)
{
  if (!root.is_object() || root.contains("scenes") || !root.contains("nodes") || !root["nodes"].is_array())
  {
    return root;
  }
  std::set<std::size_t> children;
  for (const Json& node : root["nodes"])
  {
    for (const Json& child : node.value("children", Json::array()))
    {
      children.insert(child.get<std::size_t>());
    }
  }
  Json roots = Json::array();
  for (std::size_t n = 0; n < root["nodes"].size(); ++n)
  {
    if (children.count(n) == 0)
    {
      roots.push_back(n);
    }
  }
  root["scenes"] = Json::array({ { { "nodes", roots } } });
  root.erase("scene");
  return root;
}

/// The JSON of a file, and where what follows it begins.
std::pair<Json, std::size_t> parsed(const std::string& bytes)
{
  if (bytes.compare(0, 4, "glTF") != 0)
  {
    return { withScene(Json::parse(bytes)), bytes.size() };
  }
  const std::size_t length = littleWord(bytes, 12);
  // some pad it with bytes that are 0
  return { withScene(Json::parse(bytes.substr(20, length).c_str())), 20 + (length + 3) / 4 * 4 };
}

std::string fromBase64(const std::string& text, std::size_t begin)
{
  std::string bytes;
  if (!addBase64(std::string_view(text).substr(begin), bytes))
  {
    GltfFile::fail("a buffer is not base64");
  }
  return bytes;
}

std::size_t bytesOf(int type) { return type == 5126 || type == 5125 ? 4 : type == 5122 || type == 5123 ? 2 : 1; }

/// Components of a row of an accessor, 0 where its type is unknown.
std::size_t widthOf(const Json& accessor)
{
  static const std::map<std::string, std::size_t> widths = { { "SCALAR", 1 }, { "VEC2", 2 }, { "VEC3", 3 },
    { "VEC4", 4 }, { "MAT4", 16 } };
  const auto found = widths.find(accessor.at("type").get<std::string>());
  return found == widths.end() ? 0 : found->second;
}

/// Whether an accessor has sparse values over rows with gaps.
bool isSparseWithGaps(const Json& accessor, const Json& root)
{
  try
  {
    return accessor.is_object() && accessor.contains("sparse") &&
           root.at("bufferViews").at(accessor.at("bufferView").get<std::size_t>()).value("byteStride", std::size_t(0)) >
             widthOf(accessor) * bytesOf(accessor.at("componentType"));
  }
  catch (const Json::exception&)
  {
    return false; // there is no such accessor
  }
}

/// An integer as it is, or a share of the largest of its type.
double number(const char* from, int type, bool normalized)
{
  const auto as = [from](auto value)
  {
    std::memcpy(&value, from, sizeof value);
    return static_cast<double>(value);
  };
  const auto share = [normalized](double value, double one)
  { return normalized ? std::max(value / one, -1.0) : value; };
  switch (type)
  {
    case 5120:
      return share(as(std::int8_t(0)), 127);
    case 5121:
      return share(as(std::uint8_t(0)), 255);
    case 5122:
      return share(as(std::int16_t(0)), 32767);
    case 5123:
      return share(as(std::uint16_t(0)), 65535);
    case 5125:
      return as(std::uint32_t(0));
    case 5126:
      return as(float(0));
    default:
      GltfFile::fail("an accessor is of an unexpected type");
  }
}
} // namespace

void GltfFile::fail(const char* what) { throw std::runtime_error(what); }

GltfFile::GltfFile(const std::string& path, const ReadContents& contentsOf)
  : Folder(std::filesystem::path(path).parent_path())
  , ContentsOf(contentsOf)
{
  const std::string bytes = contentsOf(path);
  std::tie(this->Root, this->End) = parsed(bytes);
  if (this->End + 8 <= bytes.size())
  {
    this->Binary = bytes.substr(this->End + 8, littleWord(bytes, this->End));
  }
}

std::size_t GltfFile::vertices(const Json& primitive) const
{
  const Json& attributes = primitive.at("attributes");
  return attributes.contains("POSITION")
           ? this->item("accessors", attributes["POSITION"]).at("count").get<std::size_t>()
           : 0;
}

bool GltfFile::drawsNothing(const Json& primitive)
{
  const std::size_t count = this->vertices(primitive);
  const int mode = primitive.value("mode", 4);
  const std::size_t size = mode >= 4 ? 3 : mode >= 1 ? 2 : 1;
  const std::size_t step = mode == 4 ? 3 : mode == 1 ? 2 : 1;
  if (!primitive.contains("indices"))
  {
    return count < size;
  }
  const std::vector<double> corners = this->numbers(primitive["indices"], 1, Integers::AsSaid);
  const auto exists = [&](std::size_t corner) { return corners[corner] < double(count); };
  for (std::size_t begin = 0; begin + size <= corners.size(); begin += step)
  {
    bool all = mode != 6 || exists(0); // a fan's triangles share the first corner
    for (std::size_t i = mode == 6 ? 1 : 0; i < size; ++i)
    {
      all = all && exists(begin + i);
    }
    if (all)
    {
      return false;
    }
  }
  return true;
}

void GltfFile::replaceEmpty()
{
  std::vector<Json*> empty;
  const Json* fewest = nullptr; // places that others can have
  const auto lookAt = [&](Json& primitive)
  {
    const std::size_t count = this->vertices(primitive);
    if (count > 0 && (fewest == nullptr || count < this->vertices(*fewest)))
    {
      fewest = &primitive;
    }
    if (this->drawsNothing(primitive))
    {
      empty.push_back(&primitive);
    }
  };
  Json none;
  const auto list = [&none](Json& object, const char* name) -> Json&
  {
    const auto found = object.find(name);
    return found == object.end() ? none : *found;
  };
  for (Json& mesh : list(this->Root, "meshes"))
  {
    for (Json& primitive : list(mesh, "primitives"))
    {
      try
      {
        lookAt(primitive);
      }
      catch (const std::bad_alloc&)
      {
        throw;
      }
      catch (const std::exception&) // the importer says what it is
      {
      }
    }
  }
  const Json places = fewest ? (*fewest)["attributes"]["POSITION"] : Json();
  for (Json* const primitive : fewest ? empty : std::vector<Json*>())
  {
    (*primitive)["mode"] = 0;
    primitive->erase("indices");
    if (this->vertices(*primitive) == 0)
    {
      primitive->erase("targets");
      (*primitive)["attributes"] = { { "POSITION", places } };
    }
  }
}

std::string GltfFile::inOrder(const std::string& bytes)
{
  this->replaceEmpty();
  for (Json& list : this->Root)
  {
    for (Json& item : list)
    {
      if (item.is_object() && item.contains("extras") && !item["extras"].is_object())
      {
        item.erase("extras");
      }
      if (isSparseWithGaps(item, this->Root))
      {
        item.erase("sparse");
      }
    }
  }
  std::string text = this->Root.dump();
  if (this->End == bytes.size())
  {
    return text;
  }
  text.resize((text.size() + 3) / 4 * 4, ' ');
  const std::string rest = bytes.substr(std::min(this->End, bytes.size()));
  return "glTF" + word(2) + word(20 + text.size() + rest.size()) + word(text.size()) + "JSON" + text + rest;
}

bool GltfFile::hasSparseGaps(const Json& accessor) const { return isSparseWithGaps(accessor, this->Root); }

bool GltfFile::hasSparseGaps() const
{
  const Json accessors = this->Root.value("accessors", Json::array());
  return std::any_of(accessors.begin(), accessors.end(), [this](const Json& a) { return this->hasSparseGaps(a); });
}

std::vector<double> GltfFile::list(
  const Json& where, int type, std::size_t count, std::size_t components, bool normalized)
{
  const Json& view = this->item("bufferViews", where.at("bufferView"));
  const std::string& buffer = this->buffer(view.at("buffer"));
  const std::size_t size = bytesOf(type);
  const std::size_t stride = view.value("byteStride", size * components);
  const std::size_t begin = view.value("byteOffset", std::size_t(0)) + where.value("byteOffset", std::size_t(0));
  if (count > buffer.size() || stride > 4096 || begin > buffer.size() ||
      (count > 0 && (count - 1) * stride + size * components > buffer.size() - begin))
  {
    GltfFile::fail("an accessor reaches beyond its buffer");
  }
  std::vector<double> numbers;
  for (std::size_t i = 0; i < count * components; ++i)
  {
    const char* const from = buffer.data() + begin + i / components * stride + i % components * size;
    numbers.push_back(number(from, type, normalized));
  }
  return numbers;
}

std::vector<double> GltfFile::numbers(std::size_t index, std::size_t components, Integers integers)
{
  constexpr std::size_t mostWithoutBytes = 1 << 24;
  const Json& accessor = this->item("accessors", index);
  if (widthOf(accessor) != components)
  {
    GltfFile::fail("an accessor is of an unexpected type");
  }
  const int type = accessor.at("componentType");
  const std::size_t count = accessor.at("count");
  const bool normalized = integers == Integers::Shares || accessor.value("normalized", false);
  if (!accessor.contains("bufferView") && count > mostWithoutBytes)
  {
    GltfFile::fail("an accessor without bytes is too long");
  }
  std::vector<double> numbers = accessor.contains("bufferView")
                                  ? this->list(accessor, type, count, components, normalized)
                                  : std::vector<double>(count * components);
  if (accessor.contains("sparse"))
  {
    const Json& sparse = accessor.at("sparse");
    const std::size_t changes = sparse.at("count");
    const Json& indices = sparse.at("indices");
    const std::vector<double> places = this->list(indices, indices.at("componentType"), changes, 1, false);
    const std::vector<double> values = this->list(sparse.at("values"), type, changes, components, normalized);
    for (std::size_t i = 0; i < changes; ++i)
    {
      if (!(places[i] >= 0 && places[i] < double(count)))
      {
        GltfFile::fail("an accessor changes what is not there");
      }
      std::copy_n(values.begin() + std::ptrdiff_t(i * components), components,
        numbers.begin() + std::ptrdiff_t(std::size_t(places[i]) * components));
    }
  }
  return numbers;
}

std::vector<double> GltfFile::ofVertices(std::size_t index, std::size_t components, Integers integers, const Mesh& mesh)
{
  std::vector<double> all = this->numbers(index, components, integers);
  if (all.size() != components * mesh.positions.size())
  {
    GltfFile::fail("attributes and vertices do not match");
  }
  return all;
}

const std::string& GltfFile::buffer(std::size_t index)
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

NodeMatch::NodeMatch(const GltfFile& file, const Scene& scene)
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

void NodeMatch::match(std::size_t node, std::size_t index)
{
  const Json& from = this->File.item("nodes", node);
  if (this->Index.size() > mostGltfNodes || !this->Index.emplace(node, static_cast<std::int32_t>(index)).second)
  {
    GltfFile::fail("a node has two parents");
  }
  const std::string name = from.value("name", "");
  if (!name.empty() && name != this->Whole.nodes[index].name)
  {
    GltfFile::fail("nodes are not as expected");
  }
  this->matchAll(from.value("children", Json::array()), this->Children[index]);
}

void NodeMatch::matchAll(const Json& nodes, const std::vector<std::size_t>& indices)
{
  if (nodes.size() != indices.size())
  {
    GltfFile::fail("nodes are not as expected");
  }
  for (std::size_t i = 0; i < indices.size(); ++i)
  {
    this->match(nodes[i], indices[i]);
  }
}

} // namespace dgtk::import
