// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkOptionFields.h"

#include "dgtkEditorState.h"
#include "dgtkError.h"
#include "dgtkNumberRow.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QLineEdit>
#include <QSettings>
#include <QSpinBox>

#include <algorithm>

namespace dgtk
{

namespace
{
QString wordOf(const OptionRow& row) { return optionWord(toText(row.name)); }

/// What is typed for another scene or dataset means nothing for this one.
bool fitsAnything(const OptionRow& row)
{
  return row.kind != OptionRow::Kind::Numbers && (row.kind != OptionRow::Kind::Names || !row.choices.empty());
}
} // namespace

QString optionWord(const QString& name) { return "--" + QString(name).replace('_', '-'); }

OptionFields::OptionFields(const QString& settings, QWidget* parent)
  : QWidget(parent)
  , Settings(settings)
{
}

QString OptionFields::keyOf(const OptionRow& row) const { return this->Settings + '/' + toText(row.name); }

QString OptionFields::kept(const OptionRow& row) const
{
  const QString text = fitsAnything(row) ? QSettings().value(this->keyOf(row)).toString() : QString();
  try
  {
    return text.isEmpty() ? toText(row.fallback) : toText(row.normal(text.toStdString()));
  }
  catch (const UsageError&)
  {
    return toText(row.fallback); // of another version
  }
}

OptionFields::Field& OptionFields::add(const OptionRow& row, QFormLayout* form)
{
  Field field{ &row, nullptr, {}, {} };
  field.widget = this->makeField(row, this->kept(row), field);
  field.widget->setObjectName(toText(row.name));
  field.widget->setToolTip(toText(row.help));
  form->addRow(toText(row.name), field.widget);
  form->labelForField(field.widget)->setToolTip(toText(row.help));
  this->Fields.push_back(field);
  return this->Fields.back();
}

QWidget* OptionFields::makeField(const OptionRow& row, const QString& text, Field& field)
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

QStringList OptionFields::words() const
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

void OptionFields::setOwners(const QStringList& owners)
{
  for (const Field& field : this->Fields)
  {
    const bool has = std::any_of(
      field.owners.begin(), field.owners.end(), [&](const QString& owner) { return owners.contains(owner); });
    field.widget->setEnabled(field.owners.isEmpty() || has);
  }
}

void OptionFields::remember() const
{
  QSettings settings;
  for (const Field& field : this->Fields)
  {
    const std::string text = field.text();
    if (text == field.row->fallback || !fitsAnything(*field.row))
    {
      settings.remove(this->keyOf(*field.row));
    }
    else
    {
      settings.setValue(this->keyOf(*field.row), toText(text));
    }
  }
}

QString OptionFields::inWindowsWords(QString message) const
{
  const auto named = std::find_if(this->Fields.begin(), this->Fields.end(),
    [&](const Field& field) { return message.startsWith(wordOf(*field.row) + ": "); });
  return named == this->Fields.end() ? message : toText(named->row->name) + message.mid(wordOf(*named->row).size());
}

} // namespace dgtk
