// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRayMesh_h
#define dgtkRayMesh_h

#include "dgtkBoxTree.h"
#include "dgtkEmbree.h"
#include "dgtkSceneState.h"

#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

namespace dgtk
{

class RayDevice;

/// Embree's tree of one geometry, shared by all instances that have the geometry and the same cut-out textures.
/// Vertices are float32: bake * (position - centre).
struct RayMesh
{
  ~RayMesh();
  /// Of the boxes of the triangles that have an area, by triangle of the model, object frame. Thread-safe.
  const BoxTree& tree() const;

  std::shared_ptr<RayDevice> device;
  std::shared_ptr<const Geometry> geometry;
  std::shared_ptr<const Model> model;
  RTCScene scene = nullptr;
  Eigen::Vector3d centre{ 0, 0, 0 }; ///< object frame
  bool hasCutOuts = false;
  bool baked = false;                       ///< vertices are in the axes and scale of the world, for singular matrices
  float radius = 0;                         ///< of the vertices around the centre
  std::vector<std::uint32_t> firstTriangle; ///< of the model, by Embree geometry id
  std::vector<std::uint8_t> cutOut;         ///< whether a texture may cut holes, by Embree geometry id
  std::vector<float> inverseEdge; ///< 1 / longest edge by triangle of the model, units of the vertices; 0 without area

private:
  mutable std::once_flag Once;
  mutable BoxTree Tree; ///< made when somebody asks for it
};

/// What makes meshes different.
struct RayMeshKey
{
  const Geometry* geometry = nullptr;
  const Model* model = nullptr;
  bool bare = false;
  std::vector<const Image*> cutOuts; ///< by part; empty when there are none
  std::vector<double> bake;          ///< 9 values or none
  bool operator<(const RayMeshKey& o) const;
};

/// One Embree device for the process while anything uses it, and the meshes in use.
class RayDevice : public std::enable_shared_from_this<RayDevice>
{
public:
  static std::shared_ptr<RayDevice> shared();
  RayDevice();
  ~RayDevice();
  RayDevice(const RayDevice&) = delete;
  RayDevice& operator=(const RayDevice&) = delete;

  RTCDevice handle() const { return this->Handle; }
  /// The meshes of instances, null where there is nothing to hit. Those that nobody has are made, on as many threads as
  /// the machine has; `bare` ones know no cut-out textures and call no filters. Thread-safe.
  std::vector<std::shared_ptr<const RayMesh>> meshes(const std::vector<Instance>& instances, bool bare);
  /// Throws MachineError when Embree reported an error.
  void check() const;
  /// Builds a scene's tree. Throws as check(), and lets go of the scene then: Embree 3.13 ends the process when it is
  /// to destroy one for which memory was missing.
  void commit(RTCScene& scene) const;
  /// So many bytes of meshes stay when nobody has them any more, the last used ones; 0 lets all go.
  void keepUnused(std::uint64_t bytes);

private:
  std::shared_ptr<const RayMesh> find(const RayMeshKey& key);
  std::shared_ptr<const RayMesh> make(const Instance& instance, const RayMeshKey& key);
  /// What the others find from now on; the first one of a key.
  std::shared_ptr<const RayMesh> keep(const RayMeshKey& key, std::shared_ptr<const RayMesh> mesh);

  RTCDevice Handle = nullptr;
  std::mutex Lock;
  std::map<RayMeshKey, std::weak_ptr<const RayMesh>> Meshes;
  std::size_t MostMeshes = 16; ///< with more, those that nobody has any more are dropped

  void use(const std::shared_ptr<const RayMesh>& mesh);
  std::uint64_t MostKept = 0; ///< bytes
  std::uint64_t KeptBytes = 0;
  std::list<std::shared_ptr<const RayMesh>> Kept; ///< last used first
  std::map<const RayMesh*, std::list<std::shared_ptr<const RayMesh>>::iterator> KeptAt;
};

} // namespace dgtk

#endif
