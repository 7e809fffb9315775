// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkThesisScene_h
#define dgtkThesisScene_h

#include "dgtkSceneDescription.h"

#include <string>

namespace dgtk::scenefile
{

/// Reads the contents of a .scene file (thesis, appendix B); names are given, relations are checked.
SceneDescription readThesisScene(const std::string& file, const std::string& folder, const std::string& contents);

/// The tag of a model's line by its extension, or "" when .scene has none.
std::string thesisTag(const std::string& model);

} // namespace dgtk::scenefile

#endif
