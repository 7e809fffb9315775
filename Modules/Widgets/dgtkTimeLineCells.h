// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTimeLineCells_h
#define dgtkTimeLineCells_h

// Private to Widgets.

#include "dgtkEditorState.h"

#include <QAbstractScrollArea>

#include <optional>
#include <vector>

class QMenu;

namespace dgtk
{

/// Frames as cells, a row for each item, a dot for each key frame. A click or drag chooses the frame; the context menu
/// makes and removes key frames; Left, Right, Home and End step.
class TimeLineCells : public QAbstractScrollArea
{
  Q_OBJECT

public:
  TimeLineCells(EditorState& state, QWidget* parent);

  QSize sizeHint() const override;
  void makeKey();
  void removeKey();

protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

private:
  struct Row
  {
    SceneItem item;
    QString name;
    std::vector<int> keys;
  };
  void refresh();
  void setBars();
  void showFrame();
  void pasteKey(bool move);
  void addInterpolations(QMenu& menu);
  void paintHeader(QPainter& painter) const;
  void paintRow(QPainter& painter, int top, const Row& row) const;
  int frames() const; ///< cells in a row
  int frameAt(int x) const;
  int leftOf(int frame) const;

  EditorState& State;
  std::vector<Row> Rows;
  std::vector<int> Keys; ///< of the whole scene
  std::optional<int> Copied;
};

} // namespace dgtk

#endif
