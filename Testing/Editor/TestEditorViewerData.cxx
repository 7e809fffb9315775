// SPDX-License-Identifier: BSD-3-Clause
// Names, words, and what a dataset has beside pictures.
#include "TestEditorSupport.h"
#include "TestEditorViewer.h"

#include "dgtkDatasetDocuments.h"
#include "dgtkLayerColors.h"
#include "dgtkLayerReader.h"
#include "dgtkObjectDocuments.h"
#include "dgtkPixelText.h"

#include <QAction>
#include <QComboBox>
#include <QHelpEvent>
#include <QImage>
#include <QMainWindow>
#include <QPlainTextEdit>
#include <QProcess>
#include <QRegularExpression>
#include <QSpinBox>
#include <QStatusBar>
#include <QStyle>
#include <QStyleOptionComboBox>
#include <QTableWidget>

#include <filesystem>
#include <map>
#include <set>

namespace
{
namespace fs = std::filesystem;

constexpr int width = 64;
constexpr int height = 48;

/// Whether a colour is within a widget's pixel or two of a place.
bool hasColorNear(const QImage& image, const QPointF& at, const dgtk::Rgb& color)
{
  for (int y = -2; y <= 2; ++y)
  {
    for (int x = -2; x <= 2; ++x)
    {
      const QPoint pixel = QPointF(at).toPoint() + QPoint(x, y);
      if (image.valid(pixel) && image.pixelColor(pixel) == QColor(color[0], color[1], color[2]))
      {
        return true;
      }
    }
  }
  return false;
}

QPointF picturePoint(QWidget* picture, const QPointF& image)
{
  QPointF point;
  QMetaObject::invokeMethod(picture, "widgetPoint", Q_RETURN_ARG(QPointF, point), Q_ARG(QPointF, image));
  return point;
}

QString shortest(double value) { return QString::fromStdString(dgtk::numberText(value, dgtk::PixelType::Float64)); }
} // namespace

void TestEditorViewer::longNamesAreLegible()
{
  const std::string folder = this->Folder.path("names");
  const std::string camera = "camera-above-the-mill-left";
  dgtk::Manifest manifest;
  const dgtk::LayerSpec spec{ "correspondence", dgtk::PixelType::UInt8, 1, "", "", "none", "",
    dgtk::Meaning::Visibility };
  manifest.layers.push_back({ spec, "png" });
  for (int i = 0; i < 12; ++i)
  {
    const std::string layer = "correspondence_camera-" + std::to_string(i) + "-above-the-house";
    const std::string name = camera + "/" + layer + "/000000.png";
    fs::create_directories(folder + "/" + camera + "/" + layer);
    QImage image(64, 48, QImage::Format_Grayscale8);
    image.fill(17 * i);
    QVERIFY(image.save(QString::fromStdString(folder + "/" + name)));
    manifest.files.push_back({ name, 1, std::string(64, '0'), "correspondence", camera, 0 });
  }
  dgtk::writeDocument(folder, "manifest.json", dgtk::manifestText(manifest));
  QMainWindow* const viewer = this->open(QString::fromStdString(folder));
  QVERIFY(viewer != nullptr);
  viewer->resize(1280, 900);
  const auto whole = [&]
  {
    int names = 0;
    for (QComboBox* combo : viewer->findChildren<QComboBox*>())
    {
      QStyleOptionComboBox option;
      option.initFrom(combo);
      const QRect field =
        combo->style()->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, combo);
      const bool fits = combo->fontMetrics().horizontalAdvance(combo->currentText()) <= field.width();
      names += combo->isVisible() && fits;
    }
    return names;
  };
  QTRY_COMPARE(whole(), 2 * 4);
  QTest::keyClick(viewer, Qt::Key_L);
  this->waitForPictures(viewer);
  QTRY_COMPARE(whole(), 2 * 12);
  const QSize seen = this->picture(viewer, 0)->size();
  QVERIFY(2 * seen.height() >= seen.width()); // scrolled, not flat
  auto* const table = viewer->findChild<QTableWidget*>("readOut");
  for (const int column : { 0, 1 })
  {
    QVERIFY(table->columnWidth(column) >= table->fontMetrics().horizontalAdvance(this->cell(viewer, 0, column)));
  }
  // where there is no room the ends are seen, and the tool tip has all
  viewer->findChild<QAction*>("cloud")->setChecked(true);
  viewer->resize(viewer->minimumSizeHint());
  QTRY_VERIFY(whole() < 2 * 12);
  auto* const layer = viewer->findChild<QWidget*>("pane.3")->findChild<QComboBox*>("layer");
  QHelpEvent hover(QEvent::ToolTip, layer->rect().center(), layer->mapToGlobal(layer->rect().center()));
  QCoreApplication::sendEvent(layer, &hover);
  QVERIFY2(layer->toolTip().endsWith(": " + layer->currentText()), qPrintable(layer->toolTip()));
}

void TestEditorViewer::germanIsSpokenOfPixels()
{
  const German german;
  QMainWindow* const viewer = this->open(this->dataset());
  QVERIFY(viewer != nullptr);
  const char* const layers[] = { "objects", "flow_forward class", "flow_forward", "ldi depth" };
  for (int pane = 0; pane < 4; ++pane)
  {
    this->choose(viewer, pane, "left", layers[pane]);
  }
  const QStringList classes{ QString::fromUtf8("keine Fl\u00e4che"), "sichtbar", "von einem anderen Objekt verdeckt",
    "vom eigenen Objekt verdeckt", QString::fromUtf8("au\u00dferhalb des Bildes"), "hinter der Kamera" };
  const QRegularExpression surfaces(QString::fromUtf8("^(1 Fl\u00e4che: |\\d+ Fl\u00e4chen)"));
  std::set<int> seen;
  const dgtk::ImageData ids = dgtk::readLayerFile(this->dataset().toStdString() + "/left/objects/000000.ppm");
  std::map<int, QPoint> pixels; // one of each object, and of the background
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      pixels.emplace(ids.pixels.row<std::uint8_t>(y)[3 * x + 2], QPoint(x, y));
    }
  }
  for (const auto& [id, pixel] : pixels)
  {
    this->pointAt(viewer, pixel.x(), pixel.y());
    const QString kind = this->cell(viewer, 1, 2);
    const int number = kind.section(' ', 0, 0).toInt();
    QCOMPARE(kind.section(' ', 1), classes[number]);
    seen.insert(number);
    QCOMPARE(this->cell(viewer, 0, 2) == "0 Hintergrund", id == 0);
    QCOMPARE(number == 0, id == 0);
    const QString flow = this->cell(viewer, 2, 2);
    QVERIFY2(number == 0 || (flow.contains(") Pixel, ") && flow.endsWith(" lang")), qPrintable(flow));
    QVERIFY2(surfaces.match(this->cell(viewer, 3, 2)).hasMatch(), qPrintable(this->cell(viewer, 3, 2)));
  }
  QVERIFY(seen.count(0) == 1 && seen.size() > 1);
}

QString TestEditorViewer::richDataset()
{
  if (this->RenderedRich.isEmpty())
  {
    const QString folder = this->path("rich");
    const QStringList words{ "render", this->scene(), "-o", folder, "--layers",
      "color,objects,boxes,amodal,points,calibration", "--size", QString("%1x%2").arg(width).arg(height), "--frames",
      "0:1", "--quiet" };
    const int status = QProcess::execute(QString::fromLocal8Bit(qgetenv("DGTK")), words);
    this->RenderedRich = status == 0 ? folder : QString();
  }
  return this->RenderedRich;
}

void TestEditorViewer::boxesAndPointsLieOverPictures()
{
  QMainWindow* viewer = this->open(this->dataset());
  QVERIFY(viewer != nullptr);
  // NOLINTNEXTLINE(clang-analyzer-core.CallAndMessage): QVERIFY has returned
  QVERIFY(!viewer->findChild<QAction*>("boxes")->isEnabled()); // this one has none
  QVERIFY(viewer->close());
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  viewer = this->open(this->richDataset());
  QVERIFY(viewer != nullptr);
  QTest::keyClick(viewer, Qt::Key_1, Qt::ControlModifier);
  this->waitForPictures(viewer);
  QWidget* const picture = this->picture(viewer, 0);
  for (const QString& camera : { QString("left"), QString("right") })
  {
    this->choose(viewer, 0, camera, "color");
    for (const int frame : { 0, 1 })
    {
      QTest::keyClick(viewer, frame == 0 ? Qt::Key_Home : Qt::Key_End);
      this->waitForPictures(viewer);
      const QImage bare = picture->grab().toImage();
      QTest::keyClick(viewer, Qt::Key_B);
      this->waitForPictures(viewer);
      const QImage boxed = picture->grab().toImage();
      QTest::keyClick(viewer, Qt::Key_B);
      QTest::keyClick(viewer, Qt::Key_S);
      this->waitForPictures(viewer);
      const QImage dotted = picture->grab().toImage();
      QTest::keyClick(viewer, Qt::Key_S);
      this->waitForPictures(viewer);
      QCOMPARE(picture->grab().toImage(), bare);
      const std::string folder = this->richDataset().toStdString();
      const std::string name = "/00000" + std::to_string(frame) + ".json";
      int boxes = 0;
      for (const dgtk::BoxRecord& box : dgtk::readBoxes(folder + "/" + camera.toStdString() + "/boxes" + name))
      {
        if (box.visible)
        {
          ++boxes;
          const Eigen::Vector4d& edge = *box.visible;
          int met = 0; // where no name is in front
          for (int i = 1; i < 8; ++i)
          {
            const double x = edge[0] + (edge[2] - edge[0]) * i / 8;
            const double y = edge[1] + (edge[3] - edge[1]) * i / 8;
            for (const QPointF& at :
              { QPointF(x, edge[1]), QPointF(x, edge[3]), QPointF(edge[0], y), QPointF(edge[2], y) })
            {
              met += hasColorNear(boxed, picturePoint(picture, at), dgtk::idColor(box.id));
            }
          }
          QVERIFY2(met >= 10, qPrintable(QString("%1 of 28").arg(met)));
        }
      }
      QVERIFY(boxes >= 3);
      const dgtk::TrackedPoints points = dgtk::readPoints(folder + "/points" + name);
      int seen = 0;
      int drawn = 0;
      for (const dgtk::PointRecord& point : points.points)
      {
        for (const dgtk::PointRecord::Sight& sight : point.track)
        {
          if (points.cameras[sight.camera] == camera.toStdString())
          {
            ++seen;
            const QPointF at = picturePoint(picture, { sight.u, sight.v });
            drawn += hasColorNear(dotted, at, dgtk::idColor(point.object)) &&
                     !hasColorNear(bare, at, dgtk::idColor(point.object));
          }
        }
      }
      QVERIFY2(seen > 50 && drawn > seen * 9 / 10, qPrintable(QString("%1 of %2").arg(drawn).arg(seen)));
    }
  }

  // a picture that is small is not hidden by its points
  for (int step = 0; step < 10; ++step)
  {
    QTest::keyClick(viewer, Qt::Key_Minus);
  }
  const QImage small = picture->grab().toImage();
  QTest::keyClick(viewer, Qt::Key_S);
  this->waitForPictures(viewer);
  const QImage dotted = picture->grab().toImage();
  int changed = 0;
  for (int y = 0; y < small.height(); ++y)
  {
    for (int x = 0; x < small.width(); ++x)
    {
      changed += small.pixel(x, y) != dotted.pixel(x, y);
    }
  }
  const QPointF extent = picturePoint(picture, { width, height }) - picturePoint(picture, { 0, 0 });
  QVERIFY2(changed > 50 && changed < extent.x() * extent.y() / 2, qPrintable(QString::number(changed)));

  // a damaged file is told, and pictures stay
  const std::string broken = this->Folder.path("brokenBoxes");
  fs::copy(this->richDataset().toStdString(), broken, fs::copy_options::recursive);
  fs::resize_file(broken + "/left/boxes/000000.json", 100);
  QVERIFY(viewer->close());
  QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
  viewer = this->open(QString::fromStdString(broken));
  QVERIFY(viewer != nullptr);
  const QImage bare = this->picture(viewer, 0)->grab().toImage();
  QTest::keyClick(viewer, Qt::Key_B);
  this->waitForPictures(viewer);
  QVERIFY2(viewer->statusBar()->currentMessage().contains("left/boxes/000000.json"),
    qPrintable(viewer->statusBar()->currentMessage()));
  QCOMPARE(this->picture(viewer, 0)->grab().toImage(), bare);

  // nor is another camera without its boxes, and the message goes with the damage
  this->choose(viewer, 1, "right", "color");
  const QImage boxed = this->picture(viewer, 1)->grab().toImage();
  QTest::keyClick(viewer, Qt::Key_B);
  this->waitForPictures(viewer);
  QVERIFY(this->picture(viewer, 1)->grab().toImage() != boxed);
  QCOMPARE(viewer->statusBar()->currentMessage(), QString());
  QTest::keyClick(viewer, Qt::Key_B);
  this->waitForPictures(viewer);
  QVERIFY(!viewer->statusBar()->currentMessage().isEmpty());
  QTest::keyClick(viewer, Qt::Key_End); // the next frame is whole
  this->waitForPictures(viewer);
  QCOMPARE(viewer->statusBar()->currentMessage(), QString());
}

void TestEditorViewer::masksHaveASliceForEachObject()
{
  QMainWindow* const viewer = this->open(this->richDataset());
  QVERIFY(viewer != nullptr);
  this->choose(viewer, 0, "left", "amodal");
  auto* const slice = viewer->findChild<QWidget*>("pane.0")->findChild<QSpinBox*>("surface");
  QVERIFY(slice->isVisible());
  const std::string folder = this->richDataset().toStdString();
  const std::vector<dgtk::ObjectRecord> objects = dgtk::readObjects(folder + "/objects.json");
  QCOMPARE(slice->maximum(), int(objects.size()));
  int insides = 0;
  int outsides = 0;
  std::set<int> slices;
  for (const dgtk::MaskRecord& mask : dgtk::readAmodal(folder + "/left/amodal/000000.json").masks)
  {
    slice->setValue(int(mask.id));
    this->waitForPictures(viewer);
    slices.insert(int(mask.id));
    std::vector<bool> inside; // column by column
    for (std::size_t run = 0; run < mask.counts.size(); ++run)
    {
      inside.insert(inside.end(), mask.counts[run], run % 2 == 1);
    }
    const dgtk::ObjectRecord& object = objects[mask.id - 1];
    for (const QPoint& pixel : { QPoint(2, 3), QPoint(20, 30), QPoint(33, 25), QPoint(40, 20), QPoint(60, 45) })
    {
      this->pointAt(viewer, pixel.x(), pixel.y());
      const bool in = inside[std::size_t(pixel.x() * height + pixel.y())];
      (in ? insides : outsides) += 1;
      const QString name = QString::fromStdString(object.name + " (" + object.objectClass + ")");
      QCOMPARE(this->cell(viewer, 0, 2), in ? QString("%1 %2").arg(mask.id).arg(name) : QString("0 outside"));
    }
  }
  QVERIFY(slices.size() > 2 && insides > 2 && outsides > 2);
  this->choose(viewer, 0, "left", "color");
  QVERIFY(!slice->isVisible());
}

void TestEditorViewer::calibrationIsShown()
{
  QMainWindow* const viewer = this->open(this->richDataset());
  QVERIFY(viewer != nullptr);
  auto* const panel = viewer->findChild<QPlainTextEdit*>("calibration");
  QVERIFY(!panel->isVisible());
  QTest::keyClick(viewer, Qt::Key_K);
  QVERIFY(panel->isVisible());
  const std::string folder = this->richDataset().toStdString();
  const auto missing = [panel](const auto& matrix)
  {
    const QStringList words = panel->toPlainText().simplified().split(' ');
    QStringList numbers;
    for (Eigen::Index i = 0; i < matrix.size(); ++i)
    {
      const double value = matrix.data()[i];
      const QString number = shortest(value == 0 ? 0.0 : value); // no sign of a zero
      numbers += words.contains(number) ? QStringList() : QStringList(number);
    }
    return numbers;
  };
  for (const dgtk::CameraRecord& record : dgtk::readCameras(folder + "/cameras.json"))
  {
    this->choose(viewer, 0, QString::fromStdString(record.name), "color");
    QTest::keyClick(viewer, record.frame == 0 ? Qt::Key_Home : Qt::Key_End);
    const QString text = panel->toPlainText();
    QVERIFY2(text.startsWith(QString::fromStdString(record.name) + ", frame " + QString::number(record.frame)),
      qPrintable(text));
    QVERIFY(text.contains("Size: 64 x 48 pixels\nLens: " + QString::fromStdString(record.model)));
    QVERIFY2(!text.contains("-0 ") && !text.contains("-0\n"), qPrintable(text));
    QCOMPARE(missing(record.K), QStringList());
    QCOMPARE(missing(record.R), QStringList());
    QCOMPARE(missing(record.t), QStringList());
    const dgtk::Calibration calibration =
      dgtk::readCalibration(folder + "/" + record.name + "/calibration/00000" + std::to_string(record.frame) + ".txt");
    QCOMPARE(missing(calibration.K), QStringList());
    QCOMPARE(missing(calibration.Rt), QStringList());
    QVERIFY(text.contains("Viewport\n  0 0 64 48"));
  }
  QTest::keyClick(viewer, Qt::Key_K);
  QVERIFY(!panel->isVisible());
}
