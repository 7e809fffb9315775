// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEditorLog.h"
#include "dgtkEditorState.h"
#include "dgtkEnvironmentLight.h"
#include "dgtkSampleDialog.h"
#include "dgtkSceneFiles.h"
#include "dgtkSceneViews.h"
#include "dgtkUsualFolder.h"

#include <QFileDialog>
#include <QFileInfo>
#include <QMainWindow>
#include <QMessageBox>
#include <QPushButton>

#include <utility>

namespace dgtk
{

void SceneFiles::askSample()
{
  const QString path = QFileDialog::getOpenFileName(
    &this->Window, tr("Sample a random scene"), usualFolder(), tr("Random scenes (*.json);;All files (*)"));
  if (!path.isEmpty())
  {
    rememberFolder(path);
    this->Discarded.clear(); // what was given up for another one
    this->sampleFile(path);
  }
}

void SceneFiles::offerToSample(const QString& path, const std::string& given)
{
  QMessageBox box(QMessageBox::Question, tr("DGTk"), tr("%1 has random values.").arg(QFileInfo(path).fileName()),
    QMessageBox::Cancel, &this->Window);
  box.setTextFormat(Qt::PlainText);
  box.setObjectName("randomBox");
  box.setInformativeText(tr("Samples of it are plain scenes, which the window can show."));
  QPushButton* const sample = box.addButton(tr("&Sample ..."), QMessageBox::AcceptRole);
  sample->setObjectName("sample");
  box.setDefaultButton(sample);
  box.exec();
  if (box.clickedButton() == sample)
  {
    this->Discarded = given;
    this->sampleFile(path);
  }
}

SampleDialog& SceneFiles::sampling()
{
  if (this->Samples == nullptr)
  {
    this->Samples = new SampleDialog(
      { [this] { return this->mayReplaceBySample(); },
        [](const LoadedScene& sample) { environmentLight(sample.models.environment(sample.scene)); },
        [this](LoadedScene sample) { return this->showSample(std::move(sample)); }, [this] { this->saveAs(); } },
      &this->Window);
    connect(this->Samples, &SampleDialog::noted, this, [this](const QString& line) { this->Log.note(line); });
    connect(
      &this->State, &EditorState::changed, this->Samples, [this] { this->Samples->allowKeeping(this->isSample()); });
  }
  return *this->Samples;
}

void SceneFiles::sampleFile(const QString& path)
{
  SampleDialog& dialog = this->sampling();
  dialog.show();
  dialog.raise();
  dialog.activateWindow();
  dialog.openScene(path);
  this->addRecent(path);
}

void SceneFiles::closeSamples()
{
  if (this->Samples != nullptr)
  {
    this->Samples->hide();
  }
}

bool SceneFiles::isSample() const
{
  return this->SampleOpened == this->State.document().opened() && this->SampleOpened > 0 &&
         this->State.document().path().empty();
}

bool SceneFiles::mayReplaceBySample()
{
  this->State.finishTyping();
  const bool isAsDrawn = this->isSample() && !this->State.document().canUndo();
  if ((isAsDrawn && this->Hooks.mayDiscardMore()) || this->State.document().json() == this->Discarded)
  {
    return true;
  }
  if (isAsDrawn || !this->mayDiscard())
  {
    return false;
  }
  this->Discarded = this->State.document().json();
  return true;
}

bool SceneFiles::showSample(LoadedScene sample)
{
  // What was edited in the meantime is not thrown away unasked.
  if (!this->mayReplaceBySample())
  {
    return false;
  }
  const bool isFirst = !this->isSample();
  this->SampleOpened = this->State.document().opened() + 1; // before the listeners hear of it
  this->State.document().recover(std::move(sample));
  this->Discarded.clear();
  this->State.select({});
  this->State.setFrame(this->State.scene().firstFrame());
  if (isFirst)
  {
    this->Views.showWhole(); // further samples are seen from the same place
  }
  return true;
}

} // namespace dgtk
