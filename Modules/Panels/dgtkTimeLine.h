// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTimeLine_h
#define dgtkTimeLine_h

#include "dgtkEditorState.h"
#include "dgtkPanelsModule.h"

#include <QElapsedTimer>
#include <QIcon>
#include <QWidget>

#include <vector>

class QBoxLayout;
class QDoubleSpinBox;
class QHBoxLayout;
class QPushButton;
class QSpinBox;
class QTimer;
class QToolButton;

namespace dgtk
{

class TimeLineCells;

/// The cells with their controls: play, loop, frame, frame rate, key frames. Playing keeps the scene's frame rate; what
/// the views are too slow for is left out.
class DGTKPANELS_EXPORT TimeLine : public QWidget
{
  Q_OBJECT

public:
  TimeLine(EditorState& state, QWidget* parent);

protected:
  void resizeEvent(QResizeEvent* event) override;

private:
  /// Has its text where the row has room for it, and an icon otherwise.
  struct KeyButton
  {
    QPushButton* button;
    QIcon icon;
    QString text;
    int width; ///< with its text
  };
  QPushButton* addKeyButton(const char* name, const char* icon, const QString& text);
  QToolButton* addButton(QBoxLayout* layout, const char* name, int icon, const QString& tip);
  void addFrameFields(QBoxLayout* layout);
  void play(bool on);
  void step();
  void refresh();
  void refreshRate();

  EditorState& State;
  TimeLineCells* Cells = nullptr;
  QTimer* Clock = nullptr;
  QHBoxLayout* Controls = nullptr;
  std::vector<KeyButton> KeyButtons;
  QElapsedTimer Playing;
  int PlayedFrom = 0;
  bool Stepping = false;
  QToolButton* Play = nullptr;
  QToolButton* Loop = nullptr;
  QSpinBox* Frame = nullptr;
  QDoubleSpinBox* Rate = nullptr;
};

} // namespace dgtk

#endif
