// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAssimpModel_h
#define dgtkAssimpModel_h

#include "dgtkModelContents.h"

#include <memory>
#include <string>

namespace dgtk
{

/// Reads a model in dgtk-import, with Assimp or our own reader of FBX. `format` is the reader's. Throws InputError.
ModelContents readThroughAssimp(const std::string& path, const std::string& format, const ReadOptions& options);

} // namespace dgtk

#endif
