// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMainWindow.h"

#include "dgtkBackgroundWork.h"
#include "dgtkEditorLanguage.h"
#include "dgtkEditorLog.h"
#include "dgtkEditorState.h"
#include "dgtkMatchDialog.h"
#include "dgtkNamedAction.h"
#include "dgtkRenderStatus.h"
#include "dgtkSceneClipboard.h"
#include "dgtkSceneFiles.h"
#include "dgtkSceneViews.h"
#include "dgtkUsualFolder.h"
#include "dgtkWindowSize.h"

#include <QAction>
#include <QCloseEvent>
#include <QCoreApplication>
#include <QDockWidget>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFileInfo>
#include <QMenu>
#include <QMessageBox>
#include <QSettings>
#include <QStatusBar>
#include <QSurfaceFormat>
#include <QTimer>
#include <QToolBar>

#include <clocale>

namespace dgtk
{

namespace
{
/// Actions whose check marks are kept.
constexpr const char* keptActions[] = { "wireframe", "shaded", "textured", "sceneLights", "grid", "handlesAtOrigin" };
constexpr int statusTime = 5000; // milliseconds

bool isBehindTab(const QWidget* widget)
{
  while (widget != nullptr && qobject_cast<const QDockWidget*>(widget) == nullptr)
  {
    widget = widget->parentWidget();
  }
  return widget != nullptr && widget->visibleRegion().isEmpty();
}
} // namespace

void MainWindow::prepareApplication()
{
  QSurfaceFormat format = QVTKOpenGLNativeWidget::defaultFormat();
  format.setSamples(0);
  QSurfaceFormat::setDefaultFormat(format);
  QCoreApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
  QCoreApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
  QCoreApplication::setAttribute(Qt::AA_ShareOpenGLContexts);
}

void MainWindow::setupApplication()
{
  QCoreApplication::setOrganizationName("DGTk");
  QCoreApplication::setApplicationName("Editor");
  std::setlocale(LC_NUMERIC, "C");
}

MainWindow::MainWindow(QWidget* parent)
  : QMainWindow(parent)
  , State(new EditorState(this))
  , Copied(new SceneClipboard(*this->State, this))
{
  this->setObjectName("mainWindow");
  this->setAcceptDrops(true);
  this->Work = new BackgroundWork(this->statusBar(), this);
  this->Run = new RenderStatus(this->statusBar());
  this->setDockOptions(QMainWindow::AnimatedDocks | QMainWindow::AllowNestedDocks | QMainWindow::AllowTabbedDocks);
  this->Views = new SceneViews(*this->State, this);
  this->setCentralWidget(this->Views);
  auto* tools = this->addToolBar(tr("Tools"));
  tools->setObjectName("toolBar");
  tools->setIconSize({ 20, 20 });
  this->Log = new EditorLog(this);
  this->makeDocks();
  this->makeFileMenu();
  this->makeEditMenu();
  this->makeViewMenu();
  this->makeToolsMenu();
  this->makeHelpMenu();
  connect(this->State, &EditorState::changed, this, &MainWindow::refresh);
  connect(this->State, &EditorState::changed, this, [this] { this->Log->noteNewWarnings(this->document()); });
  connect(this->Log, &EditorLog::noted, this,
    [this](const QString& line) { this->statusBar()->showMessage(line, statusTime); });
  connect(this->State, &EditorState::selectionChanged, this, &MainWindow::refresh);
  connect(this->Copied, &SceneClipboard::changed, this, &MainWindow::refreshItemActions);
  connect(this->Copied, &SceneClipboard::told, this,
    [this](const QString& text) { this->statusBar()->showMessage(text, statusTime); });
  connect(this->State, &EditorState::failed, this, &MainWindow::fail);
  connect(this->Work, &BackgroundWork::busyChanged, this, &MainWindow::allowFiles);
  connect(this->Views, &SceneViews::failed, this, &MainWindow::note);
  connect(this->Views, &SceneViews::told, this,
    [this](const QString& text) { this->statusBar()->showMessage(text, statusTime); });
  connect(this->Views, &SceneViews::menuAsked, this, &MainWindow::showContextMenu);
  this->Views->view(ViewKind::Perspective)->setFocus();
  resizeWithin(*this, 1280, 860);
  this->restoreSettings();
  this->refresh();
  this->statusBar()->showMessage(tr("File > Open opens a scene, File > Import adds a model"));
}

MainWindow::~MainWindow() = default;

SceneDocument& MainWindow::document() { return this->State->document(); }

void MainWindow::refresh()
{
  SceneDocument& document = this->State->document();
  const QString path = toText(document.path());
  this->setWindowTitle(tr("%1[*] - DGTk").arg(path.isEmpty() ? tr("Untitled") : QFileInfo(path).fileName()));
  this->setWindowFilePath(path);
  this->setWindowModified(document.modified());
  this->refreshItemActions();
  QAction* const undo = this->findChild<QAction*>("undo");
  QAction* const redo = this->findChild<QAction*>("redo");
  this->findChild<QAction*>("findModels")->setEnabled(!document.absent().empty());
  undo->setEnabled(document.canUndo());
  redo->setEnabled(document.canRedo());
  undo->setText(document.canUndo() ? tr("&Undo %1").arg(menuText(editText(document.undoText()))) : tr("&Undo"));
  redo->setText(document.canRedo() ? tr("&Redo %1").arg(menuText(editText(document.redoText()))) : tr("&Redo"));
}

void MainWindow::note(const QString& line) { this->Log->note(line); }

void MainWindow::noteReplacedModels()
{
  for (const std::string& file : this->State->document().takeReplacedModels())
  {
    this->note(tr("Warning: %1 has changed since it was read here. Open the scene again to see it as it is rendered.")
                 .arg(toText(file)));
  }
}

void MainWindow::fail(const QString& message)
{
  this->note(message);
  QMessageBox box(QMessageBox::Warning, tr("DGTk"), message, QMessageBox::Ok, this);
  box.setTextFormat(Qt::PlainText);
  box.setObjectName("errorBox");
  box.exec();
}

void MainWindow::saveSettings() const
{
  QSettings settings;
  settings.setValue("geometry", this->saveGeometry());
  settings.setValue("state", this->saveState());
  this->Views->saveLayout(settings);
  for (const char* name : keptActions)
  {
    settings.setValue(QString("views/") + name, this->findChild<QAction*>(name)->isChecked());
  }
}

void MainWindow::restoreSettings()
{
  const QSettings settings;
  this->restoreGeometry(settings.value("geometry").toByteArray());
  this->restoreState(settings.value("state").toByteArray());
  this->Views->restoreLayout(settings);
  for (const char* name : keptActions)
  {
    auto* const action = this->findChild<QAction*>(name);
    const bool wanted = settings.value(QString("views/") + name, action->isChecked()).toBool();
    // Of a group only the one that is checked; that takes the others' marks.
    if (wanted != action->isChecked() && (wanted || action->actionGroup() == nullptr))
    {
      action->trigger();
    }
  }
}

bool MainWindow::openFile(const QString& path) { return this->Files->openFile(path); }
bool MainWindow::importFile(const QString& path) { return this->Files->importFile(path); }
bool MainWindow::saveFile(const QString& path) { return this->Files->saveFile(path); }
void MainWindow::offerRecovery() { this->Files->offerRecovery(); }

void MainWindow::allowFiles(bool busy)
{
  for (const char* name : { "new", "open", "import", "exportPov" })
  {
    this->findChild<QAction*>(name)->setEnabled(!busy);
  }
  this->Recent->setEnabled(!busy && !this->Recent->isEmpty());
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event)
{
  if (!localFiles(*event->mimeData()).isEmpty())
  {
    event->acceptProposedAction();
  }
}

void MainWindow::dropEvent(QDropEvent* event)
{
  const QStringList paths = localFiles(*event->mimeData());
  event->acceptProposedAction();
  for (const QString& address : foreignAddresses(*event->mimeData()))
  {
    this->note(tr("%1 is not opened: it is no file of this machine").arg(address));
  }
  // The program that they come from does not wait for them to be read.
  QTimer::singleShot(0, this,
    [this, paths]
    {
      for (const QString& path : paths)
      {
        this->openFile(path);
      }
    });
}

bool MainWindow::focusNextPrevChild(bool next)
{
  const QWidget* const before = this->focusWidget();
  bool moved = QMainWindow::focusNextPrevChild(next);
  while (moved && this->focusWidget() != before && isBehindTab(this->focusWidget()))
  {
    moved = QMainWindow::focusNextPrevChild(next);
  }
  return moved;
}

void MainWindow::closeEvent(QCloseEvent* event)
{
  if (!this->Files->mayDiscard() || !this->mayLeaveRun())
  {
    event->ignore();
    return;
  }
  this->Work->cancel();
  this->saveSettings();
  event->accept();
  emit this->closed();
}

} // namespace dgtk
