// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFolderScenes_h
#define dgtkFolderScenes_h

// Private to Pipeline.

#include "dgtkSceneDescription.h"

#include <string>
#include <utility>
#include <vector>

namespace dgtk
{

/// The scenes of a folder, by the names of their datasets.
struct FolderScenes
{
  std::vector<std::pair<std::string, std::string>> scenes; ///< name, path; in the order of names
  std::vector<std::string> leftOut;                        ///< names of files that are none
  /// With the numbers that they have in all scenes which fix none; empty: no object has a class, or all scenes fix
  /// them.
  std::vector<ClassDescription> classes;
};

/// Looks at all files of a folder. Throws InputError where there is no scene, for a file that cannot be read, and where
/// scenes fix other numbers of classes; UsageError where two scenes would become one dataset.
FolderScenes scenesIn(const std::string& folder);

} // namespace dgtk

#endif
