// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovExport_h
#define dgtkPovExport_h

#include "dgtkExportModule.h"

#include "dgtkSceneState.h"

#include <string>
#include <vector>

namespace dgtk
{

struct PovOptions
{
  /// Every object in one colour without light: R, G, B are its id as a 24-bit number, R high, as in the layer objects.
  bool flatIds = false;
  /// Objects cast shadows. Off, as in the built-in renderer.
  bool shadows = false;
};

/// What was written.
struct PovResult
{
  std::vector<std::string> files;    ///< textures in the order of their first use, then the scene
  std::vector<std::string> warnings; ///< what POV-Ray will show otherwise than the built-in renderer, one line each
};

/// Writes a state of a scene, seen by a camera, for POV-Ray 3.7 (Documentation/Formats/pov.md). Coordinates are the
/// world's. Each mesh is declared once, however many instances have it. Textures that POV-Ray would read otherwise are
/// written beside the scene as <stem>_<number>.ppm, those with missing texels with a mask .pgm. All files appear when
/// they are whole, the scene last. Throws UsageError for a camera that is not linear, InputError for a name that does
/// not end in .pov and for more objects than 24 bits count, MachineError for what cannot be written.
DGTKEXPORT_EXPORT PovResult exportPov(
  const SceneState& state, const View& view, const std::string& path, const PovOptions& options = {});

/// Writes a model in its own axes, at its first frame, with a camera before it that shows it whole and that tells
/// readers that the axes are right-handed. Throws as above.
DGTKEXPORT_EXPORT PovResult exportPov(const std::shared_ptr<const Model>& model, const std::string& path);

} // namespace dgtk

#endif
