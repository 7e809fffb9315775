// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAssimpTexture.h"

#include "dgtkError.h"
#include "dgtkModelFiles.h"
#include "dgtkTexturePixels.h"

#include <charconv>

namespace dgtk
{

namespace
{
Eigen::Vector3d color(const std::array<double, 3>& from) { return Eigen::Vector3d(from.data()); }

/// A URI as the name of a file; "" when it is that name already.
std::string unescaped(const std::string& name)
{
  const std::string plain = withoutPercents(name.rfind("file://", 0) == 0 ? name.substr(7) : name);
  return plain == name ? std::string() : plain;
}

TextureWraps wrapOf(const import::Map& map)
{
  const auto along = [](import::Wrap wrap)
  {
    return wrap == import::Wrap::Clamp    ? TextureWrap::Clamp
           : wrap == import::Wrap::Mirror ? TextureWrap::Mirror
                                          : TextureWrap::Repeat;
  };
  return { along(map.wrap[0]), along(map.wrap[1]) };
}

/// glTF says what alpha means; elsewhere a picture with holes is a cut-out.
MaterialAlpha alphaOf(const import::Material& from)
{
  switch (from.alpha)
  {
    case import::AlphaMode::Mask:
      return { AlphaUse::CutOff, from.alphaCutoff };
    case import::AlphaMode::Opaque:
      return { AlphaUse::Nothing, 0 };
    default:
      return {};
  }
}
} // namespace

int AssimpMaterials::embeddedTexture(const import::Map& map)
{
  const std::string& name = map.name;
  std::size_t index = 0;
  const auto parsed = std::from_chars(name.data() + 1, name.data() + name.size(), index);
  if (parsed.ec != std::errc() || index >= this->Scene.textures.size())
  {
    this->Builder.warn("texture " + quoted(name) + " is not in the file");
    return -1;
  }
  import::Texture& from = this->Scene.textures[index];
  ModelPicture picture;
  picture.name = from.name.empty() ? name : from.name;
  picture.wrap = wrapOf(map);
  if (from.width > 0 && from.height > 0 && from.width <= picture::largestSide && from.height <= picture::largestSide &&
      from.data.size() == std::size_t(from.width) * static_cast<std::size_t>(from.height) * 4)
  {
    picture.width = from.width;
    picture.height = from.height;
  }
  else
  {
    const bool jpeg = from.data.size() > 1 && from.data[0] == 0xff && from.data[1] == 0xd8;
    picture.type = jpeg ? "jpg" : "png";
  }
  const auto [first, isFirst] = this->Embedded.try_emplace(index, ModelPicture::own);
  picture.same = first->second;
  picture.bytes = std::move(from.data); // empty when another one has taken it
  const int made = this->Builder.addEmbedded(std::move(picture));
  first->second = isFirst ? made : first->second;
  return made;
}

int AssimpMaterials::textureOf(const import::Map& map)
{
  const std::string& name = map.name;
  if (name.empty())
  {
    return -1;
  }
  const std::pair key{ name, wrapOf(map) };
  const auto known = this->Named.find(key);
  if (known != this->Named.end())
  {
    return known->second;
  }
  const int made =
    name[0] == '*' ? this->embeddedTexture(map) : this->Builder.addTexture(name, {}, unescaped(name), key.second);
  this->Named[key] = made;
  return made;
}

const import::Material* AssimpMaterials::find(std::int32_t index) const
{
  const bool known = index >= 0 && static_cast<std::size_t>(index) < this->Scene.materials.size();
  return known ? &this->Scene.materials[static_cast<std::size_t>(index)] : nullptr;
}

void AssimpMaterials::nameTextures(const std::vector<std::int32_t>& indices)
{
  for (const std::int32_t index : indices)
  {
    if (const import::Material* material = this->find(index))
    {
      for (const auto map : import::mapsOfMaterials)
      {
        this->textureOf(material->*map);
      }
    }
  }
}

int AssimpMaterials::add(std::int32_t index)
{
  if (!this->find(index))
  {
    return this->Builder.defaultMaterial();
  }
  const auto known = this->Known.find(index);
  if (known != this->Known.end())
  {
    return known->second;
  }
  const import::Material& from = *this->find(index);
  Material to;
  to.name = from.name;
  to.ambient = color(from.ambient);
  to.diffuse = color(from.diffuse);
  to.specular = color(from.specular);
  to.emission = color(from.emission);
  to.shininess = from.shininess;
  to.opacity = from.opacity;
  to.twoSided = from.twoSided != 0;
  if (from.alpha == import::AlphaMode::Unsaid && !(to.opacity > 0))
  {
    this->Builder.warn("material " + quoted(to.name) + " has opacity 0: drawn opaque");
    to.opacity = 1;
  }
  if (from.physical != 0)
  {
    to.physical = Material::Physical{ from.metallic, from.roughness, false };
  }
  to.texture = this->textureOf(from.texture);
  to.normalMap = this->textureOf(from.normalMap);
  to.metallicRoughnessMap = this->textureOf(from.metallicRoughnessMap);
  to.emissionMap = this->textureOf(from.emissionMap);
  to.occlusionMap = this->textureOf(from.occlusionMap);
  to.normalScale = from.normalScale;
  to.occlusionStrength = from.occlusionStrength;
  MaterialAlpha alpha = alphaOf(from);
  alpha.mask = this->textureOf(from.mask);
  alpha.value = from.maskIsLuminance != 0 ? MaskValue::Luminance : MaskValue::Usual;
  alpha.inverse = from.maskInverse;
  const int made = this->Builder.addMaterial(to, alpha);
  this->Known[index] = made;
  return made;
}

} // namespace dgtk
