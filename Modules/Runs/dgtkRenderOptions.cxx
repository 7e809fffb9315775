// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRenderOptions.h"

#include "dgtkEditorState.h"
#include "dgtkGenerator.h"

#include <QComboBox>
#include <QFormLayout>
#include <QGroupBox>
#include <QLineEdit>
#include <QScrollArea>
#include <QVBoxLayout>

#include <algorithm>

namespace dgtk
{

namespace
{
const QString layerOfPov = "pov"; // whose options are the renderer's, too, and begin with its name
const QString rendererOfPov = "povray";

/// Of the command line's options that are no layer's, and that no other page of the dialog has.
const OptionRow& classFile()
{
  static const NamesOption row("classes", "FILE",
    "numbers of the classes of scenes that fix none (default: in the order in which objects have them)");
  return row;
}
} // namespace

RenderOptions::RenderOptions(QWidget* parent)
  : OptionFields("render/options", parent)
{
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  auto* area = new QScrollArea;
  area->setWidgetResizable(true);
  area->setFrameShape(QFrame::NoFrame);
  layout->addWidget(area);
  auto* page = new QWidget;
  auto* columns = new QVBoxLayout(page);
  auto* form = new QFormLayout;
  columns->addLayout(form);
  auto* group = new QGroupBox(tr("File formats"));
  auto* formats = new QFormLayout(group);
  columns->addWidget(group);
  columns->addStretch(1);
  for (const OptionRow* row : allOptions())
  {
    this->add(*row, row->kind == OptionRow::Kind::Names && !row->choices.empty() ? formats : form);
  }
  this->add(classFile(), form);
  for (const LayerInfo& info : generatorLayers())
  {
    for (Field& field : this->fields())
    {
      const bool has = std::find(info.options.begin(), info.options.end(), field.row) != info.options.end();
      field.owners += has ? QStringList(toText(info.layer)) : QStringList();
    }
  }
  for (Field& field : this->fields())
  {
    const bool isOfPov = field.owners.isEmpty() && toText(field.row->name).startsWith(layerOfPov + '_');
    field.owners += isOfPov ? QStringList{ layerOfPov, rendererOfPov } : QStringList();
  }
  area->setWidget(page);
  connect(this->findChild<QComboBox*>("renderer"), &QComboBox::currentTextChanged, this,
    [this] { this->setLayers(this->Layers); });
}

void RenderOptions::setLayers(const QStringList& layers)
{
  this->Layers = layers;
  this->setOwners(layers + QStringList(this->findChild<QComboBox*>("renderer")->currentText()));
}

void RenderOptions::offer(const QString& name, const QString& text)
{
  auto* const line = this->findChild<QLineEdit*>(name);
  if (line != nullptr && !line->isModified())
  {
    line->setText(text);
  }
}

} // namespace dgtk
