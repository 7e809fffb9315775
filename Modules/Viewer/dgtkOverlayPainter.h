// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkOverlayPainter_h
#define dgtkOverlayPainter_h

#include "dgtkPictureOverlay.h"

#include <QPointF>
#include <QRect>

#include <functional>

class QPainter;

namespace dgtk
{

/// Draws points, and boxes with the names of their objects, each in its object's colour; the box of all pixels, hidden
/// or not, is dashed where it is another one. `area`: of the widget, in which names stay. `toWidget`: of image points.
void paintOverlay(QPainter& painter, const PictureOverlay& overlay, const QRect& area,
  const std::function<QPointF(const Eigen::Vector2d&)>& toWidget);

} // namespace dgtk

#endif
