// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovLights_h
#define dgtkPovLights_h

#include "dgtkPovExport.h"

#include <string>
#include <vector>

namespace dgtk
{

/// A ball that holds all that is drawn, world frame.
struct PovBall
{
  Eigen::Vector3d centre{ 0, 0, 0 };
  double radius = 1;
};

/// Ambient light of the scene: that of the world, 0.2 as in the built-in renderer, and that of the lights.
Eigen::Vector3d povAmbient(const SceneState& state);

/// Whether objects cast shadows: in all lights, or in those of the scene that have them.
bool povShadows(const SceneState& state, const PovOptions& options);

/// What lights depend on beside themselves.
struct PovLightContext
{
  const View& view;
  const PovOptions& options;
  PovBall ball;
  double scale = 1;     ///< of the scene as written
  bool shadows = false; ///< some light has shadows
};

/// `light_source { ... }`; a warning is added for what POV-Ray computes otherwise.
std::string povLight(const LightState& light, const PovLightContext& context, std::vector<std::string>& warnings);

} // namespace dgtk

#endif
