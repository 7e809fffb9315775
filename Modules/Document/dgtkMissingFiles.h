// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMissingFiles_h
#define dgtkMissingFiles_h

#include "dgtkDocumentModule.h"

#include "dgtkModelLibrary.h"

#include <cstddef>
#include <map>
#include <string>
#include <vector>

namespace dgtk
{

/// The models that these objects name, as written, each once.
DGTKDOCUMENT_EXPORT std::vector<std::string> modelsOf(
  const SceneDescription& scene, const std::vector<std::size_t>& objects);

/// Files below a folder with the names of the models: model as written -> file. Of several that one whose path ends
/// most like the model's, then the first by name. Folders that cannot be read are left out, links are not followed.
/// What `progress` stops has found less; it is called with the number of files looked at.
DGTKDOCUMENT_EXPORT std::map<std::string, std::string> findModels(
  const std::vector<std::string>& models, const std::string& folder, const LoadProgress& progress = {});

/// Gives objects the files that were found, relative to the scene's folder.
DGTKDOCUMENT_EXPORT void replaceModels(SceneDescription& scene, const std::map<std::string, std::string>& found);

} // namespace dgtk

#endif
