// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayeredDepth.h"

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
  {
    computeSurfaceRows(state, view, in.rect, in.first, false, this->First);
    this->Ranks.resize(in.ranks.size());
    for (std::size_t r = 0; r < in.ranks.size(); ++r)
    {
      computeSurfaceRows(state, view, in.rect, in.ranks[r].hits, false, this->Ranks[r]);
    }
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
    surface.splatIndex = splatIndex(point.norm(), normal.dot(direction) > 0 ? Eigen::Vector3d(-normal) : normal,
      this->TheView.near, this->TheView.far);
    return surface;
  }

  void colour(std::size_t i, const LayeredInput& in, LayeredSurface& first) const
  {
    const float* shaded = nullptr;
    for (const PeeledRows& rank : in.ranks)
    {
      if (rank.hits[i] == first.hit)
      {
        shaded = rank.rgba + 4 * i;
        break;
      }
    }
    if (!shaded && !in.ranks.empty() && in.ranks[0].hits[i].object != 0)
    {
      shaded = in.ranks[0].rgba + 4 * i; // the pixel was settled after it was drawn
    }
    if (shaded)
    {
      std::copy_n(shaded, 4, first.rgba.begin());
    }
    if (in.rgb && (!shaded || shaded[3] >= 1))
    {
      std::copy_n(in.rgb + 3 * i, 3, first.rgba.begin());
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
    this->colour(i, this->In, first);
    this->Pixel.push_back(first);
    for (std::size_t r = 0; r < this->Ranks.size(); ++r)
    {
      const Hit& hit = this->In.ranks[r].hits[i];
      if (hit.object != 0 && std::isfinite(this->Ranks[r].t[i]) && !this->has(hit))
      {
        LayeredSurface surface = this->make(hit, this->Ranks[r].t[i], x, y);
        std::copy_n(this->In.ranks[r].rgba + 4 * i, 4, surface.rgba.begin());
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
  SurfaceRows First;
  std::vector<SurfaceRows> Ranks;
  std::vector<LayeredSurface> Pixel;
};

std::uint32_t quantised(double unit, std::uint32_t steps)
{
  return static_cast<std::uint32_t>(std::clamp(std::floor(unit * steps), 0.0, double(steps - 1)));
}
} // namespace

void layeredDepthRows(const SceneState& state, const View& view, const LayeredInput& in, LayeredRows& out)
{
  out.counts.clear();
  out.surfaces.clear();
  Layering(state, view, in, out).run();
}

std::uint32_t splatIndex(double distance, const Eigen::Vector3d& normal, double near, double far)
{
  const std::uint32_t d = quantised(std::log(distance / near) / std::log(far / near), distanceSteps);
  return (d << 6) | (quantised((normal.x() + 1) / 2, normalSteps) << 3) | quantised((normal.y() + 1) / 2, normalSteps);
}

double splatDistance(std::uint32_t index, double near, double far)
{
  return near * std::pow(far / near, ((index >> 6 & (distanceSteps - 1)) + 0.5) / distanceSteps);
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
