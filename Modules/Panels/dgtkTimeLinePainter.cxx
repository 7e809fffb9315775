// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTimeLinePainter.h"

#include <QPainter>
#include <QPainterPath>
#include <QPalette>

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

TimeLinePainter::TimeLinePainter(QPainter& painter, const TimeLineRows& shown, const QPalette& palette)
  : Painter(painter)
  , Shown(shown)
  , Palette(palette)
{
}

void TimeLinePainter::paintHeader() const
{
  const int width = this->Shown.width;
  this->Painter.fillRect(0, 0, width, headerHeight, this->Palette.button());
  this->Painter.setClipRect(namesWidth, 0, width - namesWidth, headerHeight);
  this->Painter.setPen(this->Palette.color(QPalette::ButtonText));
  const int first = this->Shown.frameAt(namesWidth) / numberEvery * numberEvery;
  for (int frame = first; this->Shown.leftOf(frame) < width; frame += numberEvery)
  {
    const int left = this->Shown.leftOf(frame);
    this->Painter.drawText(QRect(left + 2, 0, numberEvery * cellWidth, headerHeight - headerMarks),
      Qt::AlignLeft | Qt::AlignVCenter, QString::number(frame));
    this->Painter.drawLine(left, headerHeight - headerMarks, left, headerHeight);
  }
  this->Painter.setRenderHint(QPainter::Antialiasing, true);
  this->Painter.setPen(Qt::NoPen);
  this->Painter.setBrush(sceneKeyColor);
  for (const int key : this->Shown.keys)
  {
    paintMark(this->Painter, QPointF(this->Shown.leftOf(key) + cellWidth / 2.0, headerHeight - headerMarks / 2.0),
      Interpolation::Smooth);
  }
  this->Painter.setRenderHint(QPainter::Antialiasing, false);
  this->Painter.setClipping(false);
}

void TimeLinePainter::paintKeys(const Row& row, const QColor& color, bool selected) const
{
  const int top = this->Shown.topOf(row);
  for (std::size_t i = 0; i + 1 < row.keys.size(); ++i)
  {
    // A line where the value moves, none where it holds.
    if (row.kinds[i] != Interpolation::Step)
    {
      this->Painter.fillRect(QRect(QPoint(this->Shown.middleOf(row.keys[i]), top + rowHeight / 2 - 1),
                               QPoint(this->Shown.middleOf(row.keys[i + 1]), top + rowHeight / 2)),
        selected ? color : this->Palette.color(QPalette::Dark));
    }
  }
  this->Painter.setRenderHint(QPainter::Antialiasing, true);
  this->Painter.setPen(Qt::NoPen);
  this->Painter.setBrush(color);
  for (std::size_t i = 0; i < row.keys.size(); ++i)
  {
    paintMark(
      this->Painter, QPointF(this->Shown.leftOf(row.keys[i]) + cellWidth / 2.0, top + rowHeight / 2.0), row.kinds[i]);
  }
  this->Painter.setRenderHint(QPainter::Antialiasing, false);
}

void TimeLinePainter::paintBar(const Row& row, const SequenceBar& bar) const
{
  const int width = this->Shown.width;
  const int top = this->Shown.topOf(row) + rowHeight - 1;
  const int left = this->Shown.middleOf(bar.start);
  const int right = std::isinf(bar.length) ? width : this->Shown.middleOf(bar.start + bar.length);
  const QRect body(left, top, std::max(2, right - left), barHeight - 2);
  if (bar.loop && !std::isinf(bar.length))
  {
    this->Painter.fillRect(QRect(right, top + 4, std::max(0, width - right), barHeight - 10), barColor.lighter(150));
    const double turns =
      std::ceil((this->Shown.frameAt(namesWidth) - 1 - bar.start) / bar.length); // a cell before what is in sight
    for (double turn = std::max(2.0, turns); bar.length * cellWidth > 3; ++turn)
    {
      const int again = this->Shown.middleOf(bar.start + turn * bar.length);
      if (again > width)
      {
        break;
      }
      this->Painter.fillRect(again, top + 2, 1, barHeight - 6, barColor.darker(120));
    }
  }
  this->Painter.setPen(barColor.darker(150));
  this->Painter.setBrush(barColor);
  this->Painter.drawRect(body.adjusted(0, 0, -1, -1));
  if (!std::isinf(bar.length))
  {
    this->Painter.fillRect(right - 3, top + 2, 2, barHeight - 6, QColor(255, 255, 255, 200)); // the handle of its speed
  }
  const QRect text = body.intersected(QRect(namesWidth, top, width - namesWidth, barHeight)).adjusted(5, 0, -6, 0);
  this->Painter.setPen(Qt::white);
  this->Painter.drawText(text, Qt::AlignLeft | Qt::AlignVCenter,
    this->Painter.fontMetrics().elidedText(
      QString::fromStdString(bar.name), Qt::ElideRight, std::max(0, text.width())));
}

void TimeLinePainter::paintRow(const Row& row, const SequenceBar* bar, bool selected) const
{
  const int width = this->Shown.width;
  const int top = this->Shown.topOf(row);
  const QColor text = this->Palette.color(selected ? QPalette::HighlightedText : QPalette::Text);
  this->Painter.fillRect(0, top, width, row.height, selected ? this->Palette.highlight() : this->Palette.base());
  this->Painter.setPen(text);
  this->Painter.drawText(QRect(6, top, namesWidth - 8, rowHeight), Qt::AlignLeft | Qt::AlignVCenter,
    this->Painter.fontMetrics().elidedText(row.name, Qt::ElideRight, namesWidth - 10));

  this->Painter.setClipRect(namesWidth, top, width - namesWidth, row.height);
  this->Painter.setPen(this->Palette.color(QPalette::Midlight));
  for (int frame = this->Shown.frameAt(namesWidth); this->Shown.leftOf(frame) < width; ++frame)
  {
    this->Painter.drawLine(this->Shown.leftOf(frame), top, this->Shown.leftOf(frame), top + rowHeight - 2);
  }
  if (bar != nullptr)
  {
    this->paintBar(row, *bar);
  }
  this->paintKeys(row, text, selected);
  this->Painter.setClipping(false);
  this->Painter.setPen(this->Palette.color(QPalette::Mid));
  this->Painter.drawLine(0, top + row.height - 1, width, top + row.height - 1);
}

void TimeLinePainter::paintFrame(int frame, int height) const
{
  this->Painter.setPen(this->Palette.color(QPalette::Mid));
  this->Painter.drawLine(namesWidth - 1, 0, namesWidth - 1, height);
  const int left = this->Shown.leftOf(frame);
  if (left >= namesWidth)
  {
    this->Painter.fillRect(left, 0, cellWidth, height, QColor(220, 50, 50, 60));
    this->Painter.fillRect(left + cellWidth / 2, 0, 1, height, frameColor);
  }
}

void TimeLinePainter::paintDrag(const Drag& drag, const QString& text) const
{
  const bool scene = drag.from.target == Target::SceneKey;
  const double y =
    scene ? headerHeight - headerMarks / 2.0 : this->Shown.topOf(this->Shown.rows[*drag.from.row]) + rowHeight / 2.0;
  const QPointF at(this->Shown.leftOf(drag.to) + cellWidth / 2.0, y);
  this->Painter.setRenderHint(QPainter::Antialiasing, true);
  this->Painter.setPen(QPen(Qt::white, 1.5));
  this->Painter.setBrush(scene ? sceneKeyColor : frameColor);
  paintMark(this->Painter, at, Interpolation::Linear);
  this->Painter.setRenderHint(QPainter::Antialiasing, false);
  QRect box(0, 0, this->Painter.fontMetrics().horizontalAdvance(text) + 10, rowHeight);
  box.moveTo(int(at.x()) + 10, int(y) - rowHeight / 2);
  if (box.right() >= this->Shown.width)
  {
    box.moveRight(int(at.x()) - 10);
  }
  this->Painter.fillRect(box, this->Palette.toolTipBase());
  this->Painter.setPen(this->Palette.color(QPalette::ToolTipText));
  this->Painter.drawText(box, Qt::AlignCenter, text);
}

} // namespace dgtk
