// SPDX-License-Identifier: BSD-3-Clause
#include "TestEditorSupport.h"
#include "TestEditorViewer.h"

#include "dgtkDatasetViewer.h"

#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QMainWindow>
#include <QMenu>
#include <QMenuBar>
#include <QProcess>
#include <QRegularExpression>
#include <QTableWidget>
#include <QWheelEvent>

#include <random>

// What the cases share, and random events.

namespace
{
constexpr int usualViewerEvents = 600;

/// An action by chance that opens no other window.
void triggerOne(QMainWindow* viewer, std::mt19937& random)
{
  const QList<QAction*> menus = viewer->menuBar()->actions();
  const QList<QAction*> actions = menus[int(random() % unsigned(menus.size()))]->menu()->actions();
  QAction* const action = actions[int(random() % unsigned(actions.size()))];
  const QStringList asking{ "open", "save", "close", "exit", "mouse" };
  if (!action->isSeparator() && !asking.contains(action->objectName()))
  {
    action->trigger();
  }
}

/// A press, a motion and a release, or the wheel.
void useMouse(QWidget* widget, std::mt19937& random)
{
  const auto place = [&]
  { return QPoint(int(random() % unsigned(widget->width())), int(random() % unsigned(widget->height()))); };
  const Qt::MouseButton buttons[] = { Qt::LeftButton, Qt::MiddleButton, Qt::RightButton };
  const Qt::MouseButton button = buttons[random() % 3];
  QTest::mousePress(widget, button, {}, place());
  moveMouse(widget, place(), button);
  moveMouse(widget, place(), button);
  QTest::mouseRelease(widget, button, {}, place());
  const QPoint at = place();
  QWheelEvent event(at, widget->mapToGlobal(at), {}, { 0, random() % 2 ? 120 : -120 }, Qt::NoButton, Qt::NoModifier,
    Qt::NoScrollPhase, false);
  QCoreApplication::sendEvent(widget, &event);
}
} // namespace

void TestEditorViewer::randomEventsDoNoHarm()
{
  QMainWindow* const viewer = this->open(this->dataset());
  QVERIFY(viewer != nullptr);
  const int asked = qEnvironmentVariableIntValue("DGTK_MONKEY_EVENTS");
  std::mt19937 random(1);
  for (int i = 0; i < (asked > 0 ? asked : usualViewerEvents); ++i)
  {
    const QList<QWidget*> all = viewer->findChildren<QWidget*>();
    QWidget* const widget = all[int(random() % unsigned(all.size()))];
    const bool pointed = widget->objectName().startsWith("picture.") || widget->objectName() == "cloudView";
    const Qt::Key keys[] = { Qt::Key_Up, Qt::Key_Down, Qt::Key_Left, Qt::Key_Right, Qt::Key_Tab, Qt::Key_PageUp };
    if (pointed && widget->isVisible())
    {
      useMouse(widget, random);
    }
    else if (random() % 4 == 0)
    {
      triggerOne(viewer, random);
    }
    else if (widget->isVisible() && widget->focusPolicy() != Qt::NoFocus)
    {
      QTest::keyClick(widget, keys[random() % 6]);
    }
    if (random() % 8 == 0)
    {
      this->Window->findChild<QAction*>("frameAll")->trigger();
      QCoreApplication::processEvents();
    }
  }
  viewer->findChild<QAction*>("play")->setChecked(false);
  QTest::keyClick(viewer, Qt::Key_4, Qt::ControlModifier);
  this->waitForPictures(viewer);
  QVERIFY(viewer->isVisible());
}

QPoint pixelOf(const QMainWindow* viewer)
{
  const QRegularExpression numbers("\\((\\d+), (\\d+)\\)");
  const auto match = numbers.match(viewer->findChild<QLabel*>("pixel")->text());
  return match.hasMatch() ? QPoint(match.captured(1).toInt(), match.captured(2).toInt()) : QPoint(-1, -1);
}

QString TestEditorViewer::scene() const
{
  return this->partOfDemo("scene.json", { "terrain", "house", "windmill", "tree", "vase", "ball" });
}

QString TestEditorViewer::dataset()
{
  if (this->Rendered.isEmpty())
  {
    const QString folder = this->path("dataset");
    const QStringList words{ "render", this->scene(), "-o", folder, "--layers",
      "color,depth,objects,normal,position,distance,flow_forward,ldi,correspondence", "--size", "64x48", "--quiet" };
    const int status = QProcess::execute(QString::fromLocal8Bit(qgetenv("DGTK")), words);
    this->Rendered = status == 0 ? folder : QString();
  }
  return this->Rendered;
}

TestEditorViewer::TestEditorViewer() = default;
TestEditorViewer::~TestEditorViewer() = default;

bool TestEditorViewer::hasWindow(const QString& testCase) const
{
  const QStringList besideAnEditor{ "opensByFolderManifestAndDrop", "brokenDatasetsAreRefused",
    "theRenderDialogOpensItsResult", "theViewerOpensWhereItWas", "theProgramEndsWithItsDatasets",
    "randomEventsDoNoHarm" };
  return besideAnEditor.contains(testCase);
}

void TestEditorViewer::cleanup()
{
  this->Alone.reset();
  EditorTest::cleanup();
}

QMainWindow* TestEditorViewer::open(const QString& folder)
{
  if (this->Window != nullptr)
  {
    this->Window->openFile(folder);
  }
  else
  {
    this->Alone = std::make_unique<dgtk::DatasetViewer>();
    this->Alone->show();
    this->Alone->openFolder(folder);
  }
  return this->viewer();
}

QMainWindow* TestEditorViewer::viewer() const
{
  QMainWindow* viewer = nullptr;
  for (QWidget* window : QApplication::topLevelWidgets())
  {
    viewer =
      window->objectName() == "datasetViewer" && window->isVisible() ? qobject_cast<QMainWindow*>(window) : viewer;
  }
  if (viewer != nullptr)
  {
    activate(*viewer);
    this->waitForPictures(viewer);
  }
  return viewer;
}

void TestEditorViewer::waitForPictures(QMainWindow* viewer) const
{
  QTRY_VERIFY(viewer->property("busy").isValid() && !viewer->property("busy").toBool());
}

QWidget* TestEditorViewer::picture(QMainWindow* viewer, int pane) const
{
  return viewer->findChild<QWidget*>(QString("picture.%1").arg(pane));
}

QString TestEditorViewer::cell(QMainWindow* viewer, int row, int column) const
{
  const QTableWidgetItem* const item = viewer->findChild<QTableWidget*>("readOut")->item(row, column);
  return item == nullptr ? QString() : item->text();
}

void TestEditorViewer::choose(QMainWindow* viewer, int pane, const QString& camera, const QString& layer) const
{
  auto* const frame = viewer->findChild<QWidget*>(QString("pane.%1").arg(pane));
  frame->findChild<QComboBox*>("camera")->setCurrentText(camera);
  frame->findChild<QComboBox*>("layer")->setCurrentText(layer);
  this->waitForPictures(viewer);
}

void TestEditorViewer::pointAt(QMainWindow* viewer, int x, int y) const
{
  QWidget* const view = this->picture(viewer, 0);
  view->setFocus();
  QTest::keyClick(view, Qt::Key_Right);
  const QPoint from = pixelOf(viewer);
  for (int i = 0; i < std::abs(x - from.x()); ++i)
  {
    QTest::keyClick(view, x < from.x() ? Qt::Key_Left : Qt::Key_Right);
  }
  for (int i = 0; i < std::abs(y - from.y()); ++i)
  {
    QTest::keyClick(view, y < from.y() ? Qt::Key_Up : Qt::Key_Down);
  }
  QCOMPARE(pixelOf(viewer), QPoint(x, y));
}
