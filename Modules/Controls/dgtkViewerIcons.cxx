// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEditorIcons.h"

#include <QPainter>
#include <QPolygonF>

// The icons of the dataset viewer, in the style of the editor's.

namespace dgtk
{

namespace
{
const QColor viewerAccent(58, 122, 200);
const QColor pale(150, 185, 225);

void magnifier(QPainter& p, bool more)
{
  p.drawEllipse(QPointF(10, 10), 6.5, 6.5);
  p.drawLine(QPointF(15, 15), QPointF(21, 21));
  p.drawLine(QPointF(7, 10), QPointF(13, 10));
  if (more)
  {
    p.drawLine(QPointF(10, 7), QPointF(10, 13));
  }
}

void panes(QPainter& p, int columns, int rows)
{
  p.setBrush(pale);
  const double width = (18.0 - 2 * (columns - 1)) / columns;
  const double height = (18.0 - 2 * (rows - 1)) / rows;
  for (int i = 0; i < columns * rows; ++i)
  {
    p.drawRect(QRectF(3 + (i % columns) * (width + 2), 3 + double(i / columns) * (height + 2), width, height));
  }
}

void triangle(QPainter& p, double tip, double base)
{
  p.setBrush(viewerAccent);
  p.drawPolygon(QPolygonF(QVector<QPointF>{ { base, 5 }, { tip, 12 }, { base, 19 } }));
}

void step(QPainter& p, bool forward)
{
  triangle(p, forward ? 16 : 8, forward ? 6 : 18);
  const double bar = forward ? 19 : 5;
  p.drawLine(QPointF(bar, 5), QPointF(bar, 19));
}

void sheets(QPainter& p)
{
  for (int i = 2; i >= 0; --i)
  {
    p.setBrush(i == 0 ? viewerAccent : pale);
    const double y = 4 + 5.0 * i;
    p.drawPolygon(QPolygonF(QVector<QPointF>{ { 12, y - 1 }, { 21, y + 3 }, { 12, y + 7 }, { 3, y + 3 } }));
  }
}

void smallCamera(QPainter& p, double x, double y)
{
  p.drawRect(QRectF(x, y, 5.5, 5));
  p.drawPolyline(
    QPolygonF(QVector<QPointF>{ { x + 5.5, y + 2.5 }, { x + 9, y }, { x + 9, y + 5 }, { x + 5.5, y + 2.5 } }));
}

void cloud(QPainter& p)
{
  p.drawPolyline(QPolygonF(QVector<QPointF>{ { 10, 5 }, { 3, 12 }, { 10, 19 }, { 10, 5 } }));
  p.setPen(QPen(viewerAccent, 2.6, Qt::SolidLine, Qt::RoundCap));
  for (const QPointF& at : { QPointF(14, 8), QPointF(14.5, 13), QPointF(15, 18), QPointF(18, 6), QPointF(18.5, 11),
         QPointF(19.5, 16), QPointF(21.5, 9) })
  {
    p.drawPoint(at);
  }
}

void oneToOne(QPainter& p)
{
  p.drawLine(QPointF(6, 6), QPointF(6, 18));
  p.drawLine(QPointF(6, 6), QPointF(3.5, 8.5));
  p.drawLine(QPointF(18, 6), QPointF(18, 18));
  p.drawLine(QPointF(18, 6), QPointF(15.5, 8.5));
  p.setPen(QPen(viewerAccent, 3, Qt::SolidLine, Qt::RoundCap));
  p.drawPoint(QPointF(12, 10));
  p.drawPoint(QPointF(12, 16));
}

void fit(QPainter& p)
{
  p.drawRect(QRectF(3, 5, 18, 14));
  p.setBrush(pale);
  p.drawRect(QRectF(7, 8, 10, 8));
}
} // namespace

std::map<QString, IconDrawing> viewerIcons()
{
  return { { "fit", fit }, { "actualSize", oneToOne }, { "zoomIn", [](QPainter& p) { magnifier(p, true); } },
    { "zoomOut", [](QPainter& p) { magnifier(p, false); } }, { "panes1", [](QPainter& p) { panes(p, 1, 1); } },
    { "panes2", [](QPainter& p) { panes(p, 2, 1); } }, { "panes4", [](QPainter& p) { panes(p, 2, 2); } },
    { "layersOfCamera", sheets },
    { "camerasOfLayer",
      [](QPainter& p)
      {
        smallCamera(p, 2, 3);
        smallCamera(p, 2, 15);
        smallCamera(p, 13, 9);
      } },
    { "play", [](QPainter& p) { triangle(p, 19, 6); } }, { "nextFrame", [](QPainter& p) { step(p, true); } },
    { "previousFrame", [](QPainter& p) { step(p, false); } }, { "cloud", cloud } };
}

} // namespace dgtk
