// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovMaterials_h
#define dgtkPovMaterials_h

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
  bool cast = false;  ///< objects cast shadows
  bool asSeen = true; ///< meshes may be shaded for one view: see povTurned()
};

PovSurfaceOptions povSurfaceOptions(const SceneState& state, const PovOptions& options);

/// Whether texels of the material are missing.
bool povCutOut(const Model& model, const Material& material);

/// A material of a mesh.
struct PovSurface
{
  const Model& model;
  const Material& material;
  double texel = 1; ///< mean size of a texel of its bump map, scene units
};

/// The surface of an instance with one of its materials.
PovSurface povSurfaceOf(const Instance& instance, std::size_t material);
/// Scene units in a unit of the model, of an instance whose materials depend on it; else 1.
double povUnitOf(const Instance& instance);

/// `texture { ... }` of a surface: the built-in renderer's ambient, diffuse and Phong terms, and its bumps.
std::string povMaterial(const PovSurface& surface, const PovSurfaceOptions& options, PovImages& images);

/// `texture { ... }` that shines in the colour of an id, with the material's missing texels.
std::string povFlatMaterial(const Model& model, const Material& material, std::uint32_t id, PovImages& images);
/// The same for all surfaces without missing texels.
std::string povFlatTexture(std::uint32_t id);

/// `texture { ... }` that shines in the colour of the place, world frame.
std::string povPositionTexture(const PovBox& box);

} // namespace dgtk

#endif
