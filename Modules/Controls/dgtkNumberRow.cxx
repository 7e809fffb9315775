// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkNumberRow.h"

#include "dgtkNumberBox.h"
#include "dgtkText.h"

#include <QApplication>
#include <QDialog>
#include <QGridLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QPainter>
#include <QStatusTipEvent>
#include <QStyle>
#include <QStyleOptionFrame>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>

namespace dgtk
{

namespace
{
constexpr int mostAbreast = 5;    // numbers in one line
constexpr int severalAbreast = 4; // of more, which have several lines

/// A field that shows by three points that its number goes on.
class NumberField : public QLineEdit
{
public:
  using QLineEdit::QLineEdit;

protected:
  void paintEvent(QPaintEvent* event) override
  {
    QLineEdit::paintEvent(event);
    QStyleOptionFrame option;
    this->initStyleOption(&option);
    const QRect inside = this->style()->subElementRect(QStyle::SE_LineEditContents, &option, this);
    constexpr int margins = 4; // of the text, on both sides
    if (this->hasFocus() || this->fontMetrics().horizontalAdvance(this->text()) + margins <= inside.width())
    {
      return;
    }
    const QString more(QChar(0x2026));
    const int width = this->fontMetrics().horizontalAdvance(more) + 2;
    const QRect end(inside.right() - width + 1, inside.top(), width, inside.height());
    QPainter painter(this);
    painter.fillRect(end, this->palette().base());
    painter.setPen(this->palette().color(QPalette::Text));
    painter.drawText(end, Qt::AlignCenter, more);
  }
};

QLineEdit* lineOf(QObject* field)
{
  auto* const line = qobject_cast<QLineEdit*>(field);
  return line != nullptr ? line : field->findChild<QLineEdit*>();
}

/// What its field or the dialog's fields tell stands in a label.
class Teller : public QObject
{
public:
  Teller(QWidget& parent, QLabel& label)
    : QObject(&parent)
    , Label(label)
  {
  }
  bool eventFilter(QObject* /*watched*/, QEvent* event) override
  {
    const QString tip = event->type() == QEvent::StatusTip ? static_cast<QStatusTipEvent*>(event)->tip() : QString();
    if (!tip.isEmpty())
    {
      this->Label.setText(tip);
      this->Label.show();
    }
    return !tip.isEmpty();
  }

private:
  QLabel& Label;
};

class UndoLeft : public QObject
{
public:
  using QObject::QObject;
  bool eventFilter(QObject* watched, QEvent* event) override
  {
    if (event->type() != QEvent::ShortcutOverride || lineOf(watched)->isModified())
    {
      return false;
    }
    auto* const key = static_cast<QKeyEvent*>(event);
    const bool left = key->matches(QKeySequence::Undo) || key->matches(QKeySequence::Redo);
    if (left)
    {
      event->ignore();
    }
    return left;
  }
};
} // namespace

QString numberText(double value) { return QString::fromStdString(shortest(value)); }

std::optional<double> numberOf(const QString& text)
{
  const std::string word = text.trimmed().replace(',', '.').toStdString();
  const bool plus = word.rfind('+', 0) == 0 && word.rfind("+-", 0) != 0;
  const char* const begin = word.c_str() + (plus ? 1 : 0);
  const char* const end = word.c_str() + word.size();
  double value = 0;
  const auto [rest, code] = std::from_chars(begin, end, value);
  if (code != std::errc() || rest != end || !std::isfinite(value))
  {
    return std::nullopt;
  }
  return value;
}

int pixelsOf(double number)
{
  constexpr double mostPixels = 1 << 24; // beyond the largest image, far below the largest int
  return static_cast<int>(std::clamp(number, -1.0, mostPixels));
}

NumberRow::NumberRow(const QString& name, int count, QWidget* parent)
  : QWidget(parent)
  , Values(static_cast<std::size_t>(count), 0.0)
{
  this->setObjectName(name);
  auto* layout = new QGridLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(3);
  const int columns = count > mostAbreast ? severalAbreast : count;
  for (int i = 0; i < count; ++i)
  {
    auto* field = new NumberField(this);
    field->setObjectName(name + '.' + QString::number(i));
    field->setMinimumWidth(38);
    leaveUndo(field);
    layout->addWidget(field, i / columns, i % columns);
    this->Fields.push_back(field);
    connect(field, &QLineEdit::returnPressed, this, &NumberRow::commit);
    connect(field, &QLineEdit::editingFinished, this, &NumberRow::leaveField);
  }
  this->setFocusPolicy(Qt::ClickFocus); // as the buddy of a label, but no stop of Tab beside its fields
  this->setFocusProxy(this->Fields.front());
}

NumberRow::~NumberRow()
{
  // A field that has the focus loses it with the row, and would tell one that is no row any more.
  for (QLineEdit* field : this->Fields)
  {
    field->disconnect(this);
  }
}

void NumberRow::setValues(const std::vector<double>& values)
{
  this->Values = values;
  for (std::size_t i = 0; i < this->Fields.size(); ++i)
  {
    const QString text = numberText(values[i]);
    if (this->Fields[i]->text() != text && !this->Fields[i]->isModified())
    {
      this->Fields[i]->setText(text);
      this->Fields[i]->setCursorPosition(0);
    }
    this->Fields[i]->setToolTip(text);
  }
}

void NumberRow::leaveField()
{
  // The focus goes nowhere when the window is left: it comes back to the row.
  const QWidget* const focus = QApplication::focusWidget();
  if (!this->Together || (focus != nullptr && !this->isAncestorOf(focus)))
  {
    this->commit();
  }
}

QString NumberRow::commit()
{
  std::vector<double> wanted = this->Values;
  QString fault;
  for (std::size_t i = 0; i < this->Fields.size(); ++i)
  {
    const std::optional<double> number = numberOf(this->Fields[i]->text());
    wanted[i] = number.value_or(wanted[i]);
    const bool isWrong = !number && this->Fields[i]->isModified(); // of a row without values nothing was typed
    if (isWrong && fault.isEmpty())
    {
      fault = tr("\"%1\" is no number that can be used here").arg(this->Fields[i]->text());
    }
    this->Fields[i]->setModified(isWrong && keepsWrong(*this));
  }
  const bool other = wanted != this->Values;
  this->setValues(wanted);
  if (other && this->Edited)
  {
    this->Edited(wanted);
  }
  tell(*this, fault);
  return fault;
}

void NumberRow::forget()
{
  for (QLineEdit* field : this->Fields)
  {
    field->setModified(false);
  }
  this->setValues(this->Values);
}

void leaveUndo(QWidget* field)
{
  field->installEventFilter(new UndoLeft(field));
  if (auto* const box = qobject_cast<QAbstractSpinBox*>(field))
  {
    QObject::connect(box, &QAbstractSpinBox::editingFinished, box, [line = lineOf(box)] { line->setModified(false); });
  }
}

void tell(const QWidget& field, const QString& text)
{
  if (!text.isEmpty())
  {
    QStatusTipEvent tip(text);
    QWidget* to = const_cast<QWidget*>(&field);
    if (QWidget* const dock = to->window(); dock->inherits("QDockWidget"))
    {
      to = dock->parentWidget(); // of one that floats nothing goes there by itself
    }
    QApplication::sendEvent(to, &tip);
  }
}

void tellIn(QWidget& part, QLabel& label) { part.installEventFilter(new Teller(part, label)); }

bool keepsWrong(const QWidget& field) { return qobject_cast<const QDialog*>(field.window()) != nullptr; }

bool hasPieceOf(const QString& words, const QString& text)
{
  bool is = !words.isEmpty() && text.contains(words);
  for (int size = 2; size < words.size(); ++size)
  {
    is = is || text.endsWith(words.left(size)) || text.endsWith(words.right(size)) ||
         text.startsWith(words.left(size)) || text.startsWith(words.right(size));
  }
  return is;
}

QString numberFault(const QString& text, double least, double most, int decimals)
{
  const std::optional<double> number = numberOf(text);
  if (!number || *number < least || *number > most)
  {
    return NumberRow::tr("\"%1\": expected a number from %2 to %3").arg(text, numberText(least), numberText(most));
  }
  return decimals == 0 ? NumberRow::tr("\"%1\": expected a whole number").arg(text)
                       : NumberRow::tr("\"%1\": expected at most %2 decimals").arg(text).arg(decimals);
}

QSpinBox* makeNumber(const QString& name, int least, int most, int value)
{
  auto* box = new NumberBox<QSpinBox>;
  box->setObjectName(name);
  box->setRange(least, most);
  box->setValue(value);
  return box;
}

QString commitRows(const QWidget& dialog)
{
  QString why;
  const auto refuse = [&why](QWidget* field, const QString& fault)
  {
    if (why.isEmpty() && !fault.isEmpty() && field->isEnabled())
    {
      why = fault;
      field->setFocus();
    }
  };
  for (NumberRow* row : dialog.findChildren<NumberRow*>())
  {
    refuse(row, row->commit());
  }
  for (QAbstractSpinBox* box : dialog.findChildren<QAbstractSpinBox*>())
  {
    box->interpretText();
    const auto* const number = dynamic_cast<const TypedNumber*>(box);
    refuse(box, number == nullptr ? QString() : number->fault());
  }
  return why;
}

} // namespace dgtk
