// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayeredDepth.h"

#include "dgtkPortableMath.h"
#include "dgtkSurfaceLoop.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace dgtk
{

namespace
{
/// Relative difference of depths that drawing cannot tell apart: the resolution of the depth buffer, both ways.
constexpr double sameDepth = 2e-6;
/// Relative slack of a triangle's range of depths, for triangles parallel to the image plane.
constexpr double rangeSlack = 1e-6;
constexpr std::uint32_t distanceSteps = 32;
constexpr std::uint32_t normalSteps = 8;

/// A triangle in the camera frame.
struct TriangleFacts
{
  Eigen::Vector3d normal{ 0, 0, -1 }; ///< unit, of either side
  double nearest = 0;                 ///< depths that it reaches, with slack
  double farthest = 0;
};

TriangleFacts factsOf(const SceneState& state, const View& view, const Hit& hit)
{
  Eigen::Vector3d corner[3];
  triangleInWorld(state, hit, corner);
  for (Eigen::Vector3d& x : corner)
  {
    x = view.camera_from_world * x;
  }
  TriangleFacts facts;
  const Eigen::Vector3d normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
  if (normal.squaredNorm() > 0)
  {
    facts.normal = normal.stableNormalized();
  }
  if (!view.model->linear())
  {
    facts.farthest = std::numeric_limits<double>::infinity(); // rays have found it
    return facts;
  }
  const auto [least, most] = std::minmax({ corner[0].z(), corner[1].z(), corner[2].z() });
  const double slack = rangeSlack * std::abs(most);
  facts.nearest = least - slack;
  facts.farthest = most + slack;
  return facts;
}

std::uint32_t quantised(double unit, std::uint32_t steps)
{
  return static_cast<std::uint32_t>(std::clamp(std::floor(unit * steps), 0.0, double(steps - 1)));
}

/// A splat index; `part`: of the way from near to far, of logarithms.
std::uint32_t packed(double part, const Eigen::Vector3d& normal)
{
  return (quantised(part, distanceSteps) << 6) | (quantised((normal.x() + 1) / 2, normalSteps) << 3) |
         quantised((normal.y() + 1) / 2, normalSteps);
}

bool before(const LayeredSurface& a, const LayeredSurface& b)
{
  return std::tie(a.depth, a.hit.object, a.hit.triangle) < std::tie(b.depth, b.hit.object, b.hit.triangle);
}

/// The layered pixels of rows, one after another.
class Layering
{
public:
  Layering(const SceneState& state, const View& view, const LayeredInput& in, LayeredRows& out)
    : TheView(view)
    , In(in)
    , Out(out)
    , Rays(*view.model)
    , Facts([&state, &view](const Hit& hit) { return factsOf(state, view, hit); })
    , LogOfRange(portable::log(view.far / view.near))
  {
    computeSurfaceRows(state, view, in.rect, in.first, false, this->First);
    computeSurfaceLists(state, view, in.rect, in.begins, in.hits, this->Distances);
  }

  void run()
  {
    std::size_t i = 0;
    for (int y = this->In.rect.y; y < this->In.rect.y + this->In.rect.height; ++y)
    {
      for (int x = this->In.rect.x; x < this->In.rect.x + this->In.rect.width; ++x, ++i)
      {
        this->Pixel.clear();
        if (this->In.first[i].object != 0)
        {
          this->gather(i, x, y);
        }
        this->Out.counts.push_back(static_cast<std::uint32_t>(this->Pixel.size()));
        this->Out.surfaces.insert(this->Out.surfaces.end(), this->Pixel.begin(), this->Pixel.end());
      }
    }
  }

private:
  LayeredSurface make(const Hit& hit, double t, int x, int y)
  {
    const Eigen::Vector3d point = this->Rays.point(x, y, t);
    const Eigen::Vector3d& normal = this->Facts(hit).normal;
    const Eigen::Vector3d direction = this->Rays.direction(x, y);
    LayeredSurface surface;
    surface.hit = hit;
    surface.depth = t;
    surface.splatIndex = packed(portable::log(point.norm() / this->TheView.near) / this->LogOfRange,
      normal.dot(direction) > 0 ? Eigen::Vector3d(-normal) : normal);
    return surface;
  }

  /// `begin`, `end`: what was peeled of the pixel.
  void colour(std::size_t i, std::size_t begin, std::size_t end, LayeredSurface& first) const
  {
    const Hit* const found = std::find(this->In.hits + begin, this->In.hits + end, first.hit);
    const float* shaded = nullptr;
    if (begin < end)
    {
      const auto at = std::size_t(found - this->In.hits);
      shaded = this->In.rgba + 4 * (at < end ? at : begin); // else the pixel was settled after it was drawn
      std::copy_n(shaded, 4, first.rgba.begin());
    }
    if (this->In.rgb && (!shaded || shaded[3] >= 1))
    {
      std::copy_n(this->In.rgb + 3 * i, 3, first.rgba.begin());
      first.rgba[3] = 1;
    }
  }

  void gather(std::size_t i, int x, int y)
  {
    LayeredSurface first = this->make(this->In.first[i], this->First.t[i], x, y);
    if (!std::isfinite(first.depth))
    {
      return;
    }
    const std::size_t begin = this->In.begins[i] - this->In.begins[0];
    const std::size_t end = this->In.begins[i + 1] - this->In.begins[0];
    this->colour(i, begin, end, first);
    this->Pixel.push_back(first);
    for (std::size_t k = begin; k < end; ++k)
    {
      const Hit& hit = this->In.hits[k];
      if (std::isfinite(this->Distances[k]) && !this->has(hit))
      {
        LayeredSurface surface = this->make(hit, this->Distances[k], x, y);
        std::copy_n(this->In.rgba + 4 * k, 4, surface.rgba.begin());
        this->add(surface);
      }
    }
    std::sort(this->Pixel.begin() + 1, this->Pixel.end(), &before);
  }

  bool has(const Hit& hit) const
  {
    return std::any_of(
      this->Pixel.begin(), this->Pixel.end(), [&](const LayeredSurface& surface) { return surface.hit == hit; });
  }

  void add(LayeredSurface& surface)
  {
    const double first = this->Pixel[0].depth;
    const TriangleFacts& facts = this->Facts(surface.hit);
    const bool real = surface.depth >= facts.nearest && surface.depth <= facts.farthest &&
                      surface.depth >= this->TheView.near && surface.depth <= this->TheView.far;
    if (real && surface.depth >= first - sameDepth * first)
    {
      surface.depth = std::max(surface.depth, first);
      this->Pixel.push_back(surface);
    }
  }

  const View& TheView;
  const LayeredInput& In;
  LayeredRows& Out;
  PixelRays Rays;
  TriangleCache<TriangleFacts, std::function<TriangleFacts(const Hit&)>> Facts;
  double LogOfRange;
  SurfaceRows First;
  std::vector<double> Distances; ///< of what was peeled
  std::vector<LayeredSurface> Pixel;
};
} // namespace

void layeredDepthRows(const SceneState& state, const View& view, const LayeredInput& in, LayeredRows& out)
{
  out.counts.clear();
  out.surfaces.clear();
  Layering(state, view, in, out).run();
}

std::uint32_t splatIndex(double distance, const Eigen::Vector3d& normal, double near, double far)
{
  return packed(portable::log(distance / near) / portable::log(far / near), normal);
}

double splatDistance(std::uint32_t index, double near, double far)
{
  return near * portable::pow(far / near, ((index >> 6 & (distanceSteps - 1)) + 0.5) / distanceSteps);
}

Eigen::Vector3d splatNormal(std::uint32_t index)
{
  const double step = 2.0 / normalSteps;
  Eigen::Vector2d n(
    ((index >> 3 & (normalSteps - 1)) + 0.5) * step - 1, ((index & (normalSteps - 1)) + 0.5) * step - 1);
  const double square = n.squaredNorm();
  if (square > 1)
  {
    n /= std::sqrt(square);
  }
  return { n.x(), n.y(), -std::sqrt(std::max(0.0, 1 - n.squaredNorm())) };
}

} // namespace dgtk
