// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPaneGrid.h"

#include <QAbstractSpinBox>
#include <QGridLayout>
#include <QLineEdit>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr int narrowestPane = 190; // widget units
constexpr int widestName = 400;    // for which a pane is made wider
constexpr int lowestView = 90;     // small panes are scrolled, so that they are not flat
} // namespace

PaneGrid::PaneGrid(PictureSync& sync, QWidget* parent)
  : QScrollArea(parent)
  , Sync(sync)
{
  auto* inner = new QWidget;
  this->Grid = new QGridLayout(inner);
  this->Grid->setContentsMargins(0, 0, 0, 0);
  this->Grid->setSpacing(4);
  this->setWidget(inner);
  this->setWidgetResizable(true);
  this->setFrameShape(QFrame::NoFrame);
}

void PaneGrid::setDataset(const std::shared_ptr<const DatasetPictures>& dataset)
{
  this->Dataset = dataset;
  for (PicturePane* pane : this->Panes)
  {
    pane->setDataset(dataset);
  }
}

void PaneGrid::setCount(int count)
{
  while (static_cast<int>(this->Panes.size()) > count)
  {
    emit this->dropped(this->Panes.back()->number());
    delete this->Panes.back();
    this->Panes.pop_back();
  }
  while (static_cast<int>(this->Panes.size()) < count)
  {
    this->Panes.push_back(this->makePane(static_cast<int>(this->Panes.size())));
  }
  this->Maximized = -1;
  this->setActive(std::min(this->Active, count - 1));
  this->layOut();
}

PicturePane* PaneGrid::makePane(int number)
{
  auto* pane = new PicturePane(number, this->Sync, this->widget());
  if (this->Dataset)
  {
    const std::vector<std::string> labels = this->Dataset->layersOf(this->Dataset->cameras().front());
    pane->setDataset(this->Dataset);
    pane->choose(this->Panes.empty() ? QString() : this->Panes.front()->camera(),
      QString::fromStdString(labels[std::size_t(number) % labels.size()]));
  }
  connect(pane, &PicturePane::changed, this,
    [this, pane]
    {
      this->setActive(pane->number());
      emit this->chosen(pane);
    });
  connect(
    pane, &PicturePane::rangeAsked, this, [this, pane](const auto& range) { emit this->rangeAsked(pane, range); });
  connect(&pane->view(), &PictureView::activated, this, [this, pane] { this->setActive(pane->number()); });
  connect(&pane->view(), &PictureView::pointed, this, &PaneGrid::takeKeys);
  connect(&pane->view(), &PictureView::maximizeAsked, this, [this, pane] { this->maximize(pane->number()); });
  connect(&pane->view(), &PictureView::resized, this, &PaneGrid::refreshArea);
  connect(&pane->view(), &PictureView::detailWanted, this,
    [this, pane](const PixelRect& window, int step) { emit this->detailWanted(pane, window, step); });
  return pane;
}

int PaneGrid::columns() const
{
  int width = narrowestPane;
  for (const PicturePane* pane : this->Panes)
  {
    width = std::max(width, std::min(pane->wholeWidth(true), widestName));
  }
  const int shown = this->Maximized < 0 ? static_cast<int>(this->Panes.size()) : 1;
  return std::min(std::max(1, this->width() / width), static_cast<int>(std::ceil(std::sqrt(double(shown)))));
}

/// All panes alike, so that pictures side by side have one size.
void PaneGrid::stackNames()
{
  const bool stacked = std::any_of(this->Panes.begin(), this->Panes.end(),
    [this](const PicturePane* pane) { return pane->isVisibleTo(this) && pane->width() < pane->wholeWidth(false); });
  for (PicturePane* pane : this->Panes)
  {
    pane->setStacked(stacked);
  }
}

void PaneGrid::layOut()
{
  const int columns = this->Columns = this->columns();
  int place = 0;
  for (PicturePane* pane : this->Panes)
  {
    const bool visible = this->Maximized < 0 || pane->number() == this->Maximized;
    pane->setVisible(visible);
    this->Grid->removeWidget(pane);
    if (visible)
    {
      this->Grid->addWidget(pane, place / columns, place % columns);
      ++place;
    }
  }
  for (int i = 0; i < std::max(this->Grid->columnCount(), this->Grid->rowCount()); ++i)
  {
    this->Grid->setColumnStretch(i, i < columns ? 1 : 0);
    this->Grid->setRowStretch(i, i < (place + columns - 1) / columns ? 1 : 0);
  }
  this->setLowest();
  emit this->arranged();
}

/// Panes that are scrolled have a height that goes with their width.
void PaneGrid::setLowest()
{
  const bool scrolled = this->Maximized < 0 && int(this->Panes.size()) > 2 * this->Columns;
  const int lowest = std::max(lowestView, scrolled ? this->width() / this->Columns * 3 / 5 : 0);
  for (PicturePane* pane : this->Panes)
  {
    pane->view().setMinimumHeight(lowest);
  }
}

void PaneGrid::maximize(int pane)
{
  this->Maximized = this->Maximized < 0 ? pane : -1;
  this->layOut();
}

void PaneGrid::setActive(int pane)
{
  const bool changed = this->Active != pane;
  this->Active = std::max(0, pane);
  for (PicturePane* other : this->Panes)
  {
    other->view().setActive(other->number() == this->Active);
  }
  if (changed)
  {
    emit this->activated();
  }
}

void PaneGrid::takeKeys()
{
  QWidget* const focus = this->window()->focusWidget();
  const bool isTyped = qobject_cast<QLineEdit*>(focus) != nullptr || qobject_cast<QAbstractSpinBox*>(focus) != nullptr;
  if (qobject_cast<PictureView*>(focus) == nullptr && !isTyped && this->active() != nullptr)
  {
    this->active()->view().setFocus();
  }
}

PicturePane* PaneGrid::active() const
{
  return this->Panes.empty() ? nullptr
                             : this->Panes[std::size_t(std::min<int>(this->Active, int(this->Panes.size()) - 1))];
}

void PaneGrid::refreshArea()
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
  this->Sync.area = area;
  if (this->Sync.fitting)
  {
    this->fit();
  }
  this->Sync.changeZoom();
}

void PaneGrid::fit()
{
  Eigen::Vector2d image(0, 0);
  for (const PicturePane* pane : this->Panes)
  {
    image = image.cwiseMax(pane->view().imageSize());
  }
  if (image.x() > 0)
  {
    this->Sync.fitting = true;
    this->Sync.zoom.fit(image, this->Sync.area);
    this->Sync.changeZoom();
  }
}

void PaneGrid::zoom(double factor)
{
  const Eigen::Vector2d& area = this->Sync.area;
  const std::optional<QPoint>& pixel = this->Sync.cursor();
  const Eigen::Vector2d at =
    pixel ? this->Sync.zoom.toWidget({ pixel->x() + 0.5, pixel->y() + 0.5 }, area) : Eigen::Vector2d(area / 2);
  this->Sync.fitting = false;
  this->Sync.zoom.zoomBy(factor, at, area);
  this->Sync.changeZoom();
}

void PaneGrid::actualSize() { this->zoom(1 / (this->Sync.zoom.scale() * this->devicePixelRatioF())); }

} // namespace dgtk
