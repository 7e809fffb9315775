// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSurfaceLoop_h
#define dgtkSurfaceLoop_h

#include "dgtkRepresentation.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace dgtk
{

/// Value of `parts` and `triangles` where there is nothing.
constexpr std::uint32_t noId = 0xFFFFFFFFu;

/// Calls body(index, x, y, value) for every pixel of `in` with a surface, in rows top to bottom; `index` into
/// SurfaceRows::t and hits, `value` the pixel's channels. The others get `invalid` in all channels.
template <typename T, int Channels, typename Body>
void forSurface(const SurfaceRows& in, Rows& out, T invalid, const Body& body)
{
  std::size_t index = 0;
  for (int y = in.rect.y; y < in.rect.y + in.rect.height; ++y)
  {
    T* value = out.row<T>(y) + std::ptrdiff_t(in.rect.x) * Channels;
    for (int x = in.rect.x; x < in.rect.x + in.rect.width; ++x, ++index, value += Channels)
    {
      if (in.t[index] < std::numeric_limits<double>::infinity())
      {
        body(index, x, y, value);
      }
      else
      {
        std::fill(value, value + Channels, invalid);
      }
    }
  }
}

/// What a representation derives once per triangle, kept for the triangles of a strip. A value depends on its triangle
/// only.
template <typename Value, typename Make>
class TriangleCache
{
public:
  explicit TriangleCache(const Make& make)
    : MakeValue(make)
    , Entries(entryCount)
  {
  }
  const Value& operator()(const Hit& hit)
  {
    Entry& entry =
      this->Entries[(std::size_t(hit.triangle * 0x9E3779B1u ^ hit.object * 0x85EBCA77u) >> 7) % entryCount];
    if (entry.hit != hit)
    {
      entry.hit = hit;
      entry.value = this->MakeValue(hit);
    }
    return entry.value;
  }

private:
  static constexpr std::size_t entryCount = 256;
  struct Entry
  {
    Hit hit;
    Value value;
  };
  Make MakeValue;
  std::vector<Entry> Entries;
};

template <typename Value, typename Make>
TriangleCache<Value, Make> cachePerTriangle(const Make& make)
{
  return TriangleCache<Value, Make>(make);
}

/// Part of a hit's triangle within its object. Neighbouring pixels mostly meet the same part.
class PartLookup
{
public:
  explicit PartLookup(const SceneState& state)
    : State(state)
  {
  }
  std::uint32_t part(const Hit& hit)
  {
    this->find(hit);
    return this->Part;
  }
  /// The triangle, counted within its part.
  std::uint32_t triangle(const Hit& hit)
  {
    this->find(hit);
    return hit.triangle - this->First + this->Base;
  }

private:
  void find(const Hit& hit)
  {
    if (hit.object == this->Object && hit.triangle - this->First < this->Count)
    {
      return;
    }
    const Instance& instance = this->State.instances[hit.object - 1];
    const Model& model = *instance.model;
    const std::uint32_t part = model.partOf(hit.triangle);
    this->Object = hit.object;
    this->Part = instance.firstPart + part;
    this->First = model.parts[part].firstTriangle;
    this->Count = model.parts[part].triangles;
    this->Base = instance.firstInPart;
  }
  const SceneState& State;
  std::uint32_t Object = 0;
  std::uint32_t Part = 0;
  std::uint32_t First = 0;
  std::uint32_t Count = 0;
  std::uint32_t Base = 0;
};

/// Rays through the centres of pixels without a virtual call: of a linear lens, or of rows whose rays are known.
class PixelRays
{
public:
  explicit PixelRays(const SurfaceRows& in)
    : PixelRays(*in.view->model)
  {
    this->Known = in.rays.empty() ? nullptr : &in;
  }
  explicit PixelRays(const CameraModel& model)
    : Model(model)
    , Linear(model.linear())
  {
    if (this->Linear)
    {
      this->K = this->Linear->K;
      this->Perspective = this->Linear->perspective;
      this->InverseFx = 1 / this->K(0, 0);
      this->InverseFy = 1 / this->K(1, 1);
    }
  }

  /// The point at parameter t of the ray through the centre of pixel (x, y), camera frame.
  Eigen::Vector3d point(int x, int y, double t) const
  {
    if (!this->Linear)
    {
      const CameraRay ray = this->ray(x, y);
      return ray.origin + t * ray.direction;
    }
    const double v = (y + 0.5 - this->K(1, 2)) * this->InverseFy;
    const double u = (x + 0.5 - this->K(0, 2) - this->K(0, 1) * v) * this->InverseFx;
    return this->Perspective ? Eigen::Vector3d(u * t, v * t, t) : Eigen::Vector3d(u, v, t);
  }

  /// The direction of the ray through the centre of pixel (x, y), camera frame, not normalised.
  Eigen::Vector3d direction(int x, int y) const
  {
    if (!this->Linear)
    {
      return this->ray(x, y).direction;
    }
    return this->Perspective ? this->point(x, y, 1) : Eigen::Vector3d(0, 0, 1);
  }

private:
  CameraRay ray(int x, int y) const
  {
    return this->Known
             ? this->Known
                 ->rays[std::size_t(y - this->Known->rect.y) * this->Known->rect.width + x - this->Known->rect.x]
             : this->Model.rayThrough({ x + 0.5, y + 0.5 });
  }

  const CameraModel& Model;
  const SurfaceRows* Known = nullptr;
  std::optional<LinearProjection> Linear;
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
  double InverseFx = 1;
  double InverseFy = 1;
  bool Perspective = false;
};

} // namespace dgtk

#endif
