// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkNamedAction.h"

#include "dgtkEditorIcons.h"

#include <QAction>
#include <QMenu>
#include <QToolBar>

namespace dgtk
{

QAction* addNamedAction(
  QWidget* owner, QMenu* menu, QToolBar* tools, const QString& name, const QString& text, const QKeySequence& keys)
{
  QAction* const action = menu->addAction(text);
  action->setObjectName(name);
  action->setParent(owner);
  action->setShortcut(keys);
  const QIcon icon = editorIcon(name);
  if (!icon.isNull())
  {
    action->setIcon(icon);
    if (tools != nullptr)
    {
      tools->addAction(action);
    }
  }
  return action;
}

} // namespace dgtk
