// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTimeLineCells_h
#define dgtkTimeLineCells_h

#include "dgtkEditorState.h"
#include "dgtkPanelsModule.h"
#include "dgtkSequenceBar.h"

#include <QAbstractScrollArea>

#include <optional>
#include <vector>

class QMenu;

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
  void makeKey();
  void removeKey();
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
  struct Row
  {
    SceneItem item;
    QString name;
    std::vector<int> keys;
    std::vector<Interpolation> kinds; ///< of each key
    std::optional<SequenceBar> bar;
    int top = 0; ///< from the first row's
    int height = 0;
  };
  enum class Part
  {
    Nothing,
    Names,
    Frames,
    Key,
    SceneKey,
    Bar,
    BarEnd
  };
  struct Hit
  {
    Part part = Part::Nothing;
    std::optional<std::size_t> row;
    int frame = 0;
  };
  struct Drag
  {
    Hit from;
    int to = 0; ///< frame under the mouse
    bool copy = false;
  };

  void refresh();
  Row rowOf(const SceneItem& item) const;
  void setBars();
  void showFrame();
  /// Of the item selected.
  void showRow();
  int frames() const; ///< cells in a row
  int frameAt(int x) const;
  int leftOf(int frame) const;
  int middleOf(double frame) const; ///< of its cell
  int topOf(const Row& row) const;
  int rowsHeight() const { return this->Rows.empty() ? 0 : this->Rows.back().top + this->Rows.back().height; }
  SequenceBar draggedBar(std::size_t row) const;
  const Row* selectedRow() const;

  Hit hitAt(const QPoint& at) const;
  void showCursor(const Hit& hit, bool copy);
  void finishDrag();
  void dragKeys(const Drag& drag);
  void changeBar(SceneItem item, const SequenceBar& bar, bool start);

  void edit(const QString& text, const std::function<void(SceneDescription&)>& change);
  void pasteKey(bool move);
  void shiftKeys(int direction, bool scene, bool copy);
  void shiftBar(int direction, bool start);
  void selectRow(int direction);
  bool barKey(const QKeyEvent& event);
  bool stepKey(const QKeyEvent& event);
  void addKeyActions(QMenu& menu, const Row& row);
  void addInterpolations(QMenu& menu, const Row& row);
  void addSequences(QMenu& menu, const Row& row);

  void paintHeader(QPainter& painter) const;
  void paintRow(QPainter& painter, const Row& row, std::size_t index) const;
  void paintKeys(QPainter& painter, const Row& row, const QColor& color) const;
  void paintBar(QPainter& painter, const Row& row, const SequenceBar& bar) const;
  void paintDrag(QPainter& painter) const;

  EditorState& State;
  std::vector<Row> Rows;
  std::vector<int> Keys; ///< of the whole scene
  std::optional<int> Copied;
  std::optional<Drag> Dragged;
};

} // namespace dgtk

#endif
