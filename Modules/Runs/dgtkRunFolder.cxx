// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRunFolder.h"

#include "dgtkEditorState.h"
#include "dgtkFolderContents.h"
#include "dgtkJournal.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QMessageBox>
#include <QPushButton>

#include <exception>

namespace dgtk
{

namespace
{
/// For no request: to tell whether a run is of the same one, the scene's models would have to be read.
FolderContents contentsOf(const QString& folder)
{
  try
  {
    return folderContents(QFile::encodeName(folder).toStdString(), {});
  }
  catch (const std::exception&)
  {
    return FolderContents::Foreign; // the run says what is wrong with it
  }
}
} // namespace

QString RunFolder::usual(const std::string& scene)
{
  const QFileInfo file(toText(scene));
  return scene.empty() ? QDir::home().filePath("dataset") : file.dir().filePath(file.completeBaseName() + "_dataset");
}

RunFolder::RunFolder(const QString& typed)
  : Path(QDir::cleanPath(QDir::current().absoluteFilePath(typed)))
  , Finished(QDir(this->Path).exists(manifestName))
{
  const FolderContents found = contentsOf(this->Path);
  RunLog log(this->Path);
  this->Rendering = log.alive();
  this->Unfinished = found == FolderContents::UnfinishedOther;
  if (this->Unfinished)
  {
    log.read();
    this->Text = tr("An interrupted run stands in this folder%1. Start goes on with it.")
                   .arg(log.total() == 0 ? QString() : tr(" (%1 of %2 pictures)").arg(log.done()).arg(log.total()));
  }
  else if (found == FolderContents::Running)
  {
    this->Text = this->Rendering ? tr("A run into this folder goes on. Start shows it.")
                                 : tr("Another program is rendering into this folder.");
  }
  if (!log.request().arguments.isEmpty() && log.end() != RunLog::End::Done)
  {
    this->Interrupted = log.request();
  }
}

RunFolder::Question RunFolder::question(bool goOn, const QByteArray& scene) const
{
  if (!this->Unfinished)
  {
    return this->Finished ? Question::Finished : Question::None;
  }
  if (!goOn)
  {
    return Question::Unfinished;
  }
  const bool other = this->Interrupted && !scene.isEmpty() && scene != this->Interrupted->scene;
  return other ? Question::OtherScene : Question::None;
}

RunFolder::Begin RunFolder::begin(bool goOn, const QByteArray& scene, QWidget* parent) const
{
  const QString name = QDir::toNativeSeparators(this->Path);
  switch (this->question(goOn, scene))
  {
    case Question::Unfinished:
      return askToGoOn(tr("%1 holds an interrupted run.").arg(name), parent);
    case Question::OtherScene:
      return askToGoOn(
        tr("%1 holds an interrupted run of another scene, or of this one before it was changed.").arg(name), parent);
    case Question::Finished:
      return askToReplace(tr("%1 holds a finished dataset.").arg(name), parent);
    default:
      return this->Unfinished ? Begin::GoOn : Begin::Fresh;
  }
}

RunFolder::Begin RunFolder::askToGoOn(const QString& what, QWidget* parent)
{
  QMessageBox box(QMessageBox::Question, QStringLiteral("DGTk"), what, QMessageBox::Cancel, parent);
  box.setTextFormat(Qt::PlainText);
  box.setObjectName("unfinishedRunBox");
  box.setInformativeText(tr("Go on with it, or replace it by this run? What it has made so far goes then."));
  QPushButton* const goOn = box.addButton(tr("Go on"), QMessageBox::AcceptRole);
  goOn->setObjectName("goOn");
  QPushButton* const replace = box.addButton(tr("Replace"), QMessageBox::DestructiveRole);
  replace->setObjectName("replace");
  box.button(QMessageBox::Cancel)->setText(tr("Another folder"));
  box.setDefaultButton(goOn);
  box.exec();
  return box.clickedButton() == goOn ? Begin::GoOn : box.clickedButton() == replace ? Begin::Replace : Begin::Not;
}

RunFolder::Begin RunFolder::askToReplace(const QString& what, QWidget* parent)
{
  QMessageBox box(QMessageBox::Question, QStringLiteral("DGTk"), what, QMessageBox::Cancel, parent);
  box.setTextFormat(Qt::PlainText);
  box.setObjectName("replaceDatasetBox");
  box.setInformativeText(tr("Replace it by this run? Cancel to name another folder."));
  QPushButton* const replace = box.addButton(tr("Replace"), QMessageBox::DestructiveRole);
  replace->setObjectName("replace");
  box.setDefaultButton(QMessageBox::Cancel);
  box.exec();
  return box.clickedButton() == replace ? Begin::Replace : Begin::Not;
}

} // namespace dgtk
