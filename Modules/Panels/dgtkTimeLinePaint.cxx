// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTimeLineCells.h"
#include "dgtkTimeLineSizes.h"

#include <QPainter>
#include <QPainterPath>
#include <QScrollBar>

#include <algorithm>
#include <cmath>

namespace dgtk
{

using namespace timeline;

namespace
{
constexpr double markRadius = 4;
const QColor sceneKeyColor(214, 140, 20);
const QColor barColor(86, 150, 130);
const QColor frameColor(220, 50, 50);

void paintMark(QPainter& painter, const QPointF& at, Interpolation kind)
{
  const double r = markRadius;
  switch (kind)
  {
    case Interpolation::Step:
      painter.drawRect(QRectF(at.x() - r + 0.5, at.y() - r + 0.5, 2 * r - 1, 2 * r - 1));
      break;
    case Interpolation::Smooth:
      painter.drawPolygon(QPolygonF(
        { at + QPointF(0, -r - 1), at + QPointF(r + 1, 0), at + QPointF(0, r + 1), at + QPointF(-r - 1, 0) }));
      break;
    default:
      painter.drawEllipse(at, r, r);
  }
}
} // namespace

void TimeLineCells::paintHeader(QPainter& painter) const
{
  const int width = this->viewport()->width();
  painter.fillRect(0, 0, width, headerHeight, this->palette().button());
  painter.setClipRect(namesWidth, 0, width - namesWidth, headerHeight);
  painter.setPen(this->palette().color(QPalette::ButtonText));
  const int first = this->frameAt(namesWidth) / numberEvery * numberEvery;
  for (int frame = first; this->leftOf(frame) < width; frame += numberEvery)
  {
    const int left = this->leftOf(frame);
    painter.drawText(QRect(left + 2, 0, numberEvery * cellWidth, headerHeight - headerMarks),
      Qt::AlignLeft | Qt::AlignVCenter, QString::number(frame));
    painter.drawLine(left, headerHeight - headerMarks, left, headerHeight);
  }
  painter.setRenderHint(QPainter::Antialiasing, true);
  painter.setPen(Qt::NoPen);
  painter.setBrush(sceneKeyColor);
  for (const int key : this->Keys)
  {
    paintMark(
      painter, QPointF(this->leftOf(key) + cellWidth / 2.0, headerHeight - headerMarks / 2.0), Interpolation::Smooth);
  }
  painter.setRenderHint(QPainter::Antialiasing, false);
  painter.setClipping(false);
}

void TimeLineCells::paintKeys(QPainter& painter, const Row& row, const QColor& color) const
{
  const int top = this->topOf(row);
  for (std::size_t i = 0; i + 1 < row.keys.size(); ++i)
  {
    // A line where the value moves, none where it holds.
    if (row.kinds[i] != Interpolation::Step)
    {
      painter.fillRect(QRect(QPoint(this->middleOf(row.keys[i]), top + rowHeight / 2 - 1),
                         QPoint(this->middleOf(row.keys[i + 1]), top + rowHeight / 2)),
        this->State.isSelected(row.item) ? color : this->palette().color(QPalette::Dark));
    }
  }
  painter.setRenderHint(QPainter::Antialiasing, true);
  painter.setPen(Qt::NoPen);
  painter.setBrush(color);
  for (std::size_t i = 0; i < row.keys.size(); ++i)
  {
    paintMark(painter, QPointF(this->leftOf(row.keys[i]) + cellWidth / 2.0, top + rowHeight / 2.0), row.kinds[i]);
  }
  painter.setRenderHint(QPainter::Antialiasing, false);
}

void TimeLineCells::paintBar(QPainter& painter, const Row& row, const SequenceBar& bar) const
{
  const int width = this->viewport()->width();
  const int top = this->topOf(row) + rowHeight - 1;
  const int left = this->middleOf(bar.start);
  const int right = std::isinf(bar.length) ? width : this->middleOf(bar.start + bar.length);
  const QRect body(left, top, std::max(2, right - left), barHeight - 2);
  if (bar.loop && !std::isinf(bar.length))
  {
    painter.fillRect(QRect(right, top + 4, std::max(0, width - right), barHeight - 10), barColor.lighter(150));
    const double turns = std::ceil((this->frameAt(namesWidth) - bar.start) / bar.length); // before what is in sight
    for (double turn = std::max(2.0, turns); bar.length * cellWidth > 3; ++turn)
    {
      const int again = this->middleOf(bar.start + turn * bar.length);
      if (again > width)
      {
        break;
      }
      painter.fillRect(again, top + 2, 1, barHeight - 6, barColor.darker(120));
    }
  }
  painter.setPen(barColor.darker(150));
  painter.setBrush(barColor);
  painter.drawRect(body.adjusted(0, 0, -1, -1));
  if (!std::isinf(bar.length))
  {
    painter.fillRect(right - 3, top + 2, 2, barHeight - 6, QColor(255, 255, 255, 200)); // the handle of its speed
  }
  const QRect text = body.intersected(QRect(namesWidth, top, width - namesWidth, barHeight)).adjusted(5, 0, -6, 0);
  painter.setPen(Qt::white);
  painter.drawText(text, Qt::AlignLeft | Qt::AlignVCenter,
    painter.fontMetrics().elidedText(toText(bar.name), Qt::ElideRight, std::max(0, text.width())));
}

void TimeLineCells::paintRow(QPainter& painter, const Row& row, std::size_t index) const
{
  const int width = this->viewport()->width();
  const int top = this->topOf(row);
  const bool selected = this->State.isSelected(row.item);
  const QPalette& palette = this->palette();
  const QColor text = palette.color(selected ? QPalette::HighlightedText : QPalette::Text);
  painter.fillRect(0, top, width, row.height, selected ? palette.highlight() : palette.base());
  painter.setPen(text);
  painter.drawText(QRect(6, top, namesWidth - 8, rowHeight), Qt::AlignLeft | Qt::AlignVCenter,
    painter.fontMetrics().elidedText(row.name, Qt::ElideRight, namesWidth - 10));

  painter.setClipRect(namesWidth, top, width - namesWidth, row.height);
  painter.setPen(palette.color(QPalette::Midlight));
  for (int frame = this->frameAt(namesWidth); this->leftOf(frame) < width; ++frame)
  {
    painter.drawLine(this->leftOf(frame), top, this->leftOf(frame), top + rowHeight - 2);
  }
  if (row.bar)
  {
    this->paintBar(painter, row, this->draggedBar(index));
  }
  this->paintKeys(painter, row, text);
  painter.setClipping(false);
  painter.setPen(palette.color(QPalette::Mid));
  painter.drawLine(0, top + row.height - 1, width, top + row.height - 1);
}

void TimeLineCells::paintDrag(QPainter& painter) const
{
  if (!this->Dragged || this->Dragged->to == this->Dragged->from.frame ||
      (this->Dragged->from.part != Part::Key && this->Dragged->from.part != Part::SceneKey))
  {
    return;
  }
  const Drag& drag = *this->Dragged;
  const bool scene = drag.from.part == Part::SceneKey;
  const double y = scene ? headerHeight - headerMarks / 2.0 : this->topOf(this->Rows[*drag.from.row]) + rowHeight / 2.0;
  const QPointF at(this->leftOf(drag.to) + cellWidth / 2.0, y);
  painter.setRenderHint(QPainter::Antialiasing, true);
  painter.setPen(QPen(Qt::white, 1.5));
  painter.setBrush(scene ? sceneKeyColor : frameColor);
  paintMark(painter, at, Interpolation::Linear);
  painter.setRenderHint(QPainter::Antialiasing, false);
  const QString text = drag.copy ? tr("copy %1 to %2").arg(drag.from.frame).arg(drag.to)
                                 : tr("%1 to %2").arg(drag.from.frame).arg(drag.to);
  QRect box(0, 0, painter.fontMetrics().horizontalAdvance(text) + 10, rowHeight);
  box.moveTo(int(at.x()) + 10, int(y) - rowHeight / 2);
  if (box.right() >= this->viewport()->width())
  {
    box.moveRight(int(at.x()) - 10);
  }
  painter.fillRect(box, this->palette().toolTipBase());
  painter.setPen(this->palette().color(QPalette::ToolTipText));
  painter.drawText(box, Qt::AlignCenter, text);
}

void TimeLineCells::paintEvent(QPaintEvent*)
{
  QPainter painter(this->viewport());
  painter.setRenderHint(QPainter::Antialiasing, false);
  const QSize size = this->viewport()->size();
  painter.fillRect(this->viewport()->rect(), this->palette().window());
  if (this->Rows.empty())
  {
    const int margin = namesWidth + 3 * cellWidth;
    painter.drawText(QRect(margin, headerHeight, size.width() - margin - cellWidth, size.height() - headerHeight),
      Qt::AlignVCenter | Qt::AlignLeft | Qt::TextWordWrap,
      tr("Objects, lights and cameras get rows here. Right-click a frame to make a key frame."));
  }
  for (std::size_t i = 0; i < this->Rows.size(); ++i)
  {
    const int top = this->topOf(this->Rows[i]);
    if (top < size.height() && top + this->Rows[i].height > headerHeight)
    {
      this->paintRow(painter, this->Rows[i], i);
    }
  }
  this->paintHeader(painter);
  painter.setPen(this->palette().color(QPalette::Mid));
  painter.drawLine(namesWidth - 1, 0, namesWidth - 1, size.height());
  const int left = this->leftOf(this->State.frame());
  if (left >= namesWidth)
  {
    painter.fillRect(left, 0, cellWidth, size.height(), QColor(220, 50, 50, 60));
    painter.fillRect(left + cellWidth / 2, 0, 1, size.height(), frameColor);
  }
  this->paintDrag(painter);
}

} // namespace dgtk
