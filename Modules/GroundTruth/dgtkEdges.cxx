// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEdges.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr double tolerance = 0.01; // of the smaller range

bool holds(const PixelPlane& plane, const Eigen::Vector3d& other, double slack)
{
  return std::abs(plane.normal.dot(other - plane.point)) <= slack;
}

Eigen::Vector3d normalInCamera(const SurfaceRows& row, const Hit& hit)
{
  Eigen::Vector3d corners[3];
  triangleInWorld(*row.state, hit, corners);
  return row.view->camera_from_world.rotation *
         (corners[1] - corners[0]).cross(corners[2] - corners[0]).stableNormalized();
}
} // namespace

std::uint8_t edgeBetween(const PixelPlane& a, const PixelPlane& b)
{
  if (a.object != b.object)
  {
    return objectEdge;
  }
  const double slack = tolerance * std::min(a.range, b.range);
  return a.object != 0 && !holds(a, b.point, slack) && !holds(b, a.point, slack) ? depthEdge : noEdge;
}

std::vector<PixelPlane> pixelPlanes(const SurfaceRows& row)
{
  std::vector<PixelPlane> planes(row.t.size());
  for (std::size_t x = 0; x < planes.size(); ++x)
  {
    if (!std::isfinite(row.t[x]))
    {
      continue;
    }
    const CameraRay ray = row.view->model->rayThrough({ row.rect.x + double(x) + 0.5, row.rect.y + 0.5 });
    planes[x].object = row.state->objectOf(row.hits[x].object);
    planes[x].point = ray.origin + row.t[x] * ray.direction;
    planes[x].range = row.t[x];
    planes[x].normal =
      x > 0 && row.hits[x] == row.hits[x - 1] ? planes[x - 1].normal : normalInCamera(row, row.hits[x]);
  }
  return planes;
}

std::vector<std::uint8_t> EdgeRows::next(std::vector<PixelPlane> row)
{
  std::vector<std::uint8_t> marks(row.size(), noEdge);
  for (std::size_t x = 0; x < this->Above.size(); ++x)
  {
    marks[x] = edgeBetween(this->Above[x], row[x]);
    this->Marks[x] = std::max(this->Marks[x], marks[x]);
  }
  for (std::size_t x = 1; x < row.size(); ++x)
  {
    const std::uint8_t edge = edgeBetween(row[x - 1], row[x]);
    marks[x - 1] = std::max(marks[x - 1], edge);
    marks[x] = std::max(marks[x], edge);
  }
  this->Above = std::move(row);
  this->Marks.swap(marks);
  return marks;
}

} // namespace dgtk
