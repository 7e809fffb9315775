// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkEditorLanguage_h
#define dgtkEditorLanguage_h

#include "dgtkWidgetsModule.h"

#include <QString>
#include <QStringList>

#include <string>

namespace dgtk
{

/// Languages of the window, as ISO 639 words: "en", the sources' own, and those with a translation.
DGTKWIDGETS_EXPORT QStringList editorLanguages();

/// Has the application show a language, or that of the system where `language` is "" (English when there is no
/// translation). To be called once, after the QApplication and before the window is made. False for another language.
DGTKWIDGETS_EXPORT bool setEditorLanguage(const QString& language);

/// What an edit of a document is called in the language of the window.
QString editText(const std::string& text);

} // namespace dgtk

#endif
