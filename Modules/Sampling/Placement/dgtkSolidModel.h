// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSolidModel_h
#define dgtkSolidModel_h

#include "dgtkConvexHull.h"
#include "dgtkSampleModels.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// A surface whose vertices at one place are one, in connected parts.
struct SolidMesh
{
  std::vector<Eigen::Vector3d> points;
  std::vector<std::array<std::uint32_t, 3>> triangles; ///< with three different corners, those of a part together
  struct Part
  {
    std::size_t first = 0; ///< triangle
    std::size_t count = 0;
    bool closed = false; ///< every edge has two triangles: it has an inside, which they have behind them
  };
  std::vector<Part> parts; ///< in the order of their first triangles in the model
};

/// The surface of geometry whose triangles are `triangles`.
SolidMesh solidMesh(
  const std::vector<Eigen::Vector3d>& positions, const std::vector<std::array<std::uint32_t, 3>>& triangles);

/// The model's surface at its first frame, in its own axes.
std::shared_ptr<const SolidMesh> solidOf(SampleModels& models, const std::string& path);
/// Convex pieces of it, true to 2 % of the model's size: of each connected part, one where that is convex.
std::shared_ptr<const std::vector<ConvexHull>> piecesOf(SampleModels& models, const std::string& path);

/// A piece with as few corners as leave the others by 1 % of the size of what it is of outside, less of a small one.
ConvexHull fewCorners(const ConvexHull& piece, double size);

} // namespace dgtk

#endif
