// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkNameCombo_h
#define dgtkNameCombo_h

#include "dgtkControlsModule.h"

#include <QComboBox>

namespace dgtk
{

/// A list of names that leaves out the middle of a name for which it is too narrow: beginning and end tell names of one
/// family apart. The whole name is in the tool tip.
class DGTKCONTROLS_EXPORT NameCombo : public QComboBox
{
  Q_OBJECT

public:
  /// `tip`: what is chosen.
  NameCombo(const char* name, const QString& tip, QWidget* parent);
  /// The width at which every name of the list is whole.
  int wholeWidth() const;

protected:
  bool event(QEvent* event) override;
  void paintEvent(QPaintEvent* event) override;

private:
  QString Tip;
};

} // namespace dgtk

#endif
