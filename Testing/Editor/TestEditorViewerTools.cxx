// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorSupport.h"
#include "TestEditorViewer.h"

#include <QComboBox>
#include <QLabel>
#include <QMainWindow>
#include <QProcess>
#include <QRegularExpression>
#include <QTableWidget>

// What the cases share.

QPoint pixelOf(const QMainWindow* viewer)
{
  const QRegularExpression numbers("\\((\\d+), (\\d+)\\)");
  const auto match = numbers.match(viewer->findChild<QLabel*>("pixel")->text());
  return match.hasMatch() ? QPoint(match.captured(1).toInt(), match.captured(2).toInt()) : QPoint(-1, -1);
}

QString TestEditorViewer::dataset()
{
  if (this->Rendered.isEmpty())
  {
    const QString folder = this->path("dataset");
    const QStringList words{ "render", demo(), "-o", folder, "--layers",
      "color,depth,objects,normal,position,distance,flow_forward,ldi,correspondence", "--size", "64x48", "--quiet" };
    const int status = QProcess::execute(QString::fromLocal8Bit(qgetenv("DGTK")), words);
    this->Rendered = status == 0 ? folder : QString();
  }
  return this->Rendered;
}

QMainWindow* TestEditorViewer::open(const QString& folder)
{
  this->Window->openFile(folder);
  return this->viewer();
}

QMainWindow* TestEditorViewer::viewer() const
{
  QMainWindow* viewer = nullptr;
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    viewer =
      window->objectName() == "datasetViewer" && window->isVisible() ? qobject_cast<QMainWindow*>(window) : viewer;
  }
  if (viewer != nullptr)
  {
    viewer->activateWindow();
    QApplication::setActiveWindow(viewer);
    this->waitForPictures(viewer);
  }
  return viewer;
}

void TestEditorViewer::waitForPictures(QMainWindow* viewer) const
{
  QTRY_VERIFY_WITH_TIMEOUT(viewer->property("busy").isValid() && !viewer->property("busy").toBool(), longestRun);
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
  this->waitForPictures(viewer);
}

void TestEditorViewer::pointAt(QMainWindow* viewer, int x, int y) const
{
  QWidget* const view = this->picture(viewer, 0);
  view->setFocus();
  QTest::keyClick(view, Qt::Key_Right);
  const QPoint from = pixelOf(viewer);
  for (int i = 0; i < std::abs(x - from.x()); ++i)
  {
    QTest::keyClick(view, x < from.x() ? Qt::Key_Left : Qt::Key_Right);
  }
  for (int i = 0; i < std::abs(y - from.y()); ++i)
  {
    QTest::keyClick(view, y < from.y() ? Qt::Key_Up : Qt::Key_Down);
  }
  QCOMPARE(pixelOf(viewer), QPoint(x, y));
}
