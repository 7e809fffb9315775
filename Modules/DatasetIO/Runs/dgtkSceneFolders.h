// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneFolders_h
#define dgtkSceneFolders_h

#include "dgtkDatasetIOModule.h"

#include <string>
#include <vector>

namespace dgtk
{

/// Names of the folders that a folder of datasets holds, as its manifest lists them; none for a dataset. Throws
/// InputError for a folder that is neither.
DGTKDATASETIO_EXPORT std::vector<std::string> sceneFoldersIn(const std::string& folder);

} // namespace dgtk

#endif
