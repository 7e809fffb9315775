// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkWindowSize_h
#define dgtkWindowSize_h

#include "dgtkControlsModule.h"

class QWidget;

namespace dgtk
{

/// The size of a window that is not shown yet, as far as its display has room beside a window's frame.
DGTKCONTROLS_EXPORT void resizeWithin(QWidget& window, int width, int height);

/// Moves a window that is not shown yet to the left of a widget, as far as the display allows.
DGTKCONTROLS_EXPORT void placeBeside(QWidget& window, const QWidget& widget);

} // namespace dgtk

#endif
