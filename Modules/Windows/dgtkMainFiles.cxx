// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMainWindow.h"

#include "dgtkBackgroundWork.h"
#include "dgtkEditorState.h"
#include "dgtkEnvironmentLight.h"
#include "dgtkError.h"
#include "dgtkMatchDialog.h"
#include "dgtkModelReader.h"
#include "dgtkNamedAction.h"
#include "dgtkPovExport.h"
#include "dgtkSaveName.h"
#include "dgtkSceneViews.h"
#include "dgtkUsualFolder.h"

#include <QAction>
#include <QDir>
#include <QDragEnterEvent>
#include <QDropEvent>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QMenu>
#include <QMessageBox>
#include <QMimeData>
#include <QSettings>
#include <QTimer>
#include <QUrl>

#include <memory>
#include <optional>
#include <stdexcept>

namespace dgtk
{

namespace
{
constexpr int mostRecent = 8;

bool isScene(const QString& path)
{
  const QString extension = QFileInfo(path).suffix().toLower();
  return extension == "json" || extension == "scene";
}

/// What is wrong with a model, without the name of the object that it was to become.
std::string withoutObject(const std::string& message)
{
  const std::string before = "': model: ";
  const std::size_t at = message.find(before);
  return at == std::string::npos ? message : message.substr(at + before.size());
}
} // namespace

QString MainWindow::withWarnings(const QString& line, std::size_t warnings)
{
  return warnings == 0 ? line : tr("%1; warnings in the log: %2").arg(line).arg(warnings);
}

bool MainWindow::isFree()
{
  if (this->Work->busy())
  {
    this->note(tr("Another file is being read: wait for it, or cancel it."));
  }
  return !this->Work->busy();
}

void MainWindow::allowFiles(bool busy)
{
  for (const char* name : { "new", "open", "import", "exportPov" })
  {
    this->findChild<QAction*>(name)->setEnabled(!busy);
  }
  this->Recent->setEnabled(!busy && !this->Recent->isEmpty());
}

bool MainWindow::work(const QString& what, const std::function<void(const LoadProgress&)>& work)
{
  bool done = false;
  const bool tried = this->State->attempt([&] { done = this->Work->run(what, work); });
  if (tried && !done)
  {
    this->note(tr("Cancelled: %1").arg(what));
  }
  return done;
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

void MainWindow::askOpen()
{
  const QString path =
    QFileDialog::getOpenFileName(this, tr("Open a scene"), usualFolder(), tr("Scenes (*.json *.scene);;All files (*)"));
  if (!path.isEmpty())
  {
    rememberFolder(path);
    this->openFile(path);
  }
}

bool MainWindow::openFile(const QString& path)
{
  if (QFileInfo(path).isDir() || QFileInfo(path).fileName() == "manifest.json")
  {
    this->openDataset(path);
    return true;
  }
  if (!isScene(path))
  {
    return this->importFile(path);
  }
  if (!this->isFree() || !this->mayDiscard())
  {
    return false;
  }
  const std::string before = this->document().json();
  const auto loaded = std::make_shared<std::optional<LoadedScene>>();
  const std::string file = QFile::encodeName(path).toStdString();
  const bool read = this->work(tr("Reading %1 ...").arg(QFileInfo(path).fileName()),
    [loaded, file](const LoadProgress& progress)
    {
      *loaded = SceneDocument::read(file, progress);
      if (*loaded)
      {
        environmentLight((*loaded)->models.environment((*loaded)->scene)); // is kept; the views need not wait for it
      }
    });
  // What was edited in the meantime is not thrown away unasked.
  if (!read || !*loaded || (this->document().json() != before && !this->mayDiscard()))
  {
    return false;
  }
  this->document().install(std::move(**loaded));
  this->State->select({});
  this->State->setFrame(this->State->scene().firstFrame());
  this->Views->showWhole();
  this->addRecent(path);
  const SceneDescription& scene = this->State->scene();
  const QString opened = tr("Opened %1: %2 objects, %3 lights, %4 cameras")
                           .arg(QFileInfo(path).fileName(), QString::number(scene.objects.size()),
                             QString::number(scene.lights.size()), QString::number(scene.cameras.size()));
  this->note(withWarnings(opened, this->Warned));
  this->findMissing();
  return true;
}

void MainWindow::askImport()
{
  QStringList all;
  QStringList filters;
  for (const ReaderInfo& reader : modelReaders())
  {
    QStringList patterns;
    for (const std::string& extension : reader.extensions)
    {
      patterns << "*." + toText(extension);
    }
    all << patterns;
    filters << toText(reader.description).remove('(').remove(')') + " (" + patterns.join(' ') + ')';
  }
  filters.prepend(tr("All models (%1)").arg(all.join(' ')));
  const QStringList paths =
    QFileDialog::getOpenFileNames(this, tr("Import models"), usualFolder("models"), filters.join(";;"));
  for (const QString& path : paths)
  {
    rememberFolder(path, "models");
    this->importFile(path);
  }
}

bool MainWindow::importFile(const QString& path)
{
  if (!this->isFree())
  {
    return false;
  }
  const std::string file = QFile::encodeName(QDir::cleanPath(QFileInfo(path).absoluteFilePath())).toStdString();
  const auto loaded = std::make_shared<std::optional<ModelLibrary>>();
  const bool read = this->work(tr("Reading %1 ...").arg(QFileInfo(path).fileName()),
    [loaded, reader = this->document().modelReader(file)](const LoadProgress& progress)
    {
      try
      {
        *loaded = reader(progress);
      }
      catch (const InputError& error)
      {
        throw std::runtime_error(withoutObject(error.what()));
      }
    });
  if (!read || !*loaded)
  {
    return false;
  }
  return this->addRead(file, **loaded);
}

bool MainWindow::addRead(const std::string& file, const ModelLibrary& models)
{
  const QString name = QFileInfo(QFile::decodeName(file.c_str())).fileName();
  const std::shared_ptr<const Model> model = this->document().modelIn(models, file);
  std::vector<std::string> warnings;
  for (const std::string& line : model->warnings)
  {
    warnings.push_back(name.toStdString() + ": " + line);
  }
  this->noteWarnings(warnings);
  if (model->triangles.empty())
  {
    this->fail(tr("%1 has no surfaces: nothing was added.").arg(name));
    return false;
  }
  const bool first = this->State->scene().objects.empty();
  this->document().adopt(models);
  this->Warned = this->document().models().warnings().size();
  if (!this->State->attempt([&] { this->State->select({ this->document().addModel(file) }); }))
  {
    return false;
  }
  if (first)
  {
    this->Views->showWhole();
  }
  this->note(withWarnings(tr("Imported %1").arg(name), warnings.size()));
  return true;
}

bool MainWindow::saveFile(const QString& path)
{
  this->State->finishTyping();
  if (!this->State->attempt([&] { this->State->document().saveAs(QFile::encodeName(path).toStdString()); }))
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

bool MainWindow::saveAs()
{
  const QString now = toText(this->document().path());
  const QString path = askSaveName(
    this, tr("Save the scene"), now.isEmpty() ? usualFolder() : now, tr("Scene (*.json);;Thesis scene (*.scene)"));
  if (path.isEmpty())
  {
    return false;
  }
  rememberFolder(path);
  return this->saveFile(path);
}

bool MainWindow::mayDiscard()
{
  this->State->finishTyping();
  if (this->Matching != nullptr && !this->Matching->mayDiscard())
  {
    return false;
  }
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

void MainWindow::exportPov()
{
  const QFileInfo now(toText(this->document().path()));
  const QString path = askSaveName(this, tr("Export for POV-Ray"),
    now.filePath().isEmpty() ? usualFolder() : now.dir().filePath(now.completeBaseName() + ".pov"),
    tr("POV-Ray scene (*.pov)"));
  if (path.isEmpty() || !this->isFree())
  {
    return;
  }
  SceneDescription scene = this->State->scene();
  std::size_t camera = 0;
  for (const SceneItem& item : this->State->selection())
  {
    camera = item.kind == SceneItem::Kind::Camera ? item.index : camera;
  }
  if (scene.cameras.empty())
  {
    scene.cameras.push_back(this->cameraOfView());
    scene.order.clear();
  }
  const std::string file = QFile::encodeName(path).toStdString();
  const auto warnings = std::make_shared<std::vector<std::string>>();
  const bool done = this->work(tr("Writing %1 ...").arg(QFileInfo(path).fileName()),
    [scene, camera, file, warnings, frame = this->State->frame()](const LoadProgress& progress)
    {
      const std::shared_ptr<const Stage> stage = Stage::load(scene);
      const std::shared_ptr<const SceneState> state = stage->at(frame);
      if (progress(1, 2)) // cancelled, it leaves the file as it was
      {
        *warnings = dgtk::exportPov(*state, stage->view(camera, frame), file).warnings;
      }
    });
  if (done)
  {
    this->noteWarnings(*warnings);
    this->note(tr("Wrote %1").arg(QFile::decodeName(file.c_str())));
  }
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
  QStringList paths;
  for (const QUrl& url : event->mimeData()->urls())
  {
    if (url.isLocalFile())
    {
      paths << url.toLocalFile();
    }
  }
  event->acceptProposedAction();
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
    QAction* const open =
      this->Recent->addAction(menuText(QFileInfo(path).fileName() + "  -  " + QFileInfo(path).absolutePath()), this,
        [this, path] { this->openFile(path); });
    open->setObjectName("recent." + QString::number(this->Recent->actions().size() - 1));
  }
  this->Recent->setEnabled(!recent.isEmpty());
}

} // namespace dgtk
