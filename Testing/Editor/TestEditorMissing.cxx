// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorFiles.h"
#include "TestEditorSupport.h"

#include "dgtkFile.h"
#include "dgtkMainWindow.h"
#include "dgtkSceneDocument.h"

#include <QAction>
#include <QFileDialog>
#include <QLabel>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QStatusBar>
#include <QTest>
#include <QTreeWidget>

using dgtk::test::sourceFile;

namespace
{
/// The second column of an object's row in the tree.
QString kindOf(const dgtk::MainWindow& window, const QString& name)
{
  const QList<QTreeWidgetItem*> rows =
    window.findChild<QTreeWidget*>("sceneTree")->findItems(name, Qt::MatchExactly | Qt::MatchRecursive);
  return rows.isEmpty() ? QString() : rows.front()->text(1);
}
} // namespace

QString TestEditorFiles::sceneWithoutModels() const
{
  const std::string file = this->Folder.path("lost.json");
  dgtk::writeFile(file, R"({ "objects": [ { "name": "box", "model": "models/crate.ac" },
    { "name": "toy", "model": "models/ball.ac", "position": [2, 0, 0] } ],
    "cameras": [ { "name": "eye", "eye": [0, 1, 5], "lookAt": [0, 0, 0] } ] })");
  return QString::fromStdString(file);
}

void TestEditorFiles::missingModelsAreBoxes()
{
  QString told;
  answer<QMessageBox>("missingBox",
    [&told](QMessageBox& box)
    {
      told = box.text() + box.informativeText();
      QCOMPARE(box.findChild<QLabel*>("qt_msgbox_informativelabel")->textFormat(), Qt::PlainText);
      QTest::keyClick(&box, Qt::Key_Escape);
    });
  QVERIFY(this->Window->openFile(this->sceneWithoutModels()));
  QVERIFY2(told.contains("2") && told.contains("models/crate.ac") && told.contains("models/ball.ac"), qPrintable(told));
  dgtk::SceneDocument& document = this->Window->document();
  QCOMPARE(document.absent().size(), std::size_t(2));
  QCOMPARE(kindOf(*this->Window, "box"), QString("missing"));
  QCOMPARE(kindOf(*this->Window, "toy"), QString("missing"));
  QVERIFY(this->action("findModels")->isEnabled());
  QVERIFY(!document.modified());

  // What is known about a box is not the dataset's.
  this->action("show.depth")->trigger();
  QVERIFY(this->Window->findChild<QWidget*>("view.3")->findChild<QLabel*>("draft")->isVisible());
  const std::string before = document.json();
  QVERIFY(this->Window->saveFile(this->path("copy.json")));
  QCOMPARE(document.json(), before);
}

void TestEditorFiles::missingModelsAreFound()
{
  const QString library = this->path("library");
  QVERIFY(QDir().mkpath(library + "/deep"));
  for (const char* name : { "crate.ac", "ball.ac" })
  {
    QVERIFY(
      QFile::copy(QString::fromStdString(sourceFile(std::string("Data/Models/") + name)), library + "/deep/" + name));
  }
  answer<QMessageBox>("missingBox",
    [library](QMessageBox& box)
    {
      answer<QFileDialog>({},
        [library](QFileDialog& dialog)
        {
          dialog.selectFile(library);
          static_cast<QDialog&>(dialog).accept();
        });
      box.findChild<QPushButton*>("findFolder")->click();
    });
  QVERIFY(this->Window->openFile(this->sceneWithoutModels()));
  dgtk::SceneDocument& document = this->Window->document();
  QCOMPARE(document.scene().objects[0].model, std::string("library/deep/crate.ac"));
  QVERIFY(document.absent().empty());
  QVERIFY(!this->action("findModels")->isEnabled());
  QVERIFY(kindOf(*this->Window, "box") != "missing");
  // Their textures are not there: the line that stays says so.
  const QString told = this->Window->statusBar()->currentMessage();
  QVERIFY2(told.startsWith("Found 2 of 2 models; warnings in the log: "), qPrintable(told));
  const QString log = this->Window->findChild<QPlainTextEdit*>("log")->toPlainText();
  QCOMPARE(log.count("Warning: "), told.section(' ', -1).toInt());
  this->action("undo")->trigger();
  QCOMPARE(document.scene().objects[0].model, std::string("models/crate.ac"));
  QCOMPARE(kindOf(*this->Window, "box"), QString("missing"));
}
