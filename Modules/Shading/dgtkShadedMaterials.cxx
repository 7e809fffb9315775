// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkShadedMaterials.h"

#include "dgtkColorMap.h"
#include "dgtkSurfaceMaterial.h"

#include <iterator>

namespace dgtk
{

ShadedMaterialLibrary& ShadedMaterialLibrary::shared()
{
  static ShadedMaterialLibrary all;
  return all;
}

std::shared_ptr<const ShadedMaterials> ShadedMaterialLibrary::of(const Instance& instance)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  const Key key{ instance.model.get(), instance.materials.get() };
  if (std::shared_ptr<const ShadedMaterials> set = this->Sets[key].lock())
  {
    return set; // holds what the key points to
  }
  if (this->Sets.size() > 2 * this->Kept) // looking through all of them for each new one takes time with many
  {
    this->dropUnused();
    this->Kept = this->Sets.size();
  }
  const auto set = std::make_shared<ShadedMaterials>();
  set->model = instance.model;
  set->materials = instance.materials;
  for (const Part& part : instance.model->parts)
  {
    const Material& material = instance.materials->at(std::size_t(part.material));
    set->ofPart.push_back(this->make(*instance.model, material, *set));
    set->translucent = set->translucent || material.opacity < 1;
  }
  set->translucentColors = hasTranslucentColors(*instance.model);
  set->translucent = set->translucent || set->translucentColors;
  this->Sets[key] = set;
  return set;
}

void ShadedMaterialLibrary::dropUnused()
{
  const auto drop = [](auto& all, const auto& isUnused)
  {
    for (auto it = all.begin(); it != all.end();)
    {
      it = isUnused(it->second) ? all.erase(it) : std::next(it);
    }
  };
  drop(this->Sets, [](const auto& set) { return set.expired(); });
  drop(this->Textures, [](const KnownTexture& texture) { return texture.pyramid.expired(); });
}

std::shared_ptr<const TexturePyramid> ShadedMaterialLibrary::textureOf(const Model& model, int index, bool cutOut)
{
  if (index < 0 || model.uvs.empty() || !model.textures.at(std::size_t(index)).image)
  {
    return nullptr;
  }
  const Texture& texture = model.textures[std::size_t(index)];
  const std::shared_ptr<const Image>& image = texture.image;
  const PictureUse use{ cutOut, texture.filter, texture.wrap };
  KnownTexture& known = this->Textures[{ image.get(), use }];
  std::shared_ptr<const TexturePyramid> pyramid = known.pyramid.lock();
  if (!pyramid || known.image.lock() != image)
  {
    pyramid = std::make_shared<const TexturePyramid>(*image, use);
    known = { image, pyramid };
  }
  return pyramid;
}

ShadedMaterial ShadedMaterialLibrary::make(const Model& model, const Material& material, ShadedMaterials& set)
{
  const auto picture = [&](int index, bool cutOut = false)
  {
    std::shared_ptr<const TexturePyramid> pyramid = this->textureOf(model, index, cutOut);
    const TexturePyramid* const bare = pyramid.get();
    if (pyramid)
    {
      set.textures.push_back(std::move(pyramid));
    }
    return bare;
  };
  const FacetedSurface facets = facetsOf(material);
  ShadedMaterial to;
  to.ambient = toFloat4(material.ambient);
  to.diffuse = toFloat4(material.diffuse);
  to.specular = toFloat4(material.specular);
  to.emission = toFloat4(material.emission);
  to.f0 = toFloat4(facets.f0);
  to.shininess = float(material.shininess);
  to.opacity = float(material.opacity);
  to.metallic = float(facets.metallic);
  to.roughness = float(facets.roughness);
  to.normalScale = float(material.normalScale);
  to.bumpScale = float(material.bumpScale);
  to.occlusionStrength = float(material.occlusionStrength);
  to.shines = !material.specular.isZero(0);
  to.physical = material.physical && material.physical->wanted;
  to.texture = picture(material.texture, material.cutOut);
  to.normalMap = picture(material.normalMap);
  to.bumpMap = picture(material.bumpMap);
  to.metallicRoughnessMap = picture(material.metallicRoughnessMap);
  to.emissionMap = picture(material.emissionMap);
  if (material.emissionMap >= 0 && to.emissionMap == nullptr)
  {
    to.emission = float4(0); // where it glows is not known
  }
  to.occlusionMap = picture(material.occlusionMap);
  to.mapped = to.texture != nullptr || to.normalMap != nullptr || to.bumpMap != nullptr ||
              to.metallicRoughnessMap != nullptr || to.emissionMap != nullptr || to.occlusionMap != nullptr;
  return to;
}

} // namespace dgtk
