// SPDX-License-Identifier: BSD-3-Clause
// Widgets in a program of GoogleTest: without a window system, and with events that are given to them.
#ifndef dgtkTestWidgets_h
#define dgtkTestWidgets_h

#include <QApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>

namespace dgtk::test
{

/// The program's application, made by the first test that needs it.
inline void needApplication()
{
  if (QCoreApplication::instance() == nullptr)
  {
    qputenv("QT_QPA_PLATFORM", "offscreen");
    static int count = 1;
    static char name[] = "test";
    static char* arguments[] = { name, nullptr };
    static QApplication application(count, arguments);
  }
}

inline void sendMouse(QWidget& widget, QEvent::Type type, const QPoint& at, Qt::MouseButton button = Qt::LeftButton)
{
  QMouseEvent event(type, at, button, button, Qt::NoModifier);
  QApplication::sendEvent(&widget, &event);
}

inline void sendKey(QWidget& widget, int key, Qt::KeyboardModifiers modifiers = Qt::NoModifier)
{
  QKeyEvent event(QEvent::KeyPress, key, modifiers);
  QApplication::sendEvent(&widget, &event);
}

/// Whether a widget that has the focus keeps Ctrl+Z from the window.
inline bool takesUndo(QWidget& widget)
{
  QKeyEvent undo(QEvent::ShortcutOverride, Qt::Key_Z, Qt::ControlModifier);
  undo.ignore();
  QApplication::sendEvent(&widget, &undo);
  return undo.isAccepted();
}

inline void sendWheel(QWidget& widget, const QPointF& at, int steps)
{
  QWheelEvent event(at, at, QPoint(), QPoint(0, 120 * steps), Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
  QApplication::sendEvent(&widget, &event);
}

} // namespace dgtk::test

#endif
