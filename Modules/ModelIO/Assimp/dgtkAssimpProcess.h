// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAssimpProcess_h
#define dgtkAssimpProcess_h

#include "dgtkAssimpStream.h"
#include "dgtkModelContents.h"

#include <string>

namespace dgtk
{

/// What the importer found, and in which files.
struct ImportedScene : import::Scene
{
  std::vector<std::string> files; ///< read beside the model, spelled as it is
  std::vector<ModelDependency> dependencies;
};

/// Reads a model in a copy of the process dgtk-import ($DGTK_IMPORT can name it), with limits of memory (512 MiB and 10
/// bytes a byte read) and of processor time (60 s). That process opens nothing: it is handed the model, and the files
/// that the model names, as far as they lie in the model's folder or below it. Throws InputError with the importer's
/// complaint, also when the importer crashed or ran into a limit, or when the model names a file elsewhere.
ImportedScene importModel(const std::string& path, const std::string& format);

} // namespace dgtk

#endif
