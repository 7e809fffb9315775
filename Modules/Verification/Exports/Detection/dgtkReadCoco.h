// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkReadCoco_h
#define dgtkReadCoco_h

// Private to Verification: what COCO's documents of all kinds have.

#include "dgtkExportJudge.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace dgtk
{

/// Rows top to bottom of a mask given column by column, by counts of pixels outside and inside in turns; none where the
/// counts are not of so many pixels.
std::vector<char> maskOfCounts(const std::vector<std::uint64_t>& counts, int width, int height);

/// [x0, y0, x1, y1] of pixels' borders around those inside, of which there are some.
Eigen::Vector4d cornersOfMask(const std::vector<char>& mask, int width);

/// Categories are these classes of the dataset, in their order.
void judgeCocoCategories(ExportJudge& judge, const std::string& file, const nlohmann::json& categories,
  const std::vector<ClassRecord>& classes);

/// The picture of an entry of "images", whose names and size are compared; null for none. `folder` ends with '/'.
const ExportedName* judgeCocoImage(
  ExportJudge& judge, const std::string& file, const std::string& folder, const nlohmann::json& image);

} // namespace dgtk

#endif
