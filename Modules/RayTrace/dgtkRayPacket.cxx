// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRayPacket.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr int Lanes = 16;
constexpr int Side = 4;

/// Whether a hit is too close to an edge, seen too much edge-on, or too close to the ends of the range for single
/// precision. In the axes of the mesh: u, v of the hit have the error (error of a position) * (longest edge) *
/// |direction| / |normal * direction|, with Embree's normal of twice the triangle's area.
bool isDoubtful(
  const RayScene::Placed& placed, const RTCRayHit16& packet, int lane, std::uint32_t triangle, float least, float most)
{
  const float* m = placed.mesh_from_camera;
  const float dx = packet.ray.dir_x[lane];
  const float dy = packet.ray.dir_y[lane];
  const float dz = packet.ray.dir_z[lane];
  const float x = m[0] * dx + m[1] * dy + m[2] * dz;
  const float y = m[3] * dx + m[4] * dy + m[5] * dz;
  const float z = m[6] * dx + m[7] * dy + m[8] * dz;
  const float length = std::sqrt(x * x + y * y + z * z);
  const float along = std::abs(x * packet.hit.Ng_x[lane] + y * packet.hit.Ng_y[lane] + z * packet.hit.Ng_z[lane]);
  const float u = packet.hit.u[lane];
  const float v = packet.hit.v[lane];
  const float t = packet.ray.tfar[lane];
  const float position = float(RayPrecision) * (t * length + placed.sizes);
  const bool clear =
    std::min(std::min(u, v), 1 - u - v) * along > position * placed.mesh->longestEdge[triangle] * length;
  return !(clear && t > least && t < most);
}

} // namespace

PacketRays::PacketRays(const dgtk::View& view)
  : TheView(view)
  , Linear(view.model->linear().has_value())
{
  if (this->Linear)
  {
    this->Perspective = view.model->linear()->perspective;
    this->First = view.model->rayThrough({ 0.5, 0.5 });
    const CameraRay right = view.model->rayThrough({ 1.5, 0.5 });
    const CameraRay below = view.model->rayThrough({ 0.5, 1.5 });
    this->AlongX = { right.origin - this->First.origin, right.direction - this->First.direction };
    this->AlongY = { below.origin - this->First.origin, below.direction - this->First.direction };
  }
}

void PacketRays::set(RTCRayHit16& packet, int lane, int x, int y) const
{
  CameraRay ray;
  if (this->Linear)
  {
    ray.origin = this->First.origin + x * this->AlongX.origin + y * this->AlongY.origin;
    ray.direction = this->First.direction + x * this->AlongX.direction + y * this->AlongY.direction;
  }
  else
  {
    ray = this->TheView.model->rayThrough({ x + 0.5, y + 0.5 });
  }
  packet.ray.org_x[lane] = float(ray.origin.x());
  packet.ray.org_y[lane] = float(ray.origin.y());
  packet.ray.org_z[lane] = float(ray.origin.z());
  packet.ray.dir_x[lane] = float(ray.direction.x());
  packet.ray.dir_y[lane] = float(ray.direction.y());
  packet.ray.dir_z[lane] = float(ray.direction.z());
}

template <bool Exact>
void tracePacket(
  const RayScene& scene, const PacketRays& rays, const PixelRect& block, VisibilityBuffer& buffer, RayMarks& marks)
{
  RayContext context;
  rtcInitIntersectContext(&context.context);
  context.context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  context.scene = &scene;
  context.view = &rays.view();
  const float near = float(rays.view().near);
  const float far = float(rays.view().far);
  alignas(64) RTCRayHit16 packet;
  alignas(64) int valid[Lanes];
  for (int lane = 0; lane < Lanes; ++lane)
  {
    const int x = block.x + std::min(lane % Side, block.width - 1);
    const int y = block.y + std::min(lane / Side, block.height - 1);
    valid[lane] = lane % Side < block.width && lane / Side < block.height ? -1 : 0;
    rays.set(packet, lane, x, y);
    packet.ray.tnear[lane] = near * (1 - NearTie);
    packet.ray.tfar[lane] = far * (1 + NearTie);
    packet.ray.time[lane] = 0;
    packet.ray.mask[lane] = ~0U;
    packet.ray.id[lane] = unsigned(lane);
    packet.ray.flags[lane] = 0;
    packet.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    packet.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    if (Exact)
    {
      context.x[lane] = x;
      context.y[lane] = y;
      context.t[lane] = INFINITY;
    }
  }
  rtcIntersect16(valid, scene.handle(), &context.context, &packet);
  const float least = near * (1 + NearTie);
  const float most = far * (1 - NearTie);
  for (int y = 0; y < block.height; ++y)
  {
    const std::size_t row = std::size_t(block.y - buffer.rect.y + y) * buffer.rect.width + (block.x - buffer.rect.x);
    for (int x = 0; x < block.width; ++x)
    {
      const int lane = y * Side + x;
      const bool any = packet.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
      const unsigned int instance = packet.hit.instID[0][lane];
      const Hit hit = any ? scene.hit(instance, packet.hit.geomID[lane], packet.hit.primID[lane]) : Hit{};
      buffer.hits[row + x] = hit;
      if (Exact)
      {
        marks.nearness[row + x] = any ? 1 / packet.ray.tfar[lane] : 0;
        marks.doubtful[row + x] = any && isDoubtful(scene.placed(instance), packet, lane, hit.triangle, least, most);
      }
    }
  }
}

template void tracePacket<true>(const RayScene&, const PacketRays&, const PixelRect&, VisibilityBuffer&, RayMarks&);
template void tracePacket<false>(const RayScene&, const PacketRays&, const PixelRect&, VisibilityBuffer&, RayMarks&);

} // namespace dgtk
