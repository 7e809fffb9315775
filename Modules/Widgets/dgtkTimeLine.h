// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTimeLine_h
#define dgtkTimeLine_h

// Private to Widgets.

#include "dgtkEditorState.h"

#include <QWidget>

class QSpinBox;
class QTimer;
class QToolButton;

namespace dgtk
{

class TimeLineCells;

/// The cells with their controls: play, loop, frame, key frames.
class TimeLine : public QWidget
{
  Q_OBJECT

public:
  TimeLine(EditorState& state, QWidget* parent);

private:
  void play(bool on);
  void step();
  void refresh();

  EditorState& State;
  TimeLineCells* Cells = nullptr;
  QTimer* Clock = nullptr;
  QToolButton* Play = nullptr;
  QToolButton* Loop = nullptr;
  QSpinBox* Frame = nullptr;
};

} // namespace dgtk

#endif
