// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkTruthPicture.h"

#include <QPainter>

#include <algorithm>
#include <cstring>

namespace dgtk
{

namespace
{
constexpr int margin = 6; // pixels
const QColor backdrop(28, 28, 31);
} // namespace

QImage imageOf(const LayerPicture& picture)
{
  QImage image(picture.width, picture.height, QImage::Format_RGB888);
  for (int y = 0; y < picture.height; ++y)
  {
    std::memcpy(image.scanLine(y), picture.pixels.data() + std::size_t(y) * std::size_t(picture.width),
      3 * std::size_t(picture.width));
  }
  return image;
}

TruthPicture::TruthPicture(QWidget* view)
  : QWidget(view)
{
  this->setAttribute(Qt::WA_TransparentForMouseEvents);
  this->setAttribute(Qt::WA_OpaquePaintEvent);
  this->setObjectName("truthPicture");
  this->hide();
}

QRectF TruthPicture::fitted(const QSize& image, const QSize& widget)
{
  const double scale = std::min(
    double(widget.width()) / std::max(image.width(), 1), double(widget.height()) / std::max(image.height(), 1));
  const QSizeF size = QSizeF(image) * scale;
  return { QPointF((widget.width() - size.width()) / 2, (widget.height() - size.height()) / 2), size };
}

void TruthPicture::showPicture(const LivePicture& picture, const QSize& size, const QString& caption)
{
  this->Image = imageOf(picture.picture);
  this->Size = size;
  this->Step = picture.step;
  this->Caption = caption;
  this->update();
}

void TruthPicture::forgetPicture()
{
  this->Image = {};
  this->Settled = false;
  this->Caption.clear();
  this->update();
}

void TruthPicture::paintEvent(QPaintEvent* /*event*/)
{
  QPainter painter(this);
  painter.fillRect(this->rect(), backdrop);
  if (!this->Image.isNull())
  {
    const QRectF place = fitted(this->Size, this->size());
    const double scale = place.width() / this->Size.width() * this->Step;
    painter.setRenderHint(QPainter::SmoothPixmapTransform, scale < 1);
    painter.setClipRect(place);
    painter.drawImage(QRectF(place.topLeft(), QSizeF(this->Image.size()) * scale), this->Image);
    painter.setClipping(false);
  }
  if (!this->Caption.isEmpty())
  {
    const QRect area = this->rect().adjusted(margin, margin, -margin, -margin);
    const QRect text =
      painter.fontMetrics().boundingRect(area, Qt::AlignLeft | Qt::AlignBottom | Qt::TextWordWrap, this->Caption);
    painter.fillRect(text.adjusted(-4, -2, 4, 2), QColor(0, 0, 0, 150));
    painter.setPen(Qt::white);
    painter.drawText(area, Qt::AlignLeft | Qt::AlignBottom | Qt::TextWordWrap, this->Caption);
  }
}

} // namespace dgtk
