// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkShadowViews.h"

#include "dgtkPortableMath.h"
#include "dgtkSeenSurfaces.h"
#include "dgtkShadowNotes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace dgtk
{
namespace
{

constexpr double largestCone = 60; // degrees, half the opening of a light with a single map
constexpr double margin = 1.0 + 1e-6;
constexpr int mostMaps = 4;            // of a directional light
constexpr int largestOfSeveral = 8192; // texels a side: four have as many as the largest single one
constexpr double fineTexel = 1e-3;     // texel, of the image's height, that needs no further maps
constexpr double gain = 1.1;           // what a further map must bring
constexpr int stepsOfSide = 32;        // places of a window within its own side
constexpr double coarsePixels = 8;
constexpr double unseen = 1.0 / 255; // strength of a light that does not show

/// Axes as OpenGL's for a view along `axis`: rows x, y, z.
Eigen::Matrix3d axesAlong(const Eigen::Vector3d& axis, const Eigen::Vector3d& up)
{
  const Eigen::Vector3d z = -axis.normalized();
  const Eigen::Vector3d x = up.cross(z).normalized();
  Eigen::Matrix3d axes;
  axes << x.transpose(), z.cross(x).transpose(), z.transpose();
  return axes;
}

/// The world axis that is most across `axis`.
Eigen::Vector3d across(const Eigen::Vector3d& axis)
{
  Eigen::Vector3d::Index least = 0;
  axis.cwiseAbs().minCoeff(&least);
  return Eigen::Vector3d::Unit(least);
}

void setDepths(RasterCamera& camera, double near, double far, bool zeroToOne)
{
  camera.near = near;
  camera.far = far;
  Eigen::Matrix4d& clip = camera.clip_from_view;
  clip.row(2).setZero();
  const double scale = camera.perspective ? near : 1.0;
  clip(2, 2) = scale / (far - near);
  clip(2, 3) = scale * far / (far - near);
  if (!zeroToOne)
  {
    clip.row(2) = 2 * clip.row(2) - clip.row(3);
  }
}

/// Texels around what is seen: the way off a surface, and the comparisons. Small maps have less.
double border(int size) { return std::min(6.0, size / 8.0); }

/// What is seen between two depths, in the axes of a directional light.
struct Slice
{
  Eigen::AlignedBox3d box;
  double least = std::numeric_limits<double>::infinity(); ///< depth

  void add(const Slice& other)
  {
    this->box.extend(other.box);
    this->least = std::min(this->least, other.least);
  }
};

/// Texels between the places of a window.
int stepOf(int size) { return std::max(1, size / stepsOfSide); }

/// Side of a map that holds a slice: with the border, in steps, so that it stays the same while the camera moves on.
double sideFor(const Slice& slice, int size)
{
  const double extent = slice.box.sizes().head<2>().maxCoeff();
  const double rounding = 1e-9 * slice.box.min().cwiseAbs().cwiseMax(slice.box.max().cwiseAbs()).maxCoeff();
  const double share = 1 - (2 * border(size) + stepOf(size)) / size;
  const double side = std::max({ extent / share, rounding, 1e-30 });
  return std::exp2(std::ceil(8 * std::log2(side)) / 8);
}

class LightFit
{
public:
  LightFit(const LightState& light, const SeenSurfaces& seen)
    : Light(light)
    , Seen(seen)
    , Axis(light.target - light.position)
    , Axes(axesAlong(Axis, across(Axis)))
    , Slope(std::tan(halfAngle(light) * pi / 180))
  {
  }

  void add(int slice, const Polygon& polygon)
  {
    if (!traitsOf(this->Light.kind).near)
    {
      this->addSlice(this->Slices[slice], polygon);
      return;
    }
    this->Lit = polygon;
    if (oneCone(this->Light))
    {
      this->cutToCone();
    }
    for (const Eigen::Vector3d& x : this->Lit)
    {
      this->addPoint(x);
    }
  }
  void addViews(const SceneState& state, double imageHeight, bool zeroToOne, std::vector<ShadowView>& views) const;

private:
  static bool oneCone(const LightState& light) { return traitsOf(light.kind).cone && light.coneAngle <= largestCone; }
  /// A rim of a texel or two, so that the comparisons at the cone's border find neighbours.
  static double halfAngle(const LightState& light)
  {
    return oneCone(light) ? light.coneAngle + 2.0 * light.coneAngle / light.shadowSize
                          : 45.0 + 180.0 / light.shadowSize;
  }

  void addSlice(Slice& slice, const Polygon& polygon) const
  {
    for (const Eigen::Vector3d& x : polygon)
    {
      slice.box.extend(this->Axes * x);
      slice.least = std::min(slice.least, this->Seen.depthOf(x));
    }
  }

  void addPoint(const Eigen::Vector3d& x)
  {
    const double distance = (x - this->Light.position).norm();
    this->Reach = std::max(this->Reach, distance);
    const Eigen::Vector3d& k = this->Light.attenuation;
    const double strength =
      this->Light.intensity * std::max(this->Light.diffuse.maxCoeff(), this->Light.specular.maxCoeff());
    if (strength >= unseen * (k[0] + distance * (k[1] + distance * k[2])))
    {
      this->Coarsest = std::max(this->Coarsest, distance / this->Seen.heightAt(this->Seen.depthOf(x)));
    }
  }

  void cutToCone()
  {
    for (int side = 0; side < 4 && !this->Lit.empty(); ++side)
    {
      Eigen::Vector4d plane;
      plane.head<3>() =
        -this->Slope * this->Axes.row(2).transpose() + (side % 2 ? -1 : 1) * this->Axes.row(side / 2).transpose();
      plane.w() = -plane.head<3>().dot(this->Light.position);
      cutPolygon(this->Lit, plane, this->Spare);
    }
  }

  std::vector<Slice> grouped(int& size) const;
  double coarseness(const Slice& slice, int size) const
  {
    return sideFor(slice, size) / size / this->Seen.heightAt(slice.least);
  }
  double nearestCaster(const SceneState& state) const;
  ShadowView parallelView(const Slice& slice, int size, double nearest, bool zeroToOne) const;
  ShadowView perspectiveView(const Eigen::Matrix3d& axes, bool zeroToOne) const;

  const LightState& Light;
  const SeenSurfaces& Seen;
  Eigen::Vector3d Axis;
  Eigen::Matrix3d Axes;
  double Slope;                // of lights with a place
  std::map<int, Slice> Slices; // of directional lights
  double Reach = 0;            // of lights with a place: to the farthest point that is seen
  double Coarsest = 0;         // and the largest distance, in heights of the image where it is seen
  Polygon Lit;
  Polygon Spare;
};

/// The slices, neighbours joined to what a map holds: in as few maps as are fine enough, or bring something, so that
/// the coarsest is as fine as it can be. `size` becomes that of the maps.
std::vector<Slice> LightFit::grouped(int& size) const
{
  std::vector<Slice> slices;
  for (const auto& entry : this->Slices)
  {
    slices.push_back(entry.second);
  }
  const std::size_t count = slices.size();
  const std::size_t most = std::min<std::size_t>(mostMaps, count);
  const int several = std::min(size, largestOfSeveral);
  constexpr double none = std::numeric_limits<double>::infinity();
  // Of the first j slices in k maps: how coarse the coarsest is, and where the last map begins.
  std::array<std::vector<double>, mostMaps + 1> coarsest;
  std::array<std::vector<std::size_t>, mostMaps + 1> begin;
  coarsest.fill(std::vector<double>(count + 1, none));
  begin.fill(std::vector<std::size_t>(count + 1, 0));
  coarsest[0][0] = 0;
  for (std::size_t k = 1; k <= most; ++k)
  {
    for (std::size_t j = k; j <= count; ++j)
    {
      Slice last;
      for (std::size_t i = j; i-- > 0;)
      {
        last.add(slices[i]);
        const double value = std::max(coarsest[k - 1][i], this->coarseness(last, k == 1 ? size : several));
        if (value < coarsest[k][j])
        {
          coarsest[k][j] = value;
          begin[k][j] = i;
        }
      }
    }
  }
  double best = none;
  for (std::size_t k = 1; k <= most; ++k)
  {
    best = std::min(best, coarsest[k][count]);
  }
  std::size_t k = 1;
  while (coarsest[k][count] > std::max(fineTexel, gain * best))
  {
    ++k;
  }
  size = k == 1 ? size : several;
  std::vector<Slice> groups(k);
  for (std::size_t j = count; k > 0; j = begin[k + 1][j])
  {
    --k;
    for (std::size_t i = begin[k + 1][j]; i < j; ++i)
    {
      groups[k].add(slices[i]);
    }
  }
  return groups;
}

/// The largest coordinate of anything along the axis towards the light.
double LightFit::nearestCaster(const SceneState& state) const
{
  double nearest = -std::numeric_limits<double>::infinity();
  for (const Instance& instance : state.instances)
  {
    if (!instance.visible)
    {
      continue;
    }
    for (const Eigen::Vector3d& position : instance.geometry->positions)
    {
      nearest = std::max(nearest, this->Axes.row(2).dot(instance.world_from_object * position));
    }
  }
  return nearest;
}

ShadowView LightFit::parallelView(const Slice& slice, int size, double nearest, bool zeroToOne) const
{
  ShadowView view;
  const double side = sideFor(slice, size);
  view.size = size;
  view.texel = side / size;
  const double step = view.texel * stepOf(size);
  const auto from = [&](int axis)
  { return std::floor((slice.box.min()[axis] - border(size) * view.texel) / step) * step; };
  const Eigen::Vector3d eye(from(0) + side / 2, from(1) + side / 2, nearest + view.texel);
  view.camera.perspective = false;
  view.camera.view_from_world.setIdentity();
  view.camera.view_from_world.topLeftCorner<3, 3>() = this->Axes;
  view.camera.view_from_world.topRightCorner<3, 1>() = -eye;
  view.camera.clip_from_view.setZero();
  view.camera.clip_from_view(0, 0) = view.camera.clip_from_view(1, 1) = 2 / side;
  view.camera.clip_from_view(3, 3) = 1;
  setDepths(view.camera, 0, eye.z() - slice.box.min().z() + border(size) * view.texel, zeroToOne);
  view.camera.focal = size / side;
  view.pixels = view.texel / this->Seen.heightAt(slice.least);
  return view;
}

ShadowView LightFit::perspectiveView(const Eigen::Matrix3d& axes, bool zeroToOne) const
{
  ShadowView view;
  view.size = this->Light.shadowSize;
  const double far = this->Reach * margin;
  view.camera.perspective = true;
  view.camera.view_from_world.setIdentity();
  view.camera.view_from_world.topLeftCorner<3, 3>() = axes;
  view.camera.view_from_world.topRightCorner<3, 1>() = -axes * this->Light.position;
  view.camera.clip_from_view.setZero();
  view.camera.clip_from_view(0, 0) = view.camera.clip_from_view(1, 1) = 1 / this->Slope;
  view.camera.clip_from_view(3, 2) = -1;
  // A depth of floats has the same relative precision at all distances, unless OpenGL stretches it to [-1, 1].
  setDepths(view.camera, far * (zeroToOne ? 1e-6 : 1e-4), far, zeroToOne);
  view.camera.focal = view.size / (2 * this->Slope);
  view.texel = 2 * this->Slope / view.size;
  view.pixels = view.texel * this->Coarsest;
  return view;
}

void LightFit::addViews(
  const SceneState& state, double imageHeight, bool zeroToOne, std::vector<ShadowView>& views) const
{
  const std::size_t first = views.size();
  if (!this->Slices.empty())
  {
    int size = this->Light.shadowSize;
    const std::vector<Slice> groups = this->grouped(size);
    const double nearest = this->nearestCaster(state);
    for (std::size_t i = 0; i < groups.size(); ++i)
    {
      views.push_back(this->parallelView(groups[i], size, nearest, zeroToOne));
      views.back().nested = int(groups.size() - i);
    }
  }
  else if (this->Reach > 0 && oneCone(this->Light))
  {
    views.push_back(this->perspectiveView(this->Axes, zeroToOne));
  }
  else if (this->Reach > 0)
  {
    for (int face = 0; face < 6; ++face)
    {
      const Eigen::Vector3d axis = Eigen::Vector3d::Unit(face / 2) * (face % 2 == 0 ? 1.0 : -1.0);
      views.push_back(this->perspectiveView(axesAlong(axis, Eigen::Vector3d::Unit((face / 2 + 1) % 3)), zeroToOne));
      views.back().cube = true;
    }
  }
  for (std::size_t i = first; i < views.size(); ++i)
  {
    views[i].pixels *= imageHeight;
  }
}

bool castsShadows(const LightState& light) { return light.shadows && traitsOf(light.kind).shadows; }

} // namespace

std::vector<ShadowView> shadowViews(
  const SceneState& state, const View& view, bool zeroToOne, std::vector<int>& firstOfLight)
{
  firstOfLight.assign(state.lights.size(), -1);
  std::vector<ShadowView> views;
  if (std::none_of(state.lights.begin(), state.lights.end(), castsShadows))
  {
    return views;
  }
  SeenSurfaces seen(view);
  std::vector<std::pair<std::size_t, LightFit>> fits;
  for (std::size_t i = 0; i < state.lights.size(); ++i)
  {
    if (castsShadows(state.lights[i]))
    {
      fits.emplace_back(i, LightFit(state.lights[i], seen));
    }
  }
  seen.visit(state,
    [&fits](int slice, const Polygon& polygon)
    {
      for (auto& fit : fits)
      {
        fit.second.add(slice, polygon);
      }
    });
  for (const auto& [light, fit] : fits)
  {
    const std::size_t before = views.size();
    fit.addViews(state, view.model->height(), zeroToOne, views);
    firstOfLight[light] = views.size() > before ? int(before) : -1;
  }
  return views;
}

std::vector<CoarseShadow> coarseShadows(const SceneState& state, const View& view)
{
  std::vector<int> firsts;
  const std::vector<ShadowView> views = shadowViews(state, view, true, firsts);
  std::vector<CoarseShadow> coarse;
  for (std::size_t light = 0; light < firsts.size(); ++light)
  {
    if (firsts[light] >= 0)
    {
      const auto first = views.begin() + firsts[light];
      double pixels = first->pixels;
      for (int i = 1; i < first->nested; ++i)
      {
        pixels = std::max(pixels, first[i].pixels);
      }
      if (pixels > coarsePixels)
      {
        coarse.push_back({ light, pixels });
      }
    }
  }
  return coarse;
}

} // namespace dgtk
