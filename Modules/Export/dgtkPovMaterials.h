// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovMaterials_h
#define dgtkPovMaterials_h

// Private to Export.

#include "dgtkPovExport.h"
#include "dgtkPovImages.h"

#include <string>

namespace dgtk
{

/// What decides how surfaces look.
struct PovSurfaceOptions : PovOptions
{
  /// All lights are at the camera: the built-in renderer then takes the cosine to the normal for the highlight, in
  /// place of that to the reflected ray.
  bool headLit = false;
};

PovSurfaceOptions povSurfaceOptions(const SceneState& state, const PovOptions& options);

/// Whether texels of the material are missing.
bool povCutOut(const Model& model, const Material& material);

/// `texture { ... }` of a material: the built-in renderer's ambient, diffuse and Phong terms.
std::string povMaterial(
  const Model& model, const Material& material, const PovSurfaceOptions& options, PovImages& images);

/// `texture { ... }` that shines in the colour of an id, with the material's missing texels.
std::string povFlatMaterial(const Model& model, const Material& material, std::uint32_t id, PovImages& images);
/// The same for all surfaces without missing texels.
std::string povFlatTexture(std::uint32_t id);

/// `texture { ... }` that shines in the colour of the place, world frame.
std::string povPositionTexture(const PovBox& box);

} // namespace dgtk

#endif
