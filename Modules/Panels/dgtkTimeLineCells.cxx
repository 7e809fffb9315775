// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTimeLineCells.h"

#include "dgtkTimeLineSizes.h"

#include <QScrollBar>

#include <algorithm>
#include <cmath>

namespace dgtk
{

using namespace timeline;

TimeLineCells::TimeLineCells(EditorState& state, QWidget* parent)
  : QAbstractScrollArea(parent)
  , State(state)
{
  this->setObjectName("timeLineCells");
  this->setFocusPolicy(Qt::StrongFocus);
  this->viewport()->setMouseTracking(true);
  this->horizontalScrollBar()->setSingleStep(cellWidth);
  this->verticalScrollBar()->setSingleStep(rowHeight);
  connect(&state, &EditorState::changed, this, &TimeLineCells::refresh);
  connect(&state, &EditorState::selectionChanged, this, &TimeLineCells::showRow);
  connect(&state, &EditorState::frameChanged, this, &TimeLineCells::showFrame);
  this->refresh();
}

QSize TimeLineCells::sizeHint() const { return { 600, headerHeight + 5 * rowHeight }; }

int TimeLineCells::frames() const
{
  int last = this->Keys.empty() ? 0 : this->Keys.back();
  for (const Row& row : this->Rows)
  {
    const double end = row.bar ? row.bar->start + (std::isinf(row.bar->length) ? 0 : row.bar->length) : 0;
    last = std::max(last, int(std::clamp(end, 0.0, double(largestFrame))));
  }
  return std::min(
    largestFrame, std::max({ fewestFrames, last + framesAfterLast, this->State.frame() + framesAfterLast }));
}

int TimeLineCells::leftOf(int frame) const
{
  return namesWidth + frame * cellWidth - this->horizontalScrollBar()->value();
}

int TimeLineCells::middleOf(double frame) const
{
  // Bars may begin and end far outside of the window.
  const double middle = namesWidth + (frame + 0.5) * cellWidth - this->horizontalScrollBar()->value();
  return int(std::clamp(middle, -1e6, 1e6));
}

int TimeLineCells::frameAt(int x) const
{
  return std::clamp((x - namesWidth + this->horizontalScrollBar()->value()) / cellWidth, 0, largestFrame);
}

int TimeLineCells::topOf(const Row& row) const { return headerHeight + row.top - this->verticalScrollBar()->value(); }

TimeLineCells::Row TimeLineCells::rowOf(const SceneItem& item) const
{
  const SceneDescription& scene = this->State.scene();
  Row row;
  row.item = item;
  row.name = toText(itemName(scene, item));
  row.keys = keyFramesOf(scene, item);
  for (const int key : row.keys)
  {
    row.kinds.push_back(keyInterpolationOf(scene, item, key)->kind);
  }
  if (item.kind == SceneItem::Kind::Object)
  {
    row.bar = sequenceBar(scene, scene.objects[item.index], this->State.document().models());
  }
  row.height = rowHeight + (row.bar ? barHeight : 0);
  return row;
}

void TimeLineCells::refresh()
{
  this->Rows.clear();
  int top = 0;
  for (const SceneItem& item : this->State.scene().items())
  {
    this->Rows.push_back(this->rowOf(item));
    this->Rows.back().top = top;
    top += this->Rows.back().height;
  }
  this->Keys = this->State.scene().keyFrames();
  this->Dragged.reset();
  this->setBars();
  this->viewport()->update();
}

void TimeLineCells::setBars()
{
  const QSize size = this->viewport()->size();
  this->horizontalScrollBar()->setPageStep(size.width() - namesWidth);
  this->horizontalScrollBar()->setRange(0, std::max(0, this->frames() * cellWidth - size.width() + namesWidth));
  this->verticalScrollBar()->setPageStep(size.height() - headerHeight);
  this->verticalScrollBar()->setRange(0, std::max(0, this->rowsHeight() - size.height() + headerHeight));
}

void TimeLineCells::resizeEvent(QResizeEvent* event)
{
  QAbstractScrollArea::resizeEvent(event);
  this->setBars();
}

void TimeLineCells::showFrame()
{
  this->setBars();
  const int left = this->leftOf(this->State.frame());
  QScrollBar* const bar = this->horizontalScrollBar();
  if (left < namesWidth)
  {
    bar->setValue(bar->value() + left - namesWidth);
  }
  else if (left + cellWidth > this->viewport()->width())
  {
    bar->setValue(bar->value() + left + cellWidth - this->viewport()->width());
  }
  this->viewport()->update();
}

void TimeLineCells::showRow()
{
  if (const Row* const row = this->selectedRow())
  {
    QScrollBar* const bar = this->verticalScrollBar();
    bar->setValue(std::min(row->top, std::max(bar->value(), row->top + row->height - bar->pageStep())));
  }
  this->viewport()->update();
}

const TimeLineCells::Row* TimeLineCells::selectedRow() const
{
  for (const Row& row : this->Rows)
  {
    if (this->State.isSelected(row.item))
    {
      return &row;
    }
  }
  return nullptr;
}

void TimeLineCells::goToKey(int direction)
{
  const Row* const row = this->selectedRow();
  const std::vector<int>& keys = row != nullptr && !row->keys.empty() ? row->keys : this->Keys;
  const int now = this->State.frame();
  const auto after = std::upper_bound(keys.begin(), keys.end(), now);
  const auto before = std::lower_bound(keys.begin(), keys.end(), now);
  if (direction > 0 && after != keys.end())
  {
    this->State.setFrame(*after);
  }
  else if (direction < 0 && before != keys.begin())
  {
    this->State.setFrame(*std::prev(before));
  }
}

void TimeLineCells::edit(const QString& text, const std::function<void(SceneDescription&)>& change)
{
  this->State.attempt([&] { this->State.document().edit(text.toStdString(), change); });
}

void TimeLineCells::makeKey()
{
  const int frame = this->State.frame();
  this->edit("Make key frame", [frame](SceneDescription& scene) { makeKeyFrame(scene, frame); });
}

void TimeLineCells::removeKey()
{
  const int frame = this->State.frame();
  this->edit("Remove key frame", [frame](SceneDescription& scene) { removeKeyFrame(scene, frame); });
}

void TimeLineCells::pasteKey(bool move)
{
  const int from = *this->Copied;
  const int to = this->State.frame();
  this->edit(move ? "Move key frame" : "Paste key frame",
    [&](SceneDescription& scene) { move ? moveKeyFrame(scene, from, to) : copyKeyFrame(scene, from, to); });
}

void TimeLineCells::changeBar(SceneItem item, const SequenceBar& bar, bool start)
{
  const ModelLibrary& models = this->State.document().models();
  this->State.attempt(
    [&]
    {
      this->State.document().editItem(start ? "Move sequence" : "Change speed of sequence", item,
        [&](SceneDescription& scene)
        {
          ObjectDescription& object = scene.objects[item.index];
          if (start)
          {
            object.animation.start = bar.start;
          }
          else
          {
            setSequenceLength(scene, object, models, bar.length);
          }
        });
    });
}

} // namespace dgtk
