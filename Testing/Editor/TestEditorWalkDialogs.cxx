// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorSupport.h"
#include "TestEditorWalk.h"

#include "dgtkSceneDocument.h"

#include <QCheckBox>
#include <QDialog>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>

#include <fstream>

/// They have a height instead of an angle, and one size of a pixel at every depth.
void TestEditorWalk::aParallelCamera()
{
  dgtk::CameraDescription camera;
  camera.name = "above";
  camera.model = "orthographic";
  camera.viewHeight = 12;
  camera.width = 640;
  camera.height = 480;
  this->Window->document().addCamera(camera);
  this->choose("render");
  auto* dialog = this->Window->findChild<QDialog*>("renderDialog");
  activate(*dialog);
  turnTo(*dialog, 1);
  QCOMPARE(dialog->findChild<QLineEdit*>("renderFov.0")->text(), QString("12"));
  const auto* said = dialog->findChild<QLabel*>("resolution");
  QVERIFY2(said->text().contains("at every depth") && said->text().contains("0.025"), qPrintable(said->text()));
  typeInto(dialog->findChild<QLineEdit*>("renderFov.0"), "24");
  QCOMPARE(this->Window->document().scene().cameras[0].viewHeight.value, 24.0);
  QVERIFY2(said->text().contains("0.05"), qPrintable(said->text()));
}

/// Its rays are in a file beside the scene, wherever the editor was started.
void TestEditorWalk::aCameraOfATable()
{
  std::ofstream rays(this->path("rays.npy").toStdString(), std::ios::binary);
  const std::string head = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2, 3), }";
  rays << std::string("\x93NUMPY\x01\x00\x76\x00", 10) << head << std::string(117 - head.size(), ' ') << '\n';
  for (const double component : { -0.5, 0.5, 1.0, 0.5, 0.5, 1.0, -0.5, -0.5, 1.0, 0.5, -0.5, 1.0 })
  {
    rays.write(reinterpret_cast<const char*>(&component), sizeof component);
  }
  rays.close();
  std::ofstream(this->path("table.json").toStdString())
    << R"({"cameras":[{"name":"table","model":"raytable","rays":"rays.npy","width":2,"height":2,)"
       R"("eye":[0,0,5],"lookAt":[0,0,0]}]})";
  QVERIFY(this->Window->openFile(this->path("table.json")));
  this->choose("render");
  auto* dialog = this->Window->findChild<QDialog*>("renderDialog");
  activate(*dialog);
  turnTo(*dialog, 1);
  const QString said = dialog->findChild<QLabel*>("resolution")->text();
  QVERIFY2(!said.isEmpty() && !said.contains("no pose"), qPrintable(said));
}

/// Alt and its letter lead to each field of the dialogs.
void TestEditorWalk::lettersLeadToFields()
{
  for (const char* name : { "camera", "light", "cameraArray" })
  {
    int fields = 0;
    answer<QDialog>({},
      [&fields](QDialog& dialog)
      {
        for (const QLabel* label : dialog.findChildren<QLabel*>())
        {
          QWidget* const field = label->buddy();
          if (field == nullptr || !field->isEnabled())
          {
            continue;
          }
          const int at = label->text().indexOf('&');
          QVERIFY2(at >= 0, qPrintable(label->text()));
          dialog.setFocus();
          QTest::keyClick(&dialog, label->text().at(at + 1).toLatin1(), Qt::AltModifier);
          const QWidget* const focus = QApplication::focusWidget();
          QVERIFY2(focus != nullptr && (focus == field || field->isAncestorOf(focus)), qPrintable(label->text()));
          ++fields;
        }
        dialog.reject();
      });
    this->choose(name);
    QVERIFY2(fields >= 5, name);
  }
}

/// Of the render configuration and of file dialogs.
void TestEditorWalk::choicesAreKept()
{
  this->import("crate.ac");
  this->addCamera();
  this->saveAs(this->path("kept.json"));
  this->renderAndCompare(this->path("kept.json"), { "normal", "uv" }, 32, 24);
  this->Window->document().undo();
  this->Window = std::make_unique<dgtk::MainWindow>();
  this->Window->show();
  activate(*this->Window);
  this->choose("render");
  auto* dialog = this->Window->findChild<QDialog*>("renderDialog");
  QVERIFY(dialog->findChild<QCheckBox*>("layer.normal")->isChecked());
  QVERIFY(dialog->findChild<QCheckBox*>("layer.uv")->isChecked());
  QVERIFY(!dialog->findChild<QCheckBox*>("layer.depth")->isChecked());
  QTest::mouseClick(dialog->findChild<QPushButton*>("allLayers"), Qt::LeftButton);
  QVERIFY(dialog->findChild<QCheckBox*>("layer.depth")->isChecked());
  QTest::mouseClick(dialog->findChild<QPushButton*>("noLayers"), Qt::LeftButton);
  QVERIFY(!dialog->findChild<QCheckBox*>("layer.uv")->isChecked());
  dialog->close();
  const auto folderOf = [this](const char* action)
  {
    QString folder;
    answer<QFileDialog>({},
      [&folder](QFileDialog& files)
      {
        folder = files.directory().canonicalPath();
        files.reject();
      });
    this->choose(action);
    return folder;
  };
  QCOMPARE(folderOf("open"), QFileInfo(this->path("kept.json")).canonicalPath());
  QCOMPARE(folderOf("import"),
    QFileInfo(QString::fromStdString(dgtk::test::sourceFile("Data/Models/crate.ac"))).canonicalPath());
  QCOMPARE(folderOf("openDataset"), QFileInfo(this->path("kept.json.window")).canonicalFilePath());
}
