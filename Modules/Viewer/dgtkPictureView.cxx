// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPictureView.h"

#include "dgtkOverlayPainter.h"

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
const QColor background(28, 28, 31);
const QColor messageColor(190, 190, 195);
constexpr double zoomPerStep = 0.2; // of the wheel, natural logarithm
constexpr double gridScale = 12;    // widget units a pixel, from which on pixels have borders
constexpr int farStep = 10;         // pixels, arrow keys with Shift
constexpr int panStep = 40;         // widget units, arrow keys with Control
constexpr int messageMargin = 16;
constexpr int readOutMargin = 4;

QPointF toQt(const Eigen::Vector2d& v) { return { v.x(), v.y() }; }
Eigen::Vector2d fromQt(const QPointF& p) { return { p.x(), p.y() }; }

/// Whether both show the same, perhaps in another part and step.
bool isSame(const ShownPointer& a, const ShownPointer& b)
{
  return a && b && a->dataset == b->dataset && a->ask.key == b->ask.key && a->ask.surface == b->ask.surface &&
         a->ask.range == b->ask.range;
}
} // namespace

void PictureSync::setCursor(const std::optional<QPoint>& pixel)
{
  if (this->Cursor != pixel)
  {
    this->Cursor = pixel;
    emit this->cursorChanged();
  }
}

PictureView::PictureView(PictureSync& sync, QWidget* parent)
  : QWidget(parent)
  , Sync(sync)
{
  this->setMouseTracking(true);
  this->setFocusPolicy(Qt::StrongFocus);
  this->setCursor(Qt::CrossCursor);
  this->setMinimumSize(120, 90);
  this->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  connect(&sync, &PictureSync::zoomChanged, this,
    [this]
    {
      this->askForDetail();
      this->update();
    });
  connect(&sync, &PictureSync::cursorChanged, this, [this] { this->update(); });
}

void PictureView::showPicture(const ShownPointer& shown)
{
  this->Detail = isSame(this->Shown, shown) ? this->Detail : nullptr;
  this->Shown = shown;
  this->Message = shown ? shown->error : QString();
  this->setToolTip(this->Message);
  this->askForDetail();
  this->update();
}

void PictureView::showDetail(const ShownPointer& shown)
{
  this->Detail = isSame(this->Shown, shown) && shown->picture ? shown : this->Detail;
  this->update();
}

Eigen::Vector2d PictureView::imageSize() const
{
  if (!this->Shown || !this->Shown->picture)
  {
    return { 0, 0 };
  }
  return { double(this->Shown->picture->info.width), double(this->Shown->picture->info.height) };
}

const PictureValues* PictureView::pictureAt(const QPoint& pixel) const
{
  const PictureValues* const whole = this->Shown ? this->Shown->picture.get() : nullptr;
  const PictureValues* const part = this->Detail ? this->Detail->picture.get() : nullptr;
  return part && part->inside(pixel.x(), pixel.y()) ? part : whole;
}

void PictureView::setReadOut(const QString& text)
{
  if (this->ReadOut != text)
  {
    this->ReadOut = text;
    this->update();
  }
}

void PictureView::setOverlays(const std::shared_ptr<const FrameOverlays>& overlays)
{
  this->Overlays = overlays;
  this->update();
}

QPointF PictureView::widgetPoint(const QPointF& image) const { return toQt(this->toWidget(fromQt(image))); }

void PictureView::setActive(bool on)
{
  this->Active = on;
  this->update();
}

void PictureView::askForDetail()
{
  const PictureValues* const whole = this->Shown ? this->Shown->picture.get() : nullptr;
  if (whole == nullptr || whole->step == 1 || this->Sync.zoom.scale() * whole->step <= 1)
  {
    return;
  }
  const Eigen::Vector2d first = this->toImage({ 0, 0 });
  const Eigen::Vector2d last = this->toImage(this->corner());
  const int step = std::max(1, static_cast<int>(std::floor(1 / this->Sync.zoom.scale())));
  PixelRect window;
  window.x = std::clamp(static_cast<int>(std::floor(first.x())), 0, whole->info.width - 1);
  window.y = std::clamp(static_cast<int>(std::floor(first.y())), 0, whole->info.height - 1);
  window.width = std::clamp(static_cast<int>(std::ceil(last.x())) - window.x, 1, whole->info.width - window.x);
  window.height = std::clamp(static_cast<int>(std::ceil(last.y())) - window.y, 1, whole->info.height - window.y);
  if (!this->Detail || !(this->Detail->ask.window == window) || this->Detail->ask.step != step)
  {
    emit this->detailWanted(window, step);
  }
}

void PictureView::drawPicture(QPainter& painter, const ShownPicture& shown) const
{
  const PictureValues& picture = *shown.picture;
  const QImage image(reinterpret_cast<const uchar*>(shown.colors.pixels.data()), picture.columns(), picture.rows(),
    picture.columns() * 4, QImage::Format_RGB32);
  const Eigen::Vector2d origin(picture.window.x, picture.window.y);
  const Eigen::Vector2d first = ((this->toImage({ 0, 0 }) - origin) / picture.step).array().floor().cwiseMax(0.0);
  const Eigen::Vector2d size(picture.columns(), picture.rows());
  const Eigen::Vector2d last =
    ((this->toImage(this->corner()) - origin) / picture.step).array().ceil().cwiseMin(size.array());
  if ((last.array() <= first.array()).any())
  {
    return;
  }
  const QPointF from = toQt(this->toWidget(origin + first * picture.step));
  const QPointF to = toQt(this->toWidget(origin + last * picture.step));
  const bool colors = shown.colors.legend.kind == PictureLegend::Kind::None;
  painter.setRenderHint(QPainter::SmoothPixmapTransform, colors && this->Sync.zoom.scale() * picture.step < 1);
  painter.drawImage(QRectF(from, to), image, QRectF(toQt(first), toQt(last)));
}

void PictureView::drawGrid(QPainter& painter) const
{
  const Eigen::Vector2d size = this->imageSize();
  const Eigen::Vector2d first = this->toImage({ 0, 0 }).array().floor().cwiseMax(0.0);
  const Eigen::Vector2d last = this->toImage(this->corner()).array().ceil().cwiseMin(size.array());
  const QPointF low = toQt(this->toWidget(first));
  const QPointF high = toQt(this->toWidget(last));
  painter.setPen(QColor(128, 128, 128, 110));
  for (int x = int(first.x()); x <= int(last.x()); ++x)
  {
    const double at = this->toWidget({ double(x), 0 }).x();
    painter.drawLine(QPointF(at, low.y()), QPointF(at, high.y()));
  }
  for (int y = int(first.y()); y <= int(last.y()); ++y)
  {
    const double at = this->toWidget({ 0, double(y) }).y();
    painter.drawLine(QPointF(low.x(), at), QPointF(high.x(), at));
  }
}

void PictureView::drawCursor(QPainter& painter) const
{
  const QPoint pixel = *this->Sync.cursor();
  const QPointF low = toQt(this->Sync.zoom.toWidget({ double(pixel.x()), double(pixel.y()) }, this->Sync.area));
  const double side = this->Sync.zoom.scale();
  const QPointF middle = low + QPointF(side / 2, side / 2);
  const double gap = std::max(6.0, side / 2);
  const double arm = gap + 14;
  const QLineF arms[] = { { middle.x() - arm, middle.y(), middle.x() - gap, middle.y() },
    { middle.x() + gap, middle.y(), middle.x() + arm, middle.y() },
    { middle.x(), middle.y() - arm, middle.x(), middle.y() - gap },
    { middle.x(), middle.y() + gap, middle.x(), middle.y() + arm } };
  for (const QPen& pen : { QPen(QColor(0, 0, 0, 180), 3), QPen(Qt::white, 1) })
  {
    painter.setPen(pen);
    painter.drawLines(arms, 4);
    if (side >= 4)
    {
      painter.drawRect(QRectF(low.x(), low.y(), side, side));
    }
  }
}

void PictureView::drawReadOut(QPainter& painter) const
{
  const QFontMetrics metrics = painter.fontMetrics();
  const QString text = metrics.elidedText(this->ReadOut, Qt::ElideRight, this->width() - 4 * readOutMargin);
  const QRect box(readOutMargin, this->height() - metrics.height() - 2 * readOutMargin,
    metrics.horizontalAdvance(text) + 2 * readOutMargin, metrics.height() + readOutMargin);
  painter.fillRect(box, QColor(0, 0, 0, 170));
  painter.setPen(Qt::white);
  painter.drawText(box, Qt::AlignCenter, text);
}

void PictureView::paintEvent(QPaintEvent*)
{
  QPainter painter(this);
  painter.fillRect(this->rect(), background);
  if (!this->Shown || !this->Shown->picture)
  {
    painter.setPen(messageColor);
    painter.drawText(this->rect().adjusted(messageMargin, messageMargin, -messageMargin, -messageMargin),
      Qt::AlignCenter | Qt::TextWrapAnywhere, this->Message);
    return;
  }
  this->drawPicture(painter, *this->Shown);
  if (this->Detail && this->Shown->picture->step > this->Detail->picture->step)
  {
    this->drawPicture(painter, *this->Detail);
  }
  if (this->Sync.zoom.scale() >= gridScale)
  {
    this->drawGrid(painter);
  }
  if (this->Overlays && this->Overlays->frame == this->Shown->ask.key.frame)
  {
    const auto overlay = this->Overlays->cameras.find(this->Shown->ask.key.camera);
    if (overlay != this->Overlays->cameras.end())
    {
      paintOverlay(
        painter, overlay->second, this->rect(), [this](const Eigen::Vector2d& p) { return toQt(this->toWidget(p)); });
    }
  }
  if (this->Sync.cursor())
  {
    this->drawCursor(painter);
    if (!this->ReadOut.isEmpty())
    {
      this->drawReadOut(painter);
    }
  }
  if (this->Active)
  {
    QColor mark = this->palette().color(QPalette::Highlight);
    mark.setAlphaF(this->hasFocus() ? 1 : 0.45);
    painter.setPen(QPen(mark, 2));
    painter.drawRect(QRectF(this->rect()).adjusted(1, 1, -1, -1));
  }
}

void PictureView::point(const QPoint& at)
{
  const Eigen::Vector2d size = this->imageSize();
  const Eigen::Vector2d image = this->toImage(fromQt(QPointF(at) + QPointF(0.5, 0.5)));
  const bool inside = (image.array() >= 0).all() && (image.array() < size.array()).all();
  if (inside) // elsewhere the last pixel stays, to be read at leisure
  {
    this->Sync.setCursor(QPoint(int(std::floor(image.x())), int(std::floor(image.y()))));
    emit this->pointed();
  }
}

void PictureView::wheelEvent(QWheelEvent* event)
{
  this->Sync.fitting = false;
  this->Sync.zoom.zoomBy(
    std::exp(zoomPerStep * event->angleDelta().y() / 120.0), fromQt(event->position()), this->Sync.area);
  this->Sync.changeZoom();
  this->point(event->position().toPoint());
  event->accept();
}

void PictureView::mousePressEvent(QMouseEvent* event)
{
  emit this->activated();
  this->Pressing = event->button() == Qt::LeftButton || event->button() == Qt::MiddleButton;
  this->Panning = false;
  this->Pressed = this->Last = event->pos();
}

void PictureView::mouseMoveEvent(QMouseEvent* event)
{
  const bool far = (event->pos() - this->Pressed).manhattanLength() >= QApplication::startDragDistance();
  this->Panning = this->Pressing && (this->Panning || far);
  if (this->Panning)
  {
    this->Sync.fitting = false;
    this->Sync.zoom.pan(fromQt(event->pos() - this->Last));
    this->Last = event->pos();
    this->Sync.changeZoom();
  }
  this->point(event->pos());
}

void PictureView::mouseReleaseEvent(QMouseEvent* event)
{
  this->Pressing = this->Panning = false;
  this->point(event->pos());
}

void PictureView::mouseDoubleClickEvent(QMouseEvent* event)
{
  if (event->button() == Qt::LeftButton)
  {
    emit this->maximizeAsked();
  }
}

void PictureView::moveCursor(int dx, int dy)
{
  const Eigen::Vector2d size = this->imageSize();
  if (size.x() < 1)
  {
    return;
  }
  const Eigen::Vector2d& center = this->Sync.zoom.center();
  const QPoint from = this->Sync.cursor().value_or(QPoint(int(center.x()) - dx, int(center.y()) - dy));
  const QPoint to(std::clamp(from.x() + dx, 0, int(size.x()) - 1), std::clamp(from.y() + dy, 0, int(size.y()) - 1));
  this->Sync.setCursor(to);
  const Eigen::Vector2d before = center;
  this->Sync.zoom.reveal({ to.x() + 0.5, to.y() + 0.5 }, this->Sync.area);
  if (before != this->Sync.zoom.center())
  {
    this->Sync.changeZoom();
  }
}

void PictureView::keyPressEvent(QKeyEvent* event)
{
  const int dx = event->key() == Qt::Key_Left ? -1 : event->key() == Qt::Key_Right ? 1 : 0;
  const int dy = event->key() == Qt::Key_Up ? -1 : event->key() == Qt::Key_Down ? 1 : 0;
  if (dx == 0 && dy == 0)
  {
    QWidget::keyPressEvent(event);
    return;
  }
  if (event->modifiers() & Qt::ControlModifier)
  {
    this->Sync.fitting = false;
    this->Sync.zoom.pan(Eigen::Vector2d(-dx * panStep, -dy * panStep));
    this->Sync.changeZoom();
    return;
  }
  const int step = event->modifiers() & Qt::ShiftModifier ? farStep : 1;
  this->moveCursor(dx * step, dy * step);
}

void PictureView::resizeEvent(QResizeEvent*)
{
  emit this->resized();
  this->askForDetail();
}

void PictureView::focusInEvent(QFocusEvent* event)
{
  QWidget::focusInEvent(event);
  emit this->activated();
}

} // namespace dgtk
