// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTimeLineCells.h"
#include "dgtkTimeLineSizes.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QScrollBar>
#include <QToolTip>

#include <algorithm>
#include <cmath>

namespace dgtk
{

using namespace timeline;

TimeLineCells::Hit TimeLineCells::hitAt(const QPoint& at) const
{
  Hit hit;
  hit.frame = this->frameAt(at.x());
  const bool names = at.x() < namesWidth;
  if (at.y() < headerHeight)
  {
    const bool marks = at.y() >= headerHeight - headerMarks;
    const bool key = marks && std::binary_search(this->Keys.begin(), this->Keys.end(), hit.frame);
    hit.part = names ? Part::Nothing : key ? Part::SceneKey : Part::Frames;
    return hit;
  }
  for (std::size_t i = 0; i < this->Rows.size(); ++i)
  {
    const Row& row = this->Rows[i];
    const int y = at.y() - this->topOf(row);
    if (y < 0 || y >= row.height)
    {
      continue;
    }
    hit.row = i;
    hit.part = names ? Part::Names : Part::Frames;
    if (!names && y < rowHeight && std::binary_search(row.keys.begin(), row.keys.end(), hit.frame))
    {
      hit.part = Part::Key;
    }
    if (!names && y >= rowHeight && row.bar)
    {
      const int left = this->middleOf(row.bar->start);
      const int right = std::isinf(row.bar->length) ? this->viewport()->width() + 2 * edgeWidth
                                                    : this->middleOf(row.bar->start + row.bar->length);
      const bool end = std::abs(at.x() - right) <= edgeWidth;
      hit.part = end ? Part::BarEnd : at.x() >= left && at.x() < right ? Part::Bar : Part::Frames;
    }
    break;
  }
  return hit;
}

void TimeLineCells::showCursor(const Hit& hit, bool copy)
{
  switch (hit.part)
  {
    case Part::Key:
    case Part::SceneKey:
      this->viewport()->setCursor(copy ? Qt::DragCopyCursor : Qt::PointingHandCursor);
      break;
    case Part::Bar:
      this->viewport()->setCursor(Qt::SizeAllCursor);
      break;
    case Part::BarEnd:
      this->viewport()->setCursor(Qt::SizeHorCursor);
      break;
    default:
      this->viewport()->unsetCursor();
  }
}

void TimeLineCells::mousePressEvent(QMouseEvent* event)
{
  const Hit hit = this->hitAt(event->pos());
  const bool bar = hit.part == Part::Bar || hit.part == Part::BarEnd;
  if (event->pos().x() >= namesWidth && !bar)
  {
    this->State.setFrame(hit.frame);
  }
  if (hit.row)
  {
    const SceneItem item = this->Rows[*hit.row].item;
    if (hit.part == Part::Names && event->modifiers() & Qt::ControlModifier)
    {
      this->State.toggle(item);
    }
    else if (event->button() == Qt::LeftButton || !this->State.isSelected(item))
    {
      this->State.select({ item });
    }
  }
  if (event->button() == Qt::LeftButton && hit.part != Part::Nothing && hit.part != Part::Names)
  {
    // The view may have scrolled to the frame; the mouse is where it was.
    this->Dragged = Drag{ hit, hit.frame, false };
  }
}

void TimeLineCells::mouseMoveEvent(QMouseEvent* event)
{
  const bool copy = (event->modifiers() & Qt::ControlModifier) != 0;
  if (!this->Dragged || !(event->buttons() & Qt::LeftButton))
  {
    this->showCursor(this->hitAt(event->pos()), copy);
    return;
  }
  Drag& drag = *this->Dragged;
  // Beyond the edges the cells come along.
  const int x = event->pos().x();
  QScrollBar* const bar = this->horizontalScrollBar();
  bar->setValue(bar->value() + (x >= this->viewport()->width() ? cellWidth : x < namesWidth ? -cellWidth : 0));
  drag.to = this->frameAt(x);
  drag.copy = copy;
  if (drag.from.part == Part::Frames)
  {
    this->State.setFrame(drag.to);
  }
  this->showCursor(drag.from, copy);
  this->viewport()->update();
}

void TimeLineCells::mouseReleaseEvent(QMouseEvent* event)
{
  if (event->button() == Qt::LeftButton && this->Dragged)
  {
    this->Dragged->to = this->frameAt(event->pos().x());
    this->Dragged->copy = (event->modifiers() & Qt::ControlModifier) != 0;
    this->finishDrag();
  }
}

void TimeLineCells::finishDrag()
{
  const Drag drag = *this->Dragged;
  this->Dragged.reset();
  this->viewport()->update();
  if (drag.to == drag.from.frame)
  {
    return;
  }
  switch (drag.from.part)
  {
    case Part::Key:
    case Part::SceneKey:
      this->dragKeys(drag);
      break;
    case Part::Bar:
    case Part::BarEnd:
    {
      this->Dragged = drag;
      const SequenceBar bar = this->draggedBar(*drag.from.row);
      this->Dragged.reset();
      this->changeBar(this->Rows[*drag.from.row].item, bar, drag.from.part == Part::Bar);
      break;
    }
    default:
      break;
  }
}

void TimeLineCells::dragKeys(const Drag& drag)
{
  const int from = drag.from.frame;
  const int to = drag.to;
  const bool copy = drag.copy;
  if (drag.from.part == Part::SceneKey)
  {
    this->edit(copy ? "Copy key frame" : "Move key frame",
      [&](SceneDescription& scene) { copy ? copyKeyFrame(scene, from, to) : moveKeyFrame(scene, from, to); });
  }
  else
  {
    const SceneItem item = this->Rows[*drag.from.row].item;
    this->edit(copy ? "Copy keys" : "Move keys", [&](SceneDescription& scene)
      { copy ? copyItemKeys(scene, item, from, to) : moveItemKeys(scene, item, from, to); });
  }
  this->State.setFrame(to);
}

SequenceBar TimeLineCells::draggedBar(std::size_t index) const
{
  SequenceBar bar = *this->Rows[index].bar;
  if (this->Dragged && this->Dragged->from.row == index)
  {
    const int by = this->Dragged->to - this->Dragged->from.frame;
    if (this->Dragged->from.part == Part::Bar)
    {
      bar.start = std::round(bar.start) + by;
    }
    else if (this->Dragged->from.part == Part::BarEnd && by != 0)
    {
      bar.length = std::max(1.0, std::round(bar.start + bar.length) + by - bar.start);
    }
  }
  return bar;
}

bool TimeLineCells::viewportEvent(QEvent* event)
{
  if (event->type() == QEvent::ToolTip)
  {
    const auto& help = *static_cast<QHelpEvent*>(event);
    QString text;
    switch (this->hitAt(help.pos()).part)
    {
      case Part::Key:
        text = tr("Drag: move the key. Ctrl: copy it. Right click: interpolation.");
        break;
      case Part::SceneKey:
        text = tr("Drag: move this key frame of the whole scene. Ctrl: copy it.");
        break;
      case Part::Bar:
        text = tr("Drag: move the start of the sequence.");
        break;
      case Part::BarEnd:
        text = tr("Drag: change the speed of the sequence.");
        break;
      default:
        break;
    }
    text.isEmpty() ? QToolTip::hideText() : QToolTip::showText(help.globalPos(), text, this);
    return true;
  }
  return QAbstractScrollArea::viewportEvent(event);
}

} // namespace dgtk
