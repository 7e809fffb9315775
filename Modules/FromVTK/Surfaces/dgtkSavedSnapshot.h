// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSavedSnapshot_h
#define dgtkSavedSnapshot_h

#include "dgtkFrozenView.h"

#include <string>
#include <vector>

namespace dgtk
{

/// Writes a view as a scene with its models (OBJ) and textures (PNG) in the folder `models` beside it. Throws
/// InputError for what they cannot say, and MachineError. Returns what they have otherwise, a line each.
std::vector<std::string> saveSnapshot(const FrozenView& view, const std::string& path);

} // namespace dgtk

#endif
