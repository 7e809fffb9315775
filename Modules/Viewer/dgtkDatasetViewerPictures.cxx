// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetViewer.h"
#include "dgtkPicturePane.h"

#include <QAction>
#include <QLabel>
#include <QSlider>
#include <QSpinBox>
#include <QStatusBar>
#include <QToolButton>

#include <algorithm>

// The pictures that are asked for, and those that come.

namespace dgtk
{

int DatasetViewer::frame() const
{
  return this->Dataset ? this->Dataset->frames()[std::size_t(this->Frames->value())] : 0;
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

void DatasetViewer::askAll()
{
  if (!this->Dataset)
  {
    return;
  }
  this->Pending.clear();
  for (PicturePane* pane : this->Panes)
  {
    this->askPane(*pane);
  }
  this->askPoints();
  this->askOverlays();
  this->refreshCalibration();
  this->FrameText->setText(
    tr("Frame %1 (%2 of %3)").arg(this->frame()).arg(this->Frames->value() + 1).arg(this->Dataset->frames().size()));
}

void DatasetViewer::askPoints()
{
  this->PointSources.clear();
  const std::vector<std::string>& cameras = this->Dataset->cameras();
  for (std::size_t i = 0; i < cameras.size(); ++i)
  {
    const bool shown = std::any_of(this->Panes.begin(), this->Panes.end(),
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
  for (std::size_t i = 0; (ask.boxes || ask.points) && i < this->Panes.size(); ++i)
  {
    ask.cameras.insert(this->Panes[i]->camera().toStdString());
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
  this->Pending.erase(overlaySlot);
  this->refreshBusy();
  for (PicturePane* pane : this->Panes)
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
  if (slot >= detailSlots)
  {
    const std::size_t pane = std::size_t(slot - detailSlots);
    if (pane < this->Panes.size())
    {
      this->Panes[pane]->view().showDetail(shown);
    }
  }
  else if (slot >= pointSlots)
  {
    this->Pending.erase(slot);
    this->refreshBusy();
    this->PointSources[shown->ask.key.camera] = shown;
  }
  else if (std::size_t(slot) < this->Panes.size())
  {
    this->Pending.erase(slot);
    this->refreshBusy();
    this->Panes[std::size_t(slot)]->showPicture(shown, shown->ask.range.has_value());
    if (this->Sync->fitting)
    {
      this->fit();
    }
  }
  this->refreshReadOut();
}

void DatasetViewer::setRange(const PicturePane& pane, const std::optional<PictureRange>& range)
{
  const std::string label = pane.layer().toStdString();
  this->Ranges.erase(label);
  if (range)
  {
    this->Ranges[label] = *range;
  }
  for (PicturePane* other : this->Panes)
  {
    if (other->layer() == pane.layer())
    {
      this->askPane(*other);
    }
  }
}

void DatasetViewer::stepFrame(int by) { this->Frames->setValue(this->Frames->value() + by); }

void DatasetViewer::play(bool on)
{
  if (on && this->Dataset)
  {
    if (this->Frames->value() == this->Frames->maximum())
    {
      this->Frames->setValue(0);
    }
    this->prefetch();
    this->Player.start(1000 / this->Rate->value());
  }
  else
  {
    this->Player.stop();
  }
}

void DatasetViewer::playNext()
{
  if (!this->Pending.empty() && *this->Pending.begin() < pointSlots)
  {
    return; // reading is slower than playing
  }
  if (this->Frames->value() == this->Frames->maximum() && !this->Loop->isChecked())
  {
    this->Play->setChecked(false);
    return;
  }
  this->Frames->setValue(this->Frames->value() == this->Frames->maximum() ? 0 : this->Frames->value() + 1);
  this->prefetch();
}

void DatasetViewer::prefetch()
{
  const std::vector<int>& frames = this->Dataset->frames();
  const int next = frames[std::size_t(this->Frames->value() + 1) % frames.size()];
  for (const PicturePane* pane : this->Panes)
  {
    this->Loader->prefetch(pane->number(), this->askOf(*pane, next));
  }
}

} // namespace dgtk
