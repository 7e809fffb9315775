// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAssimpTexture.h"

#include "dgtkError.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <charconv>

namespace dgtk
{

namespace
{
constexpr int largestSide = 16384;

std::shared_ptr<Image> decode(OIIO::ImageInput& input, std::string& problem)
{
  const OIIO::ImageSpec& spec = input.spec();
  const int channels = std::min(spec.nchannels, 4);
  if (spec.width < 1 || spec.height < 1 || spec.width > largestSide || spec.height > largestSide || channels < 1)
  {
    problem = "is larger than " + std::to_string(largestSide) + " pixels a side, or empty";
    return nullptr;
  }
  const std::size_t pixels = std::size_t(spec.width) * static_cast<std::size_t>(spec.height);
  const auto step = static_cast<std::size_t>(channels);
  std::vector<std::uint8_t> raw(pixels * step);
  if (!input.read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, raw.data()))
  {
    problem = input.geterror();
    return nullptr;
  }
  auto image = std::make_shared<Image>();
  image->width = spec.width;
  image->height = spec.height;
  image->rgba.resize(pixels * 4);
  for (std::size_t i = 0; i < pixels; ++i)
  {
    const std::uint8_t* from = &raw[i * step];
    std::uint8_t* to = &image->rgba[i * 4];
    to[0] = from[0];
    to[1] = channels < 3 ? from[0] : from[1];
    to[2] = channels < 3 ? from[0] : from[2];
    to[3] = channels == 2 ? from[1] : channels == 4 ? from[3] : std::uint8_t(255);
  }
  return image;
}

void findAlpha(Image& image)
{
  image.hasAlpha = false;
  for (std::size_t i = 3; i < image.rgba.size(); i += 4)
  {
    image.hasAlpha = image.hasAlpha || image.rgba[i] < 255;
  }
}

/// "%20" and the like, and `file://` in front.
std::string withoutUrl(const std::string& name)
{
  std::string text = name.rfind("file://", 0) == 0 ? name.substr(7) : name;
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i)
  {
    unsigned code = 0;
    const char* digits = text.data() + i + 1;
    if (text[i] == '%' && i + 2 < text.size() && std::from_chars(digits, digits + 2, code, 16).ptr == digits + 2)
    {
      plain += static_cast<char>(code);
      i += 2;
    }
    else
    {
      plain += text[i];
    }
  }
  return plain;
}

Eigen::Vector3d color(const std::array<double, 3>& from) { return Eigen::Vector3d(from.data()); }
} // namespace

std::shared_ptr<const Image> decodeEmbedded(const import::Texture& texture, std::string& problem)
{
  problem.clear();
  std::shared_ptr<Image> image;
  if (texture.height > 0 && texture.width > 0 && texture.width <= largestSide && texture.height <= largestSide &&
      texture.data.size() == std::size_t(texture.width) * static_cast<std::size_t>(texture.height) * 4)
  {
    image = std::make_shared<Image>();
    image->width = texture.width;
    image->height = texture.height;
    image->rgba = texture.data;
  }
  else if (texture.height == 0 && texture.data.size() > 8)
  {
    const bool jpeg = texture.data[0] == 0xff && texture.data[1] == 0xd8;
    OIIO::ImageSpec config;
    config["oiio:UnassociatedAlpha"] = 1;
    OIIO::Filesystem::IOMemReader memory(const_cast<std::uint8_t*>(texture.data.data()), texture.data.size());
    const auto input = OIIO::ImageInput::create(jpeg ? "jpeg" : "png");
    OIIO::ImageSpec spec;
    if (input && input->set_ioproxy(&memory) && input->open(jpeg ? "embedded.jpg" : "embedded.png", spec, config))
    {
      image = decode(*input, problem);
    }
    else
    {
      problem = input ? input->geterror() : OIIO::geterror();
    }
  }
  if (!image)
  {
    problem = problem.empty() ? "is not a PNG or JPEG picture" : problem;
    std::replace(problem.begin(), problem.end(), '\n', ' ');
    return nullptr;
  }
  findAlpha(*image);
  return image;
}

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
  Texture texture;
  texture.name = from.name.empty() ? name : from.name;
  texture.path = this->Builder.model().path;
  if (this->Options.decodeTextures)
  {
    std::string problem;
    texture.image = decodeEmbedded(from, problem);
    if (!texture.image)
    {
      this->Builder.warn("texture " + quoted(texture.name) + " in the file cannot be decoded: " + problem);
    }
  }
  this->Builder.model().textures.push_back(texture);
  return static_cast<int>(this->Builder.model().textures.size()) - 1;
}

int AssimpMaterials::fileTexture(const std::string& name)
{
  const std::string plain = withoutUrl(name);
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
    findAlpha(*remade);
    Texture texture = textures[static_cast<std::size_t>(to.texture)];
    texture.image = remade;
    known->second = static_cast<int>(textures.size());
    textures.push_back(texture);
  }
  to.texture = known->second;
}

int AssimpMaterials::add(std::int32_t index)
{
  if (index < 0 || static_cast<std::size_t>(index) >= this->Scene.materials.size())
  {
    return this->Builder.defaultMaterial();
  }
  const auto known = this->Known.find(index);
  if (known != this->Known.end())
  {
    return known->second;
  }
  const import::Material& from = this->Scene.materials[static_cast<std::size_t>(index)];
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
