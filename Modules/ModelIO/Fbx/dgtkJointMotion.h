// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkJointMotion_h
#define dgtkJointMotion_h

#include "dgtkAssimpStream.h"

#include <Eigen/Geometry>

#include <vector>

namespace dgtk
{

/// Of a matrix of the stream, whose last row does not count.
Eigen::Affine3d affineOf(const import::Matrix& matrix);

/// How far from a key a time may be that is meant to be at it; seconds. Times are rounded; those of glTF to single
/// precision.
double roundingOf(double time);

/// Value of a curve with at least one key; time in seconds.
double valueAt(const import::Curve& curve, double time);

/// A rotation between two, along the shorter arc (Shoemake 1985); not of unit length.
Eigen::Quaterniond slerp(const Eigen::Quaterniond& a, const Eigen::Quaterniond& b, double u);

/// Transforms model_from_node of nodes as they stand in the file (FBX SDK, `FbxNode`, for those that are joints);
/// `animation`, which may be null, says how joints move, and `parent_from_node` where the other nodes are.
std::vector<Eigen::Affine3d> poseOf(const std::vector<import::Node>& nodes,
  const std::vector<Eigen::Affine3d>& parent_from_node, const import::Animation* animation, double time);

/// Percentage of a blend shape.
double percentAt(const import::Blend& blend, const import::Animation* animation, double time);

/// Adds to `weights`, one a target of the mesh, what a blend shape at a percentage gives its targets: between two of
/// them both, before the first one and after the last one more than all of it.
void addWeights(const import::Blend& blend, double percent, std::vector<double>& weights);

/// Dual quaternion skinning (Kavan et al. 2008) of one point by rigid parts; scales are blended apart.
class DualQuaternions
{
public:
  void add(const Eigen::Affine3d& transform, double weight);
  Eigen::Vector3d operator()(const Eigen::Vector3d& point) const;

private:
  Eigen::Vector4d Real = Eigen::Vector4d::Zero(); ///< x, y, z, w
  Eigen::Vector4d Dual = Eigen::Vector4d::Zero();
  Eigen::Vector4d First = Eigen::Vector4d::Zero();
  Eigen::Vector3d Scale = Eigen::Vector3d::Zero();
  double Total = 0;
};

} // namespace dgtk

#endif
