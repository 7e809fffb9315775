// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMeshOverlap_h
#define dgtkMeshOverlap_h

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <vector>

namespace dgtk
{

using WorldTriangle = std::array<Eigen::Vector3d, 3>;

/// Triangles of one body, world frame.
struct WorldMesh
{
  std::vector<WorldTriangle> triangles;
  Eigen::AlignedBox3d box;
  void add(const WorldTriangle& triangle);
};

/// How far `a` can be moved along `way` before a surface of it touches one of `b`, in lengths of `way`; 1 at most.
/// Surfaces that cross already do not count.
double freeWay(const WorldMesh& a, const WorldMesh& b, const Eigen::Vector3d& way);

/// The depth of the deepest pair of triangles that cross, and of the deepest vertex of one body within the other; where
/// there is neither, as their sides lie in one plane, the diameter of a ball that is in closed parts of both.
double overlapDepth(const WorldMesh& a, const WorldMesh& b);

} // namespace dgtk

#endif
