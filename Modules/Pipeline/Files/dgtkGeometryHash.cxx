// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkGeometryHash.h"

#include "dgtkHash.h"

#include <map>
#include <tuple>
#include <type_traits>

namespace dgtk
{

namespace
{
/// Lists with their lengths, so that no two geometries have the same bytes.
class Bytes
{
public:
  void text(const std::string& value)
  {
    this->number(value.size());
    this->Hash.update(value.data(), value.size());
  }
  template <typename T>
  void number(T value)
  {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    this->Hash.update(&value, sizeof value);
  }
  void numbers(const Eigen::Vector3d& value) { this->Hash.update(value.data(), sizeof(double) * 3); }
  /// Of types without padding.
  template <typename T>
  void list(const std::vector<T>& values)
  {
    this->number(values.size());
    this->Hash.update(values.data(), sizeof(T) * values.size());
  }
  void picture(const Image& image)
  {
    this->number(image.width);
    this->number(image.height);
    this->list(image.rgba);
  }
  std::string hex() { return this->Hash.hex(); }

private:
  Sha256 Hash;
};

std::string hashOfTexture(const Texture& texture)
{
  Bytes bytes;
  bytes.number(texture.filter);
  bytes.number(texture.repeats());
  if (!texture.repeats())
  {
    bytes.number(texture.wrap[0]);
    bytes.number(texture.wrap[1]);
  }
  bytes.text(texture.path.empty() || !texture.image ? "" : hashOfFile(texture.path));
  if (texture.path.empty() && texture.image)
  {
    bytes.picture(*texture.image);
  }
  return bytes.hex();
}

class GeometryHashes
{
public:
  std::string of(const Instance& instance)
  {
    const Key key{ instance.model.get(), instance.geometry.get(), instance.materials.get() };
    const auto known = this->Known.find(key);
    return known != this->Known.end() ? known->second : this->Known[key] = this->compute(instance);
  }

private:
  using Key = std::tuple<const Model*, const Geometry*, const std::vector<Material>*>;

  std::string compute(const Instance& instance)
  {
    const Model& model = *instance.model;
    Bytes bytes;
    bytes.list(instance.geometry->positions);
    bytes.list(instance.geometry->normals);
    bytes.list(model.triangles);
    bytes.list(model.uvs);
    if (!model.unplaced.empty())
    {
      bytes.list(model.unplaced);
    }
    bytes.list(model.colors);
    bytes.list(model.colorMapAt);
    if (model.colorMap)
    {
      bytes.picture(*model.colorMap);
    }
    for (const Part& part : model.parts)
    {
      bytes.number(part.triangles);
      this->material(model, (*instance.materials)[std::size_t(part.material)], bytes);
    }
    return bytes.hex();
  }

  void material(const Model& model, const Material& material, Bytes& bytes)
  {
    for (const Eigen::Vector3d& color : { material.ambient, material.diffuse, material.specular, material.emission })
    {
      bytes.numbers(color);
    }
    for (const double number :
      { material.shininess, material.opacity, material.normalScale, material.bumpScale, material.occlusionStrength })
    {
      bytes.number(number);
    }
    bytes.number(material.cutOut);
    bytes.number(material.physical.has_value());
    const Material::Physical physical = material.physical.value_or(Material::Physical());
    bytes.number(physical.metallic);
    bytes.number(physical.roughness);
    bytes.number(physical.wanted);
    for (const auto texture : materialTextures)
    {
      const int index = material.*texture;
      bytes.text(index < 0 ? "" : this->texture(model.textures[std::size_t(index)]));
    }
  }

  const std::string& texture(const Texture& texture)
  {
    std::string& hash = this->Textures[&texture];
    hash = hash.empty() ? hashOfTexture(texture) : hash;
    return hash;
  }

  std::map<Key, std::string> Known;
  std::map<const Texture*, std::string> Textures;
};
} // namespace

std::vector<std::string> geometryHashes(const Stage& stage)
{
  GeometryHashes hashes;
  std::vector<std::string> list;
  const std::shared_ptr<const SceneState> state = stage.at(stage.description().firstFrame());
  for (const Instance& instance : state->instances)
  {
    list.push_back(hashes.of(instance));
  }
  return list;
}

} // namespace dgtk
