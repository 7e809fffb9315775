// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorTruth.h"
#include "TestEditorTruthSupport.h"

#include "dgtkLayerReader.h"
#include "dgtkMainWindow.h"
#include "dgtkSceneDocument.h"

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QDialog>
#include <QElapsedTimer>
#include <QImage>
#include <QLabel>
#include <QProcess>
#include <QPushButton>
#include <QSpinBox>
#include <QTest>
#include <QTreeWidget>

#include <cmath>

namespace
{
constexpr int eventLimit = 200; // milliseconds, the mean of an event while pictures are made
constexpr int turns = 20;

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
  QTRY_VERIFY_WITH_TIMEOUT(picture->property("settled").toBool(), longest);
  const QImage first = picture->grab().toImage();
  QCOMPARE(picture->size(), view->size());

  QTest::mousePress(view, Qt::LeftButton, {}, QPoint(5, 5));
  QTest::mouseMove(view, QPoint(30, 5));
  QTest::mouseMove(view, QPoint(90, 5));
  QTest::mouseRelease(view, Qt::LeftButton, {}, QPoint(90, 5));
  QTRY_VERIFY_WITH_TIMEOUT(picture->property("settled").toBool() && picture->grab().toImage() != first, longest);
  const QImage turned = picture->grab().toImage();

  this->select("house");
  this->type("position.1", "3");
  QTRY_VERIFY_WITH_TIMEOUT(picture->property("settled").toBool() && picture->grab().toImage() != turned, longest);
  this->action("undo")->trigger();
  QTRY_VERIFY_WITH_TIMEOUT(picture->property("settled").toBool() && picture->grab().toImage() == turned, longest);

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
  QVERIFY(mean < patience * eventLimit);
}

void TestEditorTruth::theSceneMayChangeMeanwhile()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  dgtk::SceneDocument& document = this->Window->document();
  const std::string first = document.json();
  this->action("correspondence")->trigger();
  auto* dialog = this->Window->findChild<QDialog*>("matchDialog");
  this->action("show.flow_forward")->trigger();
  auto* view = this->Window->findChild<QWidget*>("view.3");
  auto* pane = dialog->findChild<QWidget*>("pane.0");
  auto* frame = this->Window->findChild<QSpinBox*>("frame");
  for (int i = 0; i < 28; ++i)
  {
    const dgtk::SceneItem object{ dgtk::SceneItem::Kind::Object, std::size_t(i) % 5 };
    document.editItem("Move", object,
      [&](dgtk::SceneDescription& scene) { scene.objects[object.index].position = Eigen::Vector3d(i, 0, -i); });
    hover(view, QPoint(3 * i, 2 * i));
    QTest::mouseClick(pane, Qt::LeftButton, {}, pane->rect().center() + QPoint(i, i));
    frame->setValue(i % 3);
    if (i % 7 == 0)
    {
      document.remove({ document.scene().items()[std::size_t(i) % document.scene().items().size()] });
    }
    QCoreApplication::processEvents();
  }
  while (document.canUndo())
  {
    document.undo();
  }
  QCOMPARE(document.json(), first);
  this->action("new")->trigger();
  QTRY_VERIFY(dialog->findChild<QComboBox*>("camera.0")->count() == 0);
  QCOMPARE(textOf(dialog, "match.to"), QString("-"));
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
  QTRY_VERIFY_WITH_TIMEOUT(view->findChild<QWidget*>("truthPicture")->property("settled").toBool(), longest);
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
