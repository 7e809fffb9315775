// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneFile_h
#define dgtkSceneFile_h

#include "dgtkSceneModule.h"

#include <string>

namespace dgtk
{

/// Whether a file is a scene by its extension and, of .json, by its keys: cameras beside objects, lights or an
/// environment. Files of classes, records of samples and documents of datasets are not. Throws InputError for a file that cannot be read, and for what is no JSON.
DGTKSCENE_EXPORT bool looksLikeScene(const std::string& path);

} // namespace dgtk

#endif
