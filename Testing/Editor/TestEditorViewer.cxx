// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorViewer.h"
#include "TestEditorSupport.h"

#include "dgtkDatasetPictures.h"
#include "dgtkDatasetPoints.h"
#include "dgtkLayerReader.h"

#include <QAction>
#include <QComboBox>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QLabel>
#include <QLineEdit>
#include <QMainWindow>
#include <QMessageBox>
#include <QMimeData>
#include <QOpenGLWidget>
#include <QPixmap>
#include <QProcess>
#include <QPushButton>
#include <QRegularExpression>
#include <QSlider>
#include <QSpinBox>
#include <QStatusBar>
#include <QTableWidget>
#include <QToolButton>
#include <QUrl>
#include <QWheelEvent>

#include <cmath>
#include <filesystem>
#include <set>

using dgtk::DatasetPictures;

namespace
{
constexpr double pointTolerance = 1e-9; // scene units

enum Column
{
  Camera,
  Layer,
  Value,
  World
};

void wheel(QWidget* widget, const QPoint& at, int steps)
{
  QWheelEvent event(
    at, widget->mapToGlobal(at), {}, { 0, 120 * steps }, Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
  QCoreApplication::sendEvent(widget, &event);
}

QString frameText(const QMainWindow* viewer) { return viewer->findChild<QLabel*>("frameText")->text(); }

int paneCount(const QMainWindow* viewer)
{
  int count = 0;
  while (viewer->findChild<QWidget*>(QString("pane.%1").arg(count)) != nullptr)
  {
    ++count;
  }
  return count;
}

/// The numbers of a text such as "(1.5, 2, nan) metre".
std::vector<double> numbersOf(const QString& text)
{
  std::vector<double> numbers;
  const QRegularExpression number("-?(\\d+\\.?\\d*(e[-+]?\\d+)?|inf|nan)");
  for (auto at = number.globalMatch(text); at.hasNext();)
  {
    numbers.push_back(at.next().captured(0).toDouble());
  }
  return numbers;
}

double valueOf(const dgtk::ImageData& image, int x, int y, int channel)
{
  const std::size_t i = std::size_t(x * image.info.channels + channel);
  switch (image.info.type)
  {
    case dgtk::PixelType::Float64:
      return image.pixels.row<double>(y)[i];
    case dgtk::PixelType::Float32:
      return double(image.pixels.row<float>(y)[i]);
    default:
      return image.pixels.row<std::uint8_t>(y)[i];
  }
}

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }
} // namespace

void TestEditorViewer::opensByFolderManifestAndDrop()
{
  QVERIFY(!this->dataset().isEmpty());
  QMainWindow* viewer = this->open(this->dataset());
  QVERIFY(viewer != nullptr);
  QVERIFY2(viewer->windowTitle().startsWith("dataset"), qPrintable(viewer->windowTitle()));
  QCOMPARE(paneCount(viewer), 4);
  QCOMPARE(this->cell(viewer, 0, Layer), QString("color"));
  QCOMPARE(this->cell(viewer, 1, Layer), QString("depth"));
  QVERIFY(viewer->close());
  viewer = this->open(this->dataset() + "/manifest.json");
  QVERIFY(viewer != nullptr);
  QCOMPARE(frameText(viewer), QString("Frame 0 (1 of 3)"));

  QMimeData elsewhere;
  elsewhere.setUrls({ QUrl("https://example.org/a.json") });
  for (QWidget* const window : { static_cast<QWidget*>(viewer), static_cast<QWidget*>(this->Window.get()) })
  {
    QDragEnterEvent none({ 50, 50 }, Qt::CopyAction, &elsewhere, Qt::LeftButton, Qt::NoModifier);
    QCoreApplication::sendEvent(window, &none);
    QVERIFY(!none.isAccepted()); // the pointer says so
  }
  QVERIFY(viewer->close());
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);

  QMimeData dropped;
  dropped.setUrls({ QUrl::fromLocalFile(this->dataset()) });
  QDragEnterEvent enter({ 50, 50 }, Qt::CopyAction, &dropped, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(this->Window.get(), &enter);
  QVERIFY(enter.isAccepted());
  QDropEvent drop({ 50, 50 }, Qt::CopyAction, &dropped, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(this->Window.get(), &drop);
  QTRY_VERIFY(this->viewer() != nullptr);
  viewer = this->viewer();
  QCOMPARE(paneCount(viewer), 4);
  viewer->findChild<QSlider*>("frames")->setValue(2);
  QDragEnterEvent over({ 50, 50 }, Qt::CopyAction, &dropped, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(viewer, &over);
  QDropEvent again({ 50, 50 }, Qt::CopyAction, &dropped, Qt::LeftButton, Qt::NoModifier);
  QCoreApplication::sendEvent(viewer, &again);
  QTRY_COMPARE(frameText(viewer), QString("Frame 0 (1 of 3)"));
}

void TestEditorViewer::framesStepAndPlay()
{
  QMainWindow* const viewer = this->open(this->dataset());
  QVERIFY(viewer != nullptr);
  this->choose(viewer, 1, "left", "flow_forward");
  this->pointAt(viewer, 30, 40);
  const QString first = this->cell(viewer, 1, Value);
  QVERIFY2(first.contains("pixels"), qPrintable(first));
  QTest::keyClick(viewer, Qt::Key_Period);
  QCOMPARE(frameText(viewer), QString("Frame 1 (2 of 3)"));
  QTest::keyClick(viewer, Qt::Key_End);
  QCOMPARE(frameText(viewer), QString("Frame 2 (3 of 3)"));
  // the last frame has no flow to the next
  QTRY_VERIFY(this->picture(viewer, 1)->toolTip().contains("No picture"));
  QCOMPARE(this->cell(viewer, 1, Value), QString());
  QTest::keyClick(viewer, Qt::Key_Comma);
  QTest::keyClick(viewer, Qt::Key_Home);
  this->waitForPictures(viewer);
  QCOMPARE(this->cell(viewer, 1, Value), first);

  auto* const play = viewer->findChild<QAction*>("play");
  QTest::keyClick(viewer, Qt::Key_P);
  QVERIFY(play->isChecked());
  QTRY_VERIFY(!play->isChecked());
  QCOMPARE(frameText(viewer), QString("Frame 2 (3 of 3)"));
  this->waitForPictures(viewer);
}

void TestEditorViewer::numbersAreThoseOfTheFiles()
{
  QMainWindow* const viewer = this->open(this->dataset());
  QVERIFY(viewer != nullptr);
  const DatasetPictures dataset(this->dataset().toStdString());
  const char* const layers[] = { "depth", "position", "normal", "objects" };
  std::vector<dgtk::ImageData> files;
  for (int pane = 0; pane < 4; ++pane)
  {
    this->choose(viewer, pane, "right", layers[pane]);
    files.push_back(dgtk::readLayerFile(dataset.file({ "right", 0, layers[pane] })));
  }
  for (const QPoint& pixel : { QPoint(0, 0), QPoint(63, 47), QPoint(20, 30), QPoint(33, 25), QPoint(40, 1) })
  {
    this->pointAt(viewer, pixel.x(), pixel.y());
    for (int pane = 0; pane < 3; ++pane)
    {
      const std::vector<double> shown = numbersOf(this->cell(viewer, pane, Value));
      QCOMPARE(int(shown.size()), files[std::size_t(pane)].info.channels);
      for (int c = 0; c < int(shown.size()); ++c)
      {
        const double file = valueOf(files[std::size_t(pane)], pixel.x(), pixel.y(), c);
        QVERIFY2(files[std::size_t(pane)].info.type == dgtk::PixelType::Float32
                   ? same(double(float(shown[std::size_t(c)])), file)
                   : same(shown[std::size_t(c)], file),
          qPrintable(this->cell(viewer, pane, Value)));
      }
    }
    const auto id = static_cast<std::uint32_t>(valueOf(files[3], pixel.x(), pixel.y(), 2));
    const dgtk::ObjectRecord* const object = dataset.object(id);
    const std::string name = object ? " " + object->name + " (" + object->objectClass + ")" : " background";
    QCOMPARE(this->cell(viewer, 3, Value), QString::fromStdString(std::to_string(id) + name));
    const std::vector<double> world = numbersOf(this->cell(viewer, 0, World));
    QCOMPARE(world.size(), std::size_t(id == 0 ? 0 : 3));
    for (int c = 0; c < int(world.size()); ++c)
    {
      const double position = valueOf(files[1], pixel.x(), pixel.y(), c);
      QVERIFY(std::abs(world[std::size_t(c)] - position) <= 1e-5 * std::max(1.0, std::abs(position)));
    }
    QCOMPARE(this->cell(viewer, 3, World), this->cell(viewer, 0, World)); // of the camera, whatever the layer
  }
  dgtk::PointCloud cloud;
  dgtk::addPoints(cloud, dataset, "right", 0, "color", 1000000);
  std::size_t at = 0;
  for (int y = 0; y < 48; ++y)
  {
    for (int x = 0; x < 64; ++x)
    {
      const Eigen::Vector3d position(
        valueOf(files[1], x, y, 0), valueOf(files[1], x, y, 1), valueOf(files[1], x, y, 2));
      if (position.allFinite())
      {
        QVERIFY((cloud.points.at(at++) - position).norm() < pointTolerance);
      }
    }
  }
  QCOMPARE(at, cloud.points.size());
}

void TestEditorViewer::zoomIsCommon()
{
  QMainWindow* const viewer = this->open(this->dataset());
  QVERIFY(viewer != nullptr);
  QWidget* const first = this->picture(viewer, 0);
  QWidget* const last = this->picture(viewer, 3);
  QVERIFY2(first->hasFocus(), "arrows move the crosshair before anything is clicked");
  QWidget* const table = viewer->findChild<QTableWidget*>();
  table->setFocus();
  const QPoint mouse = first->rect().center() + QPoint(37, -22);
  moveMouse(first, mouse);
  QVERIFY2(first->hasFocus(), "and where the mouse is over a picture");
  const QPoint pixel = pixelOf(viewer);
  QVERIFY(pixel.x() > 0);
  const QPoint elsewhere = mouse + QPoint(30, 30);
  moveMouse(last, elsewhere);
  const QPoint other = pixelOf(viewer);
  QVERIFY(other != pixel);
  for (int step = 0; step < 12; ++step)
  {
    wheel(first, mouse, 1);
    QCOMPARE(pixelOf(viewer), pixel);
  }
  moveMouse(last, mouse);
  QCOMPARE(pixelOf(viewer), pixel);
  const dgtk::ImageData color =
    dgtk::readLayerFile(DatasetPictures(this->dataset().toStdString()).file({ "left", 0, "color" }));
  const QColor file(int(valueOf(color, pixel.x(), pixel.y(), 0)), int(valueOf(color, pixel.x(), pixel.y(), 1)),
    int(valueOf(color, pixel.x(), pixel.y(), 2)));
  QCOMPARE(first->grab().toImage().pixelColor(mouse), file);

  QTest::mousePress(last, Qt::LeftButton, {}, mouse);
  for (int step = 1; step <= 4; ++step)
  {
    moveMouse(last, mouse + step * QPoint(-12, 9), Qt::LeftButton);
  }
  QTest::mouseRelease(last, Qt::LeftButton, {}, mouse + QPoint(-48, 36));
  QCOMPARE(pixelOf(viewer), pixel);
  moveMouse(first, mouse + QPoint(-48, 36));
  QCOMPARE(pixelOf(viewer), pixel);
  QTest::keyClick(viewer, Qt::Key_F);
  moveMouse(first, mouse + QPoint(1, 0));
  moveMouse(first, mouse);
  QCOMPARE(pixelOf(viewer), pixel);
  moveMouse(first, elsewhere);
  QCOMPARE(pixelOf(viewer), other);
}

void TestEditorViewer::presetsAndLayouts()
{
  QMainWindow* const viewer = this->open(this->dataset());
  QVERIFY(viewer != nullptr);
  const DatasetPictures dataset(this->dataset().toStdString());
  QTest::keyClick(viewer, Qt::Key_L);
  this->waitForPictures(viewer);
  QCOMPARE(paneCount(viewer), int(dataset.layersOf("left").size()));
  std::set<QString> labels;
  for (int pane = 0; pane < paneCount(viewer); ++pane)
  {
    QCOMPARE(this->cell(viewer, pane, Camera), QString("left"));
    labels.insert(this->cell(viewer, pane, Layer));
    QVERIFY2(this->picture(viewer, pane)->toolTip().isEmpty(), qPrintable(this->picture(viewer, pane)->toolTip()));
  }
  QCOMPARE(labels.size(), dataset.layersOf("left").size());
  QTest::keyClick(viewer, Qt::Key_1, Qt::ControlModifier);
  this->waitForPictures(viewer);
  QCOMPARE(paneCount(viewer), 1);
  this->choose(viewer, 0, "right", "depth");
  QTest::keyClick(viewer, Qt::Key_C);
  this->waitForPictures(viewer);
  QCOMPARE(paneCount(viewer), 2);
  QCOMPARE(this->cell(viewer, 0, Camera) + this->cell(viewer, 1, Camera), QString("leftright"));
  QCOMPARE(this->cell(viewer, 1, Layer), QString("depth"));
  // a layer that the other camera does not have: another one is shown there
  this->choose(viewer, 0, "left", "correspondence_right");
  QTest::keyClick(viewer, Qt::Key_C);
  this->waitForPictures(viewer);
  QCOMPARE(this->cell(viewer, 0, Layer), QString("correspondence_right"));
  const std::vector<std::string> others = dataset.layersOf("right");
  QVERIFY(std::count(others.begin(), others.end(), this->cell(viewer, 1, Layer).toStdString()) == 1);
  QVERIFY2(this->picture(viewer, 1)->toolTip().isEmpty(), qPrintable(this->picture(viewer, 1)->toolTip()));
  QTest::keyClick(viewer, Qt::Key_4, Qt::ControlModifier);
  this->waitForPictures(viewer);
  QCOMPARE(paneCount(viewer), 4);
  QTest::mouseDClick(this->picture(viewer, 2), Qt::LeftButton);
  QVERIFY(!this->picture(viewer, 0)->isVisible());
  QVERIFY(this->picture(viewer, 2)->isVisible());
  QTest::keyClick(viewer, Qt::Key_F11);
  QVERIFY(this->picture(viewer, 0)->isVisible());
}

void TestEditorViewer::rangesAreChosen()
{
  QMainWindow* const viewer = this->open(this->dataset());
  QVERIFY(viewer != nullptr);
  this->choose(viewer, 0, "right", "depth");
  auto* const pane = viewer->findChild<QWidget*>("pane.1");
  auto* const low = pane->findChild<QLineEdit*>("low");
  auto* const high = pane->findChild<QLineEdit*>("high");
  auto* const own = pane->findChild<QToolButton*>("auto");
  QVERIFY(low->isVisible());
  QVERIFY(own->isChecked());
  const QString nearest = low->text();
  const QImage before = this->picture(viewer, 1)->grab().toImage();
  low->setFocus();
  low->selectAll();
  QTest::keyClicks(low, "5");
  QTest::keyClick(low, Qt::Key_Return);
  high->setFocus();
  high->selectAll();
  QTest::keyClicks(high, "9.5");
  QTest::keyClick(high, Qt::Key_Return);
  this->waitForPictures(viewer);
  QVERIFY(!own->isChecked());
  QCOMPARE(low->text(), QString("5"));
  QVERIFY(this->picture(viewer, 1)->grab().toImage() != before);
  auto* const sibling = viewer->findChild<QWidget*>("pane.0");
  QCOMPARE(sibling->findChild<QLineEdit*>("high")->text(), QString("9.5")); // the same layer of another camera
  for (const char* text : { " ", "." })
  {
    typeInto(high, text);
    QCOMPARE(high->text(), QString("9.5")); // what is no number gives way, and is told
    QVERIFY(viewer->statusBar()->currentMessage().startsWith(QString("\"%1\"").arg(text)));
  }
  QTest::keyClick(this->picture(viewer, 1), Qt::Key_Period);
  this->waitForPictures(viewer);
  QCOMPARE(high->text(), QString("9.5"));
  QTest::keyClick(this->picture(viewer, 1), Qt::Key_Comma);
  QTest::mouseClick(own, Qt::LeftButton);
  this->waitForPictures(viewer);
  QCOMPARE(low->text(), nearest);
  this->picture(viewer, 0)->setFocus();
  QCOMPARE(this->picture(viewer, 1)->grab().toImage(), before);
}

void TestEditorViewer::theRenderDialogOpensItsResult()
{
  this->action("render")->trigger();
  auto* const dialog = this->Window->findChild<QDialog*>("renderDialog");
  auto* const result = dialog->findChild<QPushButton*>("openResult");
  dialog->findChild<QLineEdit*>("folder")->setText(this->path("nothing"));
  QVERIFY(!result->isEnabled());
  dialog->findChild<QLineEdit*>("folder")->setText(this->dataset());
  QVERIFY(result->isEnabled());
  QTest::mouseClick(result, Qt::LeftButton);
  QTRY_VERIFY(this->viewer() != nullptr);
  QCOMPARE(paneCount(this->viewer()), 4);
}

DGTK_EDITOR_TEST(TestEditorViewer);
