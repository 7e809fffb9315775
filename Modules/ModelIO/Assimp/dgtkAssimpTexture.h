// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAssimpTexture_h
#define dgtkAssimpTexture_h

#include "dgtkAssimpStream.h"
#include "dgtkModelBuilder.h"

#include <map>
#include <string>

namespace dgtk
{

/// Makes the model's materials and textures of the importer's.
class AssimpMaterials
{
public:
  /// Takes the pictures out of the scene.
  AssimpMaterials(import::Scene& scene, ModelBuilder& builder)
    : Scene(scene)
    , Builder(builder)
  {
  }
  /// Gives the textures of materials that are going to be added their places.
  void nameTextures(const std::vector<std::int32_t>& indices);
  /// Index in the model of material `index` of the scene, which may be out of range.
  int add(std::int32_t index);

private:
  const import::Material* find(std::int32_t index) const;
  int textureOf(const import::Map& map);
  int embeddedTexture(const import::Map& map);

  import::Scene& Scene;
  ModelBuilder& Builder;
  std::map<std::int32_t, int> Known;
  std::map<std::pair<std::string, TextureWraps>, int> Named;
  std::map<std::size_t, int> Embedded; ///< the first picture of each
};

} // namespace dgtk

#endif
