// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTruthPicture_h
#define dgtkTruthPicture_h

#include "dgtkLiveTruth.h"

#include <QImage>
#include <QString>
#include <QWidget>

namespace dgtk
{

/// Copies the pixels.
QImage imageOf(const LayerPicture& picture);

/// A layer's picture over a view, whose mouse it leaves alone. It is as large as the view; an image of another shape
/// is fitted into it.
class TruthPicture : public QWidget
{
  Q_OBJECT
  Q_PROPERTY(bool settled READ isSettled)
  Q_PROPERTY(QString caption READ caption)

public:
  explicit TruthPicture(QWidget* view);

  /// `size`: of the image, pixels; the picture may be coarser.
  void showPicture(const LivePicture& picture, const QSize& size, const QString& caption);
  void forgetPicture();
  /// Whether what is shown is the last word about the view as it is.
  bool isSettled() const { return this->Settled; }
  void setSettled(bool on) { this->Settled = on; }
  const QImage& image() const { return this->Image; }
  const QString& caption() const { return this->Caption; }

  /// Where an image of that size is in a widget of another.
  static QRectF fitted(const QSize& image, const QSize& widget);

protected:
  void paintEvent(QPaintEvent* event) override;

private:
  QImage Image;
  QSize Size;
  int Step = 1; ///< pixels of the view that are one of the image
  bool Settled = false;
  QString Caption;
};

} // namespace dgtk

#endif
