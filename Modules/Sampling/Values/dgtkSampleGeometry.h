// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSampleGeometry_h
#define dgtkSampleGeometry_h

#include "dgtkDistributions.h"
#include "dgtkSampleModels.h"
#include "dgtkSceneDescription.h"

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace dgtk
{

/// Indices of the objects whose names are like a pattern with `*` and `?`. "cup" is also like the instances of a
/// counted object, "cup#1", "cup#2" ...
std::vector<std::size_t> objectsLike(const std::vector<std::string>& names, const std::string& pattern);
std::vector<std::string> objectNamesOf(const SceneDescription& scene);

/// Where the objects of a scene are, at its first frame.
class SampleGeometry
{
public:
  /// Both outlive it. The scene has objects alone.
  SampleGeometry(const SceneDescription& scene, SampleModels& models)
    : Scene(scene)
    , Models(models)
  {
  }

  /// Of the objects like a pattern: the centre of the box along the world's axes that holds the corners of their
  /// models' boxes. There is at least one. Throws what SampleModels::model() throws.
  Eigen::Vector3d centreOf(const std::vector<std::size_t>& objects) const;
  Eigen::Vector3d at(const GeometryPoint& point, const std::vector<std::size_t>& objects) const;

private:
  const SceneDescription& Scene;
  SampleModels& Models;
};

} // namespace dgtk

#endif
