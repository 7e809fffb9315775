// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMaterialMaps_h
#define dgtkMaterialMaps_h

#include "dgtkModel.h"

#include <array>
#include <map>
#include <memory>

namespace dgtk
{

/// What a part's shader gets beyond VTK's Phong material; textures are OpenGL's names, 0 for none.
struct SurfaceParameters
{
  std::array<float, 2> metalRough{ 0, 1 };
  std::array<float, 3> f0{ 0, 0, 0 }; ///< reflectance at normal incidence of what is not metal, linear
  float normalScale = 1;
  float bumpScale = 1;
  float occlusionStrength = 1;
  unsigned int normalMap = 0;
  unsigned int bumpMap = 0;
  unsigned int metallicRoughnessMap = 0;
  unsigned int emissionMap = 0;
  unsigned int occlusionMap = 0;

  bool hasMaps() const
  {
    return this->normalMap || this->bumpMap || this->metallicRoughnessMap || this->emissionMap || this->occlusionMap;
  }
};

/// Pictures other than the base texture, in OpenGL's memory. The context must be current.
class MaterialMaps
{
public:
  ~MaterialMaps();
  /// Of a material of a model; maps of a model without texture coordinates count as absent.
  SurfaceParameters parameters(const Model& model, const Material& material);
  /// Those of pictures that are gone.
  void drop();

private:
  unsigned int textureOf(const Model& model, int index);
  std::map<std::weak_ptr<const Image>, unsigned int, std::owner_less<>> Textures;
};

} // namespace dgtk

#endif
