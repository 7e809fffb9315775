// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkOverlayPainter.h"

#include "dgtkLayerColors.h"

#include <QLineF>
#include <QPainter>

#include <algorithm>
#include <vector>

namespace dgtk
{

namespace
{
constexpr double largestPoint = 3; // radius, widget units
constexpr double smallestPoint = 1;
constexpr int nameMargin = 3;
const QColor shadow(0, 0, 0, 170);

QColor colorOf(std::uint32_t id)
{
  const Rgb color = idColor(id);
  return { color[0], color[1], color[2] };
}

void paintRectangle(QPainter& painter, const QRectF& place, const QColor& color, Qt::PenStyle style)
{
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(shadow, 3));
  painter.drawRect(place);
  painter.setPen(QPen(color, 1, style));
  painter.drawRect(place);
}

void paintPoint(QPainter& painter, const QPointF& at, double radius, const QColor& color)
{
  if (radius < 2)
  {
    painter.fillRect(QRectF(at - QPointF(radius, radius), QSizeF(2 * radius, 2 * radius)), color);
    return;
  }
  painter.setPen(QPen(shadow, 1));
  painter.setBrush(color);
  painter.drawEllipse(at, radius, radius);
}

/// Above the box, in it or below it: where no other name is. Where all three are taken, there is none.
void paintName(QPainter& painter, const QString& name, const QRectF& box, const QRect& area, std::vector<QRect>& taken)
{
  const QFontMetrics metrics = painter.fontMetrics();
  QRect place(0, 0, metrics.horizontalAdvance(name) + 2 * nameMargin, metrics.height());
  place.moveLeft(std::max(area.left(), std::min(int(box.left()), area.right() - place.width())));
  const int above = int(box.top()) - place.height() - 1;
  for (const int top : { above, std::max(area.top(), int(box.top()) + 2), int(box.bottom()) + 2 })
  {
    place.moveTop(top);
    const bool free =
      std::none_of(taken.begin(), taken.end(), [&place](const QRect& other) { return other.intersects(place); });
    if (free && area.contains(place))
    {
      painter.fillRect(place, shadow);
      painter.setPen(Qt::white);
      painter.drawText(place, Qt::AlignCenter, name);
      taken.push_back(place);
      return;
    }
  }
}
} // namespace

void paintOverlay(QPainter& painter, const PictureOverlay& overlay, const QRect& area,
  const std::function<QPointF(const Eigen::Vector2d&)>& toWidget)
{
  painter.save();
  // small where pixels are, or points would hide the picture
  const double pixel = QLineF(toWidget({ 0, 0 }), toWidget({ 1, 0 })).length();
  const double radius = std::clamp(pixel / 3, smallestPoint, largestPoint);
  for (const PictureOverlay::Point& point : overlay.points)
  {
    const QPointF at = toWidget(point.pixel);
    if (area.contains(at.toPoint()))
    {
      paintPoint(painter, at, radius, colorOf(point.object));
    }
  }
  const auto placeOf = [&](const Eigen::Vector4d& box)
  { return QRectF(toWidget(box.head<2>()), toWidget(box.tail<2>())); };
  for (const PictureOverlay::Box& box : overlay.boxes)
  {
    if (box.amodal && box.amodal != box.visible)
    {
      paintRectangle(painter, placeOf(*box.amodal), colorOf(box.id), Qt::DashLine);
    }
    if (box.visible)
    {
      paintRectangle(painter, placeOf(*box.visible), colorOf(box.id), Qt::SolidLine);
    }
  }
  // names last, so that no line crosses one
  std::vector<QRect> taken;
  for (const PictureOverlay::Box& box : overlay.boxes)
  {
    const std::optional<Eigen::Vector4d>& named = box.visible ? box.visible : box.amodal;
    if (named && placeOf(*named).intersects(area))
    {
      paintName(painter, QString::fromStdString(box.name), placeOf(*named), area, taken);
    }
  }
  painter.restore();
}

} // namespace dgtk
