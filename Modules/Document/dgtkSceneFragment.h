// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneFragment_h
#define dgtkSceneFragment_h

#include "dgtkDocumentModule.h"

#include "dgtkSceneDescription.h"

#include <optional>
#include <string>

namespace dgtk
{

// Items of a scene on their way to another one, also to that of another program.

/// The items as the .json of a scene that has nothing else, with paths as seen from `folder`. Parents that are not
/// among them are left out.
DGTKDOCUMENT_EXPORT std::string fragmentText(const SceneDescription& part, const std::string& folder);
/// The items of such a text, or of any scene's .json, with paths as seen from `folder`; nothing where the text is no
/// scene, or has no items.
DGTKDOCUMENT_EXPORT std::optional<SceneDescription> readFragment(const std::string& text, const std::string& folder);

/// fragmentText() with the folder that its paths are seen from.
DGTKDOCUMENT_EXPORT std::string packFragment(const SceneDescription& part);
/// Nothing for bytes that packFragment() has not made.
DGTKDOCUMENT_EXPORT std::optional<SceneDescription> unpackFragment(const std::string& bytes);

} // namespace dgtk

#endif
