// SPDX-License-Identifier: BSD-3-Clause
#include "EditorTest.h"
#include "TestEditorSupport.h"

#include "dgtkMainWindow.h"
#include "dgtkModelCache.h"
#include "dgtkSceneDescription.h"
#include "dgtkSystem.h"

#include <QAbstractEventDispatcher>
#include <QAction>
#include <QApplication>
#include <QCheckBox>
#include <QDialog>
#include <QElapsedTimer>
#include <QFile>
#include <QFileDialog>
#include <QLineEdit>
#include <QMenu>
#include <QMenuBar>
#include <QProcess>
#include <QPushButton>
#include <QSettings>
#include <QSpinBox>
#include <QStandardPaths>
#include <QTabBar>
#include <QTabWidget>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>
#include <QTreeWidget>
#include <QWindow>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <sys/file.h>

double patience()
{
  constexpr double atLeast = 5;
  constexpr double aim = 0.015; // seconds
  std::vector<unsigned int> numbers(std::size_t(1) << 18);
  std::generate(numbers.begin(), numbers.end(), std::mt19937());
  QElapsedTimer clock;
  clock.start();
  std::sort(numbers.begin(), numbers.end());
  return atLeast * std::max(1.0, double(clock.nsecsElapsed()) * 1e-9 / aim);
}

void activate(QWidget& window)
{
  constexpr int step = 20;
  constexpr int again = 500;
  QVERIFY(QTest::qWaitForWindowExposed(&window, longestRun));
  for (int waited = 0; waited < longestRun && !window.isActiveWindow(); waited += step)
  {
    if (window.windowHandle()->isActive())
    {
      QApplication::setActiveWindow(&window); // the focus came while a menu was open
    }
    else if (waited % again == 0)
    {
      window.activateWindow();
    }
    QTest::qWait(step);
  }
  QVERIFY2(window.isActiveWindow(), qPrintable("no focus: " + window.objectName()));
}

void browseFor(QPushButton* button, const QLineEdit* line, const QString& folder)
{
  const QString before = line->text();
  const auto chosen = [button](const QString& name)
  {
    QString begin;
    answer<QFileDialog>({},
      [&](QFileDialog& dialog)
      {
        begin = dialog.directory().absolutePath();
        dialog.findChild<QLineEdit*>("fileNameEdit")->setText(name);
        QMetaObject::invokeMethod(&dialog, name.isEmpty() ? "reject" : "accept");
      });
    QTest::mouseClick(button, Qt::LeftButton);
    return begin;
  };
  QVERIFY(QDir().mkpath(folder));
  chosen({});
  QCOMPARE(line->text(), before);
  chosen(folder);
  QCOMPARE(line->text(), folder);
  QCOMPARE(chosen({}), folder);
}

void untilQuiet()
{
  constexpr int quiet = 25; // milliseconds; Qt draws a window at most some 5 after it was asked to
  QElapsedTimer clock;
  clock.start();
  QElapsedTimer still;
  still.start();
  while (still.elapsed() < quiet && clock.elapsed() < longestRun)
  {
    QGuiApplication::sync(); // what the X server has to say is there
    QCoreApplication::sendPostedEvents(nullptr, QEvent::DeferredDelete);
    if (QAbstractEventDispatcher::instance()->processEvents(QEventLoop::AllEvents))
    {
      still.start();
    }
    else
    {
      QTest::qSleep(1);
    }
  }
}

/// Whether the X server has given the keyboard to the open menu: it does so a moment after the menu is shown, and
/// before any click of a user. After a test's click, which is there at once, that word would take the focus from what
/// was chosen, and a name that is being edited would be left.
static bool hasFocus(const QMenu& menu)
{
  return menu.isVisible() && QGuiApplication::focusWindow() == menu.windowHandle();
}

EditorTest::EditorTest() = default;
EditorTest::~EditorTest() = default;

QList<pid_t> livingRuns()
{
  QList<pid_t> living;
  const QString data = QStandardPaths::writableLocation(QStandardPaths::AppDataLocation);
  for (QDirIterator at(data, { "run.log" }, QDir::Files, QDirIterator::Subdirectories); at.hasNext();)
  {
    QFile log(at.next());
    if (log.open(QIODevice::ReadOnly) && ::flock(log.handle(), LOCK_SH | LOCK_NB) != 0)
    {
      log.readLine(); // what was asked
      living << log.readLine().trimmed().toInt();
    }
  }
  return living;
}

void EditorTest::initTestCase()
{
  // Shaders that Mesa compiled stay where they are for all programs; other than that, programs that run at the same
  // time do not meet there.
  const QString caches = QStandardPaths::writableLocation(QStandardPaths::GenericCacheLocation);
  if (!qEnvironmentVariableIsSet("MESA_SHADER_CACHE_DIR"))
  {
    qputenv("MESA_SHADER_CACHE_DIR", caches.toLocal8Bit());
  }
  qputenv("XDG_DATA_HOME", QByteArray::fromStdString(this->Folder.path("data")));
  qputenv("XDG_CACHE_HOME", QByteArray::fromStdString(this->Folder.path("cache")));
  dgtk::ModelCache::use(dgtk::ModelCache::ofUser()); // as the program does
  QSettings::setPath(
    QSettings::NativeFormat, QSettings::UserScope, QString::fromStdString(this->Folder.path("settings")));
}

void EditorTest::init()
{
  QSettings().clear();
  const QString function = QTest::currentTestFunction();
  const bool makesNone = function == "pictures" && !qEnvironmentVariableIsSet("DGTK_EDITOR_PICTURES");
  if (makesNone || !this->hasWindow(function))
  {
    return;
  }
  this->Window = std::make_unique<dgtk::MainWindow>();
  if (function != "pictures") // which are the editor's as it opens
  {
    this->Window->resize(this->windowSize(function));
  }
  this->Window->show();
  activate(*this->Window);
  untilQuiet();
}

void EditorTest::cleanup()
{
  this->Window.reset();
  for (const pid_t run : livingRuns())
  {
    ::kill(-run, SIGKILL);
  }
  QTRY_VERIFY(livingRuns().isEmpty());
}

QAction* EditorTest::action(const char* name) const { return this->Window->findChild<QAction*>(name); }

QLineEdit* EditorTest::field(const char* name) const
{
  auto* panel = this->Window->findChild<QWidget*>("propertiesPanel");
  // A panel that has just been replaced waits to be deleted.
  const QList<QLineEdit*> all = panel->findChildren<QLineEdit*>(name);
  return all.isEmpty() ? nullptr : all.last();
}

void EditorTest::typeOnly(const char* name, const QString& text) const
{
  QLineEdit* const at = this->field(name);
  QVERIFY2(at != nullptr, name);
  activate(*at->window());
  at->setFocus();
  at->selectAll();
  QTest::keyClicks(at, text);
}

void EditorTest::type(const char* name, const QString& text) const
{
  this->typeOnly(name, text);
  QTest::keyClick(this->field(name), Qt::Key_Return);
}

void EditorTest::select(const char* name) const
{
  auto* tree = this->Window->findChild<QTreeWidget*>("sceneTree");
  const QList<QTreeWidgetItem*> rows = tree->findItems(name, Qt::MatchExactly | Qt::MatchRecursive);
  QCOMPARE(rows.size(), 1);
  tree->scrollToItem(rows[0]);
  QTest::mouseClick(tree->viewport(), Qt::LeftButton, {}, tree->visualItemRect(rows[0]).center());
  QCoreApplication::processEvents();
}

QString EditorTest::path(const char* name) const { return QString::fromStdString(this->Folder.path(name)); }

QString EditorTest::partOfDemo(const char* name, const QStringList& objects) const
{
  dgtk::SceneDescription scene = dgtk::readScene(demo().toStdString());
  const auto isOther = [&](const dgtk::ObjectDescription& one)
  { return !objects.contains(QString::fromStdString(one.name)); };
  scene.objects.erase(std::remove_if(scene.objects.begin(), scene.objects.end(), isOther), scene.objects.end());
  dgtk::writeScene(scene, this->Folder.path(name));
  return this->path(name);
}

QString EditorTest::copyOfDemo() const
{
  return this->partOfDemo("demo.json", { "terrain", "house", "tree", "vase", "ball" });
}

void EditorTest::choose(const char* name) const
{
  QAction* const item = this->action(name);
  QVERIFY2(item != nullptr && item->isEnabled(), name);
  QMenuBar* const bar = this->Window->menuBar();
  for (QAction* top : bar->actions())
  {
    if (top->menu() != nullptr && top->menu()->actions().contains(item))
    {
      QTest::mouseClick(bar, Qt::LeftButton, {}, bar->actionGeometry(top).center());
      QTRY_VERIFY(hasFocus(*top->menu()));
      QTest::mouseClick(top->menu(), Qt::LeftButton, {}, top->menu()->actionGeometry(item).center());
      QTRY_VERIFY(!top->menu()->isVisible());
      return;
    }
  }
  QFAIL(name);
}

void EditorTest::chooseInMenu(const QString& item, const std::function<void()>& open)
{
  constexpr int step = 20;
  bool found = false;
  int waited = 0;
  QTimer clicker;
  connect(&clicker, &QTimer::timeout,
    [&]
    {
      auto* const menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
      waited += step;
      if (menu == nullptr || (!hasFocus(*menu) && waited < longestRun))
      {
        return;
      }
      for (QAction* action : menu->actions())
      {
        if (action->objectName() == item && action->isEnabled() && waited < longestRun)
        {
          found = true;
          QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(action).center());
          return;
        }
      }
      menu->close(); // the test says what was not found, and goes on
    });
  clicker.start(step);
  open();
  QVERIFY2(found, qPrintable(item));
  QCoreApplication::processEvents();
}

void EditorTest::typeInto(QWidget* field, const QString& text)
{
  activate(*field->window());
  QTest::mouseClick(field, Qt::LeftButton, {}, QPoint(6, field->height() / 2));
  QTest::keyClick(field, Qt::Key_A, Qt::ControlModifier);
  QTest::keyClicks(field, text);
  QTest::keyClick(field, Qt::Key_Tab);
}

void EditorTest::turnTo(const QDialog& dialog, int page)
{
  auto* tabs = dialog.findChild<QTabWidget*>();
  QTest::mouseClick(tabs->tabBar(), Qt::LeftButton, {}, tabs->tabBar()->tabRect(page).center());
  QCOMPARE(tabs->currentIndex(), page);
}

void EditorTest::check(QCheckBox* box, bool on)
{
  if (box->isChecked() != on)
  {
    QTest::mouseClick(box, Qt::LeftButton, {}, QPoint(8, box->height() / 2));
  }
  QVERIFY2(box->isChecked() == on, qPrintable(box->text()));
}

void EditorTest::renderAndCompare(const QString& scene, const QStringList& layers, int width, int height) const
{
  const QString inWindow = scene + ".window";
  const QString inLine = scene + ".line";
  this->choose("render");
  auto* dialog = this->Window->findChild<QDialog*>("renderDialog");
  QVERIFY(dialog != nullptr);
  activate(*dialog);
  turnTo(*dialog, 2);
  for (QCheckBox* box : dialog->findChildren<QCheckBox*>())
  {
    if (box->objectName().startsWith("layer."))
    {
      check(box, layers.contains(box->text()));
    }
  }
  turnTo(*dialog, 1);
  check(dialog->findChild<QCheckBox*>("ownSize"), false);
  typeInto(dialog->findChild<QSpinBox*>("width"), QString::number(width));
  typeInto(dialog->findChild<QSpinBox*>("height"), QString::number(height));
  typeInto(dialog->findChild<QLineEdit*>("folder"), inWindow);
  auto* start = dialog->findChild<QPushButton*>("start");
  QTest::mouseClick(start, Qt::LeftButton);
  QTRY_VERIFY(start->isEnabled() && QFile::exists(inWindow + "/manifest.json")); // small runs may be over at once
  dialog->close();

  const QString program = QString::fromLocal8Bit(qgetenv("DGTK"));
  const QStringList words{ "render", scene, "-o", inLine, "--layers", layers.join(','), "--size",
    QString("%1x%2").arg(width).arg(height), "--quiet" };
  QCOMPARE(QProcess::execute(program, words), 0);
  const QMap<QString, QByteArray> window = contents(inWindow);
  const QMap<QString, QByteArray> line = contents(inLine);
  QVERIFY2(window.keys() == line.keys(),
    qPrintable("window: " + QStringList(window.keys()).join(' ') + "; line: " + QStringList(line.keys()).join(' ')));
  QVERIFY(window.size() > 5);
  for (const QString& name : line.keys())
  {
    QVERIFY2(window[name] == line[name], qPrintable(name));
  }
}

static std::map<std::string, int (*)(int, char**)>& rows()
{
  static std::map<std::string, int (*)(int, char**)> all;
  return all;
}

EditorTestRow::EditorTestRow(const char* word, int (*run)(int, char**)) { rows()[word] = run; }

int main(int argc, char** argv)
{
  const auto row = argc > 1 ? rows().find(argv[1]) : rows().end();
  if (row == rows().end())
  {
    std::fputs("The first argument is one of:", stderr);
    for (const auto& [word, run] : rows())
    {
      std::fprintf(stderr, " %s", word.c_str());
    }
    std::fputs("\n", stderr);
    return 2;
  }
  argv[1] = argv[0];
  const QTemporaryDir own; // file dialogs show what lies beside: nothing of others
  qputenv("TMPDIR", QFile::encodeName(own.path()));
  dgtk::prepareHeap(); // as dgtk-editor does
  return row->second(argc - 1, argv + 1);
}
