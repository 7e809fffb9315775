// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkEditorLanguage_h
#define dgtkEditorLanguage_h

#include "dgtkControlsModule.h"

#include <QString>
#include <QStringList>

#include <cstdint>
#include <string>

namespace dgtk
{

struct SceneDescription;

/// Languages of the window, as ISO 639 words: "en", the sources' own, and those with a translation.
DGTKCONTROLS_EXPORT QStringList editorLanguages();

/// Has the application show a language, or that of the system where `language` is "" (English when there is no
/// translation). To be called once, after the QApplication and before the window is made. False for another language.
DGTKCONTROLS_EXPORT bool setEditorLanguage(const QString& language);

/// What an edit of a document is called in the language of the window.
QString editText(const std::string& text);

/// What a part without Qt says in a sentence of its own ("the last frame has none after it"), in the language of the
/// window; as it is where that is not known, as what the command line says of files.
QString messageText(const std::string& text);

/// How many objects, lights and cameras a scene has.
QString contentsText(const SceneDescription& scene);

/// What a value of the layers "..._class" means, in the words of the dataset's format.
QString visibilityText(std::uint32_t value);

/// A layer's unit in the language of the window; a unit of the scene's own as it is.
QString unitText(const std::string& unit);

} // namespace dgtk

#endif
