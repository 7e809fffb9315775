// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMatchPane.h"

#include "dgtkEditorLanguage.h"
#include "dgtkTruthPicture.h"

#include <QApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr double zoomPerStep = 0.25; // natural logarithm
constexpr double largestZoom = 200;
constexpr double gridZoom = 14; // pixels are seen as squares
constexpr double markSize = 9;
constexpr double fine = 0.1; // of a pixel
const QColor paneBackdrop(28, 28, 31);
} // namespace

MatchPane::MatchPane(QWidget* parent)
  : QWidget(parent)
{
  this->setMinimumSize(200, 150);
  this->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  this->setFocusPolicy(Qt::StrongFocus);
  this->setMouseTracking(true);
  this->setCursor(Qt::CrossCursor);
}

void MatchPane::setImageSize(const QSize& size)
{
  const bool other = size != this->Size;
  this->Size = size;
  if (other)
  {
    this->Step = 0;
    this->Image = {};
    this->showAll();
  }
}

void MatchPane::setPicture(const LivePicture& picture)
{
  this->Image = imageOf(picture.picture);
  this->Step = picture.step;
  this->setMessage(messageText(picture.message));
}

void MatchPane::setMessage(const QString& message)
{
  this->Message = message;
  this->update();
}

void MatchPane::setMarks(const std::vector<Mark>& marks)
{
  this->Marks = marks;
  this->update();
}

void MatchPane::setLine(const std::optional<Eigen::Vector3d>& line, const QColor& color)
{
  this->Line = line;
  this->LineColor = color;
  this->update();
}

void MatchPane::showAll()
{
  const QRectF place = TruthPicture::fitted(this->Size, this->size());
  this->Zoom = place.width() / this->Size.width();
  this->Origin = place.topLeft();
  this->Whole = true;
  this->update();
}

void MatchPane::ensureVisible(const QPointF& point)
{
  if (!this->Whole && !this->rect().contains(this->toWidget(point).toPoint()) && this->isInside(point))
  {
    this->Origin += QRectF(this->rect()).center() - this->toWidget(point);
    this->update();
  }
}

bool MatchPane::isInside(const QPointF& point) const
{
  return point.x() >= 0 && point.y() >= 0 && point.x() <= this->Size.width() && point.y() <= this->Size.height();
}

void MatchPane::zoomAt(const QPointF& widget, double factor)
{
  const QPointF fixed = this->toImage(widget);
  const double whole = TruthPicture::fitted(this->Size, this->size()).width() / this->Size.width();
  this->Zoom = std::clamp(this->Zoom * factor, whole / 2, std::max(largestZoom, whole));
  this->Origin = widget - fixed * this->Zoom;
  this->Whole = false;
  this->update();
}

void MatchPane::paintMark(QPainter& painter, const Mark& mark) const
{
  const QPointF at = this->toWidget(mark.at);
  const double size = mark.strong ? markSize : markSize / 2;
  painter.setBrush(Qt::NoBrush);
  for (const bool shadow : { true, false })
  {
    painter.setPen(QPen(shadow ? QColor(0, 0, 0, 180) : mark.color, (mark.strong ? 1.5 : 1.2) + (shadow ? 2 : 0)));
    painter.drawLine(at - QPointF(size, 0), at - QPointF(size / 3, 0));
    painter.drawLine(at + QPointF(size / 3, 0), at + QPointF(size, 0));
    painter.drawLine(at - QPointF(0, size), at - QPointF(0, size / 3));
    painter.drawLine(at + QPointF(0, size / 3), at + QPointF(0, size));
    if (mark.strong)
    {
      painter.drawEllipse(at, size, size);
    }
  }
  if (!mark.label.isEmpty())
  {
    const QPointF corner = at + QPointF(size + 3, -3);
    painter.setPen(QColor(0, 0, 0, 200));
    painter.drawText(corner + QPointF(1, 1), mark.label);
    painter.setPen(mark.color);
    painter.drawText(corner, mark.label);
  }
}

void MatchPane::paintImage(QPainter& painter) const
{
  const QRectF place(this->Origin, QSizeF(this->Size) * this->Zoom);
  if (!this->Image.isNull())
  {
    painter.setRenderHint(QPainter::SmoothPixmapTransform, this->Zoom * this->Step < 1);
    painter.setClipRect(place);
    painter.drawImage(QRectF(this->Origin, QSizeF(this->Image.size()) * (this->Zoom * this->Step)), this->Image);
    painter.setClipping(false);
  }
  painter.setPen(QColor(90, 90, 96));
  painter.drawRect(place);
}

void MatchPane::paintGrid(QPainter& painter) const
{
  const QRectF seen(this->toImage({ 0, 0 }), this->toImage({ double(this->width()), double(this->height()) }));
  const int left = std::max(0, int(std::floor(seen.left())));
  const int right = std::min(this->Size.width(), int(std::ceil(seen.right())));
  const int top = std::max(0, int(std::floor(seen.top())));
  const int bottom = std::min(this->Size.height(), int(std::ceil(seen.bottom())));
  painter.setPen(QColor(255, 255, 255, 40));
  for (int x = left; x <= right; ++x)
  {
    painter.drawLine(this->toWidget(QPointF(x, top)), this->toWidget(QPointF(x, bottom)));
  }
  for (int y = top; y <= bottom; ++y)
  {
    painter.drawLine(this->toWidget(QPointF(left, y)), this->toWidget(QPointF(right, y)));
  }
}

void MatchPane::paintLine(QPainter& painter) const
{
  const std::optional<LinePart> part =
    this->Line ? clippedLine(*this->Line, this->Size.width(), this->Size.height()) : std::nullopt;
  if (part)
  {
    const QLineF line(
      this->toWidget({ part->begin.x(), part->begin.y() }), this->toWidget({ part->end.x(), part->end.y() }));
    painter.setPen(QPen(QColor(0, 0, 0, 150), 3));
    painter.drawLine(line);
    painter.setPen(QPen(this->LineColor, 1.2));
    painter.drawLine(line);
  }
}

void MatchPane::paintWords(QPainter& painter) const
{
  const QRect area = this->rect().adjusted(20, 20, -20, -20);
  const bool hint = this->Message.isEmpty() && this->Marks.empty();
  const int where = (hint ? Qt::AlignHCenter | Qt::AlignBottom : Qt::AlignCenter) | Qt::TextWordWrap;
  const QString words =
    hint ? tr("Click a point. Wheel: zoom, drag: pan, double click: all of it, arrows: move the point.")
         : this->Message;
  if (words.isEmpty())
  {
    return;
  }
  const QRect box = painter.fontMetrics().boundingRect(area, where, words).adjusted(-6, -3, 6, 3);
  painter.fillRect(box, QColor(0, 0, 0, 150));
  painter.setPen(Qt::white);
  painter.drawText(area, where, words);
}

void MatchPane::paintEvent(QPaintEvent* /*event*/)
{
  QPainter painter(this);
  painter.fillRect(this->rect(), paneBackdrop);
  this->paintImage(painter);
  if (this->Zoom >= gridZoom)
  {
    this->paintGrid(painter);
  }
  painter.setRenderHint(QPainter::Antialiasing);
  this->paintLine(painter);
  for (const Mark& mark : this->Marks)
  {
    this->paintMark(painter, mark);
  }
  this->paintWords(painter);
  if (this->hasFocus())
  {
    painter.setRenderHint(QPainter::Antialiasing, false);
    painter.setPen(this->palette().highlight().color());
    painter.drawRect(this->rect().adjusted(0, 0, -1, -1));
  }
}

void MatchPane::resizeEvent(QResizeEvent*)
{
  if (this->Whole)
  {
    this->showAll();
  }
}

void MatchPane::mousePressEvent(QMouseEvent* event)
{
  this->Pressed = this->LastPosition = event->pos();
  this->Panned = false;
  this->Down = true;
}

void MatchPane::mouseMoveEvent(QMouseEvent* event)
{
  const QPointF point = this->pointAt(event->pos());
  emit this->pointed(this->isInside(point), point.x(), point.y());
  if (!this->Down ||
      (!this->Panned && (event->pos() - this->Pressed).manhattanLength() < QApplication::startDragDistance()))
  {
    return;
  }
  this->Panned = true;
  this->Whole = false;
  this->Origin += event->pos() - this->LastPosition;
  this->LastPosition = event->pos();
  this->update();
}

void MatchPane::mouseReleaseEvent(QMouseEvent* event)
{
  const QPointF point = this->pointAt(event->pos());
  this->Down = false;
  if (!this->Panned && event->button() == Qt::LeftButton && this->isInside(point))
  {
    emit this->picked(point.x(), point.y());
  }
}

void MatchPane::mouseDoubleClickEvent(QMouseEvent* /*event*/)
{
  this->Panned = true; // the release that follows picks nothing
  this->showAll();
}

void MatchPane::wheelEvent(QWheelEvent* event)
{
  this->zoomAt(event->position(), std::exp(zoomPerStep * event->angleDelta().y() / 120.0));
  event->accept();
}

void MatchPane::keyPressEvent(QKeyEvent* event)
{
  const double step = event->modifiers() & Qt::ShiftModifier ? fine : 1;
  const QPointF middle = QRectF(this->rect()).center();
  switch (event->key())
  {
    case Qt::Key_Left:
      emit this->moved(-step, 0);
      break;
    case Qt::Key_Right:
      emit this->moved(step, 0);
      break;
    case Qt::Key_Up:
      emit this->moved(0, -step);
      break;
    case Qt::Key_Down:
      emit this->moved(0, step);
      break;
    case Qt::Key_Plus:
    case Qt::Key_Equal:
      this->zoomAt(middle, std::exp(zoomPerStep));
      break;
    case Qt::Key_Minus:
      this->zoomAt(middle, std::exp(-zoomPerStep));
      break;
    case Qt::Key_0:
      this->showAll();
      break;
    default:
      QWidget::keyPressEvent(event);
  }
}

void MatchPane::leaveEvent(QEvent*) { emit this->pointed(false, 0, 0); }

} // namespace dgtk
