// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPicturePane.h"

#include "dgtkLegendBar.h"
#include "dgtkPixelText.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QSpinBox>
#include <QVBoxLayout>

namespace dgtk
{

namespace
{
constexpr int narrowestCombo = 44; // widget units

QComboBox* makeCombo(const char* name, const QString& tip, QWidget* parent)
{
  auto* combo = new QComboBox(parent);
  combo->setObjectName(name);
  combo->setToolTip(tip);
  combo->setAccessibleName(tip);
  // panes side by side have one size, whatever the names in them
  combo->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  combo->setMinimumWidth(narrowestCombo);
  QObject::connect(combo, &QComboBox::currentTextChanged, combo,
    [combo, tip](const QString& chosen) { combo->setToolTip(tip + ": " + chosen); });
  return combo;
}
} // namespace

PicturePane::PicturePane(int number, PictureSync& sync, QWidget* parent)
  : QFrame(parent)
  , Number(number)
  , Sync(sync)
  , Camera(makeCombo("camera", tr("Camera of this picture"), this))
  , Layer(makeCombo("layer", tr("Layer of this picture"), this))
  , Surface(new QSpinBox(this))
  , View(new PictureView(sync, this))
  , Legend(new LegendBar(this))
{
  this->setObjectName(QString("pane.%1").arg(number));
  this->View->setObjectName(QString("picture.%1").arg(number));
  this->Surface->setObjectName("surface");
  this->Surface->setRange(1, 99);
  this->Surface->setPrefix(tr("no. "));
  this->Surface->setToolTip(tr("Which surface along each ray, from the nearest"));
  auto* head = new QHBoxLayout;
  head->setContentsMargins(0, 0, 0, 0);
  head->setSpacing(3);
  head->addWidget(this->Camera, 1);
  head->addWidget(this->Layer, 2);
  head->addWidget(this->Surface);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(2, 2, 2, 2);
  layout->setSpacing(2);
  layout->addLayout(head);
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
      this->Surface->setVisible(this->layer() == "ldi color" || this->layer() == "ldi depth");
      emit this->changed();
    });
  connect(this->Surface, QOverload<int>::of(&QSpinBox::valueChanged), this, &PicturePane::changed);
  connect(this->Legend, &LegendBar::rangeAsked, this, &PicturePane::rangeAsked);
  this->Surface->hide();
}

QString PicturePane::camera() const { return this->Camera->currentText(); }
QString PicturePane::layer() const { return this->Layer->currentText(); }
int PicturePane::surface() const { return this->Surface->isVisibleTo(this) ? this->Surface->value() - 1 : 0; }

void PicturePane::setDataset(const std::shared_ptr<const DatasetPictures>& dataset)
{
  this->Dataset = dataset;
  const QSignalBlocker quiet(this->Camera);
  this->Camera->clear();
  for (const std::string& name : dataset->cameras())
  {
    this->Camera->addItem(QString::fromStdString(name));
  }
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
  this->Surface->setVisible(this->layer() == "ldi color" || this->layer() == "ldi depth");
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
  this->Surface->setVisible(this->layer() == "ldi color" || this->layer() == "ldi depth");
}

void PicturePane::showPicture(const ShownPointer& shown, bool chosen)
{
  this->View->showPicture(shown);
  this->Legend->setPicture(shown && shown->picture ? shown : nullptr, chosen);
  if (shown && shown->picture && shown->picture->surfaces > 0)
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
