// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCorrespondence.h"

#include <cmath>
#include <limits>
#include <vector>

namespace dgtk
{

namespace
{
constexpr double nowhere = std::numeric_limits<double>::quiet_NaN();

bool isInside(const Eigen::Vector2d& pixel, const CameraModel& model)
{
  return pixel.x() >= 0 && pixel.y() >= 0 && pixel.x() <= model.width() && pixel.y() <= model.height();
}

/// Parameter of a point on its ray.
double alongRay(const Eigen::Vector3d& x_in_camera, const Eigen::Vector2d& pixel, const CameraModel& model)
{
  if (model.linear())
  {
    return x_in_camera.z();
  }
  const CameraRay ray = model.rayThrough(pixel);
  return (x_in_camera - ray.origin).dot(ray.direction) / ray.direction.squaredNorm();
}
} // namespace

Eigen::Vector3d carriedPoint(const SceneState& state, const Hit& hit, const Eigen::Vector2d& barycentrics)
{
  const Instance& instance = state.instances[hit.object - 1];
  const auto& corners = instance.model->triangles[hit.triangle];
  const std::vector<Eigen::Vector3d>& p = instance.geometry->positions;
  const Eigen::Vector3d& first = p[corners[0]];
  return instance.world_from_object *
         (first + barycentrics.x() * (p[corners[1]] - first) + barycentrics.y() * (p[corners[2]] - first));
}

Correspondence correspond(const OtherView& other, const Hit& hit, const Eigen::Vector2d& barycentrics)
{
  Correspondence result;
  const Eigen::Vector3d world = carriedPoint(*other.state, hit, barycentrics);
  const Eigen::Vector3d point = other.view.camera_from_world * world;
  if (!other.view.model->project(point, result.pixel))
  {
    result.visibility = VisibilityClass::Behind;
    return result;
  }
  const double t = alongRay(point, result.pixel, *other.view.model);
  if (!isInside(result.pixel, *other.view.model) || t < other.view.near || t > other.view.far)
  {
    result.visibility = VisibilityClass::Outside;
    return result;
  }
  const Hit before = other.occlusion->occluder(other.view, world, hit);
  result.visibility = before.object == 0            ? VisibilityClass::Visible
                      : before.object == hit.object ? VisibilityClass::OccludedByOwn
                                                    : VisibilityClass::OccludedByOther;
  return result;
}

Correspondence correspondPixel(const SceneState& state, const View& view, const OcclusionQuery& occlusion,
  const Eigen::Vector2d& pixel, const OtherView& other, Hit* hit)
{
  std::vector<Hit> hits;
  occlusion.allHits(view, pixel, hits);
  const Hit first = hits.empty() ? Hit{} : hits.front();
  if (hit)
  {
    *hit = first;
  }
  if (first.object == 0)
  {
    return {};
  }
  const SurfacePoint point = surfacePointAt(state, view, pixel, first);
  return std::isfinite(point.t) ? correspond(other, first, point.barycentrics) : Correspondence{};
}

void correspondRows(const SurfaceRows& in, const OtherView& other, double* pixels, std::uint8_t* classes)
{
  for (std::size_t i = 0; i < in.t.size(); ++i)
  {
    Correspondence found;
    if (std::isfinite(in.t[i]))
    {
      found = correspond(other, in.hits[i], { in.barycentrics[2 * i], in.barycentrics[2 * i + 1] });
    }
    pixels[2 * i] = found.pixel.x();
    pixels[2 * i + 1] = found.pixel.y();
    classes[i] = static_cast<std::uint8_t>(found.visibility);
  }
}

void sceneFlowRows(const SurfaceRows& in, const SceneState& next, double* motion)
{
  const Eigen::Matrix3d& rotation = in.view->camera_from_world.rotation;
  for (std::size_t i = 0; i < in.t.size(); ++i)
  {
    Eigen::Map<Eigen::Vector3d> value(motion + 3 * i);
    value.setConstant(nowhere);
    if (std::isfinite(in.t[i]))
    {
      const Eigen::Vector2d barycentrics(in.barycentrics[2 * i], in.barycentrics[2 * i + 1]);
      value =
        rotation * (carriedPoint(next, in.hits[i], barycentrics) - carriedPoint(*in.state, in.hits[i], barycentrics));
    }
  }
}

} // namespace dgtk
