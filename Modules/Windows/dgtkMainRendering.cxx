// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkExportDialog.h"
#include "dgtkMainWindow.h"
#include "dgtkRenderDialog.h"
#include "dgtkRenderStatus.h"
#include "dgtkRunLog.h"
#include "dgtkUsualFolder.h"

#include <QDir>
#include <QMessageBox>
#include <QPushButton>

#include <algorithm>

namespace dgtk
{

namespace
{
QString endTitle(RunLog::End end)
{
  switch (end)
  {
    case RunLog::End::Done:
      return MainWindow::tr("Rendering is done");
    case RunLog::End::Failed:
      return MainWindow::tr("Rendering has failed");
    default:
      return MainWindow::tr("Rendering was interrupted");
  }
}

/// What a run does: the word after dgtk.
QString commandOf(const RunLog& log) { return log.request().arguments.value(0); }
/// Runs of the others cannot go on where they stopped.
bool isRender(const RunLog& log) { return commandOf(log) == "render"; }

/// Of a run that ended while no window was there.
QString endText(const RunLog& log)
{
  const QString name = QDir::toNativeSeparators(log.request().folder);
  if (commandOf(log) == "sample")
  {
    return log.end() == RunLog::End::Done ? MainWindow::tr("Sampled meanwhile: %1").arg(log.last())
                                          : MainWindow::tr("Sampling into %1 has ended: %2").arg(name, log.last());
  }
  if (commandOf(log) == "export")
  {
    return log.end() == RunLog::End::Done ? MainWindow::tr("Exported meanwhile: %1").arg(log.last())
                                          : MainWindow::tr("The export into %1 has ended: %2").arg(name, log.last());
  }
  switch (log.end())
  {
    case RunLog::End::Done:
      return MainWindow::tr("Rendered meanwhile: %1").arg(log.last());
    case RunLog::End::Failed:
      return MainWindow::tr("Rendering into %1 has failed: %2").arg(name, log.last());
    default:
      return MainWindow::tr("Rendering into %1 was interrupted%2. It can go on: Tools > Render configuration.")
        .arg(
          name, log.total() == 0 ? QString() : MainWindow::tr(" (%1 of %2 pictures)").arg(log.done()).arg(log.total()));
  }
}
} // namespace

RenderDialog& MainWindow::rendering()
{
  if (this->Rendering == nullptr)
  {
    this->Rendering = new RenderDialog(*this->State, this);
    connect(this->Rendering, &RenderDialog::noted, this, &MainWindow::note);
    connect(this->Rendering, &RenderDialog::started, this, &MainWindow::noteReplacedModels);
    connect(this->Rendering, &RenderDialog::resultAsked, this, &MainWindow::openDataset);
    connect(this->Rendering, &RenderDialog::progressed, this->Run, &RenderStatus::showProgress);
    connect(this->Rendering, &RenderDialog::shown, this, [this] { this->Run->setVisible(this->Rendering->running()); });
    connect(this->Rendering, &RenderDialog::ended, this,
      [this](RunLog::End end, const QString& message)
      {
        if (end != RunLog::End::Done) // it says so itself
        {
          this->note(message);
        }
        this->Run->showEnd(endTitle(end), message);
        this->Run->setVisible(!this->Rendering->isVisible());
      });
    connect(this->Run, &RenderStatus::clicked, this, &MainWindow::configureRendering);
    connect(this, &MainWindow::closed, this->Rendering, &QWidget::hide);
  }
  return *this->Rendering;
}

void MainWindow::configureRendering()
{
  RenderDialog& dialog = this->rendering();
  dialog.show();
  dialog.raise();
  dialog.activateWindow();
}

void MainWindow::exportDataset()
{
  if (this->Exporting == nullptr)
  {
    this->Exporting = new ExportDialog(this);
    connect(this->Exporting, &ExportDialog::noted, this, &MainWindow::note);
    connect(this, &MainWindow::closed, this->Exporting, &QWidget::hide);
  }
  this->Exporting->offer(usualFolder("dataset"));
  this->Exporting->show();
  this->Exporting->raise();
  this->Exporting->activateWindow();
}

void MainWindow::findRuns()
{
  QStringList running;
  QStringList folders = RunLog::folders();
  std::reverse(folders.begin(), folders.end()); // the latest has the last word
  for (const QString& folder : folders)
  {
    RunLog log(folder);
    const bool alive = log.alive(); // before its last words are read
    log.read();
    if (alive && isRender(log))
    {
      running << folder;
    }
    else if (!alive && !isRender(log))
    {
      if (!log.shown())
      {
        this->note(endText(log));
      }
      log.remove();
    }
    else if (!alive && !log.shown())
    {
      this->note(endText(log));
      this->rendering().offer(folder);
      this->Run->showEnd(endTitle(log.end()), QDir::toNativeSeparators(folder));
      log.markShown();
    }
    else if (!alive && (log.end() == RunLog::End::Done || !QDir(folder).exists()))
    {
      log.remove(); // there is nothing to go on with
    }
  }
  if (!running.isEmpty())
  {
    this->rendering().follow(running.last());
  }
}

bool MainWindow::mayLeaveRun()
{
  if (this->Rendering == nullptr || !this->Rendering->running())
  {
    return true;
  }
  const auto question = [this] { return tr("A dataset is being rendered. %1").arg(this->Rendering->pictures()); };
  QMessageBox box(QMessageBox::Question, tr("DGTk"), question(), QMessageBox::NoButton, this);
  box.setObjectName("runningBox");
  connect(this->Rendering, &RenderDialog::progressed, &box, [&] { box.setText(question()); });
  connect(this->Rendering, &RenderDialog::ended, &box, &QDialog::reject); // the window shows how, and stays
  box.setInformativeText(tr("In the background it goes on without this window, and the next start shows it again. "
                            "Stopped, it can go on later."));
  QPushButton* const goOn = box.addButton(tr("Go on in the &background"), QMessageBox::AcceptRole);
  goOn->setObjectName("goOn");
  QPushButton* const stop = box.addButton(tr("&Stop"), QMessageBox::DestructiveRole);
  stop->setObjectName("stop");
  QPushButton* const stay = box.addButton(tr("S&tay here"), QMessageBox::RejectRole);
  stay->setObjectName("stay");
  box.setDefaultButton(goOn);
  box.setEscapeButton(stay);
  box.exec();
  if (box.clickedButton() == stop)
  {
    this->Rendering->cancel();
  }
  return box.clickedButton() == goOn || box.clickedButton() == stop;
}

} // namespace dgtk
