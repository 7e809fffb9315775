// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkReadCoco_h
#define dgtkReadCoco_h

// Private to Verification: what COCO's documents of all kinds have.

#include "dgtkExportJudge.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace dgtk
{

/// Categories are these classes of the dataset, in their order.
void judgeCocoCategories(ExportJudge& judge, const std::string& file, const nlohmann::json& categories,
  const std::vector<ClassRecord>& classes);

/// The picture of an entry of "images", whose names and size are compared; null for none. `folder` ends with '/'.
const ExportedName* judgeCocoImage(
  ExportJudge& judge, const std::string& file, const std::string& folder, const nlohmann::json& image);

} // namespace dgtk

#endif
