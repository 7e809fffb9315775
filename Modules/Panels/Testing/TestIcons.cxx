// SPDX-License-Identifier: BSD-3-Clause
// The icons of the editor and of the dataset viewer as they are drawn, beside the sheet icons.png that was looked at.
#include "dgtkEditorIcons.h"

#include "dgtkTestSupport.h"
#include "dgtkTestWidgets.h"

#include <QDir>
#include <QIcon>
#include <QImage>
#include <QPainter>
#include <QSet>
#include <QStringList>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

namespace
{
using namespace dgtk;

QStringList allNames()
{
  QStringList names;
  for (const auto& row : editorIcons())
  {
    names.append(row.first);
  }
  return names;
}

QImage drawn(const QString& name, int pixels, QIcon::Mode mode = QIcon::Normal)
{
  QImage image(pixels, pixels, QImage::Format_ARGB32);
  image.fill(Qt::white);
  QPainter painter(&image);
  painter.drawPixmap(0, 0, editorIcon(name).pixmap(pixels, mode));
  return image;
}

/// All icons in a row each: 24 pixels, the same greyed, 48 pixels.
QImage sheet()
{
  const QStringList names = allNames();
  QImage image(96, 48 * names.size(), QImage::Format_RGB32);
  image.fill(Qt::white);
  QPainter painter(&image);
  for (int i = 0; i < names.size(); ++i)
  {
    painter.drawImage(0, 48 * i, drawn(names[i], 24));
    painter.drawImage(24, 48 * i, drawn(names[i], 24, QIcon::Disabled));
    painter.drawImage(48, 48 * i, drawn(names[i], 48));
  }
  return image;
}

int differenceOf(QRgb a, QRgb b)
{
  return std::max({ std::abs(qRed(a) - qRed(b)), std::abs(qGreen(a) - qGreen(b)), std::abs(qBlue(a) - qBlue(b)) });
}

TEST(Icons, AreThoseOfTheSheet)
{
  test::needApplication();
  constexpr int rounding = 3; // levels, of another Qt's blending
  const QImage now = sheet();
  const QImage kept(QString::fromStdString(test::sourceFile("Modules/Panels/Testing/icons.png")));
  const QString place = QDir::temp().filePath("dgtk-icons.png");
  ASSERT_EQ(now.size(), kept.size()) << (now.save(place) ? "drawn now: " + place.toStdString() : "");
  for (int y = 0; y < now.height(); ++y)
  {
    for (int x = 0; x < now.width(); ++x)
    {
      ASSERT_LE(differenceOf(now.pixel(x, y), kept.pixel(x, y)), rounding)
        << allNames()[y / 48].toStdString() << " at " << x << ", " << y % 48
        << (now.save(place) ? ", drawn now: " + place.toStdString() : "");
    }
  }
}

TEST(Icons, EachIsOneAndAnotherNameHasNone)
{
  test::needApplication();
  QSet<QString> drawings;
  for (const QString& name : allNames())
  {
    EXPECT_FALSE(editorIcon(name).isNull()) << name.toStdString();
    const QImage image = drawn(name, 32);
    drawings.insert(QByteArray(reinterpret_cast<const char*>(image.constBits()), int(image.sizeInBytes())).toHex());
  }
  EXPECT_EQ(drawings.size(), allNames().size());
  EXPECT_TRUE(editorIcon("nothing").isNull());
}
} // namespace
