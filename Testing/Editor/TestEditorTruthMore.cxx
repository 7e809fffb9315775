// SPDX-License-Identifier: BSD-3-Clause
// What the correspondence tool begins with and undoes, and the language of the ground truth.
#include "TestEditorTruth.h"
#include "TestEditorTruthSupport.h"

#include "dgtkMainWindow.h"
#include "dgtkSceneDocument.h"

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QLineEdit>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QTableWidget>
#include <QTest>
#include <QToolButton>
#include <QTreeWidget>
#include <QVector>

void TestEditorTruth::selectedCamerasAreMatched()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  dgtk::SceneDocument& document = this->Window->document();
  document.edit("Third",
    [](dgtk::SceneDescription& scene)
    {
      scene.cameras.push_back(scene.cameras.front());
      scene.cameras.back().name = "third";
    });
  QWidget* dialog = nullptr;
  const auto cameras = [&](const QStringList& selected)
  {
    auto* tree = this->Window->findChild<QTreeWidget*>("sceneTree");
    tree->clearSelection();
    for (const QString& name : selected)
    {
      tree->findItems(name, Qt::MatchExactly | Qt::MatchRecursive).front()->setSelected(true);
    }
    QCoreApplication::processEvents();
    dialog = this->openMatches();
    const QString left = dialog->findChild<QComboBox*>("camera.0")->currentText();
    const QString right = dialog->findChild<QComboBox*>("camera.1")->currentText();
    dialog->hide();
    return left + ' ' + right;
  };
  QCOMPARE(cameras({ "right", "third" }), QString("right third"));
  QCOMPARE(cameras({}), QString("right third"));
  QCOMPARE(cameras({ "third" }), QString("third left"));
  QCOMPARE(cameras({ "right", "house" }), QString("right left"));
}

void TestEditorTruth::pairsAreUndone()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  QWidget* const dialog = this->openMatches();
  auto* table = dialog->findChild<QTableWidget*>("matchTable");
  auto* add = dialog->findChild<QPushButton*>("addPair");
  auto* undo = dialog->findChild<QToolButton*>("undoPairs");
  auto* redo = dialog->findChild<QToolButton*>("redoPairs");
  const auto rows = [table]
  {
    QStringList all;
    for (int row = 0; row < table->rowCount(); ++row)
    {
      all << table->item(row, 1)->toolTip() + ' ' + table->item(row, 2)->toolTip();
    }
    return all;
  };
  QVERIFY(!undo->isEnabled() && !redo->isEnabled());
  QVector<QStringList> states{ rows() };
  dialog->findChild<QCheckBox*>("centers")->setChecked(false);
  for (const QPointF& point : { QPointF(330, 250), QPointF(200, 330), QPointF(220, 335), QPointF(300, 300) })
  {
    this->clickMatch(dialog, 0, point);
    QTRY_VERIFY(add->isEnabled());
    QTest::mouseClick(add, Qt::LeftButton);
    states << rows();
  }
  QCOMPARE(table->rowCount(), 4);
  for (const int column : { 1, 2, 4, 5 })
  {
    const QTableWidgetItem* const item = table->item(1, column);
    QCOMPARE(item->text(), QString::number(item->toolTip().toDouble(), 'f', 3));
  }
  QVERIFY(table->item(1, 4)->toolTip().size() > table->item(1, 4)->text().size());
  table->clearSelection();
  for (const int row : { 0, 2 })
  {
    const bool first = row == 0;
    QTest::mouseClick(table->viewport(), Qt::LeftButton, first ? Qt::NoModifier : Qt::ControlModifier,
      table->visualItemRect(table->item(row, 1)).center());
  }
  QTest::keyClick(table, Qt::Key_Delete);
  QCOMPARE(table->rowCount(), 2);
  states << rows();
  answer<QMessageBox>("unsavedPairsBox", [](QMessageBox& box) { box.button(QMessageBox::Discard)->click(); });
  QTest::mouseClick(dialog->findChild<QPushButton*>("clearPairs"), Qt::LeftButton);
  states << rows();
  QCOMPARE(table->rowCount(), 0);
  activate(*dialog);
  for (int at = int(states.size()) - 2; at >= 0; --at)
  {
    QTest::keyClick(dialog, Qt::Key_Z, Qt::ControlModifier);
    QTRY_COMPARE(rows(), states[at]);
  }
  QVERIFY(!undo->isEnabled() && redo->isEnabled());
  for (int at = 1; at < states.size(); ++at)
  {
    QTest::keyClick(dialog, Qt::Key_Z, Qt::ControlModifier | Qt::ShiftModifier);
    QTRY_COMPARE(rows(), states[at]);
  }
  QVERIFY(undo->isEnabled() && !redo->isEnabled());
  QTest::mouseClick(undo, Qt::LeftButton);
  QTest::mouseClick(undo, Qt::LeftButton);
  QCOMPARE(rows(), states[4]);
  this->clickMatch(dialog, 0, QPointF(340, 250));
  QTRY_VERIFY(add->isEnabled());
  QTest::mouseClick(add, Qt::LeftButton);
  QVERIFY(!redo->isEnabled());
  QVERIFY(!this->Window->document().canUndo());
}

void TestEditorTruth::germanIsSpokenOfTheTruth()
{
  const German german;
  QVERIFY(this->Window->openFile(demo()));
  auto* picture = this->Window->findChild<QWidget*>("view.3")->findChild<QWidget*>("truthPicture");
  auto* frame = this->Window->findChild<QSpinBox*>("frame");
  this->action("show.flow_forward")->trigger();
  frame->setValue(this->Window->document().scene().lastFrame());
  QTRY_COMPARE(
    picture->property("caption").toString(), QString("flow_forward: dafür braucht es ein Bild der Szene nach diesem"));
  this->action("show.flow_backward")->trigger();
  frame->setValue(this->Window->document().scene().firstFrame());
  QTRY_COMPARE(
    picture->property("caption").toString(), QString("flow_backward: dafür braucht es ein Bild der Szene vor diesem"));
  QCOMPARE(this->action("show.surface")->text(), QString("Picture"));
  this->action("show.depth_noisy")->trigger(); // the scene is seen from far away
  QTRY_COMPARE(
    picture->property("caption").toString(), QString("depth_noisy: alles außerhalb der Reichweite des Tiefensensors"));
  this->action("show.flow_forward")->trigger();
  auto* view = this->Window->findChild<QWidget*>("view.3");
  auto* panel = this->Window->findChild<QTreeWidget*>("truthPanel");
  moveMouse(view, view->rect().center());
  QTRY_VERIFY(valueOf(panel, "flow forward,").contains('\n'));
  QVERIFY(panel->findItems("flow forward,\nPixel", Qt::MatchExactly).size() == 1);

  QStringList faults;
  answer<QDialog>("cameraArrayDialog",
    [&faults](QDialog& dialog)
    {
      const auto add = [&]
      {
        QTest::mouseClick(dialog.findChild<QPushButton*>("add"), Qt::LeftButton);
        faults << dialog.findChild<QLabel*>("fault")->text();
      };
      const auto type = [&dialog](const char* name, const char* text)
      {
        auto* field = dialog.findChild<QLineEdit*>(name);
        field->setFocus();
        field->selectAll();
        QTest::keyClicks(field, text);
      };
      auto* path = dialog.findChild<QPlainTextEdit*>("path");
      dialog.findChild<QComboBox*>("kind")->setCurrentText("Entlang eines Wegs");
      for (const char* const text : { "1 2 drei", "1 2 3\n1 2", "1 2 3" })
      {
        path->setPlainText(text);
        add();
      }
      dialog.findChild<QComboBox*>("kind")->setCurrentText("Stereopaar");
      type("spacing.0", "0");
      add();
      type("spacing.0", "1");
      for (const char* const name : { "eye.0", "eye.1", "eye.2", "lookAt.0", "lookAt.1", "lookAt.2" })
      {
        type(name, "1");
      }
      add();
      type("eye.1", "5");
      add();
      dialog.reject();
    });
  this->action("cameraArray")->trigger();
  const QStringList expected{ QString::fromUtf8("Weg: Zeile 1: \u201edrei\u201c ist keine Zahl"),
    "Weg: Zeile 2: 3 oder 6 Zahlen erwartet, 2 gefunden", "Weg: mindestens zwei verschiedene Punkte erwartet",
    QString::fromUtf8("Abstand: eine Zahl \u00fcber 0 erwartet"), "Auge und Blickpunkt einer Kamera fallen zusammen",
    "Oben einer Kamera ist null oder parallel zu ihrem Blick" };
  QCOMPARE(faults, expected);
}
