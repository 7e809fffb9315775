// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorTruth.h"
#include "TestEditorSupport.h"

#include "dgtkMainWindow.h"
#include "dgtkSceneDocument.h"

#include <QAction>
#include <QComboBox>
#include <QTest>
#include <QTreeWidget>

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
  this->action("show.normal")->trigger();
  this->action("maximize")->trigger();
  QTest::qWait(3000);
  QVERIFY(this->Window->grab().save(folder + "/editor_truth2.png"));
}

int main(int argc, char** argv) { return runEditorTest<TestEditorTruth>(argc, argv); }
