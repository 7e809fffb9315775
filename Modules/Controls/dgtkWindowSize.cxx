// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkWindowSize.h"

#include <QGuiApplication>
#include <QPoint>
#include <QRect>
#include <QScreen>
#include <QWidget>

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr int frame[2] = { 12, 44 }; // pixels about a window: borders, title
}

void resizeWithin(QWidget& window, int width, int height)
{
  const QSize room = QGuiApplication::primaryScreen()->availableSize();
  window.resize(std::min(width, room.width() - frame[0]), std::min(height, room.height() - frame[1]));
}

void placeBeside(QWidget& window, const QWidget& widget)
{
  window.adjustSize();
  const QRect room = widget.screen()->availableGeometry();
  const QRect there(widget.mapToGlobal(QPoint(0, 0)), widget.size());
  const int x = there.left() - window.width() - frame[0];
  const int y = there.center().y() - window.height() / 2;
  window.move(std::max(room.left(), std::min(x, room.right() - window.width() - frame[0])),
    std::max(room.top(), std::min(y, room.bottom() - window.height() - frame[1])));
}

} // namespace dgtk
