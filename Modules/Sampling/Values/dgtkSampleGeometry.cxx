// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampleGeometry.h"

#include "dgtkObjectPoses.h"
#include "dgtkPlacement.h"
#include "dgtkRandomScene.h"

#include <limits>

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

Eigen::Vector3d SampleGeometry::centreOf(const std::vector<std::size_t>& objects) const
{
  const ObjectPoses poses(this->Scene);
  Eigen::Vector3d least = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d most = -least;
  for (const std::size_t object : objects)
  {
    const std::shared_ptr<const Model> model =
      this->Models.model(this->Scene.resolve(this->Scene.objects[object].model));
    const Affine3 world_from_object = poses.of(object, this->Scene.firstFrame());
    const bool empty = (model->boundsMin.array() > model->boundsMax.array()).any();
    for (int corner = 0; corner < 8; ++corner)
    {
      Eigen::Vector3d x_in_object = Eigen::Vector3d::Zero();
      for (int axis = 0; axis < 3 && !empty; ++axis)
      {
        x_in_object[axis] = (corner >> axis & 1) != 0 ? model->boundsMax[axis] : model->boundsMin[axis];
      }
      const Eigen::Vector3d x_in_world = world_from_object * x_in_object;
      least = least.cwiseMin(x_in_world);
      most = most.cwiseMax(x_in_world);
    }
  }
  return (least + most) / 2;
}

Eigen::Vector3d SampleGeometry::at(const GeometryPoint& point, const std::vector<std::size_t>& objects) const
{
  if (!point.onSurface)
  {
    return this->centreOf(objects) + point.numbers;
  }
  const DrawnSurfacePoint found = placement().pointOnSurface(this->Scene, objects.front(), this->Scene.firstFrame(),
    { point.numbers[0], point.numbers[1], point.numbers[2] }, this->Models);
  return found.x_in_world + point.above * found.normal_in_world;
}

} // namespace dgtk
