// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkNumberBox_h
#define dgtkNumberBox_h

#include "dgtkNumberRow.h"

#include <QDoubleSpinBox>
#include <QSpinBox>
#include <QString>

#include <optional>
#include <type_traits>
#include <utility>

class QLabel;

namespace dgtk
{

/// What is typed cannot be taken: in the status bar, or the label of tellIn(), of the window that has the field.
DGTKCONTROLS_EXPORT void tell(const QWidget& field, const QString& text);
/// What the fields of this dialog, or of this part of one, tell stands in the label.
DGTKCONTROLS_EXPORT void tellIn(QWidget& part, QLabel& label);
/// Whether a text that cannot be taken stays in this field: in dialogs, whose buttons refuse it by commitRows().
DGTKCONTROLS_EXPORT bool keepsWrong(const QWidget& field);
/// Why a text is no number of a field with this range and so many decimals.
DGTKCONTROLS_EXPORT QString numberFault(const QString& text, double least, double most, int decimals);

/// Whether a text is what is left of the words beside a number, or holds them.
DGTKCONTROLS_EXPORT bool hasPieceOf(const QString& words, const QString& text);

class TypedNumber
{
public:
  virtual ~TypedNumber() = default;
  /// Why what is typed cannot be taken, or "".
  virtual QString fault() const = 0;
  /// What was typed was for something else: the number is shown.
  virtual void forget() = 0;
};

/// A spin box that drops no keys, which would leave another number than the one that was typed. What it cannot take is
/// told; in a dialog it stays, elsewhere the number before comes back. A comma is a point there, too.
template <typename Box>
class NumberBox : public Box, public TypedNumber
{
public:
  explicit NumberBox(QWidget* parent = nullptr)
    : Box(parent)
  {
    this->setKeyboardTracking(false); // each key would be a number
  }
  using Number = decltype(std::declval<Box>().value());
  static constexpr bool isWhole = std::is_integral_v<Number>;

  QString fault() const override { return this->hasAcceptableInput() ? QString() : this->faultOf(this->cleanText()); }

  void forget() override
  {
    this->Wrong.reset();
    this->setValue(this->value());
  }

  QValidator::State validate(QString& text, int& at) const override
  {
    // Qt has put back what a key took of the words around the number: that key is ignored, any other is not.
    const QString prefix = this->prefix();
    const QString suffix = this->suffix();
    QString typed = text.startsWith(prefix) ? text.mid(prefix.size()) : text;
    typed.chop(typed.endsWith(suffix) ? suffix.size() : 0);
    if (hasPieceOf(prefix, typed) || hasPieceOf(suffix, typed))
    {
      return QValidator::Invalid;
    }
    QString number = typed;
    if constexpr (!isWhole)
    {
      const QChar point = this->locale().decimalPoint();
      number.replace(',', point).replace('.', point);
    }
    text = prefix + number + suffix;
    QString found = text;
    const QValidator::State state = Box::validate(found, at);
    const std::optional<double> meant = numberOf(typed); // signs between groups of digits are none
    if (state != QValidator::Acceptable || (meant && *meant != double(this->valueFromText(found))))
    {
      return QValidator::Intermediate;
    }
    this->Wrong.reset();
    return state;
  }

  void fixup(QString& /*text*/) const override
  {
    this->Wrong = keepsWrong(*this) ? std::optional<QString>(this->cleanText()) : std::nullopt;
    this->WrongAt = this->value();
    tell(*this, this->fault());
  }

  QString textFromValue(Number value) const override
  {
    return this->Wrong && value == this->WrongAt ? *this->Wrong : Box::textFromValue(value);
  }

private:
  QString faultOf(const QString& text) const
  {
    int decimals = 0;
    if constexpr (!isWhole)
    {
      decimals = this->decimals();
    }
    return numberFault(text, double(this->minimum()), double(this->maximum()), decimals);
  }

  mutable std::optional<QString> Wrong; ///< what is shown in place of the value that it had then
  mutable Number WrongAt = 0;
};

} // namespace dgtk

#endif
