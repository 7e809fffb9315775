// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMeshClusters_h
#define dgtkMeshClusters_h

#include "dgtkSceneState.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace dgtk
{

/// A part of a model with fewer triangles.
struct ClusteredPart
{
  std::vector<Eigen::Vector3d> positions;
  std::vector<std::uint32_t> sources; ///< of each position the vertex that has its normal and UV
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

/// Vertices of a cell of a grid become one (Rossignac and Borrel 1993); `cells`: along the diagonal of the model's box.
/// A place may have several UVs, as at the seams of a texture: triangles that hang together within the cell share one.
/// Nothing where the triangles would be hardly fewer, or much would vanish.
std::optional<ClusteredPart> clusterPart(const Geometry& geometry, const Model& model, const Part& part, double cells);

} // namespace dgtk

#endif
