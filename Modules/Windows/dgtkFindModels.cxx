// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEditorLog.h"
#include "dgtkEditorState.h"
#include "dgtkMissingFiles.h"
#include "dgtkSceneFiles.h"
#include "dgtkUsualFolder.h"

#include <QFile>
#include <QFileDialog>
#include <QLabel>
#include <QMainWindow>
#include <QMessageBox>
#include <QPushButton>

#include <memory>
#include <optional>

namespace dgtk
{

namespace
{
constexpr std::size_t mostListed = 20;

QString listOf(const std::vector<std::string>& models)
{
  QStringList lines;
  for (std::size_t i = 0; i < models.size() && i < mostListed; ++i)
  {
    lines << toText(models[i]);
  }
  if (models.size() > mostListed)
  {
    lines << QStringLiteral("...");
  }
  return lines.join('\n');
}
} // namespace

void SceneFiles::findMissing()
{
  while (!this->State.document().absent().empty() && this->offerToFind())
  {
  }
}

bool SceneFiles::offerToFind()
{
  const std::vector<std::string> models = modelsOf(this->State.scene(), this->State.document().absent());
  QMessageBox box(QMessageBox::Warning, tr("DGTk"), tr("Models that are not there: %1").arg(models.size()),
    QMessageBox::Ok, &this->Window);
  box.setObjectName("missingBox");
  box.setEscapeButton(QMessageBox::Ok);
  box.setDefaultButton(QMessageBox::Ok);
  box.setInformativeText(
    tr("%1\n\nGrey boxes stand in their place. The scene can be edited and saved, but not rendered.")
      .arg(listOf(models)));
  box.findChild<QLabel*>("qt_msgbox_informativelabel")->setTextFormat(Qt::PlainText);
  QPushButton* const find = box.addButton(tr("&Find folder ..."), QMessageBox::ActionRole);
  find->setObjectName("findFolder");
  box.exec();
  if (box.clickedButton() != find)
  {
    return false;
  }
  const QString folder =
    QFileDialog::getExistingDirectory(&this->Window, tr("Folder below which the models are"), usualFolder("models"));
  return !folder.isEmpty() && this->findModelsBelow(folder);
}

bool SceneFiles::findModelsBelow(const QString& folder)
{
  if (!this->isFree())
  {
    return false;
  }
  struct Found
  {
    std::map<std::string, std::string> files;
    std::optional<ModelLibrary> models;
  };
  const auto found = std::make_shared<Found>();
  const std::vector<std::string> wanted = modelsOf(this->State.scene(), this->State.document().absent());
  const bool looked = this->work(tr("Looking for models in %1 ...").arg(folder),
    [found, wanted, scene = this->State.scene(), models = this->State.document().models(),
      file = QFile::encodeName(folder).toStdString()](const LoadProgress& progress)
    {
      found->files = findModels(wanted, file, progress);
      SceneDescription after = scene;
      replaceModels(after, found->files);
      ModelLibrary more = models;
      if (more.load(after, progress))
      {
        found->models = std::move(more);
      }
    });
  if (!looked || !found->models)
  {
    return false;
  }
  const std::size_t before = this->Log.warned();
  this->State.document().adopt(*found->models);
  const bool changed =
    !found->files.empty() && this->State.attempt(
                               [&] {
                                 this->State.document().edit(
                                   "Find models", [&](SceneDescription& scene) { replaceModels(scene, found->files); });
                               });
  this->Log.note(EditorLog::withWarnings(
    tr("Found %1 of %2 models").arg(found->files.size()).arg(wanted.size()), this->Log.warned() - before));
  return changed;
}

} // namespace dgtk
