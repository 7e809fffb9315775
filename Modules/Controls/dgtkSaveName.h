// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSaveName_h
#define dgtkSaveName_h

#include "dgtkControlsModule.h"

#include <QString>

class QWidget;

namespace dgtk
{

/// Asks for the name of a file to be written; "" when there is none. A name without an ending of one of the filters
/// ("Scene (*.json);;Thesis scene (*.scene)") gets that of the chosen one; then the dialog asks before a file of that
/// name is replaced. `start`: the path that it begins with, or "".
DGTKCONTROLS_EXPORT QString askSaveName(
  QWidget* parent, const QString& title, const QString& start, const QString& filters);

} // namespace dgtk

#endif
