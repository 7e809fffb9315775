// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFbxMaterials.h"

#include "dgtkImportBase64.h"
#include "dgtkPortableMath.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace dgtk::import
{

namespace
{
using Color = std::array<double, 3>;

/// A colour times its factor, as Phong and Lambert materials have it.
std::optional<Color> colorOf(const FbxObject& material, const std::string& name)
{
  if (material.property(name + "Color") == nullptr)
  {
    return std::nullopt;
  }
  Color color = material.vector(name + "Color", {});
  const double factor = material.number(name + "Factor", 1);
  for (double& component : color)
  {
    component *= factor;
  }
  return color;
}

void readColors(const FbxObject& material, Material& to)
{
  to.ambient = colorOf(material, "Ambient").value_or(to.ambient);
  to.diffuse = colorOf(material, "Diffuse").value_or(to.diffuse);
  to.specular = colorOf(material, "Specular").value_or(to.specular);
  to.emission = colorOf(material, "Emissive").value_or(to.emission);
  // surfaces of Maya and 3ds Max that are neither
  if (material.property("Maya|baseColor") != nullptr)
  {
    to.diffuse = material.vector("Maya|baseColor", to.diffuse);
    const double base = material.number("Maya|base", 1);
    std::for_each(to.diffuse.begin(), to.diffuse.end(), [base](double& c) { c *= base; });
  }
  to.diffuse = material.vector("3dsMax|Parameters|base_color", to.diffuse);
  to.shininess = material.number("ShininessExponent", material.number("Shininess", 0));
  if (!(to.shininess > 0))
  {
    to.specular = { 0, 0, 0 }; // an exponent of 0 would shine everywhere
  }
  const Color through = colorOf(material, "Transparent").value_or(Color{});
  const double factor = material.number("TransparencyFactor", 1); // "TransparentColor" and "TransparencyFactor"
  to.opacity = material.number("Opacity", 1 - factor * (through[0] + through[1] + through[2]) / 3);
}

/// 2 x 3 matrices, row by row.
using Affine = std::array<double, 6>;

Affine times(const Affine& a, const Affine& b)
{
  return { a[0] * b[0] + a[1] * b[3], a[0] * b[1] + a[1] * b[4], a[0] * b[2] + a[1] * b[5] + a[2],
    a[3] * b[0] + a[4] * b[3], a[3] * b[1] + a[4] * b[4], a[3] * b[2] + a[4] * b[5] + a[5] };
}

Affine inverse(const Affine& m)
{
  const double d = m[0] * m[4] - m[1] * m[3];
  if (d == 0 || !std::isfinite(d))
  {
    return { 1, 0, 0, 0, 1, 0 };
  }
  return { m[4] / d, -m[1] / d, (m[1] * m[5] - m[4] * m[2]) / d, -m[3] / d, m[0] / d, (m[3] * m[2] - m[0] * m[5]) / d };
}

/// Where a texture lies: it is scaled, turned and moved as the picture is (so Blender and the FBX SDK have it); texture
/// coordinates go the other way.
Affine placementOf(const FbxObject& texture)
{
  const auto shift = [](const Color& by, double sign) { return Affine{ 1, 0, sign * by[0], 0, 1, sign * by[1] }; };
  const Color scalePivot = texture.vector("TextureScalingPivot", {});
  const Color turnPivot = texture.vector("TextureRotationPivot", {});
  const Color scale = texture.vector("Scaling", { 1, 1, 1 });
  const Color turn = texture.vector("Rotation", {});
  const double angle = turn[2] * pi / 180;
  const double c = portable::cos(angle);
  const double s = portable::sin(angle);
  Affine uv_from_picture =
    times(shift(scalePivot, 1), times({ scale[0], 0, 0, 0, scale[1], 0 }, shift(scalePivot, -1)));
  uv_from_picture =
    times(shift(turnPivot, 1), times({ c, -s, 0, s, c, 0 }, times(shift(turnPivot, -1), uv_from_picture)));
  uv_from_picture = times(shift(texture.vector("Translation", {}), 1), uv_from_picture);
  return inverse(uv_from_picture);
}
} // namespace

std::string FbxMaterials::embedded(const FbxElement& video, const std::string& name)
{
  const FbxElement* content = video.find("Content");
  if (content == nullptr || content->values.empty())
  {
    return {};
  }
  const auto [known, isNew] = this->Embedded.try_emplace(content);
  if (!isNew)
  {
    return known->second;
  }
  const auto isPicture = [](const std::string& bytes)
  { return bytes.compare(0, 4, "\x89PNG") == 0 || bytes.compare(0, 2, "\xff\xd8") == 0; };
  std::string bytes = content->text(0);
  if (!isPicture(bytes))
  {
    bytes.clear(); // text files have it in base64, in several pieces
    for (std::size_t i = 0; i < content->values.size() && addBase64(content->text(i), bytes); ++i)
    {
    }
  }
  if (isPicture(bytes)) // of others the name counts
  {
    known->second = "*" + std::to_string(this->To.textures.size());
    Texture texture;
    texture.name = name;
    texture.data.assign(bytes.begin(), bytes.end());
    this->To.textures.push_back(std::move(texture));
  }
  return known->second;
}

/// The name of a texture's picture, or "*N" when the file holds it.
std::string FbxMaterials::pictureOf(std::size_t index)
{
  const FbxObject& texture = this->File.object(index);
  const auto named = [](const FbxElement& element)
  {
    for (const char* key : { "RelativeFilename", "FileName", "Filename" })
    {
      const FbxElement* name = element.find(key);
      if (name != nullptr && !name->text(0).empty())
      {
        return name->text(0);
      }
    }
    return std::string();
  };
  std::string name = named(*texture.element);
  for (const std::size_t video : this->File.childrenOf(index, "Video"))
  {
    const FbxElement& element = *this->File.object(video).element;
    name = name.empty() ? named(element) : name;
    std::string inside = this->embedded(element, name.substr(name.find_last_of("/\\") + 1));
    if (!inside.empty())
    {
      return inside;
    }
  }
  return name;
}

/// The texture that drives a property of a material, or 0; of several in layers the first one.
std::size_t FbxMaterials::textureOf(const FbxObject& material, const char* property) const
{
  for (const FbxObject::Link& link : material.children)
  {
    std::size_t index = link.property == property ? link.object : 0;
    if (this->File.object(index).is("LayeredTexture"))
    {
      const std::vector<std::size_t> layers = this->File.childrenOf(index, "Texture");
      index = layers.empty() ? 0 : layers.front();
    }
    if (this->File.object(index).is("Texture"))
    {
      return index;
    }
  }
  return 0;
}

/// A picture takes the place of the colour that it drives; factors stay.
void FbxMaterials::readPictures(const FbxObject& material, Material& to, FbxPlacement& placement)
{
  struct Use
  {
    const char* property;
    Map Material::*map;
    std::array<double, 3> Material::*color;
    const char* factor;
  };
  constexpr Use uses[] = { { "DiffuseColor", &Material::texture, &Material::diffuse, "DiffuseFactor" },
    { "Maya|baseColor", &Material::texture, &Material::diffuse, "Maya|base" },
    { "Maya|TEX_color_map", &Material::texture, &Material::diffuse, "" },
    { "3dsMax|Parameters|base_color_map", &Material::texture, &Material::diffuse, "" },
    { "EmissiveColor", &Material::emissionMap, &Material::emission, "EmissiveFactor" },
    { "NormalMap", &Material::normalMap, nullptr, "" } };
  bool isPlaced = false;
  for (const Use& use : uses)
  {
    const std::size_t index = this->textureOf(material, use.property);
    if (index == 0 || !(to.*use.map).name.empty())
    {
      continue;
    }
    const FbxObject& texture = this->File.object(index);
    const auto wrap = [&texture](const char* name)
    { return texture.integer(name, 0) == 1 ? Wrap::Clamp : Wrap::Repeat; };
    to.*use.map = { this->pictureOf(index), { wrap("WrapModeU"), wrap("WrapModeV") } };
    if (use.color != nullptr)
    {
      (to.*use.color).fill(material.number(use.factor, 1));
    }
    if (!isPlaced) // all pictures lie where the first one does
    {
      placement = { texture.text("UVSet"), placementOf(texture) };
      isPlaced = true;
    }
  }
}

std::int32_t FbxMaterials::indexOf(std::size_t object)
{
  const auto known = this->Made.find(object);
  if (known != this->Made.end())
  {
    return known->second;
  }
  const FbxObject& from = this->File.object(object);
  Material material;
  material.name = from.name;
  FbxPlacement placement;
  readColors(from, material);
  this->readPictures(from, material, placement);
  const auto made = static_cast<std::int32_t>(this->To.materials.size());
  this->To.materials.push_back(material);
  this->Placements.push_back(placement);
  this->Made[object] = made;
  return made;
}

std::int32_t FbxMaterials::other()
{
  const auto [known, isNew] = this->Made.try_emplace(0, static_cast<std::int32_t>(this->To.materials.size()));
  if (isNew)
  {
    this->To.materials.emplace_back().name = "DefaultMaterial";
    this->Placements.emplace_back();
  }
  return known->second;
}

} // namespace dgtk::import
