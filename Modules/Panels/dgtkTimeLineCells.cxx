// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTimeLineCells.h"

#include "dgtkTimeLinePainter.h"

#include <QPainter>
#include <QScrollBar>

#include <algorithm>

namespace dgtk
{

using namespace timeline;

TimeLineCells::TimeLineCells(EditorState& state, QWidget* parent)
  : QAbstractScrollArea(parent)
  , State(state)
  , Edits(new TimeLineEdits(state, this))
{
  this->setObjectName("timeLineCells");
  this->setFocusPolicy(Qt::StrongFocus);
  this->viewport()->setMouseTracking(true);
  this->horizontalScrollBar()->setSingleStep(cellWidth);
  this->verticalScrollBar()->setSingleStep(rowHeight);
  const auto scrolled = [this] {
    this->Shown.scrolled = { this->horizontalScrollBar()->value(), this->verticalScrollBar()->value() };
  };
  connect(this->horizontalScrollBar(), &QScrollBar::valueChanged, this, scrolled);
  connect(this->verticalScrollBar(), &QScrollBar::valueChanged, this, scrolled);
  connect(&state, &EditorState::changed, this, &TimeLineCells::refresh);
  connect(&state, &EditorState::selectionChanged, this, &TimeLineCells::showRow);
  connect(&state, &EditorState::frameChanged, this, &TimeLineCells::showFrame);
  this->refresh();
}

QSize TimeLineCells::sizeHint() const { return { 600, headerHeight + 5 * rowHeight }; }

void TimeLineCells::refresh()
{
  this->Shown.fill(this->State.scene(), this->State.document().models());
  this->Dragged.reset();
  this->setBars();
  this->viewport()->update();
}

void TimeLineCells::setBars()
{
  const QSize size = this->viewport()->size();
  this->Shown.width = size.width();
  this->horizontalScrollBar()->setPageStep(size.width() - namesWidth);
  this->horizontalScrollBar()->setRange(
    0, std::max(0, this->Shown.frames(this->State.frame()) * cellWidth - size.width() + namesWidth));
  this->verticalScrollBar()->setPageStep(size.height() - headerHeight);
  this->verticalScrollBar()->setRange(0, std::max(0, this->Shown.height() - size.height() + headerHeight));
}

void TimeLineCells::resizeEvent(QResizeEvent* event)
{
  QAbstractScrollArea::resizeEvent(event);
  this->setBars();
}

void TimeLineCells::showFrame()
{
  this->setBars();
  const int left = this->Shown.leftOf(this->State.frame());
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

const Row* TimeLineCells::selectedRow() const
{
  for (const Row& row : this->Shown.rows)
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
  const std::vector<int>& keys = row != nullptr && !row->keys.empty() ? row->keys : this->Shown.keys;
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

void TimeLineCells::paintEvent(QPaintEvent*)
{
  QPainter painter(this->viewport());
  const QSize size = this->viewport()->size();
  painter.fillRect(this->viewport()->rect(), this->palette().window());
  if (this->Shown.rows.empty())
  {
    const int margin = namesWidth + 3 * cellWidth;
    painter.drawText(QRect(margin, headerHeight, size.width() - margin - cellWidth, size.height() - headerHeight),
      Qt::AlignVCenter | Qt::AlignLeft | Qt::TextWordWrap,
      tr("Objects, lights and cameras get rows here. Right-click a frame to make a key frame."));
  }
  const TimeLinePainter parts(painter, this->Shown, this->palette());
  for (std::size_t i = 0; i < this->Shown.rows.size(); ++i)
  {
    const Row& row = this->Shown.rows[i];
    const int top = this->Shown.topOf(row);
    if (top < size.height() && top + row.height > headerHeight)
    {
      const SequenceBar bar = row.bar ? this->Shown.draggedBar(i, this->Dragged) : SequenceBar();
      parts.paintRow(row, row.bar ? &bar : nullptr, this->State.isSelected(row.item));
    }
  }
  parts.paintHeader();
  parts.paintFrame(this->State.frame(), size.height());
  if (this->Dragged && this->Dragged->to != this->Dragged->from.frame &&
      (this->Dragged->from.target == Target::Key || this->Dragged->from.target == Target::SceneKey))
  {
    const QString text = this->Dragged->copy ? tr("copy %1 to %2") : tr("%1 to %2");
    parts.paintDrag(*this->Dragged, text.arg(this->Dragged->from.frame).arg(this->Dragged->to));
  }
}

} // namespace dgtk
