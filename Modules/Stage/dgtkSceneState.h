// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneState_h
#define dgtkSceneState_h

#include "dgtkStageModule.h"

#include "dgtkCameraModel.h"
#include "dgtkLightKind.h"
#include "dgtkModel.h"
#include "dgtkRigid3.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

/// A named point of an object at one instant.
struct KeypointState
{
  std::string name;
  Eigen::Vector3d x_in_object{ 0, 0, 0 };
};

/// One object of the scene at one instant, or one of many copies of a model that together are an object. An object's id
/// is its index in SceneState::instances plus 1.
struct Instance
{
  std::string name;
  std::string className;
  std::uint32_t classId = 0;                ///< as the scene fixes it; 0: it does not
  std::shared_ptr<const Model> model;       ///< shared by all instances of one file
  std::shared_ptr<const Geometry> geometry; ///< model->rest, or the deformed vertices at this instant
  std::shared_ptr<const std::vector<Material>>
    materials;               ///< model's, or overridden by the scene; one per Model::materials
  Affine3 world_from_object; ///< includes scale and parents; may mirror
  bool visible = true;       ///< otherwise nothing of it is there at this instant, but it has its place and its id
  std::vector<KeypointState> keypoints; ///< as the scene lists them

  // Of a copy.
  std::uint32_t copyOf = 0;        ///< id of its object; 0: it is an object
  Affine3 object_from_model;       ///< `world_from_object` is the object's times this
  std::uint32_t firstPart = 0;     ///< what its part 0 is in the object
  std::uint32_t firstTriangle = 0; ///< what its triangle 0 is in the object ...
  std::uint32_t firstInPart = 0;   ///< ... and in the object's part
};

/// A light at one instant, world frame. Attenuation: 1 / (constant + linear d + quadratic d^2).
struct LightState
{
  std::string name;
  LightKind kind = LightKind::Point;
  Eigen::Vector3d position{ 0, 0, 0 };
  Eigen::Vector3d target{ 0, 0, 0 };
  Eigen::Vector3d ambient{ 0, 0, 0 };
  Eigen::Vector3d diffuse{ 1, 1, 1 };
  Eigen::Vector3d specular{ 1, 1, 1 };
  Eigen::Vector3d attenuation{ 1, 0, 0 };
  double coneAngle = 30; ///< degrees, half the opening
  double exponent = 1;   ///< fall-off inside the cone
  double intensity = 1;
  bool shadows = false;  ///< objects cast shadows in its light
  int shadowSize = 2048; ///< texels a side of its shadow map
};

/// Light from everywhere.
struct EnvironmentState
{
  std::shared_ptr<const RadianceImage> image; ///< equirectangular
  double intensity = 1;
  bool background = true; ///< seen where nothing is
  /// A direction in the image's axes: its centre column is -z, its right quarter +x, its top row +y.
  Eigen::Matrix3d image_from_world = Eigen::Matrix3d::Identity();
};

/// exp(-density (distance - start)) of a colour is left beyond `start`.
struct FogState
{
  Eigen::Vector3d color{ 0.5, 0.5, 0.5 }; ///< sRGB in [0, 1]
  double density = 0;                     ///< 0: there is none
  double start = 0;
};

/// Everything of a scene at one instant. Immutable and safe to share between threads.
struct SceneState
{
  double frame = 0;
  /// Objects with geometry, in the scene's order, object id = index + 1; then `copies` copies, in the order of their
  /// objects. An object that is made of copies is not visible itself, they are. Hits have index + 1 of either.
  std::vector<Instance> instances;
  std::size_t copies = 0;
  std::vector<LightState> lights;                      ///< enabled ones; a single Head light when the scene has none
  Eigen::Vector3d background{ 0, 0, 0 };               ///< sRGB in [0, 1]
  std::shared_ptr<const EnvironmentState> environment; ///< null: there is none
  FogState fog;
  bool cutsAtWhite = false; ///< light above it, before it is blended

  std::size_t objects() const { return this->instances.size() - this->copies; }
  /// The object's id of what a hit has as its object; 0 for 0.
  std::uint32_t objectOf(std::uint32_t hit) const
  {
    return hit <= this->objects() ? hit : this->instances[hit - 1].copyOf;
  }
};

} // namespace dgtk

#endif
