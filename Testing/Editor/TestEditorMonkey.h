// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditorMonkey_h
#define TestEditorMonkey_h

#include "EditorTest.h"

#include <QSize>

#include <random>

class QFileDialog;
class QWidget;

/// 600 random events (1,500 with DGTK_TEST_WHOLE), or DGTK_MONKEY_EVENTS; DGTK_MONKEY_SEED chooses others. The same
/// seed gives the same ones.
class TestEditorMonkey : public EditorTest
{
  Q_OBJECT

protected:
  QSize windowSize(const QString& /*testCase*/) const override { return { 900, 640 }; }

private slots:
  void randomEventsDoNoHarm();

private:
  int below(int end) { return int(this->Random() % unsigned(end > 1 ? end : 1)); }
  /// To what is in front: a dialog, a menu, or the window with its panels and tool windows.
  void touch();
  void touchDialog();
  void touchFileDialog(QFileDialog& dialog);
  void writeFiles() const;
  void watchDialogs();
  void touchWidget(QWidget* widget);
  void drag(QWidget* widget);
  void press(QWidget* widget);
  void trigger();
  void openAgain();
  void tidyUp();

  std::mt19937 Random;
  QSize Size; ///< of the window, at first
};

#endif
