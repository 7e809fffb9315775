// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkNameCombo.h"

#include <QEvent>
#include <QStyle>
#include <QStyleOptionComboBox>
#include <QStylePainter>

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr int narrowest = 44; // widget units
} // namespace

NameCombo::NameCombo(const char* name, const QString& tip, QWidget* parent)
  : QComboBox(parent)
  , Tip(tip)
{
  this->setObjectName(name);
  this->setToolTip(tip);
  this->setAccessibleName(tip);
  // panes side by side have one size, whatever the names in them
  this->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Fixed);
  this->setMinimumWidth(narrowest);
}

bool NameCombo::event(QEvent* event)
{
  if (event->type() == QEvent::ToolTip) // names are also chosen without a signal
  {
    this->setToolTip(this->Tip + ": " + this->currentText());
  }
  return QComboBox::event(event);
}

int NameCombo::wholeWidth() const
{
  int widest = 0;
  for (int i = 0; i < this->count(); ++i)
  {
    widest = std::max(widest, this->fontMetrics().horizontalAdvance(this->itemText(i)));
  }
  QStyleOptionComboBox option;
  this->initStyleOption(&option);
  option.rect.setWidth(2 * narrowest);
  const QRect field = this->style()->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, this);
  return widest + option.rect.width() - field.width() + 2;
}

void NameCombo::paintEvent(QPaintEvent*)
{
  QStylePainter painter(this);
  QStyleOptionComboBox option;
  this->initStyleOption(&option);
  const QRect field = this->style()->subControlRect(QStyle::CC_ComboBox, &option, QStyle::SC_ComboBoxEditField, this);
  option.currentText = this->fontMetrics().elidedText(option.currentText, Qt::ElideMiddle, field.width());
  painter.drawComplexControl(QStyle::CC_ComboBox, option);
  painter.drawControl(QStyle::CE_ComboBoxLabel, option);
}

} // namespace dgtk
