// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkOptionFields_h
#define dgtkOptionFields_h

#include "dgtkOption.h"

#include <QString>
#include <QStringList>
#include <QWidget>

#include <functional>
#include <vector>

class QFormLayout;

namespace dgtk
{

/// An option of the command line as it has it.
QString optionWord(const QString& name);

/// A field for each option of a command, called as the option.
class OptionFields : public QWidget
{
  Q_OBJECT

public:
  /// `settings`: where choices are kept for the next start of the program.
  OptionFields(const QString& settings, QWidget* parent);

  /// Those that differ from their defaults, as words of the command line. Options of other owners are left out.
  QStringList words() const;
  /// Options that only some layers or formats have can be chosen with one of these.
  void setOwners(const QStringList& owners);
  /// For the next start of the program: those that fit anything.
  void remember() const;
  /// A message of the command line, with the names that options have here.
  QString inWindowsWords(QString message) const;

protected:
  struct Field
  {
    const OptionRow* row;
    QWidget* widget;
    QStringList owners; ///< layers or formats that have it; empty: all
    std::function<std::string()> text;
  };
  Field& add(const OptionRow& row, QFormLayout* form);
  std::vector<Field>& fields() { return this->Fields; }

private:
  QWidget* makeField(const OptionRow& row, const QString& text, Field& field);
  QString kept(const OptionRow& row) const;
  QString keyOf(const OptionRow& row) const;

  QString Settings;
  std::vector<Field> Fields;
};

} // namespace dgtk

#endif
