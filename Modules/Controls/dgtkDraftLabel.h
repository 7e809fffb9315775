// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkDraftLabel_h
#define dgtkDraftLabel_h

#include "dgtkControlsModule.h"

class QLabel;
class QWidget;

namespace dgtk
{

/// The word "Draft" at a picture's upper left corner: it is not the renderer's. A child of the picture named "draft".
DGTKCONTROLS_EXPORT QLabel* makeDraftLabel(QWidget* picture);

} // namespace dgtk

#endif
