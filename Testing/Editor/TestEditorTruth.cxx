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
#include <QLineEdit>
#include <QProcess>
#include <QPushButton>
#include <QSet>
#include <QSpinBox>
#include <QTest>
#include <QTreeWidget>

#include <cmath>

namespace
{
constexpr int truthEventLimit = 200; // milliseconds, the mean of an event while pictures are made
constexpr int turns = 20;

} // namespace

void TestEditorTruth::render(const QString& layers, const QStringList& more) const
{
  const QString program = QString::fromLocal8Bit(qgetenv("DGTK"));
  QStringList words{ "render", this->copyOfDemo(), "-o", this->path("out"), "--layers", layers, "--visibility", "ray",
    "--frames", "0", "--quiet", "--replace" };
  QCOMPARE(QProcess::execute(program, words + more), 0);
}

void TestEditorTruth::layersReplaceColourAndFollowTheView()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  auto* view = this->Window->findChild<QWidget*>("view.3");
  auto* picture = view->findChild<QWidget*>("truthPicture");
  auto* choice = this->Window->findChild<QComboBox*>("truthLayer");
  QVERIFY(!picture->isVisible());
  QTest::keyClick(this->Window.get(), Qt::Key_2, Qt::ControlModifier);
  QVERIFY(picture->isVisible());
  QCOMPARE(choice->currentText(), QString("depth"));
  QVERIFY(this->action("show.depth")->isChecked());
  QTRY_VERIFY(picture->property("settled").toBool());
  const QImage first = picture->grab().toImage();
  QCOMPARE(picture->size(), view->size());

  QTest::mousePress(view, Qt::LeftButton, {}, QPoint(5, 5));
  moveMouse(view, QPoint(30, 5), Qt::LeftButton);
  moveMouse(view, QPoint(90, 5), Qt::LeftButton);
  QTest::mouseRelease(view, Qt::LeftButton, {}, QPoint(90, 5));
  QTRY_VERIFY(picture->property("settled").toBool() && picture->grab().toImage() != first);
  const QImage turned = picture->grab().toImage();

  this->select("house");
  this->type("position.1", "3");
  QTRY_VERIFY(picture->property("settled").toBool() && picture->grab().toImage() != turned);
  this->action("undo")->trigger();
  QTRY_VERIFY(picture->property("settled").toBool() && picture->grab().toImage() == turned);

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
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  this->select("left");
  this->action("preview")->trigger();
  this->action("show.depth")->trigger();
  QVERIFY(this->Window->findChild<QLabel*>("truthSubject")->text().contains("left"));
  auto* view = this->Window->findChild<QWidget*>("view.3");
  auto* panel = this->Window->findChild<QTreeWidget*>("truthPanel");
  int surfaces = 0;
  for (int i = 1; i < 6; ++i)
  {
    moveMouse(view, QPoint(view->width() / 2 - 60 + 20 * i, view->height() * i / 6));
    const QString before = valueOf(panel, "Pixel");
    QTRY_VERIFY(valueOf(panel, "Pixel") != before);
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
  // The mouse goes to the panel, and the values stay.
  QEvent leave(QEvent::Leave);
  QApplication::sendEvent(view, &leave);
  const QString last = valueOf(panel, "Pixel");
  panel->setFocus();
  QTest::keyClick(panel, Qt::Key_C, Qt::ControlModifier);
  const QString copied = QApplication::clipboard()->text();
  QVERIFY2(copied.contains("Pixel\t" + last), qPrintable(copied));
  // In another frame they are of the past, and the hint is not copied.
  this->Window->findChild<QSpinBox*>("frame")->setValue(1);
  QCOMPARE(panel->topLevelItemCount(), 1);
  QTest::keyClick(panel, Qt::Key_C, Qt::ControlModifier);
  QCOMPARE(QApplication::clipboard()->text(), copied);
}

void TestEditorTruth::previewLeavesTheViewFree()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  dgtk::SceneDocument& document = this->Window->document();
  auto* view = this->Window->findChild<QWidget*>("view.3");
  auto* tree = this->Window->findChild<QTreeWidget*>("sceneTree");
  auto* subject = this->Window->findChild<QLabel*>("truthSubject");
  this->select("left");
  this->action("preview")->trigger();
  QVERIFY(subject->text().contains("left"));
  QTest::mousePress(view, Qt::LeftButton, {}, QPoint(40, 30));
  for (const int x : { 60, 80, 100 })
  {
    moveMouse(view, QPoint(x, 30), Qt::LeftButton);
  }
  QTest::mouseRelease(view, Qt::LeftButton, {}, QPoint(100, 30));
  QVERIFY2(subject->text().isEmpty(), "the drag turned the view");
  QVERIFY(!document.canUndo());
  this->action("preview")->trigger();
  for (const QPoint& at : { QPoint(3, 3), view->rect().center(), QPoint(view->width() - 9, view->height() - 9) })
  {
    QTest::mouseClick(view, Qt::LeftButton, {}, at);
    const QList<QTreeWidgetItem*> chosen = tree->selectedItems();
    QVERIFY2(chosen.isEmpty() || chosen.front()->text(0) != "left", "the camera itself is not met");
  }

  document.edit("Above",
    [](dgtk::SceneDescription& scene)
    {
      scene.cameras.front().eye = Eigen::Vector3d(0, 20, 0);
      scene.cameras.front().lookAt = Eigen::Vector3d(0, 0, 0);
      scene.cameras.front().up = Eigen::Vector3d(0, 0, -1);
    });
  this->select(document.scene().cameras.front().name.c_str());
  this->action("preview")->trigger();
  QString height;
  answer<QDialog>({},
    [&height](QDialog& dialog)
    {
      height = dialog.findChild<QLineEdit*>("eye.1")->text();
      dialog.reject();
    });
  this->action("camera")->trigger(); // starts where the view stands
  QCOMPARE(height, QString("20"));

  // A camera that is no longer one of the scene is not looked through; one that is not added yet may be.
  const dgtk::SceneItem first{ dgtk::SceneItem::Kind::Camera, 0 };
  document.edit("Rename", [&](dgtk::SceneDescription& scene) { renameItem(scene, first, "renamed"); });
  QCOMPARE(subject->text(), QString());
  this->select("renamed");
  this->action("preview")->trigger();
  QVERIFY(subject->text().contains("renamed"));
  document.remove({ first });
  QCOMPARE(subject->text(), QString());
  answer<QDialog>({},
    [](QDialog& dialog)
    {
      for (QPushButton* button : dialog.findChildren<QPushButton*>())
      {
        if (button->text() == "&Preview")
        {
          button->click();
        }
      }
      dialog.reject();
    });
  this->action("camera")->trigger();
  const QString previewed = subject->text();
  QVERIFY(!previewed.isEmpty());
  document.edit("Other", [](dgtk::SceneDescription& scene) { scene.fps = 50; });
  QCOMPARE(subject->text(), previewed);
}

/// Lens, roll, shape and motion are the camera's own, also in colour.
void TestEditorTruth::previewIsTheCamerasPicture()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  dgtk::SceneDocument& document = this->Window->document();
  document.edit("Camera",
    [](dgtk::SceneDescription& scene)
    {
      dgtk::CameraDescription& camera = scene.cameras.front();
      camera.posed = false;
      camera.eye.keys = { { 0, Eigen::Vector3d(0, 6, 16) }, { 20, Eigen::Vector3d(6, 6, 16) } };
      camera.lookAt = Eigen::Vector3d(0, 1, 0);
      camera.up = Eigen::Vector3d(0, 1, 0);
      camera.fovY = 40;
      camera.width = 300;
      camera.height = 300;
    });
  const std::string name = document.scene().cameras.front().name;
  auto* picture = this->Window->findChild<QWidget*>("view.3")->findChild<QWidget*>("truthPicture");
  this->select(name.c_str());
  QVERIFY(!picture->isVisible());
  this->action("preview")->trigger();
  QVERIFY(picture->isVisible());
  QImage seen;
  const auto changes = [&]
  {
    const QImage before = seen;
    const bool done = QTest::qWaitFor(
      [&]
      {
        seen = picture->grab().toImage();
        return picture->property("settled").toBool() && seen != before;
      },
      longestRun);
    return done;
  };
  QVERIFY(changes());
  const QImage first = seen;
  this->Window->findChild<QSpinBox*>("frame")->setValue(20);
  QVERIFY2(changes(), "it moves with the camera");
  this->Window->findChild<QSpinBox*>("frame")->setValue(0);
  QVERIFY(changes());
  QVERIFY(seen == first);
  for (const int what : { 0, 1, 2 })
  {
    document.edit("Lens",
      [what](dgtk::SceneDescription& scene)
      {
        dgtk::CameraDescription& camera = scene.cameras.front();
        camera.fovY = what == 0 ? 80 : 40;
        camera.up = what == 1 ? Eigen::Vector3d(1, 1, 0) : Eigen::Vector3d(0, 1, 0);
        camera.width = what == 2 ? 600 : 300;
      });
    QVERIFY2(changes(), "lens, roll and shape");
  }
  while (document.undoText() != "Camera")
  {
    document.undo();
  }
  QVERIFY(changes());
  QVERIFY(seen == first);
  this->action("frameAll")->trigger();
  QVERIFY2(!picture->isVisible(), "the view's own eye again");
}

void TestEditorTruth::clicksGoThroughThePicture()
{
  QVERIFY(this->Window->openFile(demo()));
  this->Window->document().edit("Wide",
    [](dgtk::SceneDescription& scene)
    {
      dgtk::CameraDescription& camera = scene.cameras.front();
      camera.posed = false;
      camera.eye.keys = { { 0, Eigen::Vector3d(0, 6, 16) }, { 1, Eigen::Vector3d(48, 6, 16) } };
      camera.lookAt = Eigen::Vector3d(0, 1, 0);
      camera.up = Eigen::Vector3d(0.3, 1, 0);
      camera.fovY = 90;
      camera.rollingShutter.duration = 1; // the lower half is seen from the side
    });
  auto* view = this->Window->findChild<QWidget*>("view.3");
  auto* overlay = view->findChild<QWidget*>("overlay");
  auto* panel = this->Window->findChild<QTreeWidget*>("truthPanel");
  auto* tree = this->Window->findChild<QTreeWidget*>("sceneTree");
  this->select(this->Window->document().scene().cameras.front().name.c_str());
  QVERIFY(overlay->isVisible());
  this->action("preview")->trigger();
  QVERIFY2(!overlay->isVisible(), "handles would not fit the picture");
  this->action("show.objects")->trigger();
  QVERIFY2(!overlay->isVisible(), "handles would not fit the picture");
  QSet<QString> met;
  for (int i = 0; i < 10; ++i)
  {
    const QPoint at(view->width() * (i % 5 + 1) / 6, view->height() * (i / 5 + 3) / 7);
    const QString before = valueOf(panel, "Pixel");
    moveMouse(view, at);
    QTRY_VERIFY(valueOf(panel, "Pixel") != before);
    QTest::mouseClick(view, Qt::LeftButton, {}, at);
    const QList<QTreeWidgetItem*> chosen = tree->selectedItems();
    const QString name = chosen.isEmpty() ? QString("nothing") : chosen.front()->text(0);
    QCOMPARE(valueOf(panel, "Object").section(" (", 0, 0), name);
    met.insert(name);
  }
  QVERIFY(met.size() > 2);
  QTest::mousePress(view, Qt::LeftButton, {}, view->rect().center());
  moveMouse(view, view->rect().center() + QPoint(30, 0), Qt::LeftButton);
  moveMouse(view, view->rect().center() + QPoint(60, 0), Qt::LeftButton);
  QTest::mouseRelease(view, Qt::LeftButton, {}, view->rect().center() + QPoint(60, 0));
  QVERIFY2(overlay->isVisible(), "the view's own eye again");
  QCOMPARE(this->Window->document().undoText(), std::string("Wide"));
}

void TestEditorTruth::nothingWaitsForPictures()
{
  QVERIFY(this->Window->openFile(demo()));
  this->action("maximize")->trigger();
  this->action("show.alpha")->trigger(); // sixteen rays a pixel
  auto* view = this->Window->findChild<QWidget*>("view.3");
  QTest::mousePress(view, Qt::LeftButton, {}, QPoint(5, 5));
  moveMouse(view, QPoint(30, 5), Qt::LeftButton);
  QCoreApplication::processEvents();
  QElapsedTimer clock;
  clock.start();
  for (int step = 1; step <= turns; ++step)
  {
    moveMouse(view, QPoint(30 + 5 * step, 5), Qt::LeftButton);
    moveMouse(view, QPoint(100 + step, 100));
    QCoreApplication::processEvents();
  }
  const qint64 mean = clock.elapsed() / turns;
  QTest::mouseRelease(view, Qt::LeftButton, {}, QPoint(30, 5));
  qInfo("%lld ms for a step of turning the view", static_cast<long long>(mean));
  QVERIFY(mean < patience() * truthEventLimit);
}

void TestEditorTruth::theSceneMayChangeMeanwhile()
{
  QVERIFY(this->Window->openFile(
    this->partOfDemo("changing.json", { "terrain", "house", "tree", "vase", "ball", "crate one", "crate two" })));
  dgtk::SceneDocument& document = this->Window->document();
  const std::string first = document.json();
  this->action("correspondence")->trigger();
  auto* dialog = this->Window->findChild<QDialog*>("matchDialog");
  this->action("show.flow_forward")->trigger();
  auto* view = this->Window->findChild<QWidget*>("view.3");
  auto* pane = dialog->findChild<QWidget*>("pane.0");
  auto* frame = this->Window->findChild<QSpinBox*>("frame");
  for (int i = 0; i < 15; ++i) // each object at each frame
  {
    const dgtk::SceneItem object{ dgtk::SceneItem::Kind::Object, std::size_t(i) % 5 };
    document.editItem("Move", object,
      [&](dgtk::SceneDescription& scene) { scene.objects[object.index].position = Eigen::Vector3d(i, 0, -i); });
    moveMouse(view, QPoint(3 * i, 2 * i));
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
  moveMouse(view, view->rect().center() + QPoint(-30, 20));
  QTRY_VERIFY(view->findChild<QWidget*>("truthPicture")->property("settled").toBool());
  grab(this->Window.get(), "editor_truth.png");
  this->action("show.colour")->trigger();
  QWidget* const dialog = this->openMatches();
  dialog->resize(1060, 700);
  for (const QPointF& point : { QPointF(330, 250), QPointF(200, 330), QPointF(425, 280) })
  {
    this->clickMatch(dialog, 0, point);
    dialog->findChild<QPushButton*>("addPair")->click();
  }
  grab(dialog, "editor_correspondence.png");
}

DGTK_EDITOR_TEST(TestEditorTruth);
