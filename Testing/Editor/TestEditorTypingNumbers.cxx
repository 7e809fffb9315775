// SPDX-License-Identifier: BSD-3-Clause
// Keys in fields of numbers.
#include "TestEditorSupport.h"
#include "TestEditorTyping.h"

#include "dgtkMainWindow.h"

#include <QAction>
#include <QDialog>
#include <QFile>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QSpinBox>
#include <QStatusBar>
#include <QTest>

#include <utility>

/// Keys at the ends of "25.000 frames/s" change the number alone, and a comma is a point.
void TestEditorTyping::wordsAroundANumberStay()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  auto* const rate = this->Window->findChild<QDoubleSpinBox*>("frameRate");
  rate->setFocus();
  const QString suffix = rate->suffix();
  QTest::keyClick(rate, Qt::Key_End);
  QTest::keyClick(rate, Qt::Key_Backspace);
  QTest::keyClick(rate, Qt::Key_Backspace);
  QCOMPARE(rate->text(), "25.000" + suffix);
  QTest::keyClick(rate, Qt::Key_Home);
  for (int i = 0; i < 20; ++i)
  {
    QTest::keyClick(rate, Qt::Key_Delete);
  }
  QCOMPARE(rate->text(), suffix);
  for (const auto& [text, value] : { std::pair("30", 30.0), std::pair("23,976", 23.976), std::pair("1,5", 1.5) })
  {
    QTest::keyClick(rate, Qt::Key_Home);
    QTest::keyClicks(rate, text);
    QTest::keyClick(rate, Qt::Key_Return);
    QCOMPARE(rate->value(), value);
    rate->selectAll();
    QTest::keyClick(rate, Qt::Key_Delete);
  }
  typeInto(rate, "23.9761");
  QCOMPARE(this->Window->statusBar()->currentMessage(), QString("\"23.9761\": expected at most 3 decimals"));
  QCOMPARE(rate->value(), 1.5);
}

/// A number that an option cannot have stays in its field, and no run begins with another one.
void TestEditorTyping::noKeyIsDropped()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  this->action("render")->trigger();
  auto* const dialog = this->Window->findChild<QDialog*>("renderDialog");
  auto* const status = dialog->findChild<QLabel*>("status");
  auto* const start = dialog->findChild<QPushButton*>("start");
  dialog->findChild<QLineEdit*>("folder")->setText(this->path("wrong"));
  const auto isRefused = [&](int page, const char* name, const QString& text)
  {
    turnTo(*dialog, page);
    QWidget* const box = dialog->findChild<QSpinBox*>(name);
    auto* const line = dialog->findChild<QWidget*>(name)->findChild<QLineEdit*>();
    QWidget* const field = box != nullptr ? box : line;
    const QString before = line->text();
    typeInto(field, text);
    QCOMPARE(line->text(), text);
    QVERIFY2(status->text().startsWith('"' + text + '"'), qPrintable(status->text()));
    status->clear();
    QTest::mouseClick(start, Qt::LeftButton);
    QVERIFY2(status->text().startsWith('"' + text + '"'), qPrintable(status->text()));
    QVERIFY(line->hasFocus() || field->hasFocus());
    QVERIFY(start->isEnabled() && !QFile::exists(this->path("wrong")));
    typeInto(field, before);
    QCOMPARE(line->text(), before);
  };
  isRefused(3, "samples", "32");
  isRefused(2, "frameStep", "0");
  isRefused(2, "lastFrame", "1e3");
  isRefused(1, "width", "-64");
  isRefused(1, "renderFar", "1e999");
  typeInto(dialog->findChild<QLineEdit*>("renderFar.0"), "far");
  auto* const cameras = dialog->findChild<QListWidget*>();
  cameras->setCurrentRow(1); // what was typed was for the other camera
  QVERIFY(dialog->findChild<QLineEdit*>("renderFar.0")->text() != "far");
  dialog->close();
  answer<QDialog>("cameraArrayDialog",
    [](QDialog& array)
    {
      auto* const count = array.findChild<QSpinBox*>("count");
      typeInto(count, "20000");
      add(array);
      QVERIFY(array.isVisible());
      QVERIFY(array.findChild<QLabel*>("fault")->text().startsWith("\"20000\""));
      QCOMPARE(count->text(), QString("20000"));
      array.reject();
    });
  this->action("cameraArray")->trigger();
}
