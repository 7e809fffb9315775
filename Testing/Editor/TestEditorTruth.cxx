// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorTruth.h"
#include "TestEditorSupport.h"

#include "dgtkFile.h"
#include "dgtkLayerReader.h"
#include "dgtkMainWindow.h"
#include "dgtkSceneDocument.h"

#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QClipboard>
#include <QComboBox>
#include <QDialog>
#include <QElapsedTimer>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QMouseEvent>
#include <QProcess>
#include <QPushButton>
#include <QSpinBox>
#include <QTableWidget>
#include <QTest>
#include <QTreeWidget>
#include <QWheelEvent>

#include <cmath>

namespace
{
constexpr int longest = 30000;  // milliseconds, of a picture on a busy machine
constexpr int eventLimit = 200; // milliseconds, the mean of an event while pictures are made
constexpr int turns = 20;

/// Where an image point of a pane is in its widget.
QPoint widgetPoint(QWidget* pane, const QPointF& image)
{
  QPointF point;
  QMetaObject::invokeMethod(pane, "toWidget", Q_RETURN_ARG(QPointF, point), Q_ARG(QPointF, image));
  return { int(std::floor(point.x())), int(std::floor(point.y())) };
}

/// The mouse without a button.
void hover(QWidget* widget, const QPoint& at)
{
  QMouseEvent move(QEvent::MouseMove, at, widget->mapToGlobal(at), Qt::NoButton, Qt::NoButton, Qt::NoModifier);
  QApplication::sendEvent(widget, &move);
}

QString textOf(QWidget* dialog, const char* label) { return dialog->findChild<QLabel*>(label)->text(); }

/// The row of the values' panel that begins so.
QString valueOf(QTreeWidget* panel, const QString& name)
{
  for (int i = 0; i < panel->topLevelItemCount(); ++i)
  {
    if (panel->topLevelItem(i)->text(0).startsWith(name))
    {
      return panel->topLevelItem(i)->text(1);
    }
  }
  return {};
}
} // namespace

void TestEditorTruth::render(const QString& layers, const QStringList& more) const
{
  const QString program = QString::fromLocal8Bit(qgetenv("DGTK"));
  QStringList words{ "render", demo(), "-o", this->path("out"), "--layers", layers, "--visibility", "ray", "--frames",
    "0", "--quiet" };
  QCOMPARE(QProcess::execute(program, words + more), 0);
}

void TestEditorTruth::layersReplaceColourAndFollowTheView()
{
  QVERIFY(this->Window->openFile(demo()));
  auto* view = this->Window->findChild<QWidget*>("view.3");
  auto* picture = view->findChild<QWidget*>("truthPicture");
  auto* choice = this->Window->findChild<QComboBox*>("truthLayer");
  QVERIFY(!picture->isVisible());
  QTest::keyClick(this->Window.get(), Qt::Key_2, Qt::ControlModifier);
  QVERIFY(picture->isVisible());
  QCOMPARE(choice->currentText(), QString("depth"));
  QVERIFY(this->action("show.depth")->isChecked());
  QTRY_COMPARE_WITH_TIMEOUT(picture->property("coarseness").toInt(), 1, longest);
  const QImage first = picture->grab().toImage();
  QCOMPARE(picture->size(), view->size());

  QTest::mousePress(view, Qt::LeftButton, {}, QPoint(5, 5));
  QTest::mouseMove(view, QPoint(30, 5));
  QTest::mouseMove(view, QPoint(90, 5));
  QTest::mouseRelease(view, Qt::LeftButton, {}, QPoint(90, 5));
  QTRY_VERIFY_WITH_TIMEOUT(picture->property("coarseness").toInt() == 1 && picture->grab().toImage() != first, longest);
  const QImage turned = picture->grab().toImage();

  this->select("house");
  this->type("position.1", "3");
  QTRY_VERIFY_WITH_TIMEOUT(
    picture->property("coarseness").toInt() == 1 && picture->grab().toImage() != turned, longest);
  this->action("undo")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(
    picture->property("coarseness").toInt() == 1 && picture->grab().toImage() == turned, longest);

  choice->setFocus();
  QTest::keyClick(choice, Qt::Key_Home);
  QCOMPARE(choice->currentIndex(), 0);
  QVERIFY(!picture->isVisible());
  QVERIFY(this->action("show.colour")->isChecked());
}

void TestEditorTruth::valuesAreTheDatasets()
{
  this->render("depth,triangles", { "--cameras", "left", "--triangles-format", "npy" });
  const dgtk::ImageData depth = dgtk::readLayerFile(this->Folder.path("out/left/depth/000000.npy"));
  const dgtk::ImageData triangles = dgtk::readLayerFile(this->Folder.path("out/left/triangles/000000.npy"));
  QVERIFY(this->Window->openFile(demo()));
  this->select("left");
  this->action("preview")->trigger();
  this->action("show.depth")->trigger();
  QVERIFY(this->Window->findChild<QLabel*>("truthSubject")->text().contains("left"));
  auto* view = this->Window->findChild<QWidget*>("view.3");
  auto* panel = this->Window->findChild<QTreeWidget*>("truthPanel");
  int surfaces = 0;
  for (int i = 1; i < 6; ++i)
  {
    hover(view, QPoint(view->width() / 2 - 60 + 20 * i, view->height() * i / 6));
    const QString before = valueOf(panel, "Pixel");
    QTRY_VERIFY_WITH_TIMEOUT(valueOf(panel, "Pixel") != before, longest);
    const QStringList words = valueOf(panel, "Pixel").remove(',').split(' '); // column C row R
    const int column = words[1].toInt();
    const int row = words[3].toInt();
    const double expected = depth.pixels.row<double>(row)[column];
    QCOMPARE(valueOf(panel, "Object") == "nothing", std::isinf(expected));
    if (std::isfinite(expected))
    {
      ++surfaces;
      QCOMPARE(valueOf(panel, "depth,").toDouble(), expected);
      QCOMPARE(valueOf(panel, "Triangle").toUInt(), triangles.pixels.row<std::uint32_t>(row)[column]);
    }
  }
  QVERIFY(surfaces > 2);
  panel->setFocus();
  QTest::keyClick(panel, Qt::Key_C, Qt::ControlModifier);
  QVERIFY(QApplication::clipboard()->text().contains("Pixel\tcolumn"));
  QEvent leave(QEvent::Leave);
  QApplication::sendEvent(view, &leave);
  QCOMPARE(panel->topLevelItemCount(), 1);
}

void TestEditorTruth::nothingWaitsForPictures()
{
  QVERIFY(this->Window->openFile(demo()));
  this->action("maximize")->trigger();
  this->action("show.alpha")->trigger(); // sixteen rays a pixel
  auto* view = this->Window->findChild<QWidget*>("view.3");
  QTest::mousePress(view, Qt::LeftButton, {}, QPoint(5, 5));
  QTest::mouseMove(view, QPoint(30, 5));
  QCoreApplication::processEvents();
  QElapsedTimer clock;
  clock.start();
  for (int step = 1; step <= turns; ++step)
  {
    QTest::mouseMove(view, QPoint(30 + 5 * step, 5));
    hover(view, QPoint(100 + step, 100));
    QCoreApplication::processEvents();
  }
  const qint64 mean = clock.elapsed() / turns;
  QTest::mouseRelease(view, Qt::LeftButton, {}, QPoint(30, 5));
  qInfo("%lld ms for a step of turning the view", static_cast<long long>(mean));
  QVERIFY(mean < eventLimit);
}

QWidget* TestEditorTruth::openMatches() const
{
  this->action("correspondence")->trigger();
  auto* dialog = this->Window->findChild<QDialog*>("matchDialog");
  for (const char* pane : { "pane.0", "pane.1" })
  {
    auto* widget = dialog->findChild<QWidget*>(pane);
    for (int i = 0; i < longest / 20 && widget->property("step").toInt() != 1; ++i)
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
  QTRY_VERIFY_WITH_TIMEOUT(textOf(dialog, "match.class") != "-", longest);
}

void TestEditorTruth::matchesAreTheDatasets()
{
  this->render("correspondence", { "--pairs", "left:right,right:left" });
  QVERIFY(this->Window->openFile(demo()));
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
  QVERIFY(this->Window->openFile(demo()));
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
    { "correspond", demo(), "--from", "left", "--to", "right", "--points", list });
  QVERIFY(program.waitForFinished(longestRun));
  QCOMPARE(program.readAllStandardOutput(), QByteArray::fromStdString(dgtk::readFile(list.toStdString())));

  table->selectRow(1);
  QTest::keyClick(table, Qt::Key_Delete);
  QCOMPARE(table->rowCount(), 2);
  QTest::mouseClick(dialog->findChild<QPushButton*>("clearPairs"), Qt::LeftButton);
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
  QTRY_VERIFY_WITH_TIMEOUT(textOf(dialog, "match.to").contains(table->item(2, 4)->text()), longest);

  dgtk::writeFile(this->Folder.path("broken.txt"), "1 2 3\n");
  QString message;
  answer<QMessageBox>("errorBox",
    [&](QMessageBox& box)
    {
      message = box.text();
      box.accept();
    });
  QVERIFY(!call("openPairs", this->path("broken.txt")));
  QVERIFY2(message.contains("broken.txt:1"), qPrintable(message));
  QCOMPARE(table->rowCount(), 3);
}

void TestEditorTruth::panesZoomAndPan()
{
  QVERIFY(this->Window->openFile(demo()));
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
  QTest::mouseMove(pane, middle + QPoint(30, 0));
  QTest::mouseMove(pane, middle + QPoint(60, 20));
  QTest::mouseRelease(pane, Qt::LeftButton, {}, middle + QPoint(60, 20));
  QVERIFY((imageAt(middle + QPoint(60, 20)) - before).manhattanLength() < 1e-9);
  QCOMPARE(textOf(dialog, "match.class"), QString("-")); // a drag picks nothing
  // Inside a pixel, and by a tenth.
  dialog->findChild<QCheckBox*>("centers")->setChecked(false);
  QTest::mouseClick(pane, Qt::LeftButton, {}, middle);
  QTRY_VERIFY_WITH_TIMEOUT(textOf(dialog, "match.class") != "-", longest);
  const double x = textOf(dialog, "match.from").section(':', 1).section(',', 0, 0).toDouble();
  QTest::keyClick(pane, Qt::Key_Right, Qt::ShiftModifier);
  const double moved = textOf(dialog, "match.from").section(':', 1).section(',', 0, 0).toDouble();
  QVERIFY(std::abs(moved - x - 0.1) < 1e-9);
  QTest::keyClick(pane, Qt::Key_0);
  QVERIFY((imageAt({ 0, 0 }) - corner).manhattanLength() < 1e-9);
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

void TestEditorTruth::pictures()
{
  const QString folder = QString::fromLocal8Bit(qgetenv("DGTK_EDITOR_PICTURES"));
  if (folder.isEmpty())
  {
    return; // made by Documentation/Images/make_editor.py
  }
  // Few colours make small files.
  const auto grab = [&](QWidget* widget, const char* name)
  {
    QTest::qWait(5 * settle);
    const QImage image =
      widget->grab().toImage().convertToFormat(QImage::Format_RGB555).convertToFormat(QImage::Format_RGB888);
    QVERIFY(image.save(folder + '/' + name));
  };
  this->Window->resize(1180, 760);
  QVERIFY(this->Window->openFile(demo()));
  this->select("left");
  this->action("preview")->trigger();
  this->action("show.depth")->trigger();
  this->action("maximize")->trigger();
  auto* view = this->Window->findChild<QWidget*>("view.3");
  QTest::qWait(settle);
  hover(view, view->rect().center() + QPoint(-30, 20));
  QTRY_COMPARE_WITH_TIMEOUT(view->findChild<QWidget*>("truthPicture")->property("coarseness").toInt(), 1, longest);
  grab(this->Window.get(), "editor_truth.png");
  this->action("show.colour")->trigger();
  QWidget* const dialog = this->openMatches();
  dialog->resize(920, 640);
  for (const QPointF& point : { QPointF(330, 250), QPointF(200, 330), QPointF(425, 280) })
  {
    this->clickMatch(dialog, 0, point);
    dialog->findChild<QPushButton*>("addPair")->click();
  }
  grab(dialog, "editor_correspondence.png");
}

int main(int argc, char** argv) { return runEditorTest<TestEditorTruth>(argc, argv); }
