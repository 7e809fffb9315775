// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditor.h"
#include "TestEditorSupport.h"

#include "dgtkMainWindow.h"
#include "dgtkSceneDocument.h"

#include <QAction>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QTest>
#include <QToolBar>
#include <QTreeWidget>

#include <cmath>

using dgtk::SceneItem;

namespace
{
void typeInto(QDialog& dialog, const char* name, const QString& text)
{
  QVERIFY(QTest::qWaitForWindowActive(&dialog));
  auto* field = dialog.findChild<QLineEdit*>(name);
  field->setFocus();
  field->selectAll();
  QTest::keyClicks(field, text);
}

void add(const QDialog& dialog) { QTest::mouseClick(dialog.findChild<QPushButton*>("add"), Qt::LeftButton); }
} // namespace

void TestEditor::whatIsBeingTypedIsSaved()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  const dgtk::SceneDocument& document = this->Window->document();
  this->select("tree");
  const auto saved = [&]
  {
    dgtk::SceneDocument again;
    again.open(document.path());
    return again.scene().objects[3];
  };
  this->typeOnly("position.0", "12.5");
  QTest::keyClick(this->field("position.0"), Qt::Key_S, Qt::ControlModifier);
  QCOMPARE(saved().position.value.x(), 12.5);
  this->typeOnly("position.0", "13.5");
  auto* tools = this->Window->findChild<QToolBar*>("toolBar");
  QTest::mouseClick(tools->widgetForAction(this->action("save")), Qt::LeftButton);
  QCOMPARE(saved().position.value.x(), 13.5);
  this->typeOnly("class", "oak");
  QTest::keyClick(this->field("class"), Qt::Key_S, Qt::ControlModifier);
  QCOMPARE(saved().className, std::string("oak"));
  this->typeOnly("position.0", "14.5");
  answer<QMessageBox>("unsavedBox", [](QMessageBox& box) { box.button(QMessageBox::Save)->click(); });
  QVERIFY(this->Window->close());
  QCOMPARE(saved().position.value.x(), 14.5);
}

void TestEditor::whatIsBeingTypedIsKept()
{
  QVERIFY(this->Window->openFile(demo()));
  dgtk::SceneDocument& document = this->Window->document();
  this->select("tree");
  this->typeOnly("position.0", "12.5");
  document.editItem("another change", { SceneItem::Kind::Object, 3 },
    [](dgtk::SceneDescription& scene) { scene.objects[3].position.value.y() = 2; });
  QCOMPARE(this->field("position.0")->text(), QString("12.5"));
  QCOMPARE(this->field("position.1")->text(), QString("2"));
  QTest::keyClick(this->field("position.0"), Qt::Key_Return);
  QCOMPARE(document.scene().objects[3].position.value, Eigen::Vector3d(12.5, 2, -3.4));
  this->typeOnly("class", "oak");
  document.undo();
  QCOMPARE(this->field("class")->text(), QString("oak"));
  QCOMPARE(this->field("position.0")->text(), QString("4.2"));
  this->action("undo")->trigger();
  QVERIFY(document.scene().objects[3].className != "oak");
  QVERIFY(this->field("class")->text() != "oak");
}

void TestEditor::quaternionsAreTypedAsOne()
{
  QVERIFY(this->Window->openFile(demo()));
  dgtk::SceneDocument& document = this->Window->document();
  const auto rotation = [&] { return document.scene().objects[3].orientation.value; };
  this->select("tree");
  const dgtk::Quaternion before = rotation();
  this->typeOnly("orientation.0", "0.7071");
  this->typeOnly("orientation.1", "0.7071");
  this->typeOnly("orientation.2", "0");
  this->typeOnly("orientation.3", "0");
  QVERIFY(rotation() == before);
  this->field("position.0")->setFocus();
  QVERIFY(std::abs(rotation().norm() - 1) < 1e-15);
  QVERIFY(std::abs(rotation().x - std::sqrt(0.5)) < 1e-15);
  QVERIFY(std::abs(this->field("rotation.0")->text().toDouble() - 90) < 1e-9);
  this->typeOnly("orientation.0", "0.6");
  this->type("orientation.1", "0.8");
  QCOMPARE(rotation().w, 0.6);
  QCOMPARE(rotation().x, 0.8);
  QString message;
  expectRefusal(message);
  this->typeOnly("orientation.0", "0");
  this->type("orientation.1", "0");
  QVERIFY2(message.contains("tree"), qPrintable(message));
  QCOMPARE(this->field("orientation.1")->text(), QString("0.8"));
}

void TestEditor::aRefusalComesOnce()
{
  QVERIFY(this->Window->openFile(demo()));
  this->select("tree");
  int boxes = 0;
  QTimer closer;
  connect(&closer, &QTimer::timeout, &closer,
    [&]
    {
      if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget()))
      {
        ++boxes;
        QCOMPARE(this->field("name")->text(), QString("tree"));
        box->accept();
      }
    });
  closer.start(50);
  this->type("name", "house");
  QTest::qWait(settle);
  QCOMPARE(boxes, 1);
  QCOMPARE(this->field("name")->text(), QString("tree"));
}

void TestEditor::dialogsKeepWhatIsRefused()
{
  const dgtk::SceneDocument& document = this->Window->document();
  QString message;
  const auto refuseThenAdd = [&](const char* dialogName, const char* field, const QString& bad, const QString& good)
  {
    answer<QDialog>(dialogName,
      [&, dialogName, field, bad, good](QDialog& dialog)
      {
        typeInto(dialog, "name", "Top");
        typeInto(dialog, field, bad);
        expectRefusal(message);
        add(dialog);
        QVERIFY2(!message.isEmpty(), dialogName);
        QVERIFY(dialog.isVisible());
        QCOMPARE(dialog.findChild<QLineEdit*>("name")->text(), QString("Top"));
        typeInto(dialog, field, good);
        add(dialog);
        QVERIFY(!dialog.isVisible());
      });
  };
  refuseThenAdd("cameraDialog", "fovY.0", "190", "50");
  this->action("camera")->trigger();
  QCOMPARE(document.scene().cameras.at(0).name, std::string("Top"));
  QCOMPARE(document.scene().cameras.at(0).fovY.value, 50.0);
  refuseThenAdd("lightDialog", "diffuse.0", "-1", "0.5");
  this->action("light")->trigger();
  QCOMPARE(document.scene().lights.at(0).name, std::string("Top"));
  answer<QDialog>("cameraArrayDialog",
    [](QDialog& dialog)
    {
      typeInto(dialog, "fovY.0", "190");
      add(dialog);
      QVERIFY(dialog.findChild<QLabel*>("fault")->isVisible());
      typeInto(dialog, "fovY.0", "50");
      add(dialog);
      QVERIFY(!dialog.isVisible());
    });
  this->action("cameraArray")->trigger();
  QCOMPARE(document.scene().cameras.size(), std::size_t(9));
}

void TestEditor::hugeSizesAreRefused()
{
  QVERIFY(this->Window->openFile(demo()));
  const dgtk::SceneDocument& document = this->Window->document();
  const std::string first = document.json();
  this->select(document.scene().cameras.front().name.c_str());
  for (const char* size : { "4294967936", "1e300", "-1e300" }) // the first is 640 to an int that wraps
  {
    QString message;
    expectRefusal(message);
    this->type("size.0", size);
    QVERIFY2(!message.isEmpty(), size);
    QCOMPARE(document.json(), first);
  }
}
