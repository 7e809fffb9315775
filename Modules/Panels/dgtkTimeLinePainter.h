// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTimeLinePainter_h
#define dgtkTimeLinePainter_h

#include "dgtkTimeLineRows.h"

class QColor;
class QPainter;
class QPalette;

namespace dgtk
{

/// Draws the time line's parts.
class TimeLinePainter
{
public:
  TimeLinePainter(QPainter& painter, const timeline::TimeLineRows& shown, const QPalette& palette);

  /// The frames' numbers and the marks of the scene's key frames.
  void paintHeader() const;
  /// `bar`: as it is drawn, null for none.
  void paintRow(const timeline::Row& row, const SequenceBar* bar, bool selected) const;
  void paintFrame(int frame, int height) const;
  /// Where a key would come.
  void paintDrag(const timeline::Drag& drag, const QString& text) const;

private:
  void paintKeys(const timeline::Row& row, const QColor& color, bool selected) const;
  void paintBar(const timeline::Row& row, const SequenceBar& bar) const;

  QPainter& Painter;
  const timeline::TimeLineRows& Shown;
  const QPalette& Palette;
};

} // namespace dgtk

#endif
