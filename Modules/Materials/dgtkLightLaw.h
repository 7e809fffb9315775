// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkLightLaw_h
#define dgtkLightLaw_h

#include "dgtkMaterialsModule.h"

#include "dgtkSceneState.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
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

/// Points that are lit at once, in the frame of their lights.
struct LightPoints
{
  static constexpr std::size_t count = 16;
  alignas(64) std::array<double, count> x;
  alignas(64) std::array<double, count> y;
  alignas(64) std::array<double, count> z;
};

/// What a light does to each of them.
struct LightRays
{
  alignas(64) std::array<double, LightPoints::count> x; ///< of the unit vector towards the light
  alignas(64) std::array<double, LightPoints::count> y;
  alignas(64) std::array<double, LightPoints::count> z;
  alignas(64) std::array<double, LightPoints::count> strength; ///< factor of the light's colours
};

/// A law of light, for the processor and for OpenGL.
struct LightLawRow
{
  void (*rays)(const LightShape& light, const LightPoints& points, LightRays& rays);
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
