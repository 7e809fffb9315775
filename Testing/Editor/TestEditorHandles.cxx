// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorHandles.h"
#include "TestEditorSupport.h"

#include "dgtkFile.h"
#include "dgtkMainWindow.h"
#include "dgtkSceneDocument.h"
#include "dgtkScenePlaces.h"
#include "dgtkViewCamera.h"
#include "dgtkViewHandles.h"

#include <QAction>
#include <QApplication>
#include <QComboBox>
#include <QDialog>
#include <QImage>
#include <QLineEdit>
#include <QStatusBar>
#include <QTest>

#include <cmath>

using dgtk::test::sourceFile;

namespace
{
constexpr double pi = 3.14159265358979323846;

const double arrow = dgtk::ViewHandles::length();
} // namespace

dgtk::SceneDocument& TestEditorHandles::document() const { return this->Window->document(); }

const dgtk::ObjectDescription& TestEditorHandles::object(std::size_t index) const
{
  return this->document().scene().objects[index];
}

QWidget* TestEditorHandles::view(int kind) const
{
  return this->Window->findChild<QWidget*>("view." + QString::number(kind));
}

dgtk::ViewCamera TestEditorHandles::camera(int kind) const
{
  const dgtk::ScenePlaces places = dgtk::placeScene(this->document().scene(), this->document().models(), 0);
  dgtk::WorldBox box;
  for (const dgtk::ObjectPlace& place : places.objects)
  {
    box.add(place.box);
  }
  dgtk::ViewCamera camera(static_cast<dgtk::ViewKind>(kind));
  camera.frame(box.empty() ? places.box : box, double(this->view(kind)->width()) / this->view(kind)->height());
  return camera;
}

double TestEditorHandles::unit(int kind) const { return this->camera(kind).height() / this->view(kind)->height(); }

Eigen::Vector2d TestEditorHandles::exactPixelOf(int kind, const Eigen::Vector3d& point) const
{
  return this->camera(kind).pixel(point, this->view(kind)->width(), this->view(kind)->height()).value();
}

QPoint TestEditorHandles::pixelOf(int kind, const Eigen::Vector3d& point) const
{
  const Eigen::Vector2d at = this->exactPixelOf(kind, point);
  return QPoint(int(std::lround(at.x())), int(std::lround(at.y())));
}

/// Whether the status bar begins so.
bool TestEditorHandles::told(const QString& words) const
{
  return this->Window->statusBar()->currentMessage().startsWith(words);
}

void TestEditorHandles::openCrate()
{
  QVERIFY(this->Window->importFile(QString::fromStdString(sourceFile("Data/Models/crate.ac"))));
  this->action("handlesAtOrigin")->trigger(); // in the middle of its base
  this->action("frameAll")->trigger();
  untilQuiet();
}

void TestEditorHandles::press(int kind, const QPoint& at) const
{
  QTest::mousePress(this->view(kind), Qt::LeftButton, {}, at);
}

void TestEditorHandles::move(int kind, const QPoint& at, Qt::KeyboardModifiers modifiers) const
{
  moveMouse(this->view(kind), at, Qt::LeftButton, modifiers);
  QCoreApplication::processEvents();
}

void TestEditorHandles::release(int kind, const QPoint& at) const
{
  QTest::mouseRelease(this->view(kind), Qt::LeftButton, {}, at);
  QCoreApplication::processEvents();
}

void TestEditorHandles::drag(int kind, const QPoint& from, const QPoint& to, Qt::KeyboardModifiers modifiers) const
{
  this->press(kind, from);
  for (int step = 1; step <= 4; ++step)
  {
    this->move(kind, from + (to - from) * step / 4, modifiers);
  }
  this->move(kind, to, modifiers);
  this->release(kind, to);
}

void TestEditorHandles::arrowsMove()
{
  this->openCrate();
  const std::string first = this->document().json();
  const QPoint center = this->pixelOf(front, { 0, 0, 0 });
  const double u = this->unit(front);
  // The other component of the mouse's way has no effect.
  this->drag(front, center + QPoint(60, 0), center + QPoint(110, 20));
  QVERIFY(near(this->object().position.value, { 50 * u, 0, 0 }));
  QCOMPARE(this->document().undoText(), std::string("Move"));
  this->action("undo")->trigger();
  QCOMPARE(this->document().json(), first);
  this->drag(front, center - QPoint(0, 60), center - QPoint(15, 100));
  QVERIFY(near(this->object().position.value, { 0, 40 * u, 0 }));
  this->action("undo")->trigger();
  QVERIFY(!this->document().canUndo() || this->document().undoText() != "Move");
}

void TestEditorHandles::squaresAndKeysKeepToPlanes()
{
  this->openCrate();
  const QPoint center = this->pixelOf(front, { 0, 0, 0 });
  const double u = this->unit(front);
  // Between a quarter and a half of two arrows lies the square of their plane.
  const QPoint square = center + QPoint(int(0.38 * arrow), -int(0.38 * arrow));
  this->drag(front, square, square + QPoint(30, 25));
  QVERIFY(near(this->object().position.value, { 30 * u, -25 * u, 0 }));
  this->action("undo")->trigger();

  this->press(front, center);
  this->move(front, center + QPoint(20, -10));
  this->move(front, center + QPoint(40, -30));
  QVERIFY(near(this->object().position.value, { 40 * u, 30 * u, 0 }));
  QVERIFY(this->told(QString("Move by %1, %2, 0 ").arg(40 * u, 0, 'g', 4).arg(30 * u, 0, 'g', 4)));
  QTest::keyClick(this->view(front), Qt::Key_X);
  QVERIFY(this->told(QString("Move by %1, 0, 0 ").arg(40 * u, 0, 'g', 4)));
  QVERIFY(near(this->object().position.value, { 40 * u, 0, 0 }));
  QTest::keyClick(this->view(front), Qt::Key_Y);
  QVERIFY(near(this->object().position.value, { 0, 30 * u, 0 }));
  QTest::keyClick(this->view(front), Qt::Key_X, Qt::ShiftModifier);
  QVERIFY(std::abs(this->object().position.value.x()) < handleTolerance);
  QTest::keyClick(this->view(front), Qt::Key_Y);
  QTest::keyClick(this->view(front), Qt::Key_Y);
  QVERIFY(near(this->object().position.value, { 40 * u, 30 * u, 0 }));
  this->release(front, center + QPoint(40, -30));
  this->action("undo")->trigger();
  QCOMPARE(this->object().position.value, Eigen::Vector3d(0, 0, 0));
}

void TestEditorHandles::ringsRotate()
{
  this->openCrate();
  QTest::keyClick(this->Window.get(), Qt::Key_2);
  QVERIFY(this->action("rotate")->isChecked());
  const QPoint center = this->pixelOf(front, { 0, 0, 0 });
  const auto onRing = [&](double degrees)
  {
    return center + QPoint(int(std::lround(arrow * std::cos(degrees * pi / 180))),
                      -int(std::lround(arrow * std::sin(degrees * pi / 180))));
  };
  const Eigen::Vector2d exact = this->exactPixelOf(front, { 0, 0, 0 });
  const auto angleOf = [&](const QPoint& p) { return std::atan2(exact.y() - p.y(), p.x() - exact.x()); };
  // The ring about z is seen whole from the front.
  const double expected = angleOf(onRing(70)) - angleOf(onRing(20));
  this->drag(front, onRing(20), onRing(70));
  const dgtk::Quaternion q = this->object().orientation.value;
  QVERIFY(std::abs(2 * std::atan2(q.z, q.w) - expected) < handleTolerance);
  QCOMPARE(q.x, 0.0);
  QCOMPARE(q.y, 0.0);
  QCOMPARE(this->object().position.value, Eigen::Vector3d(0, 0, 0));
  QCOMPARE(this->document().undoText(), std::string("Rotate"));
  this->action("undo")->trigger();

  // More than half a turn, by steps of 15 degrees.
  this->press(front, onRing(20));
  for (int degrees = 40; degrees <= 220; degrees += 20)
  {
    this->move(front, onRing(degrees), Qt::ControlModifier);
  }
  this->release(front, onRing(220));
  QVERIFY(this->told(QString::fromUtf8("Rotate 195\u00b0 about Z ")));
  const dgtk::Quaternion turned = this->object().orientation.value;
  QVERIFY(std::abs(turned.w - std::cos(195 * pi / 360)) < 1e-12);
  QVERIFY(std::abs(turned.z - std::sin(195 * pi / 360)) < 1e-12);
  this->action("undo")->trigger();

  // A ring seen from its edge turns by its rim: the one about y when the mouse goes to the right.
  this->press(front, center + QPoint(30, 0));
  this->move(front, center + QPoint(31, 0));
  this->move(front, center + QPoint(70, 0));
  this->release(front, center + QPoint(70, 0));
  const dgtk::Quaternion wheel = this->object().orientation.value;
  QVERIFY(std::abs(2 * std::atan2(wheel.y, wheel.w) - 40 / arrow) < handleTolerance);
}

/// Below a parent of uneven scale; about the axis of the odd scale they do not.
void TestEditorHandles::turnsThatShearSaySo()
{
  this->openCrate();
  this->action("rotate")->trigger();
  this->action("duplicate")->trigger();
  const QPoint centers[] = { this->pixelOf(front, { 0, 0, 0 }), this->pixelOf(top, { 0, 0, 0 }) };
  this->document().edit("Hang",
    [](dgtk::SceneDescription& scene)
    {
      scene.objects[0].scale = Eigen::Vector3d(1, 0.5, 1);
      scene.objects[1].parent = scene.objects[0].name;
    });
  for (const int kind : { front, top })
  {
    const int half = int(std::lround(arrow * std::sqrt(0.5)));
    const QPoint end = centers[kind] + QPoint(-half, -half);
    this->press(kind, centers[kind] + QPoint(half, -half));
    this->move(kind, centers[kind] + QPoint(0, -half));
    this->move(kind, end, Qt::ControlModifier);
    const bool shears = kind == front;
    QVERIFY(this->told(QString::fromUtf8("Rotate 90\u00b0 about ") + (shears ? "Z" : "Y")));
    QCOMPARE(this->told(QString::fromUtf8("Rotate 90\u00b0 about Z, sheared by the parent's uneven scale ")), shears);
    this->release(kind, end);
    this->action("undo")->trigger();
  }
}

void TestEditorHandles::boxesScale()
{
  this->openCrate();
  this->type("rotation.2", "90"); // the crate's x axis is up
  this->action("frameAll")->trigger();
  QTest::keyClick(this->Window.get(), Qt::Key_3);
  const QPoint center = this->pixelOf(front, { 0, 0, 0 });
  const QPoint from = center - QPoint(0, int(arrow));
  const QPoint to = center - QPoint(9, int(1.5 * arrow));
  const double middle = this->exactPixelOf(front, { 0, 0, 0 }).y();
  this->drag(front, from, to);
  QVERIFY(near(this->object().scale.value, { (middle - to.y()) / (middle - from.y()), 1, 1 }));
  QCOMPARE(this->object().scale.value.y(), 1.0);
  QVERIFY(this->told(QString("Scale by %1, 1, 1 ").arg((middle - to.y()) / (middle - from.y()), 0, 'g', 4)));
  QCOMPARE(this->document().undoText(), std::string("Scale"));
  this->action("undo")->trigger();
  QCOMPARE(this->object().scale.value, Eigen::Vector3d(1, 1, 1));
  // The middle scales evenly: half an arrow to the right and up is a factor of 1 + sqrt(1/2).
  this->drag(front, center, center + QPoint(40, -40));
  QVERIFY(near(this->object().scale.value, Eigen::Vector3d::Constant(1 + 80 / std::sqrt(2.0) / arrow)));
  QVERIFY(this->told(QString("Scale by %1 ").arg(1 + 80 / std::sqrt(2.0) / arrow, 0, 'g', 4)));
}

void TestEditorHandles::modelsFarFromTheirOriginTurnInPlace()
{
  // A box of 4 x 2 x 2, written in world coordinates as some programs do.
  const Eigen::Vector3d middle(1000, 50, -300);
  std::string obj;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Eigen::Vector3d at = middle + Eigen::Vector3d(corner & 1 ? 2 : -2, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
    obj += "v " + std::to_string(at.x()) + ' ' + std::to_string(at.y()) + ' ' + std::to_string(at.z()) + '\n';
  }
  obj += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  dgtk::writeFile(this->Folder.path("far.obj"), obj);
  QVERIFY(this->Window->importFile(this->path("far.obj")));
  this->action("frameAll")->trigger();
  untilQuiet();
  const std::string first = this->document().json();
  const QPoint center = this->pixelOf(front, middle);
  const Eigen::Vector2d exact = this->exactPixelOf(front, middle);

  // Turned, the middle stays: p = c - R c.
  this->action("rotate")->trigger();
  const auto onRing = [&](double degrees)
  {
    return center + QPoint(int(std::lround(arrow * std::cos(degrees * pi / 180))),
                      -int(std::lround(arrow * std::sin(degrees * pi / 180))));
  };
  const auto angleOf = [&](const QPoint& p) { return std::atan2(exact.y() - p.y(), p.x() - exact.x()); };
  const double angle = angleOf(onRing(70)) - angleOf(onRing(20));
  this->drag(front, onRing(20), onRing(70));
  const dgtk::Quaternion q = this->object().orientation.value;
  QVERIFY(std::abs(2 * std::atan2(q.z, q.w) - angle) < handleTolerance);
  const Eigen::Vector3d turned(std::cos(angle) * middle.x() - std::sin(angle) * middle.y(),
    std::sin(angle) * middle.x() + std::cos(angle) * middle.y(), middle.z());
  QVERIFY((this->object().position.value - (middle - turned)).norm() < 1000 * handleTolerance);
  this->action("undo")->trigger();
  QCOMPARE(this->document().json(), first);

  // Scaled along x by f: p = (1 - f) c in x.
  this->action("scale")->trigger();
  const QPoint from = center + QPoint(int(arrow), 0);
  const QPoint to = center + QPoint(int(1.5 * arrow), 8);
  const double factor = (to.x() - exact.x()) / (from.x() - exact.x());
  this->drag(front, from, to);
  QVERIFY(near(this->object().scale.value, { factor, 1, 1 }));
  QVERIFY(
    (this->object().position.value - Eigen::Vector3d((1 - factor) * middle.x(), 0, 0)).norm() < 1000 * handleTolerance);
  this->action("undo")->trigger();
  QCOMPARE(this->document().json(), first);

  this->action("move")->trigger();
  this->drag(front, from, to);
  QVERIFY(near(this->object().position.value, { (to.x() - from.x()) * this->unit(front), 0, 0 }));
  this->action("undo")->trigger();

  // At the origin, a thousand units away, there is nothing to be held: the thing itself is.
  this->action("scale")->trigger();
  this->action("handlesAtOrigin")->trigger();
  this->drag(front, from, to);
  QCOMPARE(this->document().undoText(), std::string("Move"));
}

void TestEditorHandles::severalTurnAboutTheirCommonBox()
{
  this->openCrate();
  this->action("duplicate")->trigger();
  this->type("scale.0", "3");
  this->type("position.0", "10");
  const dgtk::ScenePlaces places = dgtk::placeScene(this->document().scene(), this->document().models(), 0);
  const Eigen::Vector3d middle = places.box.center();
  QVERIFY((middle - Eigen::Vector3d(5, 0, 0)).norm() > 0.5); // the larger one counts for more
  this->action("selectAll")->trigger();
  this->action("frameAll")->trigger();
  this->action("rotate")->trigger();
  untilQuiet();
  const auto halfTurn = [&](const Eigen::Vector3d& pivot)
  {
    const QPoint center = this->pixelOf(front, pivot);
    const auto onRing = [&](double angle)
    { return center + QPoint(int(arrow * std::cos(angle)), -int(arrow * std::sin(angle))); };
    this->press(front, onRing(0.4));
    for (int i = 1; i <= 6; ++i)
    {
      this->move(front, onRing(0.4 + i * pi / 6), Qt::ControlModifier);
    }
    this->release(front, onRing(0.4 + pi));
    QVERIFY(near(this->object(0).position.value, 2 * pivot));
    QVERIFY(near(this->object(1).position.value, 2 * pivot - Eigen::Vector3d(10, 0, 0)));
    this->action("undo")->trigger();
  };
  halfTurn({ 5, 0, 0 });
  this->action("handlesAtOrigin")->trigger();
  halfTurn(middle);
}

void TestEditorHandles::controlSnaps()
{
  this->openCrate();
  const QPoint center = this->pixelOf(front, { 0, 0, 0 });
  const double u = this->unit(front);
  const int way = int(0.8 / u); // nearer to one square than to none: a drag back to its start would be no step
  this->drag(front, center + QPoint(60, 0), center + QPoint(60 + way, 0), Qt::ControlModifier);
  const double x = this->object().position.value.x();
  QVERIFY(std::abs(x - way * u) < 1);
  QCOMPARE(x, std::round(x)); // a square of the grid of this scene is a unit
  QCOMPARE(x, 1.0);
  this->action("undo")->trigger();
  QTest::keyClick(this->Window.get(), Qt::Key_3);
  this->drag(front, center + QPoint(int(arrow), 0), center + QPoint(int(1.33 * arrow), 0), Qt::ControlModifier);
  QCOMPARE(this->object().scale.value, Eigen::Vector3d(1.3, 1, 1));
}

void TestEditorHandles::escapePutsBack()
{
  this->openCrate();
  this->type("position.0", "2");
  this->action("undo")->trigger();
  const std::string first = this->document().json();
  QVERIFY(this->document().canRedo());
  const QPoint center = this->pixelOf(front, { 0, 0, 0 });
  this->press(front, center + QPoint(60, 0));
  this->move(front, center + QPoint(80, 0));
  this->move(front, center + QPoint(140, 0));
  QVERIFY(this->object().position.value.x() > 0);
  QTest::keyClick(this->view(front), Qt::Key_Escape);
  QVERIFY(this->told("As it was before the drag"));
  QCOMPARE(this->document().json(), first);
  this->move(front, center + QPoint(190, 0));
  this->release(front, center + QPoint(190, 0));
  QCOMPARE(this->document().json(), first);
  QCOMPARE(this->field("position.0")->text(), QString("0"));
  // As if it had not been: what was undone before can be done again.
  this->action("redo")->trigger();
  QCOMPARE(this->object().position.value.x(), 2.0);
}

void TestEditorHandles::pictures()
{
  const QString folder = QString::fromLocal8Bit(qgetenv("DGTK_EDITOR_PICTURES"));
  if (folder.isEmpty())
  {
    return; // made by Documentation/Images/make_editor.py
  }
  this->Window->resize(1280, 860);
  QVERIFY(this->Window->openFile(demo()));
  this->select("crate one");
  this->action("frameSelected")->trigger();
  const auto save = [&](QWidget* widget, const char* name)
  {
    QTest::qWait(3 * settle);
    // A palette of 256 colours makes the pictures of views small.
    const bool view = widget->objectName().startsWith("view.");
    const QImage image =
      widget->grab().toImage().convertToFormat(view ? QImage::Format_Indexed8 : QImage::Format_RGB32);
    QVERIFY(image.save(folder + "/editor_" + name + ".png"));
  };
  for (const char* name : { "move", "rotate", "scale" })
  {
    this->action(name)->trigger();
    save(this->view(perspective), (std::string("handles_") + name).c_str());
  }
  save(this->view(perspective), "scene_lights");
  for (const char* name : { "camera", "cameraArray" })
  {
    answer<QDialog>({},
      [&](QDialog& dialog)
      {
        auto* kind = dialog.findChild<QComboBox*>(name == std::string("camera") ? "lens" : "kind");
        kind->setCurrentIndex(kind->count() - 1);
        save(&dialog, (std::string("new_") + name).c_str());
        dialog.reject();
      });
    this->action(name)->trigger();
  }
}

DGTK_EDITOR_TEST(TestEditorHandles);
