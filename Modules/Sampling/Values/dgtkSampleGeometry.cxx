// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampleGeometry.h"

#include "dgtkError.h"
#include "dgtkObjectPoses.h"
#include "dgtkRandomScene.h"
#include "dgtkText.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dgtk
{

std::vector<std::size_t> objectsLike(const std::vector<std::string>& names, const std::string& pattern)
{
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const std::string& name = names[i];
    const std::size_t hash = name.rfind('#');
    if (isLike(name, pattern) || (hash != std::string::npos && name.substr(0, hash) == pattern))
    {
      found.push_back(i);
    }
  }
  return found;
}

std::vector<std::string> objectNamesOf(const SceneDescription& scene)
{
  std::vector<std::string> names;
  names.reserve(scene.objects.size());
  for (const ObjectDescription& object : scene.objects)
  {
    names.push_back(object.name);
  }
  return names;
}

const std::vector<std::size_t>& SampleGeometry::like(const std::string& pattern) const
{
  const auto [known, isNew] = this->Like.try_emplace(pattern);
  if (isNew)
  {
    known->second = objectsLike(this->Names, pattern);
  }
  return known->second;
}

const Affine3& SampleGeometry::world_from_object(std::size_t object) const
{
  if (this->Places.empty())
  {
    this->Places = ObjectPoses(this->Scene).at(this->Scene.firstFrame());
  }
  return this->Places.at(object);
}

std::shared_ptr<const Model> SampleGeometry::model(std::size_t object) const
{
  return this->Models.model(this->Scene.resolve(this->Scene.objects[object].model));
}

std::shared_ptr<const Geometry> SampleGeometry::geometry(std::size_t object, const Model& model) const
{
  return geometryAt(this->Scene, this->Scene.objects[object], model, this->Scene.firstFrame(), this->Shapes);
}

Eigen::Vector3d SampleGeometry::centreOf(const std::vector<std::size_t>& objects) const
{
  Eigen::Vector3d least = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d most = -least;
  for (const std::size_t object : objects)
  {
    const std::shared_ptr<const Model> model = this->model(object);
    const std::shared_ptr<const Geometry> geometry = this->geometry(object, *model);
    const Affine3& world_from_object = this->world_from_object(object);
    Eigen::AlignedBox3d box(model->boundsMin, model->boundsMax);
    if (geometry != model->rest)
    {
      box.setEmpty();
      std::for_each(
        geometry->positions.begin(), geometry->positions.end(), [&box](const Eigen::Vector3d& x) { box.extend(x); });
    }
    const bool empty = box.isEmpty();
    for (int corner = 0; corner < 8; ++corner)
    {
      Eigen::Vector3d x_in_object = Eigen::Vector3d::Zero();
      for (int axis = 0; axis < 3 && !empty; ++axis)
      {
        x_in_object[axis] = (corner >> axis & 1) != 0 ? box.max()[axis] : box.min()[axis];
      }
      const Eigen::Vector3d x_in_world = world_from_object * x_in_object;
      least = least.cwiseMin(x_in_world);
      most = most.cwiseMax(x_in_world);
    }
  }
  return (least + most) / 2;
}

Eigen::Vector3d SampleGeometry::Surface::corner(std::size_t triangle, std::size_t i) const
{
  return this->world_from_object * this->geometry->positions[this->model->triangles[triangle][i]];
}

Eigen::Vector3d SampleGeometry::Surface::normal(std::size_t triangle) const
{
  const Eigen::Vector3d a = this->corner(triangle, 0);
  return (this->corner(triangle, 1) - a).cross(this->corner(triangle, 2) - a);
}

const SampleGeometry::Surface& SampleGeometry::surface(std::size_t object) const
{
  const auto known = this->Surfaces.find(object);
  if (known != this->Surfaces.end())
  {
    return known->second;
  }
  Surface surface;
  surface.model = this->model(object);
  surface.geometry = this->geometry(object, *surface.model);
  surface.world_from_object = this->world_from_object(object);
  for (std::size_t t = 0; t < surface.model->triangles.size(); ++t)
  {
    surface.sums.push_back((t == 0 ? 0 : surface.sums.back()) + surface.normal(t).norm());
  }
  return this->Surfaces.emplace(object, std::move(surface)).first->second;
}

DrawnSurfacePoint SampleGeometry::onSurface(std::size_t object, const std::array<double, 3>& uniforms) const
{
  const Surface& surface = this->surface(object);
  const std::vector<double>& sums = surface.sums;
  if (sums.empty() || !(sums.back() > 0))
  {
    const ObjectDescription& it = this->Scene.objects[object];
    throw InputError(
      this->Scene.title(), it.line, "the model of " + quoted(it.name) + " has no surface to draw points on");
  }
  const auto chosen = std::upper_bound(sums.begin(), sums.end(), uniforms[0] * sums.back());
  const std::size_t t = std::size_t(std::min(chosen, sums.end() - 1) - sums.begin());
  const double root = std::sqrt(uniforms[1]);
  DrawnSurfacePoint point;
  point.x_in_world = surface.corner(t, 0) * (1 - root) + surface.corner(t, 1) * (root * (1 - uniforms[2])) +
                     surface.corner(t, 2) * (root * uniforms[2]);
  const double side = surface.world_from_object.linear.determinant() < 0 ? -1 : 1;
  point.normal_in_world = side * surface.normal(t).normalized();
  return point;
}

Eigen::Vector3d SampleGeometry::at(const GeometryPoint& point, const std::vector<std::size_t>& objects) const
{
  if (!point.onSurface)
  {
    return this->centreOf(objects) + point.numbers;
  }
  const DrawnSurfacePoint found =
    this->onSurface(objects.front(), { point.numbers[0], point.numbers[1], point.numbers[2] });
  return found.x_in_world + point.above * found.normal_in_world;
}

} // namespace dgtk
