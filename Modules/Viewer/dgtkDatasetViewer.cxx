// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetViewer.h"

#include "dgtkCameraText.h"
#include "dgtkCloudView.h"
#include "dgtkFrameRow.h"
#include "dgtkPaneGrid.h"
#include "dgtkPixelText.h"
#include "dgtkReadOut.h"

#include <QAction>
#include <QDockWidget>
#include <QFileInfo>
#include <QLabel>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QStackedWidget>
#include <QStatusBar>
#include <QTimer>

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr std::uint64_t pictureBytes = std::uint64_t(256) << 20; // of all panes together
constexpr int statusTime = 8000;
constexpr int pause = 1000; // milliseconds until a folder is looked at again whose dataset is being replaced

QString text(const std::string& name) { return QString::fromStdString(name); }
} // namespace

const std::vector<PicturePane*>& DatasetViewer::panes() const { return this->Grid->panes(); }
PicturePane* DatasetViewer::activePane() const { return this->Grid->active(); }

void DatasetViewer::openFolder(const QString& folder)
{
  this->Awaited.clear();
  this->IsOpening = true;
  this->statusBar()->showMessage(tr("Opening %1 ...").arg(folder));
  this->Loader->open(folder);
}

void DatasetViewer::showDataset(const std::shared_ptr<const DatasetPictures>& dataset)
{
  const bool isAgain = this->Awaited == text(dataset->folder());
  this->Awaited.clear();
  this->IsOpening = false;
  this->Dataset = dataset;
  if (!isAgain)
  {
    this->Ranges.clear();
  }
  this->PointSources.clear();
  this->Sync->setCursor(std::nullopt);
  this->Sync->fitting = true;
  this->CloudFramed = false;
  this->Cloud->reset(dataset->upAxis());
  this->Frames->setCount(static_cast<int>(dataset->frames().size()));
  this->Grid->setDataset(dataset);
  this->Pages->setCurrentIndex(1);
  this->setWindowTitle(tr("%1 - DGTk dataset").arg(QFileInfo(text(dataset->folder())).fileName()));
  this->setPaneCount(static_cast<int>(std::min<std::size_t>(4, dataset->layers().size())));
  this->chooseFirstLayers();
  if (isAgain)
  {
    this->chooseAgain();
  }
  this->enableActions(true);
  this->Grid->takeKeys();
  this->askAll();
  QString line = tr("Cameras: %1, frames: %2, layers: %3")
                   .arg(dataset->cameras().size())
                   .arg(dataset->frames().size())
                   .arg(dataset->layers().size());
  for (const std::string& warning : dataset->warnings())
  {
    line += "; " + text(warning);
  }
  this->statusBar()->showMessage(line, dataset->warnings().empty() ? statusTime : 0);
  emit this->opened(text(dataset->folder()));
}

bool DatasetViewer::isLeft()
{
  const bool isReplaced = this->Dataset && this->Dataset->isReplaced();
  if (isReplaced)
  {
    QMetaObject::invokeMethod(this, &DatasetViewer::leaveReplaced, Qt::QueuedConnection); // its asker may need it
  }
  return isReplaced || !this->Dataset;
}

void DatasetViewer::leaveReplaced()
{
  if (this->Dataset && this->Dataset->isReplaced())
  {
    this->Awaited = this->IsOpening ? QString() : text(this->Dataset->folder());
    this->AwaitedFrame = this->Frames->index();
    this->AwaitedPanes.clear();
    for (const PicturePane* pane : this->panes())
    {
      this->AwaitedPanes.emplace_back(pane->camera(), pane->layer());
    }
    this->Dataset.reset();
    this->Frames->setCount(0);
    this->Pending.clear();
    this->CloudPending = false;
    this->refreshBusy();
    this->Calibration->clear();
    this->Pages->setCurrentIndex(0);
    this->enableActions(false);
    if (!this->Awaited.isEmpty())
    {
      this->Loader->open(this->Awaited);
    }
  }
}

/// What was shown of the dataset that was replaced, where there is such a thing.
void DatasetViewer::chooseAgain()
{
  this->setPaneCount(static_cast<int>(this->AwaitedPanes.size()));
  for (std::size_t i = 0; i < this->AwaitedPanes.size(); ++i)
  {
    this->panes()[i]->choose(this->AwaitedPanes[i].first, this->AwaitedPanes[i].second);
  }
  this->Frames->setIndex(std::min(this->AwaitedFrame, this->Frames->last()));
}

void DatasetViewer::chooseFirstLayers()
{
  const QString camera = text(this->Dataset->cameras().front());
  std::vector<std::string> labels;
  for (const Meaning wanted : { Meaning::Picture, Meaning::Depth, Meaning::Id, Meaning::Direction })
  {
    const std::string label = this->Dataset->firstLayer(wanted, camera.toStdString(), this->frame());
    if (!label.empty())
    {
      labels.push_back(label);
    }
  }
  for (const std::string& label : this->Dataset->layersOf(camera.toStdString()))
  {
    if (std::find(labels.begin(), labels.end(), label) == labels.end())
    {
      labels.push_back(label);
    }
  }
  for (std::size_t i = 0; i < this->panes().size() && i < labels.size(); ++i)
  {
    this->panes()[i]->choose(camera, text(labels[i]));
  }
}

void DatasetViewer::setPaneCount(int count)
{
  this->Grid->setCount(count);
  this->Loader->setBudget(pictureBytes / std::uint64_t(std::max(4, count)));
}

void DatasetViewer::showPictures(const std::vector<std::string>& cameras, const std::vector<std::string>& labels)
{
  if (this->Dataset && this->activePane() != nullptr)
  {
    const std::size_t count = std::max(cameras.size(), labels.size());
    this->setPaneCount(static_cast<int>(count));
    for (std::size_t i = 0; i < count; ++i)
    {
      this->panes()[i]->choose(text(cameras[i % cameras.size()]), text(labels[i % labels.size()]));
    }
    this->Sync->fitting = true;
    this->askAll();
  }
}

void DatasetViewer::layersOfOneCamera()
{
  if (const PicturePane* const pane = this->activePane(); pane != nullptr && this->Dataset)
  {
    const std::string camera = pane->camera().toStdString();
    this->showPictures({ camera }, this->Dataset->layersOf(camera));
  }
}

void DatasetViewer::oneLayerOfCameras()
{
  if (const PicturePane* const pane = this->activePane(); pane != nullptr && this->Dataset)
  {
    this->showPictures(this->Dataset->cameras(), { pane->layer().toStdString() });
  }
}

void DatasetViewer::showRefusal(const QString& message)
{
  this->IsOpening = false;
  this->statusBar()->clearMessage();
  this->EmptyText->setText(
    tr("<p>%1</p><p>Open the folder that <i>dgtk render</i> wrote.</p>").arg(message.toHtmlEscaped()));
  if (!this->Awaited.isEmpty())
  {
    QTimer::singleShot(pause, this,
      [this]
      {
        if (!this->Awaited.isEmpty())
        {
          this->Loader->open(this->Awaited);
        }
      });
    return;
  }
  QMessageBox box(QMessageBox::Warning, tr("DGTk"), message, QMessageBox::Ok, this);
  box.setTextFormat(Qt::PlainText);
  box.setObjectName("errorBox");
  box.exec();
  emit this->refused(message);
}

std::optional<Eigen::Vector3d> DatasetViewer::worldUnder(const std::string& camera) const
{
  const auto source = this->PointSources.find(camera);
  const std::optional<QPoint>& pixel = this->Sync->cursor();
  if (!pixel || source == this->PointSources.end() || !source->second->picture ||
      source->second->ask.key.frame != this->frame() || !source->second->picture->exact(pixel->x(), pixel->y()))
  {
    return std::nullopt;
  }
  return worldPoint(*this->Dataset, source->second->ask.key, *source->second->picture, pixel->x(), pixel->y());
}

void DatasetViewer::refreshReadOut()
{
  std::vector<ReadOut::Row> rows;
  for (PicturePane* pane : this->panes())
  {
    const auto point = this->Dataset ? this->worldUnder(pane->camera().toStdString()) : std::nullopt;
    const QString own = this->Dataset ? pane->world(*this->Dataset) : QString();
    const QString value = this->Dataset ? pane->value(*this->Dataset) : QString();
    pane->view().setReadOut(value);
    rows.push_back({ pane->camera(), pane->layer(), value, own.isEmpty() && point ? text(pointText(*point)) : own });
  }
  this->Numbers->showRows(this->Sync->cursor(), rows);
  const PicturePane* const active = this->activePane();
  this->Cloud->setMarker(this->Dataset && active ? this->worldUnder(active->camera().toStdString()) : std::nullopt);
}

void DatasetViewer::refreshCloudCameras()
{
  const PicturePane* const active = this->activePane();
  if (!this->Dataset || active == nullptr)
  {
    return;
  }
  std::vector<View> views;
  for (const CameraRecord& record : this->Dataset->records())
  {
    try
    {
      if (record.frame == this->frame())
      {
        views.push_back(viewOf(record));
      }
    }
    catch (const std::exception& error)
    {
      this->CloudText->setText(QString::fromUtf8(error.what()));
    }
  }
  this->Cloud->setCameras(views, active->camera().toStdString());
}

void DatasetViewer::refreshCalibration()
{
  const PicturePane* const active = this->activePane();
  if (this->Dataset && active && this->CalibrationDock->isVisible())
  {
    this->Calibration->setPlainText(cameraText(*this->Dataset, active->camera().toStdString(), this->frame()));
  }
}

} // namespace dgtk
