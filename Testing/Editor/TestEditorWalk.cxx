// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorWalk.h"
#include "TestEditorSupport.h"

#include "dgtkSceneDocument.h"
#include "dgtkViewHandles.h"

#include <QAbstractItemView>
#include <QAbstractScrollArea>
#include <QAction>
#include <QComboBox>
#include <QCompleter>
#include <QContextMenuEvent>
#include <QDialogButtonBox>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTreeWidget>

#include <cmath>

namespace
{
constexpr int namesWidth = 130; // of the time line, pixels
constexpr int cellWidth = 12;

/// Types the path, and clicks Open or Save.
void confirm(QFileDialog& dialog, const QString& path)
{
  auto* field = dialog.findChild<QLineEdit*>("fileNameEdit");
  QTest::mouseClick(field, Qt::LeftButton);
  QTRY_VERIFY(field->hasFocus()); // otherwise what is typed gives way to the list's selection
  QTest::keyClick(field, Qt::Key_A, Qt::ControlModifier);
  QTest::keyClicks(field, path);
  field->completer()->popup()->hide(); // a click beside it would
  // A folder on the way whose contents Qt read late stays selected, and would be opened in place of the file.
  dialog.findChild<QAbstractItemView*>("listView")->clearSelection();
  QCOMPARE(field->text(), path);
  QCOMPARE(dialog.selectedFiles(), QStringList(path));
  auto* buttons = dialog.findChild<QDialogButtonBox*>();
  QTest::mouseClick(
    buttons->button(dialog.acceptMode() == QFileDialog::AcceptSave ? QDialogButtonBox::Save : QDialogButtonBox::Open),
    Qt::LeftButton);
}
} // namespace

QWidget* TestEditorWalk::view(int kind) const
{
  return this->Window->findChild<QWidget*>("view." + QString::number(kind));
}

QWidget* TestEditorWalk::cells() const
{
  return this->Window->findChild<QAbstractScrollArea*>("timeLineCells")->viewport();
}

QPoint TestEditorWalk::cellOf(int frame) { return { namesWidth + frame * cellWidth + cellWidth / 2, 5 }; }

void TestEditorWalk::import(const char* model) const
{
  const std::size_t before = this->Window->document().scene().objects.size();
  const QString path = QString::fromStdString(dgtk::test::sourceFile(std::string("Data/Models/") + model));
  answer<QFileDialog>({}, [path](QFileDialog& dialog) { confirm(dialog, path); });
  this->choose("import");
  QTRY_COMPARE(this->Window->document().scene().objects.size(), before + 1);
  untilQuiet();
}

void TestEditorWalk::saveAs(const QString& path) const
{
  answer<QFileDialog>({}, [path](QFileDialog& dialog) { confirm(dialog, path); });
  this->choose("save");
  QTRY_COMPARE(QString::fromStdString(this->Window->document().path()), path);
  QVERIFY(!this->Window->isWindowModified());
}

void TestEditorWalk::addCamera() const
{
  answer<QDialog>("cameraDialog",
    [](QDialog& dialog)
    {
      const std::pair<const char*, const char*> typed[] = { { "eye.0", "1" }, { "eye.1", "2" }, { "eye.2", "8" },
        { "lookAt.0", "0" }, { "lookAt.1", "0" }, { "lookAt.2", "0" }, { "fovY.0", "45" } };
      for (const auto& [name, text] : typed)
      {
        typeInto(dialog.findChild<QLineEdit*>(name), text);
      }
      QTest::mouseClick(dialog.findChild<QPushButton*>("add"), Qt::LeftButton);
    });
  this->choose("camera");
  const std::vector<dgtk::CameraDescription>& cameras = this->Window->document().scene().cameras;
  QCOMPARE(cameras.size(), std::size_t(1));
  QCOMPARE(cameras[0].eye.value, Eigen::Vector3d(1, 2, 8));
  QCOMPARE(cameras[0].fovY.value, 45.0);
}

void TestEditorWalk::drag(int kind, const QPoint& from, const QPoint& to) const
{
  QWidget* const widget = this->view(kind);
  QTest::mousePress(widget, Qt::LeftButton, {}, from);
  for (int step = 1; step <= 6; ++step)
  {
    moveMouse(widget, from + (to - from) * step / 6, Qt::LeftButton);
    QCoreApplication::processEvents();
  }
  QTest::mouseRelease(widget, Qt::LeftButton, {}, to);
  QCoreApplication::processEvents();
}

void TestEditorWalk::makeKeyFrame(int frame) const
{
  QWidget* const cells = this->cells();
  const QPoint at = cellOf(frame);
  QTest::mouseClick(cells, Qt::LeftButton, {}, at);
  chooseInMenu("makeKey",
    [&]
    {
      QTest::mouseClick(cells, Qt::RightButton, {}, at);
      QContextMenuEvent event(QContextMenuEvent::Mouse, at, cells->mapToGlobal(at));
      QApplication::sendEvent(cells, &event);
    });
}

QImage TestEditorWalk::pictureOf(int kind) const
{
  untilQuiet();
  const QWidget* const view = this->view(kind);
  return this->Window->grab(QRect(view->mapTo(this->Window.get(), QPoint(0, 0)), view->size())).toImage();
}

int TestEditorWalk::greenPixels(int kind) const
{
  const QImage image = this->pictureOf(kind);
  int green = 0;
  for (int y = 0; y < image.height(); ++y)
  {
    for (int x = 0; x < image.width(); ++x)
    {
      const QColor color = image.pixelColor(x, y);
      green += color.green() > color.red() + 80 && color.green() > color.blue() + 80 ? 1 : 0;
    }
  }
  return green;
}

void TestEditorWalk::aStaticScene()
{
  this->choose("new");
  this->import("crate.ac");
  const dgtk::SceneDescription& scene = this->Window->document().scene();
  const QPoint middle = this->view(front)->rect().center();
  QTest::mouseClick(this->view(front), Qt::LeftButton, {}, QPoint(4, 4)); // beside it
  const int before = this->greenPixels(front);
  QTest::mouseClick(this->view(front), Qt::LeftButton, {}, middle);
  QVERIFY2(this->greenPixels(front) > before + 50, "a green box about what is selected");
  this->drag(front, middle, middle + QPoint(-60, 0));
  QVERIFY(scene.objects[0].position.value.x() < -0.1);
  QCOMPARE(scene.objects[0].position.value.z(), 0.0);
  this->import("tree.ac");
  this->addCamera();
  auto* tree = this->Window->findChild<QTreeWidget*>("sceneTree");
  this->select("Camera0");
  const QPoint row = tree->visualItemRect(tree->currentItem()).center();
  const QImage own = this->pictureOf(3);
  chooseInMenu("preview",
    [&]
    {
      QContextMenuEvent event(QContextMenuEvent::Mouse, row, tree->viewport()->mapToGlobal(row));
      QApplication::sendEvent(tree->viewport(), &event);
    });
  QTRY_VERIFY2(this->pictureOf(3) != own, "the camera's view");
  this->makeKeyFrame(0);
  this->makeKeyFrame(2);
  QCOMPARE(scene.keyFrames(), (std::vector<int>{ 0, 2 }));
  this->saveAs(this->path("static.scene"));
  this->renderAndCompare(this->path("static.scene"), { "color", "depth", "objects", "calibration" }, 48, 36);
}

void TestEditorWalk::aDynamicScene()
{
  this->choose("new");
  this->import("crate.ac");
  this->addCamera();
  this->makeKeyFrame(0);
  const dgtk::SceneDescription& scene = this->Window->document().scene();
  const QPoint middle = this->view(front)->rect().center();
  QTest::mouseClick(this->cells(), Qt::LeftButton, {}, cellOf(10));
  QTest::mouseClick(this->view(front), Qt::LeftButton, {}, middle);
  this->drag(front, middle, middle + QPoint(60, -30));
  const Eigen::Vector3d moved = scene.objects[0].position.at(10);
  QVERIFY(moved.x() > 0.1);
  QVERIFY(std::abs(moved.y() - moved.x() / 2) < 1e-9);
  QCOMPARE(scene.objects[0].position.at(0), Eigen::Vector3d(0, 0, 0));
  this->makeKeyFrame(10);
  QCOMPARE(scene.keyFrames(), (std::vector<int>{ 0, 10 }));
  // Rotated by its context menu and the ring about the direction of view.
  QTest::mouseClick(this->cells(), Qt::LeftButton, {}, cellOf(20));
  const QPoint center = middle + QPoint(60, -30);
  chooseInMenu("rotate", [&] { QTest::mouseClick(this->view(front), Qt::RightButton, {}, center); });
  const double radius = dgtk::ViewHandles::length();
  const auto onRing = [&](double angle)
  { return center + QPoint(int(radius * std::cos(angle)), -int(radius * std::sin(angle))); };
  untilQuiet();
  this->drag(front, onRing(0.5), onRing(1.3));
  const dgtk::Quaternion turned = scene.objects[0].orientation.at(20);
  QVERIFY2(std::abs(turned.z - std::sin(0.4)) < 0.02, qPrintable(QString::number(turned.z)));
  QVERIFY(std::abs(turned.x) + std::abs(turned.y) < 1e-9);
  this->makeKeyFrame(20);
  this->saveAs(this->path("dynamic.scene"));
  this->renderAndCompare(this->path("dynamic.scene"), { "depth", "objects", "flow_forward" }, 48, 32);
  dgtk::SceneDocument again;
  again.open(this->path("dynamic.scene").toStdString());
  QVERIFY((again.scene().objects[0].position.at(5) - moved / 2).norm() < 1e-12);
  QCOMPARE(again.scene().lastFrame(), 20);
}

/// The numbers of figure 4.15, in the render configuration.
void TestEditorWalk::aCameraOfTheThesis()
{
  this->choose("new");
  this->addCamera();
  this->choose("render");
  auto* dialog = this->Window->findChild<QDialog*>("renderDialog");
  activate(*dialog);
  turnTo(*dialog, 1);
  const std::pair<const char*, const char*> typed[] = { { "renderFov.0", "60" }, { "renderAspect.0", "1.33" },
    { "renderNear.0", "0.1" }, { "renderFar.0", "1000" } };
  for (const auto& [name, text] : typed)
  {
    typeInto(dialog->findChild<QLineEdit*>(name), text);
  }
  typeInto(dialog->findChild<QWidget*>("width"), "640");
  typeInto(dialog->findChild<QWidget*>("height"), "480");
  const dgtk::CameraDescription& camera = this->Window->document().scene().cameras.at(0);
  QCOMPARE(camera.fovY.value, 60.0);
  QCOMPARE(camera.aspect, 1.33);
  QCOMPARE(camera.far, 1000.0);
  // 2 (far - near) tan(60 / 2) / 480, and the same times the aspect over 640 (the thesis printed other digits).
  const QString said = dialog->findChild<QLabel*>("resolution")->text();
  QVERIFY2(said.contains("2.40539"), qPrintable(said));
  QVERIFY2(said.contains("2.39937"), qPrintable(said));
  const double away = Eigen::Vector3d(1, 2, 8).norm();
  QVERIFY2(said.contains(QString::number(2 * away * std::tan(std::acos(-1.0) / 6) / 480, 'g', 6)), qPrintable(said));
  QString message;
  expectRefusal(message);
  typeInto(dialog->findChild<QLineEdit*>("renderNear.0"), "2000"); // beyond far
  QTRY_VERIFY(!message.isEmpty());
  QCOMPARE(dialog->findChild<QLineEdit*>("renderNear.0")->text(), QString("0.1"));
  // Units of the scene, which are typed where nothing is selected.
  QTest::mouseClick(this->view(front), Qt::LeftButton, {}, QPoint(4, 4));
  this->type("units", "mm");
  QVERIFY(dialog->findChild<QLabel*>("resolution")->text().contains("2.40539 mm"));
  // Those with a matrix say what it means.
  this->select("Camera0");
  auto* lens = this->Window->findChild<QWidget*>("propertiesPanel")->findChild<QComboBox*>("lens");
  lens->setFocus();
  QTest::keyClick(lens, Qt::Key_Down);
  QTRY_VERIFY(this->Window->document().scene().cameras.at(0).K.has_value());
  QVERIFY2(this->Window->focusWidget() != nullptr && this->Window->focusWidget()->objectName() == "lens",
    "other rows, the focus where it was");
  QVERIFY(!dialog->findChild<QLineEdit*>("renderFov.0")->isEnabled());
  QVERIFY(std::abs(dialog->findChild<QLineEdit*>("renderFov.0")->text().toDouble() - 60) < 1e-9);
  this->type("principal.0", "300");
  QCOMPARE((*this->Window->document().scene().cameras.at(0).K)(0, 2), 300.0);
  QVERIFY(std::abs((*this->Window->document().scene().cameras.at(0).K)(1, 1) - 240 * std::sqrt(3.0)) < 1e-9);
  for (int step = 0; step < 2; ++step)
  {
    this->action("undo")->trigger();
  }
  QCOMPARE(this->field("fovY.0")->text(), QString("60"));
  // A matrix has no key frames.
  this->Window->document().editItem("keys", { dgtk::SceneItem::Kind::Camera, 0 },
    [](dgtk::SceneDescription& edited) {
      edited.cameras[0].fovY.keys = { { 0, 60, {} }, { 10, 30, {} } };
    });
  const std::string zooming = this->Window->document().json();
  lens = this->Window->findChild<QWidget*>("propertiesPanel")->findChild<QComboBox*>("lens");
  expectRefusal(message);
  QTest::keyClick(lens, Qt::Key_Down);
  QTRY_VERIFY2(message.contains("key frames"), qPrintable(message));
  QCOMPARE(this->Window->document().json(), zooming);
  QCOMPARE(lens->currentIndex(), 0);
}

DGTK_EDITOR_TEST(TestEditorWalk);
