// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorLook.h"
#include "TestEditorSupport.h"

#include "dgtkEditorLanguage.h"
#include "dgtkFile.h"
#include "dgtkMainWindow.h"
#include "dgtkSceneDocument.h"

#include <QAbstractButton>
#include <QAction>
#include <QComboBox>
#include <QDialog>
#include <QDockWidget>
#include <QLabel>
#include <QLineEdit>
#include <QOpenGLWidget>
#include <QProcess>
#include <QTest>
#include <QTranslator>
#include <QVTKOpenGLNativeWidget.h>
#include <QXmlStreamReader>

#include <vtkCallbackCommand.h>
#include <vtkCommand.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

using dgtk::test::sourceFile;

namespace
{
constexpr double leastFramed = 0.15; // of a view, that something framed takes
constexpr double zoomPerStep = 0.15; // of the minus key, natural logarithm
constexpr double seamTolerance = 12; // of 255: fewer normals shade a little differently
constexpr int nearEdge = 2;          // pixels of the window on either side of an edge

QString text(const char* relative) { return QString::fromStdString(sourceFile(relative)); }

/// English strings that are others in German, from the translation's source.
QMap<QString, QString> germanOfEnglish()
{
  QMap<QString, QString> german;
  QFile file(text("Modules/Controls/Translations/dgtk-editor_de.ts"));
  file.open(QIODevice::ReadOnly);
  QXmlStreamReader xml(&file);
  QString english;
  while (!xml.atEnd())
  {
    xml.readNext();
    if (xml.isStartElement() && xml.name() == QLatin1String("source"))
    {
      english = xml.readElementText();
    }
    else if (xml.isStartElement() && xml.name() == QLatin1String("translation"))
    {
      german[english] = xml.readElementText(QXmlStreamReader::IncludeChildElements).trimmed();
    }
  }
  return german;
}

/// A ball whose texture meets itself in front, where it is yellow; black elsewhere.
void writeBall(const std::string& folder)
{
  constexpr int around = 64;
  constexpr int down = 32;
  QImage picture(256, 16, QImage::Format_RGB32);
  for (int y = 0; y < picture.height(); ++y)
  {
    for (int x = 0; x < picture.width(); ++x)
    {
      picture.setPixel(x, y, x < 32 || x >= 224 ? qRgb(255, 220, 0) : qRgb(0, 0, 0));
    }
  }
  picture.save(QString::fromStdString(folder + "/ball.png"));
  dgtk::writeFile(folder + "/ball.mtl", "newmtl skin\nKd 1 1 1\nmap_Kd ball.png\n");
  std::ostringstream obj;
  obj << "mtllib ball.mtl\nusemtl skin\n";
  for (int i = 0; i <= down; ++i)
  {
    for (int j = 0; j <= around; ++j)
    {
      const double a = 2 * M_PI * j / around;
      const double b = M_PI * i / down;
      obj << "v " << std::sin(b) * std::sin(a) << ' ' << std::cos(b) << ' ' << std::sin(b) * std::cos(a) << "\nvt "
          << double(j) / around << ' ' << 1 - double(i) / down << '\n';
    }
  }
  for (int i = 0; i < down; ++i)
  {
    for (int j = 1; j <= around; ++j)
    {
      const int a = i * (around + 1) + j;
      const int b = a + around + 1;
      obj << "f " << a << '/' << a << ' ' << b << '/' << b << ' ' << b + 1 << '/' << b + 1 << ' ' << a + 1 << '/'
          << a + 1 << '\n';
    }
  }
  dgtk::writeFile(folder + "/ball.obj", obj.str());
}

/// The mean colour of a square about a point, in [0, 255].
Eigen::Vector3d meanAbout(const QImage& image, const Eigen::Vector2d& at, double side)
{
  Eigen::Vector3d sum(0, 0, 0);
  int count = 0;
  for (int y = int(std::lround(at.y() - side / 2)); y < std::lround(at.y() + side / 2); ++y)
  {
    for (int x = int(std::lround(at.x() - side / 2)); x < std::lround(at.x() + side / 2); ++x)
    {
      const QColor color = image.pixelColor(x, y);
      sum += Eigen::Vector3d(color.red(), color.green(), color.blue());
      ++count;
    }
  }
  return sum / std::max(count, 1);
}

/// Everything that is written on a widget and what is in it.
QStringList written(const QWidget& widget)
{
  QStringList all{ widget.windowTitle(), widget.toolTip() };
  for (const QAction* action : widget.findChildren<QAction*>())
  {
    all << action->text();
  }
  for (const QLabel* label : widget.findChildren<QLabel*>())
  {
    all << label->text();
  }
  for (const QAbstractButton* button : widget.findChildren<QAbstractButton*>())
  {
    all << button->text() << button->toolTip();
  }
  for (const QDockWidget* dock : widget.findChildren<QDockWidget*>())
  {
    all << dock->windowTitle();
  }
  return all;
}
} // namespace

QImage TestEditorLook::picture(const char* view) const
{
  auto* widget = this->Window->findChild<QOpenGLWidget*>(view);
  untilQuiet();
  return widget->grabFramebuffer();
}

void TestEditorLook::viewsHaveAllPixelsOfTheDisplay()
{
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  auto* view = this->Window->findChild<QOpenGLWidget*>("view.3");
  const QImage shown = this->picture("view.3");
  QCOMPARE(shown.size(), (QSizeF(view->size()) * view->devicePixelRatioF()).toSize());
  // Neighbours within a pixel of the window differ somewhere: nothing was enlarged.
  int different = 0;
  for (int y = 0; y + 1 < shown.height(); y += 2)
  {
    for (int x = 0; x + 1 < shown.width(); x += 2)
    {
      different += shown.pixel(x, y) != shown.pixel(x + 1, y) ? 1 : 0;
    }
  }
  QVERIFY2(different > shown.width(), qPrintable(QString::number(different)));
}

void TestEditorLook::aViewIsDrawnOnceForASize()
{
  int drawn = 0;
  vtkNew<vtkCallbackCommand> counter;
  counter->SetClientData(&drawn);
  counter->SetCallback([](vtkObject*, unsigned long, void* number, void*) { ++*static_cast<int*>(number); });
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  for (int place = 0; place < 4; ++place)
  {
    auto* view = this->Window->findChild<QVTKOpenGLNativeWidget*>("view." + QString::number(place));
    untilQuiet();
    drawn = 0;
    const QSize before = view->size();
    view->renderWindow()->AddObserver(vtkCommand::EndEvent, counter);
    this->Window->resize(this->Window->size() - QSize(40, 40));
    QTRY_VERIFY(view->size() != before);
    untilQuiet();
    view->renderWindow()->RemoveObserver(counter);
    QCOMPARE(drawn, 1);
  }
}

void TestEditorLook::clicksMeetWhatIsSeen()
{
  QVERIFY(this->Window->importFile(text("Data/Models/crate.ac")));
  dgtk::SceneDocument& document = this->Window->document();
  auto* view = this->Window->findChild<QOpenGLWidget*>("view.0");
  const double ratio = view->devicePixelRatioF();
  const auto clickIn = [&](int x)
  {
    QTest::mouseClick(view, Qt::LeftButton, {}, QPoint(3, 3));
    QTest::mouseClick(view, Qt::LeftButton, {}, QPoint(x, view->height() / 2));
    QCoreApplication::processEvents();
    const QLineEdit* const name = this->field("name");
    return name != nullptr && name->isVisible();
  };
  QTest::mouseClick(view, Qt::LeftButton, {}, QPoint(3, 3));
  const QImage with = this->picture("view.0");
  document.edit("hide", [](dgtk::SceneDescription& scene) { scene.objects[0].visible = false; });
  const QImage without = this->picture("view.0");
  document.undo();
  int first = -1;
  int last = -1;
  for (int x = 0; x < with.width(); ++x)
  {
    if (with.pixel(x, with.height() / 2) != without.pixel(x, with.height() / 2))
    {
      first = first < 0 ? x : first;
      last = x;
    }
  }
  QVERIFY(first > 0 && last > first + 20 * ratio && last + 1 < with.width());
  const int left = int(first / ratio);
  const int right = int((last + 1) / ratio);
  QVERIFY(clickIn(left + nearEdge));
  QVERIFY(!clickIn(left - nearEdge));
  QVERIFY(clickIn(right - nearEdge));
  QVERIFY(!clickIn(right + nearEdge));
}

void TestEditorLook::camerasAndLightsAreFramedAsTheyAreDrawn()
{
  // In a small scene and in a large one.
  for (const double size : { 1.0, 1000.0 })
  {
    QVERIFY(this->Window->importFile(text("Data/Models/crate.ac")));
    this->Window->document().edit("Place",
      [&](dgtk::SceneDescription& scene)
      {
        scene.objects[0].scale = Eigen::Vector3d(size, size, size);
        scene.cameras.resize(1);
        scene.cameras[0].name = "eye";
        scene.cameras[0].eye = Eigen::Vector3d(4 * size, 3 * size, 5 * size);
        scene.lights.resize(1);
        scene.lights[0].name = "lamp";
        scene.lights[0].position = Eigen::Vector3d(-4 * size, 3 * size, 2 * size);
      });
    for (const char* name : { "eye", "lamp" })
    {
      this->select(name);
      this->action("frameSelected")->trigger();
      untilQuiet();
      for (const char* view : { "view.0", "view.1", "view.2", "view.3" })
      {
        // The green lines about it are in sight as a whole, and large enough to be worked with.
        const QImage shown = this->Window->findChild<QWidget*>(view)->grab().toImage();
        QRect green;
        for (int y = 0; y < shown.height(); ++y)
        {
          for (int x = 0; x < shown.width(); ++x)
          {
            const QColor color = shown.pixelColor(x, y);
            green |= color.green() > 200 && color.red() < 110 && color.blue() < 110 ? QRect(x, y, 1, 1) : QRect();
          }
        }
        const double share = std::max(double(green.width()) / shown.width(), double(green.height()) / shown.height());
        QVERIFY2(share > leastFramed && share < 1,
          qPrintable(QString("%1, %2, size %3: %4").arg(name, view).arg(size).arg(share)));
      }
    }
    answer<QMessageBox>("unsavedBox", [](QMessageBox& box) { box.button(QMessageBox::Discard)->click(); });
    this->action("new")->trigger();
  }
}

void TestEditorLook::theUpAxisTurnsTheViews()
{
  const char* const views[] = { "view.0", "view.1", "view.2", "view.3" };
  const auto pictures = [&]
  {
    QList<QImage> all;
    for (const char* view : views)
    {
      all << this->picture(view);
    }
    return all;
  };
  QVERIFY(this->Window->importFile(text("Data/Models/tree.ac")));
  this->action("frameAll")->trigger();
  QTest::mouseClick(this->Window->findChild<QWidget*>("view.0"), Qt::LeftButton, {}, QPoint(3, 3)); // selects nothing
  untilQuiet();
  const QList<QImage> yUp = pictures();
  auto* axis = this->Window->findChild<QComboBox*>("upAxis");
  QVERIFY(axis != nullptr);
  axis->setFocus();
  QTest::keyClick(axis, Qt::Key_Down);
  QVERIFY(this->Window->document().scene().upAxis == dgtk::UpAxis::Z);
  const QList<QImage> zUp = pictures();
  this->action("undo")->trigger();
  const QList<QImage> undone = pictures();
  this->action("redo")->trigger();
  // As if the scene had always been so.
  const QString path = this->path("zUp.json");
  this->Window->document().saveAs(path.toStdString());
  const QSize size = this->Window->size();
  this->Window = std::make_unique<dgtk::MainWindow>();
  this->Window->resize(size);
  this->Window->show();
  QVERIFY(this->Window->openFile(path));
  this->action("frameAll")->trigger();
  untilQuiet();
  const QList<QImage> opened = pictures();
  for (int i = 0; i < yUp.size(); ++i)
  {
    QVERIFY2(zUp[i] != yUp[i], views[i]);
    QVERIFY2(undone[i] == yUp[i], views[i]);
    QVERIFY2(zUp[i] == opened[i], views[i]);
  }
}

void TestEditorLook::smallModelsKeepTheirTexturesSeams()
{
  writeBall(this->Folder.path("."));
  QVERIFY(this->Window->importFile(this->path("ball.obj")));
  this->action("frameSelected")->trigger();
  auto* view = this->Window->findChild<QOpenGLWidget*>("view.0");
  const double ratio = view->devicePixelRatioF();
  const QImage whole = this->picture("view.0");
  const auto isYellow = [](const QColor& color) { return color.red() > 100 && color.blue() < 60; };
  int yellow = 0; // across the middle: the ball's diameter times the sine of an eighth of a turn
  for (int x = 0; x < whole.width(); ++x)
  {
    yellow += isYellow(whole.pixelColor(x, whole.height() / 2)) ? 1 : 0;
  }
  const double diameter = yellow / std::sqrt(0.5) / ratio;
  QVERIFY2(diameter > 100, qPrintable(QString::number(diameter)));
  int steps = 0;
  for (const double wanted : { 28.0, 12.0 }) // pixels: fewer triangles, and still fewer
  {
    for (; diameter * std::exp(-zoomPerStep * steps) > wanted; ++steps)
    {
      QTest::keyClick(view, Qt::Key_Minus);
    }
    const double shrunk = std::exp(-zoomPerStep * steps);
    const QImage small = this->picture("view.0");
    const Eigen::Vector2d middle(small.width() / 2.0, small.height() / 2.0);
    const int reach = int(0.3 * ratio * diameter * shrunk / 2);
    QVERIFY(reach > 0);
    double sum = 0;
    int count = 0;
    for (int y = -2 * reach; y < 2 * reach; ++y)
    {
      for (int x = -reach; x < reach; ++x)
      {
        const Eigen::Vector2d way(x + 0.5, y + 0.5);
        const Eigen::Vector3d is = meanAbout(small, middle + way, 1);
        sum += (is - meanAbout(whole, middle + way / shrunk, 1 / shrunk)).cwiseAbs().maxCoeff();
        ++count;
      }
    }
    qInfo("a ball of %.0f pixels: %.1f of 255 from all its triangles", diameter * shrunk, sum / count);
    QVERIFY(sum / count < seamTolerance);
  }
}

void TestEditorLook::germanIsShownEverywhere()
{
  if (qApp->devicePixelRatio() > 1)
  {
    QSKIP("words are the same on all displays");
  }
  QVERIFY(dgtk::setEditorLanguage("de"));
  this->Window = std::make_unique<dgtk::MainWindow>();
  this->Window->show();
  QVERIFY(this->Window->openFile(this->copyOfDemo()));
  this->select("house");
  this->action("duplicate")->trigger();
  QStringList all = written(*this->Window);
  for (const char* name : { "camera", "cameraArray", "light" })
  {
    answer<QDialog>({},
      [&](QDialog& dialog)
      {
        all << written(dialog);
        dialog.reject();
      });
    this->action(name)->trigger();
  }
  this->action("render")->trigger();
  all << written(*this->Window->findChild<QDialog*>("renderDialog"));
  QCOMPARE(this->action("open")->text(), QString::fromUtf8("\u00d6&ffnen ..."));
  QCOMPARE(this->action("undo")->text(), QString::fromUtf8("&R\u00fcckg\u00e4ngig: Duplizieren"));
  const QMap<QString, QString> german = germanOfEnglish();
  QVERIFY(german.size() > 200);
  const std::set<QString> words(german.begin(), german.end());
  for (const QString& one : all)
  {
    // A word of the scene itself may be an English one; none is in the demo scene.
    QVERIFY2(!german.contains(one) || german[one] == one || words.count(one) != 0, qPrintable(one));
  }
  this->Window.reset();
  for (QTranslator* translator : qApp->findChildren<QTranslator*>())
  {
    delete translator;
  }
}

void TestEditorLook::languagesAreNamed()
{
  if (qApp->devicePixelRatio() > 1)
  {
    QSKIP("words are the same on all displays");
  }
  QVERIFY(dgtk::editorLanguages().contains("de"));
  QVERIFY(!dgtk::setEditorLanguage("tlh"));
  QProcess editor;
  const QString program = QCoreApplication::applicationDirPath() + "/dgtk-editor";
  editor.start(program, { "--language", "tlh" });
  QVERIFY(editor.waitForFinished(longestRun));
  QCOMPARE(editor.exitCode(), 2);
  QVERIFY(editor.readAllStandardError().trimmed().endsWith(
    "dgtk-editor: --language: expected one of en, de, found 'tlh' (see dgtk-editor --help)"));
  editor.start(program, { "--languaje" });
  QVERIFY(editor.waitForFinished(longestRun));
  QCOMPARE(editor.exitCode(), 2);
}

void TestEditorLook::pictures()
{
  const QString folder = QString::fromLocal8Bit(qgetenv("DGTK_EDITOR_PICTURES"));
  if (folder.isEmpty())
  {
    return; // made by Documentation/Images/make_editor.py
  }
  dgtk::setEditorLanguage("de");
  this->Window = std::make_unique<dgtk::MainWindow>();
  this->Window->show();
  this->Window->resize(1280, 860);
  QVERIFY(this->Window->openFile(demo()));
  this->select("creature");
  QTest::qWait(3 * settle);
  QVERIFY(this->Window->findChild<QWidget*>("propertiesPanel")->grab().save(folder + "/editor_german.png"));
}

DGTK_EDITOR_TEST(TestEditorLook);
