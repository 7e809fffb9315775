// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPicturePane.h"

#include "dgtkLegendBar.h"
#include "dgtkNameCombo.h"
#include "dgtkNumberBox.h"
#include "dgtkPixelText.h"

#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include <algorithm>
#include <limits>

namespace dgtk
{

namespace
{
constexpr int headSpacing = 3;   // widget units
constexpr int mostSurfaces = 99; // until a picture tells its own

/// The largest number of an object that can be asked for. Objects are in the order of their ids.
int largestObject(const std::vector<ObjectRecord>& objects)
{
  constexpr std::uint32_t largest = std::numeric_limits<int>::max();
  return objects.empty() ? mostSurfaces : static_cast<int>(std::clamp<std::uint32_t>(objects.back().id, 1, largest));
}
} // namespace

PicturePane::PicturePane(int number, PictureSync& sync, QWidget* parent)
  : QFrame(parent)
  , Number(number)
  , Sync(sync)
  , Camera(new NameCombo("camera", tr("Camera of this picture"), this))
  , Layer(new NameCombo("layer", tr("Layer of this picture"), this))
  , Surface(new NumberBox<QSpinBox>(this))
  , View(new PictureView(sync, this))
  , Legend(new LegendBar(this))
{
  this->setObjectName(QString("pane.%1").arg(number));
  this->View->setObjectName(QString("picture.%1").arg(number));
  this->Surface->setObjectName("surface");
  this->Surface->setRange(1, mostSurfaces);
  this->Surface->setPrefix(tr("no. "));
  this->Surface->setToolTip(tr("Which surface along each ray, from the nearest"));
  auto* layer = new QHBoxLayout;
  layer->setSpacing(headSpacing);
  layer->addWidget(this->Layer, 1);
  layer->addWidget(this->Surface);
  this->Head = new QBoxLayout(QBoxLayout::LeftToRight);
  this->Head->setContentsMargins(0, 0, 0, 0);
  this->Head->setSpacing(headSpacing);
  this->Head->addWidget(this->Camera);
  this->Head->addLayout(layer);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(2, 2, 2, 2);
  layout->setSpacing(2);
  layout->addLayout(this->Head);
  layout->addWidget(this->View, 1);
  layout->addWidget(this->Legend);
  connect(this->Camera, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
    [this]
    {
      this->fillLayers();
      emit this->changed();
    });
  connect(this->Layer, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
    [this]
    {
      this->showSurface();
      emit this->changed();
    });
  connect(this->Surface, QOverload<int>::of(&QSpinBox::valueChanged), this, &PicturePane::changed);
  connect(this->Legend, &LegendBar::rangeAsked, this, &PicturePane::rangeAsked);
  this->Surface->hide();
}

QString PicturePane::camera() const { return this->Camera->currentText(); }
QString PicturePane::layer() const { return this->Layer->currentText(); }
int PicturePane::surface() const { return this->Surface->isVisibleTo(this) ? this->Surface->value() - 1 : 0; }

int PicturePane::wholeWidth(bool stacked) const
{
  const QMargins margins = this->layout()->contentsMargins();
  const int names = stacked ? std::max(this->CameraWidth, this->LayerWidth)
                            : this->CameraWidth + headSpacing + this->LayerWidth + 1; // one for rounding
  return names + margins.left() + margins.right() + 2 * this->frameWidth();
}

void PicturePane::setStacked(bool on)
{
  this->Head->setDirection(on ? QBoxLayout::TopToBottom : QBoxLayout::LeftToRight);
}

void PicturePane::setDataset(const std::shared_ptr<const DatasetPictures>& dataset)
{
  this->Dataset = dataset;
  const QSignalBlocker quiet(this->Camera);
  this->Camera->clear();
  for (const std::string& name : dataset->cameras())
  {
    this->Camera->addItem(QString::fromStdString(name));
  }
  this->CameraWidth = this->Camera->wholeWidth();
  this->fillLayers();
}

void PicturePane::fillLayers()
{
  const QSignalBlocker quiet(this->Layer);
  const QString before = this->layer();
  this->Layer->clear();
  for (const std::string& label : this->Dataset->layersOf(this->camera().toStdString()))
  {
    this->Layer->addItem(QString::fromStdString(label));
  }
  this->Layer->setCurrentIndex(std::max(0, this->Layer->findText(before)));
  this->LayerWidth = this->Layer->wholeWidth();
  this->Head->setStretch(0, this->CameraWidth);
  this->Head->setStretch(1, this->LayerWidth);
  this->showSurface();
}

void PicturePane::showSurface()
{
  const PictureLayer* const layer = this->Dataset->layer(this->layer().toStdString());
  const bool amodal = layer != nullptr && isObjectMask(*layer);
  const bool surfaces = layer != nullptr && !layer->part.empty() && layer->spec.meaning != Meaning::Surfaces;
  this->Surface->setVisible(amodal || surfaces);
  this->Surface->setToolTip(
    amodal ? tr("Which object, by its id") : tr("Which surface along each ray, from the nearest"));
  const QSignalBlocker quiet(this->Surface); // whoever changed the layer tells it
  this->Surface->setMaximum(amodal ? largestObject(this->Dataset->objects()) : mostSurfaces);
}

void PicturePane::choose(const QString& camera, const QString& layer)
{
  const QSignalBlocker quietCamera(this->Camera);
  const QSignalBlocker quietLayer(this->Layer);
  const int cameraAt = this->Camera->findText(camera);
  this->Camera->setCurrentIndex(cameraAt < 0 ? this->Camera->currentIndex() : cameraAt);
  this->fillLayers();
  const int layerAt = this->Layer->findText(layer);
  this->Layer->setCurrentIndex(layerAt < 0 ? this->Layer->currentIndex() : layerAt);
  this->showSurface();
}

void PicturePane::showPicture(const ShownPointer& shown, bool chosen)
{
  this->View->showPicture(shown);
  this->Legend->setPicture(shown && shown->picture ? shown : nullptr, chosen);
  if (shown && shown->picture && shown->picture->ldi && shown->picture->surfaces > 0)
  {
    this->Surface->setMaximum(shown->picture->surfaces);
  }
}

QString PicturePane::value(const DatasetPictures& dataset) const
{
  const std::optional<QPoint>& pixel = this->Sync.cursor();
  const PictureValues* const picture = pixel ? this->View->pictureAt(*pixel) : nullptr;
  if (picture == nullptr)
  {
    return {};
  }
  const QString text = QString::fromStdString(valueText(dataset, *picture, pixel->x(), pixel->y()));
  return picture->exact(pixel->x(), pixel->y()) || text.isEmpty() ? text : tr("%1 (nearby; zoom in)").arg(text);
}

QString PicturePane::world(const DatasetPictures& dataset) const
{
  const std::optional<QPoint>& pixel = this->Sync.cursor();
  const PictureValues* const picture = pixel ? this->View->pictureAt(*pixel) : nullptr;
  if (picture == nullptr || !picture->exact(pixel->x(), pixel->y()))
  {
    return {};
  }
  const auto point = worldPoint(dataset, this->View->shown()->ask.key, *picture, pixel->x(), pixel->y());
  return point ? QString::fromStdString(pointText(*point)) : QString();
}

} // namespace dgtk
