// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkNumberRow_h
#define dgtkNumberRow_h

#include "dgtkControlsModule.h"

#include <QLineEdit>
#include <QString>
#include <QWidget>

#include <functional>
#include <optional>
#include <vector>

class QSpinBox;

namespace dgtk
{

/// The shortest decimal text that reads back as the same number, with a point in every locale.
DGTKCONTROLS_EXPORT QString numberText(double value);
/// The whole text as a finite number; a comma counts as a point.
DGTKCONTROLS_EXPORT std::optional<double> numberOf(const QString& text);
/// The whole number of pixels of an image's side; what no image has stays out of its range.
DGTKCONTROLS_EXPORT int pixelsOf(double number);

/// One or more numbers side by side, of many four in a line. What is typed is taken at Return or when the field is
/// left; a text that is no number is told, and gives way to the old value; in a dialog it stays, for commitRows().
/// While something is being typed, other values do not take its place.
class DGTKCONTROLS_EXPORT NumberRow : public QWidget
{
  Q_OBJECT

public:
  /// The fields are called `name`.0, `name`.1, ...
  NumberRow(const QString& name, int count, QWidget* parent);
  ~NumberRow() override;

  /// All numbers are taken at once, at Return or when the row is left: for those that make sense together only.
  void takeTogether() { this->Together = true; }
  bool areTakenTogether() const { return this->Together; }
  /// Takes what is typed now. What is wrong with a text that is no number, or "".
  QString commit();
  /// What is typed is forgotten.
  void forget();
  void setValues(const std::vector<double>& values);
  const std::vector<double>& values() const { return this->Values; }
  /// Called with the new values when a field changed.
  void onEdit(std::function<void(const std::vector<double>&)> edited) { this->Edited = std::move(edited); }

private:
  void leaveField();

  bool Together = false;
  std::vector<QLineEdit*> Fields;
  std::vector<double> Values;
  std::function<void(const std::vector<double>&)> Edited;
};

/// Undo and redo are the window's while nothing is being typed in this line or spin box.
DGTKCONTROLS_EXPORT void leaveUndo(QWidget* field);

/// A NumberBox for whole numbers; what is typed counts when it is left.
DGTKCONTROLS_EXPORT QSpinBox* makeNumber(const QString& name, int least, int most, int value);

/// What is typed in the rows and number fields of a dialog, or of a part of one, is taken. Where one of those that can
/// be used has no number that it can take: why, and the field has the focus; otherwise "".
[[nodiscard]] DGTKCONTROLS_EXPORT QString commitRows(const QWidget& dialog);

} // namespace dgtk

#endif
