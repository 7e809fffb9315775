// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAssimpCheck_h
#define dgtkAssimpCheck_h

#include "dgtkAssimpStream.h"

namespace dgtk
{

/// Throws std::runtime_error unless every index, length and time in the scene is right.
void checkScene(const import::Scene& scene);

} // namespace dgtk

#endif
