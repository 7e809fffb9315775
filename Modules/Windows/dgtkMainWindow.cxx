// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMainWindow.h"

#include "dgtkAutosave.h"
#include "dgtkBackgroundWork.h"
#include "dgtkEditorLanguage.h"
#include "dgtkEditorState.h"
#include "dgtkMatchDialog.h"
#include "dgtkNamedAction.h"
#include "dgtkRenderStatus.h"
#include "dgtkSceneViews.h"
#include "dgtkWindowSize.h"

#include <QAction>
#include <QCloseEvent>
#include <QCoreApplication>
#include <QFileInfo>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QSettings>
#include <QStatusBar>
#include <QSurfaceFormat>
#include <QToolBar>

#include <clocale>

namespace dgtk
{

namespace
{
/// Actions whose check marks are kept.
constexpr const char* keptActions[] = { "wireframe", "shaded", "textured", "sceneLights", "grid", "handlesAtOrigin" };
constexpr int statusTime = 5000;         // milliseconds
constexpr std::size_t mostWarnings = 20; // of one reading, in the log
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
{
  this->Copies = new Autosave(*this->State);
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
  this->makeDocks();
  this->makeFileMenu();
  this->makeEditMenu();
  this->makeViewMenu();
  this->makeToolsMenu();
  this->makeHelpMenu();
  connect(this->State, &EditorState::changed, this, &MainWindow::refresh);
  connect(this->State, &EditorState::changed, this, &MainWindow::noteNewWarnings);
  connect(this->State, &EditorState::selectionChanged, this, &MainWindow::refresh);
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

void MainWindow::fail(const QString& message)
{
  this->note(message);
  QMessageBox box(QMessageBox::Warning, tr("DGTk"), message, QMessageBox::Ok, this);
  box.setObjectName("errorBox");
  box.exec();
}

void MainWindow::note(const QString& line)
{
  this->Log->appendPlainText(line);
  this->statusBar()->showMessage(line, statusTime);
}

void MainWindow::noteWarnings(const std::vector<std::string>& lines)
{
  for (std::size_t i = 0; i < lines.size() && i < mostWarnings; ++i)
  {
    this->note(tr("Warning: %1").arg(toText(lines[i])));
  }
  if (lines.size() > mostWarnings)
  {
    this->note(tr("%1 more warnings: dgtk info shows all of them").arg(lines.size() - mostWarnings));
  }
}

void MainWindow::noteNewWarnings()
{
  const std::vector<std::string>& all = this->document().models().warnings();
  this->Warned = this->document().opened() == this->Opened ? this->Warned : 0;
  this->Opened = this->document().opened();
  this->noteWarnings({ all.begin() + std::ptrdiff_t(this->Warned), all.end() });
  this->Warned = all.size();
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

void MainWindow::closeEvent(QCloseEvent* event)
{
  if (!this->mayDiscard() || !this->mayLeaveRun())
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
