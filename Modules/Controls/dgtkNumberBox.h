// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkNumberBox_h
#define dgtkNumberBox_h

#include "dgtkControlsModule.h"

#include <QDoubleSpinBox>
#include <QSpinBox>
#include <QString>

#include <algorithm>
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
DGTKCONTROLS_EXPORT QString rangeFault(const QString& text, const QString& least, const QString& most);

class TypedNumber
{
public:
  virtual ~TypedNumber() = default;
  /// Why what is typed cannot be taken, or "".
  virtual QString fault() const = 0;
};

/// A spin box that drops no keys, which would leave another number than the one that was typed. What it cannot take is
/// told; in a dialog it stays, elsewhere the number before comes back.
template <typename Box>
class NumberBox : public Box, public TypedNumber
{
public:
  using Box::Box;
  using Number = decltype(std::declval<Box>().value());

  QString fault() const override
  {
    return this->hasAcceptableInput()
             ? QString()
             : rangeFault(this->cleanText(), Box::textFromValue(this->minimum()), Box::textFromValue(this->maximum()));
  }

  QValidator::State validate(QString& text, int& at) const override
  {
    const QValidator::State state = std::max(Box::validate(text, at), QValidator::Intermediate);
    if (state == QValidator::Acceptable)
    {
      this->Wrong.clear();
    }
    return state;
  }

  void fixup(QString& /*text*/) const override
  {
    this->Wrong = keepsWrong(*this) ? this->cleanText() : QString();
    this->WrongAt = this->value();
    tell(*this, this->fault());
  }

  QString textFromValue(Number value) const override
  {
    return this->Wrong.isEmpty() || value != this->WrongAt ? Box::textFromValue(value) : this->Wrong;
  }

private:
  mutable QString Wrong; ///< what is shown in place of the value that it had then
  mutable Number WrongAt = 0;
};

} // namespace dgtk

#endif
