// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorWhole.h"
#include "TestEditorSupport.h"

#include "dgtkMainWindow.h"
#include "dgtkSceneDocument.h"
#include "dgtkViewWidget.h"

#include <Eigen/Geometry>

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDialog>
#include <QLineEdit>
#include <QListWidget>
#include <QMap>
#include <QMenu>
#include <QMessageBox>
#include <QOpenGLWidget>
#include <QProcess>
#include <QPushButton>
#include <QSpinBox>
#include <QTabWidget>
#include <QTest>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <utility>

namespace
{
constexpr int largeWidth = 800;     // pixels
constexpr int endlessWidth = 12000; // pixels of a picture that nothing here lives to see

/// Made in that folder.
QString smallDataset(const QString& folder)
{
  QProcess::execute(QString::fromLocal8Bit(qgetenv("DGTK")),
    { "render", demo(), "-o", folder, "--layers", "depth", "--size", "32x24", "--frames", "0", "--quiet" });
  return folder;
}

/// Lets the only run go on for moments until the folder has so many files, and holds it there: what is clicked next
/// comes before its end, however busy the machine. Its process, or 0 when it has ended.
pid_t heldWhen(const QString& folder, int files)
{
  constexpr int moment = 10; // milliseconds
  QList<pid_t> runs;
  if (!QTest::qWaitFor([&runs] { return !(runs = livingRuns()).isEmpty() && runs[0] > 0; }, longestRun))
  {
    return 0;
  }
  const auto there = [&folder]
  {
    int count = 0;
    for (QDirIterator at(folder, QDir::Files, QDirIterator::Subdirectories); at.hasNext(); at.next())
    {
      ++count;
    }
    return count;
  };
  for (::kill(-runs[0], SIGSTOP); there() < files && !livingRuns().isEmpty(); ::kill(-runs[0], SIGSTOP))
  {
    ::kill(-runs[0], SIGCONT);
    QTest::qSleep(moment);
  }
  return livingRuns().isEmpty() ? 0 : runs[0];
}

/// The dataset viewers that are shown.
QWidgetList viewers()
{
  QWidgetList found;
  for (QWidget* widget : QApplication::topLevelWidgets())
  {
    if (widget->isVisible() && widget->objectName() == "datasetViewer")
    {
      found << widget;
    }
  }
  return found;
}
}

void TestEditorWhole::camerasHaveSizesOfTheirOwn()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  dgtk::SceneDocument& document = this->Window->document();
  const std::string first = document.json();
  this->action("render")->trigger();
  auto* dialog = this->Window->findChild<QDialog*>("renderDialog");
  dialog->findChild<QTabWidget*>()->setCurrentIndex(1);
  auto* cameras = dialog->findChild<QListWidget*>("cameras");
  auto* width = dialog->findChild<QSpinBox*>("width");
  auto* height = dialog->findChild<QSpinBox*>("height");
  cameras->setCurrentRow(1);
  QCOMPARE(width->value(), 640);
  width->setValue(320);
  height->setValue(200);
  QCOMPARE(cameras->currentRow(), 1);
  QCOMPARE(document.scene().cameras[1].width, 320);
  QCOMPARE(document.scene().cameras[1].height, 200);
  QCOMPARE(document.scene().cameras[0].width, 640);
  cameras->setCurrentRow(0);
  QCOMPARE(width->value(), 640);
  auto* own = dialog->findChild<QCheckBox*>("ownSize");
  own->setChecked(false);
  width->setValue(100);
  QCOMPARE(document.scene().cameras[0].width, 640);
  own->setChecked(true);
  QCOMPARE(width->value(), 640);
  cameras->setCurrentRow(1);
  QCOMPARE(height->value(), 200);
  document.undo(); // both numbers are one step
  QCOMPARE(document.json(), first);
  QCOMPARE(height->value(), 480);
}

void TestEditorWhole::cancelledRunsResume()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  this->select("house");
  this->type("position.1", "0.5"); // a scene with changes: a copy of it is rendered
  this->action("render")->trigger();
  auto* dialog = this->Window->findChild<QDialog*>("renderDialog");
  dialog->findChild<QLineEdit*>("folder")->setText(this->path("stopped"));
  dialog->findChild<QCheckBox*>("ownSize")->setChecked(false);
  dialog->findChild<QSpinBox*>("width")->setValue(largeWidth);
  dialog->findChild<QSpinBox*>("height")->setValue(largeWidth);
  auto* start = dialog->findChild<QPushButton*>("start");
  QTest::mouseClick(start, Qt::LeftButton);
  const pid_t run = heldWhen(this->path("stopped"), 3); // a file has its name before its entry
  QVERIFY2(run > 0, "the run has ended");
  QTest::mouseClick(dialog->findChild<QPushButton*>("cancel"), Qt::LeftButton);
  ::kill(-run, SIGCONT);
  QTRY_VERIFY(start->isEnabled());
  QVERIFY(dialog->findChild<QCheckBox*>("resume")->isChecked());
  QVERIFY(!QFile::exists(this->path("stopped/manifest.json")));
  QTest::mouseClick(start, Qt::LeftButton);
  QTRY_VERIFY(start->isEnabled());
  QVERIFY(QFile::exists(this->path("stopped/manifest.json")));
  // A finished dataset is not replaced unasked.
  dialog->findChild<QCheckBox*>("resume")->setChecked(false);
  const QMap<QString, QByteArray> finished = contents(this->path("stopped"));
  answer<QMessageBox>("replaceDatasetBox", [](QMessageBox& box) { box.button(QMessageBox::Cancel)->click(); });
  QTest::mouseClick(start, Qt::LeftButton);
  QVERIFY(start->isEnabled());
  QVERIFY(contents(this->path("stopped")) == finished);
  // Another scene has another folder.
  QVERIFY(this->Window->saveFile(this->path("other.json")));
  QVERIFY(this->Window->openFile(this->path("other.json")));
  QCOMPARE(dialog->findChild<QLineEdit*>("folder")->text(), this->path("other_dataset"));
}

void TestEditorWhole::closingEndsTheProgram()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  this->Window->openDataset(smallDataset(this->path("small")));
  QCOMPARE(viewers().size(), 1);
  this->action("correspondence")->trigger();
  this->action("render")->trigger();
  auto* dialog = this->Window->findChild<QDialog*>("renderDialog");
  dialog->findChild<QLineEdit*>("folder")->setText(this->path("interrupted"));
  dialog->findChild<QCheckBox*>("ownSize")->setChecked(false);
  dialog->findChild<QSpinBox*>("width")->setValue(endlessWidth);
  dialog->findChild<QSpinBox*>("height")->setValue(endlessWidth);
  auto* start = dialog->findChild<QPushButton*>("start");
  start->click();
  QTRY_VERIFY(!contents(this->path("interrupted")).isEmpty());
  QVERIFY(!start->isEnabled());

  answer<QMessageBox>("runningBox", [](QMessageBox& box) { box.findChild<QPushButton*>("stop")->click(); });
  QTimer::singleShot(0, this->Window.get(), &QWidget::close);
  QTimer guard;
  connect(&guard, &QTimer::timeout, [] { QCoreApplication::exit(1); });
  guard.start(longestRun);
  QCOMPARE(QApplication::exec(), 0); // ends with the last window
  guard.stop();
  QCOMPARE(viewers().size(), 0);
  QVERIFY(!dialog->isVisible());
  QVERIFY(!this->Window->findChild<QDialog*>("matchDialog")->isVisible());
  QTRY_VERIFY(start->isEnabled());
  QVERIFY(!QFile::exists(this->path("interrupted/manifest.json")));
}

void TestEditorWhole::aClosedViewerEndsNothing()
{
  this->Window->openDataset(smallDataset(this->path("small")));
  QCOMPARE(viewers().size(), 1);
  QTimer::singleShot(0, viewers().front(), &QWidget::close);
  QTimer::singleShot(5 * settle, [] { QCoreApplication::exit(1); });
  QCOMPARE(QApplication::exec(), 1); // goes on until it is told to end
  QCOMPARE(viewers().size(), 0);
  QVERIFY(this->Window->isVisible());
}

void TestEditorWhole::parallelViewsCutNothing()
{
  QVERIFY(this->Window->importFile(QString::fromStdString(dgtk::test::sourceFile("Data/Models/crate.ac"))));
  auto* front = this->Window->findChild<QOpenGLWidget*>("view.0");
  const auto middle = [front]
  {
    untilQuiet();
    const QImage image = front->grabFramebuffer();
    return image.pixelColor(image.rect().center() + QPoint(9, 7));
  };
  const QColor crate = middle();
  this->select("crate-1");
  for (const char* depth : { "5000", "-5000", "30" })
  {
    this->type("position.2", depth); // towards the front view's eye, and far beyond it
    const QColor there = middle();
    QVERIFY2(std::abs(there.red() - crate.red()) + std::abs(there.green() - crate.green()) < 40, depth);
  }
  this->type("position.0", "5000");
  const QColor background = middle();
  QVERIFY(std::abs(background.red() - crate.red()) + std::abs(background.green() - crate.green()) >= 40);
}

void TestEditorWhole::viewsMoveByKeys()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  untilQuiet();
  QVERIFY2(this->Window->findChild<QWidget*>("view.3")->hasFocus(), "the perspective begins");
  for (const char* name : { "view.0", "view.3" })
  {
    auto* view = dynamic_cast<dgtk::ViewWidget*>(this->Window->findChild<QOpenGLWidget*>(name));
    QVERIFY(view != nullptr);
    view->setFocus();
    const QImage first = view->grabFramebuffer();
    struct Row
    {
      Qt::Key key;
      Qt::KeyboardModifiers modifiers;
      int right; // ways of 30 pixels, or turns of 5 degrees
      int down;
      double closer;
    };
    for (const Row& row : { Row{ Qt::Key_Right, Qt::NoModifier, 1, 0, 0 }, { Qt::Key_Up, Qt::NoModifier, 0, -1, 0 },
           { Qt::Key_Up, Qt::NoModifier, 0, -1, 0 }, { Qt::Key_Left, Qt::NoModifier, -1, 0, 0 },
           { Qt::Key_Down, Qt::NoModifier, 0, 1, 0 }, { Qt::Key_Left, Qt::ShiftModifier, -1, 0, 0 },
           { Qt::Key_Plus, Qt::NoModifier, 0, 0, 0.15 }, { Qt::Key_Minus, Qt::NoModifier, 0, 0, -0.15 },
           { Qt::Key_Equal, Qt::NoModifier, 0, 0, 0.15 } })
    {
      dgtk::ViewCamera wanted = view->camera();
      const QImage before = view->grabFramebuffer();
      if (wanted.parallel() || row.modifiers == Qt::ShiftModifier)
      {
        wanted.pan(30 * row.right, 30 * row.down, view->height());
      }
      else
      {
        wanted.orbit(5 * row.right, 5 * row.down);
      }
      wanted.zoom(std::exp(row.closer));
      QTest::keyClick(view, row.key, row.modifiers);
      untilQuiet();
      QVERIFY((view->camera().eye() - wanted.eye()).norm() < 1e-9);
      QVERIFY((view->camera().focus() - wanted.focus()).norm() < 1e-9);
      QVERIFY(view->grabFramebuffer() != before);
    }
    QVERIFY(first != view->grabFramebuffer());
    this->action("maximize")->trigger(); // the view that has the focus
    QVERIFY(view->isVisible());
    QVERIFY(!this->Window->findChild<QWidget*>("view.1")->isVisible());
    this->action("maximize")->trigger();
  }
}

/// At the frame that is shown; a camera that looks straight down says what is upwards in its picture.
void TestEditorWhole::aPreviewHasTheCamerasPose()
{
  using V = Eigen::Vector3d;
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  const auto posed = [](const char* name, const V& right, const V& down, const V& forward)
  {
    Eigen::Matrix3d axes;
    axes << right, down, forward;
    const Eigen::Quaterniond turn(axes);
    dgtk::CameraDescription camera;
    camera.name = name;
    camera.posed = true;
    camera.position = V(1, 2, 3);
    camera.orientation = dgtk::Quaternion{ turn.w(), turn.x(), turn.y(), turn.z() };
    return camera;
  };
  dgtk::CameraDescription walking;
  walking.name = "walking";
  walking.eye.keys = { { 0, V(0, 0, 8) }, { 8, V(0, 4, 8) } };
  this->Window->document().addCamera(walking);
  this->Window->document().addCamera(posed("level", V(0, 0, 1), V(0, -1, 0), V(1, 0, 0)));
  this->Window->document().addCamera(posed("down", V(0, 0, 1), V(-1, 0, 0), V(0, -1, 0)));
  this->Window->findChild<QSpinBox*>("frame")->setValue(4);
  const auto* view = dynamic_cast<dgtk::ViewWidget*>(this->Window->findChild<QOpenGLWidget*>("view.3"));
  QVERIFY(view != nullptr);
  const auto shows = [&](const char* name, const V& eye, const V& focus, const V& up)
  {
    this->select(name);
    this->action("preview")->trigger();
    const dgtk::ViewCamera& seen = view->camera();
    return (seen.eye() - eye).norm() + (seen.focus() - focus).norm() + (seen.up() - up).norm() < 1e-9;
  };
  const double away = std::sqrt(14.0); // as far as what the view was turned about
  QVERIFY(shows("walking", V(0, 2, 8), V(0, 0, 0), V(0, 1, 0)));
  QVERIFY(shows("level", V(1, 2, 3), V(1 + away, 2, 3), V(0, 1, 0)));
  QVERIFY(shows("down", V(1, 2, 3), V(1, 2 - away, 3), V(1, 0, 0)));
}

void TestEditorWhole::stylesLookDifferent()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  auto* view = this->Window->findChild<QOpenGLWidget*>("view.3");
  const auto seen = [&](const char* action)
  {
    this->action(action)->trigger();
    untilQuiet();
    return view->grabFramebuffer();
  };
  const QImage textured = seen("textured");
  const QImage shaded = seen("shaded");
  const QImage wires = seen("wireframe");
  QVERIFY(textured != shaded);
  QVERIFY(shaded != wires);
  QVERIFY(wires != textured);
  QVERIFY2(seen("textured") == textured, "and back");
  QVERIFY(seen("grid") != textured);
  QVERIFY(seen("grid") == textured);
  QVERIFY(seen("sceneLights") != textured);
}

/// Of the question about unsaved work; a new scene is asked for a name first.
void TestEditorWhole::savingIsAnAnswer()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  const QString path = QString::fromStdString(this->Window->document().path());
  this->select("house");
  this->type("position.1", "0.75");
  const std::string changed = this->Window->document().json();
  answer<QMessageBox>("unsavedBox", [](QMessageBox& box) { box.button(QMessageBox::Save)->click(); });
  this->action("new")->trigger();
  QVERIFY(this->Window->document().scene().objects.empty());
  QVERIFY(this->Window->openFile(path));
  QCOMPARE(this->Window->document().json(), changed);
  this->select("house");
  this->type("position.1", "0.5");
  this->action("save")->trigger();
  QVERIFY(!this->Window->document().modified());
  QVERIFY(this->Window->close()); // nothing is asked
}

void TestEditorWhole::lightsHaveAllTheirNumbers()
{
  QVERIFY(this->Window->importFile(QString::fromStdString(dgtk::test::sourceFile("Data/Models/crate.ac"))));
  answer<QDialog>("lightDialog",
    [](QDialog& dialog)
    {
      const auto field = [&dialog](const char* name) { return dialog.findChild<QLineEdit*>(name); };
      QVERIFY(!field("target.0")->isEnabled());
      dialog.findChild<QComboBox*>("kind")->setCurrentIndex(static_cast<int>(dgtk::LightKind::Spot));
      QVERIFY(field("target.0")->isEnabled());
      const std::pair<const char*, const char*> typed[] = { { "intensity.0", "0.5" }, { "attenuation.1", "0.25" },
        { "attenuation.2", "0.125" }, { "coneAngle.0", "20" }, { "exponent.0", "3" } };
      for (const auto& [name, text] : typed)
      {
        field(name)->setText(text);
        field(name)->setModified(true);
      }
      QTest::mouseClick(dialog.findChild<QPushButton*>("add"), Qt::LeftButton);
    });
  this->action("light")->trigger();
  const dgtk::LightDescription& light = this->Window->document().scene().lights.at(0);
  QCOMPARE(light.kind, dgtk::LightKind::Spot);
  QCOMPARE(light.intensity.value, 0.5);
  QCOMPARE(light.attenuation, Eigen::Vector3d(1, 0.25, 0.125));
  QCOMPARE(light.coneAngle.value, 20.0);
  QCOMPARE(light.exponent.value, 3.0);
  // Its properties have the rows of its kind.
  QVERIFY(this->field("exponent.0") != nullptr);
  auto* kind = this->Window->findChild<QWidget*>("propertiesPanel")->findChild<QComboBox*>("kind");
  QTest::keyClick(kind, Qt::Key_Home);
  QTRY_COMPARE(this->Window->document().scene().lights.at(0).kind, dgtk::LightKind::Point);
  untilQuiet();
  QVERIFY(this->field("exponent.0") == nullptr);
  QVERIFY(this->field("target.0") == nullptr);
  QVERIFY(this->field("attenuation.1") != nullptr);
}

void TestEditorWhole::pictures()
{
  const QString folder = QString::fromLocal8Bit(qgetenv("DGTK_EDITOR_PICTURES"));
  if (folder.isEmpty())
  {
    return; // made by Documentation/Images/make_editor.py
  }
  const auto grab = [&](QWidget* widget, const char* name)
  {
    QTest::qWait(3 * settle);
    QVERIFY(widget->grab().save(folder + '/' + name));
  };
  this->Window->resize(1280, 860);
  grab(this->Window.get(), "editor_empty.png");
  QVERIFY(this->Window->openFile(demo()));
  this->select("house");
  grab(this->Window.get(), "editor.png");
  this->action("render")->trigger();
  auto* dialog = this->Window->findChild<QDialog*>("renderDialog");
  dialog->findChild<QLineEdit*>("folder")->setText("/home/me/dataset");
  grab(dialog, "editor_render.png");
  dialog->findChild<QTabWidget*>()->setCurrentIndex(1);
  grab(dialog, "editor_render_cameras.png");
  dialog->findChild<QTabWidget*>()->setCurrentIndex(3);
  grab(dialog, "editor_render_options.png");
  dialog->hide();
  answer<QDialog>({},
    [&](QDialog& shown)
    {
      shown.grab().save(folder + "/editor_light.png");
      shown.reject();
    });
  this->action("light")->trigger();
}

DGTK_EDITOR_TEST(TestEditorWhole);
