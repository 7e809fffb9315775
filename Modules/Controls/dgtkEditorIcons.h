// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkEditorIcons_h
#define dgtkEditorIcons_h

#include "dgtkControlsModule.h"

#include <QIcon>
#include <QString>

#include <functional>
#include <map>

class QPainter;

namespace dgtk
{

/// Draws on a square of 24 x 24, with the pen that is set.
using IconDrawing = std::function<void(QPainter&)>;
/// All icons, drawn in one style, by the names of actions; the dataset viewer's among them.
DGTKCONTROLS_EXPORT const std::map<QString, IconDrawing>& editorIcons();
/// One of them at every size. Null for another name.
DGTKCONTROLS_EXPORT QIcon editorIcon(const QString& name);

/// Those of the dataset viewer, by the names of its actions.
DGTKCONTROLS_EXPORT std::map<QString, IconDrawing> viewerIcons();

} // namespace dgtk

#endif
