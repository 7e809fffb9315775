// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTimeLineRows_h
#define dgtkTimeLineRows_h

#include "dgtkSceneEdits.h"
#include "dgtkSequenceBar.h"

#include <QPoint>
#include <QString>

#include <optional>
#include <vector>

namespace dgtk
{

class ModelLibrary;

namespace timeline
{

// Pixels of the time line.
constexpr int cellWidth = 12;
constexpr int rowHeight = 18;
constexpr int barHeight = 16; ///< more, for a row with a sequence
constexpr int headerHeight = 26;
constexpr int headerMarks = 11; ///< the header's lower part, with the marks of key frames
constexpr int namesWidth = 130;
constexpr int edgeWidth = 4; ///< of a bar, to both sides

constexpr int numberEvery = 5;
constexpr int fewestFrames = 60;
constexpr int framesAfterLast = 30;

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
enum class Target
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
  Target target = Target::Nothing;
  std::optional<std::size_t> row;
  int frame = 0;
};
struct Drag
{
  Hit from;
  int to = 0; ///< frame under the mouse
  bool copy = false;
};

/// What the time line shows, and where: pixels of the viewport, whose part of the cells begins at `scrolled`.
class TimeLineRows
{
public:
  std::vector<Row> rows;
  std::vector<int> keys; ///< of the whole scene
  QPoint scrolled;
  int width = 0; ///< of the viewport

  void fill(const SceneDescription& scene, const ModelLibrary& models);
  int frames(int now) const; ///< cells in a row; all that have something, and the current one
  int frameAt(int x) const;
  int leftOf(int frame) const;
  int middleOf(double frame) const; ///< of its cell
  int topOf(const Row& row) const { return headerHeight + row.top - this->scrolled.y(); }
  int height() const { return this->rows.empty() ? 0 : this->rows.back().top + this->rows.back().height; }
  Hit hitAt(const QPoint& at) const;
  /// The bar of a row as it will be when the drag ends here.
  SequenceBar draggedBar(std::size_t row, const std::optional<Drag>& drag) const;
};

} // namespace timeline
} // namespace dgtk

#endif
