// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkGltfStructure_h
#define dgtkGltfStructure_h

// Private to Verification: what the specification of glTF 2.0 asks of any asset.

#include "dgtkExportJudge.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

namespace dgtk
{

/// A list of so many numbers; std::out_of_range for another.
Eigen::VectorXd gltfList(const nlohmann::json& list, std::size_t count);

/// " clamp mirror": what is beyond the picture of a texture, along u and v; "" where nothing is said of it.
std::string gltfWrap(const nlohmann::json& asset, const nlohmann::json& texture);

/// The numbers of an asset's accessors.
class GltfNumbers
{
public:
  GltfNumbers(const nlohmann::json& asset, const std::string& folder, const std::string& file);
  /// A row for each element. Throws InputError.
  Eigen::MatrixXd read(std::size_t accessor) const;
  /// The same of so many rows and columns; std::out_of_range for others.
  Eigen::MatrixXd read(std::size_t accessor, std::size_t rows, Eigen::Index columns) const;
  bool hasRightSizes() const { return this->Right; } ///< of its files

private:
  const nlohmann::json& Asset;
  std::string Path;
  std::vector<std::string> Buffers;
  bool Right = true;
};

/// The corners of a triangle, the least one first.
inline std::array<std::size_t, 3> sortedCorners(std::array<std::size_t, 3> corners)
{
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}

/// What moves a node.
struct GltfChannel
{
  Eigen::VectorXd times;
  Eigen::MatrixXd values;
  /// The row at a key's time; the nearest one.
  Eigen::VectorXd at(double time) const
  {
    Eigen::Index row = 0;
    (this->times.array() - time).abs().minCoeff(&row);
    return this->values.row(row);
  }
};

/// One scene with one root; all that is listed is used; limits and targets of accessors; what is the same in all
/// cameras and materials.
void judgeGltfStructure(
  ExportJudge& judge, const std::string& file, const nlohmann::json& document, const GltfNumbers& numbers);

} // namespace dgtk

#endif
