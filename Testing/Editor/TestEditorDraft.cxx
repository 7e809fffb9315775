// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorTruth.h"
#include "TestEditorTruthSupport.h"

#include "dgtkMainWindow.h"
#include "dgtkSceneDocument.h"
#include "dgtkViewCamera.h"

#include <QAction>
#include <QComboBox>
#include <QImage>
#include <QOpenGLWidget>
#include <QProcess>
#include <QTest>

#include <algorithm>
#include <cmath>
#include <fstream>

using dgtk::test::sourceFile;

namespace
{
constexpr int squares = 4; // a side of the pictures that are compared
// Of 255, of the mean colours of squares.
constexpr double shadingTolerance = 8;
constexpr double environmentTolerance = 24; // what mirrors it has only its mean
constexpr double farAway = 1000;
constexpr int aside = 3; // presses of a key

/// The largest difference between the mean colours of squares of two pictures, of 255.
double worstSquare(const QImage& a, const QImage& b)
{
  double worst = 0;
  for (int square = 0; square < squares * squares; ++square)
  {
    const int left = square % squares * a.width() / squares;
    const int top = square / squares * a.height() / squares;
    double sum[3] = { 0, 0, 0 };
    for (int y = top; y < top + a.height() / squares; ++y)
    {
      for (int x = left; x < left + a.width() / squares; ++x)
      {
        const QRgb one = a.pixel(x, y);
        const QRgb other = b.pixel(x, y);
        sum[0] += qRed(one) - qRed(other);
        sum[1] += qGreen(one) - qGreen(other);
        sum[2] += qBlue(one) - qBlue(other);
      }
    }
    for (const double channel : sum)
    {
      worst = std::max(worst, std::abs(channel) * squares * squares / (double(a.width()) * a.height()));
    }
  }
  return worst;
}
} // namespace

void TestEditorTruth::viewsHaveTheRenderersColours_data()
{
  QTest::addColumn<QString>("scene");
  QTest::addColumn<double>("tolerance");
  QTest::newRow("emission") << "appendix_b3.scene" << shadingTolerance;
  QTest::newRow("lights") << "demo.json" << shadingTolerance;
  QTest::newRow("environment") << "materials_environment.json" << environmentTolerance;
}

/// The perspective view from a camera's place, and the renderer's picture of a camera with the view's lens.
void TestEditorTruth::viewsHaveTheRenderersColours()
{
  QFETCH(QString, scene);
  QFETCH(double, tolerance);
  QVERIFY(this->Window->openFile(QString::fromStdString(sourceFile(("Data/Scenes/" + scene).toStdString()))));
  auto* view = this->Window->findChild<QOpenGLWidget*>("view.3");
  dgtk::SceneDocument& document = this->Window->document();
  document.edit("The view's lens",
    [view](dgtk::SceneDescription& edited)
    {
      dgtk::CameraDescription& camera = edited.cameras.front();
      camera.K.reset();
      camera.fovY = dgtk::ViewCamera::angle();
      camera.aspect = 0;
      camera.width = view->width();
      camera.height = view->height();
      for (dgtk::LightDescription& light : edited.lights) // their signs would stand before the view
      {
        const Eigen::Vector3d away = light.position.at(0) - light.target.at(0);
        light.position = light.kind == dgtk::LightKind::Directional
                           ? Eigen::Vector3d(light.target.at(0) + farAway * away)
                           : light.position.at(0);
      }
    });
  const std::string name = document.scene().cameras.front().name;
  document.writeCopy(this->Folder.path("view.json"));
  const QStringList words{ "render", this->path("view.json"), "-o", this->path("drawn"), "--replace", "--layers",
    "color", "--cameras", name.c_str(), "--frames", "0", "--quiet" };
  QCOMPARE(QProcess::execute(QString::fromLocal8Bit(qgetenv("DGTK")), words), 0);
  const QImage rendered(this->path(("drawn/" + name + "/color/000000.png").c_str()));
  QCOMPARE(rendered.size(), view->size());

  this->action("grid")->setChecked(false);
  this->select(name.c_str());
  this->action("preview")->trigger();
  auto* picture = view->findChild<QWidget*>("truthPicture");
  QTRY_VERIFY(picture->property("settled").toBool());
  view->setFocus();
  for (int i = 0; i < aside; ++i)
  {
    QTest::keyClick(view, Qt::Key_Right);
    QTest::keyClick(view, Qt::Key_Left);
  }
  QVERIFY(!picture->isVisible());
  untilQuiet();
  const double worst = worstSquare(view->grabFramebuffer(), rendered);
  QVERIFY2(worst < tolerance, QByteArray::number(worst));
}

/// Some twenty texels a pixel, black and white by turns, are grey.
void TestEditorTruth::texturesAreSmoothFromAfar()
{
  constexpr int texels = 256; // a side, of a picture that is repeated four times
  constexpr int middle = 64;  // pixels
  constexpr int even = 8;     // of 255
  QImage board(texels, texels, QImage::Format_RGB32);
  for (int i = 0; i < texels * texels; ++i)
  {
    board.setPixel(i % texels, i / texels, (i % texels + i / texels) % 2 == 0 ? 0xffffffff : 0xff000000);
  }
  QVERIFY(board.save(this->path("board.png")));
  std::ofstream(this->Folder.path("board.mtl")) << "newmtl board\nKd 1 1 1\nmap_Kd board.png\n";
  std::ofstream(this->Folder.path("board.obj"))
    << "mtllib board.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 4 0\nvt 4 4\nvt 0 4\n"
       "usemtl board\nf 1/1 2/2 3/3 4/4\n";
  std::ofstream(this->Folder.path("board.json"))
    << R"({ "version": 1, "objects": [{ "name": "board", "model": "board.obj" }] })";
  QVERIFY(this->Window->openFile(this->path("board.json")));
  this->action("grid")->setChecked(false);
  untilQuiet();
  for (const int place : { front, perspective })
  {
    auto* view = this->Window->findChild<QOpenGLWidget*>("view." + QString::number(place));
    const QImage whole = view->grabFramebuffer();
    const QImage seen = whole.copy((whole.width() - middle) / 2, (whole.height() - middle) / 2, middle, middle);
    int least = 255;
    int most = 0;
    for (int i = 0; i < middle * middle; ++i)
    {
      least = std::min(least, qGreen(seen.pixel(i % middle, i / middle)));
      most = std::max(most, qGreen(seen.pixel(i % middle, i / middle)));
    }
    QVERIFY2(most - least <= even && least > 80 && most < 180, qPrintable(QString("%1 to %2").arg(least).arg(most)));
  }
}

void TestEditorTruth::whatIsNotTheRenderersSaysDraft()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  const auto draft = [this](int view)
  {
    auto* widget = this->Window->findChild<QWidget*>("view." + QString::number(view));
    const auto* label = widget->findChild<QLabel*>("draft");
    return label != nullptr && label->isVisible() && label->text() == "Draft";
  };
  for (int view = 0; view < 4; ++view)
  {
    QVERIFY(draft(view));
  }
  this->action("show.depth")->trigger();
  QVERIFY2(draft(0) && !draft(3), "depths are the dataset's");
  this->select("left");
  this->action("preview")->trigger();
  QVERIFY(!draft(3));
  this->action("show.colour")->trigger();
  QVERIFY2(draft(3), "colours through a camera are not");
  this->action("show.objects")->trigger();
  QVERIFY(!draft(3));
  this->action("show.surface")->trigger();
  QVERIFY(draft(3));

  QWidget* const dialog = this->openMatches();
  const auto* label = dialog->findChild<QWidget*>("pane.0")->findChild<QLabel*>("draft");
  QVERIFY(label != nullptr && label->isVisible());
  auto* layer = dialog->findChild<QComboBox*>("layer");
  layer->setCurrentIndex(layer->findData("depth"));
  QVERIFY(!label->isVisible());
}
