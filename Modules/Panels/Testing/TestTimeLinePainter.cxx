// SPDX-License-Identifier: BSD-3-Clause
// The time line's parts as they are painted: which pixels have which colour; on no display.
#include "dgtkTimeLinePainter.h"

#include "dgtkTestWidgets.h"

#include <QImage>
#include <QPainter>
#include <QPalette>

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <vector>

namespace
{
using namespace dgtk;
using namespace dgtk::timeline;

using Columns = std::vector<int>;

constexpr int width = 600;
constexpr int height = 100;
const QColor bar(86, 150, 130);

class TimeLinePicture : public testing::Test
{
protected:
  TimeLinePicture()
  {
    test::needApplication();
    this->Shown.width = width;
    this->Colors.setColor(QPalette::Base, QColor(250, 251, 252));
    this->Colors.setColor(QPalette::Highlight, QColor(10, 20, 200));
    this->Colors.setColor(QPalette::HighlightedText, QColor(255, 255, 0));
    this->Colors.setColor(QPalette::Text, QColor(1, 2, 3));
    this->Colors.setColor(QPalette::Dark, QColor(90, 80, 70));
    this->Colors.setColor(QPalette::Mid, QColor(140, 150, 160));
    this->Colors.setColor(QPalette::Midlight, QColor(210, 220, 230));
    this->Colors.setColor(QPalette::Button, QColor(230, 240, 220));
    this->Colors.setColor(QPalette::ButtonText, QColor(30, 40, 50));
    this->Colors.setColor(QPalette::ToolTipBase, QColor(255, 220, 160));
  }
  void paint(const std::function<void(const TimeLinePainter&)>& parts)
  {
    this->Image = QImage(width, height, QImage::Format_RGB32);
    this->Image.fill(Qt::magenta);
    QPainter painter(&this->Image);
    parts(TimeLinePainter(painter, this->Shown, this->Colors));
  }
  void paintRow(const Row& row, const SequenceBar* its, bool selected = false)
  {
    this->paint([&](const TimeLinePainter& parts) { parts.paintRow(row, its, selected); });
  }
  /// The columns whose pixel in a line has a colour.
  Columns columns(int y, const QColor& color) const
  {
    Columns found;
    for (int x = 0; x < width; ++x)
    {
      if (this->Image.pixel(x, y) == color.rgb())
      {
        found.push_back(x);
      }
    }
    return found;
  }
  QColor color(QPalette::ColorRole role) const { return this->Colors.color(role); }

  TimeLineRows Shown;
  QPalette Colors;
  QImage Image;
};

/// All columns of the cells, from `first` in steps, that are in sight.
Columns every(double first, double step)
{
  Columns columns;
  for (int i = 0; first + i * step < width; ++i)
  {
    if (const double x = first + i * step; x >= namesWidth)
    {
      columns.push_back(int(x));
    }
  }
  return columns;
}

TEST_F(TimeLinePicture, ALoopsTurnsAreMarkedToTheEnd)
{
  Row row;
  row.height = rowHeight + barHeight;
  SequenceBar its;
  its.start = 10;
  its.length = 5.5;
  its.loop = true;
  const int y = headerHeight + rowHeight + 5;
  for (const int scrolled : { 0, 7, 12 * 30, 12 * 60, 12 * 1000 }) // the turn at 59.5 is at the left edge
  {
    this->Shown.scrolled.setX(scrolled);
    this->paintRow(row, &its);
    const double begin = namesWidth + 6 + 12 * its.start - scrolled;
    EXPECT_EQ(this->columns(y, bar.darker(120)), every(begin + 2 * 66, 66)) << scrolled;
    const Columns later = this->columns(y, bar.lighter(150));
    const double end = std::max(begin + 66, double(namesWidth));
    for (int below = 0; below < barHeight && scrolled == 12 * 60; ++below)
    {
      const bool there = below >= 3 && below < 9; // from the row's last line, which the bar begins on
      EXPECT_EQ(this->Image.pixel(width - 20, headerHeight + rowHeight + below) == bar.lighter(150).rgb(), there)
        << below;
    }
    EXPECT_EQ(later.size() + this->columns(y, bar.darker(120)).size(), std::size_t(width - end)) << scrolled;
  }
  this->Shown.scrolled.setX(0);
  const int begin = namesWidth + 6 + 120;
  for (const auto& [length, marks] : { std::pair(0.25, false), { 0.5, true } }) // 3 pixels: too narrow
  {
    its.length = length;
    this->paintRow(row, &its);
    EXPECT_EQ(this->columns(y, bar.darker(120)), marks ? every(begin + 12, 6) : Columns()) << length;
  }
  its.length = 0.01;
  this->paintRow(row, &its);
  EXPECT_EQ(this->columns(y, bar.darker(150)), (Columns{ begin, begin + 1 })) << "two pixels at least";
  for (const double length : { 5.5, std::numeric_limits<double>::infinity() })
  {
    its.length = length;
    its.loop = std::isinf(length); // without an end there is none to begin again at
    this->paintRow(row, &its);
    EXPECT_EQ(this->columns(y, bar.darker(120)), Columns());
    EXPECT_EQ(this->columns(y, bar.lighter(150)), Columns());
    const int end = std::isinf(length) ? width : begin + 66;
    const Columns edges = this->columns(y, bar.darker(150));
    EXPECT_EQ(edges, (Columns{ begin, end - 1 }));
    // Two pixels of the handle of its speed are no body.
    EXPECT_EQ(this->columns(y, bar).size(), std::size_t(end - begin - (std::isinf(length) ? 2 : 4)));
    EXPECT_EQ(this->columns(headerHeight + rowHeight - 2, bar.darker(150)), Columns()) << "above it";
    EXPECT_EQ(this->columns(headerHeight + rowHeight - 1, bar.darker(150)).size(), std::size_t(end - begin));
    EXPECT_EQ(
      this->columns(headerHeight + rowHeight + barHeight - 4, bar.darker(150)).size(), std::size_t(end - begin));
  }
}

TEST_F(TimeLinePicture, ABarsNameIsCutWithIt)
{
  Row row;
  row.height = rowHeight + barHeight;
  SequenceBar its;
  its.name = QString(100, 'M').toStdString();
  its.length = 10;
  this->paintRow(row, &its);
  const int y = headerHeight + rowHeight + 5;
  Columns inked;
  for (int x = 0; x < width; ++x)
  {
    const bool ink = this->Image.pixelColor(x, y) != bar && x > namesWidth + 6 && x < namesWidth + 6 + 120 - 3;
    inked.insert(inked.end(), ink ? 1 : 0, x);
  }
  ASSERT_FALSE(inked.empty());
  EXPECT_GE(inked.front(), namesWidth + 6 + 5);
  EXPECT_LT(inked.back(), namesWidth + 6 + 120 - 6);
  EXPECT_EQ(this->columns(y, this->color(QPalette::Base)).front(), 0) << "names' part";
  EXPECT_EQ(this->columns(y, this->color(QPalette::Base)).back(), width - 1);
}

TEST_F(TimeLinePicture, KeysHaveMarksAndLinesBetweenThem)
{
  Row row;
  row.top = 10;
  row.height = rowHeight;
  row.keys = { 4, 8, 12, 20 };
  row.kinds = { Interpolation::Step, Interpolation::Linear, Interpolation::Smooth, Interpolation::Linear };
  this->Shown.scrolled = QPoint(24, 4);
  const int top = headerHeight + 6;
  const auto middle = [](int frame) { return namesWidth + 6 + 12 * frame - 24; };
  for (const bool selected : { false, true })
  {
    this->paintRow(row, nullptr, selected);
    const QColor back = this->color(selected ? QPalette::Highlight : QPalette::Base);
    const QColor mark = this->color(selected ? QPalette::HighlightedText : QPalette::Text);
    const QColor line = selected ? mark : this->color(QPalette::Dark);
    for (const auto& [x, there] : { std::pair(middle(6) + 3, false), { middle(10) + 3, true }, { middle(16) + 3, true },
           { middle(22) + 3, false } })
    {
      for (int y = -3; y < 3; ++y)
      {
        const bool on = there && (y == -1 || y == 0);
        EXPECT_EQ(this->Image.pixelColor(x, top + rowHeight / 2 + y), on ? line : back) << x << ' ' << y;
      }
    }
    const auto at = [&](int frame, int dx, int dy)
    { return this->Image.pixelColor(middle(frame) + dx, top + rowHeight / 2 + dy); };
    for (const int frame : row.keys)
    {
      EXPECT_EQ(at(frame, 0, -3), mark) << frame;
      EXPECT_EQ(at(frame, 0, 2), mark) << frame;
      EXPECT_EQ(at(frame, -3, -3) == mark, frame == 4) << "a square has corners";
      EXPECT_EQ(at(frame, 2, 2) == mark, frame == 4);
      EXPECT_EQ(at(frame, -1, -5) != back, frame == 12) << "a rhomb is higher";
      EXPECT_EQ(at(frame, 0, 4) != back, frame == 12);
      EXPECT_EQ(at(frame, -5, -4), back);
    }
    // The line of each frame, and the row's last.
    EXPECT_EQ(this->columns(top + 1, this->color(QPalette::Midlight)), every(namesWidth, 12));
    EXPECT_EQ(this->columns(top + rowHeight - 1, this->color(QPalette::Mid)).size(), std::size_t(width));
    EXPECT_EQ(this->columns(top - 1, Qt::magenta).size(), std::size_t(width));
    EXPECT_EQ(this->columns(top + rowHeight, Qt::magenta).size(), std::size_t(width));
  }
}

TEST_F(TimeLinePicture, TheHeaderCountsFramesAndMarksTheScenesKeys)
{
  this->Shown.keys = { 3, 17 };
  for (const int scrolled : { 0, 5, 12 * 3, 12 * 12 + 5 })
  {
    this->Shown.scrolled.setX(scrolled);
    this->paint([](const TimeLinePainter& parts) { parts.paintHeader(); });
    EXPECT_EQ(
      this->columns(headerHeight - headerMarks, this->color(QPalette::ButtonText)), every(namesWidth - scrolled, 60));
    const Columns marked = this->columns(headerHeight - 6, QColor(214, 140, 20));
    for (int frame = 0; frame < 30; ++frame)
    {
      const int x = namesWidth + 12 * frame + 6 - scrolled;
      const bool there = (frame == 3 || frame == 17) && x >= namesWidth;
      EXPECT_EQ(std::count(marked.begin(), marked.end(), x), there ? 1 : 0) << frame;
    }
    EXPECT_EQ(this->columns(headerHeight - 1, this->color(QPalette::Button)).front(), 0);
    EXPECT_EQ(this->columns(headerHeight, Qt::magenta).size(), std::size_t(width));
    Columns written;
    for (int x = 0; x < width; ++x)
    {
      bool ink = false;
      for (int y = 0; y < headerHeight - headerMarks; ++y)
      {
        ink = ink || this->Image.pixelColor(x, y) != this->color(QPalette::Button);
      }
      written.insert(written.end(), ink ? 1 : 0, (x - namesWidth + scrolled) / 12);
    }
    EXPECT_FALSE(written.empty());
    EXPECT_TRUE(std::all_of(written.begin(), written.end(), [](int frame) { return frame % 5 < 2; }))
      << "behind its line";
  }
}

TEST_F(TimeLinePicture, TheFrameIsAColumnUnlessItIsLeftOfTheCells)
{
  const QColor red(220, 50, 50);
  for (const auto& [frame, scrolled, there] :
    { std::tuple(7, 0, true), { 7, 7 * 12, true }, { 7, 7 * 12 + 1, false }, { 0, 0, true } })
  {
    this->Shown.scrolled.setX(scrolled);
    this->paint([frame = frame](const TimeLinePainter& parts) { parts.paintFrame(frame, 60); });
    const int middle = namesWidth + 12 * frame - scrolled + 6;
    for (const int y : { 0, 59 })
    {
      EXPECT_EQ(this->columns(y, red), there ? Columns{ middle } : Columns()) << frame << ' ' << scrolled;
      EXPECT_EQ(this->columns(y, this->color(QPalette::Mid)), Columns{ namesWidth - 1 });
      EXPECT_EQ(this->columns(y, Qt::magenta).size(), std::size_t(width - 1 - (there ? 12 : 0)));
    }
    EXPECT_EQ(this->columns(61, Qt::magenta).size(), std::size_t(width));
  }
}

TEST_F(TimeLinePicture, WhereAKeyWouldComeHasItsTextBesideIt)
{
  this->Shown.rows.resize(2);
  this->Shown.rows[1].top = 20;
  for (const Target target : { Target::Key, Target::SceneKey })
  {
    const bool ofScene = target == Target::SceneKey;
    const int y = ofScene ? headerHeight - 6 : headerHeight + 20 + rowHeight / 2;
    for (const int to : { 5, 38 })
    {
      Drag drag;
      drag.from.target = target;
      drag.from.row = 1;
      drag.to = to;
      this->paint([&](const TimeLinePainter& parts) { parts.paintDrag(drag, "MMMMM"); });
      const int middle = namesWidth + 12 * to + 6;
      EXPECT_EQ(this->Image.pixelColor(middle, y), ofScene ? QColor(214, 140, 20) : QColor(220, 50, 50));
      const Columns box = this->columns(y - 8, this->color(QPalette::ToolTipBase));
      ASSERT_FALSE(box.empty());
      EXPECT_EQ(to == 5 ? box.front() : box.back(), to == 5 ? middle + 10 : middle - 10) << "left of it at the edge";
      EXPECT_EQ(this->columns(y - 11, Qt::magenta).size(), std::size_t(width));
    }
  }
}

TEST_F(TimeLinePicture, TheTextOfAKeyIsRightOfItAsLongAsItFits)
{
  Drag drag;
  drag.from.target = Target::SceneKey;
  drag.to = 5;
  const auto box = [&]
  {
    this->paint([&](const TimeLinePainter& parts) { parts.paintDrag(drag, "MMMMM"); });
    return this->columns(headerHeight - 14, this->color(QPalette::ToolTipBase));
  };
  const Columns right = box();
  this->Shown.width = right.back() + 1;
  EXPECT_EQ(box(), right);
  this->Shown.width = right.back();
  EXPECT_EQ(box().back(), namesWidth + 12 * 5 + 6 - 10);
}

} // namespace
