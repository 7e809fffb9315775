// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLegendBar_h
#define dgtkLegendBar_h

#include "dgtkPictureLoader.h"

#include <QWidget>

#include <optional>

class QLineEdit;
class QToolButton;

namespace dgtk
{

/// What the colours of a picture mean, drawn in one line: a ramp with numbers, names with their colours, the wheel of
/// a flow.
class LegendStrip : public QWidget
{
  Q_OBJECT

public:
  explicit LegendStrip(QWidget* parent);
  void setPicture(const ShownPointer& shown);
  /// Whether the ends of a ramp have their numbers, too.
  void setEnds(bool on);

protected:
  void paintEvent(QPaintEvent* event) override;
  bool event(QEvent* event) override;

private:
  void drawRamp(QPainter& painter) const;
  void drawSwatches(QPainter& painter) const;
  void drawWheel(QPainter& painter) const;
  QString longText() const;

  ShownPointer Shown;
  bool Ends = false;
};

/// The legend of a pane, with the ends of the range in fields where the picture has one.
class LegendBar : public QWidget
{
  Q_OBJECT

public:
  explicit LegendBar(QWidget* parent);
  void setPicture(const ShownPointer& shown, bool chosen);

protected:
  void resizeEvent(QResizeEvent* event) override;

signals:
  /// Low and high end as typed; nothing: the picture's own.
  void rangeAsked(const std::optional<dgtk::PictureRange>& range);

private:
  void ask();
  void showFields();

  LegendStrip* Strip;
  QLineEdit* Ends[2];
  QToolButton* Auto;
  PictureRange Shown;
  bool HasRange = false;
  bool HasLow = false;
};

} // namespace dgtk

#endif
