// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAutosave.h"
#include "dgtkEditorLog.h"
#include "dgtkEditorState.h"
#include "dgtkError.h"
#include "dgtkSceneFiles.h"
#include "dgtkSceneViews.h"
#include "dgtkUtf8.h"

#include <QDateTime>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QMainWindow>
#include <QMessageBox>

#include <memory>
#include <optional>

namespace dgtk
{

namespace
{
/// The same fault told of the scene: where its copy is kept is the program's own business.
Error toldOf(const Error& error, const std::string& copy, const QString& scene)
{
  const QString place = toText(printable(copy));
  return Error(error.code(), toText(error.what()).replace(place, scene).toStdString());
}
} // namespace

void SceneFiles::offerRecovery()
{
  QStringList copies = Autosave::leftBehind();
  while (!copies.isEmpty())
  {
    const QString copy = copies.takeFirst();
    const QString origin = Autosave::originOf(copy);
    const bool outdated = QFileInfo(origin).lastModified() > QFileInfo(copy).lastModified();
    const QString time = QFileInfo(copy).lastModified().toString(Qt::ISODate).replace('T', ' ');
    QMessageBox box(QMessageBox::Question, tr("DGTk"),
      origin.isEmpty() ? tr("The editor ended without saving a scene that had no name yet, at %1.").arg(time)
                       : tr("The editor ended without saving %1, at %2.").arg(QDir::toNativeSeparators(origin), time),
      QMessageBox::Open | QMessageBox::Discard | QMessageBox::Cancel, &this->Window);
    box.setTextFormat(Qt::PlainText);
    box.setObjectName("recoverBox");
    box.setInformativeText(tr("Open what was kept of it, or discard it for good. Cancel asks again next time."));
    const int choice = box.exec();
    if (choice == QMessageBox::Discard)
    {
      Autosave::discard(copy);
    }
    const auto loaded = std::make_shared<std::optional<LoadedScene>>();
    const QString name = origin.isEmpty() ? tr("a scene without a name") : origin;
    const auto read = [loaded, name, file = QFile::encodeName(copy).toStdString()](const LoadProgress& p)
    {
      try
      {
        *loaded = SceneDocument::read(file, p);
      }
      catch (const Error& error)
      {
        throw toldOf(error, file, name);
      }
    };
    if (choice == QMessageBox::Open && this->work(tr("Reading what was kept ..."), read) && *loaded)
    {
      this->Copies->adopt(copy); // before anything is drawn, which may be what ended the editor
      // A file that was saved since is not replaced unasked.
      this->State.document().recover(std::move(**loaded), outdated ? std::string() : origin.toStdString());
      this->Views.showWhole();
      this->Log.note(tr("Recovered: %1").arg(name));
      this->findMissing();
      if (const int others = Autosave::leftBehind().size(); others > 0)
      {
        this->Log.note(tr("There is other unsaved work, too (%1): the next start asks about it.").arg(others));
      }
      return;
    }
  }
}

} // namespace dgtk
