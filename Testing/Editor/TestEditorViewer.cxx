// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorViewer.h"
#include "TestEditorSupport.h"

#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QMainWindow>
#include <QPixmap>
#include <QProcess>
#include <QTableWidget>

QString TestEditorViewer::dataset()
{
  if (this->Rendered.isEmpty())
  {
    const QString folder = this->path("dataset");
    const QStringList words{ "render", demo(), "-o", folder, "--layers",
      "color,depth,objects,normal,position,distance,flow_forward,classes,ldi,coverage,correspondence,triangles",
      "--size", "64x48", "--quiet" };
    const int status = QProcess::execute(QString::fromLocal8Bit(qgetenv("DGTK")), words);
    this->Rendered = status == 0 ? folder : QString();
  }
  return this->Rendered;
}

void TestEditorViewer::pictures()
{
  const QString folder = QString::fromLocal8Bit(qgetenv("DGTK_EDITOR_PICTURES"));
  if (folder.isEmpty())
  {
    QSKIP("DGTK_EDITOR_PICTURES names no folder");
  }
  const QString given = QString::fromLocal8Bit(qgetenv("DGTK_VIEWER_DATASET"));
  QMainWindow* const viewer = this->open(given.isEmpty() ? this->dataset() : given);
  QVERIFY(viewer != nullptr);
  this->pointAt(viewer, 150, 150);
  QTest::qWait(1500);
  QVERIFY(viewer->grab().save(folder + "/editor_viewer.png"));
}

QMainWindow* TestEditorViewer::open(const QString& folder)
{
  this->Window->openFile(folder);
  QMainWindow* viewer = nullptr;
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    viewer =
      window->objectName() == "datasetViewer" && window->isVisible() ? qobject_cast<QMainWindow*>(window) : viewer;
  }
  if (viewer != nullptr)
  {
    viewer->activateWindow();
    this->waitForPictures(viewer);
  }
  return viewer;
}

void TestEditorViewer::waitForPictures(QMainWindow* viewer) const
{
  QTRY_VERIFY_WITH_TIMEOUT(viewer->findChild<QWidget*>("picture.0") != nullptr, longestRun);
  QTest::qWait(settle);
}

QWidget* TestEditorViewer::picture(QMainWindow* viewer, int pane) const
{
  return viewer->findChild<QWidget*>(QString("picture.%1").arg(pane));
}

QString TestEditorViewer::cell(QMainWindow* viewer, int row, int column) const
{
  const QTableWidgetItem* const item = viewer->findChild<QTableWidget*>("readOut")->item(row, column);
  return item == nullptr ? QString() : item->text();
}

void TestEditorViewer::choose(QMainWindow* viewer, int pane, const QString& camera, const QString& layer) const
{
  auto* const frame = viewer->findChild<QWidget*>(QString("pane.%1").arg(pane));
  frame->findChild<QComboBox*>("camera")->setCurrentText(camera);
  frame->findChild<QComboBox*>("layer")->setCurrentText(layer);
}

void TestEditorViewer::pointAt(QMainWindow* viewer, int x, int y) const
{
  QWidget* const view = this->picture(viewer, 0);
  view->setFocus();
  QTest::keyClick(view, Qt::Key_Right);
  for (int i = 0; i < 100; ++i)
  {
    QTest::keyClick(view, Qt::Key_Left, Qt::ShiftModifier);
    QTest::keyClick(view, Qt::Key_Up, Qt::ShiftModifier);
  }
  for (int i = 0; i < x; ++i)
  {
    QTest::keyClick(view, Qt::Key_Right);
  }
  for (int i = 0; i < y; ++i)
  {
    QTest::keyClick(view, Qt::Key_Down);
  }
}
void TestEditorViewer::opensByFolderManifestAndDrop() {}
void TestEditorViewer::framesStepAndPlay() {}
void TestEditorViewer::numbersAreThoseOfTheFiles() {}
void TestEditorViewer::zoomIsCommon() {}
void TestEditorViewer::presetsAndLayouts() {}
void TestEditorViewer::rangesAreChosen() {}
void TestEditorViewer::keysReachEverything() {}
void TestEditorViewer::camerasAndPointsInTheWorld() {}
void TestEditorViewer::layeredImagesHaveSurfaces() {}
void TestEditorViewer::brokenDatasetsAreRefused() {}
void TestEditorViewer::theRenderDialogOpensItsResult() {}

int main(int argc, char** argv) { return runEditorTest<TestEditorViewer>(argc, argv); }
