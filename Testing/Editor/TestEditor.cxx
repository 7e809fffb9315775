// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditor.h"
#include "TestEditorSupport.h"

#include "dgtkMainWindow.h"
#include "dgtkSceneDocument.h"
#include "dgtkViewCamera.h"

#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QClipboard>
#include <QDialog>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QLineEdit>
#include <QMessageBox>
#include <QOpenGLWidget>
#include <QProcess>
#include <QPushButton>
#include <QSettings>
#include <QSpinBox>
#include <QSplitter>
#include <QStandardPaths>
#include <QStatusBar>
#include <QTest>
#include <QToolButton>
#include <QTreeWidget>

#include <cmath>

using dgtk::test::sourceFile;

void TestEditor::opensSelectsMovesUndoesSavesAndRenders()
{
  QVERIFY(this->Window->openFile(demo()));
  dgtk::SceneDocument& document = this->Window->document();
  const std::string first = document.json();
  this->select("tree");
  QCOMPARE(this->field("name")->text(), QString("tree"));
  QCOMPARE(this->field("position.0")->text(), QString("4.2"));
  this->type("position.0", "3.25");
  this->type("position.1", "0.5");
  this->type("rotation.1", "90");
  QCOMPARE(document.scene().objects[3].position.value, Eigen::Vector3d(3.25, 0.5, -3.4));
  QVERIFY(std::abs(document.scene().objects[3].orientation.value.y - std::sqrt(0.5)) < 1e-15);
  QVERIFY(this->Window->isWindowModified());
  QTest::keyClick(this->Window.get(), Qt::Key_Z, Qt::ControlModifier);
  QTest::keyClick(this->Window.get(), Qt::Key_Z, Qt::ControlModifier);
  QCOMPARE(document.scene().objects[3].position.value, Eigen::Vector3d(3.25, 0, -3.4));
  QCOMPARE(this->field("position.1")->text(), QString("0"));
  this->action("undo")->trigger();
  QCOMPARE(document.json(), first);
  QVERIFY(!this->Window->isWindowModified());
  this->action("redo")->trigger();

  const QString scene = this->path("moved.json");
  QVERIFY(this->Window->saveFile(scene));
  QVERIFY(!this->Window->isWindowModified());

  this->renderAndCompare(scene, { "color", "depth" }, 64, 48);
}

void TestEditor::clicksSelectAndDragsMove()
{
  QVERIFY(this->Window->importFile(QString::fromStdString(sourceFile("Data/Models/crate.ac"))));
  untilQuiet();
  dgtk::SceneDocument& document = this->Window->document();
  auto* front = this->Window->findChild<QOpenGLWidget*>("view.0");
  const QPoint middle = front->rect().center();
  QTest::mouseClick(front, Qt::LeftButton, {}, QPoint(3, 3));
  QVERIFY(this->field("name") == nullptr || !this->field("name")->isVisible());
  QTest::mouseClick(front, Qt::LeftButton, {}, middle);
  QCoreApplication::processEvents();
  QCOMPARE(this->field("name")->text(), QString("crate-1"));
  QTest::mousePress(front, Qt::LeftButton, {}, middle);
  for (int step = 10; step <= 60; step += 10)
  {
    moveMouse(front, middle + QPoint(step, -step / 2), Qt::LeftButton);
    QTest::qWait(20);
  }
  QTest::mouseRelease(front, Qt::LeftButton, {}, middle + QPoint(60, -30));
  const Eigen::Vector3d position = document.scene().objects[0].position.value;
  QVERIFY(position.x() > 0.1);
  QVERIFY(std::abs(position.y() - position.x() / 2) < 1e-9);
  QCOMPARE(position.z(), 0.0);
  this->action("undo")->trigger();
  QCOMPARE(document.scene().objects[0].position.value, Eigen::Vector3d(0, 0, 0));
  QTest::mouseDClick(front, Qt::LeftButton, {}, middle);
  QVERIFY(!this->Window->findChild<QOpenGLWidget*>("view.1")->isVisible());
  QTest::mouseDClick(front, Qt::LeftButton, {}, middle);
  QVERIFY(this->Window->findChild<QOpenGLWidget*>("view.1")->isVisible());
}

void TestEditor::keyFramesPlay()
{
  QVERIFY(this->Window->importFile(QString::fromStdString(sourceFile("Data/Models/crate.ac"))));
  dgtk::SceneDocument& document = this->Window->document();
  auto* make = this->Window->findChild<QPushButton*>("makeKeyFrame");
  auto* frame = this->Window->findChild<QSpinBox*>("frame");
  QTest::mouseClick(make, Qt::LeftButton);
  frame->setValue(10);
  this->type("position.0", "5");
  QTest::mouseClick(make, Qt::LeftButton);
  QCOMPARE(document.scene().keyFrames(), (std::vector<int>{ 0, 10 }));
  frame->setValue(4);
  QCOMPARE(this->field("position.0")->text(), QString("2"));
  auto* play = this->Window->findChild<QToolButton*>("play");
  this->Window->findChild<QToolButton*>("loop")->setChecked(false);
  play->setChecked(true);
  QTRY_COMPARE(frame->value(), 10);
  QTRY_VERIFY(!play->isChecked());
  QTest::mouseClick(this->Window->findChild<QPushButton*>("removeKeyFrame"), Qt::LeftButton);
  QCOMPARE(document.scene().keyFrames(), (std::vector<int>{ 0 }));
}

void TestEditor::copiesCutsAndPastes()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  dgtk::SceneDocument& document = this->Window->document();
  const std::string first = document.json();
  const std::size_t models = document.models().size();
  this->select("vase");
  this->action("copy")->trigger();
  this->action("paste")->trigger();
  QCOMPARE(document.scene().objects.back().name, std::string("vase-2"));
  QCOMPARE(document.models().size(), models);
  this->action("duplicate")->trigger();
  QCOMPARE(document.scene().objects.back().name, std::string("vase-3"));
  this->action("cut")->trigger();
  QCOMPARE(document.scene().objects.size(), std::size_t(6));
  this->action("paste")->trigger();
  this->action("selectAll")->trigger();
  this->action("delete")->trigger();
  QVERIFY(document.scene().items().empty());
  const auto offered = [this](const char* name)
  { return std::pair(this->action(name)->isEnabled(), this->action(name)->text().size() > 5); };
  QCOMPARE(offered("undo"), std::pair(true, true));
  QCOMPARE(offered("redo"), std::pair(false, false));
  while (document.canUndo())
  {
    this->action("undo")->trigger();
  }
  QCOMPARE(document.json(), first);
  QCOMPARE(offered("undo"), std::pair(false, false));
  QCOMPARE(offered("redo"), std::pair(true, true));
}

void TestEditor::pastesWhatOtherWindowsCopied()
{
  QClipboard* const clipboard = QApplication::clipboard();
  clipboard->clear();
  QVERIFY(!this->action("paste")->isEnabled());
  // Another window, of a scene in another folder: it may be of another process.
  const QString far = this->path("far/away");
  QVERIFY(
    QDir().mkpath(far) && QFile::copy(QString::fromStdString(sourceFile("Data/Models/crate.ac")), far + "/crate.ac"));
  {
    dgtk::MainWindow other;
    QVERIFY(other.importFile(far + "/crate.ac") && other.saveFile(far + "/s.json"));
    other.findChild<QAction*>("selectAll")->trigger();
    other.findChild<QAction*>("copy")->trigger();
    other.findChild<QAction*>("paste")->trigger();
    QCOMPARE(other.document().scene().objects.back().name, std::string("crate-2"));
  }
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  const dgtk::SceneDescription& scene = this->Window->document().scene();
  const std::size_t objects = scene.objects.size();
  this->action("paste")->trigger();
  QCOMPARE(scene.objects.size(), objects + 1);
  QCOMPARE(QFileInfo(QString::fromStdString(scene.resolve(scene.objects.back().model))).canonicalFilePath(),
    far + "/crate.ac");
  QVERIFY(!QFileInfo(QString::fromStdString(scene.objects.back().model)).isAbsolute());
  this->action("undo")->trigger();
  // The text alone, as an editor of texts hands it on: its paths are this scene's.
  QString text = clipboard->text();
  QVERIFY2(text.contains("\"model\": \"crate.ac\""), qPrintable(text));
  clipboard->setText(text.replace("crate.ac", QString::fromStdString(scene.objects.front().model)));
  this->action("paste")->trigger();
  QCOMPARE(scene.objects.back().model, scene.objects.front().model);
  QCOMPARE(scene.objects.back().name, std::string("crate-1"));
  this->action("undo")->trigger();
  // What is no part of a scene is not pasted, but what was copied here still is.
  for (const char* const words : { "words", "{ \"objects\": [ {", "{}" })
  {
    clipboard->setText(words);
    this->action("paste")->trigger();
    QCOMPARE(scene.objects.size(), objects);
    QCOMPARE(this->Window->statusBar()->currentMessage(), QString("The clipboard has no part of a scene"));
  }
  this->select("vase");
  this->action("copy")->trigger();
  clipboard->setText("words");
  this->action("paste")->trigger();
  QCOMPARE(scene.objects.back().name, std::string("vase-2"));
}

void TestEditor::aFamilyIsCutAndPasted()
{
  QVERIFY(this->Window->openFile(QString::fromStdString(dgtk::test::sourceFile("Data/Scenes/parenting.json"))));
  dgtk::SceneDocument& document = this->Window->document();
  const auto parents = [&document]
  {
    std::map<std::string, std::string> of;
    for (const dgtk::ObjectDescription& object : document.scene().objects)
    {
      of[object.name] = object.parent;
    }
    return of;
  };
  const std::map<std::string, std::string> first = parents();
  const std::string root =
    std::find_if(first.begin(), first.end(), [](const auto& object) { return !object.second.empty(); })->second;
  QVERIFY(first.at(root).empty());
  this->select(root.c_str());
  this->action("cut")->trigger();
  QVERIFY(parents().size() + 1 < first.size());
  this->action("paste")->trigger();
  QVERIFY(parents() == first);
  this->select(root.c_str());
  this->action("duplicate")->trigger();
  const std::size_t twice = parents().size();
  QVERIFY(twice > first.size() + 1);
  this->select(root.c_str());
  this->action("copy")->trigger();
  this->action("paste")->trigger();
  QCOMPARE(parents().size() - twice, twice - first.size());
}

void TestEditor::addsCamerasAndLights()
{
  dgtk::SceneDocument& document = this->Window->document();
  answer<QDialog>("cameraDialog",
    [](QDialog& dialog)
    {
      auto* eye = dialog.findChild<QLineEdit*>("eye.2");
      eye->setFocus();
      eye->selectAll();
      QTest::keyClicks(eye, "-10");
      QTest::mouseClick(dialog.findChild<QPushButton*>("add"), Qt::LeftButton);
    });
  this->action("camera")->trigger();
  QCOMPARE(document.scene().cameras.size(), std::size_t(1));
  QCOMPARE(document.scene().cameras[0].eye.value.z(), -10.0);
  QCOMPARE(document.scene().cameras[0].fovY.value, dgtk::ViewCamera::angle()); // as the perspective view
  answer<QDialog>("cameraArrayDialog",
    [](QDialog& dialog)
    {
      dialog.findChild<QSpinBox*>("count")->setValue(5);
      QTest::mouseClick(dialog.findChild<QPushButton*>("add"), Qt::LeftButton);
    });
  this->action("cameraArray")->trigger();
  QCOMPARE(document.scene().cameras.size(), std::size_t(6));
  this->action("undo")->trigger();
  QCOMPARE(document.scene().cameras.size(), std::size_t(1));
  answer<QDialog>(
    "lightDialog", [](QDialog& dialog) { QTest::mouseClick(dialog.findChild<QPushButton*>("add"), Qt::LeftButton); });
  this->action("light")->trigger();
  QCOMPARE(document.scene().lights.size(), std::size_t(1));
  this->type("diffuse.0", "0.25");
  QCOMPARE(document.scene().lights[0].diffuse.value.x(), 0.25);
}

void TestEditor::refusesWithAMessage()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  const std::string first = this->Window->document().json();
  QString message;
  QFile broken(this->path("broken.ac"));
  QVERIFY(broken.open(QIODevice::WriteOnly));
  broken.write("no model at all\n");
  broken.close();
  expectRefusal(message);
  QVERIFY(!this->Window->importFile(broken.fileName()));
  QVERIFY2(message.contains("broken.ac"), qPrintable(message));
  expectRefusal(message);
  QVERIFY(!this->Window->openFile(this->path("missing.json")));
  QVERIFY2(message.contains("missing.json"), qPrintable(message));
  expectRefusal(message);
  QVERIFY(!this->Window->saveFile(this->path("demo.scene")));
  QVERIFY(!message.isEmpty());
  this->select("tree");
  expectRefusal(message);
  this->type("scale.0", "0");
  QVERIFY2(message.contains("tree"), qPrintable(message));
  QCOMPARE(this->field("scale.0")->text(), QString("1"));
  QCOMPARE(this->Window->document().json(), first);
  QVERIFY(!this->Window->document().modified());
}

void TestEditor::asksAboutUnsavedWork()
{
  QVERIFY(this->Window->importFile(QString::fromStdString(sourceFile("Data/Models/crate.ac"))));
  answer<QMessageBox>("unsavedBox", [](QMessageBox& box) { box.button(QMessageBox::Cancel)->click(); });
  QVERIFY(!this->Window->close());
  QVERIFY(this->Window->isVisible());
  answer<QMessageBox>("unsavedBox", [](QMessageBox& box) { box.button(QMessageBox::Cancel)->click(); });
  this->action("new")->trigger();
  QCOMPARE(this->Window->document().scene().objects.size(), std::size_t(1));
  auto* frame = this->Window->findChild<QSpinBox*>("frame");
  frame->setValue(7);
  answer<QMessageBox>("unsavedBox", [](QMessageBox& box) { box.button(QMessageBox::Discard)->click(); });
  this->action("new")->trigger();
  QVERIFY(this->Window->document().scene().objects.empty());
  QCOMPARE(frame->value(), 0);
  QVERIFY(this->Window->close());
}

void TestEditor::theViewsLookAsTheyWereLeft()
{
  const auto sizes = [this]
  {
    QList<int> all;
    for (const QSplitter* splitter : this->Window->findChildren<QSplitter*>())
    {
      all += splitter->sizes();
    }
    return all;
  };
  const auto visible = [this]
  {
    QList<int> kinds;
    for (int kind = 0; kind < 4; ++kind)
    {
      if (this->Window->findChild<QWidget*>("view." + QString::number(kind))->isVisible())
      {
        kinds << kind;
      }
    }
    return kinds;
  };
  const auto picture = [this](const char* view)
  {
    auto* widget = this->Window->findChild<QOpenGLWidget*>(view);
    untilQuiet();
    return widget->grabFramebuffer();
  };
  const auto again = [this]
  {
    QVERIFY(this->Window->close());
    this->Window = std::make_unique<dgtk::MainWindow>();
    this->Window->show();
    activate(*this->Window);
    QVERIFY(this->Window->openFile(this->copyOfDemo()));
  };
  const QList<int> usual = sizes();
  QList<QSplitter*> splitters = this->Window->findChildren<QSplitter*>();
  QCOMPARE(splitters.size(), 3);
  for (QSplitter* splitter : splitters)
  {
    const int all = splitter->sizes()[0] + splitter->sizes()[1];
    splitter->setSizes({ all / 3, all - all / 3 });
  }
  const QList<int> moved = sizes();
  QVERIFY(moved != usual);
  for (const char* name : { "wireframe", "grid", "sceneLights", "handlesAtOrigin" })
  {
    this->action(name)->trigger();
  }
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  const QImage front = picture("view.0");
  again();
  QCOMPARE(sizes(), moved);
  QCOMPARE(visible(), (QList<int>{ 0, 1, 2, 3 }));
  for (const char* name : { "wireframe", "handlesAtOrigin" })
  {
    QVERIFY2(this->action(name)->isChecked(), name);
  }
  QVERIFY(!this->action("textured")->isChecked());
  QVERIFY(!this->action("sceneLights")->isChecked());
  QVERIFY(!this->action("grid")->isChecked());
  QTRY_VERIFY2(picture("view.0") == front, "and it looks so");

  // One view alone; when the others come back they show the scene that was opened meanwhile.
  this->Window->findChild<QWidget*>("view.1")->setFocus();
  this->action("maximize")->trigger();
  QCOMPARE(visible(), (QList<int>{ 1 }));
  again();
  QCOMPARE(visible(), (QList<int>{ 1 }));
  this->action("maximize")->trigger();
  QCOMPARE(visible(), (QList<int>{ 0, 1, 2, 3 }));
  QCOMPARE(sizes(), moved);
  QTRY_VERIFY(picture("view.0") == front);
}

DGTK_EDITOR_TEST(TestEditor);
