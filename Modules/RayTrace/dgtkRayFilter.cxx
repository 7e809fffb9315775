// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRayScene.h"

#include "dgtkSurfaceRows.h"

#include <emmintrin.h>

namespace dgtk
{

namespace
{

ExactRay rayOfLane(const RayContext& context, unsigned int lane)
{
  return context.rays
           ? context.rays[lane]
           : rayOf(*context.view, Eigen::Vector2d(context.x + int(lane % 4) + 0.5, context.y + int(lane / 4) + 0.5));
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

/// One bit a lane that is not 0.
unsigned int activeLanes(const int* valid, unsigned int count)
{
  unsigned int lanes = 0;
  if (count == 16)
  {
    const __m128i zero = _mm_setzero_si128();
    const auto load = [&](int i)
    { return _mm_cmpeq_epi32(_mm_loadu_si128(reinterpret_cast<const __m128i*>(valid) + i), zero); };
    const __m128i low = _mm_packs_epi32(load(0), load(1));
    const __m128i high = _mm_packs_epi32(load(2), load(3));
    return ~unsigned(_mm_movemask_epi8(_mm_packs_epi16(low, high))) & 0xFFFFU;
  }
  for (unsigned int i = 0; i < count; ++i)
  {
    lanes |= unsigned(valid[i] != 0) << i;
  }
  return lanes;
}

Hit hitOf(const RayMesh& mesh, const RTCFilterFunctionNArguments& arguments, unsigned int i)
{
  return { RTCHitN_instID(arguments.hit, arguments.N, i, 0) + 1,
    mesh.firstTriangle[RTCHitN_geomID(arguments.hit, arguments.N, i)] + RTCHitN_primID(arguments.hit, arguments.N, i) };
}

/// Whether the hit at `t` becomes the nearest of its lane; never when all hits are collected.
bool accept(RayContext& context, const RayMesh& mesh, unsigned int geometry, unsigned int lane, const Hit& hit, float t)
{
  switch (context.mode)
  {
    case RayContext::Mode::Collect:
      context.found[lane].push_back(hit);
      return false;
    case RayContext::Mode::Checked:
    {
      bool uncertain = false;
      const bool inside = context.scene->intersect(context.rays[lane], hit, uncertain, context.triangles).inside;
      context.marginal |= unsigned(uncertain) << lane;
      if (hit == context.skip[lane] || !inside)
      {
        return false;
      }
      break;
    }
    case RayContext::Mode::Nearest:
      if (mesh.cutOut[geometry] && isCutOut(context.scene->state().instances[hit.object - 1], hit.triangle,
                                     context.scene->intersectTriangle(rayOfLane(context, lane), hit).barycentrics))
      {
        return false;
      }
      break;
  }
  return !(t > context.t[lane] - context.scene->slack(t)) || isBetter(context, lane, hit, context.best[lane]);
}

} // namespace

void rayFilter(const RTCFilterFunctionNArguments* arguments)
{
  auto& context = *reinterpret_cast<RayContext*>(arguments->context);
  const auto* mesh = static_cast<const RayMesh*>(arguments->geometryUserPtr);
  const unsigned int count = arguments->N;
  for (unsigned int lanes = activeLanes(arguments->valid, count); lanes != 0; lanes &= lanes - 1)
  {
    const unsigned int i = unsigned(__builtin_ctz(lanes));
    const unsigned int geometry = RTCHitN_geomID(arguments->hit, count, i);
    const Hit hit = hitOf(*mesh, *arguments, i);
    const unsigned int lane = RTCRayN_id(arguments->ray, count, i);
    float& tfar = RTCRayN_tfar(arguments->ray, count, i);
    if (!accept(context, *mesh, geometry, lane, hit, tfar))
    {
      arguments->valid[i] = 0;
      continue;
    }
    context.t[lane] = tfar;
    context.best[lane] = hit;
    tfar += context.scene->slack(tfar);
  }
}

} // namespace dgtk
