// SPDX-License-Identifier: BSD-3-Clause
// Panes in windows of other sizes and of other datasets.
#include "TestEditorSupport.h"
#include "TestEditorViewer.h"

#include "dgtkDatasetDocuments.h"
#include "dgtkDatasetViewer.h"
#include "dgtkFile.h"

#include <QAction>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMainWindow>
#include <QMimeData>
#include <QPlainTextEdit>
#include <QPointer>
#include <QSettings>
#include <QSignalSpy>
#include <QSpinBox>
#include <QUrl>

#include <filesystem>
#include <fstream>
#include <limits>

namespace
{
namespace fs = std::filesystem;

// height by width of a picture that is scrolled: about 3/5, with margins
constexpr double lowestShape = 0.58;
constexpr double highestShape = 0.66;

/// Drops a folder on the window and waits until it is shown.
void drop(QMainWindow* viewer, const std::string& folder)
{
  QMimeData dropped;
  dropped.setUrls({ QUrl::fromLocalFile(QString::fromStdString(folder)) });
  QDragEnterEvent enter({ 50, 50 }, Qt::CopyAction, &dropped, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(viewer, &enter);
  QDropEvent event({ 50, 50 }, Qt::CopyAction, &dropped, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(viewer, &event);
  const QString name = QString::fromStdString(fs::path(folder).filename().string());
  QTRY_VERIFY(viewer->windowTitle().startsWith(name + " "));
}
} // namespace

void TestEditorViewer::scrolledPicturesKeepTheirShape()
{
  QMainWindow* const viewer = this->open(this->dataset());
  QVERIFY(viewer != nullptr);
  viewer->findChild<QAction*>("cloud")->setChecked(false);
  viewer->resize(1100, 700);
  QTest::keyClick(viewer, Qt::Key_L);
  this->waitForPictures(viewer);
  QWidget* const picture = this->picture(viewer, 0);
  const auto shape = [&] { return double(picture->height()) / picture->width(); };
  QTRY_VERIFY(shape() > lowestShape && shape() < highestShape);
  const int before = picture->width();
  viewer->resize(1380, 700); // as many columns, wider ones
  QTRY_VERIFY(picture->width() > before + 50);
  QTRY_VERIFY(shape() > lowestShape && shape() < highestShape);
  viewer->resize(900, 700);
  QTRY_VERIFY(picture->width() < before - 40);
  QTRY_VERIFY(shape() > lowestShape && shape() < highestShape);
}

void TestEditorViewer::theViewerOpensWhereItWas()
{
  QMainWindow* const viewer = this->open(this->richDataset());
  QVERIFY(viewer != nullptr);
  const QString other = this->dataset();
  QString begin;
  answer<QFileDialog>({},
    [&](QFileDialog& dialog)
    {
      begin = dialog.directory().absolutePath();
      auto* const field = dialog.findChild<QLineEdit*>("fileNameEdit");
      field->setText(other);
      QTest::keyClick(field, Qt::Key_Return);
    });
  viewer->findChild<QAction*>("open")->trigger();
  QCOMPARE(begin, this->richDataset());
  QTRY_VERIFY(viewer->windowTitle().startsWith("dataset "));
  QCOMPARE(QSettings().value("folder/dataset").toString(), other);
  QCOMPARE(QSettings().value("recent").toStringList().first(), other);
}

/// Of a program that was started for a dataset; another one, or one with a scene, goes on. Ctrl+Q ends it at any rate.
void TestEditorViewer::theProgramEndsWithItsDatasets()
{
  const auto closeViewer = [&](const char* action)
  {
    this->Window->show();
    const QPointer<QMainWindow> viewer = this->open(this->dataset());
    viewer->findChild<QAction*>(action)->trigger();
    for (int waited = 0; waited < longestRun && !viewer.isNull(); waited += settle)
    {
      QTest::qWait(settle);
    }
    untilQuiet();
    return this->Window->isVisible();
  };
  QVERIFY(closeViewer("close"));
  QVERIFY(!closeViewer("exit"));
  this->Window->openForDatasets();
  QVERIFY(!closeViewer("close"));
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  QVERIFY(closeViewer("close"));
}

void TestEditorViewer::objectNumbersAreThoseOfTheDataset()
{
  const std::string first = this->Folder.path("first");
  const std::string second = this->Folder.path("second");
  const std::string third = this->Folder.path("third");
  for (const std::string& folder : { first, second, third })
  {
    fs::copy(this->richDataset().toStdString(), folder, fs::copy_options::recursive);
  }
  std::vector<dgtk::ObjectRecord> objects = dgtk::readObjects(first + "/objects.json");
  QVERIFY(objects.size() > 2);
  objects.back().id = 3000000000;
  std::ofstream(first + "/objects.json") << dgtk::objectsText(objects);
  objects.resize(1);
  std::ofstream(second + "/objects.json") << dgtk::objectsText(objects);
  fs::remove(third + "/objects.json");

  QMainWindow* const viewer = this->open(QString::fromStdString(first));
  QVERIFY(viewer != nullptr);
  this->choose(viewer, 0, "left", "amodal");
  auto* const pane = viewer->findChild<QWidget*>("pane.0");
  auto* const surface = pane->findChild<QSpinBox*>("surface");
  QCOMPARE(surface->minimum(), 1);
  QCOMPARE(surface->maximum(), std::numeric_limits<int>::max());
  surface->setValue(2);
  this->waitForPictures(viewer);
  const QSignalSpy changed(pane, SIGNAL(changed()));
  QVERIFY(changed.isValid());
  drop(viewer, second);
  this->waitForPictures(viewer);
  QCOMPARE(changed.count(), 0); // what the user did not do is no change
  this->choose(viewer, 0, "left", "amodal");
  QCOMPARE(surface->maximum(), 1);
  drop(viewer, third);
  this->choose(viewer, 0, "left", "amodal");
  QVERIFY2(surface->maximum() > 1, "of the dataset before");
}

void TestEditorViewer::germanIsSpokenOfCameras()
{
  const German german;
  QMainWindow* const viewer = this->open(this->richDataset());
  QVERIFY(viewer != nullptr);
  QTest::keyClick(viewer, Qt::Key_K);
  const QString text = viewer->findChild<QPlainTextEdit*>("calibration")->toPlainText();
  QVERIFY2(text.contains("Bildbereich\n  0 0 64 48"), qPrintable(text));
}

/// When the next picture is asked for: nothing of the other one goes with what was read of this one.
void TestEditorViewer::aReplacedDatasetIsOpenedAgain()
{
  const std::string folder = this->Folder.path("replaced");
  const std::string manifest = folder + "/manifest.json";
  fs::copy(this->dataset().toStdString(), folder, fs::copy_options::recursive);
  QMainWindow* const viewer = this->open(QString::fromStdString(folder));
  QVERIFY(viewer != nullptr);
  QSignalSpy opened(viewer, SIGNAL(opened(QString)));
  const std::string whole = dgtk::readFile(manifest) + '\n';
  dgtk::writeFile(manifest, whole);
  QTest::keyClick(viewer, Qt::Key_Period);
  QTRY_COMPARE(opened.count(), 1);
  const auto frame = [&] { return viewer->findChild<QLabel*>("frameText")->text(); };
  QVERIFY2(frame().contains("(2 of 3)"), qPrintable(frame())); // that was asked for
  this->waitForPictures(viewer);
  QTest::keyClick(viewer, Qt::Key_Period);
  this->waitForPictures(viewer);
  QCOMPARE(opened.count(), 1);

  fs::remove(manifest);                  // as a run does that replaces it
  QTest::keyClick(viewer, Qt::Key_Home); // what was read already
  QTRY_VERIFY(viewer->findChild<QLabel*>("emptyText")->isVisible());
  triggerAll(viewer);
  dgtk::writeFile(manifest, whole);
  QTRY_COMPARE(opened.count(), 2);
  QVERIFY2(frame().contains("(1 of 3)"), qPrintable(frame()));

  // What the user opens meanwhile is not put aside for it.
  this->waitForPictures(viewer);
  dgtk::writeFile(manifest, whole + '\n');
  QTest::keyClick(viewer, Qt::Key_Period); // it is left when events are looked at
  qobject_cast<dgtk::DatasetViewer*>(viewer)->openFolder(this->dataset());
  QTRY_COMPARE(opened.count(), 3);
  this->waitForPictures(viewer);
  QCOMPARE(opened.back().front().toString(), this->dataset());
}
