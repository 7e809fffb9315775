// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRayScene.h"

#include "dgtkSurfaceRows.h"

namespace dgtk
{

namespace
{

ExactRay rayOfLane(const RayContext& context, unsigned int lane)
{
  return context.ray ? *context.ray
                     : rayOf(*context.view, Eigen::Vector2d(context.x[lane] + 0.5, context.y[lane] + 0.5));
}

/// Of two hits at nearly the same distance, whether `a` is the one to keep.
bool isBetter(const RayContext& context, unsigned int lane, const Hit& a, const Hit& b)
{
  const ExactRay ray = rayOfLane(context, lane);
  const ExactHit first = context.scene->intersectTriangle(ray, a);
  const ExactHit second = context.scene->intersectTriangle(ray, b);
  if (first.inside != second.inside)
  {
    return first.inside;
  }
  return comesBefore(first.t, a, second.t, b);
}

} // namespace

void rayFilter(const RTCFilterFunctionNArguments* arguments)
{
  auto& context = *reinterpret_cast<RayContext*>(arguments->context);
  const auto* mesh = static_cast<const RayMesh*>(arguments->geometryUserPtr);
  const unsigned int count = arguments->N;
  for (unsigned int i = 0; i < count; ++i)
  {
    if (arguments->valid[i] == 0)
    {
      continue;
    }
    const unsigned int geometry = RTCHitN_geomID(arguments->hit, count, i);
    const Hit hit{ RTCHitN_instID(arguments->hit, count, i, 0) + 1,
      mesh->firstTriangle[geometry] + RTCHitN_primID(arguments->hit, count, i) };
    if (context.mode == RayContext::Mode::Collect)
    {
      context.found->push_back(hit);
      arguments->valid[i] = 0;
      continue;
    }
    const unsigned int lane = RTCRayN_id(arguments->ray, count, i);
    if (context.mode == RayContext::Mode::Checked)
    {
      const ExactHit exactly = context.scene->intersect(*context.ray, hit);
      context.marginal |= exactly.marginal;
      if (hit == context.skip || !exactly.inside)
      {
        arguments->valid[i] = 0;
        continue;
      }
    }
    else if (mesh->cutOut[geometry] && isCutOut(context.scene->state().instances[hit.object - 1], hit.triangle,
                                         context.scene->intersectTriangle(rayOfLane(context, lane), hit).barycentrics))
    {
      arguments->valid[i] = 0;
      continue;
    }
    float& tfar = RTCRayN_tfar(arguments->ray, count, i);
    if (tfar > context.t[lane] * (1 - NearTie) && !isBetter(context, lane, hit, context.best[lane]))
    {
      arguments->valid[i] = 0;
      continue;
    }
    context.t[lane] = tfar;
    context.best[lane] = hit;
    tfar *= 1 + NearTie;
  }
}

} // namespace dgtk
