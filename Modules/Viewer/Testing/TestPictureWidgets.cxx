// SPDX-License-Identifier: BSD-3-Clause
// A picture as it is painted and handled, on no display.
#include "dgtkPictureView.h"

#include "dgtkShownPictures.h"
#include "dgtkTestDataset.h"
#include "dgtkTestWidgets.h"

#include <QApplication>
#include <QImage>

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <vector>

namespace
{
using namespace dgtk;
using test::makeShown;
using test::makeValues;

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
  // Of another picture, and in other colours, there is no detail yet.
  test::SmallDataset folder;
  const LayerSpec spec{ "depth", PixelType::Float64, 1, "", "", "none", "", Meaning::Depth };
  folder.add("left", "depth", 0, "", "npy", spec, [](int, int, int) { return 1; });
  folder.finish();
  const auto dataset = std::make_shared<const DatasetPictures>(folder.path());
  const std::function<void(ShownPicture&)> changes[] = { [](ShownPicture& other) { other.ask.key.frame = 4; },
    [](ShownPicture& other) { other.ask.surface = 1; },
    [](ShownPicture& other) {
      other.ask.range = PictureRange{ 2, 5 };
    },
    [&](ShownPicture& other) { other.dataset = dataset; } };
  for (std::size_t i = 0; i < 4; ++i)
  {
    this->View->showPicture(makeShown(4000, 2000, 8));
    this->View->showDetail(detail);
    EXPECT_EQ(this->View->detail(), detail) << i;
    auto other = makeShown(4000, 2000, 8);
    changes[i](*other);
    this->View->showDetail(other);
    EXPECT_EQ(this->View->detail(), detail) << "it does not belong here: " << i;
    asked.clear();
    this->View->showPicture(other);
    EXPECT_EQ(this->View->detail(), nullptr) << i;
    EXPECT_EQ(asked.size(), 1u) << i;
  }
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
  this->Sync.zoom.pan({ 10000, 0 }); // the picture's own border has one, too
  const QColor edge = this->painted().pixelColor(this->View->widgetPoint({ 0, 10.5 }).toPoint());
  EXPECT_NE(edge, QColor(0, 60, 0));
  EXPECT_NE(edge, QColor(28, 28, 31));
  auto failed = std::make_shared<ShownPicture>();
  failed->error = "it is damaged";
  this->View->showPicture(failed);
  EXPECT_EQ(this->View->toolTip(), "it is damaged");
  EXPECT_EQ(this->View->imageSize(), Eigen::Vector2d(0, 0));
  EXPECT_EQ(this->painted().pixelColor(1, 1), QColor(28, 28, 31));
}

/// A strip with a legend, as wide as is said.
} // namespace
