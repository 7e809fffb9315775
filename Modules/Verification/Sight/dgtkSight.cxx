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

Eigen::Vector3d pointOf(const Instance& instance, const Hit& hit, const Eigen::Vector3d& weights)
{
  const auto& triangle = instance.model->triangles[hit.triangle];
  const std::vector<Eigen::Vector3d>& p = instance.geometry->positions;
  const Eigen::Vector3d& first = p[triangle[0]];
  return instance.world_from_object *
         (first + weights[1] * (p[triangle[1]] - first) + weights[2] * (p[triangle[2]] - first));
}

Carried carried(const Sight& from, const Instance& then, const Hit& hit, const Eigen::Vector3d& x_in_camera)
{
  if (then.geometry != from.instance(hit.object).geometry)
  {
    const Eigen::Vector3d weights = from.weights(hit, x_in_camera);
    return { weights.allFinite(), pointOf(then, hit, weights) };
  }
  const Affine3& camera_from_object = from.cameraFromObject(hit.object);
  if (!std::isfinite(1 / camera_from_object.linear.determinant()))
  {
    return {};
  }
  const Eigen::Matrix3d linear = then.world_from_object.linear * camera_from_object.linear.inverse();
  const Eigen::Vector3d translation = then.world_from_object.translation - linear * camera_from_object.translation;
  return { true, linear * x_in_camera + translation };
}

} // namespace dgtk
