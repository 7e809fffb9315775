// SPDX-License-Identifier: BSD-3-Clause
#ifndef TestEditorTimeLine_h
#define TestEditorTimeLine_h

#include "EditorTest.h"

class QPoint;
class QString;

class TestEditorTimeLine : public EditorTest
{
  Q_OBJECT

protected:
  /// The time line needs room for its frames.
  QSize windowSize(const QString& /*testCase*/) const override { return { 1280, 720 }; }

private slots:
  void keysOfARowAreDragged();
  void keysOfTheSceneAreDragged();
  void escapeLeavesAKeyWhereItIs();
  void aKeyHasAnInterpolation();
  void thesisScenesCannotSayIt();
  void barsMoveAndStretch();
  void barsFarAwayAreDrawnAndReached();
  void sequencesAreChosen();
  void everythingByKeys();
  void playsAtItsRate();
  void pictures();

private:
  QWidget* cells() const;
  /// The middle of a frame's cell in a row; -1: the marks of the header.
  static QPoint at(int frame, int row, bool bar = false);
  void drag(const QPoint& from, const QPoint& to, Qt::KeyboardModifiers modifiers = {}, bool release = true) const;
  void key(Qt::Key key, Qt::KeyboardModifiers modifiers = {}) const;
  /// Opens the context menu and triggers an entry by its text, in the submenu of that object name unless it is empty.
  void choose(const QPoint& where, const char* submenu, const QString& text) const;
  mutable QString Checked; ///< of the menu that choose() saw last, each with a point
  /// A crate and a tree with key frames at 0 and 10, 10 units apart.
  void openTwo();
};

#endif
