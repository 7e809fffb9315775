// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMainWindow.h"

#include "dgtkAutosave.h"
#include "dgtkEditorState.h"
#include "dgtkRenderDialog.h"
#include "dgtkSceneViews.h"

#include <QAction>
#include <QCloseEvent>
#include <QCoreApplication>
#include <QDateTime>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFile>
#include <QFileInfo>
#include <QMenu>
#include <QMessageBox>
#include <QMimeData>
#include <QPlainTextEdit>
#include <QSettings>
#include <QStatusBar>
#include <QSurfaceFormat>
#include <QToolBar>
#include <QUrl>

#include <clocale>

namespace dgtk
{

namespace
{
constexpr int mostRecent = 8;
constexpr int statusTime = 5000; // milliseconds

bool isScene(const QString& path)
{
  const QString extension = QFileInfo(path).suffix().toLower();
  return extension == "json" || extension == "scene";
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
{
  new Autosave(*this->State);
  this->setObjectName("mainWindow");
  this->setAcceptDrops(true);
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
  connect(this->State, &EditorState::selectionChanged, this, &MainWindow::refresh);
  connect(this->State, &EditorState::failed, this, &MainWindow::fail);
  connect(this->Views, &SceneViews::failed, this, &MainWindow::note);
  connect(this->Views, &SceneViews::menuAsked, this, &MainWindow::showContextMenu);
  this->resize(1280, 860);
  const QSettings settings;
  this->restoreGeometry(settings.value("geometry").toByteArray());
  this->restoreState(settings.value("state").toByteArray());
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
  const bool selected = !this->State->selection().empty();
  for (const char* name : { "cut", "copy", "duplicate", "delete", "frameSelected" })
  {
    this->findChild<QAction*>(name)->setEnabled(selected);
  }
  this->findChild<QAction*>("paste")->setEnabled(this->State->canPaste());
  QAction* const undo = this->findChild<QAction*>("undo");
  QAction* const redo = this->findChild<QAction*>("redo");
  undo->setEnabled(document.canUndo());
  redo->setEnabled(document.canRedo());
  undo->setText(tr("&Undo %1").arg(toText(document.undoText())).trimmed());
  redo->setText(tr("&Redo %1").arg(toText(document.redoText())).trimmed());
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

void MainWindow::newScene()
{
  if (this->mayDiscard())
  {
    this->State->select({});
    this->State->document().clear();
    this->State->setFrame(0);
    this->Views->showWhole();
  }
}

bool MainWindow::openFile(const QString& path)
{
  if (!isScene(path))
  {
    return this->importFile(path);
  }
  if (!this->mayDiscard() || !this->State->attempt([&] { this->State->document().open(path.toStdString()); }))
  {
    return false;
  }
  this->State->select({});
  this->State->setFrame(this->State->scene().firstFrame());
  this->Views->showWhole();
  this->addRecent(path);
  this->note(tr("Opened %1: %2 objects, %3 lights, %4 cameras")
               .arg(QFileInfo(path).fileName())
               .arg(this->State->scene().objects.size())
               .arg(this->State->scene().lights.size())
               .arg(this->State->scene().cameras.size()));
  return true;
}

void MainWindow::offerRecovery()
{
  for (const QString& copy : Autosave::leftBehind())
  {
    QMessageBox box(QMessageBox::Question, tr("DGTk"),
      tr("The editor ended without saving a scene, at %1.")
        .arg(QFileInfo(copy).lastModified().toString(Qt::ISODate).replace('T', ' ')),
      QMessageBox::Open | QMessageBox::Discard | QMessageBox::Cancel, this);
    box.setObjectName("recoverBox");
    box.setInformativeText(tr("Open what was kept of it, or discard it for good. Cancel asks again next time."));
    const int choice = box.exec();
    if (choice == QMessageBox::Discard)
    {
      QFile::remove(copy);
    }
    if (choice == QMessageBox::Open &&
        this->State->attempt([&] { this->State->document().recover(copy.toStdString()); }))
    {
      QFile::remove(copy);
      this->Views->showWhole();
      return;
    }
  }
}

bool MainWindow::importFile(const QString& path)
{
  const bool first = this->State->scene().objects.empty();
  const bool done = this->State->attempt(
    [&]
    {
      const SceneItem item = this->State->document().addModel(path.toStdString());
      this->State->select({ item });
    });
  if (done && first)
  {
    this->Views->showWhole();
  }
  if (done)
  {
    this->note(tr("Imported %1").arg(QFileInfo(path).fileName()));
  }
  return done;
}

bool MainWindow::saveFile(const QString& path)
{
  if (!this->State->attempt([&] { this->State->document().saveAs(path.toStdString()); }))
  {
    return false;
  }
  this->addRecent(path);
  this->note(tr("Saved %1").arg(path));
  return true;
}

bool MainWindow::save()
{
  const QString path = toText(this->State->document().path());
  return path.isEmpty() ? this->saveAs() : this->saveFile(path);
}

bool MainWindow::mayDiscard()
{
  if (!this->State->document().modified())
  {
    return true;
  }
  QMessageBox box(QMessageBox::Question, tr("DGTk"), tr("The scene has changes that are not saved."),
    QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, this);
  box.setObjectName("unsavedBox");
  box.setInformativeText(tr("Save them, or they are lost."));
  box.setDefaultButton(QMessageBox::Save);
  switch (box.exec())
  {
    case QMessageBox::Save:
      return this->save();
    case QMessageBox::Discard:
      return true;
    default:
      return false;
  }
}

void MainWindow::closeEvent(QCloseEvent* event)
{
  if (!this->mayDiscard())
  {
    event->ignore();
    return;
  }
  QSettings settings;
  settings.setValue("geometry", this->saveGeometry());
  settings.setValue("state", this->saveState());
  event->accept();
}

void MainWindow::dragEnterEvent(QDragEnterEvent* event)
{
  if (event->mimeData()->hasUrls())
  {
    event->acceptProposedAction();
  }
}

void MainWindow::dropEvent(QDropEvent* event)
{
  for (const QUrl& url : event->mimeData()->urls())
  {
    if (url.isLocalFile())
    {
      this->openFile(url.toLocalFile());
    }
  }
  event->acceptProposedAction();
}

void MainWindow::addRecent(const QString& path)
{
  QSettings settings;
  const QString absolute = QFileInfo(path).absoluteFilePath();
  QStringList recent = settings.value("recent").toStringList();
  recent.removeAll(absolute);
  recent.prepend(absolute);
  settings.setValue("recent", QStringList(recent.mid(0, mostRecent)));
  this->refreshRecent();
}

void MainWindow::refreshRecent()
{
  this->Recent->clear();
  const QStringList recent = QSettings().value("recent").toStringList();
  for (const QString& path : recent)
  {
    this->Recent->addAction(QFileInfo(path).fileName() + "  -  " + QFileInfo(path).absolutePath(), this,
      [this, path] { this->openFile(path); });
  }
  this->Recent->setEnabled(!recent.isEmpty());
}

} // namespace dgtk
