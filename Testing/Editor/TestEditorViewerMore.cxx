// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorSupport.h"
#include "TestEditorViewer.h"

#include "dgtkDatasetDocuments.h"
#include "dgtkLdi.h"
#include "dgtkViewWidget.h"

#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QOpenGLWidget>
#include <QProcess>
#include <QSlider>
#include <QSpinBox>
#include <QTimer>
#include <QWheelEvent>

#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>

namespace
{
namespace fs = std::filesystem;

constexpr int mostTabs = 60;
constexpr double longestEvent = 0.2; // seconds of this thread

/// Time that this thread worked, which other work on the machine does not make longer.
double workedSeconds()
{
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

/// The longest work between two turns of the event loop.
class Pulse
{
public:
  Pulse()
  {
    QObject::connect(&this->Timer, &QTimer::timeout,
      [this]
      {
        const double now = workedSeconds();
        this->Longest = std::max(this->Longest, now - this->Last);
        this->Last = now;
      });
    this->Timer.start(0);
  }
  double longest() const { return this->Longest; }

private:
  QTimer Timer;
  double Last = workedSeconds();
  double Longest = 0;
};

/// Pixels of a colour, within a small difference.
int countOf(const QImage& image, const QColor& color)
{
  int count = 0;
  for (int y = 0; y < image.height(); ++y)
  {
    for (int x = 0; x < image.width(); ++x)
    {
      const QColor at = image.pixelColor(x, y);
      count += std::abs(at.red() - color.red()) < 6 && std::abs(at.green() - color.green()) < 6 &&
               std::abs(at.blue() - color.blue()) < 6;
    }
  }
  return count;
}

int colorsOf(const QImage& image)
{
  std::set<QRgb> colors;
  for (int y = 0; y < image.height(); ++y)
  {
    for (int x = 0; x < image.width(); ++x)
    {
      colors.insert(image.pixel(x, y));
    }
  }
  return int(colors.size());
}

/// Every action that asks for nothing.
void triggerAll(QMainWindow* viewer)
{
  const QStringList asking{ "open", "save", "close", "exit", "mouse" };
  for (QAction* menu : viewer->menuBar()->actions())
  {
    for (QAction* action : menu->menu()->actions())
    {
      if (!asking.contains(action->objectName()))
      {
        action->trigger();
        QCoreApplication::processEvents();
      }
    }
  }
}

int pointsOf(const QMainWindow* viewer)
{
  return viewer->findChild<QLabel*>("cloudText")->text().remove(QRegExp("[^0-9]")).toInt();
}
} // namespace

void TestEditorViewer::keysReachEverything()
{
  QMainWindow* const viewer = this->open(this->dataset());
  QVERIFY(viewer != nullptr);
  this->picture(viewer, 0)->setFocus();
  std::set<QString> reached;
  for (int i = 0; i < mostTabs; ++i)
  {
    QWidget* const at = QApplication::focusWidget();
    QVERIFY(at != nullptr);
    reached.insert(at->objectName());
    QTest::keyClick(at, Qt::Key_Tab);
  }
  for (const char* const name :
    { "picture.0", "picture.3", "camera", "layer", "low", "cloudView", "frames", "readOut" })
  {
    QVERIFY2(reached.count(name) == 1, name);
  }
  std::set<QString> keys;
  int actions = 0;
  for (QAction* menu : viewer->menuBar()->actions())
  {
    for (QAction* action : menu->menu()->actions())
    {
      if (action->isSeparator())
      {
        continue;
      }
      ++actions;
      QVERIFY2(action->text().contains('&'), qPrintable(action->text()));
      QVERIFY2(!action->shortcut().isEmpty(), qPrintable(action->text()));
      QVERIFY2(keys.insert(action->shortcut().toString()).second, qPrintable(action->text()));
    }
  }
  QVERIFY(actions > 15);
  triggerAll(viewer);
  this->waitForPictures(viewer);
  QTest::keyClick(viewer, Qt::Key_W, Qt::ControlModifier);
  QTRY_VERIFY(this->viewer() == nullptr);
}

void TestEditorViewer::camerasAndPointsInTheWorld()
{
  QMainWindow* const viewer = this->open(this->dataset());
  QVERIFY(viewer != nullptr);
  auto* const cloud = viewer->findChild<QOpenGLWidget*>("cloudView");
  untilQuiet();
  const QImage first = cloud->grabFramebuffer();
  QVERIFY(colorsOf(first) > 200);
  QVERIFY(countOf(first, QColor(51, 255, 51)) > 20); // the chosen camera's frustum
  const int points = pointsOf(viewer);
  QVERIFY2(points > 1500 && points <= 64 * 48, qPrintable(QString::number(points)));
  QTest::mousePress(cloud, Qt::LeftButton, {}, QPoint(100, 100));
  moveMouse(cloud, QPoint(140, 110), Qt::LeftButton);
  moveMouse(cloud, QPoint(190, 120), Qt::LeftButton);
  QTest::mouseRelease(cloud, Qt::LeftButton, {}, QPoint(190, 120));
  QTRY_VERIFY(cloud->grabFramebuffer() != first);
  QTest::keyClick(viewer, Qt::Key_A);
  this->waitForPictures(viewer);
  QVERIFY(pointsOf(viewer) > 3 * points / 2);
  QTest::keyClick(viewer, Qt::Key_T);
  untilQuiet();
  const QImage through = cloud->grabFramebuffer();
  QVERIFY(through != first);
  QTest::keyClick(cloud, Qt::Key_Left);
  QTRY_VERIFY(cloud->grabFramebuffer() != through);
  QTest::keyClick(viewer, Qt::Key_V);
  QVERIFY(!cloud->isVisible());
}

/// Left turns about the focus, middle or Shift and left pans, right and the wheel zoom; a click chooses a camera.
void TestEditorViewer::theMouseMovesTheWorld()
{
  QMainWindow* const viewer = this->open(this->dataset());
  QVERIFY(viewer != nullptr);
  auto* const cloud = dynamic_cast<dgtk::ViewWidget*>(viewer->findChild<QOpenGLWidget*>("cloudView"));
  QVERIFY(cloud != nullptr);
  const auto middle = cloud->rect().center(); // NOLINT(clang-analyzer-core.CallAndMessage): QVERIFY has returned
  enum Way
  {
    Turns,
    Pans,
    Zooms
  };
  struct Row
  {
    Qt::MouseButton button;
    Qt::KeyboardModifiers keys;
    Way way;
  };
  const Row rows[] = { { Qt::LeftButton, Qt::NoModifier, Turns }, { Qt::LeftButton, Qt::ControlModifier, Turns },
    { Qt::LeftButton, Qt::ShiftModifier, Pans }, { Qt::MiddleButton, Qt::NoModifier, Pans },
    { Qt::MiddleButton, Qt::ShiftModifier, Pans }, { Qt::RightButton, Qt::NoModifier, Zooms },
    { Qt::RightButton, Qt::ShiftModifier, Zooms } };
  const auto* const camera = viewer->findChild<QWidget*>("pane.0")->findChild<QComboBox*>("camera");
  std::map<std::string, Eigen::Vector2d> places;
  for (const dgtk::CameraRecord& record : dgtk::readCameras((this->dataset() + "/cameras.json").toStdString()))
  {
    const Eigen::Vector3d center = -record.R.transpose() * record.t;
    places[record.name] = cloud->camera().pixel(center, cloud->width(), cloud->height()).value();
  }
  QCOMPARE(places.size(), std::size_t(2));
  const Eigen::Vector2d apart = (places["right"] - places["left"]).normalized();
  QVERIFY((places["right"] - places["left"]).norm() > 3);
  const auto click = [&](const std::string& name, double beside, Qt::MouseButton button)
  {
    const Eigen::Vector2d at = places[name] + beside * apart;
    QTest::mouseClick(cloud, button, {}, QPoint(int(at.x()), int(at.y())));
    this->waitForPictures(viewer);
    return camera->currentText();
  };
  QCOMPARE(camera->currentText(), QString("left"));
  QCOMPARE(click("right", 10, Qt::RightButton), QString("left"));
  QCOMPARE(click("right", 15, Qt::LeftButton), QString("left")); // beside it
  QCOMPARE(click("right", 10, Qt::LeftButton), QString("right"));
  QCOMPARE(click("left", -15, Qt::LeftButton), QString("right"));
  QCOMPARE(click("left", -10, Qt::LeftButton), QString("left"));
  const auto distance = [](const dgtk::ViewCamera& camera) { return (camera.eye() - camera.focus()).norm(); };
  for (const Row& row : rows)
  {
    const dgtk::ViewCamera before = cloud->camera();
    QTest::mousePress(cloud, row.button, row.keys, middle);
    moveMouse(cloud, middle + QPoint(1, 1), row.button);
    QCOMPARE((cloud->camera().eye() - before.eye()).norm(), 0.0); // a hand shakes
    moveMouse(cloud, middle + QPoint(30, 20), row.button);
    QTest::mouseRelease(cloud, row.button, row.keys, middle + QPoint(30, 20));
    const dgtk::ViewCamera after = cloud->camera();
    moveMouse(cloud, middle);
    QCOMPARE((cloud->camera().eye() - after.eye()).norm(), 0.0); // no button is held
    const double far = distance(before);
    QCOMPARE((after.forward() - before.forward()).norm() > 1e-3, row.way == Turns);
    QCOMPARE((after.focus() - before.focus()).norm() > 1e-3 * far, row.way == Pans);
    QCOMPARE(std::abs(distance(after) - far) > 1e-3 * far, row.way == Zooms);
    if (row.way == Turns) // 0.4 degrees a pixel
    {
      dgtk::ViewCamera turned = before;
      turned.orbit(12, 8);
      QVERIFY((after.eye() - turned.eye()).norm() < 1e-9 * far);
    }
    if (row.way == Zooms) // downwards: away
    {
      QVERIFY(std::abs(distance(after) / far - std::exp(0.16)) < 1e-9);
    }
    if (row.way == Pans) // what was under the mouse still is
    {
      const std::optional<Eigen::Vector2d> at = after.pixel(before.focus(), cloud->width(), cloud->height());
      const Eigen::Vector2d expected(0.5 * cloud->width() + 30, 0.5 * cloud->height() + 20);
      QVERIFY(at && (*at - expected).norm() < 1e-6);
    }
  }
  for (const int way : { 1, -2 }) // steps of the wheel
  {
    const double far = distance(cloud->camera());
    QWheelEvent event(middle, cloud->mapToGlobal(middle), {}, QPoint(0, 120 * way), Qt::NoButton, Qt::NoModifier,
      Qt::NoScrollPhase, false);
    QApplication::sendEvent(cloud, &event);
    QVERIFY(std::abs(distance(cloud->camera()) / far - std::exp(-0.15 * way)) < 1e-9);
  }
  QCOMPARE(camera->currentText(), QString("left")); // motions choose nothing
  this->waitForPictures(viewer);
}

void TestEditorViewer::layeredImagesHaveSurfaces()
{
  QMainWindow* const viewer = this->open(this->dataset());
  QVERIFY(viewer != nullptr);
  auto* const surface = viewer->findChild<QWidget*>("pane.0")->findChild<QSpinBox*>("surface");
  QVERIFY(!surface->isVisible());
  this->choose(viewer, 0, "left", "ldi color");
  QVERIFY(surface->isVisible());
  QVERIFY(surface->maximum() > 1);
  const QImage nearest = this->picture(viewer, 0)->grab().toImage();
  surface->setValue(2);
  this->waitForPictures(viewer);
  QVERIFY(this->picture(viewer, 0)->grab().toImage() != nearest);

  this->pointAt(viewer, 30, 24);
  dgtk::LdiReader reader((this->dataset() + "/left/ldi/000000.ldi").toStdString());
  dgtk::LdiRow row;
  for (int y = 0; y <= 24; ++y)
  {
    QVERIFY(reader.read(row));
  }
  std::size_t first = 0;
  for (int x = 0; x < 30; ++x)
  {
    first += row.counts[std::size_t(x)];
  }
  const QString text = this->cell(viewer, 0, 2);
  QVERIFY2(text.startsWith(QString::number(row.counts[30]) + " surface"), qPrintable(text));
  for (std::size_t i = first; i < first + row.counts[30]; ++i)
  {
    bool found = false;
    for (const QString& word : text.split(' '))
    {
      found = found || word.toDouble() == row.records[i].depth;
    }
    QVERIFY2(found, qPrintable(text));
  }
}

void TestEditorViewer::brokenDatasetsAreRefused()
{
  const std::string folder = this->Folder.path("broken");
  QString message;
  const auto refused = [&](const char* words)
  {
    expectRefusal(message);
    this->Window->openFile(QString::fromStdString(folder));
    QTRY_VERIFY(!message.isEmpty());
    QVERIFY2(message.contains(words), qPrintable(message));
    for (QWidget* window : QApplication::topLevelWidgets())
    {
      if (window->objectName() == "datasetViewer" && window->isVisible())
      {
        QVERIFY(window->findChild<QLabel*>("emptyText")->text().contains(words));
        triggerAll(qobject_cast<QMainWindow*>(window));
        window->close();
      }
    }
  };
  fs::create_directories(folder);
  refused("no manifest.json");
  std::ofstream(folder + "/.dgtk-journal") << "DGTk journal 1 0\n";
  refused("not finished");
  std::ofstream(folder + "/manifest.json") << "{\"format\": \"DGTk dataset\", \"files\": [";
  refused("is not valid JSON");

  fs::remove_all(folder);
  fs::copy(this->dataset().toStdString(), folder, fs::copy_options::recursive);
  fs::remove(folder + "/cameras.json");
  fs::remove(folder + "/left/color/000000.png");
  fs::resize_file(folder + "/left/depth/000000.npy", 1000);
  std::ofstream(folder + "/left/objects/000000.ppm") << "no picture";
  QMainWindow* const viewer = this->open(QString::fromStdString(folder));
  QVERIFY(viewer != nullptr);
  for (int pane = 0; pane < 3; ++pane)
  {
    const QString told = this->picture(viewer, pane)->toolTip();
    QVERIFY2(told.contains("000000."), qPrintable(told));
  }
  QVERIFY(this->picture(viewer, 3)->toolTip().isEmpty());
  moveMouse(this->picture(viewer, 3), this->picture(viewer, 3)->rect().center());
  QVERIFY(this->cell(viewer, 3, 2).startsWith('('));
  QVERIFY(this->cell(viewer, 3, 3).isEmpty());
  QTest::keyClick(viewer, Qt::Key_Period); // the next frame is whole
  this->waitForPictures(viewer);
  QVERIFY(this->picture(viewer, 1)->toolTip().isEmpty());
}

void TestEditorViewer::noEventTakesLong()
{
  const QString given = QString::fromLocal8Bit(qgetenv("DGTK_VIEWER_DATASET"));
  const Pulse pulse;
  QMainWindow* const viewer = this->open(given.isEmpty() ? this->dataset() : given);
  QVERIFY(viewer != nullptr);
  for (const Qt::Key key : { Qt::Key_A, Qt::Key_L, Qt::Key_Period, Qt::Key_Plus, Qt::Key_C })
  {
    QTest::keyClick(viewer, key);
    this->waitForPictures(viewer);
    QWidget* const view = this->picture(viewer, 0);
    for (int i = 0; i < 20; ++i)
    {
      moveMouse(view, QPoint(20 + 5 * i, 30 + 3 * i));
      QCoreApplication::processEvents();
    }
  }
  qInfo("%s", qPrintable(QString("longest event %1 s").arg(pulse.longest())));
  QVERIFY2(pulse.longest() < patience() * longestEvent, qPrintable(QString::number(pulse.longest())));
}

void TestEditorViewer::largePicturesAreReadInDetail()
{
  constexpr int width = 65536;
  constexpr int height = 4096;
  const std::string folder = this->Folder.path("large");
  const std::string file = folder + "/left/color/000000.npy";
  fs::create_directories(folder + "/left/color");
  std::string header = "{'descr': '|u1', 'fortran_order': False, 'shape': (4096, 65536), }";
  header.resize(117, ' ');
  std::ofstream(file, std::ios::binary) << "\x93NUMPY" << '\x01' << '\0' << '\x76' << '\0' << header << '\n';
  fs::resize_file(file, 128 + std::uint64_t(width) * height); // no bytes on the disk
  dgtk::Manifest manifest;
  manifest.layers.push_back(
    { { "color", dgtk::PixelType::UInt8, 1, "", "", "none", "", dgtk::Meaning::Picture }, "npy" });
  manifest.files.push_back({ "left/color/000000.npy", 1, std::string(64, '0'), "color", "left", 0 });
  dgtk::writeDocument(folder, "manifest.json", dgtk::manifestText(manifest));
  QMainWindow* const viewer = this->open(QString::fromStdString(folder));
  QVERIFY(viewer != nullptr);
  QWidget* const view = this->picture(viewer, 0);
  moveMouse(view, view->rect().center() + QPoint(1, 1));
  const QPoint pixel = pixelOf(viewer);
  QVERIFY(pixel.x() > width / 3 && pixel.y() > height / 3);
  QVERIFY2(this->cell(viewer, 0, 2).startsWith("0 "), qPrintable(this->cell(viewer, 0, 2)));
  std::fstream change(file, std::ios::binary | std::ios::in | std::ios::out);
  change.seekp(std::streamoff(128 + std::uint64_t(pixel.y()) * width + std::uint64_t(pixel.x())));
  change.put(77);
  change.close();
  for (int i = 0; i < 40; ++i)
  {
    QTest::keyClick(viewer, Qt::Key_Plus);
  }
  QCOMPARE(pixelOf(viewer), pixel);
  QTRY_COMPARE(this->cell(viewer, 0, 2), QString("77"));
}

void TestEditorViewer::pictures()
{
  const QString folder = QString::fromLocal8Bit(qgetenv("DGTK_EDITOR_PICTURES"));
  if (folder.isEmpty())
  {
    QSKIP("DGTK_EDITOR_PICTURES names no folder");
  }
  const QString dataset = this->path("pictured");
  const QString layers = "color,depth,objects,normal,flow_forward,disparity,classes,shadingnormal,uv,ldi,coverage,"
                         "correspondence,boxes,amodal,points,calibration";
  const QStringList words{ "render", demo(), "-o", dataset, "--layers", layers, "--size", "320x240", "--quiet" };
  QCOMPARE(QProcess::execute(QString::fromLocal8Bit(qgetenv("DGTK")), words), 0);
  const QString given = QString::fromLocal8Bit(qgetenv("DGTK_VIEWER_DATASET"));
  QMainWindow* const viewer = this->open(given.isEmpty() ? dataset : given);
  QVERIFY(viewer != nullptr);
  viewer->resize(1120, 800);
  const auto save = [&](const char* name)
  {
    this->waitForPictures(viewer);
    QTest::qWait(2 * settle);
    QVERIFY(viewer->grab().save(folder + "/" + name + ".png"));
  };
  this->pointAt(viewer, 110, 150);
  save("editor_viewer");
  QTest::keyClick(viewer, Qt::Key_L);
  save("editor_viewer_layers");
  QTest::keyClick(viewer, Qt::Key_2, Qt::ControlModifier);
  this->choose(viewer, 0, "left", "color");
  this->choose(viewer, 1, "left", "flow_forward");
  for (int step = 0; step < 14; ++step)
  {
    QTest::keyClick(viewer, Qt::Key_Plus);
  }
  save("editor_viewer_zoom");
  QTest::keyClick(viewer, Qt::Key_F);
  this->choose(viewer, 1, "left", "amodal");
  viewer->findChild<QWidget*>("pane.1")->findChild<QSpinBox*>("surface")->setValue(2);
  for (const Qt::Key key : { Qt::Key_B, Qt::Key_V, Qt::Key_K })
  {
    QTest::keyClick(viewer, key);
  }
  save("editor_viewer_boxes");
}
