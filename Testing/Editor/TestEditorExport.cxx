// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorExport.h"
#include "TestEditorSupport.h"

#include "dgtkRenderDialog.h"

#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>

QString TestEditorExport::dataset() const
{
  QString folder = this->path("dataset");
  if (!QDir(folder).exists())
  {
    run({ "render", demo(), "-o", folder, "--for", "coco", "--size", "96x64", "--frames", "0:1", "--quiet" });
  }
  return folder;
}

QDialog* TestEditorExport::dialog(const QString& folder) const
{
  const QString dataset = this->dataset(); // before the window is asked
  this->action("exportDataset")->trigger();
  auto* const shown = this->Window->findChild<QDialog*>("exportDialog");
  activate(*shown);
  typeInto(shown->findChild<QLineEdit*>("dataset"), dataset);
  shown->findChild<QComboBox*>("format")->setCurrentText("coco");
  typeInto(shown->findChild<QLineEdit*>("folder"), folder);
  return shown;
}

QString TestEditorExport::started(const QDialog& shown)
{
  auto* start = shown.findChild<QPushButton*>("start");
  QTest::mouseClick(start, Qt::LeftButton);
  [&start] { QTRY_VERIFY(start->isEnabled()); }();
  return shown.findChild<QLabel*>("status")->text();
}

void TestEditorExport::anExportHasTheBytesOfTheCommandLine()
{
  const QString folder = this->path("coco");
  const QDialog* const shown = this->dialog(folder);
  shown->findChild<QComboBox*>("masks")->setCurrentText("polygon");
  QVERIFY(shown->findChild<QComboBox*>("masks")->isEnabled());
  const QString said = started(*shown);
  QVERIFY2(said.contains("files in"), qPrintable(said));
  QCOMPARE(
    run({ "export", this->dataset(), "--format", "coco", "-o", this->path("line"), "--masks", "polygon", "--quiet" }),
    0);
  QCOMPARE(contents(folder), contents(this->path("line")));
  QVERIFY(QFile::exists(folder + "/export.json"));
}

void TestEditorExport::refusalsAreInTheWindowsWords()
{
  const QDialog* const shown = this->dialog(this->path("refused"));
  shown->findChild<QLineEdit*>("cameras")->setText("nobody");
  const QString said = started(*shown);
  QVERIFY2(said.startsWith("cameras: ") && said.contains("nobody") && !said.contains("--"), qPrintable(said));
  QVERIFY(!QDir(this->path("refused")).exists());
}

void TestEditorExport::aRenderForAnExportHasItsLayers()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  this->action("render")->trigger();
  const auto* shown = this->Window->findChild<dgtk::RenderDialog*>("renderDialog");
  QVERIFY(!shown->arguments("scene").contains("--for"));
  shown->findChild<QComboBox*>("for")->setCurrentText("coco");
  const QStringList words = shown->arguments("scene");
  QCOMPARE(words.value(words.indexOf("--for") + 1), QString("coco"));
}

void TestEditorExport::foldersAreBrowsed()
{
  const QDialog* const shown = this->dialog(this->path("coco"));
  int browsed = 0;
  for (auto* const button : shown->findChildren<QPushButton*>())
  {
    if (button->text() == "Browse ...")
    {
      const char* const line = browsed++ == 0 ? "dataset" : "folder";
      browseFor(button, shown->findChild<QLineEdit*>(line), this->path(line));
    }
  }
  QCOMPARE(browsed, 2);
  this->action("render")->trigger();
  const auto* const render = this->Window->findChild<QDialog*>("renderDialog");
  for (auto* const button : render->findChildren<QPushButton*>())
  {
    if (button->text() == "&Browse ...")
    {
      browseFor(button, render->findChild<QLineEdit*>("folder"), this->path("rendered"));
      ++browsed;
    }
  }
  QCOMPARE(browsed, 3);
}

void TestEditorExport::pictures()
{
  const QString folder = QString::fromLocal8Bit(qgetenv("DGTK_EDITOR_PICTURES"));
  if (folder.isEmpty())
  {
    QSKIP("DGTK_EDITOR_PICTURES names no folder");
  }
  QDialog* const shown = this->dialog("coco");
  shown->findChild<QLineEdit*>("dataset")->setText("dataset");
  untilQuiet();
  QVERIFY(shown->grab().save(folder + "/editor_export.png"));
}

DGTK_EDITOR_TEST(TestEditorExport);
