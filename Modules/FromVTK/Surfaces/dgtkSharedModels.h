// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSharedModels_h
#define dgtkSharedModels_h

#include "dgtkModel.h"
#include "dgtkSurfaceKey.h"
#include "dgtkSurfaceModel.h"
#include "dgtkVisibility.h"

#include <functional>
#include <memory>
#include <vector>

namespace dgtk
{

/// A model that is in use and equal to this one, point for point, else this one: snapshots of a scene that did not
/// change share their models, and the trees that rays go through. By contents, since points may be written to without
/// telling VTK. Thread-safe.
std::shared_ptr<const Model> sharedModel(std::shared_ptr<const Model> model);

/// The surface with this key if it is in use, else what `make` makes; its model is a shared one. Thread-safe.
std::shared_ptr<const SurfaceModel> sharedSurface(const SurfaceKey& key, const std::function<SurfaceModel()>& make);

/// Builds the trees of a state, of which the result is the owner. Those of the latest call and its surfaces stay until
/// the next one, so that they are found by what is taken again. Throws MachineError.
std::shared_ptr<const OcclusionQuery> keptTrees(
  const std::shared_ptr<const SceneState>& state, std::vector<std::shared_ptr<const SurfaceModel>> surfaces);

} // namespace dgtk

#endif
