// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovCamera_h
#define dgtkPovCamera_h

#include "dgtkPovExport.h"
#include "dgtkPovLights.h"

#include <string>

namespace dgtk
{

/// `camera { ... }` of rows of a view. Throws UsageError for one that is not linear.
std::string povCamera(const View& view, const PovRows& rows, const std::optional<PovLens>& lens, double scale);

/// PovResult::scale of what lies in a ball.
double povSceneScale(const View& view, const PovBall& ball);

} // namespace dgtk

#endif
