// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSampleGeometry_h
#define dgtkSampleGeometry_h

#include "dgtkDistributions.h"
#include "dgtkModelClock.h"
#include "dgtkRigid3.h"
#include "dgtkSampleModels.h"
#include "dgtkSceneDescription.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// Indices of the objects whose names are like a pattern with `*` and `?`. "cup" is also like the instances of a
/// counted object, "cup#1", "cup#2" ...
std::vector<std::size_t> objectsLike(const std::vector<std::string>& names, const std::string& pattern);
std::vector<std::string> objectNamesOf(const SceneDescription& scene);

/// A point of an object's surface, world frame.
struct DrawnSurfacePoint
{
  Eigen::Vector3d x_in_world{ 0, 0, 0 };
  Eigen::Vector3d normal_in_world{ 0, 1, 0 }; ///< of the triangle, unit length, on its front side
};

/// Where the objects of a scene are, and what shape deforming models have, at its first frame. What was asked once is
/// kept: a forest of counted trees asks for the same ground as often as it has trees. One thread.
class SampleGeometry
{
public:
  /// Both outlive it, and the scene does not change. It has objects alone.
  SampleGeometry(const SceneDescription& scene, SampleModels& models)
    : Scene(scene)
    , Models(models)
    , Names(objectNamesOf(scene))
  {
  }

  const std::vector<std::string>& names() const { return this->Names; }
  /// objectsLike() of the names.
  const std::vector<std::size_t>& like(const std::string& pattern) const;
  /// Of the objects like a pattern: the centre of the box along the world's axes that holds the corners of their
  /// models' boxes. There is at least one. Throws what SampleModels::model() throws.
  Eigen::Vector3d centreOf(const std::vector<std::size_t>& objects) const;
  /// The point of the surface of an object that three uniforms in [0, 1) stand for: the first chooses the triangle by
  /// its area in the world, the others the point in it, so that uniforms give points uniform over the area. Throws what
  /// SampleModels::model() throws, and InputError, at the object's line, for a model without area.
  DrawnSurfacePoint onSurface(std::size_t object, const std::array<double, 3>& uniforms) const;
  Eigen::Vector3d at(const GeometryPoint& point, const std::vector<std::size_t>& objects) const;

private:
  struct Surface
  {
    std::shared_ptr<const Model> model;
    std::shared_ptr<const Geometry> geometry;
    Affine3 world_from_object;
    std::vector<double> sums; ///< of twice the areas of the triangles up to each, world frame

    Eigen::Vector3d corner(std::size_t triangle, std::size_t i) const;
    Eigen::Vector3d normal(std::size_t triangle) const; ///< as long as twice the area
  };
  const Affine3& world_from_object(std::size_t object) const;
  std::shared_ptr<const Model> model(std::size_t object) const;
  /// The shape of its model.
  std::shared_ptr<const Geometry> geometry(std::size_t object, const Model& model) const;
  const Surface& surface(std::size_t object) const;

  const SceneDescription& Scene;
  SampleModels& Models;
  mutable GeometryCache Shapes;
  std::vector<std::string> Names;
  mutable std::map<std::string, std::vector<std::size_t>> Like;
  mutable std::vector<Affine3> Places; ///< of all objects, when one was asked for
  mutable std::map<std::size_t, Surface> Surfaces;
};

} // namespace dgtk

#endif
