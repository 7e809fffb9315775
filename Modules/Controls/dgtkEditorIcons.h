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

/// The editor's icons, drawn in one style at every size: new, open, save, import, exit, undo, redo, cut, copy, paste,
/// duplicate, delete, move, rotate, scale, camera, light, render, frameAll, frameSelected, wireframe, shaded, textured,
/// grid. Null for another name.
DGTKCONTROLS_EXPORT QIcon editorIcon(const QString& name);

/// Draws on a square of 24 x 24, with the pen that is set.
using IconDrawing = std::function<void(QPainter&)>;
/// Those of the dataset viewer, by the names of its actions.
DGTKCONTROLS_EXPORT std::map<QString, IconDrawing> viewerIcons();

} // namespace dgtk

#endif
