// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRenderOptions.h"

#include "dgtkEditorState.h"
#include "dgtkError.h"
#include "dgtkGenerator.h"
#include "dgtkNumberRow.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QGroupBox>
#include <QLineEdit>
#include <QScrollArea>
#include <QSettings>
#include <QSpinBox>
#include <QVBoxLayout>

#include <algorithm>

namespace dgtk
{

namespace
{
QString keyOf(const OptionRow& row) { return "render/options/" + toText(row.name); }

QString wordOf(const OptionRow& row) { return optionWord(toText(row.name)); }

/// What is typed for another scene means nothing in this one.
bool fitsAnyScene(const OptionRow& row)
{
  return row.kind != OptionRow::Kind::Numbers && (row.kind != OptionRow::Kind::Names || !row.choices.empty());
}
} // namespace

QString optionWord(const QString& name) { return "--" + QString(name).replace('_', '-'); }

RenderOptions::RenderOptions(QWidget* parent)
  : QWidget(parent)
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
  for (const LayerInfo& info : generatorLayers())
  {
    for (Field& field : this->Fields)
    {
      const bool has = std::find(info.options.begin(), info.options.end(), field.row) != info.options.end();
      field.layers += has ? QStringList(toText(info.layer)) : QStringList();
    }
  }
  area->setWidget(page);
}

QString RenderOptions::kept(const OptionRow& row) const
{
  const QString text = fitsAnyScene(row) ? QSettings().value(keyOf(row)).toString() : QString();
  try
  {
    return text.isEmpty() ? toText(row.fallback) : toText(row.normal(text.toStdString()));
  }
  catch (const UsageError&)
  {
    return toText(row.fallback); // of another version
  }
}

void RenderOptions::add(const OptionRow& row, QFormLayout* form)
{
  Field field{ &row, nullptr, {}, {} };
  field.widget = this->makeField(row, this->kept(row), field);
  field.widget->setObjectName(toText(row.name));
  field.widget->setToolTip(toText(row.help));
  form->addRow(toText(row.name), field.widget);
  form->labelForField(field.widget)->setToolTip(toText(row.help));
  this->Fields.push_back(field);
}

QWidget* RenderOptions::makeField(const OptionRow& row, const QString& text, Field& field)
{
  if (row.kind == OptionRow::Kind::Switch)
  {
    auto* box = new QCheckBox;
    box->setChecked(text == "on");
    field.text = [box] { return std::string(box->isChecked() ? "on" : "off"); };
    return box;
  }
  if (row.kind == OptionRow::Kind::Integer && !row.fallback.empty())
  {
    QSpinBox* const number = makeNumber(toText(row.name), row.least, row.most, text.toInt());
    field.text = [number] { return std::to_string(number->value()); };
    return number;
  }
  if (row.kind == OptionRow::Kind::Choice)
  {
    auto* box = new QComboBox;
    for (const std::string& choice : row.choices)
    {
      box->addItem(toText(choice));
    }
    box->setCurrentText(text);
    field.text = [box] { return box->currentText().toStdString(); };
    return box;
  }
  auto* line = new QLineEdit(text);
  line->setPlaceholderText(toText(row.value));
  field.text = [line] { return line->text().trimmed().toStdString(); };
  return line;
}

QStringList RenderOptions::words() const
{
  QStringList words;
  for (const Field& field : this->Fields)
  {
    const std::string text = field.text();
    if (!field.widget->isEnabledTo(field.widget->parentWidget()) || text.empty() || text == field.row->fallback)
    {
      continue;
    }
    words << wordOf(*field.row);
    if (field.row->kind != OptionRow::Kind::Switch)
    {
      words << toText(text);
    }
  }
  return words;
}

void RenderOptions::setLayers(const QStringList& layers)
{
  for (const Field& field : this->Fields)
  {
    const bool has = std::any_of(
      field.layers.begin(), field.layers.end(), [&](const QString& layer) { return layers.contains(layer); });
    field.widget->setEnabled(field.layers.isEmpty() || has);
  }
}

void RenderOptions::offer(const QString& name, const QString& text)
{
  auto* const line = this->findChild<QLineEdit*>(name);
  if (line != nullptr && !line->isModified())
  {
    line->setText(text);
  }
}

void RenderOptions::remember() const
{
  QSettings settings;
  for (const Field& field : this->Fields)
  {
    const std::string text = field.text();
    if (text == field.row->fallback || !fitsAnyScene(*field.row))
    {
      settings.remove(keyOf(*field.row));
    }
    else
    {
      settings.setValue(keyOf(*field.row), toText(text));
    }
  }
}

QString RenderOptions::inWindowsWords(QString message) const
{
  const auto named = std::find_if(this->Fields.begin(), this->Fields.end(),
    [&](const Field& field) { return message.startsWith(wordOf(*field.row) + ": "); });
  return named == this->Fields.end() ? message : toText(named->row->name) + message.mid(wordOf(*named->row).size());
}

} // namespace dgtk
