// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkEnvironmentLight_h
#define dgtkEnvironmentLight_h

#include "dgtkMaterialsModule.h"
#include "dgtkModel.h"

#include <Eigen/Core>

#include <array>
#include <memory>
#include <vector>

namespace dgtk
{

/// What surfaces get from an environment, computed on the CPU in a fixed order. Linear light.
struct DGTKMATERIALS_EXPORT EnvironmentLight
{
  /// Radiance filtered for roughness 0, 1/5, ... 1, each half the size of the one before.
  static constexpr int levels = 6;
  static constexpr int width = 512; ///< of level 0; height is half of it
  static constexpr int reflectanceSize = 64;

  /// Irradiance divided by pi as a polynomial of the unit normal (x, y, z) in the image's axes, RGB:
  /// 1, y, z, x, xy, yz, 3zz - 1, xz, xx - yy (Ramamoorthi and Hanrahan 2001).
  std::array<Eigen::Vector3d, 9> irradiance;
  /// RGB, equirectangular, rows top to bottom (Karis 2013: the lobe seen along the normal).
  std::array<std::vector<float>, levels> radiance;

  /// Irradiance divided by pi on a surface with a unit normal in the image's axes, RGB.
  Eigen::Vector3d irradianceOn(const Eigen::Vector3d& normal) const;
  /// `radiance` along a direction in the image's axes for a roughness in [0, 1], interpolated.
  Eigen::Vector3d reflectedFrom(const Eigen::Vector3d& direction, double roughness) const;
};

DGTKMATERIALS_EXPORT EnvironmentLight environmentLight(const RadianceImage& image, double intensity);

struct EnvironmentState;
/// The same of a scene's environment, computed once while that is in use; null for null. Thread-safe.
DGTKMATERIALS_EXPORT std::shared_ptr<const EnvironmentLight> environmentLight(
  const std::shared_ptr<const EnvironmentState>& environment);

/// Radiance along a direction (any length but 0) in the image's axes, interpolated between texels; RGB.
DGTKMATERIALS_EXPORT Eigen::Vector3d radianceFrom(const RadianceImage& image, const Eigen::Vector3d& direction);

/// Scale and bias of the reflectance at normal incidence (Karis 2013), for the cosine of the viewer's angle (columns)
/// and roughness (rows) at the centres of ReflectanceSize x ReflectanceSize cells.
DGTKMATERIALS_EXPORT std::vector<float> reflectanceTable();

/// One cell of it, the nearest.
DGTKMATERIALS_EXPORT Eigen::Vector2d reflectanceOf(double cosine, double roughness);

struct SceneState;
/// What is seen along a direction (world) where nothing is: background colour or environment, sRGB in [0, 1].
DGTKMATERIALS_EXPORT Eigen::Vector3d backgroundOf(const SceneState& state, const Eigen::Vector3d& direction);

} // namespace dgtk

#endif
