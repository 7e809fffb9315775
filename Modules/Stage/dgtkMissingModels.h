// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMissingModels_h
#define dgtkMissingModels_h

#include "dgtkStageModule.h"

#include "dgtkSceneDescription.h"

#include <cstddef>
#include <string>
#include <vector>

namespace dgtk
{

/// A model file that is not there.
struct MissingModel
{
  std::string model;                ///< as the scene writes it first
  std::string path;                 ///< where it was looked for
  std::vector<std::size_t> objects; ///< those that name it: indices into the scene's objects, ascending, at least one
};

/// The model files of a scene that do not exist, in the order of their first use, each once, however its path is
/// spelled. No file is opened; one that is there may still be refused when it is read.
DGTKSTAGE_EXPORT std::vector<MissingModel> missingModels(const SceneDescription& scene);

/// Throws InputError, one line that names all of them, unless there are none.
DGTKSTAGE_EXPORT void requireModels(const SceneDescription& scene);

} // namespace dgtk

#endif
