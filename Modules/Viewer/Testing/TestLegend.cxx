// SPDX-License-Identifier: BSD-3-Clause
// The legend of a picture as it is painted and handled, on no display.
#include "dgtkLegendBar.h"
#include "dgtkPictureView.h"

#include "dgtkShownPictures.h"
#include "dgtkTestWidgets.h"

#include <QApplication>
#include <QFontMetrics>
#include <QHelpEvent>
#include <QImage>
#include <QLineEdit>
#include <QLocale>
#include <QToolButton>
#include <QToolTip>

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <vector>

namespace
{
using namespace dgtk;
using test::makeShown;
using test::makeValues;
using test::toQt;

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
  LegendBar bar(nullptr);
  QLocale::setDefault(before);
  std::vector<PictureRange> asked;
  QObject::connect(
    &bar, &LegendBar::rangeAsked, [&](const std::optional<PictureRange>& range) { asked.push_back(*range); });
  for (const char* const name : { "low", "high" })
  {
    auto* const field = bar.findChild<QLineEdit*>(name);
    ASSERT_TRUE(field) << name;
    for (const auto& [text, number] : std::vector<std::pair<const char*, std::optional<double>>>{
           { "2.5", 2.5 }, { "-1e-3", -0.001 }, { "2,5", 2.5 }, { "x", {} }, { "", {} }, { ".", {} }, { "1e999", {} } })
    {
      bar.setPicture(this->ramp(), false);
      asked.clear();
      const QString shown = field->text();
      field->setText(text);
      field->setModified(true);
      emit field->editingFinished();
      EXPECT_EQ(asked.size(), number ? 1u : 0u) << text;
      EXPECT_TRUE(!number || asked.back().low == *number || asked.back().high == *number) << text;
      EXPECT_EQ(field->text(), number ? QString(text) : shown) << "what was there comes back";
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
