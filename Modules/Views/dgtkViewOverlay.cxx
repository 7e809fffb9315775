// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkViewOverlay.h"

#include <QPainter>
#include <QPolygonF>

#include <algorithm>
#include <utility>

namespace dgtk
{

namespace
{
constexpr double lineWidth = 2.2;
constexpr double edgeWidth = 4.4; // a dark edge keeps colours legible on any scene
constexpr std::size_t manyLines = 2000;
constexpr int textGap = 16; // pixels from the pointer
const QColor edge(20, 20, 22, 150);
const QColor chosen(60, 255, 60);
const QColor bright(255, 214, 60);
const QColor freeColor(230, 230, 232);
const QColor frameColor(120, 160, 210);

QColor colorOf(const Handle& handle)
{
  static const QColor axes[3] = { QColor(235, 80, 75), QColor(110, 195, 70), QColor(90, 140, 255) };
  return handle.kind == Handle::Kind::Free ? freeColor : axes[handle.axis];
}

QPolygonF polygonOf(const HandleShape& shape)
{
  QPolygonF polygon;
  for (const Eigen::Vector2d& point : shape.points)
  {
    polygon << QPointF(point.x(), point.y());
  }
  return polygon;
}

void draw(QPainter& painter, const HandleShape& shape)
{
  if (shape.closed)
  {
    painter.drawPolygon(polygonOf(shape));
  }
  else
  {
    painter.drawPolyline(polygonOf(shape));
  }
}
} // namespace

ViewOverlay::ViewOverlay(QWidget* view)
  : QWidget(view)
{
  this->setObjectName("overlay");
  this->setAttribute(Qt::WA_TransparentForMouseEvents);
  this->setAttribute(Qt::WA_NoSystemBackground);
  this->setFocusPolicy(Qt::NoFocus);
}

void ViewOverlay::showLines(std::vector<QLineF> lines)
{
  this->Lines = std::move(lines);
  this->update();
}

void ViewOverlay::showHandles(std::vector<HandleShape> shapes)
{
  this->Shapes = std::move(shapes);
  this->update();
}

void ViewOverlay::highlight(const std::optional<Handle>& handle)
{
  if (handle != this->Bright)
  {
    this->Bright = handle;
    this->update();
  }
}

void ViewOverlay::showText(const QString& text, const QPoint& at)
{
  this->Text = text;
  this->At = at;
  this->update();
}

void ViewOverlay::showFrame(bool on)
{
  this->Frame = on;
  this->update();
}

void ViewOverlay::paintEvent(QPaintEvent*)
{
  QPainter painter(this);
  if (this->Frame)
  {
    painter.setPen(frameColor);
    painter.drawRect(this->rect().adjusted(0, 0, -1, -1));
  }
  painter.setRenderHint(QPainter::Antialiasing, this->Lines.size() < manyLines);
  painter.setPen(QPen(chosen, 1.6));
  painter.drawLines(this->Lines.data(), static_cast<int>(this->Lines.size()));
  painter.setRenderHint(QPainter::Antialiasing);
  for (const HandleShape& shape : this->Shapes)
  {
    const QColor color = this->Bright && *this->Bright == shape.handle ? bright : colorOf(shape.handle);
    QColor inner = color;
    inner.setAlpha(shape.handle.kind == Handle::Kind::Plane ? 110 : 255);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(edge, edgeWidth, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    draw(painter, shape);
    painter.setBrush(shape.filled ? QBrush(inner) : QBrush(Qt::NoBrush));
    painter.setPen(QPen(color, shape.filled ? 1.0 : lineWidth, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    draw(painter, shape);
  }
  if (this->Text.isEmpty())
  {
    return;
  }
  QRect box = painter.fontMetrics().boundingRect(this->Text).adjusted(-6, -3, 6, 3);
  box.moveTopLeft(this->At + QPoint(textGap, textGap));
  box.moveRight(std::min(box.right(), this->width() - 2));
  box.moveBottom(std::min(box.bottom(), this->height() - 2));
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(20, 20, 22, 200));
  painter.drawRoundedRect(box, 3, 3);
  painter.setPen(Qt::white);
  painter.drawText(box, Qt::AlignCenter, this->Text);
}

} // namespace dgtk
