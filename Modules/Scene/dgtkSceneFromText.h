// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneFromText_h
#define dgtkSceneFromText_h

#include "dgtkSceneDescription.h"

#include <string>

namespace dgtk
{

/// readScene() of the text of a .json scene that is in no file; relative paths start in `folder`. Errors name the path
/// of the value, "scene: objects[2].position ...", and a line only of what is no JSON.
DGTKSCENE_EXPORT SceneDescription readSceneText(const std::string& json, const std::string& folder);

} // namespace dgtk

#endif
