// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorTruth.h"
#include "TestEditorSupport.h"

#include "dgtkMainWindow.h"
#include "dgtkSceneDocument.h"

#include <QAction>
#include <QComboBox>
#include <QDialog>
#include <QPushButton>
#include <QTest>
#include <QTreeWidget>

#include <cmath>

namespace
{
/// Where an image point of a pane is in its widget.
QPoint widgetPoint(QWidget* pane, const QPointF& image)
{
  QPointF point;
  QMetaObject::invokeMethod(pane, "toWidget", Q_RETURN_ARG(QPointF, point), Q_ARG(QPointF, image));
  return { int(std::floor(point.x())), int(std::floor(point.y())) };
}
} // namespace

void TestEditorTruth::layersReplaceColour()
{
  QVERIFY(this->Window->openFile(demo()));
}

void TestEditorTruth::pictures()
{
  const QString folder = QString::fromLocal8Bit(qgetenv("DGTK_EDITOR_PICTURES"));
  if (folder.isEmpty())
  {
    return; // made by Documentation/Images/make_editor.py
  }
  this->Window->resize(1280, 860);
  QVERIFY(this->Window->openFile(demo()));
  this->action("show.depth")->trigger();
  auto* view = this->Window->findChild<QWidget*>("view.3");
  QTest::mouseMove(view, view->rect().center() + QPoint(-30, 20));
  QTest::qWait(3000);
  QVERIFY(this->Window->grab().save(folder + "/editor_truth.png"));
  this->action("show.colour")->trigger();
  this->action("correspondence")->trigger();
  auto* dialog = this->Window->findChild<QDialog*>("matchDialog");
  auto* pane = dialog->findChild<QWidget*>("pane.0");
  QTest::qWait(1000);
  for (const QPointF& point : { QPointF(330, 250), QPointF(200, 330), QPointF(425, 280) })
  {
    QTest::mouseClick(pane, Qt::LeftButton, {}, widgetPoint(pane, point));
    QTest::qWait(500);
    dialog->findChild<QPushButton*>("addPair")->click();
  }
  QTest::qWait(3000);
  QVERIFY(dialog->grab().save(folder + "/editor_correspondence.png"));
}

int main(int argc, char** argv) { return runEditorTest<TestEditorTruth>(argc, argv); }
