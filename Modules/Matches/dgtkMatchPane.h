// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMatchPane_h
#define dgtkMatchPane_h

#include "dgtkEpipolarLine.h"
#include "dgtkLiveTruth.h"

#include <QColor>
#include <QImage>
#include <QPointF>
#include <QString>
#include <QWidget>

#include <optional>
#include <vector>

namespace dgtk
{

/// A picture with points and a line on it. Wheel, + and -: zoom; drag: pan; double click, 0: all of it; click: picks a
/// point; arrows: move it by a pixel, with Shift by a tenth. Points are image points in pixels.
class MatchPane : public QWidget
{
  Q_OBJECT
  Q_PROPERTY(int step READ step)

public:
  struct Mark
  {
    QPointF at;
    QColor color;
    QString label;
    bool strong = false; ///< the one that is being looked at
  };

  explicit MatchPane(QWidget* parent);

  /// Shows all of an image of another size, without its picture.
  void setImageSize(const QSize& size);
  void setPicture(const LivePicture& picture);
  /// Instead of a picture; empty: none.
  void setMessage(const QString& message);
  void setMarks(const std::vector<Mark>& marks);
  void setLine(const std::optional<Eigen::Vector3d>& line, const QColor& color);
  /// Moves the picture until the point is in sight.
  void ensureVisible(const QPointF& point);
  void showAll();
  /// Coarseness of the picture; 0: there is none.
  int step() const { return this->Step; }

  /// Widget's point of an image point; for tests, too.
  Q_INVOKABLE QPointF toWidget(const QPointF& image) const { return this->Origin + image * this->Zoom; }
  Q_INVOKABLE QPointF toImage(const QPointF& widget) const { return (widget - this->Origin) / this->Zoom; }

signals:
  void picked(double x, double y);
  void moved(double dx, double dy); ///< by arrow keys
  void pointed(bool inside, double x, double y);

protected:
  void paintEvent(QPaintEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void leaveEvent(QEvent* event) override;

private:
  QPointF pointAt(const QPoint& position) const { return this->toImage(QPointF(position) + QPointF(0.5, 0.5)); }
  bool isInside(const QPointF& point) const;
  void zoomAt(const QPointF& widget, double factor);
  void paintImage(QPainter& painter) const;
  void paintGrid(QPainter& painter) const;
  void paintLine(QPainter& painter) const;
  void paintWords(QPainter& painter) const;
  void paintMark(QPainter& painter, const Mark& mark) const;

  QImage Image;
  QSize Size{ 640, 480 };
  int Step = 0;
  QString Message;
  std::vector<Mark> Marks;
  std::optional<Eigen::Vector3d> Line;
  QColor LineColor;
  double Zoom = 1; ///< widget pixels a pixel
  QPointF Origin;  ///< of the image, in the widget
  bool Whole = true;
  QPoint Pressed;
  QPoint LastPosition;
  bool Down = false; ///< a button is
  bool Panned = false;
};

} // namespace dgtk

#endif
