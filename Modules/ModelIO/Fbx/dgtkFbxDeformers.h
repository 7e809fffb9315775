// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFbxDeformers_h
#define dgtkFbxDeformers_h

#include "dgtkFbxGeometry.h"
#include "dgtkFbxMotion.h"
#include "dgtkJointPose.h"

namespace dgtk::import
{

/// The skin and the blend shapes of a geometry, by control points.
class FbxDeformers
{
public:
  /// `node_from_geometry`: the geometric transform of its model. Blend channels get their numbers in `targets`.
  FbxDeformers(const FbxScene& scene, std::size_t geometry, const Transform& node_from_geometry, FbxTargets& targets);

  /// Gives a part of the geometry, which has so many control points, its bones and targets.
  void addTo(const FbxPart& part, std::size_t controlPoints, Mesh& mesh) const;

private:
  struct Cluster
  {
    std::int32_t node;
    Matrix bone_from_mesh;
    std::vector<std::int64_t> points;
    std::vector<double> weights;
  };
  struct Shape
  {
    std::vector<std::int64_t> points;
    std::vector<double> offsets; ///< three a point
  };
  static Shape shapeOf(const FbxElement& element);
  void readSkin(
    const FbxScene& scene, std::size_t skin, const Transform& node_from_geometry, const FbxTargets& targets);
  void readChannel(const FbxScene& scene, std::size_t channel, FbxTargets& targets);
  /// A blend shape whose percentage is a property of an object.
  Blend& addBlend(
    const FbxScene& scene, std::size_t object, const std::string& property, double percent, FbxTargets& targets);

  std::vector<Cluster> Clusters;
  std::vector<Shape> Shapes;
  std::vector<Blend> Blends; ///< of shapes
  bool IsDual = false;
  std::vector<std::int64_t> DualPoints; ///< those of which shares are said
  std::vector<double> DualShares;
};

} // namespace dgtk::import

#endif
