// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRenderOptions_h
#define dgtkRenderOptions_h

// Private to Runs.

#include "dgtkRequestOptions.h"

#include <QStringList>
#include <QWidget>

#include <functional>
#include <vector>

class QFormLayout;

namespace dgtk
{

/// An option of `dgtk render` as its command line has it.
QString optionWord(const QString& name);

/// The page Options of the render configuration: a field for each option of a run, called as the option.
class RenderOptions : public QWidget
{
  Q_OBJECT

public:
  explicit RenderOptions(QWidget* parent);

  /// Those that differ from their defaults, as words of the command line. Options of other layers are left out.
  QStringList words() const;
  /// Options that only some layers have can be chosen with one of these.
  void setLayers(const QStringList& layers);
  /// The text of an option of names, until another one is typed.
  void offer(const QString& name, const QString& text);
  /// For the next start of the program: those that fit any scene.
  void remember() const;
  /// A message of the command line, with the names that options have here.
  QString inWindowsWords(QString message) const;

private:
  struct Field
  {
    const OptionRow* row;
    QWidget* widget;
    QStringList layers; ///< that have it; empty: all
    std::function<std::string()> text;
  };
  void add(const OptionRow& row, QFormLayout* form);
  QWidget* makeField(const OptionRow& row, const QString& text, Field& field);
  QString kept(const OptionRow& row) const;

  std::vector<Field> Fields;
};

} // namespace dgtk

#endif
