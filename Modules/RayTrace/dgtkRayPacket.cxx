// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRayPacket.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

PacketTracer::PacketTracer(const RayScene& scene, const View& view, bool coherent)
  : Scene(scene)
  , TheView(view)
  , Linear(view.model->linear().has_value())
  , Near(float(view.near))
  , Far(float(view.far))
{
  rtcInitIntersectContext(&this->Context.context);
  this->Context.context.flags = coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  this->Context.scene = &scene;
  this->Context.view = &view;
  RTCRay16& ray = this->Packet.ray;
  for (int lane = 0; lane < lanes; ++lane)
  {
    ray.org_x[lane] = ray.org_y[lane] = ray.org_z[lane] = 0;
    ray.dir_x[lane] = ray.dir_y[lane] = 0;
    ray.dir_z[lane] = 1;
    ray.tnear[lane] = this->Near * (1 - rangeSlack);
    ray.time[lane] = 0;
    ray.mask[lane] = ~0U;
    ray.id[lane] = unsigned(lane);
    ray.flags[lane] = 0;
  }
  if (this->Linear)
  {
    const bool perspective = view.model->linear()->perspective;
    this->VaryingX = perspective ? ray.dir_x : ray.org_x;
    this->VaryingY = perspective ? ray.dir_y : ray.org_y;
    this->Least = perspective ? halfRounding : 0;
    const auto at = [&](double x, double y)
    {
      const CameraRay r = view.model->rayThrough({ x, y });
      return perspective ? r.direction : r.origin;
    };
    const Eigen::Vector3d first = at(0.5, 0.5);
    const Eigen::Vector3d right = at(1.5, 0.5);
    const Eigen::Vector3d below = at(0.5, 1.5);
    this->FirstX = first.x();
    this->StepX = right.x() - first.x();
    this->Skew = below.x() - first.x();
    this->FirstY = first.y();
    this->StepY = below.y() - first.y();
    const Eigen::Vector3d size(1, 3 * view.model->width(), 3 * view.model->height()); // what is around the image, too
    const Eigen::Vector3d x(this->FirstX, this->StepX, this->Skew);
    const Eigen::Vector3d y(this->FirstY, 0, this->StepY);
    this->Traceable = isTraceable(x.cwiseProduct(size), y.cwiseProduct(size));
  }
}

void PacketTracer::setLinear(const PixelRect& block)
{
  for (int j = 0; j < side; ++j)
  {
    const double y = std::min(block.y + j, block.y + block.height - 1);
    const double skew = this->FirstX + this->Skew * y;
    const float row = this->component(this->FirstY + this->StepY * y);
    for (int i = 0; i < side; ++i)
    {
      const double x = std::min(block.x + i, block.x + block.width - 1);
      this->VaryingX[side * j + i] = this->component(skew + this->StepX * x);
      this->VaryingY[side * j + i] = row;
    }
  }
}

void PacketTracer::setGeneral(const PixelRect& block)
{
  RTCRay16& out = this->Packet.ray;
  Eigen::Vector2d pixels[lanes];
  CameraRay rays[lanes];
  for (int lane = 0; lane < lanes; ++lane)
  {
    const int x = block.x + std::min(lane % side, block.width - 1);
    const int y = block.y + std::min(lane / side, block.height - 1);
    pixels[lane] = { x + 0.5, y + 0.5 };
  }
  this->TheView.model->raysThrough(pixels, lanes, rays);
  for (int lane = 0; lane < lanes; ++lane)
  {
    const CameraRay& ray = rays[lane];
    this->Valid[lane] = ray.exists() && isTraceable(ray.origin, ray.direction) ? this->Valid[lane] : 0;
    out.org_x[lane] = float(ray.origin.x());
    out.org_y[lane] = float(ray.origin.y());
    out.org_z[lane] = float(ray.origin.z());
    const Eigen::Vector3d direction = withoutRoundings(ray.direction);
    out.dir_x[lane] = float(direction.x());
    out.dir_y[lane] = float(direction.y());
    out.dir_z[lane] = float(direction.z());
  }
}

/// Directions of the lanes in the axes of their mesh, what else takes part in the error, and 1 / (longest edge) of the
/// triangles. Lanes without a hit get anything finite.
void PacketTracer::toMesh(MeshLanes& out) const
{
  const RTCRay16& ray = this->Packet.ray;
  const RTCHit16& hit = this->Packet.hit;
  unsigned int instance = RTC_INVALID_GEOMETRY_ID;
  for (int i = 0; i < lanes; ++i)
  {
    instance = std::min(instance, hit.instID[0][i]);
  }
  unsigned int others = 0;
  for (int i = 0; i < lanes; ++i)
  {
    others |= unsigned(hit.instID[0][i] != instance) & unsigned(hit.instID[0][i] != RTC_INVALID_GEOMETRY_ID);
  }
  const RayScene::Placed& placed = this->Scene.placed(instance);
  if (others == 0 && placed.mesh->firstTriangle.size() == 1)
  {
    float m[9];
    std::copy(placed.mesh_from_camera, placed.mesh_from_camera + 9, m);
    const float sizes = placed.sizes;
    alignas(64) unsigned int triangle[lanes];
    for (int i = 0; i < lanes; ++i)
    {
      out.x[i] = m[0] * ray.dir_x[i] + m[1] * ray.dir_y[i] + m[2] * ray.dir_z[i];
      out.y[i] = m[3] * ray.dir_x[i] + m[4] * ray.dir_y[i] + m[5] * ray.dir_z[i];
      out.z[i] = m[6] * ray.dir_x[i] + m[7] * ray.dir_y[i] + m[8] * ray.dir_z[i];
      out.sizes[i] = sizes;
      triangle[i] = hit.geomID[i] == RTC_INVALID_GEOMETRY_ID ? 0 : hit.primID[i];
    }
    const float* inverse = placed.mesh->inverseEdge.data();
    for (int i = 0; i < lanes; ++i)
    {
      out.inverseEdge[i] = inverse[triangle[i]];
    }
    return;
  }
  for (int i = 0; i < lanes; ++i)
  {
    const bool any = hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
    const RayScene::Placed& own = this->Scene.placed(any ? hit.instID[0][i] : instance);
    const float* m = own.mesh_from_camera;
    out.x[i] = m[0] * ray.dir_x[i] + m[1] * ray.dir_y[i] + m[2] * ray.dir_z[i];
    out.y[i] = m[3] * ray.dir_x[i] + m[4] * ray.dir_y[i] + m[5] * ray.dir_z[i];
    out.z[i] = m[6] * ray.dir_x[i] + m[7] * ray.dir_y[i] + m[8] * ray.dir_z[i];
    out.sizes[i] = own.sizes;
    out.inverseEdge[i] = any ? own.mesh->inverseEdge[own.mesh->firstTriangle[hit.geomID[i]] + hit.primID[i]] : 0;
  }
}

/// Whether each hit is far enough from the edges of its triangle, not too edge-on and far enough from the ends of the
/// range for single precision. In the axes of the mesh: u, v of a hit have the error (error of a position) * (longest
/// edge) * |direction| / |normal * direction|, with Embree's normal of twice the triangle's area, and t the error
/// (error of a position) * |normal| / |normal * direction|.
void PacketTracer::findClear(int clear[lanes]) const
{
  const RTCRay16& ray = this->Packet.ray;
  const RTCHit16& hit = this->Packet.hit;
  const float least = this->Near * (1 + rangeSlack);
  const float most = this->Far * (1 - rangeSlack);
  constexpr float precision = float(2 * rayPrecision * rayPrecision); // (a + b)^2 <= 2 (a^2 + b^2)
  MeshLanes at;
  this->toMesh(at);
  for (int i = 0; i < lanes; ++i)
  {
    const float x = at.x[i];
    const float y = at.y[i];
    const float z = at.z[i];
    const float t = ray.tfar[i];
    const float square = x * x + y * y + z * z;
    const float facing = x * hit.Ng_x[i] + y * hit.Ng_y[i] + z * hit.Ng_z[i];
    const float along = facing * at.inverseEdge[i];
    const float u = hit.u[i];
    const float v = hit.v[i];
    const float w = 1 - u - v;
    const float ofPosition = precision * (t * t * square + at.sizes[i] * at.sizes[i]);
    const float error = ofPosition * square;
    const float distance = along * along;
    const float normal = hit.Ng_x[i] * hit.Ng_x[i] + hit.Ng_y[i] * hit.Ng_y[i] + hit.Ng_z[i] * hit.Ng_z[i];
    const float ofRange = ofPosition * normal;
    const float fromNear = (t - this->Near) * facing;
    const float toFar = (this->Far - t) * facing;
    clear[i] = (u > 0) & (v > 0) & (w > 0) & (u * u * distance > error) & (v * v * distance > error) &
               (w * w * distance > error) & (t > least) & (t < most) & (fromNear * fromNear > ofRange) &
               (toFar * toFar > ofRange);
  }
}

bool PacketTracer::anyHit() const
{
  unsigned int all = RTC_INVALID_GEOMETRY_ID;
  for (const unsigned int geometry : this->Packet.hit.geomID)
  {
    all &= geometry;
  }
  return all != RTC_INVALID_GEOMETRY_ID;
}

void PacketTracer::mark(const PixelRect& block, const VisibilityBuffer& buffer, RayMarks& marks)
{
  int clear[lanes] = {};
  if (this->anyHit())
  {
    this->findClear(clear);
  }
  alignas(64) float nearness[lanes];
  std::uint8_t doubtful[lanes];
  for (int lane = 0; lane < lanes; ++lane)
  {
    const bool any = this->Packet.hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID;
    const float inverse = 1 / this->Packet.ray.tfar[lane];
    nearness[lane] = any ? inverse : 0;
    doubtful[lane] = any & (clear[lane] == 0);
  }
  for (int y = 0; y < block.height; ++y)
  {
    const std::size_t row = std::size_t(block.y - buffer.rect.y + y) * buffer.rect.width + (block.x - buffer.rect.x);
    std::copy_n(nearness + side * y, block.width, &marks.nearness[row]);
    std::copy_n(doubtful + side * y, block.width, &marks.doubtful[row]);
  }
}

template <TraceMode Mode>
void PacketTracer::trace(const PixelRect& block, VisibilityBuffer& buffer, RayMarks& marks)
{
  for (int lane = 0; lane < lanes; ++lane)
  {
    this->Valid[lane] = this->Traceable && lane % side < block.width && lane / side < block.height ? -1 : 0;
  }
  if (this->Linear)
  {
    this->setLinear(block);
  }
  else
  {
    this->setGeneral(block);
  }
  RTCHit16& hit = this->Packet.hit;
  for (int lane = 0; lane < lanes; ++lane)
  {
    this->Packet.ray.tfar[lane] = this->Far * (1 + rangeSlack);
    hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
    hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    this->Context.t[lane] = INFINITY;
  }
  this->Context.mode = RayContext::Mode::Nearest;
  this->Context.context.filter = Mode == TraceMode::Exact ? rayFilter : nullptr;
  this->Context.x = block.x;
  this->Context.y = block.y;
  embree().Intersect16(this->Valid, this->Scene.handle(), &this->Context.context, &this->Packet);
  for (int y = 0; y < block.height; ++y)
  {
    Hit* row = &buffer.at(block.x, block.y + y);
    for (int x = 0; x < block.width; ++x)
    {
      const int lane = y * side + x;
      row[x] = hit.geomID[lane] != RTC_INVALID_GEOMETRY_ID
                 ? this->Scene.hit(hit.instID[0][lane], hit.geomID[lane], hit.primID[lane])
                 : Hit{};
    }
  }
  if (Mode != TraceMode::Bare)
  {
    this->mark(block, buffer, marks);
  }
}

template void PacketTracer::trace<TraceMode::Exact>(const PixelRect&, VisibilityBuffer&, RayMarks&);
template void PacketTracer::trace<TraceMode::Bare>(const PixelRect&, VisibilityBuffer&, RayMarks&);

} // namespace dgtk
