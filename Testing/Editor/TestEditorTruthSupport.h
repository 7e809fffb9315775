// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditorTruthSupport_h
#define TestEditorTruthSupport_h

#include "TestEditorSupport.h"

#include <QApplication>
#include <QLabel>
#include <QTest>
#include <QTreeWidget>

#include <cmath>

/// Where an image point of a pane is in its widget.
inline QPoint widgetPoint(QWidget* pane, const QPointF& image)
{
  QPointF point;
  QMetaObject::invokeMethod(pane, "toWidget", Q_RETURN_ARG(QPointF, point), Q_ARG(QPointF, image));
  return { int(std::floor(point.x())), int(std::floor(point.y())) };
}

inline QString textOf(QWidget* dialog, const char* label) { return dialog->findChild<QLabel*>(label)->text(); }

/// The row of the values' panel that begins so.
inline QString valueOf(QTreeWidget* panel, const QString& name)
{
  for (int i = 0; i < panel->topLevelItemCount(); ++i)
  {
    if (panel->topLevelItem(i)->text(0).startsWith(name))
    {
      return panel->topLevelItem(i)->text(1);
    }
  }
  return {};
}

#endif
