// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSurfaceShading_h
#define dgtkSurfaceShading_h

#include "dgtkEnvironmentLight.h"
#include "dgtkLightLaw.h"
#include "dgtkSurfaceRows.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace dgtk
{

/// What is seen along a direction (world) where nothing is: background colour or environment; sRGB, above 1 where it is
/// too bright.
Eigen::Vector3d backgroundOf(const SceneState& state, const Eigen::Vector3d& direction);

/// Scale and bias of the reflectance at normal incidence for the cosine of the viewer's angle and a roughness, see
/// reflectanceTable().
Eigen::Vector2d reflectanceOf(double cosine, double roughness);

/// Colours of what rays have hit: materials, lights, background, environment and fog by the formulas of the renderer's
/// shaders, without shadows, bump maps and normal maps, textures by their nearest texel. sRGB, above 1 where it is too
/// bright.
class SurfaceShading
{
public:
  /// `environment` of the state's one; null where it has none. The state must outlive the shading.
  SurfaceShading(const SceneState& state, const View& view, std::shared_ptr<const EnvironmentLight> environment);

  /// Opaque colours of a rectangle, row by row; `in` has barycentrics.
  std::vector<Eigen::Vector3d> colors(const SurfaceRows& in) const;

private:
  struct Light ///< in the camera frame
  {
    const LightState* state;
    const LightLawRow* law;
    LightShape shape;
  };
  /// A surface that is shaded, in the camera frame.
  struct Point
  {
    Eigen::Vector3d position;
    Eigen::Vector3d normal;
    Eigen::Vector3d viewer; ///< unit vector towards the eye
    const Material& material;
    const Instance& instance;
    std::uint32_t triangle;
    Eigen::Vector2d barycentrics;
    Eigen::Vector3d texel(int texture) const;
  };
  Eigen::Vector3d phong(const Point& point) const;
  Eigen::Vector3d physical(const Point& point) const; ///< linear
  Eigen::Vector3d surroundings(const Point& point, const Eigen::Vector3d& albedo, const Eigen::Vector3d& f0,
    double roughness, double occlusion) const;
  Eigen::Vector3d color(const Point& point) const;

  const SceneState& State;
  bool Parallel;
  std::shared_ptr<const EnvironmentLight> Environment;
  Eigen::Matrix3d world_from_camera;
  Eigen::Matrix3d image_from_camera = Eigen::Matrix3d::Identity();
  std::vector<Light> Lights;
};

} // namespace dgtk

#endif
