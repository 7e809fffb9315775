// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRayMesh.h"

#include "dgtkRaySource.h"

#include "dgtkError.h"
#include "dgtkSystem.h"
#include "dgtkThreadPool.h"
#include "dgtkWorkTime.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace dgtk
{

namespace
{
/// A matrix with a larger condition number loses too much when Embree inverts it in single precision.
constexpr double largestCondition = 1e4;
/// Sine of the angle at the first corner below which a triangle has no area.
constexpr double degenerateSine = 1e-12;
/// Fewer are not worth threads.
constexpr std::size_t manyTriangles = 20000;
constexpr std::size_t nothing = ~std::size_t(0);

bool canBeHit(const Instance& instance)
{
  return instance.visible && instance.model && instance.geometry && !instance.model->triangles.empty() &&
         instance.world_from_object.linear.allFinite() && instance.world_from_object.translation.allFinite();
}

bool needsBaking(const Eigen::Matrix3d& linear)
{
  const double determinant = linear.determinant();
  if (!(std::abs(determinant) > 0))
  {
    return true;
  }
  const double condition = linear.norm() * linear.inverse().norm();
  return !(condition < largestCondition);
}

RayMeshKey keyOf(const Instance& instance, bool bare)
{
  const Model& model = *instance.model;
  RayMeshKey key;
  key.geometry = instance.geometry.get();
  key.model = &model;
  key.bare = bare;
  const std::vector<Material>& materials = instance.materials ? *instance.materials : model.materials;
  bool any = false;
  for (const Part& part : model.parts)
  {
    const Image* image = nullptr;
    if (!bare && !model.uvs.empty() && !materials.empty())
    {
      const Material& material = materials[part.material];
      image = material.cutOut && material.texture >= 0 ? model.textures[material.texture].image.get() : nullptr;
    }
    key.cutOuts.push_back(image);
    any |= image != nullptr;
  }
  if (!any)
  {
    key.cutOuts.clear();
  }
  const Eigen::Matrix3d& linear = instance.world_from_object.linear;
  if (needsBaking(linear))
  {
    key.bake.assign(linear.data(), linear.data() + 9);
  }
  return key;
}

void measure(RayMesh& mesh)
{
  const std::vector<Eigen::Vector3d>& positions = mesh.geometry->positions;
  Eigen::Vector3d low = Eigen::Vector3d::Constant(INFINITY);
  Eigen::Vector3d high = -low;
  for (const auto& triangle : mesh.model->triangles)
  {
    for (const std::uint32_t corner : triangle)
    {
      if (positions[corner].allFinite())
      {
        low = low.cwiseMin(positions[corner]);
        high = high.cwiseMax(positions[corner]);
      }
    }
  }
  if (low.x() <= high.x())
  {
    mesh.centre = 0.5 * low + 0.5 * high;
  }
}

RTCBuffer makeVertices(RayMesh& mesh, const Eigen::Matrix3d* bake)
{
  const std::vector<Eigen::Vector3d>& positions = mesh.geometry->positions;
  // Embree reads 16 bytes a vertex: one float of padding at the end.
  RTCBuffer buffer = embree().NewBuffer(mesh.device->handle(), (positions.size() * 3 + 1) * sizeof(float));
  mesh.device->check();
  float* out = static_cast<float*>(embree().GetBufferData(buffer));
  double radius = 0;
  for (const Eigen::Vector3d& position : positions)
  {
    Eigen::Vector3d x = position - mesh.centre;
    x = bake ? Eigen::Vector3d(*bake * x) : x;
    radius = std::max(radius, std::isfinite(x.squaredNorm()) ? x.squaredNorm() : 0);
    *out++ = float(x.x());
    *out++ = float(x.y());
    *out++ = float(x.z());
  }
  mesh.radius = float(std::sqrt(radius));
  return buffer;
}

bool hasArea(const RayMesh& mesh, const std::array<std::uint32_t, 3>& triangle)
{
  const std::vector<Eigen::Vector3d>& positions = mesh.geometry->positions;
  const Eigen::Vector3d e1 = positions[triangle[1]] - positions[triangle[0]];
  const Eigen::Vector3d e2 = positions[triangle[2]] - positions[triangle[0]];
  const Eigen::Vector3d n(
    e1.y() * e2.z() - e1.z() * e2.y(), e1.z() * e2.x() - e1.x() * e2.z(), e1.x() * e2.y() - e1.y() * e2.x());
  return n.squaredNorm() > degenerateSine * degenerateSine * e1.squaredNorm() * e2.squaredNorm();
}

void attach(RayMesh& mesh, RTCBuffer vertices, std::uint32_t first, std::uint32_t count, bool cutOut)
{
  RTCGeometry geometry = embree().NewGeometry(mesh.device->handle(), RTC_GEOMETRY_TYPE_TRIANGLE);
  embree().SetGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, vertices, 0, 3 * sizeof(float),
    mesh.geometry->positions.size());
  auto* indices = static_cast<std::uint32_t*>(embree().SetNewGeometryBuffer(
    geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), count));
  mesh.device->check();
  const float* x = static_cast<const float*>(embree().GetBufferData(vertices));
  for (std::uint32_t i = first; i < first + count; ++i)
  {
    const auto& triangle = mesh.model->triangles[i];
    const bool solid = hasArea(mesh, triangle);
    float longest = 0;
    for (int k = 0; k < 3; ++k)
    {
      const float* a = x + std::size_t(3) * triangle[k];
      const float* b = x + std::size_t(3) * triangle[(k + 1) % 3];
      const float square =
        (b[0] - a[0]) * (b[0] - a[0]) + (b[1] - a[1]) * (b[1] - a[1]) + (b[2] - a[2]) * (b[2] - a[2]);
      longest = std::max(longest, square);
      *indices++ = solid ? triangle[k] : triangle[0];
    }
    mesh.inverseEdge[i] = solid && longest > 0 ? 1 / std::sqrt(longest) : 0;
  }
  embree().SetGeometryUserData(geometry, &mesh);
  embree().CommitGeometry(geometry);
  embree().AttachGeometry(mesh.scene, geometry);
  embree().ReleaseGeometry(geometry);
  mesh.firstTriangle.push_back(first);
  mesh.cutOut.push_back(cutOut);
}

/// Runs of parts without cut-out textures become one Embree geometry, every other part its own.
void attachAll(RayMesh& mesh, const RayMeshKey& key, RTCBuffer vertices)
{
  const std::uint32_t count = std::uint32_t(mesh.model->triangles.size());
  std::uint32_t first = 0;
  for (std::size_t i = 0; i < key.cutOuts.size(); ++i)
  {
    const Part& part = mesh.model->parts[i];
    if (key.cutOuts[i] && part.triangles > 0)
    {
      if (part.firstTriangle > first)
      {
        attach(mesh, vertices, first, part.firstTriangle - first, false);
      }
      attach(mesh, vertices, part.firstTriangle, part.triangles, true);
      first = part.firstTriangle + part.triangles;
    }
  }
  if (first < count)
  {
    attach(mesh, vertices, first, count - first, false);
  }
}

} // namespace

bool RayMeshKey::operator<(const RayMeshKey& o) const
{
  return std::tie(this->geometry, this->model, this->bare, this->cutOuts, this->bake) <
         std::tie(o.geometry, o.model, o.bare, o.cutOuts, o.bake);
}

RayMesh::~RayMesh()
{
  if (this->scene)
  {
    embree().ReleaseScene(this->scene);
  }
}

const BoxTree& RayMesh::tree() const
{
  std::call_once(this->Once,
    [this]
    {
      const WorkTime build(WorkStage::Build);
      std::vector<Eigen::AlignedBox3d> boxes(this->model->triangles.size());
      for (std::size_t i = 0; i < boxes.size(); ++i)
      {
        const auto& triangle = this->model->triangles[i];
        for (int k = 0; k < 3 && hasArea(*this, triangle); ++k)
        {
          boxes[i].extend(this->geometry->positions[triangle[k]]);
        }
      }
      this->Tree = BoxTree(boxes);
    });
  return this->Tree;
}

RayDevice::RayDevice()
  : Handle(embree().NewDevice(nullptr))
{
  if (!this->Handle)
  {
    const RTCError error = embree().GetDeviceError(nullptr);
    throw MachineError(error == RTC_ERROR_OUT_OF_MEMORY
                         ? "the memory of this machine is not enough for the ray tracer"
                         : "Embree does not start (error " + std::to_string(int(error)) + ")");
  }
}

RayDevice::~RayDevice() { embree().ReleaseDevice(this->Handle); }

std::shared_ptr<RayDevice> RayDevice::shared()
{
  static std::mutex lock;
  static std::weak_ptr<RayDevice> current;
  const std::lock_guard<std::mutex> guard(lock);
  std::shared_ptr<RayDevice> device = current.lock();
  if (!device)
  {
    device = std::make_shared<RayDevice>();
    current = device;
  }
  return device;
}

void RayDevice::check() const
{
  const RTCError error = embree().GetDeviceError(this->Handle);
  if (error == RTC_ERROR_OUT_OF_MEMORY)
  {
    throw MachineError("not enough memory for the ray tracer's copy of the scene");
  }
  if (error != RTC_ERROR_NONE)
  {
    throw MachineError("Embree failed (error " + std::to_string(int(error)) + ")");
  }
}

void RayDevice::commit(RTCScene& scene) const
{
  embree().CommitScene(scene);
  const RTCScene built = std::exchange(scene, nullptr);
  this->check();
  scene = built;
}

std::shared_ptr<const RayMesh> RayDevice::find(const RayMeshKey& key)
{
  const std::lock_guard<std::mutex> guard(this->Lock);
  const auto known = this->Meshes.find(key);
  std::shared_ptr<const RayMesh> mesh = known == this->Meshes.end() ? nullptr : known->second.lock();
  if (mesh)
  {
    this->use(mesh);
  }
  return mesh;
}

namespace
{
/// Roughly what Embree takes, with vertices and edges.
std::uint64_t bytesOf(const RayMesh& mesh)
{
  constexpr std::uint64_t bytesATriangle = 160;
  return mesh.inverseEdge.size() * bytesATriangle;
}
} // namespace

/// Under the lock of `Lock`, which others hold briefly: what goes is not destroyed in it, but for small ones.
void RayDevice::use(const std::shared_ptr<const RayMesh>& mesh)
{
  const auto known = this->KeptAt.find(mesh.get());
  if (known != this->KeptAt.end())
  {
    this->Kept.splice(this->Kept.begin(), this->Kept, known->second);
    return;
  }
  if (bytesOf(*mesh) > this->MostKept)
  {
    return;
  }
  this->Kept.push_front(mesh);
  this->KeptAt[mesh.get()] = this->Kept.begin();
  this->KeptBytes += bytesOf(*mesh);
  while (this->KeptBytes > this->MostKept)
  {
    this->KeptBytes -= bytesOf(*this->Kept.back());
    this->KeptAt.erase(this->Kept.back().get());
    this->Kept.pop_back();
  }
}

void RayDevice::keepUnused(std::uint64_t bytes)
{
  std::list<std::shared_ptr<const RayMesh>> gone; // destroyed after the lock
  const std::lock_guard<std::mutex> guard(this->Lock);
  this->MostKept = bytes;
  if (bytes == 0)
  {
    gone.swap(this->Kept);
    this->KeptAt.clear();
    this->KeptBytes = 0;
  }
}

std::shared_ptr<void> keepRayMeshes(std::uint64_t bytes)
{
  const std::shared_ptr<RayDevice> device = RayDevice::shared();
  device->keepUnused(bytes);
  return { nullptr, [device](void*) { device->keepUnused(0); } };
}

std::shared_ptr<const RayMesh> RayDevice::keep(const RayMeshKey& key, std::shared_ptr<const RayMesh> mesh)
{
  const std::lock_guard<std::mutex> guard(this->Lock);
  std::weak_ptr<const RayMesh>& known = this->Meshes[key];
  if (std::shared_ptr<const RayMesh> first = known.lock())
  {
    return first;
  }
  known = mesh;
  this->use(mesh);
  if (this->Meshes.size() > this->MostMeshes)
  {
    for (auto it = this->Meshes.begin(); it != this->Meshes.end();)
    {
      it = it->second.expired() ? this->Meshes.erase(it) : std::next(it);
    }
    this->MostMeshes = 2 * this->Meshes.size() + 16;
  }
  return mesh;
}

std::shared_ptr<const RayMesh> RayDevice::make(const Instance& instance, const RayMeshKey& key)
{
  const WorkTime build(WorkStage::Build);
  const auto mesh = std::make_shared<RayMesh>();
  mesh->device = this->shared_from_this();
  mesh->geometry = instance.geometry;
  mesh->model = instance.model;
  mesh->hasCutOuts = !key.cutOuts.empty();
  mesh->baked = !key.bake.empty();
  mesh->inverseEdge.resize(instance.model->triangles.size());
  measure(*mesh);
  mesh->scene = embree().NewScene(this->Handle);
  embree().SetSceneFlags(
    mesh->scene, key.bare ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
  embree().SetSceneBuildQuality(mesh->scene, RTC_BUILD_QUALITY_MEDIUM);
  RTCBuffer vertices = makeVertices(*mesh, mesh->baked ? &instance.world_from_object.linear : nullptr);
  attachAll(*mesh, key, vertices);
  embree().ReleaseBuffer(vertices);
  this->commit(mesh->scene);
  return mesh;
}

std::vector<std::shared_ptr<const RayMesh>> RayDevice::meshes(const std::vector<Instance>& instances, bool bare)
{
  struct Wanted
  {
    const Instance* instance;
    const RayMeshKey* key;
    std::shared_ptr<const RayMesh> mesh;
  };
  std::map<RayMeshKey, std::size_t> byKey;
  std::vector<Wanted> wanted;
  std::vector<std::size_t> uses(instances.size(), nothing);
  std::size_t triangles = 0;
  for (std::size_t i = 0; i < instances.size(); ++i)
  {
    if (!canBeHit(instances[i]))
    {
      continue;
    }
    const auto [entry, isNew] = byKey.emplace(keyOf(instances[i], bare), wanted.size());
    uses[i] = entry->second;
    if (isNew)
    {
      wanted.push_back({ &instances[i], &entry->first, this->find(entry->first) });
      triangles += wanted.back().mesh ? 0 : instances[i].model->triangles.size();
    }
  }
  const bool isWork = wanted.size() > 1 && triangles > manyTriangles;
  ThreadPool(isWork ? machineThreads() : 1)
    .parallelFor(static_cast<int>(wanted.size()),
      [&](int i)
      {
        Wanted& one = wanted[static_cast<std::size_t>(i)];
        one.mesh = one.mesh ? one.mesh : this->keep(*one.key, this->make(*one.instance, *one.key));
      });
  std::vector<std::shared_ptr<const RayMesh>> meshes;
  meshes.reserve(instances.size());
  for (const std::size_t use : uses)
  {
    meshes.push_back(use == nothing ? nullptr : wanted[use].mesh);
  }
  return meshes;
}

} // namespace dgtk
