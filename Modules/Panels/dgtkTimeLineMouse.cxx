// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTimeLineCells.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QScrollBar>
#include <QToolTip>

namespace dgtk
{

using namespace timeline;

void TimeLineCells::showCursor(const Hit& hit, bool copy)
{
  switch (hit.target)
  {
    case Target::Key:
    case Target::SceneKey:
      this->viewport()->setCursor(copy ? Qt::DragCopyCursor : Qt::PointingHandCursor);
      break;
    case Target::Bar:
      this->viewport()->setCursor(Qt::SizeAllCursor);
      break;
    case Target::BarEnd:
      this->viewport()->setCursor(Qt::SizeHorCursor);
      break;
    default:
      this->viewport()->unsetCursor();
  }
}

void TimeLineCells::mousePressEvent(QMouseEvent* event)
{
  const Hit hit = this->Shown.hitAt(event->pos());
  const bool bar = hit.target == Target::Bar || hit.target == Target::BarEnd;
  if (event->pos().x() >= namesWidth && !bar)
  {
    this->State.setFrame(hit.frame);
  }
  if (hit.row)
  {
    const SceneItem item = this->Shown.rows[*hit.row].item;
    if (hit.target == Target::Names && event->modifiers() & Qt::ControlModifier)
    {
      this->State.toggle(item);
    }
    else if (event->button() == Qt::LeftButton || !this->State.isSelected(item))
    {
      this->State.select({ item });
    }
  }
  if (event->button() == Qt::LeftButton && hit.target != Target::Nothing && hit.target != Target::Names)
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
    this->showCursor(this->Shown.hitAt(event->pos()), copy);
    return;
  }
  Drag& drag = *this->Dragged;
  // Beyond the edges the cells come along.
  const int x = event->pos().x();
  QScrollBar* const bar = this->horizontalScrollBar();
  bar->setValue(bar->value() + (x >= this->viewport()->width() ? cellWidth : x < namesWidth ? -cellWidth : 0));
  drag.to = this->Shown.frameAt(x);
  drag.copy = copy;
  if (drag.from.target == Target::Frames)
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
    this->Dragged->to = this->Shown.frameAt(event->pos().x());
    this->Dragged->copy = (event->modifiers() & Qt::ControlModifier) != 0;
    this->finishDrag();
  }
}

void TimeLineCells::finishDrag()
{
  const Drag drag = *this->Dragged;
  const Target target = drag.from.target;
  this->viewport()->update();
  if (drag.to == drag.from.frame || target == Target::Frames)
  {
    this->Dragged.reset();
    return;
  }
  const SceneItem item = drag.from.row ? this->Shown.rows[*drag.from.row].item : SceneItem();
  if (target == Target::Bar || target == Target::BarEnd)
  {
    const SequenceBar bar = this->Shown.draggedBar(*drag.from.row, drag);
    this->Dragged.reset();
    this->Edits->changeBar(item, bar, target == Target::Bar);
    return;
  }
  this->Dragged.reset();
  this->Edits->dragKeys(drag, item);
}

bool TimeLineCells::viewportEvent(QEvent* event)
{
  if (event->type() == QEvent::ToolTip)
  {
    const auto& help = *static_cast<QHelpEvent*>(event);
    QString text;
    switch (this->Shown.hitAt(help.pos()).target)
    {
      case Target::Key:
        text = tr("Drag: move the key. Ctrl: copy it. Right click: interpolation.");
        break;
      case Target::SceneKey:
        text = tr("Drag: move this key frame of the whole scene. Ctrl: copy it.");
        break;
      case Target::Bar:
        text = tr("Drag: move the start of the sequence.");
        break;
      case Target::BarEnd:
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
