// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkArrayMemory_h
#define dgtkArrayMemory_h

#include "dgtkPipelineModule.h"

namespace dgtk
{

/// Throws MachineError where arrays of so many bytes, of a picture of width x height pixels, could not fit into the
/// machine's memory.
DGTKPIPELINE_EXPORT void requireArrayMemory(int width, int height, double bytes);

} // namespace dgtk

#endif
