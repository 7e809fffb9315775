// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorHandles.h"
#include "TestEditorSupport.h"

#include "dgtkMainWindow.h"
#include "dgtkSceneDocument.h"
#include "dgtkViewCamera.h"
#include "dgtkViewHandles.h"

#include <QAbstractScrollArea>
#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QContextMenuEvent>
#include <QDialog>
#include <QImage>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QSpinBox>
#include <QTest>
#include <QTreeWidget>

#include <cmath>

using dgtk::test::sourceFile;

void TestEditorHandles::keysAtTheCurrentFrame()
{
  this->openCrate();
  auto* frame = this->Window->findChild<QSpinBox*>("frame");
  QTest::keyClick(this->Window.get(), Qt::Key_K);
  frame->setValue(10);
  QTest::keyClick(this->Window.get(), Qt::Key_K);
  frame->setValue(4);
  const QPoint center = this->pixelOf(front, { 0, 0, 0 });
  this->drag(front, center + QPoint(60, 0), center + QPoint(100, 0));
  const auto& keys = this->object().position.keys;
  QCOMPARE(keys.size(), std::size_t(3));
  QCOMPARE(keys[1].frame, 4);
  QVERIFY(near(keys[1].value, { 40 * this->unit(front), 0, 0 }));
  QCOMPARE(keys[0].value, Eigen::Vector3d(0, 0, 0));
  QCOMPARE(keys[2].value, Eigen::Vector3d(0, 0, 0));
  QCOMPARE(this->object().orientation.keys.size(), std::size_t(2)); // a motion leaves rotations alone
}

void TestEditorHandles::childrenMoveInTheWorld()
{
  this->openCrate();
  this->action("duplicate")->trigger();
  this->document().edit("Hang",
    [](dgtk::SceneDescription& scene)
    {
      scene.objects[0].orientation = dgtk::Quaternion{ std::sqrt(0.5), 0, 0, std::sqrt(0.5) };
      scene.objects[0].scale = Eigen::Vector3d(2, 2, 2);
      scene.objects[1].parent = scene.objects[0].name;
    });
  this->select("crate-2");
  this->action("frameAll")->trigger();
  const QPoint center = this->pixelOf(front, { 0, 0, 0 });
  // To the right in the world is down in the parent, which is twice as large.
  this->drag(front, center + QPoint(60, 0), center + QPoint(100, 0));
  QVERIFY(near(this->object(1).position.value, { 0, -20 * this->unit(front), 0 }));
  this->action("undo")->trigger();
  // With its parent it goes once.
  this->action("selectAll")->trigger();
  this->drag(front, center + QPoint(60, 0), center + QPoint(100, 0));
  QVERIFY(near(this->object(0).position.value, { 40 * this->unit(front), 0, 0 }));
  QCOMPARE(this->object(1).position.value, Eigen::Vector3d(0, 0, 0));
}

void TestEditorHandles::camerasAndLightsTurn()
{
  this->openCrate();
  dgtk::CameraDescription camera;
  camera.name = "eye";
  camera.eye = Eigen::Vector3d(1, 0, 0);
  camera.lookAt = Eigen::Vector3d(1, 0, -3);
  this->document().addCamera(camera);
  this->select("eye");
  const QPoint center = this->pixelOf(top, { 1, 0, 0 });
  this->drag(top, center + QPoint(60, 0), center + QPoint(110, 0));
  const double moved = 50 * this->unit(top);
  const auto& now = [this]() -> const dgtk::CameraDescription& { return this->document().scene().cameras[0]; };
  QVERIFY(near(now().eye.value, { 1 + moved, 0, 0 }));
  QVERIFY(near(now().lookAt.value, { 1 + moved, 0, -3 }));
  this->action("undo")->trigger();
  this->action("rotate")->trigger();
  // Seen from above the ring about y is whole: a quarter turn to the left looks along -x. Away from the ends of the
  // other rings.
  const double radius = dgtk::ViewHandles::length();
  const auto onRing = [&](double angle)
  { return center + QPoint(int(radius * std::cos(angle)), -int(radius * std::sin(angle))); };
  this->press(top, onRing(0.5));
  this->move(top, onRing(1.2), Qt::ControlModifier);
  this->move(top, onRing(2.05), Qt::ControlModifier);
  this->release(top, onRing(2.05));
  QCOMPARE(now().eye.value, Eigen::Vector3d(1, 0, 0));
  QVERIFY(near(now().lookAt.value, { -2, 0, 0 }));
  QCOMPARE(now().up.value, Eigen::Vector3d(0, 1, 0));
}

void TestEditorHandles::everyViewMovesTheSame()
{
  this->openCrate();
  for (int kind = front; kind <= perspective; ++kind)
  {
    const dgtk::ViewCamera camera = this->camera(kind);
    const QWidget* const widget = this->view(kind);
    const double size = dgtk::ViewHandles::length() * camera.unit({ 0, 0, 0 }, widget->height());
    for (int axis = 0; axis < 3; ++axis)
    {
      const Eigen::Vector3d along = Eigen::Vector3d::Unit(axis);
      if (std::abs(camera.towardsEye({ 0, 0, 0 }).dot(along)) > 0.9)
      {
        continue; // this arrow points at the eye
      }
      const QPoint from = this->pixelOf(kind, 0.7 * size * along);
      const QPoint to = this->pixelOf(kind, 1.4 * size * along);
      this->drag(kind, from, to);
      const Eigen::Vector3d position = this->object().position.value;
      QVERIFY2(std::abs(position[axis] - 0.7 * size) < 0.03 * size, // pixels are whole
        qPrintable(QString("view %1, axis %2: %3").arg(kind).arg(axis).arg(position[axis] / size)));
      QVERIFY((position - position[axis] * along).norm() < handleTolerance);
      this->action("undo")->trigger();
    }
  }
}

void TestEditorHandles::choose(QWidget* widget, const QPoint& at, const QString& name)
{
  chooseInMenu(name,
    [&]
    {
      if (widget->objectName().startsWith("view."))
      {
        QTest::mouseClick(widget, Qt::RightButton, {}, at);
        return;
      }
      QTest::mouseClick(widget, Qt::LeftButton, {}, at);
      QContextMenuEvent event(QContextMenuEvent::Mouse, at, widget->mapToGlobal(at));
      QApplication::sendEvent(widget, &event);
    });
}

void TestEditorHandles::theContextMenu()
{
  this->openCrate();
  dgtk::CameraDescription camera;
  camera.name = "eye";
  camera.eye = Eigen::Vector3d(3, 1, 9);
  this->document().addCamera(camera);
  auto* tree = this->Window->findChild<QTreeWidget*>("sceneTree");
  const auto row = [tree](const char* name)
  { return tree->visualItemRect(tree->findItems(name, Qt::MatchExactly | Qt::MatchRecursive).first()).center(); };
  QWidget* const view = this->view(front);
  for (const bool inTree : { false, true })
  {
    QWidget* const widget = inTree ? tree->viewport() : view;
    const auto at = [&] { return inTree ? row("crate-1") : this->pixelOf(front, { 0.3, 0.7, 0 }); };
    choose(widget, at(), "rotate");
    QVERIFY(this->action("rotate")->isChecked());
    choose(widget, at(), "scale");
    QVERIFY(this->action("scale")->isChecked());
    choose(widget, at(), "move");
    QVERIFY(this->action("move")->isChecked());
    choose(widget, at(), "keyFrame");
    QCOMPARE(this->document().scene().keyFrames(), (std::vector<int>{ 0 }));
    this->action("undo")->trigger();
    choose(widget, at(), "duplicate");
    QCOMPARE(this->document().scene().objects.size(), std::size_t(2));
    this->action("undo")->trigger();
    choose(widget, at(), "copy");
    choose(widget, at(), "paste");
    QCOMPARE(this->document().scene().objects.size(), std::size_t(2));
    this->action("undo")->trigger();
    choose(widget, at(), "cut");
    QVERIFY(this->document().scene().objects.empty());
    this->action("undo")->trigger();
    choose(widget, at(), "delete");
    QVERIFY(this->document().scene().objects.empty());
    this->action("undo")->trigger();
    choose(widget, at(), "frameSelected");
    choose(widget, at(), "properties");
    QTRY_COMPARE(QApplication::focusWidget()->objectName(), QString("name"));
    choose(widget, at(), "rename");
    QTRY_VERIFY(qobject_cast<QLineEdit*>(QApplication::focusWidget()) != nullptr);
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Escape);
  }
  choose(tree->viewport(), row("eye"), "preview");
  this->select("crate-1");
  QVERIFY(!this->action("preview")->isEnabled());
}

void TestEditorHandles::renamesInTheTree()
{
  this->openCrate();
  QTest::keyClick(this->Window.get(), Qt::Key_F2);
  QTRY_VERIFY(qobject_cast<QLineEdit*>(QApplication::focusWidget()) != nullptr);
  QTest::keyClicks(QApplication::focusWidget(), "box");
  QTest::keyClick(QApplication::focusWidget(), Qt::Key_Return);
  QTRY_COMPARE(this->object().name, std::string("box"));
  QCOMPARE(this->field("name")->text(), QString("box"));
}

void TestEditorHandles::aCameraByItsMatrix()
{
  answer<QDialog>("cameraDialog",
    [](QDialog& dialog)
    {
      const auto number = [&](const char* name) { return dialog.findChild<QLineEdit*>(name); };
      number("fovY.0")->setFocus();
      number("fovY.0")->selectAll();
      QTest::keyClicks(number("fovY.0"), "90");
      number("size.0")->setFocus();
      QVERIFY(!number("K.0")->isEnabled());
      dialog.findChild<QComboBox*>("lens")->setCurrentIndex(1);
      QVERIFY(!number("fovY.0")->isEnabled());
      // It begins as what the field of view says.
      QVERIFY(std::abs(number("K.0")->text().toDouble() - 240) < handleTolerance);
      QCOMPARE(number("K.2")->text(), QString("320"));
      QCOMPARE(number("size.1")->text(), QString("480"));
      number("K.2")->setFocus();
      number("K.2")->selectAll();
      QTest::keyClicks(number("K.2"), "300.5");
      QTest::mouseClick(dialog.findChild<QPushButton*>("add"), Qt::LeftButton);
    });
  this->action("camera")->trigger();
  QCOMPARE(this->document().scene().cameras.size(), std::size_t(1));
  const dgtk::CameraDescription& added = this->document().scene().cameras[0];
  QVERIFY(added.K.has_value());
  QCOMPARE((*added.K)(0, 2), 300.5);
  QVERIFY(std::abs((*added.K)(1, 1) - 240) < handleTolerance);
  QCOMPARE(added.width, 640);
}

void TestEditorHandles::camerasAlongAPath()
{
  dgtk::CameraDescription camera;
  camera.name = "moving";
  camera.eye.keys = { { 0, Eigen::Vector3d(0, 1, 8) }, { 10, Eigen::Vector3d(4, 1, 8) } };
  this->document().addCamera(camera);
  this->select("moving");
  QString fault;
  answer<QDialog>("cameraArrayDialog",
    [&](QDialog& dialog)
    {
      auto* path = dialog.findChild<QPlainTextEdit*>("path");
      QCOMPARE(path->toPlainText(), QString("0 1 8 0 0 0\n4 1 8 0 0 0"));
      dialog.findChild<QSpinBox*>("count")->setValue(3);
      auto* add = dialog.findChild<QPushButton*>("add");
      path->appendPlainText("4 one 8");
      QTest::mouseClick(add, Qt::LeftButton);
      fault = dialog.findChild<QLabel*>("fault")->text();
      path->setPlainText("0 1 8\n4 1 8, 1 0 0");
      QTest::mouseClick(add, Qt::LeftButton);
    });
  this->action("cameraArray")->trigger();
  QVERIFY2(fault.contains("line 3") && fault.contains("one"), qPrintable(fault));
  QCOMPARE(this->document().scene().cameras.size(), std::size_t(4));
  QVERIFY(near(this->document().scene().cameras[2].eye.value, { 2, 1, 8 }));
  QVERIFY(near(this->document().scene().cameras[3].lookAt.value, { 1, 0, 0 }));
}

void TestEditorHandles::theScenesLightsLightTheViews()
{
  this->openCrate();
  QWidget* const widget = this->view(front);
  const QPoint on = this->pixelOf(front, { 0.2, 0.5, 0 });
  const auto brightness = [&]
  {
    untilQuiet();
    return widget->grab().toImage().pixelColor(on).value();
  };
  this->action("sceneLights")->trigger(); // a light at the eye
  const int head = brightness();
  dgtk::LightDescription light;
  light.name = "behind";
  light.kind = dgtk::LightKind::Directional;
  light.position = Eigen::Vector3d(0, 0, -5);
  this->document().addLight(light);
  QTRY_COMPARE(brightness(), head);
  this->action("sceneLights")->trigger();
  QTRY_VERIFY(brightness() < head - 20); // lit from behind
  QVERIFY(brightness() > 10);            // yet it can be seen
  this->action("sceneLights")->trigger();
  QTRY_COMPARE(brightness(), head);
}

void TestEditorHandles::theThesissStaticScene()
{
  // Appendix A.2, click by click.
  this->action("new")->trigger();
  QVERIFY(this->Window->importFile(QString::fromStdString(sourceFile("Data/Models/crate.ac"))));
  QVERIFY(this->Window->importFile(QString::fromStdString(sourceFile("Data/Models/ball.ac"))));
  this->action("frameAll")->trigger();
  untilQuiet();
  // "Click and drag the object to place it"
  QTest::mouseClick(this->view(front), Qt::LeftButton, {}, QPoint(2, 2));
  const double u = this->unit(front);
  const QPoint center = this->pixelOf(front, { 0.35, 0.75, 0 });
  QTest::mouseClick(this->view(front), Qt::LeftButton, {}, center);
  QCOMPARE(this->field("name")->text(), QString("crate-1"));
  this->drag(front, center, center + QPoint(70, 0));
  QVERIFY(near(this->object(0).position.value, { 70 * u, 0, 0 }));
  // "At least one camera", previewed by its context menu
  answer<QDialog>(
    "cameraDialog", [](QDialog& dialog) { QTest::mouseClick(dialog.findChild<QPushButton*>("add"), Qt::LeftButton); });
  this->action("camera")->trigger();
  auto* tree = this->Window->findChild<QTreeWidget*>("sceneTree");
  this->select("Camera0");
  choose(tree->viewport(),
    tree->visualItemRect(tree->findItems("Camera0", Qt::MatchExactly | Qt::MatchRecursive).first()).center(),
    "preview");
  // "Right click on the first frame: make key frame"; then on the third.
  auto* cells = this->Window->findChild<QAbstractScrollArea*>("timeLineCells")->viewport();
  for (const int frame : { 0, 2 })
  {
    choose(cells, QPoint(136 + frame * 12, 5), "makeKey");
  }
  QCOMPARE(this->document().scene().keyFrames(), (std::vector<int>{ 0, 2 }));
  const QString scene = this->path("static.scene");
  QVERIFY(this->Window->saveFile(scene));
  this->renderAndCompare(scene, { "color", "depth", "objects", "calibration" }, 48, 32);
}
