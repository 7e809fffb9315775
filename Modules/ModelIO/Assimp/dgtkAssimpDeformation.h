// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAssimpDeformation_h
#define dgtkAssimpDeformation_h

#include "dgtkAssimpStream.h"
#include "dgtkModel.h"

#include <Eigen/Geometry>

#include <memory>
#include <vector>

namespace dgtk
{

/// A mesh hanging on a node, and the vertices of it that the model has.
struct PosedMesh
{
  std::uint32_t node = 0;
  std::uint32_t mesh = 0;
  std::vector<std::uint32_t> vertices; ///< of the mesh, in the order of the model's
};

/// Node transforms, morph targets and linear blend skinning (glTF 2.0, 3.7.2.2 and 3.7.3.2), in double precision, at
/// any time. Keys of channels: translation, scale and weights are linear between them, step or follow splines,
/// rotations slerp along the shorter arc; before the first and after the last one the value stays. Joints of FBX files
/// follow their curves (dgtkJointMotion.h).
class AssimpDeformation : public Deformation
{
public:
  /// The scene has been checked: every index in it is within its list.
  AssimpDeformation(std::shared_ptr<const import::Scene> scene, std::vector<PosedMesh> meshes);

  /// Frames a second of Animation; the file's keys are at times, not at frames.
  static constexpr double fps = 30;

  void positionsAt(int animation, double frame, std::vector<Eigen::Vector3d>& sourcePositions) const override;
  bool holds(int animation) const override;
  std::string saved() const override;
  /// What saved() said. Throws std::runtime_error when an index is not within its list.
  static std::shared_ptr<AssimpDeformation> restored(const std::string& bytes);

  /// Transforms model_from_node of all nodes; animation -1: as the nodes stand in the file. Time in seconds.
  std::vector<Eigen::Affine3d> pose(int animation, double time) const;
  /// Positions of a mesh's vertices at a pose.
  void positionsOf(const PosedMesh& mesh, const std::vector<Eigen::Affine3d>& pose, int animation, double time,
    std::vector<Eigen::Vector3d>& positions) const;
  /// Linear parts of model_from_mesh: one for the whole mesh, or, for a skinned one, one a vertex.
  std::vector<Eigen::Matrix3d> linearOf(
    std::uint32_t mesh, std::uint32_t node, const std::vector<Eigen::Affine3d>& pose) const;
  /// Whether anything that is drawn moves in some animation.
  bool moves() const;

private:
  struct Influence
  {
    std::uint32_t bone;
    float weight;
  };
  /// Influences of vertex i of a mesh: [first[i], first[i + 1]) of `list`.
  struct Skin
  {
    std::vector<std::uint32_t> first;
    std::vector<Influence> list;
  };
  const import::Animation* animationOf(int animation) const;
  std::vector<double> weightsAt(const PosedMesh& mesh, int animation, double time) const;
  double timeOf(int animation, double frame) const;

  std::shared_ptr<const import::Scene> Scene;
  std::vector<PosedMesh> Meshes;
  std::vector<Skin> Skins; ///< one a mesh of the scene
};

} // namespace dgtk

#endif
