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
} // namespace

int AssimpMaterials::embeddedTexture(const std::string& name)
{
  std::size_t index = 0;
  const auto parsed = std::from_chars(name.data() + 1, name.data() + name.size(), index);
  if (parsed.ec != std::errc() || index >= this->Scene.textures.size())
  {
    this->Builder.warn("texture " + quoted(name) + " is not in the file");
    return -1;
  }
  const import::Texture& from = this->Scene.textures[index];
  const std::string known = from.name.empty() ? name : from.name;
  if (from.width > 0 && from.height > 0 && from.width <= picture::largestSide && from.height <= picture::largestSide &&
      from.data.size() == std::size_t(from.width) * static_cast<std::size_t>(from.height) * 4)
  {
    auto image = std::make_shared<Image>();
    image->width = from.width;
    image->height = from.height;
    image->rgba = from.data;
    dgtk::settleAlpha(*image, AlphaRule::Meant);
    this->Builder.model().textures.push_back({ known, this->Builder.model().path, image });
    return static_cast<int>(this->Builder.model().textures.size()) - 1;
  }
  const bool jpeg = from.data.size() > 1 && from.data[0] == 0xff && from.data[1] == 0xd8;
  return this->Builder.addEmbedded(known, { jpeg ? "jpg" : "png", &from.data });
}

int AssimpMaterials::fileTexture(const std::string& name)
{
  const std::string plain = withoutPercents(name.rfind("file://", 0) == 0 ? name.substr(7) : name);
  const bool asWritten = plain == name || !locateTexture(this->Builder.model().path, name).empty();
  return this->Builder.addTexture(asWritten ? name : plain);
}

int AssimpMaterials::textureOf(const std::string& name)
{
  if (name.empty())
  {
    return -1;
  }
  const auto known = this->Named.find(name);
  if (known != this->Named.end())
  {
    return known->second;
  }
  const int made = name[0] == '*' ? this->embeddedTexture(name) : this->fileTexture(name);
  this->Named[name] = made;
  return made;
}

/// glTF says what alpha means; elsewhere a picture with holes is a cut-out. Model has one cut-off, 0.5, and no other
/// use of alpha: a picture that means something else by it is remade.
void AssimpMaterials::settleAlpha(const import::Material& from, Material& to)
{
  std::vector<Texture>& textures = this->Builder.model().textures;
  const std::shared_ptr<const Image> image =
    to.texture < 0 ? nullptr : textures[static_cast<std::size_t>(to.texture)].image;
  const bool mask = from.alpha == import::AlphaMode::Mask;
  if (from.alpha == import::AlphaMode::Unsaid || from.alpha == import::AlphaMode::Blend)
  {
    to.cutOut = image && isCutOut(*image);
    return;
  }
  const double cutoff = mask ? from.alphaCutoff : 0;
  const double opacity = mask ? to.opacity : 1;
  to.opacity = 1;
  to.cutOut = mask && to.texture >= 0;
  if (!image || !image->hasAlpha || (mask && cutoff == 0.5 && opacity == 1))
  {
    return;
  }
  const auto [known, isNew] = this->Remade.try_emplace({ to.texture, cutoff, opacity }, 0);
  if (isNew)
  {
    auto remade = std::make_shared<Image>(*image);
    for (std::size_t i = 3; i < remade->rgba.size(); i += 4)
    {
      remade->rgba[i] = remade->rgba[i] * opacity / 255 >= cutoff ? 255 : 0;
    }
    dgtk::settleAlpha(*remade, AlphaRule::Meant);
    Texture texture = textures[static_cast<std::size_t>(to.texture)];
    texture.image = remade;
    known->second = static_cast<int>(textures.size());
    textures.push_back(texture);
  }
  to.texture = known->second;
}

const import::Material* AssimpMaterials::find(std::int32_t index) const
{
  const bool known = index >= 0 && static_cast<std::size_t>(index) < this->Scene.materials.size();
  return known ? &this->Scene.materials[static_cast<std::size_t>(index)] : nullptr;
}

void AssimpMaterials::prepare(const std::vector<std::int32_t>& indices)
{
  for (const std::int32_t index : indices)
  {
    if (const import::Material* material = this->find(index))
    {
      for (const std::string* name : { &material->texture, &material->normalMap, &material->metallicRoughnessMap,
             &material->emissionMap, &material->occlusionMap })
      {
        this->textureOf(*name);
      }
    }
  }
  this->Builder.decodeTextures();
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
  this->settleAlpha(from, to);
  const int made = this->Builder.addMaterial(to);
  this->Known[index] = made;
  return made;
}

} // namespace dgtk
