// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTimeLineCells_h
#define dgtkTimeLineCells_h

#include "dgtkEditorState.h"
#include "dgtkPanelsModule.h"
#include "dgtkTimeLineEdits.h"

#include <QAbstractScrollArea>

#include <optional>
#include <vector>

namespace dgtk
{

/// Frames as cells, a row for each item, a mark for each key frame (disc: linear, square: step, diamond: smooth), below
/// it a bar for the sequence of a model. The header chooses the frame; its marks, those of rows and bars are dragged.
class DGTKPANELS_EXPORT TimeLineCells : public QAbstractScrollArea
{
  Q_OBJECT

public:
  TimeLineCells(EditorState& state, QWidget* parent);

  QSize sizeHint() const override;
  void makeKey() { this->Edits->makeKey(); }
  void removeKey() { this->Edits->removeKey(); }
  /// To the key frame before (-1) or after (1) the current one: the selected item's, or the scene's.
  void goToKey(int direction);

signals:
  void playAsked();

protected:
  bool viewportEvent(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

private:
  void refresh();
  void setBars();
  void showFrame();
  /// Of the item selected.
  void showRow();
  const timeline::Row* selectedRow() const;

  void showCursor(const timeline::Hit& hit, bool copy);
  void finishDrag();

  void shiftKeys(int direction, bool scene, bool copy);
  void shiftBar(int direction, bool start);
  void selectRow(int direction);
  bool barKey(const QKeyEvent& event);
  bool stepKey(const QKeyEvent& event);

  EditorState& State;
  TimeLineEdits* Edits;
  timeline::TimeLineRows Shown;
  std::optional<int> Copied;
  std::optional<timeline::Drag> Dragged;
};

} // namespace dgtk

#endif
