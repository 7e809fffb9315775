// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSharedModels_h
#define dgtkSharedModels_h

// Private to FromVTK.

#include "dgtkModel.h"
#include "dgtkVisibility.h"

#include <memory>

namespace dgtk
{

/// A model that is in use and equal to this one, point for point, else this one: snapshots of a scene that did not
/// change share their models, and the trees that rays go through. By contents, since points may be written to without
/// telling VTK. Thread-safe.
std::shared_ptr<const Model> sharedModel(std::shared_ptr<const Model> model);

/// Builds the trees of a state, of which the result is the owner; those of the latest call stay until the next one, so
/// that they are found by what is taken again. Throws MachineError.
std::shared_ptr<const OcclusionQuery> keptTrees(const std::shared_ptr<const SceneState>& state);

} // namespace dgtk

#endif
