// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPictureView_h
#define dgtkPictureView_h

#include "dgtkPictureLoader.h"
#include "dgtkPictureZoom.h"

#include <QImage>
#include <QPoint>
#include <QWidget>

#include <optional>

namespace dgtk
{

/// What all panes have in common: the part of the picture that they show, and the pixel under the crosshair.
class PictureSync : public QObject
{
  Q_OBJECT

public:
  using QObject::QObject;
  PictureZoom zoom;
  /// What the zoom takes for the size of every pane, so that a place in one is the same image point in all.
  Eigen::Vector2d area{ 1, 1 };
  const std::optional<QPoint>& cursor() const { return this->Cursor; }
  void setCursor(const std::optional<QPoint>& pixel);
  void changeZoom() { emit this->zoomChanged(); }
  /// Fits again when panes change their size, until the user zooms or pans.
  bool fitting = true;

signals:
  void zoomChanged();
  void cursorChanged();

private:
  std::optional<QPoint> Cursor;
};

/// One picture, enlarged or reduced. Wheel: zoom at the mouse; drag: pan; arrow keys: crosshair, with Shift by ten;
/// Ctrl and arrow keys: pan.
class PictureView : public QWidget
{
  Q_OBJECT

public:
  PictureView(PictureSync& sync, QWidget* parent);

  /// Null: nothing yet. The detail stays where it is of the same picture in the same colours.
  void showPicture(const ShownPointer& shown);
  /// A part in more detail, over the picture.
  void showDetail(const ShownPointer& shown);
  const ShownPointer& shown() const { return this->Shown; }
  const ShownPointer& detail() const { return this->Detail; }
  /// Width and height of the whole image; (0, 0) while there is none.
  Eigen::Vector2d imageSize() const;
  /// Boxes and points, drawn over the picture of their frame and camera. Null: none.
  void setOverlays(const std::shared_ptr<const FrameOverlays>& overlays);
  /// Where an image point is in the widget; for tests.
  Q_INVOKABLE QPointF widgetPoint(const QPointF& image) const;
  /// The numbers under the crosshair, shown in a corner; "" for none.
  void setReadOut(const QString& text);
  /// The one whose camera and layer the menus mean.
  void setActive(bool on);
  /// The picture that has the numbers of a pixel exactly, or the one that is nearest.
  const PictureValues* pictureAt(const QPoint& pixel) const;

signals:
  void detailWanted(const dgtk::PixelRect& window, int step);
  void activated();
  /// The mouse is over a pixel of the picture.
  void pointed();
  void maximizeAsked();
  void resized();

protected:
  void paintEvent(QPaintEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;

private:
  Eigen::Vector2d toImage(const Eigen::Vector2d& at) const { return this->Sync.zoom.toImage(at, this->Sync.area); }
  Eigen::Vector2d toWidget(const Eigen::Vector2d& point) const
  {
    return this->Sync.zoom.toWidget(point, this->Sync.area);
  }
  Eigen::Vector2d corner() const { return { double(this->width()), double(this->height()) }; }
  void point(const QPoint& at);
  void moveCursor(int dx, int dy);
  void askForDetail();
  void drawPicture(QPainter& painter, const ShownPicture& shown) const;
  void drawGrid(QPainter& painter) const;
  void drawCursor(QPainter& painter) const;
  void drawReadOut(QPainter& painter) const;

  PictureSync& Sync;
  ShownPointer Shown;
  ShownPointer Detail;
  std::shared_ptr<const FrameOverlays> Overlays;
  QString Message;
  QString ReadOut;
  QPoint Pressed;
  QPoint Last;
  bool Active = false;
  bool Pressing = false;
  bool Panning = false;
};

} // namespace dgtk

#endif
