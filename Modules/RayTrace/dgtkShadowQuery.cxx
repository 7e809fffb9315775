// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkShadowQuery.h"

#include "dgtkColorMap.h"
#include "dgtkRayScene.h"
#include "dgtkSurfaceRows.h"
#include "dgtkWorkTime.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace dgtk
{

namespace
{
constexpr float farthest = 1e30F;

struct ShadowContext
{
  RTCIntersectContext context;
  const RayScene* scene;
  const std::vector<bool>* clear; ///< by instance: colours of its vertices let light through, as in OpenGL's pictures
};

bool isTranslucent(const Instance& instance, std::uint32_t triangle)
{
  const Part& part = instance.model->parts[instance.model->partOf(triangle)];
  return (*instance.materials)[std::size_t(part.material)].opacity < 1;
}

/// Lets light through what does not hold it up.
void shadowFilter(const RTCFilterFunctionNArguments* arguments)
{
  const auto& context = *reinterpret_cast<const ShadowContext*>(arguments->context);
  const auto* mesh = static_cast<const RayMesh*>(arguments->geometryUserPtr);
  for (unsigned int i = 0; i < arguments->N; ++i)
  {
    if (arguments->valid[i] == 0)
    {
      continue;
    }
    const unsigned int geometry = RTCHitN_geomID(arguments->hit, arguments->N, i);
    const unsigned int object = RTCHitN_instID(arguments->hit, arguments->N, i, 0);
    const Instance& instance = context.scene->state().instances[object];
    const std::uint32_t triangle = mesh->firstTriangle[geometry] + RTCHitN_primID(arguments->hit, arguments->N, i);
    const Eigen::Vector2d barycentrics(
      double(RTCHitN_u(arguments->hit, arguments->N, i)), double(RTCHitN_v(arguments->hit, arguments->N, i)));
    if ((*context.clear)[object] || isTranslucent(instance, triangle) ||
        (mesh->cutOut[geometry] != 0 && isCutOut(instance, triangle, barycentrics)))
    {
      arguments->valid[i] = 0;
    }
  }
}

class EmbreeShadows final : public ShadowQuery
{
public:
  EmbreeShadows(const std::shared_ptr<const SceneState>& state, const Rigid3& camera_from_world)
    : Scene(RayDevice::shared(), false)
  {
    this->Scene.place(state, camera_from_world);
    std::map<const Model*, bool> models;
    for (const Instance& instance : state->instances)
    {
      const auto [known, isNew] = models.try_emplace(instance.model.get(), false);
      known->second = isNew ? hasTranslucentColors(*instance.model) : known->second;
      this->Clear.push_back(known->second);
      this->Filtered = this->Filtered || known->second;
      for (const Material& material : *instance.materials)
      {
        this->Filtered = this->Filtered || material.opacity < 1 || material.cutOut;
      }
    }
  }

  unsigned int blocked(const LightPath* paths, std::size_t count) const override
  {
    const WorkTime time(WorkStage::Trace);
    if (!this->Scene.fits())
    {
      return this->blockedExactly(paths, count);
    }
    ShadowContext context{};
    rtcInitIntersectContext(&context.context);
    // What Embree does with coherent packets is for rays that start at one point.
    context.context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    context.context.filter = this->Filtered ? shadowFilter : nullptr;
    context.scene = &this->Scene;
    context.clear = &this->Clear;
    alignas(64) RTCRay16 packet{};
    alignas(64) int valid[mostPaths];
    for (std::size_t i = 0; i < mostPaths; ++i)
    {
      const LightPath& path = paths[i < count ? i : 0];
      valid[i] = i < count && isTraceable(path.origin, path.direction) ? -1 : 0;
      packet.org_x[i] = float(path.origin.x());
      packet.org_y[i] = float(path.origin.y());
      packet.org_z[i] = float(path.origin.z());
      packet.dir_x[i] = float(path.direction.x());
      packet.dir_y[i] = float(path.direction.y());
      packet.dir_z[i] = float(path.direction.z());
      packet.tfar[i] = path.length < double(farthest) ? float(path.length) : farthest;
      packet.mask[i] = ~0U;
      packet.id[i] = unsigned(i);
    }
    embree().Occluded16(valid, this->Scene.handle(), &context.context, &packet);
    unsigned int bits = 0;
    for (std::size_t i = 0; i < count; ++i)
    {
      bits |= unsigned(packet.tfar[i] < 0) << i;
    }
    return bits;
  }

  double precision(std::uint32_t object, double distance) const override
  {
    constexpr double ofDoubles = 1e-12;
    return (this->Scene.fits() ? 2 * rayPrecision : ofDoubles) * (distance + this->Scene.placed(object - 1).reach);
  }

private:
  unsigned int blockedExactly(const LightPath* paths, std::size_t count) const
  {
    unsigned int bits = 0;
    std::vector<RayHit> found;
    for (std::size_t i = 0; i < count; ++i)
    {
      this->Scene.collectExactly({ paths[i].origin, paths[i].direction, 0, paths[i].length }, false, found);
      const bool any = std::any_of(found.begin(), found.end(),
        [&](const RayHit& hit)
        {
          const std::size_t object = hit.hit.object - 1;
          return !this->Clear[object] && !isTranslucent(this->Scene.state().instances[object], hit.hit.triangle);
        });
      bits |= unsigned(any) << i;
    }
    return bits;
  }

  RayScene Scene;
  std::vector<bool> Clear; ///< by instance
  bool Filtered = false;
};

} // namespace

std::shared_ptr<const ShadowQuery> makeShadowQuery(
  const std::shared_ptr<const SceneState>& state, const Rigid3& camera_from_world)
{
  return std::make_shared<EmbreeShadows>(state, camera_from_world);
}

} // namespace dgtk
