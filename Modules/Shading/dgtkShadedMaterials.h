// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkShadedMaterials_h
#define dgtkShadedMaterials_h

// Private to Shading.

#include "dgtkTexturePyramid.h"

#include "dgtkSceneState.h"

#include <map>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace dgtk
{

/// A material as it is shaded. Pictures are null where there are none.
struct ShadedMaterial
{
  Float4 ambient;
  Float4 diffuse;
  Float4 specular;
  Float4 emission;
  Float4 f0; ///< reflectance at normal incidence of what is not metal, linear
  float shininess = 0;
  float opacity = 1;
  float metallic = 0;
  float roughness = 1;
  float normalScale = 1;
  float bumpScale = 1;
  float occlusionStrength = 1;
  bool shines = false;   ///< the specular colour is not black
  bool physical = false; ///< also without an environment
  bool mapped = false;   ///< there is some picture
  const TexturePyramid* texture = nullptr;
  const TexturePyramid* normalMap = nullptr;
  const TexturePyramid* bumpMap = nullptr;
  const TexturePyramid* metallicRoughnessMap = nullptr;
  const TexturePyramid* emissionMap = nullptr;
  const TexturePyramid* occlusionMap = nullptr;
};

/// The materials of a model in a scene.
struct ShadedMaterials
{
  std::shared_ptr<const Model> model;
  std::shared_ptr<const std::vector<Material>> materials;
  std::vector<ShadedMaterial> ofPart;
  std::vector<std::shared_ptr<const TexturePyramid>> textures; ///< those that `ofPart` has
  bool translucent = false;                                    ///< some
  bool translucentColors = false;                              ///< colours of vertices let see what is behind

  const ShadedMaterial& of(std::uint32_t triangle) const
  {
    return this->ofPart[this->ofPart.size() == 1 ? 0 : this->model->partOf(triangle)];
  }
};

/// Materials and pictures that are in use, each once. Thread-safe.
class ShadedMaterialLibrary
{
public:
  static ShadedMaterialLibrary& shared();
  std::shared_ptr<const ShadedMaterials> of(const Instance& instance);

private:
  using Key = std::pair<const void*, const void*>;
  struct KnownTexture
  {
    std::weak_ptr<const Image> image; ///< an address alone may come again
    std::weak_ptr<const TexturePyramid> pyramid;
  };
  std::shared_ptr<const TexturePyramid> textureOf(const Model& model, int index, bool cutOut);
  void dropUnused();
  ShadedMaterial make(const Model& model, const Material& material, ShadedMaterials& set);

  std::mutex Mutex;
  std::map<Key, std::weak_ptr<const ShadedMaterials>> Sets;
  std::size_t Kept = 8; ///< of them, when what is unused was dropped last
  std::map<std::pair<const Image*, PictureUse>, KnownTexture> Textures;
};

} // namespace dgtk

#endif
