// SPDX-License-Identifier: BSD-3-Clause
// A picture and its legend as they are painted and handled, on no display.
#include "dgtkLegendBar.h"
#include "dgtkPictureView.h"

#include "dgtkTestWidgets.h"

#include <QApplication>
#include <QFontMetrics>
#include <QHelpEvent>
#include <QImage>
#include <QKeyEvent>
#include <QLineEdit>
#include <QLocale>
#include <QMouseEvent>
#include <QToolButton>
#include <QToolTip>
#include <QWheelEvent>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

namespace
{
using namespace dgtk;

QColor toQt(Rgb color) { return { color[0], color[1], color[2] }; }

std::shared_ptr<PictureValues> makeValues(int width, int height, int step = 1)
{
  auto picture = std::make_shared<PictureValues>();
  picture->info = { "npy", PixelType::UInt8, 1, width, height };
  picture->window = { 0, 0, width, height };
  picture->step = step;
  picture->values = Rows(PixelType::UInt8, 1, (width + step - 1) / step, 0, (height + step - 1) / step);
  return picture;
}

/// A picture of which every step-th pixel is there; its colours say where: red the column, green the row.
std::shared_ptr<ShownPicture> makeShown(int width, int height, int step = 1)
{
  const std::shared_ptr<PictureValues> picture = makeValues(width, height, step);
  auto shown = std::make_shared<ShownPicture>();
  shown->ask.key = { "left", 3, "depth" };
  for (int row = 0; row < picture->rows(); ++row)
  {
    for (int column = 0; column < picture->columns(); ++column)
    {
      shown->colors.pixels.push_back(0xff000000u | unsigned(column % 40 * 6) << 16 | unsigned(row % 40 * 6) << 8);
    }
  }
  shown->picture = picture;
  return shown;
}

class PictureViewTable : public testing::Test
{
protected:
  void SetUp() override
  {
    test::needApplication();
    this->View = std::make_unique<PictureView>(this->Sync, nullptr);
    this->View->resize(200, 120);
    this->Sync.area = { 200, 120 };
    this->Sync.zoom.fit({ 40, 20 }, this->Sync.area);
    this->View->showPicture(makeShown(40, 20));
  }
  void mouse(QEvent::Type type, const QPoint& at, Qt::MouseButton button = Qt::LeftButton)
  {
    test::sendMouse(*this->View, type, at, button);
  }
  void key(int key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) { test::sendKey(*this->View, key, modifiers); }
  void wheel(const QPointF& at, int steps) { test::sendWheel(*this->View, at, steps); }
  QImage painted() { return this->View->grab().toImage(); }
  void expectCenter(double x, double y)
  {
    EXPECT_NEAR(this->Sync.zoom.center().x(), x, 1e-9);
    EXPECT_NEAR(this->Sync.zoom.center().y(), y, 1e-9);
  }

  PictureSync Sync;
  std::unique_ptr<PictureView> View;
};

TEST_F(PictureViewTable, TheMouseReadsPansAndZooms)
{
  const double scale = this->Sync.zoom.scale();
  const auto at = [&](double x, double y) { return QPointF(100 + (x - 20) * scale, 60 + (y - 10) * scale).toPoint(); };
  EXPECT_EQ(this->View->imageSize(), Eigen::Vector2d(40, 20));
  EXPECT_EQ(this->View->widgetPoint({ 20, 10 }), QPointF(100, 60));
  int activated = 0;
  int maximized = 0;
  int zooms = 0;
  QObject::connect(this->View.get(), &PictureView::activated, [&] { ++activated; });
  QObject::connect(this->View.get(), &PictureView::maximizeAsked, [&] { ++maximized; });
  QObject::connect(&this->Sync, &PictureSync::zoomChanged, [&] { ++zooms; });
  this->mouse(QEvent::MouseMove, at(7.5, 3.5), Qt::NoButton);
  EXPECT_EQ(this->Sync.cursor(), QPoint(7, 3));
  this->mouse(QEvent::MouseMove, QPoint(0, 0), Qt::NoButton);
  EXPECT_EQ(this->Sync.cursor(), QPoint(7, 3)) << "beside the picture the last one stays";
  this->mouse(QEvent::MouseMove, at(39.5, 19.5), Qt::NoButton);
  EXPECT_EQ(this->Sync.cursor(), QPoint(39, 19));
  this->expectCenter(20, 10);
  EXPECT_TRUE(this->Sync.fitting);
  EXPECT_EQ(zooms, 0);
  for (const Qt::MouseButton button : { Qt::LeftButton, Qt::MiddleButton, Qt::RightButton })
  {
    this->Sync.zoom.fit({ 40, 20 }, this->Sync.area);
    this->Sync.fitting = true;
    activated = zooms = 0;
    const int far = QApplication::startDragDistance();
    this->mouse(QEvent::MouseButtonPress, { 100, 60 }, button);
    EXPECT_EQ(activated, 1);
    this->mouse(QEvent::MouseMove, { 100 + far - 1, 60 }, button);
    this->expectCenter(20, 10);
    EXPECT_TRUE(this->Sync.fitting);
    this->mouse(QEvent::MouseMove, { 100 + far, 60 }, button);
    const bool pans = button != Qt::RightButton;
    this->expectCenter(20 - (pans ? far / scale : 0), 10);
    EXPECT_EQ(this->Sync.fitting, !pans);
    this->mouse(QEvent::MouseMove, { 100 + far, 62 }, button);
    this->expectCenter(20 - (pans ? far / scale : 0), 10 - (pans ? 2 / scale : 0));
    EXPECT_EQ(zooms, pans ? 2 : 0);
    this->mouse(QEvent::MouseButtonRelease, { 100 + far, 62 }, button);
    this->mouse(QEvent::MouseMove, { 0, 62 }, Qt::NoButton);
    EXPECT_EQ(zooms, pans ? 2 : 0);
    this->mouse(QEvent::MouseButtonDblClick, { 100, 60 }, button);
  }
  EXPECT_EQ(maximized, 1) << "by the left button";
  this->Sync.zoom.fit({ 40, 20 }, this->Sync.area);
  this->Sync.fitting = true;
  const Eigen::Vector2d under = this->Sync.zoom.toImage({ 150, 80 }, this->Sync.area);
  this->wheel({ 150, 80 }, 2);
  EXPECT_NEAR(this->Sync.zoom.scale(), scale * std::exp(0.4), 1e-9);
  EXPECT_LT((this->Sync.zoom.toImage({ 150, 80 }, this->Sync.area) - under).norm(), 1e-9);
  EXPECT_FALSE(this->Sync.fitting);
  EXPECT_EQ(this->Sync.cursor(), QPoint(int(under.x()), int(under.y())));
}

TEST_F(PictureViewTable, KeysMoveTheCrosshairAndThePicture)
{
  const double scale = this->Sync.zoom.scale();
  this->key(Qt::Key_Right);
  EXPECT_EQ(this->Sync.cursor(), QPoint(20, 10)) << "it begins in the middle";
  this->key(Qt::Key_Right);
  EXPECT_EQ(this->Sync.cursor(), QPoint(21, 10));
  this->key(Qt::Key_Down, Qt::ShiftModifier);
  EXPECT_EQ(this->Sync.cursor(), QPoint(21, 19)) << "ten, no farther than the last row";
  this->key(Qt::Key_Up);
  EXPECT_EQ(this->Sync.cursor(), QPoint(21, 18));
  this->key(Qt::Key_Left, Qt::ShiftModifier);
  EXPECT_EQ(this->Sync.cursor(), QPoint(11, 18));
  this->key(Qt::Key_Left, Qt::ShiftModifier);
  this->key(Qt::Key_Left, Qt::ShiftModifier);
  EXPECT_EQ(this->Sync.cursor(), QPoint(0, 18));
  EXPECT_TRUE(this->Sync.fitting);
  const double x = this->Sync.zoom.center().x();
  EXPECT_NEAR(x, 20, 1) << "the first column is brought into sight";
  this->key(Qt::Key_Right, Qt::ControlModifier);
  EXPECT_EQ(this->Sync.cursor(), QPoint(0, 18));
  EXPECT_FALSE(this->Sync.fitting);
  this->expectCenter(x + 40 / scale, 10);
  this->key(Qt::Key_Down, Qt::ControlModifier);
  this->expectCenter(x + 40 / scale, 10 + 40 / scale);
  this->key(Qt::Key_Left, Qt::ControlModifier);
  this->key(Qt::Key_Up, Qt::ControlModifier);
  this->expectCenter(x, 10);
  // The crosshair is brought into sight.
  this->Sync.zoom.zoomTo(20, { 100, 60 }, this->Sync.area);
  int zooms = 0;
  QObject::connect(&this->Sync, &PictureSync::zoomChanged, [&] { ++zooms; });
  this->key(Qt::Key_Up);
  EXPECT_EQ(this->Sync.cursor(), QPoint(0, 17));
  EXPECT_EQ(zooms, 1);
  const Eigen::Vector2d there = this->Sync.zoom.toWidget({ 0.5, 17.5 }, this->Sync.area);
  EXPECT_TRUE(there.x() >= 0 && there.x() <= 200 && there.y() >= 0 && there.y() <= 120) << there.transpose();
  this->key(Qt::Key_Up);
  EXPECT_EQ(zooms, 1) << "it was in sight";
  this->View->showPicture(nullptr);
  this->key(Qt::Key_Down);
  EXPECT_EQ(this->Sync.cursor(), QPoint(0, 16)) << "without a picture";
}

TEST_F(PictureViewTable, DetailIsAskedForWhereItCanBeSeen)
{
  struct Asked
  {
    PixelRect window;
    int step;
  };
  std::vector<Asked> asked;
  QObject::connect(this->View.get(), &PictureView::detailWanted,
    [&](const PixelRect& window, int step) {
      asked.push_back({ window, step });
    });
  this->Sync.zoom.fit({ 4000, 2000 }, this->Sync.area);
  this->View->showPicture(makeShown(4000, 2000));
  EXPECT_TRUE(asked.empty()) << "all is there";
  this->View->showPicture(makeShown(4000, 2000, 8));
  EXPECT_TRUE(asked.empty()) << "a pixel of the screen has more than eight";
  this->Sync.zoom.zoomTo(0.125, { 100, 60 }, this->Sync.area);
  this->Sync.changeZoom();
  EXPECT_TRUE(asked.empty());
  this->Sync.zoom.zoomTo(0.4, { 100, 60 }, this->Sync.area);
  this->Sync.changeZoom();
  ASSERT_EQ(asked.size(), 1u);
  EXPECT_EQ(asked[0].step, 2) << "two and a half";
  EXPECT_TRUE(asked[0].window == (PixelRect{ 1750, 850, 500, 300 })) << asked[0].window.x << ' ' << asked[0].window.y;
  auto detail = makeShown(4000, 2000, 2);
  detail->ask.window = asked[0].window;
  detail->ask.step = 2;
  this->View->showDetail(detail);
  EXPECT_EQ(this->View->detail(), detail);
  this->Sync.changeZoom();
  EXPECT_EQ(asked.size(), 1u) << "it is there";
  this->Sync.zoom.zoomTo(3, { 100, 60 }, this->Sync.area);
  this->Sync.changeZoom();
  ASSERT_EQ(asked.size(), 2u);
  EXPECT_EQ(asked[1].step, 1);
  EXPECT_EQ(asked[1].window.width, 68) << "200 / 3 and what is cut at its ends";
  this->Sync.zoom.zoomTo(1, { 100, 60 }, this->Sync.area);
  this->Sync.zoom.pan({ 1e9, 1e9 });
  this->Sync.changeZoom();
  ASSERT_EQ(asked.size(), 3u);
  EXPECT_TRUE(asked[2].window == (PixelRect{ 0, 0, 100, 60 })) << "no more than there is";
  // Of another picture there is no detail yet.
  auto other = makeShown(4000, 2000, 8);
  other->ask.key.frame = 4;
  this->View->showDetail(other);
  EXPECT_EQ(this->View->detail(), detail) << "it does not belong here";
  this->View->showPicture(other);
  EXPECT_EQ(this->View->detail(), nullptr);
}

TEST_F(PictureViewTable, PixelsAreReadWhereTheyAreExact)
{
  EXPECT_EQ(this->View->pictureAt({ 3, 3 }), this->View->shown()->picture.get());
  auto part = makeShown(40, 20);
  const std::shared_ptr<PictureValues> values = makeValues(40, 20);
  values->window = { 10, 5, 8, 6 };
  part->picture = values;
  this->View->showDetail(part);
  EXPECT_EQ(this->View->pictureAt({ 3, 3 }), this->View->shown()->picture.get());
  EXPECT_EQ(this->View->pictureAt({ 12, 7 }), values.get());
}

TEST_F(PictureViewTable, WhatIsPainted)
{
  const double scale = this->Sync.zoom.scale();
  const auto colorAt = [&](const QImage& image, double x, double y)
  { return image.pixelColor(QPointF(100 + (x - 20) * scale, 60 + (y - 10) * scale).toPoint()); };
  QImage image = this->painted();
  EXPECT_EQ(image.pixelColor(1, 1), QColor(28, 28, 31)) << "beside it";
  for (const auto& [x, y] : { std::pair(0, 0), std::pair(39, 19), std::pair(12, 7) })
  {
    EXPECT_EQ(colorAt(image, x + 0.5, y + 0.5), QColor(x * 6, y * 6, 0)) << x << ' ' << y;
  }
  this->Sync.setCursor(QPoint(12, 7));
  image = this->painted();
  const double arm = std::max(6.0, scale / 2) + 7;
  EXPECT_EQ(image.pixelColor(int(100 + (12.5 - 20) * scale + arm), int(60 + (7.5 - 10) * scale)), QColor(Qt::white));
  EXPECT_EQ(image.pixelColor(int(100 + (12.5 - 20) * scale - arm), int(60 + (7.5 - 10) * scale)), QColor(Qt::white));
  EXPECT_EQ(image.pixelColor(int(100 + (12.5 - 20) * scale), int(60 + (7.5 - 10) * scale + arm)), QColor(Qt::white));
  const QColor corner = image.pixelColor(6, 112);
  this->View->setReadOut("12, 7: 3");
  EXPECT_NE(this->painted().pixelColor(6, 112), corner) << "the numbers in their corner";
  this->Sync.setCursor(std::nullopt);
  EXPECT_EQ(this->painted().pixelColor(6, 112), corner);
  this->View->setActive(true);
  EXPECT_NE(this->painted().pixelColor(100, 1), QColor(28, 28, 31)) << "a frame";
  this->View->setActive(false);
  EXPECT_EQ(this->painted().pixelColor(100, 1), QColor(28, 28, 31));
  // From 12 units a pixel on there are borders.
  for (const auto& [size, hasGrid] : { std::pair(11.0, false), std::pair(13.0, true) })
  {
    this->Sync.zoom.zoomTo(size, { 100, 60 }, this->Sync.area);
    const QPointF border = this->View->widgetPoint({ 20, 10.5 });
    const QColor beside = this->painted().pixelColor(border.toPoint() + QPoint(4, 0));
    const QColor on = this->painted().pixelColor(border.toPoint());
    EXPECT_EQ(on != beside && on != QColor(19 * 6, 60, 0), hasGrid) << size;
  }
  auto failed = std::make_shared<ShownPicture>();
  failed->error = "it is damaged";
  this->View->showPicture(failed);
  EXPECT_EQ(this->View->toolTip(), "it is damaged");
  EXPECT_EQ(this->View->imageSize(), Eigen::Vector2d(0, 0));
  EXPECT_EQ(this->painted().pixelColor(1, 1), QColor(28, 28, 31));
}

/// A strip with a legend, as wide as is said.
class LegendTable : public testing::Test
{
protected:
  void SetUp() override { test::needApplication(); }
  static QImage painted(const std::shared_ptr<ShownPicture>& shown, int width, bool ends = false)
  {
    LegendStrip strip(nullptr);
    strip.resize(width, 20);
    strip.setPicture(shown);
    strip.setEnds(ends);
    return strip.grab().toImage();
  }
  static std::shared_ptr<ShownPicture> ramp()
  {
    auto shown = makeShown(4, 4);
    const std::shared_ptr<PictureValues> picture = makeValues(4, 4);
    picture->info.type = PixelType::Float32;
    picture->layer.spec.meaning = Meaning::InverseDepth;
    shown->picture = picture;
    shown->colors.legend.kind = PictureLegend::Kind::Ramp;
    shown->colors.legend.hasRange = true;
    shown->colors.legend.range = { 2, 4 };
    return shown;
  }
  static std::shared_ptr<ShownPicture> names(const std::vector<PictureLegend::Swatch>& swatches, std::size_t hidden = 0)
  {
    auto shown = makeShown(4, 4);
    shown->colors.legend.kind = PictureLegend::Kind::Swatches;
    shown->colors.legend.swatches = swatches;
    shown->colors.legend.hidden = hidden;
    return shown;
  }
  static int widthOf(const QString& text)
  {
    const LegendStrip strip(nullptr);
    QFont small = strip.font();
    small.setPointSizeF(small.pointSizeF() * 0.85);
    return QFontMetrics(small).horizontalAdvance(text);
  }
};

TEST_F(LegendTable, RampsGoFromEndToEnd)
{
  const auto shown = this->ramp();
  const QImage image = this->painted(shown, 300);
  for (const int x : { 1, 20, 299 })
  {
    EXPECT_EQ(image.pixelColor(x, 3), toQt(legendColor(*shown->picture, shown->colors.legend, (x + 0.5) / 300))) << x;
  }
  EXPECT_NE(image.pixelColor(20, 0), image.pixelColor(20, 3)) << "two above and below are free";
  EXPECT_NE(image.pixelColor(20, 18), image.pixelColor(20, 3));
  const auto inked = [&](const QImage& painted, int from, int to)
  {
    int count = 0;
    for (int x = from; x < to; ++x)
    {
      for (int y = 3; y < 17; ++y)
      {
        count += painted.pixelColor(x, y) != painted.pixelColor(x, 2) ? 1 : 0;
      }
    }
    return count;
  };
  // Four times 64 units fit: numbers in between, with their ends where those are asked for.
  EXPECT_EQ(inked(image, 0, 40), 0);
  EXPECT_GT(inked(image, 50, 100), 0);
  EXPECT_EQ(inked(image, 260, 300), 0);
  const QImage ends = this->painted(shown, 300, true);
  EXPECT_GT(inked(ends, 0, 40), 0);
  EXPECT_GT(inked(ends, 260, 300), 0);
}

TEST_F(LegendTable, AsManyNamesAsThereIsRoomFor)
{
  const Rgb red{ 200, 10, 10 };
  const Rgb blue{ 10, 10, 200 };
  const int first = 10 + 4 + widthOf("1 floor") + 12;
  const int second = 10 + 4 + widthOf("2 mill") + 12;
  const auto hasAt = [](const QImage& image, int x, Rgb color)
  { return x < image.width() && image.pixelColor(x, 10) == toQt(color); };
  for (const auto& [width, firstIs, secondIs] :
    { std::tuple(2 + first + second, true, true), std::tuple(1 + first + second, true, false),
      std::tuple(2 + first + widthOf("+2") + 2, true, false), std::tuple(1 + first + widthOf("+2") + 2, false, false) })
  {
    const QImage image = this->painted(this->names({ { red, "1 floor" }, { blue, "2 mill" } }), width);
    EXPECT_EQ(hasAt(image, 2, red) && hasAt(image, 11, red), firstIs) << width;
    EXPECT_EQ(hasAt(image, 2 + first, blue), secondIs) << width;
  }
  // The last of all needs no room for how many more there are; not so one of more.
  EXPECT_TRUE(hasAt(this->painted(this->names({ { red, "1 floor" } }), 2 + first), 2, red));
  EXPECT_FALSE(hasAt(this->painted(this->names({ { red, "1 floor" } }, 1), 2 + first), 2, red));
  EXPECT_TRUE(hasAt(this->painted(this->names({ { red, "1 floor" } }, 1), 2 + first + widthOf("+2") + 2), 2, red));
}

TEST_F(LegendTable, TheWheelIsThatOfTheFlow)
{
  auto shown = makeShown(4, 4);
  shown->colors.legend.kind = PictureLegend::Kind::Wheel;
  const QImage image = this->painted(shown, 200);
  const auto at = [&](int x, int y) { return image.pixelColor(2 + x, 1 + y); };
  for (const auto& [x, y] : { std::pair(9, 1), std::pair(16, 9), std::pair(4, 12) })
  {
    EXPECT_EQ(at(x, y), toQt(wheelColor((x + 0.5 - 9) / 9, (y + 0.5 - 9) / 9))) << x << ' ' << y;
  }
  EXPECT_EQ(at(0, 0), image.pixelColor(0, 0)) << "a disc";
}

TEST_F(LegendTable, FieldsAskForARange)
{
  LegendBar bar(nullptr);
  std::vector<std::optional<PictureRange>> asked;
  QObject::connect(
    &bar, &LegendBar::rangeAsked, [&](const std::optional<PictureRange>& range) { asked.push_back(range); });
  auto* const low = bar.findChild<QLineEdit*>("low");
  auto* const high = bar.findChild<QLineEdit*>("high");
  auto* const automatic = bar.findChild<QToolButton*>("auto");
  ASSERT_TRUE(low && high && automatic);
  const auto expectFields = [&](bool lows, bool highs, const char* what)
  {
    EXPECT_EQ(low->isVisibleTo(&bar), lows) << what;
    EXPECT_EQ(high->isVisibleTo(&bar), highs) << what;
    EXPECT_EQ(automatic->isVisibleTo(&bar), highs) << what;
  };
  bar.resize(400, 24);
  expectFields(false, false, "nothing");
  bar.setPicture(this->ramp(), false);
  expectFields(true, true, "a ramp");
  EXPECT_EQ(low->text(), "2");
  EXPECT_EQ(high->text(), "4");
  EXPECT_TRUE(automatic->isChecked());
  auto flow = this->ramp();
  flow->colors.legend.kind = PictureLegend::Kind::Wheel;
  flow->colors.legend.range = { 0, 1.0 / 3 };
  bar.setPicture(flow, true);
  expectFields(false, true, "a flow");
  EXPECT_EQ(high->text(), "0.3333");
  EXPECT_FALSE(automatic->isChecked());
  bar.setPicture(this->names({}), false);
  expectFields(false, false, "names");
  bar.setPicture(this->ramp(), false);
  for (const auto& [width, wide] : { std::pair(259, false), std::pair(260, true) })
  {
    bar.resize(width, 24);
    QResizeEvent event(bar.size(), QSize(1, 1));
    QApplication::sendEvent(&bar, &event);
    expectFields(wide, wide, "narrow");
  }
  emit low->editingFinished();
  EXPECT_TRUE(asked.empty()) << "nobody typed";
  const auto type = [](QLineEdit* field, const char* text)
  {
    field->setText(text);
    field->setModified(true);
    emit field->editingFinished();
  };
  type(low, "3");
  type(high, "1");
  type(high, "2.5");
  automatic->click();
  automatic->click();
  ASSERT_EQ(asked.size(), 5u);
  EXPECT_TRUE(asked[0] == (PictureRange{ 3, 4 }));
  EXPECT_TRUE(asked[1] == (PictureRange{ 1, 3 })) << "in their order";
  EXPECT_TRUE(asked[2] == (PictureRange{ 1, 2.5 }));
  EXPECT_TRUE(asked[3] == (PictureRange{ 1, 2.5 })) << "what is shown";
  EXPECT_FALSE(asked[4].has_value()) << "each picture's own";
}

TEST_F(LegendTable, NumbersHaveAPointInEveryLanguage)
{
  const QLocale before;
  QLocale::setDefault(QLocale(QLocale::German, QLocale::Germany));
  const LegendBar bar(nullptr);
  QLocale::setDefault(before);
  for (const char* const name : { "low", "high" })
  {
    auto* const field = bar.findChild<QLineEdit*>(name);
    ASSERT_TRUE(field) << name;
    for (const auto& [text, fine] : { std::pair("2.5", true), std::pair("-1e-3", true), std::pair("2,5", false),
           std::pair("x", false), std::pair("", false) })
    {
      field->setText(text);
      EXPECT_EQ(field->hasAcceptableInput(), fine) << text;
    }
    EXPECT_FALSE(field->toolTip().isEmpty());
    EXPECT_EQ(field->accessibleName(), field->toolTip());
  }
}

TEST_F(LegendTable, TheRangeOfEachPictureHasAButton)
{
  const LegendBar bar(nullptr);
  const auto* const own = bar.findChild<QToolButton*>("auto");
  ASSERT_TRUE(own);
  EXPECT_EQ(own->text(), "Auto");
  EXPECT_FALSE(own->toolTip().isEmpty());
  EXPECT_TRUE(own->isCheckable());
}

/// The whole legend is the strip's tip: its text, known or not, then all names with their colours.
TEST_F(LegendTable, TheTipSaysAll)
{
  const auto tipOf = [](const std::shared_ptr<ShownPicture>& shown)
  {
    QToolTip::hideText();
    LegendStrip strip(nullptr);
    strip.resize(100, 20);
    strip.setPicture(shown);
    strip.show();
    QHelpEvent help(QEvent::ToolTip, QPoint(5, 5), strip.mapToGlobal(QPoint(5, 5)));
    EXPECT_TRUE(QApplication::sendEvent(&strip, &help));
    return QToolTip::text();
  };
  auto named = this->names({ { { 1, 2, 3 }, "a < b" }, { { 255, 0, 16 }, "c" } });
  named->colors.legend.text = "each id has a colour of its own";
  EXPECT_EQ(tipOf(named), "each id has a colour of its own<span style='color:#010203'>&#9632;</span> a &lt; b<br>"
                          "<span style='color:#ff0010'>&#9632;</span> c<br>");
  named->colors.legend.text = "more & <less>";
  named->colors.legend.swatches.clear();
  EXPECT_EQ(tipOf(named), "more &amp; &lt;less&gt;");
  named->colors.legend.hidden = 3;
  EXPECT_EQ(tipOf(named), "more &amp; &lt;less&gt;and 3 more");
  named->colors.legend.hidden = 1;
  EXPECT_EQ(tipOf(named), "more &amp; &lt;less&gt;and 1 more");
  EXPECT_EQ(tipOf(nullptr), "");
}
} // namespace
