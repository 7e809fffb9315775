// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneFile_h
#define dgtkSceneFile_h

#include "dgtkSceneModule.h"

#include "dgtkSceneDescription.h"

#include <set>
#include <string>
#include <vector>

namespace dgtk
{

/// What scenes that are rendered together have to know of one another.
struct SceneOutline
{
  /// By its extension and, of .json, by its keys: two of a version, cameras, and objects, lights, an environment or a
  /// background. Files of classes, records of samples and documents of datasets are none.
  bool isScene = false;
  std::vector<ClassDescription> classes; ///< whose numbers it fixes, itself or by a file
  std::set<std::string> classNames;      ///< of its objects; "": some have none
};

/// Throws InputError for a file that cannot be read, for what is no JSON, and for classes that cannot be used.
DGTKSCENE_EXPORT SceneOutline outlineOf(const std::string& path);

/// Reads a file of classes, as scenes name them in "classes". Throws InputError.
DGTKSCENE_EXPORT std::vector<ClassDescription> readClassFile(const std::string& path);
/// What such a file says, in one line.
DGTKSCENE_EXPORT std::string classesText(const std::vector<ClassDescription>& classes);

} // namespace dgtk

#endif
