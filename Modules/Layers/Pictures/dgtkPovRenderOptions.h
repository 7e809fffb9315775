// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovRenderOptions_h
#define dgtkPovRenderOptions_h

// Private to Layers.

#include "dgtkOption.h"
#include "dgtkPovExport.h"

#include <optional>
#include <string>
#include <vector>

namespace dgtk
{

/// What POV-Ray shall show beyond the built-in renderer: of the layer `pov`, and of the colours when POV-Ray draws
/// them.
const std::vector<const OptionRow*>& povOptionRows();

/// Throws UsageError for what cannot be together. One point a pixel where `antialias` is not given.
PovOptions povOptionsOf(const OptionValues& values);
/// What POV-Ray does not show of a scene as it is at a frame, one line each.
std::vector<std::string> povLines(const SceneState& state, const View& view, const OptionValues& values);
/// Points a pixel and axis, if that is chosen.
std::optional<int> povAntialiasOf(const OptionValues& values);

} // namespace dgtk

#endif
