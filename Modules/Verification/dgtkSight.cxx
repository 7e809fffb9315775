// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSight.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <limits>

namespace dgtk
{

Sight::Sight(Eye eye, std::shared_ptr<const SceneState> state, std::shared_ptr<const OcclusionQuery> query)
  : TheEye(std::move(eye))
  , State(std::move(state))
  , Query(std::move(query))
{
  for (const Instance& instance : this->State->instances)
  {
    this->Placed.push_back(this->TheEye.view().camera_from_world * instance.world_from_object);
  }
}

void Sight::corners(const Hit& hit, Eigen::Vector3d out[3]) const
{
  const Instance& instance = this->instance(hit.object);
  const auto& triangle = instance.model->triangles[hit.triangle];
  for (int i = 0; i < 3; ++i)
  {
    out[i] = this->cameraFromObject(hit.object) * instance.geometry->positions[triangle[i]];
  }
}

Eigen::Vector3d Sight::normal(const Hit& hit) const
{
  const Instance& instance = this->instance(hit.object);
  const auto& triangle = instance.model->triangles[hit.triangle];
  const std::vector<Eigen::Vector3d>& p = instance.geometry->positions;
  const Eigen::Matrix3d& linear = this->cameraFromObject(hit.object).linear;
  return (linear * (p[triangle[1]] - p[triangle[0]])).cross(linear * (p[triangle[2]] - p[triangle[0]]));
}

double Sight::depthOf(const Hit& hit, const Eigen::Vector2d& pixel) const
{
  const CameraRay ray = this->TheEye.ray(pixel);
  const double t = this->along(hit, ray);
  return std::isfinite(t) ? ray.origin.z() + t * ray.direction.z() : t;
}

double Sight::rangeOf(const Hit& hit, const Eigen::Vector2d& pixel) const
{
  return this->TheEye.linear() ? this->depthOf(hit, pixel) : this->along(hit, this->TheEye.ray(pixel));
}

/// Parameter of the ray; infinite where it does not meet the plane before the camera.
double Sight::along(const Hit& hit, const CameraRay& ray) const
{
  if (hit.object == 0)
  {
    return std::numeric_limits<double>::infinity();
  }
  Eigen::Vector3d corner[3];
  this->corners(hit, corner);
  // The nearest corner in view of the ray rounds least.
  const Eigen::Vector3d n = this->normal(hit);
  int nearest = 0;
  for (int i = 1; i < 3; ++i)
  {
    nearest = corner[i].squaredNorm() < corner[nearest].squaredNorm() ? i : nearest;
  }
  const double t = n.dot(corner[nearest] - ray.origin) / n.dot(ray.direction);
  return t > 0 && std::isfinite(t) ? t : std::numeric_limits<double>::infinity();
}

void Sight::surfaces(const Eigen::Vector2d& pixel, std::vector<Hit>& hits, std::vector<double>& ranges) const
{
  this->Query->allHits(this->TheEye.view(), pixel, hits);
  ranges.clear();
  for (const Hit& hit : hits)
  {
    ranges.push_back(this->rangeOf(hit, pixel));
  }
}

Eigen::Vector3d Sight::weights(const Hit& hit, const Eigen::Vector3d& x) const
{
  Eigen::Vector3d corner[3];
  this->corners(hit, corner);
  const Eigen::Vector3d n = this->normal(hit);
  // Areas opposite the corners, seen along the normal.
  const double area = n.squaredNorm();
  Eigen::Vector3d weight;
  for (int i = 0; i < 3; ++i)
  {
    const Eigen::Vector3d& a = corner[(i + 1) % 3];
    const Eigen::Vector3d& b = corner[(i + 2) % 3];
    weight[i] = (a - x).cross(b - x).dot(n) / area;
  }
  return weight;
}

Carrier::Carrier(const Sight& from, std::shared_ptr<const SceneState> to)
  : From(from)
  , To(std::move(to))
{
  for (std::size_t i = 0; i < this->To->instances.size(); ++i)
  {
    const Instance& then = this->To->instances[i];
    const Affine3& camera_from_object = from.cameraFromObject(static_cast<std::uint32_t>(i + 1));
    Way way;
    way.rigid = then.geometry == from.instance(static_cast<std::uint32_t>(i + 1)).geometry;
    const double determinant = camera_from_object.linear.determinant();
    way.regular = std::isfinite(1 / determinant);
    if (way.rigid && way.regular)
    {
      const Eigen::Matrix3d inverse = camera_from_object.linear.inverse();
      way.world_from_camera.linear = then.world_from_object.linear * inverse;
      way.world_from_camera.translation =
        then.world_from_object.translation - way.world_from_camera.linear * camera_from_object.translation;
    }
    this->Ways.push_back(way);
  }
}

Carried Carrier::operator()(const Hit& hit, const Eigen::Vector3d& x_in_camera) const
{
  const Way& way = this->Ways[hit.object - 1];
  if (way.rigid)
  {
    return { way.regular, way.world_from_camera * x_in_camera };
  }
  const Eigen::Vector3d weight = this->From.weights(hit, x_in_camera);
  const Instance& then = this->To->instances[hit.object - 1];
  const auto& triangle = then.model->triangles[hit.triangle];
  const std::vector<Eigen::Vector3d>& p = then.geometry->positions;
  const Eigen::Vector3d& first = p[triangle[0]];
  const Eigen::Vector3d point = first + weight[1] * (p[triangle[1]] - first) + weight[2] * (p[triangle[2]] - first);
  return { weight.allFinite(), then.world_from_object * point };
}

} // namespace dgtk
