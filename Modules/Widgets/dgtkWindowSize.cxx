// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkWindowSize.h"

#include <QGuiApplication>
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

} // namespace dgtk
