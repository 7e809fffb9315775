// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAssimpProcess_h
#define dgtkAssimpProcess_h

#include "dgtkAssimpStream.h"

#include <string>

namespace dgtk
{

/// Path of the program dgtk-import: $DGTK_IMPORT, else beside the library (bin/ and libexec/dgtk/ of the folders above
/// it). Throws MachineError when it is not there.
std::string importProgram();

/// Reads a model in a process of its own, with limits of memory (512 MiB and 10 bytes a byte read) and of processor
/// time (60 s). Throws InputError with the importer's complaint, also when the importer crashed or ran into a limit.
import::Scene importModel(const std::string& path, const std::string& format);

} // namespace dgtk

#endif
