// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRenderDialog.h"

#include "dgtkGenerator.h"

#include <QCheckBox>
#include <QDesktopServices>
#include <QDir>
#include <QGridLayout>
#include <QGroupBox>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QSlider>
#include <QSpinBox>
#include <QUrl>
#include <QVBoxLayout>

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr int largestImage = 1 << 20;
constexpr int largestSlider = 8192; // sliders stay usable; the numbers go further
constexpr int layerColumns = 3;
constexpr int mostSamples = 16;

QSpinBox* makeNumber(QWidget* parent, const QString& name, int least, int most, int value)
{
  auto* box = new QSpinBox(parent);
  box->setObjectName(name);
  box->setRange(least, most);
  box->setValue(value);
  box->setKeyboardTracking(false);
  return box;
}
} // namespace

QWidget* RenderDialog::makeInfo()
{
  this->Info = new QLabel;
  this->Info->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  this->Info->setMargin(12);
  this->Info->setWordWrap(true);
  return this->Info;
}

void RenderDialog::addSizeRow(QGridLayout* grid, int row, const QString& label, const QString& name, int axis)
{
  this->Sliders[axis] = new QSlider(Qt::Horizontal);
  this->Sliders[axis]->setRange(1, largestSlider);
  this->Sliders[axis]->setPageStep(64);
  this->Size[axis] = makeNumber(nullptr, name, 1, largestImage, axis == 0 ? 640 : 480);
  this->Sliders[axis]->setValue(this->Size[axis]->value());
  grid->addWidget(new QLabel(label), row, 0);
  grid->addWidget(this->Sliders[axis], row, 1);
  grid->addWidget(this->Size[axis], row, 2);
  connect(this->Sliders[axis], &QSlider::valueChanged, this->Size[axis], &QSpinBox::setValue);
  connect(this->Size[axis], QOverload<int>::of(&QSpinBox::valueChanged), this,
    [this, axis](int value)
    {
      const bool blocked = this->Sliders[axis]->blockSignals(true);
      this->Sliders[axis]->setValue(std::min(value, largestSlider));
      this->Sliders[axis]->blockSignals(blocked);
      this->takeSize();
    });
}

QWidget* RenderDialog::makeCameras()
{
  auto* page = new QWidget;
  auto* layout = new QVBoxLayout(page);
  layout->addWidget(new QLabel(tr("Cameras to render:")));
  this->Cameras = new QListWidget;
  this->Cameras->setObjectName("cameras");
  layout->addWidget(this->Cameras, 1);
  this->OwnSize = new QCheckBox(tr("Every camera in its own size: that of the chosen one is"));
  this->OwnSize->setObjectName("ownSize");
  this->OwnSize->setChecked(true);
  layout->addWidget(this->OwnSize);
  auto* grid = new QGridLayout;
  this->addSizeRow(grid, 0, tr("Width"), "width", 0);
  this->addSizeRow(grid, 1, tr("Height"), "height", 1);
  layout->addLayout(grid);
  this->Resolution = new QLabel;
  this->Resolution->setObjectName("resolution");
  this->Resolution->setWordWrap(true);
  this->Resolution->setMinimumHeight(3 * this->fontMetrics().height());
  layout->addWidget(this->Resolution);
  connect(this->OwnSize, &QCheckBox::toggled, this, &RenderDialog::showResolution);
  connect(this->Cameras, &QListWidget::currentRowChanged, this,
    [this]
    {
      this->State.document().finishMerging();
      this->showResolution();
    });
  return page;
}

QWidget* RenderDialog::makeControls()
{
  auto* page = new QWidget;
  auto* layout = new QVBoxLayout(page);
  auto* group = new QGroupBox(tr("Layers"));
  auto* groupLayout = new QVBoxLayout(group);
  auto* area = new QScrollArea;
  area->setWidgetResizable(true);
  area->setFrameShape(QFrame::NoFrame);
  auto* boxes = new QWidget;
  auto* grid = new QGridLayout(boxes);
  grid->setContentsMargins(0, 0, 0, 0);
  const std::vector<LayerInfo> layers = generatorLayers();
  const int rows = (int(layers.size()) + layerColumns - 1) / layerColumns;
  const QStringList usual{ "color", "depth", "objects", "calibration" };
  for (int i = 0; i < int(layers.size()); ++i)
  {
    const LayerInfo& layer = layers[std::size_t(i)];
    auto* box = new QCheckBox(toText(layer.layer));
    box->setObjectName("layer." + toText(layer.layer));
    box->setToolTip(toText(layer.description));
    box->setChecked(usual.contains(box->text()));
    grid->addWidget(box, i % rows, i / rows);
    this->Layers.push_back(box);
  }
  grid->setRowStretch(rows, 1);
  area->setWidget(boxes);
  boxes->setAutoFillBackground(false);
  area->viewport()->setAutoFillBackground(false);
  groupLayout->addWidget(area);
  layout->addWidget(group, 1);

  auto* numbers = new QGridLayout;
  this->Tile[0] = makeNumber(nullptr, "tileWidth", 1, largestImage, 640);
  this->Tile[1] = makeNumber(nullptr, "tileHeight", 1, largestImage, 480);
  this->Frames[0] = makeNumber(nullptr, "firstFrame", 0, largestFrame, 0);
  this->Frames[1] = makeNumber(nullptr, "lastFrame", 0, largestFrame, 0);
  this->Frames[2] = makeNumber(nullptr, "frameStep", 1, largestFrame, 1);
  this->Samples = makeNumber(nullptr, "samples", 1, mostSamples, 1);
  const auto put = [numbers](int row, int column, const QString& label, QWidget* field)
  {
    numbers->addWidget(new QLabel(label), row, 2 * column);
    numbers->addWidget(field, row, 2 * column + 1);
  };
  put(0, 0, tr("Tile width"), this->Tile[0]);
  put(0, 1, tr("Tile height"), this->Tile[1]);
  put(0, 2, tr("Samples a side"), this->Samples);
  put(1, 0, tr("First frame"), this->Frames[0]);
  put(1, 1, tr("Last frame"), this->Frames[1]);
  put(1, 2, tr("Every"), this->Frames[2]);
  layout->addLayout(numbers);
  return page;
}

void RenderDialog::makeRunRow(QVBoxLayout* layout)
{
  auto* folder = new QHBoxLayout;
  folder->addWidget(new QLabel(tr("Folder")));
  this->Folder = new QLineEdit(this->usualFolder());
  this->Folder->setObjectName("folder");
  folder->addWidget(this->Folder, 1);
  this->Browse = new QPushButton(tr("Browse ..."));
  this->Browse->setAutoDefault(false);
  folder->addWidget(this->Browse);
  layout->addLayout(folder);

  this->Resume = new QCheckBox(tr("Go on with an interrupted run of the same request"));
  this->Resume->setObjectName("resume");
  layout->addWidget(this->Resume);
  this->Progress = new QProgressBar;
  this->Progress->setObjectName("progress");
  this->Progress->setRange(0, 1);
  this->Progress->setValue(0);
  layout->addWidget(this->Progress);
  this->Status = new QLabel;
  this->Status->setObjectName("status");
  this->Status->setWordWrap(true);
  layout->addWidget(this->Status);

  auto* buttons = new QHBoxLayout;
  this->Result = new QPushButton(tr("Look at the result"));
  this->Result->setObjectName("openResult");
  this->Result->setAutoDefault(false);
  this->Open = new QPushButton(tr("Open the folder"));
  this->Open->setAutoDefault(false);
  this->Start = new QPushButton(tr("Start"));
  this->Start->setObjectName("start");
  this->Start->setDefault(true);
  this->Cancel = new QPushButton(tr("Cancel"));
  this->Cancel->setObjectName("cancel");
  this->Cancel->setAutoDefault(false);
  auto* close = new QPushButton(tr("Close"));
  close->setAutoDefault(false);
  buttons->addWidget(this->Result);
  buttons->addWidget(this->Open);
  buttons->addStretch(1);
  for (QPushButton* button : { this->Start, this->Cancel, close })
  {
    buttons->addWidget(button);
  }
  layout->addLayout(buttons);
  connect(this->Browse, &QPushButton::clicked, this, &RenderDialog::browse);
  connect(this->Start, &QPushButton::clicked, this, &RenderDialog::start);
  connect(this->Cancel, &QPushButton::clicked, &this->Process, &RenderProcess::cancel);
  connect(close, &QPushButton::clicked, this, &RenderDialog::reject);
  connect(this->Result, &QPushButton::clicked, this, [this] { emit this->resultAsked(this->Folder->text()); });
  connect(this->Folder, &QLineEdit::textChanged, this, [this] { this->setRunning(!this->Start->isEnabled()); });
  connect(this->Open, &QPushButton::clicked, this,
    [this] { QDesktopServices::openUrl(QUrl::fromLocalFile(this->Folder->text())); });
}

} // namespace dgtk
