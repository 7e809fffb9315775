// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSeenSurfaces.h"

#include "dgtkRasterCamera.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{
namespace
{

constexpr double rim = 1.0625; // of half the image; more than the widest filter from 96 pixels on

int sliceOf(double depth) { return int(std::floor(2 * std::log2(std::max(depth, 1e-300)))); }

} // namespace

void cutPolygon(Polygon& polygon, const Eigen::Vector4d& plane, Polygon& spare)
{
  spare.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Eigen::Vector3d& a = polygon[i];
    const Eigen::Vector3d& b = polygon[(i + 1) % polygon.size()];
    const double atA = plane.dot(a.homogeneous());
    const double atB = plane.dot(b.homogeneous());
    if (atA >= 0)
    {
      spare.push_back(a);
    }
    if ((atA >= 0) != (atB >= 0))
    {
      spare.push_back(a + (b - a) * (atA / (atA - atB)));
    }
  }
  polygon.swap(spare);
}

SeenSurfaces::SeenSurfaces(const View& view)
{
  const RasterCamera camera = rasterCamera(view, { 0, 0, view.model->width(), view.model->height() }, 1, true);
  this->Perspective = camera.perspective;
  this->Height = 2 / camera.clip_from_view(1, 1);
  const Eigen::Matrix4d clip_from_world = camera.clip_from_view * camera.view_from_world;
  this->Depth = -camera.view_from_world.row(2).transpose();
  for (int side = 0; side < 4; ++side)
  {
    this->Sides.row(side) = rim * clip_from_world.row(3) + (side % 2 ? -1 : 1) * clip_from_world.row(side / 2);
  }
  this->Sides.row(4) = this->Depth.transpose();
  this->Sides(4, 3) -= view.near;
  this->Sides.row(5) = -this->Depth.transpose();
  this->Sides(5, 3) += view.far;
}

void SeenSurfaces::visit(const SceneState& state, const std::function<void(int slice, const Polygon&)>& visitor)
{
  std::vector<Eigen::Vector3d> positions;
  std::vector<unsigned int> outside; // a bit for each side
  for (const Instance& instance : state.instances)
  {
    if (!instance.visible)
    {
      continue;
    }
    positions.clear();
    outside.clear();
    for (const Eigen::Vector3d& position : instance.geometry->positions)
    {
      positions.push_back(instance.world_from_object * position);
      const Eigen::Matrix<double, 6, 1> sides = this->Sides * positions.back().homogeneous();
      outside.push_back(0);
      for (int side = 0; side < 6; ++side)
      {
        outside.back() |= sides[side] < 0 ? 1u << side : 0u;
      }
    }
    for (const auto& [a, b, c] : instance.model->triangles)
    {
      if ((outside[a] & outside[b] & outside[c]) != 0)
      {
        continue;
      }
      this->Whole.assign({ positions[a], positions[b], positions[c] });
      for (int side = 0; side < 6; ++side)
      {
        if (((outside[a] | outside[b] | outside[c]) & 1u << side) != 0)
        {
          cutPolygon(this->Whole, this->Sides.row(side).transpose(), this->Spare);
        }
      }
      this->visitTriangle(visitor);
    }
  }
}

/// Cuts what is Whole at the depths of the slices.
void SeenSurfaces::visitTriangle(const std::function<void(int slice, const Polygon&)>& visitor)
{
  if (this->Whole.empty())
  {
    return;
  }
  double least = 1e300;
  double most = 0;
  for (const Eigen::Vector3d& x : this->Whole)
  {
    least = std::min(least, this->depthOf(x));
    most = std::max(most, this->depthOf(x));
  }
  const int last = sliceOf(most);
  for (int slice = sliceOf(least); slice <= last; ++slice)
  {
    this->Part = this->Whole;
    if (most > std::exp2((slice + 1) / 2.0))
    {
      const Eigen::Vector4d nearer = Eigen::Vector4d::Unit(3) * std::exp2((slice + 1) / 2.0) - this->Depth;
      cutPolygon(this->Part, nearer, this->Spare);
    }
    if (least < std::exp2(slice / 2.0))
    {
      const Eigen::Vector4d farther = this->Depth - Eigen::Vector4d::Unit(3) * std::exp2(slice / 2.0);
      cutPolygon(this->Part, farther, this->Spare);
    }
    if (!this->Part.empty())
    {
      visitor(slice, this->Part);
    }
  }
}

} // namespace dgtk
