// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTriangulate_h
#define dgtkTriangulate_h

#include "dgtkModelIOModule.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace dgtk
{

/// Splits a polygon in space into count - 2 triangles of indices into `points`, keeping its direction. Concave polygons
/// are ear-clipped; what has no ear (self-crossing, degenerate) is cut as it comes. `work` is increased by the steps
/// spent; above `workLimit` polygons are cut into fans and false is returned.
DGTKMODELIO_EXPORT bool triangulate(const std::vector<Eigen::Vector3d>& points,
  std::vector<std::array<std::uint32_t, 3>>& triangles, std::uint64_t& work, std::uint64_t workLimit);

} // namespace dgtk

#endif
