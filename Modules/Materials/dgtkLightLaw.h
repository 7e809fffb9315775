// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLightLaw_h
#define dgtkLightLaw_h

#include "dgtkMaterialsModule.h"

#include "dgtkSceneState.h"

#include <Eigen/Core>

#include <string>

namespace dgtk
{

/// Where a light is and how it falls, in the frame of whoever asks.
struct LightShape
{
  Eigen::Vector3d position{ 0, 0, 0 };
  Eigen::Vector3d axis{ 0, 0, 0 };        ///< unit vector along which it shines
  Eigen::Vector3d attenuation{ 1, 0, 0 }; ///< constant, linear, quadratic
  double coneCosine = 0;
  double exponent = 1;
};

/// What a light does to a point.
struct LightRay
{
  Eigen::Vector3d toLight; ///< unit vector
  double strength = 1;     ///< factor of the light's colours
};

/// A law of light, for the processor and for OpenGL.
struct LightLawRow
{
  LightRay (*ray)(const LightShape& light, const Eigen::Vector3d& point);
  /// GLSL that makes `vec3 L` and `float s`, toLight and strength at vertexVC. POSITION, AXIS and FADING stand for the
  /// light's vec4: position and cosine of the cone, axis and exponent, attenuation and a number for others.
  std::string code;
};

DGTKMATERIALS_EXPORT const LightLawRow& lightLaw(LightLaw law);

/// The law of a light. A cone of 90 degrees and more is none, as in VTK.
DGTKMATERIALS_EXPORT LightLaw lightLawOf(const LightState& light);

/// A light where its kind puts it, in another frame; at the camera, along `ahead`, if that is not in the world.
DGTKMATERIALS_EXPORT LightShape lightShape(const LightState& light, const Eigen::Matrix3d& rotation,
  const Eigen::Vector3d& translation, const Eigen::Vector3d& ahead);

} // namespace dgtk

#endif
