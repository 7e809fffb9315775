// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRenderDialog.h"

#include "dgtkExporterEntry.h"
#include "dgtkGenerator.h"
#include "dgtkNumberBox.h"
#include "dgtkNumberRow.h"
#include "dgtkRenderCameras.h"
#include "dgtkRenderOptions.h"

#include <QCheckBox>
#include <QComboBox>
#include <QDesktopServices>
#include <QDir>
#include <QGridLayout>
#include <QGroupBox>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QSettings>
#include <QSpinBox>
#include <QUrl>
#include <QVBoxLayout>

namespace dgtk
{

namespace
{
constexpr int layerColumns = 3;
} // namespace

QWidget* RenderDialog::makeInfo()
{
  this->Info = new QLabel;
  this->Info->setAlignment(Qt::AlignTop | Qt::AlignLeft);
  this->Info->setMargin(12);
  this->Info->setWordWrap(true);
  return this->Info;
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
  QStringList usual;
  for (const LayerInfo& layer : layers)
  {
    usual += layer.usual ? QStringList(toText(layer.layer)) : QStringList();
  }
  const QStringList chosen = QSettings().value("render/layers", usual).toStringList();
  for (int i = 0; i < int(layers.size()); ++i)
  {
    const LayerInfo& layer = layers[std::size_t(i)];
    auto* box = new QCheckBox(toText(layer.layer));
    box->setObjectName("layer." + toText(layer.layer));
    box->setToolTip(toText(layer.description));
    box->setChecked(chosen.contains(box->text()));
    connect(box, &QCheckBox::toggled, this, [this] { this->Options->setLayers(this->checkedLayers()); });
    grid->addWidget(box, i % rows, i / rows);
    this->Layers.push_back(box);
  }
  grid->setRowStretch(rows, 1);
  area->setWidget(boxes);
  boxes->setAutoFillBackground(false);
  area->viewport()->setAutoFillBackground(false);
  groupLayout->addWidget(area);
  auto* choose = new QHBoxLayout;
  const auto addChoice = [&](const QString& name, const QString& text, bool on)
  {
    auto* button = new QPushButton(text);
    button->setObjectName(name);
    button->setAutoDefault(false);
    choose->addWidget(button);
    connect(button, &QPushButton::clicked, this,
      [this, on]
      {
        for (QCheckBox* box : this->Layers)
        {
          box->setChecked(on && box->isEnabled());
        }
      });
  };
  addChoice("allLayers", tr("&All"), true);
  addChoice("noLayers", tr("&None"), false);
  choose->addStretch(1);
  groupLayout->addLayout(choose);
  layout->addWidget(group, 1);

  auto* numbers = new QGridLayout;
  this->Frames[0] = makeNumber("firstFrame", 0, largestFrame, 0);
  this->Frames[1] = makeNumber("lastFrame", 0, largestFrame, 0);
  this->Frames[2] = makeNumber("frameStep", 1, largestFrame, 1);
  const auto put = [numbers](int row, int column, const QString& label, QWidget* field, const QString& says)
  {
    auto* caption = new QLabel(label);
    caption->setBuddy(field);
    caption->setToolTip(says);
    field->setToolTip(says);
    numbers->addWidget(caption, row, 2 * column);
    numbers->addWidget(field, row, 2 * column + 1);
  };
  put(0, 0, tr("&First frame"), this->Frames[0], tr("Until you choose another, the first of the scene"));
  put(0, 1, tr("&Last frame"), this->Frames[1], tr("Until you choose another, the last of the scene"));
  put(0, 2, tr("E&very"), this->Frames[2], tr("2 renders every second frame"));
  this->Export = new QComboBox;
  this->Export->setObjectName("for");
  this->Export->addItem(tr("none"), QString());
  for (const ExporterRow& row : exporterRows())
  {
    this->Export->addItem(toText(row.info.name), toText(row.info.name));
    this->Export->setItemData(this->Export->count() - 1, toText(row.info.description), Qt::ToolTipRole);
  }
  put(1, 0, tr("For e&xport"), this->Export, tr("Adds the layers and options that this export needs"));
  layout->addLayout(numbers);
  return page;
}

void RenderDialog::makeRunRow(QVBoxLayout* layout)
{
  auto* folder = new QHBoxLayout;
  auto* caption = new QLabel(tr("F&older"));
  folder->addWidget(caption);
  this->Folder = new QLineEdit(RunFolder::usual(this->State.document().path()));
  this->Folder->setObjectName("folder");
  caption->setBuddy(this->Folder);
  folder->addWidget(this->Folder, 1);
  this->Browse = new QPushButton(tr("&Browse ..."));
  this->Browse->setAutoDefault(false);
  folder->addWidget(this->Browse);
  layout->addLayout(folder);

  this->Resume = new QCheckBox(tr("Go on with an &interrupted run"));
  this->Resume->setObjectName("resume");
  this->Resume->setToolTip(tr("As it was begun: the choices above are for a new run"));
  layout->addWidget(this->Resume);
  this->Progress = new QProgressBar;
  this->Progress->setObjectName("progress");
  this->Progress->setRange(0, 1);
  this->Progress->setValue(0);
  layout->addWidget(this->Progress);
  this->Status = new QLabel;
  this->Status->setTextFormat(Qt::PlainText);
  this->Status->setObjectName("status");
  this->Status->setWordWrap(true);
  layout->addWidget(this->Status);
  tellIn(*this, *this->Status);

  auto* buttons = new QHBoxLayout;
  this->Result = new QPushButton(tr("Loo&k at the result"));
  this->Result->setObjectName("openResult");
  this->Result->setAutoDefault(false);
  this->Open = new QPushButton(tr("O&pen the folder"));
  this->Open->setAutoDefault(false);
  this->Start = new QPushButton(tr("&Start"));
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
  connect(this->Cancel, &QPushButton::clicked, this, &RenderDialog::cancel);
  connect(close, &QPushButton::clicked, this, &RenderDialog::reject);
  connect(this->Result, &QPushButton::clicked, this, [this] { emit this->resultAsked(this->Found.path()); });
  connect(this->Resume, &QCheckBox::toggled, this, [this] { this->setRunning(this->running()); });
  connect(this->Folder, &QLineEdit::textChanged, this,
    [this]
    {
      this->Status->clear();
      this->lookAtFolder();
    });
  connect(this->Open, &QPushButton::clicked, this,
    [this] { QDesktopServices::openUrl(QUrl::fromLocalFile(this->Found.path())); });
}

} // namespace dgtk
