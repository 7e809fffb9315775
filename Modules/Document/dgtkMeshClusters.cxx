// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMeshClusters.h"
#include "dgtkDisjointSets.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <unordered_map>

namespace dgtk
{

namespace
{
using Corners = std::array<std::uint32_t, 3>;

constexpr double leastArea = 0.5; // of the triangles that are left
constexpr double mostLeft = 0.7;  // triangles; otherwise it is not worth it

double areaOf(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  return (b - a).cross(c - a).norm() / 2;
}

/// For each vertex the first one in its cell.
std::vector<std::uint32_t> firstOfCells(const Geometry& geometry, double cells)
{
  Eigen::Vector3d low = geometry.positions.front();
  Eigen::Vector3d high = low;
  for (const Eigen::Vector3d& position : geometry.positions)
  {
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
  }
  const double cell = (high - low).norm() / cells;
  std::unordered_map<std::uint32_t, std::uint32_t> first;
  std::vector<std::uint32_t> to(geometry.positions.size());
  for (std::uint32_t i = 0; i < to.size(); ++i)
  {
    const Eigen::Vector3d at = (geometry.positions[i] - low) / (cell > 0 ? cell : 1.0);
    const auto key = static_cast<std::uint32_t>(at.x()) + 64 * static_cast<std::uint32_t>(at.y()) +
                     4096 * static_cast<std::uint32_t>(at.z());
    to[i] = first.try_emplace(key, i).first->second;
  }
  return to;
}

/// Those of the vertices of each cell that are joined by edges within it, or differ in nothing but their normals.
DisjointSets islandsOf(
  const Geometry& geometry, const Model& model, const Part& part, const std::vector<std::uint32_t>& cell)
{
  DisjointSets islands(cell.size());
  std::map<std::array<double, 5>, std::uint32_t> same;
  for (std::uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangles; ++t)
  {
    const Corners& own = model.triangles[t];
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::uint32_t next = own[(i + 1) % 3];
      if (cell[own[i]] == cell[next])
      {
        islands.join(own[i], next);
      }
      const Eigen::Vector3d& p = geometry.positions[own[i]];
      const Eigen::Vector2d uv = model.uvs.empty() ? Eigen::Vector2d(0, 0) : Eigen::Vector2d(model.uvs[own[i]]);
      islands.join(own[i], same.try_emplace({ p.x(), p.y(), p.z(), uv.x(), uv.y() }, own[i]).first->second);
    }
  }
  return islands;
}

/// The smallest corner first, in the same sense.
Corners rotated(Corners corners)
{
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
  return corners;
}
} // namespace

std::optional<ClusteredPart> clusterPart(const Geometry& geometry, const Model& model, const Part& part, double cells)
{
  const std::vector<std::uint32_t> cell = firstOfCells(geometry, cells);
  const std::vector<Eigen::Vector3d>& p = geometry.positions;
  std::set<Corners> taken;
  std::vector<Corners> left; // of all that would lie in the same place the first
  double before = 0;
  double after = 0;
  for (std::uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangles; ++t)
  {
    const Corners& own = model.triangles[t];
    const Corners moved{ cell[own[0]], cell[own[1]], cell[own[2]] };
    before += areaOf(p[own[0]], p[own[1]], p[own[2]]);
    if (moved[0] != moved[1] && moved[1] != moved[2] && moved[2] != moved[0] && taken.insert(rotated(moved)).second)
    {
      left.push_back(own);
      after += areaOf(p[moved[0]], p[moved[1]], p[moved[2]]);
    }
  }
  if (after < leastArea * before || double(left.size()) > mostLeft * part.triangles)
  {
    return std::nullopt;
  }

  // A corner has normal and UV of the vertex of its island that is nearest to the place that all of the cell get.
  DisjointSets islands = islandsOf(geometry, model, part, cell);
  std::unordered_map<std::uint32_t, std::uint32_t> nearest;
  for (std::uint32_t t = part.firstTriangle; t < part.firstTriangle + part.triangles; ++t)
  {
    for (const std::uint32_t vertex : model.triangles[t])
    {
      std::uint32_t& best = nearest.try_emplace(islands.find(vertex), vertex).first->second;
      const Eigen::Vector3d& place = p[cell[vertex]];
      best = (p[vertex] - place).squaredNorm() < (p[best] - place).squaredNorm() ? vertex : best;
    }
  }
  ClusteredPart result;
  std::unordered_map<std::uint32_t, std::uint32_t> numbers;
  for (const Corners& own : left)
  {
    Corners corners{};
    for (std::size_t i = 0; i < 3; ++i)
    {
      const std::uint32_t island = islands.find(own[i]);
      const auto [at, isNew] = numbers.try_emplace(island, static_cast<std::uint32_t>(result.positions.size()));
      if (isNew)
      {
        result.positions.push_back(p[cell[own[i]]]);
        result.sources.push_back(nearest.at(island));
      }
      corners[i] = at->second;
    }
    result.triangles.push_back(corners);
  }
  return result;
}

} // namespace dgtk
