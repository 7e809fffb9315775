// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMaterialMaps.h"

#include "dgtkSurfaceMaterial.h"

#include <cstring>
#include <vector>
#include <vtk_glew.h>

namespace dgtk
{
namespace
{

unsigned int uploaded(const Image& image)
{
  const std::size_t row = std::size_t(image.width) * 4;
  std::vector<std::uint8_t> upwards(image.rgba.size());
  for (int y = 0; y < image.height; ++y)
  {
    std::memcpy(&upwards[std::size_t(image.height - 1 - y) * row], &image.rgba[std::size_t(y) * row], row);
  }
  unsigned int name = 0;
  glGenTextures(1, &name);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, name);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, image.width, image.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, upwards.data());
  glGenerateMipmap(GL_TEXTURE_2D);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
  glBindTexture(GL_TEXTURE_2D, 0);
  return name;
}

} // namespace

MaterialMaps::~MaterialMaps()
{
  for (const auto& entry : this->Textures)
  {
    glDeleteTextures(1, &entry.second);
  }
}

void MaterialMaps::drop()
{
  for (auto entry = this->Textures.begin(); entry != this->Textures.end();)
  {
    if (!entry->first.expired())
    {
      ++entry;
      continue;
    }
    glDeleteTextures(1, &entry->second);
    entry = this->Textures.erase(entry);
  }
}

unsigned int MaterialMaps::textureOf(const Model& model, int index)
{
  if (index < 0 || model.uvs.empty() || !model.textures.at(std::size_t(index)).image)
  {
    return 0;
  }
  unsigned int& name = this->Textures[model.textures[std::size_t(index)].image];
  name = name != 0 ? name : uploaded(*model.textures[std::size_t(index)].image);
  return name;
}

SurfaceParameters MaterialMaps::parameters(const Model& model, const Material& material)
{
  const FacetedSurface facets = facetsOf(material);
  SurfaceParameters to;
  to.metalRough = { float(facets.metallic), float(facets.roughness) };
  for (std::size_t i = 0; i < 3; ++i)
  {
    to.f0[i] = float(facets.f0[Eigen::Index(i)]);
  }
  to.normalMap = this->textureOf(model, material.normalMap);
  to.bumpMap = this->textureOf(model, material.bumpMap);
  to.metallicRoughnessMap = this->textureOf(model, material.metallicRoughnessMap);
  to.emissionMap = this->textureOf(model, material.emissionMap);
  to.occlusionMap = this->textureOf(model, material.occlusionMap);
  to.normalScale = float(material.normalScale);
  to.bumpScale = float(material.bumpScale);
  to.occlusionStrength = float(material.occlusionStrength);
  return to;
}

} // namespace dgtk
