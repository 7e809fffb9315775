// SPDX-License-Identifier: BSD-3-Clause
// The correspondence tool.
#include "TestEditorTruth.h"
#include "TestEditorTruthSupport.h"

#include "dgtkFile.h"
#include "dgtkLayerReader.h"
#include "dgtkMainWindow.h"
#include "dgtkSceneDocument.h"
#include "dgtkSparseText.h"

#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QElapsedTimer>
#include <QLineEdit>
#include <QMessageBox>
#include <QProcess>
#include <QPushButton>
#include <QSignalSpy>
#include <QSpinBox>
#include <QTableWidget>
#include <QTest>
#include <QWheelEvent>

#include <cmath>
#include <cstddef>
#include <cstdint>

QWidget* TestEditorTruth::openMatches() const
{
  this->action("correspondence")->trigger();
  auto* dialog = this->Window->findChild<QDialog*>("matchDialog");
  for (const char* pane : { "pane.0", "pane.1" })
  {
    auto* widget = dialog->findChild<QWidget*>(pane);
    for (int i = 0; i < longestRun / 20 && widget->property("step").toInt() != 1; ++i)
    {
      QTest::qWait(20);
    }
  }
  return dialog;
}

void TestEditorTruth::clickMatch(QWidget* dialog, int side, const QPointF& image) const
{
  auto* pane = dialog->findChild<QWidget*>(QStringLiteral("pane.%1").arg(side));
  QTest::mouseClick(pane, Qt::LeftButton, {}, widgetPoint(pane, image));
  QTRY_VERIFY(textOf(dialog, "match.class") != "-");
}

void TestEditorTruth::matchesAreTheDatasets()
{
  this->render("correspondence", { "--pairs", "left:right,right:left" });
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  QWidget* const dialog = this->openMatches();
  const QString cameras[2] = { "left", "right" };
  int seen = 0;
  int others = 0;
  for (int side = 0; side < 2; ++side)
  {
    const std::string folder =
      this->path("out").toStdString() + '/' + (cameras[side] + "/correspondence_" + cameras[1 - side]).toStdString();
    const dgtk::ImageData places = dgtk::readLayerFile(folder + "/000000.npy");
    const dgtk::ImageData classes = dgtk::readLayerFile(folder + "/000000.png");
    for (const QPointF& point : { QPointF(330, 250), QPointF(200, 330), QPointF(3, 260), QPointF(636, 330),
           QPointF(290, 90), QPointF(258, 230), QPointF(425, 280) })
    {
      this->clickMatch(dialog, side, point);
      const QString from = textOf(dialog, "match.from");
      QVERIFY2(from.startsWith(cameras[side] + ", frame 0:"), qPrintable(from));
      const QStringList numbers = from.section(':', 1).split(',');
      const int column = int(numbers[0].toDouble());
      const int row = int(numbers[1].toDouble());
      QVERIFY(std::abs(column - point.x()) <= 2 && std::abs(row - point.y()) <= 2);
      QCOMPARE(numbers[0].toDouble(), column + 0.5);
      const int kind = classes.pixels.row<std::uint8_t>(row)[column];
      QVERIFY2(textOf(dialog, "match.class").startsWith(QString::number(kind)), qPrintable(from));
      if (kind == 0)
      {
        QCOMPARE(textOf(dialog, "match.to"), QString("-"));
        continue;
      }
      (kind == 1 ? seen : others) += 1;
      const QStringList there = textOf(dialog, "match.to").section(':', 1).split(',');
      QCOMPARE(there[0].toDouble(), places.pixels.row<double>(row)[2 * column]);
      QCOMPARE(there[1].toDouble(), places.pixels.row<double>(row)[2 * column + 1]);
      QVERIFY(textOf(dialog, "match.distance").section(' ', 0, 0).toDouble() < 1e-8);
    }
  }
  QVERIFY(seen >= 6);
  QVERIFY(others >= 1);
  dialog->findChild<QSpinBox*>("frame.1")->setValue(1);
  QTRY_VERIFY(textOf(dialog, "match.from").startsWith("right, frame 1"));
  QTest::mouseClick(dialog->findChild<QPushButton*>("swap"), Qt::LeftButton);
  QCOMPARE(dialog->findChild<QComboBox*>("camera.0")->currentText(), QString("right"));
  QCOMPARE(dialog->findChild<QSpinBox*>("frame.0")->value(), 1);
}

void TestEditorTruth::pairsAreThoseOfTheCommandLine()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  QWidget* const dialog = this->openMatches();
  auto* add = dialog->findChild<QPushButton*>("addPair");
  auto* table = dialog->findChild<QTableWidget*>("matchTable");
  QVERIFY(!add->isEnabled());
  dialog->findChild<QCheckBox*>("centers")->setChecked(false);
  for (const QPointF& point : { QPointF(330, 250), QPointF(200, 330), QPointF(3, 260) })
  {
    this->clickMatch(dialog, 0, point);
    QTest::mouseClick(add, Qt::LeftButton);
  }
  QCOMPARE(table->rowCount(), 3);
  this->clickMatch(dialog, 0, QPointF(200, 330));
  QTest::mouseClick(add, Qt::LeftButton); // it is there
  QCOMPARE(table->rowCount(), 3);
  QCOMPARE(table->currentRow(), 1);
  const QString list = this->path("pairs.txt");
  const auto call = [&](const char* what, const QString& path)
  {
    bool done = false;
    QMetaObject::invokeMethod(dialog, what, Q_RETURN_ARG(bool, done), Q_ARG(QString, path));
    return done;
  };
  QVERIFY(call("savePairs", list));
  QProcess program;
  program.start(QString::fromLocal8Bit(qgetenv("DGTK")),
    { "correspond", this->copyOfDemo(), "--from", "left", "--to", "right", "--points", list });
  QVERIFY(program.waitForFinished(longestRun));
  QCOMPARE(program.readAllStandardOutput(), QByteArray::fromStdString(dgtk::readFile(list.toStdString())));

  table->selectRow(1);
  QTest::keyClick(table, Qt::Key_Delete);
  QCOMPARE(table->rowCount(), 2);
  QString refusal;
  expectRefusal(refusal);
  QVERIFY(!call("savePairs", this->path("nowhere/list.txt")));
  QVERIFY2(refusal.contains("list.txt"), qPrintable(refusal)); // and the list still counts as not saved
  auto* clear = dialog->findChild<QPushButton*>("clearPairs");
  answer<QMessageBox>("unsavedPairsBox", [](QMessageBox& box) { box.button(QMessageBox::Cancel)->click(); });
  QTest::mouseClick(clear, Qt::LeftButton);
  QCOMPARE(table->rowCount(), 2);
  answer<QMessageBox>("unsavedPairsBox", [](QMessageBox& box) { box.button(QMessageBox::Discard)->click(); });
  QTest::mouseClick(clear, Qt::LeftButton);
  QCOMPARE(table->rowCount(), 0);
  QVERIFY(call("openPairs", list));
  QCOMPARE(table->rowCount(), 3);
  const QString again = this->path("again.txt");
  QVERIFY(call("savePairs", again));
  QCOMPARE(dgtk::readFile(again.toStdString()), dgtk::readFile(list.toStdString()));
  // A row shows its pair.
  dialog->findChild<QComboBox*>("camera.1")->setCurrentIndex(0);
  const QRect cell = table->visualItemRect(table->item(2, 1));
  QTest::mouseClick(table->viewport(), Qt::LeftButton, {}, cell.center());
  QCOMPARE(dialog->findChild<QComboBox*>("camera.1")->currentText(), QString("right"));
  QTRY_VERIFY(textOf(dialog, "match.to").contains(table->item(2, 4)->toolTip()));

  dgtk::writeFile(this->Folder.path("broken.txt"), "1 2 3\n");
  QString message;
  expectRefusal(message);
  QVERIFY(!call("openPairs", this->path("broken.txt")));
  QVERIFY2(message.contains("broken.txt:1"), qPrintable(message));
  QCOMPARE(table->rowCount(), 3);

  // Another scene has other pairs; those that are not saved are asked about.
  table->selectRow(0);
  QTest::keyClick(table, Qt::Key_Delete);
  answer<QMessageBox>("unsavedPairsBox", [](QMessageBox& box) { box.button(QMessageBox::Cancel)->click(); });
  QVERIFY(!this->Window->openFile(this->copyOfDemo()));
  QCOMPARE(table->rowCount(), 2);
  answer<QMessageBox>("unsavedPairsBox", [](QMessageBox& box) { box.button(QMessageBox::Discard)->click(); });
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  QCOMPARE(table->rowCount(), 0);
}

void TestEditorTruth::pairsOfAChangedSceneAreMarked()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  QWidget* const dialog = this->openMatches();
  auto* add = dialog->findChild<QPushButton*>("addPair");
  auto* table = dialog->findChild<QTableWidget*>("matchTable");
  for (const QPointF& point : { QPointF(330, 250), QPointF(200, 330), QPointF(3, 260) })
  {
    this->clickMatch(dialog, 0, point);
    QTest::mouseClick(add, Qt::LeftButton);
  }
  QCOMPARE(table->rowCount(), 3);
  const auto isMarked = [table](int row) { return !table->item(row, 0)->icon().isNull(); };
  const auto isAny = [&] { return isMarked(0) || isMarked(1) || isMarked(2); };
  QTest::qWait(settle);
  QVERIFY(!isAny());
  // An object that is renamed is another's in the rows that have it, and in no other.
  const QString name = table->item(0, 7)->text();
  this->select(qPrintable(name));
  this->type("name", "renamed");
  QTRY_VERIFY(isMarked(0));
  QVERIFY(table->item(0, 0)->toolTip().contains("Add pair"));
  for (int row = 1; row < 3; ++row)
  {
    QCOMPARE(isMarked(row), table->item(row, 7)->text() == name);
  }
  const QRect cell = table->visualItemRect(table->item(0, 1));
  QTest::mouseClick(table->viewport(), Qt::LeftButton, {}, cell.center());
  QTRY_VERIFY(add->isEnabled());
  QTest::mouseClick(add, Qt::LeftButton); // found anew
  QCOMPARE(table->rowCount(), 3);
  QCOMPARE(table->item(2, 7)->text(), QString("renamed"));
  this->action("undo")->trigger();
  QTRY_VERIFY(isMarked(2) && !isMarked(0) && !isMarked(1));
  // Without their camera all are.
  this->select("right");
  this->action("delete")->trigger();
  QTRY_VERIFY(isMarked(0) && isMarked(1) && isMarked(2));
}

void TestEditorTruth::manyPairsOpenAtOnce()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  QWidget* const dialog = this->openMatches();
  dgtk::SparseSet set{ { "left", 0, 640, 480 }, { "right", 0, 640, 480 }, {} };
  constexpr std::size_t many = 2000;
  for (std::size_t i = 0; i < many; ++i)
  {
    dgtk::SparseMatch match;
    match.from = { 0.5 + double(i % 640), 0.5 + double(i % 480) };
    match.to.pixel = match.from;
    match.to.visibility = dgtk::VisibilityClass::Visible;
    match.hit.object = std::uint32_t(1 + i % 3);
    set.matches.push_back(match);
  }
  const QString list = this->path("many.txt");
  dgtk::writeFile(list.toStdString(), dgtk::sparseText(set));
  auto* table = dialog->findChild<QTableWidget*>("matchTable");
  const QSignalSpy refreshed(table, SIGNAL(pairsChanged()));
  QElapsedTimer clock;
  clock.start();
  bool done = false;
  QMetaObject::invokeMethod(dialog, "openPairs", Q_RETURN_ARG(bool, done), Q_ARG(QString, list));
  qInfo("%lld ms to open %zu pairs", clock.elapsed(), many);
  QVERIFY(done);
  QCOMPARE(refreshed.size(), 1);
  QCOMPARE(table->rowCount(), int(many));
  QCOMPARE(table->item(4, 7)->text(), QString::fromStdString(this->Window->document().scene().objects[1].name));
}

void TestEditorTruth::panesZoomAndPan()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  QWidget* const dialog = this->openMatches();
  auto* pane = dialog->findChild<QWidget*>("pane.0");
  const QPoint middle = pane->rect().center();
  const auto imageAt = [&](const QPoint& widget)
  {
    QPointF point;
    QMetaObject::invokeMethod(pane, "toImage", Q_RETURN_ARG(QPointF, point), Q_ARG(QPointF, QPointF(widget)));
    return point;
  };
  const QPointF before = imageAt(middle);
  const QPointF corner = imageAt({ 0, 0 });
  for (int i = 0; i < 12; ++i)
  {
    QWheelEvent wheel(
      middle, pane->mapToGlobal(middle), {}, { 0, 120 }, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
    QApplication::sendEvent(pane, &wheel);
  }
  QVERIFY((imageAt(middle) - before).manhattanLength() < 1e-9);
  const double scale = 1 / (imageAt(middle + QPoint(1, 0)) - before).x();
  QVERIFY(scale > 10);
  QTest::mousePress(pane, Qt::LeftButton, {}, middle);
  moveMouse(pane, middle + QPoint(30, 0), Qt::LeftButton);
  moveMouse(pane, middle + QPoint(60, 20), Qt::LeftButton);
  QTest::mouseRelease(pane, Qt::LeftButton, {}, middle + QPoint(60, 20));
  QVERIFY((imageAt(middle + QPoint(60, 20)) - before).manhattanLength() < 1e-9);
  QCOMPARE(textOf(dialog, "match.class"), QString("-")); // a drag picks nothing
  // Inside a pixel, and by a tenth.
  dialog->findChild<QCheckBox*>("centers")->setChecked(false);
  QTest::mouseClick(pane, Qt::LeftButton, {}, middle);
  QTRY_VERIFY(textOf(dialog, "match.class") != "-");
  const double x = textOf(dialog, "match.from").section(':', 1).section(',', 0, 0).toDouble();
  QTest::keyClick(pane, Qt::Key_Right, Qt::ShiftModifier);
  const double moved = textOf(dialog, "match.from").section(':', 1).section(',', 0, 0).toDouble();
  QVERIFY(std::abs(moved - x - 0.1) < 1e-9);
  QTest::keyClick(pane, Qt::Key_0);
  QVERIFY((imageAt({ 0, 0 }) - corner).manhattanLength() < 1e-9);
  // Up to the last column.
  dialog->findChild<QCheckBox*>("centers")->setChecked(true);
  this->clickMatch(dialog, 0, QPointF(637.5, 250));
  for (int i = 0; i < 6; ++i)
  {
    QTest::keyClick(pane, Qt::Key_Right);
  }
  QCOMPARE(textOf(dialog, "match.from").section(':', 1).section(',', 0, 0).toDouble(), 639.5);
}

void TestEditorTruth::aStereoPairWithGroundTruth()
{
  // The tutorial of the user guide.
  QVERIFY(this->Window->importFile(QString::fromStdString(dgtk::test::sourceFile("Data/Models/crate.ac"))));
  answer<QDialog>("cameraArrayDialog",
    [](QDialog& dialog)
    {
      dialog.findChild<QComboBox*>("kind")->setCurrentText("Stereo pair");
      const auto type = [&dialog](const char* name, const char* text)
      {
        auto* field = dialog.findChild<QLineEdit*>(name);
        field->setFocus();
        field->selectAll();
        QTest::keyClicks(field, text);
      };
      type("eye.0", "1");
      type("eye.1", "1.5");
      type("eye.2", "3");
      type("lookAt.0", "0");
      type("lookAt.1", "0.4");
      type("lookAt.2", "0");
      type("spacing.0", "0.25");
      QTest::mouseClick(dialog.findChild<QPushButton*>("add"), Qt::LeftButton);
    });
  this->action("cameraArray")->trigger();
  QCOMPARE(this->Window->document().scene().cameras.size(), std::size_t(2));
  const QString scene = this->path("stereo.json");
  QVERIFY(this->Window->saveFile(scene));
  this->renderAndCompare(scene, { "depth", "disparity", "correspondence" }, 640, 480);
  this->Window->findChild<QDialog*>("renderDialog")->hide();

  QWidget* const dialog = this->openMatches();
  this->clickMatch(dialog, 0, { 300, 260 });
  const QString left = dialog->findChild<QComboBox*>("camera.0")->currentText();
  const QString right = dialog->findChild<QComboBox*>("camera.1")->currentText();
  const std::string folder = (scene + ".window/" + left).toStdString();
  const dgtk::ImageData there = dgtk::readLayerFile(folder + "/correspondence_" + right.toStdString() + "/000000.npy");
  const dgtk::ImageData disparity = dgtk::readLayerFile(folder + "/disparity/000000.pfm");
  const dgtk::ImageData depth = dgtk::readLayerFile(folder + "/depth/000000.npy");
  const QStringList from = textOf(dialog, "match.from").section(':', 1).split(',');
  const QStringList to = textOf(dialog, "match.to").section(':', 1).split(',');
  const int column = int(from[0].toDouble());
  const int row = int(from[1].toDouble());
  QCOMPARE(to[0].toDouble(), there.pixels.row<double>(row)[2 * column]);
  QCOMPARE(to[1].toDouble(), there.pixels.row<double>(row)[2 * column + 1]);
  QCOMPARE(textOf(dialog, "match.depthFrom").toDouble(), depth.pixels.row<double>(row)[column]);
  QCOMPARE(float(from[0].toDouble() - to[0].toDouble()), disparity.pixels.row<float>(row)[column]);
}
