// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEditorIcons.h"

#include <QGuiApplication>
#include <QPainter>
#include <QPainterPath>
#include <QPalette>
#include <QPixmap>
#include <QPolygonF>
#include <QVector>

#include <cmath>
#include <initializer_list>
#include <map>

namespace dgtk
{

namespace
{
// All icons are drawn on a square of 24 x 24 with lines of width 1.8; the accent colour marks what an icon is about.
constexpr double side = 24;
constexpr double lineWidth = 1.8;
const QColor accent(58, 122, 200);
const QColor warm(226, 150, 30);
const QColor danger(200, 60, 50);

using Draw = IconDrawing;

QPolygonF polygon(std::initializer_list<QPointF> points) { return QPolygonF(QVector<QPointF>(points)); }

void page(QPainter& p, double x, double y, double w, double h)
{
  QPainterPath path;
  path.moveTo(x, y);
  path.lineTo(x + w - 4, y);
  path.lineTo(x + w, y + 4);
  path.lineTo(x + w, y + h);
  path.lineTo(x, y + h);
  path.closeSubpath();
  p.drawPath(path);
}

void folder(QPainter& p)
{
  p.drawPolygon(polygon({ { 3, 6 }, { 9, 6 }, { 11, 8.5 }, { 21, 8.5 }, { 21, 19 }, { 3, 19 } }));
}

void arrow(QPainter& p, const QPointF& from, const QPointF& to)
{
  p.drawLine(from, to);
  const QPointF way = (to - from) / std::sqrt(QPointF::dotProduct(to - from, to - from));
  const QPointF across(-way.y(), way.x());
  p.drawPolyline(polygon({ to - 4 * way + 4 * across, to, to - 4 * way - 4 * across }));
}

void turn(QPainter& p, bool back)
{
  if (!back)
  {
    p.translate(side, 0);
    p.scale(-1, 1);
  }
  QPainterPath path;
  path.moveTo(5, 9);
  path.lineTo(14, 9);
  path.arcTo(9.5, 9, 9.5, 9, 90, -180);
  path.lineTo(9, 18);
  p.drawPath(path);
  p.drawPolyline(polygon({ { 9, 5 }, { 5, 9 }, { 9, 13 } }));
}

void box(QPainter& p)
{
  p.drawPolygon(polygon({ { 12, 3 }, { 20, 7.5 }, { 20, 16.5 }, { 12, 21 }, { 4, 16.5 }, { 4, 7.5 } }));
  p.drawPolyline(polygon({ { 4, 7.5 }, { 12, 12 }, { 20, 7.5 } }));
  p.drawLine(QPointF(12, 12), QPointF(12, 21));
}

void corners(QPainter& p)
{
  for (int turned = 0; turned < 4; ++turned)
  {
    p.drawPolyline(polygon({ { 4, 8 }, { 4, 4 }, { 8, 4 } }));
    p.translate(side, 0);
    p.rotate(90);
  }
}

void camera(QPainter& p)
{
  p.drawRect(QRectF(3, 8, 11, 9));
  p.drawPolygon(polygon({ { 14, 12.5 }, { 21, 8 }, { 21, 17 } }));
}

void bulb(QPainter& p)
{
  p.setBrush(warm.lighter(150));
  p.drawEllipse(QPointF(12, 9.5), 6, 6);
  p.setBrush(Qt::NoBrush);
  p.drawLine(QPointF(9.5, 18), QPointF(14.5, 18));
  p.drawLine(QPointF(10.5, 21), QPointF(13.5, 21));
}

void colored(QPainter& p, const QColor& color)
{
  p.setPen(QPen(color, lineWidth, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
}

std::map<QString, Draw> fileIcons()
{
  return { { "new", [](QPainter& p) { page(p, 5, 3, 14, 18); } }, { "open", [](QPainter& p) { folder(p); } },
    { "save",
      [](QPainter& p)
      {
        p.drawRect(QRectF(4, 4, 16, 16));
        p.drawRect(QRectF(8, 4, 8, 5));
        p.fillRect(QRectF(8, 13, 8, 7), accent);
      } },
    { "import",
      [](QPainter& p)
      {
        p.drawPolyline(polygon({ { 4, 13 }, { 4, 20 }, { 20, 20 }, { 20, 13 } }));
        colored(p, accent);
        arrow(p, { 12, 3 }, { 12, 15 });
      } },
    { "saveAs",
      [](QPainter& p)
      {
        p.drawRect(QRectF(3, 3, 14, 14));
        p.drawRect(QRectF(6.5, 3, 7, 4));
        colored(p, accent);
        p.drawLine(QPointF(12, 21), QPointF(21, 12));
        p.drawPolyline(polygon({ { 12, 17 }, { 12, 21 }, { 16, 21 } }));
      } },
    { "openDataset",
      [](QPainter& p)
      {
        p.drawRect(QRectF(3, 3, 13, 11));
        p.drawPolyline(polygon({ { 19, 8 }, { 21, 8 }, { 21, 20 }, { 7, 20 }, { 7, 17 } }));
        colored(p, accent);
        p.drawPolyline(polygon({ { 4, 12 }, { 8, 7 }, { 11, 10.5 }, { 13, 8.5 }, { 15, 11 } }));
      } },
    { "exportPov",
      [](QPainter& p)
      {
        p.drawPolyline(polygon({ { 4, 13 }, { 4, 20 }, { 20, 20 }, { 20, 13 } }));
        colored(p, accent);
        arrow(p, { 12, 15 }, { 12, 3 });
      } },
    { "exit",
      [](QPainter& p)
      {
        p.drawPolyline(polygon({ { 13, 4 }, { 4, 4 }, { 4, 20 }, { 13, 20 } }));
        colored(p, danger);
        arrow(p, { 9, 12 }, { 21, 12 });
      } },
    { "render", [](QPainter& p)
      {
        p.drawRect(QRectF(3, 4, 18, 16));
        p.setPen(Qt::NoPen);
        p.setBrush(accent);
        p.drawPolygon(polygon({ { 9.5, 7.5 }, { 17, 12 }, { 9.5, 16.5 } }));
      } } };
}

std::map<QString, Draw> editIcons()
{
  return { { "undo", [](QPainter& p) { turn(p, true); } }, { "redo", [](QPainter& p) { turn(p, false); } },
    { "cut",
      [](QPainter& p)
      {
        p.drawLine(QPointF(7, 3), QPointF(15.5, 16));
        p.drawLine(QPointF(17, 3), QPointF(8.5, 16));
        p.drawEllipse(QPointF(6.5, 18.5), 2.8, 2.8);
        p.drawEllipse(QPointF(17.5, 18.5), 2.8, 2.8);
      } },
    { "copy",
      [](QPainter& p)
      {
        p.drawPolyline(polygon({ { 6, 17 }, { 3, 17 }, { 3, 3 }, { 14, 3 }, { 14, 5 } }));
        page(p, 9, 8, 12, 13);
      } },
    { "paste",
      [](QPainter& p)
      {
        p.drawRect(QRectF(4, 5, 16, 16));
        p.fillRect(QRectF(8, 2.5, 8, 5), accent);
        p.drawLine(QPointF(8, 12), QPointF(16, 12));
        p.drawLine(QPointF(8, 16), QPointF(16, 16));
      } },
    { "duplicate",
      [](QPainter& p)
      {
        p.drawRect(QRectF(3, 3, 12, 12));
        colored(p, accent);
        p.drawRect(QRectF(9, 9, 12, 12));
      } },
    { "delete",
      [](QPainter& p)
      {
        colored(p, danger);
        p.drawLine(QPointF(5, 5), QPointF(19, 19));
        p.drawLine(QPointF(19, 5), QPointF(5, 19));
      } },
    { "selectAll",
      [](QPainter& p)
      {
        p.fillRect(QRectF(8, 8, 8, 8), QColor(60, 170, 70));
        QPen dashes = p.pen();
        dashes.setDashPattern({ 1.6, 1.6 });
        p.setPen(dashes);
        p.drawRect(QRectF(4, 4, 16, 16));
      } },
    { "rename",
      [](QPainter& p)
      {
        p.drawRect(QRectF(3, 7, 18, 10));
        colored(p, accent);
        p.drawLine(QPointF(9, 4), QPointF(9, 20));
        p.drawLine(QPointF(7, 4), QPointF(11, 4));
        p.drawLine(QPointF(7, 20), QPointF(11, 20));
      } },
    { "keyFrame",
      [](QPainter& p)
      {
        p.drawLine(QPointF(3, 19), QPointF(21, 19));
        p.setPen(Qt::NoPen);
        p.setBrush(warm);
        p.drawPolygon(polygon({ { 12, 3 }, { 18, 9 }, { 12, 15 }, { 6, 9 } }));
      } },
    { "removeKeyFrame",
      [](QPainter& p)
      {
        p.drawPolygon(polygon({ { 9, 3 }, { 15, 9 }, { 9, 15 }, { 3, 9 } }));
        colored(p, danger);
        p.drawLine(QPointF(13, 13), QPointF(21, 21));
        p.drawLine(QPointF(21, 13), QPointF(13, 21));
      } },
    { "preview",
      [](QPainter& p)
      {
        QPainterPath eye;
        eye.moveTo(2.5, 12);
        eye.quadTo(12, 2, 21.5, 12);
        eye.quadTo(12, 22, 2.5, 12);
        p.drawPath(eye);
        p.setPen(Qt::NoPen);
        p.setBrush(accent);
        p.drawEllipse(QPointF(12, 12), 3.2, 3.2);
      } },
    { "properties", [](QPainter& p)
      {
        for (const double y : { 6.0, 12.0, 18.0 })
        {
          p.drawLine(QPointF(10, y), QPointF(21, y));
          p.fillRect(QRectF(3, y - 2, 4, 4), accent);
        }
      } } };
}

std::map<QString, Draw> toolIcons()
{
  return { { "camera", [](QPainter& p) { camera(p); } },
    { "cameraArray",
      [](QPainter& p)
      {
        for (const QPointF& at : { QPointF(1.5, 1.5), QPointF(11, 1.5), QPointF(6.5, 11.5) })
        {
          p.save();
          p.translate(at);
          p.scale(0.5, 0.5);
          colored(p, at.y() > 5 ? accent : p.pen().color());
          p.setPen(QPen(p.pen().color(), 2 * lineWidth, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
          camera(p);
          p.restore();
        }
      } },
    { "light", [](QPainter& p) { bulb(p); } },
    { "correspondence", [](QPainter& p)
      {
        p.drawRect(QRectF(2, 5, 8, 14));
        p.drawRect(QRectF(14, 5, 8, 14));
        colored(p, accent);
        p.drawLine(QPointF(6, 10), QPointF(18, 14));
        p.setBrush(accent);
        p.drawEllipse(QPointF(6, 10), 1.4, 1.4);
        p.drawEllipse(QPointF(18, 14), 1.4, 1.4);
      } } };
}

std::map<QString, Draw> handleIcons()
{
  return { { "move",
             [](QPainter& p)
             {
               arrow(p, { 5, 19 }, { 5, 3 });
               arrow(p, { 5, 19 }, { 21, 19 });
               p.fillRect(QRectF(9, 9, 6, 6), accent);
             } },
    { "rotate",
      [](QPainter& p)
      {
        p.fillRect(QRectF(9.5, 10, 5, 5), accent);
        p.drawArc(QRectF(4, 4.5, 16, 16), 120 * 16, 300 * 16);
        p.drawPolyline(polygon({ { 4.2, 3.2 }, { 8.4, 5.4 }, { 7, 10 } }));
      } },
    { "scale", [](QPainter& p)
      {
        p.drawPolyline(polygon({ { 10, 4 }, { 4, 4 }, { 4, 20 }, { 20, 20 }, { 20, 14 } }));
        p.fillRect(QRectF(6.5, 12, 5.5, 5.5), accent);
        arrow(p, { 12, 12 }, { 20.5, 3.5 });
      } } };
}

std::map<QString, Draw> viewIcons()
{
  return { { "frameAll",
             [](QPainter& p)
             {
               corners(p);
               p.drawRect(QRectF(8.5, 8.5, 7, 7));
             } },
    { "frameSelected",
      [](QPainter& p)
      {
        corners(p);
        p.fillRect(QRectF(8, 8, 8, 8), QColor(60, 170, 70));
      } },
    { "wireframe", [](QPainter& p) { box(p); } },
    { "shaded",
      [](QPainter& p)
      {
        p.setBrush(QColor(150, 150, 155));
        box(p);
      } },
    { "textured",
      [](QPainter& p)
      {
        p.setBrush(accent.lighter(140));
        box(p);
        p.setPen(Qt::NoPen);
        p.setBrush(accent);
        p.drawPolygon(polygon({ { 12, 12 }, { 20, 7.5 }, { 20, 16.5 }, { 12, 21 } }));
      } },
    { "grid", [](QPainter& p)
      {
        for (const double at : { 4.0, 12.0, 20.0 })
        {
          p.drawLine(QPointF(at, 4), QPointF(at, 20));
          p.drawLine(QPointF(4, at), QPointF(20, at));
        }
      } } };
}

QPixmap drawn(const Draw& draw, int pixels, QIcon::Mode mode)
{
  QPixmap pixmap(pixels, pixels);
  pixmap.fill(Qt::transparent);
  QPainter painter(&pixmap);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.scale(pixels / side, pixels / side);
  colored(painter, QGuiApplication::palette().color(QPalette::WindowText));
  painter.setOpacity(mode == QIcon::Disabled ? 0.35 : 1.0);
  draw(painter);
  return pixmap;
}
} // namespace

const std::map<QString, IconDrawing>& editorIcons()
{
  static const std::map<QString, Draw> icons = []
  {
    std::map<QString, Draw> all = fileIcons();
    all.merge(editIcons());
    all.merge(toolIcons());
    all.merge(handleIcons());
    all.merge(viewIcons());
    all.merge(viewerIcons());
    return all;
  }();
  return icons;
}

QIcon editorIcon(const QString& name)
{
  QIcon icon;
  const std::map<QString, IconDrawing>& icons = editorIcons();
  const auto at = icons.find(name);
  for (const int pixels : { 16, 20, 24, 32, 48, 64 })
  {
    for (const QIcon::Mode mode : { QIcon::Normal, QIcon::Disabled })
    {
      if (at != icons.end())
      {
        icon.addPixmap(drawn(at->second, pixels, mode), mode);
      }
    }
  }
  return icon;
}

} // namespace dgtk
