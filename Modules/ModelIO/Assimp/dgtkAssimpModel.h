// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAssimpModel_h
#define dgtkAssimpModel_h

#include "dgtkModelContents.h"

#include <memory>
#include <string>

namespace dgtk
{

/// Reads a model with Assimp, in a process of its own. `format` is the reader's. Throws InputError.
ModelContents readThroughAssimp(const std::string& path, const std::string& format, const ReadOptions& options);

} // namespace dgtk

#endif
