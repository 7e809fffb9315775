// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkOnDemand_h
#define dgtkOnDemand_h

#include "dgtkCoreModule.h"

namespace dgtk
{

/// What a library of DGTk gives under the name <library>Calls, for instance "dgtkRenderGL": the library stands beside
/// this one and is loaded at the first call. Throws MachineError when it cannot be.
DGTKCORE_EXPORT const void* callsOnDemand(const char* library);

/// The functions of a library that most runs do not need, and that takes longer to load than they to run (OpenGL,
/// OpenCV and collision libraries: 10 to 30 ms of relocations each). A module that is loaded so has a struct `Calls` of
/// pointers to its functions and exports `extern "C" const Calls* <library>Calls()`. Nothing else of it may be named by
/// who calls, as the linker (--as-needed) would load it at the start again.
template <typename Calls>
const Calls& onDemand(const char* library)
{
  static const Calls& calls = *static_cast<const Calls*>(callsOnDemand(library));
  return calls;
}

} // namespace dgtk

#endif
