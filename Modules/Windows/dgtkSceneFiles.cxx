// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneFiles.h"

#include "dgtkAutosave.h"
#include "dgtkBackgroundWork.h"
#include "dgtkEditorLanguage.h"
#include "dgtkEditorLog.h"
#include "dgtkEditorState.h"
#include "dgtkEnvironmentLight.h"
#include "dgtkError.h"
#include "dgtkModelReader.h"
#include "dgtkNamedAction.h"
#include "dgtkPovExport.h"
#include "dgtkSampleDrawer.h"
#include "dgtkSaveName.h"
#include "dgtkSceneViews.h"
#include "dgtkUsualFolder.h"

#include <QAction>
#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QMainWindow>
#include <QMenu>
#include <QMessageBox>
#include <QPushButton>
#include <QSettings>

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

SceneFiles::SceneFiles(EditorState& state, SceneViews& views, EditorLog& log, BackgroundWork& work, QMenu& recent,
  QMainWindow& window, SceneFilesHooks hooks)
  : QObject(&window)
  , State(state)
  , Views(views)
  , Log(log)
  , Work(work)
  , Recent(recent)
  , Window(window)
  , Hooks(std::move(hooks))
  , Copies(new Autosave(state))
{
  this->refreshRecent();
}

bool SceneFiles::isFree()
{
  if (this->Work.busy())
  {
    this->Log.note(tr("Another file is being read: wait for it, or cancel it."));
  }
  return !this->Work.busy();
}

bool SceneFiles::work(const QString& what, const std::function<void(const LoadProgress&)>& work)
{
  bool done = false;
  const bool tried = this->State.attempt([&] { done = this->Work.run(what, work); });
  if (tried && !done)
  {
    this->Log.note(tr("Cancelled: %1").arg(what));
  }
  return done;
}

void SceneFiles::newScene()
{
  if (this->mayDiscard())
  {
    this->State.select({});
    this->State.document().clear();
    this->State.setFrame(0);
    this->Views.showWhole();
  }
}

void SceneFiles::askOpen()
{
  const QString path = QFileDialog::getOpenFileName(
    &this->Window, tr("Open a scene"), usualFolder(), tr("Scenes (*.json *.scene);;All files (*)"));
  if (!path.isEmpty())
  {
    rememberFolder(path);
    this->openFile(path);
  }
}

bool SceneFiles::openFile(const QString& path)
{
  if (path.contains(QChar::ReplacementCharacter) && !QFileInfo::exists(path))
  {
    emit this->State.failed(tr("%1: the name of the file is not UTF-8: rename it").arg(path));
    return false;
  }
  if (QFileInfo(path).isDir() || QFileInfo(path).fileName() == "manifest.json")
  {
    emit this->datasetAsked(path);
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
  const std::string before = this->State.document().json();
  struct Outcome
  {
    std::optional<LoadedScene> scene;
    bool random = false;
  };
  const auto loaded = std::make_shared<Outcome>();
  const std::string file = QFile::encodeName(path).toStdString();
  const bool read = this->work(tr("Reading %1 ...").arg(QFileInfo(path).fileName()),
    [loaded, file](const LoadProgress& progress)
    {
      try
      {
        loaded->scene = SceneDocument::read(file, progress);
      }
      catch (const InputError& error)
      {
        loaded->random = isRandomScene(file);
        if (!loaded->random)
        {
          throw std::runtime_error(error.what()); // with its line, also where the scene that is open is read again
        }
      }
      if (loaded->scene)
      {
        environmentLight(loaded->scene->models.environment(loaded->scene->scene)); // is kept; the views need not wait
      }
    });
  if (read && loaded->random)
  {
    this->offerToSample(path, before);
    return false;
  }
  // What was edited in the meantime is not thrown away unasked.
  if (!read || !loaded->scene || (this->State.document().json() != before && !this->mayDiscard()))
  {
    return false;
  }
  this->State.document().install(std::move(*loaded->scene));
  this->State.select({});
  this->State.setFrame(this->State.scene().firstFrame());
  this->Views.showWhole();
  this->addRecent(path);
  const QString opened = tr("Opened %1: %2").arg(QFileInfo(path).fileName(), contentsText(this->State.scene()));
  this->Log.note(EditorLog::withWarnings(opened, this->Log.warned()));
  this->findMissing();
  return true;
}

void SceneFiles::askImport()
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
    QFileDialog::getOpenFileNames(&this->Window, tr("Import models"), usualFolder("models"), filters.join(";;"));
  for (const QString& path : paths)
  {
    rememberFolder(path, "models");
    this->importFile(path);
  }
}

bool SceneFiles::importFile(const QString& path)
{
  if (!this->isFree())
  {
    return false;
  }
  const std::string file = QFile::encodeName(QDir::cleanPath(QFileInfo(path).absoluteFilePath())).toStdString();
  const auto loaded = std::make_shared<std::optional<ModelLibrary>>();
  const bool read = this->work(tr("Reading %1 ...").arg(QFileInfo(path).fileName()),
    [loaded, reader = this->State.document().modelReader(file)](const LoadProgress& progress)
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

bool SceneFiles::addRead(const std::string& file, const ModelLibrary& models)
{
  const QString name = QFileInfo(QFile::decodeName(file.c_str())).fileName();
  const std::shared_ptr<const Model> model = this->State.document().modelIn(models, file);
  std::vector<std::string> warnings;
  for (const std::string& line : model->warnings)
  {
    warnings.push_back(name.toStdString() + ": " + line);
  }
  this->Log.noteWarnings(warnings);
  if (model->triangles.empty())
  {
    emit this->State.failed(tr("%1 has no surfaces: nothing was added.").arg(name));
    return false;
  }
  const bool first = this->State.scene().objects.empty();
  this->State.document().adopt(models);
  this->Log.setWarned(this->State.document().models().warnings().size());
  if (!this->State.attempt([&] { this->State.select({ this->State.document().addModel(file) }); }))
  {
    return false;
  }
  if (first)
  {
    this->Views.showWhole();
  }
  this->Log.note(EditorLog::withWarnings(tr("Imported %1").arg(name), warnings.size()));
  return true;
}

bool SceneFiles::saveFile(const QString& path)
{
  this->State.finishTyping();
  QString refusal;
  const bool isSaved = this->State.attempt(
    [&]
    {
      try
      {
        this->State.document().saveAs(QFile::encodeName(path).toStdString());
      }
      catch (const Error& error)
      {
        refusal = QString::fromUtf8(error.what());
      }
    });
  if (!refusal.isEmpty())
  {
    return this->saveElsewhere(refusal);
  }
  if (!isSaved)
  {
    return false;
  }
  this->addRecent(path);
  this->Log.note(tr("Saved %1").arg(path));
  return true;
}

bool SceneFiles::saveElsewhere(const QString& refusal)
{
  this->Log.note(refusal);
  QMessageBox box(QMessageBox::Warning, tr("DGTk"), refusal, QMessageBox::Ok, &this->Window);
  box.setTextFormat(Qt::PlainText);
  box.setObjectName("errorBox");
  QPushButton* const other = box.addButton(tr("Save &as ..."), QMessageBox::AcceptRole);
  other->setObjectName("saveAs");
  box.setEscapeButton(QMessageBox::Ok);
  box.setDefaultButton(QMessageBox::Ok);
  box.exec();
  return box.clickedButton() == other && this->saveAs();
}

bool SceneFiles::save()
{
  const SceneDocument& document = this->State.document();
  const QString path = toText(document.path());
  if (path.isEmpty())
  {
    return this->saveAs();
  }
  const bool isReplaced = document.isReplaced() && QFileInfo::exists(path);
  if (!isReplaced && !document.losesComments())
  {
    return this->saveFile(path);
  }
  const QString name = QFileInfo(path).fileName();
  QMessageBox box(QMessageBox::Warning, tr("DGTk"),
    isReplaced ? tr("%1 was changed by another program since it was opened or saved here.").arg(name)
               : tr("%1 has comments, which the editor does not keep.").arg(name),
    QMessageBox::Cancel, &this->Window);
  box.setTextFormat(Qt::PlainText);
  box.setObjectName("overwriteBox");
  box.setInformativeText(tr("Overwrite it, or save the scene in another file?"));
  QPushButton* const overwrite = box.addButton(tr("&Overwrite"), QMessageBox::DestructiveRole);
  overwrite->setObjectName("overwrite");
  QPushButton* const other = box.addButton(tr("Save &as ..."), QMessageBox::AcceptRole);
  other->setObjectName("saveAs");
  box.setDefaultButton(other);
  box.exec();
  return box.clickedButton() == overwrite ? this->saveFile(path) : box.clickedButton() == other && this->saveAs();
}

bool SceneFiles::saveAs()
{
  const QString now = toText(this->State.document().path());
  const QString path = askSaveName(&this->Window, tr("Save the scene"), now.isEmpty() ? usualFolder() : now,
    tr("Scene (*.json);;Thesis scene (*.scene)"));
  if (path.isEmpty())
  {
    return false;
  }
  rememberFolder(path);
  return this->saveFile(path);
}

bool SceneFiles::mayDiscard()
{
  this->State.finishTyping();
  if (!this->Hooks.mayDiscardMore())
  {
    return false;
  }
  if (!this->State.document().modified())
  {
    return true;
  }
  const QString name = QFileInfo(toText(this->State.document().path())).fileName();
  QMessageBox box(QMessageBox::Question, tr("DGTk"),
    name.isEmpty() ? tr("The scene has changes that are not saved.")
                   : tr("%1 has changes that are not saved.").arg(name),
    QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, &this->Window);
  box.setTextFormat(Qt::PlainText);
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

void SceneFiles::exportPov()
{
  const QFileInfo now(toText(this->State.document().path()));
  const QString path = askSaveName(&this->Window, tr("Export for POV-Ray"),
    now.filePath().isEmpty() ? usualFolder() : now.dir().filePath(now.completeBaseName() + ".pov"),
    tr("POV-Ray scene (*.pov)"));
  if (path.isEmpty() || !this->isFree())
  {
    return;
  }
  SceneDescription scene = this->State.scene();
  std::size_t camera = 0;
  for (const SceneItem& item : this->State.selection())
  {
    camera = item.kind == SceneItem::Kind::Camera ? item.index : camera;
  }
  if (scene.cameras.empty())
  {
    scene.cameras.push_back(this->Hooks.cameraOfView());
    scene.order.clear();
  }
  const std::string file = QFile::encodeName(path).toStdString();
  const auto warnings = std::make_shared<std::vector<std::string>>();
  const bool done = this->work(tr("Writing %1 ...").arg(QFileInfo(path).fileName()),
    [scene, camera, file, warnings, frame = this->State.frame()](const LoadProgress& progress)
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
    this->Log.noteWarnings(*warnings);
    this->Log.note(tr("Wrote %1").arg(QFile::decodeName(file.c_str())));
  }
}

void SceneFiles::addRecent(const QString& path)
{
  QSettings settings;
  const QString absolute = QFileInfo(path).absoluteFilePath();
  QStringList recent = settings.value("recent").toStringList();
  recent.removeAll(absolute);
  recent.prepend(absolute);
  settings.setValue("recent", QStringList(recent.mid(0, mostRecent)));
  this->refreshRecent();
}

void SceneFiles::refreshRecent()
{
  this->Recent.clear();
  const QStringList recent = QSettings().value("recent").toStringList();
  for (const QString& path : recent)
  {
    QAction* const open =
      this->Recent.addAction(menuText(QFileInfo(path).fileName() + "  -  " + QFileInfo(path).absolutePath()), this,
        [this, path]
        {
          if (!this->openFile(path) && !QFileInfo::exists(path))
          {
            QStringList others = QSettings().value("recent").toStringList();
            others.removeAll(path);
            QSettings().setValue("recent", others);
            this->refreshRecent();
          }
        });
    open->setObjectName("recent." + QString::number(this->Recent.actions().size() - 1));
  }
  this->Recent.setEnabled(!recent.isEmpty());
}

} // namespace dgtk
