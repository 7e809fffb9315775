// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetViewer.h"
#include "dgtkFrameRow.h"
#include "dgtkPaneGrid.h"

#include <QAction>
#include <QStatusBar>

#include <algorithm>

// The pictures that are asked for, and those that come.

namespace dgtk
{

int DatasetViewer::frame() const
{
  return this->Dataset ? this->Dataset->frames()[std::size_t(this->Frames->index())] : 0;
}

PictureAsk DatasetViewer::askOf(const PicturePane& pane, int frame) const
{
  PictureAsk ask;
  ask.key = { pane.camera().toStdString(), frame, pane.layer().toStdString() };
  ask.surface = pane.surface();
  const auto range = this->Ranges.find(ask.key.layer);
  ask.range = range == this->Ranges.end() ? std::nullopt : std::optional<PictureRange>(range->second);
  return ask;
}

void DatasetViewer::askPane(PicturePane& pane)
{
  if (this->Dataset)
  {
    this->Pending.insert(pane.number());
    this->refreshBusy();
    this->Loader->ask(pane.number(), this->askOf(pane, this->frame()));
  }
}

void DatasetViewer::askChosen(PicturePane* pane)
{
  this->askPane(*pane);
  this->askPoints();
  this->askOverlays();
  this->refreshCalibration();
}

void DatasetViewer::askAll()
{
  if (!this->Dataset)
  {
    return;
  }
  this->Pending.clear();
  for (PicturePane* pane : this->panes())
  {
    this->askPane(*pane);
  }
  this->askPoints();
  this->askOverlays();
  this->refreshCalibration();
  this->Frames->setText(
    tr("Frame %1 (%2 of %3)").arg(this->frame()).arg(this->Frames->index() + 1).arg(this->Dataset->frames().size()));
}

void DatasetViewer::askPoints()
{
  this->PointSources.clear();
  const std::vector<std::string>& cameras = this->Dataset->cameras();
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    const bool shown = std::any_of(this->panes().begin(), this->panes().end(),
      [&](const PicturePane* pane) { return pane->camera() == QString::fromStdString(cameras[i]); });
    const std::string label = shown ? pointLayer(*this->Dataset, cameras[i], this->frame()) : std::string();
    if (!label.empty())
    {
      PictureAsk ask;
      ask.key = { cameras[i], this->frame(), label };
      this->Pending.insert(pointSlots + static_cast<int>(i));
      this->Loader->ask(pointSlots + static_cast<int>(i), ask);
    }
  }
  this->refreshCloudCameras();
  this->CloudTimer.start();
}

void DatasetViewer::askOverlays()
{
  OverlayAsk ask;
  ask.frame = this->frame();
  ask.boxes = this->ShowBoxes->isEnabled() && this->ShowBoxes->isChecked();
  ask.points = this->ShowPoints->isEnabled() && this->ShowPoints->isChecked();
  for (std::size_t i = 0; (ask.boxes || ask.points) && i < this->panes().size(); ++i)
  {
    ask.cameras.insert(this->panes()[i]->camera().toStdString());
  }
  if (!ask.cameras.empty())
  {
    this->Pending.insert(overlaySlot);
    this->refreshBusy();
  }
  this->Loader->askOverlays(ask);
}

void DatasetViewer::receiveOverlays(const std::shared_ptr<const FrameOverlays>& overlays, const QString& error)
{
  if (this->isLeft())
  {
    return;
  }
  this->Pending.erase(overlaySlot);
  this->refreshBusy();
  for (PicturePane* pane : this->panes())
  {
    pane->view().setOverlays(overlays);
  }
  QStringList problems = error.isEmpty() ? QStringList() : QStringList(error);
  for (std::size_t i = 0; overlays && i < overlays->problems.size(); ++i)
  {
    problems << QString::fromStdString(overlays->problems[i]);
  }
  this->showOverlayProblem(problems.join("; "));
}

/// In the status bar, until an answer without one; other messages there stay.
void DatasetViewer::showOverlayProblem(const QString& problem)
{
  if (!problem.isEmpty())
  {
    this->statusBar()->showMessage(problem);
  }
  else if (!this->OverlayProblem.isEmpty() && this->statusBar()->currentMessage() == this->OverlayProblem)
  {
    this->statusBar()->clearMessage();
  }
  this->OverlayProblem = problem;
}

void DatasetViewer::receive(int slot, const ShownPointer& shown)
{
  if (this->isLeft())
  {
    return;
  }
  if (slot >= detailSlots)
  {
    const std::size_t pane = std::size_t(slot - detailSlots);
    if (pane < this->panes().size())
    {
      this->panes()[pane]->view().showDetail(shown);
    }
  }
  else if (slot >= pointSlots)
  {
    this->Pending.erase(slot);
    this->refreshBusy();
    this->PointSources[shown->ask.key.camera] = shown;
  }
  else if (std::size_t(slot) < this->panes().size())
  {
    this->Pending.erase(slot);
    this->refreshBusy();
    this->panes()[std::size_t(slot)]->showPicture(shown, shown->ask.range.has_value());
    if (this->Sync->fitting)
    {
      this->Grid->fit();
    }
  }
  this->refreshReadOut();
}

void DatasetViewer::setRange(const PicturePane* pane, const std::optional<PictureRange>& range)
{
  const std::string label = pane->layer().toStdString();
  this->Ranges.erase(label);
  if (range)
  {
    this->Ranges[label] = *range;
  }
  for (PicturePane* other : this->panes())
  {
    if (other->layer() == pane->layer())
    {
      this->askPane(*other);
    }
  }
}

void DatasetViewer::prefetch()
{
  const int next = this->Dataset->frames()[std::size_t(this->Frames->next())];
  for (const PicturePane* pane : this->panes())
  {
    this->Loader->prefetch(pane->number(), this->askOf(*pane, next));
  }
}

} // namespace dgtk
