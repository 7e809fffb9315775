// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditorTruthSupport_h
#define TestEditorTruthSupport_h

#include "TestEditorSupport.h"

#include <QApplication>
#include <QLabel>
#include <QMouseEvent>
#include <QTest>

#include <cmath>

constexpr int longest = 30000; // milliseconds, of a picture on a busy machine

/// Where an image point of a pane is in its widget.
inline QPoint widgetPoint(QWidget* pane, const QPointF& image)
{
  QPointF point;
  QMetaObject::invokeMethod(pane, "toWidget", Q_RETURN_ARG(QPointF, point), Q_ARG(QPointF, image));
  return { int(std::floor(point.x())), int(std::floor(point.y())) };
}

/// The mouse without a button.
inline void hover(QWidget* widget, const QPoint& at)
{
  QMouseEvent move(QEvent::MouseMove, at, widget->mapToGlobal(at), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
  QApplication::sendEvent(widget, &move);
}

inline QString textOf(QWidget* dialog, const char* label) { return dialog->findChild<QLabel*>(label)->text(); }

#endif
