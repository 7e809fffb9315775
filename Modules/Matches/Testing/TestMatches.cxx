// SPDX-License-Identifier: BSD-3-Clause
// The table of pairs and a picture with marks, on no display.
#include "dgtkMatchPane.h"
#include "dgtkMatchTable.h"
#include "dgtkTestWidgets.h"
#include "dgtkTruthPanel.h"
#include "dgtkTruthPicture.h"

#include <QApplication>
#include <QImage>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace
{
using namespace dgtk;

const SparseView left{ "left", 3, 640, 480 };
const SparseView right{ "right", 4, 320, 240 };

MatchRow pairOf(double x, const SparseView& from = left, const SparseView& to = right)
{
  MatchRow row;
  row.from = from;
  row.to = to;
  row.match.from = { x, 0.25 };
  row.match.to.pixel = { x + 100.0625, 7 };
  row.match.to.visibility = VisibilityClass::Visible;
  row.match.hit = { 2, 0 };
  row.object = "mill";
  return row;
}

/// Of each pair its first coordinate, as the table and the list have them.
std::string textOf(const MatchTable& table)
{
  std::string text;
  for (std::size_t i = 0; i < table.pairs().size(); ++i)
  {
    const QString x = QString::number(table.pairs()[i].match.from.x());
    text += x.toStdString() + " ";
    EXPECT_EQ(table.item(int(i), 1)->toolTip(), x) << "the row is that of the pair";
  }
  EXPECT_EQ(table.rowCount(), int(table.pairs().size()));
  return text;
}

TEST(MatchTable, CellsOfAPair)
{
  test::needApplication();
  MatchTable table(nullptr);
  MatchRow nowhere = pairOf(2);
  nowhere.match.to = Correspondence();
  nowhere.object.clear();
  table.add({ pairOf(1.0 / 3), nowhere });
  const char* const cells[2][8] = { { "left@3", "0.333", "0.250", "right@4", "100.396", "7.000", "visible", "mill" },
    { "left@3", "2.000", "0.250", "right@4", "-", "-", "no surface", "" } };
  const char* const tips[2][8] = { { "left@3", "0.3333333333333333", "0.25", "right@4", "100.39583333333333", "7",
                                     "visible", "mill" },
    { "left@3", "2", "0.25", "right@4", "-", "-", "no surface", "" } };
  ASSERT_EQ(table.columnCount(), 8);
  for (int row = 0; row < 2; ++row)
  {
    for (int column = 0; column < 8; ++column)
    {
      EXPECT_EQ(table.item(row, column)->text(), cells[row][column]) << row << ' ' << column;
      EXPECT_EQ(table.item(row, column)->toolTip(), tips[row][column]) << row << ' ' << column;
    }
  }
}

TEST(MatchTable, EveryStepIsUndoneAndRedone)
{
  test::needApplication();
  MatchTable table(nullptr);
  int changes = 0;
  QObject::connect(&table, &MatchTable::pairsChanged, [&] { ++changes; });
  EXPECT_FALSE(table.canUndo() || table.canRedo());
  table.undo();
  table.redo();
  table.add({});
  table.removeSelected();
  table.clearAll();
  EXPECT_EQ(changes, 0) << "nothing happened";
  table.add({ pairOf(1), pairOf(2) });
  table.add({ pairOf(3) });
  table.add({ pairOf(4), pairOf(5), pairOf(6) });
  EXPECT_EQ(textOf(table), "1 2 3 4 5 6 ");
  EXPECT_EQ(changes, 3);
  table.setSelectionMode(QAbstractItemView::MultiSelection);
  for (const int row : { 4, 1, 3 })
  {
    table.selectRow(row);
  }
  table.removeSelected();
  EXPECT_EQ(textOf(table), "1 3 6 ");
  table.clearAll();
  EXPECT_EQ(textOf(table), "");
  const char* const states[] = { "", "1 2 ", "1 2 3 ", "1 2 3 4 5 6 ", "1 3 6 ", "" };
  for (int step = 5; step > 0; --step)
  {
    EXPECT_EQ(textOf(table), states[step]) << step;
    EXPECT_TRUE(table.canUndo());
    EXPECT_EQ(table.canRedo(), step < 5);
    table.undo();
  }
  EXPECT_EQ(textOf(table), "");
  EXPECT_FALSE(table.canUndo());
  for (int step = 1; step <= 5; ++step)
  {
    table.redo();
    EXPECT_EQ(textOf(table), states[step]) << step;
  }
  EXPECT_FALSE(table.canRedo());
  EXPECT_EQ(changes, 15);
  table.undo();
  table.undo();
  table.clearSelection();
  table.selectRow(0);
  QKeyEvent key(QEvent::KeyPress, Qt::Key_Delete, Qt::NoModifier);
  QApplication::sendEvent(&table, &key);
  EXPECT_EQ(textOf(table), "2 3 4 5 6 ");
  EXPECT_FALSE(table.canRedo()) << "another way was gone";
  table.forgetAll();
  EXPECT_EQ(textOf(table), "");
  EXPECT_FALSE(table.canUndo() || table.canRedo());
}

TEST(MatchTable, FilesHavePairsOfTheSameViewsTogether)
{
  test::needApplication();
  MatchTable table(nullptr);
  EXPECT_EQ(table.text(), "");
  table.add({ pairOf(1), pairOf(2, right, left), pairOf(3) });
  EXPECT_EQ(table.text(), "# from left@3 640x480\n# to right@4 320x240\n# x y x' y' class object\n"
                          "1 0.25 101.0625 7 1 2\n3 0.25 103.0625 7 1 2\n"
                          "# from right@4 320x240\n# to left@3 640x480\n# x y x' y' class object\n"
                          "2 0.25 102.0625 7 1 2\n");
}

class MatchPaneTable : public testing::Test
{
protected:
  void SetUp() override
  {
    test::needApplication();
    this->Pane = std::make_unique<MatchPane>(nullptr);
    this->Pane->resize(400, 300);
    this->Pane->setImageSize({ 100, 50 }); // four times as large: from (0, 50) to (400, 250)
    QObject::connect(
      this->Pane.get(), &MatchPane::picked, [this](double x, double y) { this->Picked.emplace_back(x, y); });
    QObject::connect(
      this->Pane.get(), &MatchPane::moved, [this](double x, double y) { this->Moved.emplace_back(x, y); });
    QObject::connect(this->Pane.get(), &MatchPane::pointed,
      [this](bool inside, double x, double y) {
        this->Pointed = { inside, x, y };
      });
  }
  void mouse(QEvent::Type type, const QPoint& at, Qt::MouseButton button = Qt::LeftButton)
  {
    test::sendMouse(*this->Pane, type, at, button);
  }
  void key(int key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) { test::sendKey(*this->Pane, key, modifiers); }
  void wheel(const QPointF& at, int steps) { test::sendWheel(*this->Pane, at, steps); }
  void expectPlace(double x, double y, double zoom)
  {
    const QPointF origin = this->Pane->toWidget({ 0, 0 });
    EXPECT_NEAR(origin.x(), x, 1e-9);
    EXPECT_NEAR(origin.y(), y, 1e-9);
    EXPECT_NEAR(this->Pane->toWidget({ 1, 0 }).x() - origin.x(), zoom, 1e-9);
  }

  using Points = std::vector<std::pair<double, double>>;
  std::unique_ptr<MatchPane> Pane;
  Points Picked;
  Points Moved;
  std::tuple<bool, double, double> Pointed;
};

TEST_F(MatchPaneTable, ClicksPickAndDragsPan)
{
  this->expectPlace(0, 50, 4);
  EXPECT_EQ(this->Pane->toImage({ 200, 150 }), QPointF(50, 25));
  this->mouse(QEvent::MouseButtonPress, { 40, 90 });
  this->mouse(QEvent::MouseButtonRelease, { 40, 90 });
  EXPECT_EQ(this->Picked, (Points{ { 10.125, 10.125 } })) << "the middle of the screen's pixel";
  this->mouse(QEvent::MouseButtonPress, { 40, 40 });
  this->mouse(QEvent::MouseButtonRelease, { 40, 40 });
  this->mouse(QEvent::MouseButtonPress, { 40, 90 }, Qt::RightButton);
  this->mouse(QEvent::MouseButtonRelease, { 40, 90 }, Qt::RightButton);
  EXPECT_EQ(this->Picked.size(), 1u) << "beside it, and by another button, nothing";
  this->mouse(QEvent::MouseMove, { 0, 49 });
  EXPECT_EQ(this->Pointed, std::tuple(false, 0.125, -0.125));
  this->mouse(QEvent::MouseMove, { 399, 249 });
  EXPECT_EQ(this->Pointed, std::tuple(true, 99.875, 49.875));
  QEvent leave(QEvent::Leave);
  QApplication::sendEvent(this->Pane.get(), &leave);
  EXPECT_EQ(this->Pointed, std::tuple(false, 0.0, 0.0));
  const int far = QApplication::startDragDistance();
  this->mouse(QEvent::MouseButtonPress, { 100, 100 });
  this->mouse(QEvent::MouseMove, { 100 + far - 1, 100 });
  this->expectPlace(0, 50, 4);
  this->mouse(QEvent::MouseMove, { 100 + far, 103 });
  this->mouse(QEvent::MouseMove, { 100 + far, 100 });
  this->mouse(QEvent::MouseButtonRelease, { 100 + far, 100 });
  this->expectPlace(far, 50, 4);
  EXPECT_EQ(this->Picked.size(), 1u) << "a drag picks nothing";
  this->Pane->resize(500, 300);
  this->expectPlace(far, 50, 4);
  this->mouse(QEvent::MouseButtonDblClick, { 100, 100 });
  this->mouse(QEvent::MouseButtonRelease, { 100, 100 });
  EXPECT_EQ(this->Picked.size(), 1u);
  this->expectPlace(0, 25, 5);
  this->Pane->resize(400, 300);
  this->Pane->grab(); // lays it out
  this->expectPlace(0, 50, 4);
}

TEST_F(MatchPaneTable, WheelAndKeys)
{
  const QPointF under = this->Pane->toImage({ 120, 140 });
  this->wheel({ 120, 140 }, 2);
  EXPECT_NEAR(this->Pane->toWidget({ 1, 0 }).x() - this->Pane->toWidget({ 0, 0 }).x(), 4 * std::exp(0.5), 1e-9);
  EXPECT_LT((this->Pane->toWidget(under) - QPointF(120, 140)).manhattanLength(), 1e-9);
  this->wheel({ 120, 140 }, -100);
  EXPECT_NEAR(this->Pane->toWidget({ 1, 0 }).x() - this->Pane->toWidget({ 0, 0 }).x(), 2, 1e-9) << "half of all";
  this->wheel({ 120, 140 }, 100);
  EXPECT_NEAR(this->Pane->toWidget({ 1, 0 }).x() - this->Pane->toWidget({ 0, 0 }).x(), 200, 1e-7);
  this->key(Qt::Key_0);
  this->expectPlace(0, 50, 4);
  for (const int plus : { Qt::Key_Plus, Qt::Key_Equal })
  {
    this->key(plus);
    const double zoom = 4 * std::exp(0.25);
    const QPointF middle = QRectF(QRect(0, 0, 400, 300)).center();
    this->expectPlace(middle.x() - 50 * zoom - (middle.x() - 200) / 4 * zoom,
      middle.y() - 25 * zoom - (middle.y() - 150) / 4 * zoom, zoom);
    this->key(Qt::Key_Minus);
    this->expectPlace(0, 50, 4);
  }
  this->key(Qt::Key_Left);
  this->key(Qt::Key_Right, Qt::ShiftModifier);
  this->key(Qt::Key_Up);
  this->key(Qt::Key_Down, Qt::ShiftModifier);
  EXPECT_EQ(this->Moved, (Points{ { -1, 0 }, { 0.1, 0 }, { 0, -1 }, { 0, 0.1 } }));
  // A point that is out of sight comes into the middle.
  this->wheel({ 0, 50 }, 4);
  this->Pane->ensureVisible({ 1, 1 });
  EXPECT_NEAR(this->Pane->toWidget({ 0, 0 }).x(), 0, 1e-9) << "it was in sight";
  this->Pane->ensureVisible({ 99, 200 });
  EXPECT_NEAR(this->Pane->toWidget({ 0, 0 }).x(), 0, 1e-9) << "it is not in the picture";
  this->Pane->ensureVisible({ 99, 40 });
  EXPECT_LT((this->Pane->toWidget({ 99, 40 }) - QRectF(this->Pane->rect()).center()).manhattanLength(), 1e-9);
  this->Pane->setImageSize({ 100, 50 });
  EXPECT_LT((this->Pane->toWidget({ 99, 40 }) - QRectF(this->Pane->rect()).center()).manhattanLength(), 1e-9)
    << "the same size";
  this->Pane->setImageSize({ 200, 50 });
  this->expectPlace(0, 100, 2);
}

TEST_F(MatchPaneTable, MarksAndLinesArePainted)
{
  const QColor empty(28, 28, 31);
  this->Pane->setMessage("-");
  const auto painted = [&] { return this->Pane->grab().toImage(); };
  EXPECT_EQ(painted().pixelColor(80, 130), empty);
  this->Pane->setLine(Eigen::Vector3d(0, 1, -20), QColor(0, 255, 0)); // y = 20: row 130 of the widget
  QImage image = painted();
  EXPECT_GT(image.pixelColor(80, 130).green(), 150);
  EXPECT_GT(image.pixelColor(395, 130).green(), 150);
  EXPECT_EQ(image.pixelColor(80, 126), empty);
  this->Pane->setLine(std::nullopt, QColor());
  EXPECT_EQ(painted().pixelColor(80, 130), empty);
  const auto reds = [&](const QRect& where)
  {
    const QImage now = painted();
    int count = 0;
    for (int y = where.top(); y <= where.bottom(); ++y)
    {
      for (int x = where.left(); x <= where.right(); ++x)
      {
        const QColor color = now.pixelColor(x, y);
        count += color.red() > 120 && color.green() < 80 ? 1 : 0;
      }
    }
    return count;
  };
  EXPECT_EQ(reds({ 0, 0, 400, 300 }), 0);
  this->Pane->setMarks({ { QPointF(20, 20), QColor(255, 0, 0), {}, false } }); // at (80, 130)
  const int small = reds({ 70, 120, 21, 21 });
  EXPECT_GT(small, 0);
  EXPECT_EQ(reds({ 79, 129, 2, 2 }), 0) << "its middle is free";
  EXPECT_EQ(reds({ 0, 0, 400, 300 }), small);
  this->Pane->setMarks({ { QPointF(20, 20), QColor(255, 0, 0), {}, true } });
  EXPECT_GT(reds({ 70, 120, 21, 21 }), 2 * small) << "the one that is looked at";
  this->Pane->setMarks({ { QPointF(20, 20), QColor(255, 0, 0), "7", false } });
  EXPECT_GT(reds({ 86, 110, 20, 20 }), 0) << "its number";
}

TEST_F(MatchPaneTable, PixelsThatAreLargeHaveAGrid)
{
  this->Pane->setMessage("-");
  const QColor empty(28, 28, 31);
  const auto zoom = [&] { return this->Pane->toWidget({ 1, 0 }).x() - this->Pane->toWidget({ 0, 0 }).x(); };
  const auto painted = [&](const QPointF& at) { return this->Pane->grab().toImage().pixelColor(at.toPoint()); };
  const auto brightest = [&](const QPointF& at) // lines may be rounded either way
  {
    int red = 0;
    for (const QPointF& beside : { QPointF(-1, -1), QPointF(0, 0), QPointF(1, 1) })
    {
      red = std::max(red, painted(at + beside).red());
    }
    return red;
  };
  this->wheel({ 0, 50 }, 5); // the picture's corner stays where it is
  ASSERT_NEAR(zoom(), 4 * std::exp(1.25), 1e-9);
  for (int k = 0; k < 20; ++k)
  {
    EXPECT_EQ(painted({ this->Pane->toWidget({ double(k), 0 }).x(), 75 }) == empty, k > 0) << "smaller than 14 pixels";
  }
  this->wheel({ 0, 50 }, 1);
  EXPECT_GT(brightest({ 4 * std::exp(1.5), 50 + 6 * std::exp(1.5) }), 40) << "larger than 14";
  this->wheel({ 0, 50 }, 5);
  ASSERT_NEAR(zoom(), 4 * std::exp(2.75), 1e-9);
  for (int k = 1; k < 6; ++k)
  {
    const double border = this->Pane->toWidget({ double(k), 0 }).x();
    const double middle = this->Pane->toWidget({ k + 0.5, 0 }).x();
    const double row = this->Pane->toWidget({ 0, 1.5 }).y();
    EXPECT_GT(brightest({ border, row }), 40) << k;
    EXPECT_EQ(painted({ middle, row }), empty) << k;
    EXPECT_EQ(painted({ border, 40 }), empty) << "above the picture";
  }
  for (int k = 1; k < 4; ++k)
  {
    const double column = this->Pane->toWidget({ 1.5, 0 }).x();
    EXPECT_GT(brightest({ column, this->Pane->toWidget({ 0, double(k) }).y() }), 40) << k;
    EXPECT_EQ(painted({ column, this->Pane->toWidget({ 0, k + 0.5 }).y() }), empty) << k;
  }
}

TEST(TruthPanel, SaysWhyNothingIsKnown)
{
  test::needApplication();
  TruthPanel panel(nullptr);
  PixelTruth truth;
  truth.frame = 7;
  truth.column = 3;
  truth.row = 4;
  truth.object = "of a pixel before";
  truth.message = "mill.ac: not found";
  panel.showTruth("left", truth, "m");
  EXPECT_EQ(panel.text().toStdString(), "View\tleft, frame 7\nPixel\tcolumn 3, row 4\nUnknown\tmill.ac: not found");
}

TEST(TruthPanel, NamesTheCameraOfEachMatchAndWhatRaysMeasure)
{
  test::needApplication();
  TruthPanel panel(nullptr);
  EXPECT_EQ(panel.text().toStdString(), "") << "its hint is no value";
  PixelTruth truth;
  truth.object = "mill";
  const LayerSpec match{ "match", PixelType::Float64, 2, "pixels", "", "nan", "where it is", Meaning::Point };
  const LayerSpec seen{ "match_class", PixelType::UInt8, 1, "class", "", "0", "", Meaning::Visibility };
  truth.values = { { "match_left_eye", match, { 1, 2 } }, { "match_right", match, { 3, 4 } },
    { "match_left_eye_class", seen, { 1 } }, { "match_right_class", seen, { 4 } } };
  truth.layers.resize(1);
  truth.layers[0].depth = 5;
  for (const bool isLinear : { true, false })
  {
    truth.isLinear = isLinear;
    panel.showTruth("left", truth, {});
    const std::string text = panel.text().toStdString();
    EXPECT_NE(text.find("match left_eye, pixels\t1\t2\tvisible\nmatch right, pixels\t3\t4\toutside the image\n"),
      std::string::npos)
      << text;
    EXPECT_EQ(text.find("\tdepth 5\t") != std::string::npos, isLinear) << text;
    EXPECT_EQ(text.find("\tdistance 5\t") != std::string::npos, !isLinear) << text;
  }
  panel.forgetTruth();
  EXPECT_EQ(panel.text().toStdString(), "");
}

TEST(TruthPicture, IsAsLargeAsItsWidgetAllows)
{
  EXPECT_EQ(TruthPicture::fitted({ 100, 50 }, { 400, 300 }), QRectF(0, 50, 400, 200));
  EXPECT_EQ(TruthPicture::fitted({ 100, 200 }, { 400, 300 }), QRectF(125, 0, 150, 300));
  EXPECT_EQ(TruthPicture::fitted({ 800, 600 }, { 400, 300 }), QRectF(0, 0, 400, 300));
  LayerPicture picture;
  picture.width = 3; // rows of 9 bytes, which images keep at multiples of 4
  picture.height = 2;
  for (std::uint8_t i = 0; i < 6; ++i)
  {
    picture.pixels.push_back({ i, std::uint8_t(10 * i), std::uint8_t(40 * i) });
  }
  const QImage image = imageOf(picture);
  for (int i = 0; i < 6; ++i)
  {
    EXPECT_EQ(image.pixelColor(i % 3, i / 3), QColor(i, 10 * i, 40 * i));
  }
}

TEST_F(MatchPaneTable, ThePictureEndsAtItsFrameAndMarksDoNot)
{
  LivePicture live;
  live.step = 3; // 34 x 17 of it are 102 x 51 of the view
  live.picture.width = 34;
  live.picture.height = 17;
  live.picture.pixels.assign(34 * 17, { 255, 255, 255 });
  this->Pane->setPicture(live);
  this->Pane->setMarks({ { QPointF(50, 0), QColor(255, 0, 0), {}, false } }); // at (200, 50)
  const QImage image = this->Pane->grab().toImage();
  const QColor empty(28, 28, 31);
  EXPECT_EQ(image.pixelColor(100, 48), empty);
  EXPECT_EQ(image.pixelColor(100, 52), QColor(255, 255, 255));
  EXPECT_EQ(image.pixelColor(100, 248), QColor(255, 255, 255));
  EXPECT_EQ(image.pixelColor(100, 252), empty) << "the picture's last row is half outside";
  const QColor below = image.pixelColor(100, 250);
  EXPECT_NE(below, empty) << "the frame";
  EXPECT_NE(below, QColor(255, 255, 255));
  int red = 0;
  for (int y = 38; y < 49; ++y)
  {
    red += image.pixelColor(200, y).red() > 120 && image.pixelColor(200, y).green() < 80 ? 1 : 0;
  }
  EXPECT_GT(red, 0) << "of the mark, above the frame";
}
} // namespace
