// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetViewer.h"

#include "dgtkCameraText.h"
#include "dgtkCloudView.h"
#include "dgtkPicturePane.h"
#include "dgtkPixelText.h"

#include <QAction>
#include <QDockWidget>
#include <QFileInfo>
#include <QGridLayout>
#include <QHeaderView>
#include <QLabel>
#include <QMessageBox>
#include <QPlainTextEdit>
#include <QScrollArea>
#include <QSlider>
#include <QStackedWidget>
#include <QStatusBar>
#include <QTableWidget>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr std::uint64_t pictureBytes = std::uint64_t(256) << 20; // of all panes together
constexpr int statusTime = 8000;
constexpr int narrowestPane = 190; // widget units
constexpr int widestName = 400;    // for which a pane is made wider
constexpr int lowestView = 90;     // small panes are scrolled, so that they are not flat

QString text(const std::string& name) { return QString::fromStdString(name); }
} // namespace

void DatasetViewer::openFolder(const QString& folder)
{
  this->statusBar()->showMessage(tr("Opening %1 ...").arg(folder));
  this->Loader->open(folder);
}

void DatasetViewer::showDataset(const std::shared_ptr<const DatasetPictures>& dataset)
{
  this->Play->setChecked(false);
  this->Dataset = dataset;
  this->Ranges.clear();
  this->PointSources.clear();
  this->Sync->setCursor(std::nullopt);
  this->Sync->fitting = true;
  this->CloudFramed = false;
  this->Cloud->reset(dataset->upAxis());
  this->Frames->setRange(0, static_cast<int>(dataset->frames().size()) - 1);
  this->Frames->setValue(0);
  for (PicturePane* pane : this->Panes)
  {
    pane->setDataset(dataset);
  }
  this->Pages->setCurrentIndex(1);
  this->setWindowTitle(tr("%1 - DGTk dataset").arg(QFileInfo(text(dataset->folder())).fileName()));
  this->setPaneCount(static_cast<int>(std::min<std::size_t>(4, dataset->layers().size())));
  this->chooseFirstLayers();
  this->enableActions(true);
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
  for (std::size_t i = 0; i < this->Panes.size() && i < labels.size(); ++i)
  {
    this->Panes[i]->choose(camera, text(labels[i]));
  }
}

void DatasetViewer::showRefusal(const QString& message)
{
  this->statusBar()->clearMessage();
  this->EmptyText->setText(
    tr("<p>%1</p><p>Open the folder that <i>dgtk render</i> wrote.</p>").arg(message.toHtmlEscaped()));
  QMessageBox box(QMessageBox::Warning, tr("DGTk"), message, QMessageBox::Ok, this);
  box.setObjectName("errorBox");
  box.exec();
  emit this->refused(message);
}

void DatasetViewer::setPaneCount(int count)
{
  while (static_cast<int>(this->Panes.size()) > count)
  {
    this->Loader->drop(this->Panes.back()->number());
    delete this->Panes.back();
    this->Panes.pop_back();
  }
  while (static_cast<int>(this->Panes.size()) < count)
  {
    this->Panes.push_back(this->makePane(static_cast<int>(this->Panes.size())));
  }
  this->Maximized = -1;
  this->Loader->setBudget(pictureBytes / std::uint64_t(std::max(4, count)));
  this->setActive(std::min(this->Active, count - 1));
  this->layOut();
}

PicturePane* DatasetViewer::makePane(int number)
{
  auto* pane = new PicturePane(number, *this->Sync, this->Grid);
  if (this->Dataset)
  {
    const std::vector<std::string> labels = this->Dataset->layersOf(this->Dataset->cameras().front());
    pane->setDataset(this->Dataset);
    pane->choose(this->Panes.empty() ? QString() : this->Panes.front()->camera(),
      text(labels[std::size_t(number) % labels.size()]));
  }
  connect(pane, &PicturePane::changed, this,
    [this, pane]
    {
      this->setActive(pane->number());
      this->askPane(*pane);
      this->askPoints();
      this->askOverlays();
      this->refreshCalibration();
    });
  connect(pane, &PicturePane::rangeAsked, this, [this, pane](const auto& range) { this->setRange(*pane, range); });
  connect(&pane->view(), &PictureView::activated, this, [this, pane] { this->setActive(pane->number()); });
  connect(&pane->view(), &PictureView::maximizeAsked, this, [this, pane] { this->maximize(pane->number()); });
  connect(&pane->view(), &PictureView::resized, this, &DatasetViewer::refreshArea);
  connect(&pane->view(), &PictureView::detailWanted, this,
    [this, pane](const PixelRect& window, int step)
    {
      PictureAsk ask = this->askOf(*pane, this->frame());
      ask.window = window;
      ask.step = step;
      this->Loader->ask(detailSlots + pane->number(), ask);
    });
  return pane;
}

int DatasetViewer::columns() const
{
  int width = narrowestPane;
  for (const PicturePane* pane : this->Panes)
  {
    width = std::max(width, std::min(pane->wholeWidth(true), widestName));
  }
  const int shown = this->Maximized < 0 ? static_cast<int>(this->Panes.size()) : 1;
  return std::min(std::max(1, this->Scroll->width() / width), static_cast<int>(std::ceil(std::sqrt(double(shown)))));
}

/// All panes alike, so that pictures side by side have one size.
void DatasetViewer::stackNames()
{
  const bool stacked = std::any_of(this->Panes.begin(), this->Panes.end(),
    [this](const PicturePane* pane) { return pane->isVisibleTo(this) && pane->width() < pane->wholeWidth(false); });
  for (PicturePane* pane : this->Panes)
  {
    pane->setStacked(stacked);
  }
}

void DatasetViewer::layOut()
{
  auto* grid = static_cast<QGridLayout*>(this->Grid->layout());
  const int columns = this->Columns = this->columns();
  int place = 0;
  for (PicturePane* pane : this->Panes)
  {
    const bool visible = this->Maximized < 0 || pane->number() == this->Maximized;
    pane->setVisible(visible);
    grid->removeWidget(pane);
    if (visible)
    {
      grid->addWidget(pane, place / columns, place % columns);
      ++place;
    }
  }
  for (int i = 0; i < std::max(grid->columnCount(), grid->rowCount()); ++i)
  {
    grid->setColumnStretch(i, i < columns ? 1 : 0);
    grid->setRowStretch(i, i < (place + columns - 1) / columns ? 1 : 0);
  }
  this->setLowest();
  this->refreshReadOut();
}

/// Panes that are scrolled have a height that goes with their width.
void DatasetViewer::setLowest()
{
  const bool scrolled = this->Maximized < 0 && int(this->Panes.size()) > 2 * this->Columns;
  const int lowest = std::max(lowestView, scrolled ? this->Scroll->width() / this->Columns * 3 / 5 : 0);
  for (PicturePane* pane : this->Panes)
  {
    pane->view().setMinimumHeight(lowest);
  }
}

void DatasetViewer::maximize(int pane)
{
  this->Maximized = this->Maximized < 0 ? pane : -1;
  this->layOut();
}

void DatasetViewer::setActive(int pane)
{
  const bool changed = this->Active != pane;
  this->Active = std::max(0, pane);
  for (PicturePane* other : this->Panes)
  {
    other->view().setActive(other->number() == this->Active);
  }
  if (changed)
  {
    this->refreshCloudCameras();
    this->refreshCalibration();
    this->CloudTimer.start();
  }
}

PicturePane* DatasetViewer::activePane() const
{
  return this->Panes.empty() ? nullptr
                             : this->Panes[std::size_t(std::min<int>(this->Active, int(this->Panes.size()) - 1))];
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
  this->ReadOut->setRowCount(static_cast<int>(this->Panes.size()));
  const std::optional<QPoint>& pixel = this->Sync->cursor();
  this->PixelText->setText(
    pixel ? tr("Pixel (%1, %2)").arg(pixel->x()).arg(pixel->y()) : tr("Point at a picture to read its numbers."));
  for (PicturePane* pane : this->Panes)
  {
    const auto point = this->Dataset ? this->worldUnder(pane->camera().toStdString()) : std::nullopt;
    const QString own = this->Dataset ? pane->world(*this->Dataset) : QString();
    const QString value = this->Dataset ? pane->value(*this->Dataset) : QString();
    pane->view().setReadOut(value);
    const QString cells[] = { pane->camera(), pane->layer(), value,
      !own.isEmpty() ? own
      : point        ? text(pointText(*point))
                     : QString() };
    for (int column = 0; column < 4; ++column)
    {
      QTableWidgetItem* item = this->ReadOut->item(pane->number(), column);
      if (item == nullptr)
      {
        item = new QTableWidgetItem;
        this->ReadOut->setItem(pane->number(), column, item);
      }
      item->setText(cells[column]);
      item->setToolTip(cells[column]);
    }
  }
  this->fitReadOut();
  const PicturePane* const active = this->activePane();
  this->Cloud->setMarker(this->Dataset && active ? this->worldUnder(active->camera().toStdString()) : std::nullopt);
}

void DatasetViewer::fitReadOut()
{
  const QAbstractItemView* const view = this->ReadOut; // whose hints are public
  const QHeaderView* const header = this->ReadOut->horizontalHeader();
  for (const int column : { 0, 1 })
  {
    const int whole = std::max(view->sizeHintForColumn(column), header->sectionSizeHint(column));
    this->ReadOut->setColumnWidth(column, std::min(whole, this->ReadOut->width() / 4));
  }
}

void DatasetViewer::refreshArea()
{
  if (this->columns() != this->Columns)
  {
    this->layOut();
  }
  this->setLowest();
  this->stackNames();
  Eigen::Vector2d area(1e9, 1e9);
  for (const PicturePane* pane : this->Panes)
  {
    if (pane->isVisibleTo(this))
    {
      area = area.cwiseMin(Eigen::Vector2d(pane->view().width(), pane->view().height()));
    }
  }
  this->Sync->area = area;
  if (this->Sync->fitting)
  {
    this->fit();
  }
  this->Sync->changeZoom();
}

void DatasetViewer::fit()
{
  Eigen::Vector2d image(0, 0);
  for (const PicturePane* pane : this->Panes)
  {
    image = image.cwiseMax(pane->view().imageSize());
  }
  if (image.x() > 0)
  {
    this->Sync->fitting = true;
    this->Sync->zoom.fit(image, this->Sync->area);
    this->Sync->changeZoom();
  }
}

void DatasetViewer::zoom(double factor)
{
  const Eigen::Vector2d& area = this->Sync->area;
  const std::optional<QPoint>& pixel = this->Sync->cursor();
  const Eigen::Vector2d at =
    pixel ? this->Sync->zoom.toWidget({ pixel->x() + 0.5, pixel->y() + 0.5 }, area) : Eigen::Vector2d(area / 2);
  this->Sync->fitting = false;
  this->Sync->zoom.zoomBy(factor, at, area);
  this->Sync->changeZoom();
}

void DatasetViewer::actualSize() { this->zoom(1 / (this->Sync->zoom.scale() * this->devicePixelRatioF())); }

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
