// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAssimpTexture_h
#define dgtkAssimpTexture_h

#include "dgtkAssimpStream.h"
#include "dgtkModelBuilder.h"

#include <map>
#include <string>
#include <tuple>

namespace dgtk
{

/// Makes the model's materials and textures of the importer's.
class AssimpMaterials
{
public:
  AssimpMaterials(const import::Scene& scene, ModelBuilder& builder)
    : Scene(scene)
    , Builder(builder)
  {
  }
  /// Looks for the textures of materials that are going to be added, and decodes them together.
  void prepare(const std::vector<std::int32_t>& indices);
  /// Index in the model of material `index` of the scene, which may be out of range.
  int add(std::int32_t index);

private:
  const import::Material* find(std::int32_t index) const;
  int textureOf(const std::string& name);
  int fileTexture(const std::string& name);
  int embeddedTexture(const std::string& name);
  void settleAlpha(const import::Material& from, Material& to);

  const import::Scene& Scene;
  ModelBuilder& Builder;
  std::map<std::int32_t, int> Known;
  std::map<std::string, int> Named;
  std::map<std::tuple<int, double, double>, int> Remade; ///< (texture, cut-off, opacity)
};

} // namespace dgtk

#endif
