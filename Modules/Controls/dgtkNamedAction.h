// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkNamedAction_h
#define dgtkNamedAction_h

#include "dgtkControlsModule.h"

#include <QKeySequence>
#include <QString>

class QAction;
class QMenu;
class QToolBar;
class QWidget;

namespace dgtk
{

/// An action of `owner`, last in the menu, called `name`; the icon of that name stands before it and, where there is
/// one, in the tool bar (null: in none).
DGTKCONTROLS_EXPORT QAction* addNamedAction(
  QWidget* owner, QMenu* menu, QToolBar* tools, const QString& name, const QString& text, const QKeySequence& keys);

/// A name as part of a menu's text, where "&" would underline the letter after it.
inline QString menuText(QString name) { return name.replace('&', "&&"); }

} // namespace dgtk

#endif
