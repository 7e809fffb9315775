// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovLights.h"

#include "dgtkError.h"
#include "dgtkPovText.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
/// The built-in renderer's light of the world.
constexpr double worldAmbient = 0.2;
/// Of the ball's radius: where a light that falls off from its position on begins to.
constexpr double nearestFade = 1e-3;
/// Of the ball's radius: the width of an area light.
constexpr double areaWidth = 0.1;

/// fade_power and fade_distance f give 2 / (1 + (d / f)^power): with `scale` on the colour, 1 / (c + l d + q d^2).
struct Fade
{
  double scale = 1;
  double distance = 0; ///< 0: none
  int power = 0;
};

Eigen::Vector3d positionOf(const LightState& light, const View& view)
{
  return traitsOf(light.kind).placed ? light.position : view.camera_from_world.inverse().translation;
}

Fade fadeOf(const LightState& light, const View& view, const PovBall& ball, std::vector<std::string>& warnings)
{
  double constant = light.attenuation[0];
  double linear = light.attenuation[1];
  double quadratic = light.attenuation[2];
  if (linear <= 0 && quadratic <= 0)
  {
    return { 1 / constant, 0, 0 };
  }
  if (linear > 0 && quadratic > 0)
  {
    const double away = std::max((ball.centre - positionOf(light, view)).norm(), ball.radius * nearestFade);
    quadratic += linear / away;
    linear = 0;
    warnings.push_back("light " + quoted(light.name) +
                       ": linear and quadratic attenuation together are matched at the middle of the scene only");
  }
  const int power = linear > 0 ? 1 : 2;
  const double factor = linear > 0 ? linear : quadratic;
  const double nearest = ball.radius * nearestFade;
  constant = std::max(constant, factor * (power == 1 ? nearest : nearest * nearest));
  return { 0.5 / constant, power == 1 ? constant / factor : std::sqrt(constant / factor), power };
}

std::string parallel(const Eigen::Vector3d& direction, const PovBall& ball)
{
  const Eigen::Vector3d from = ball.centre - direction * (4 * ball.radius);
  return povVector(from) + " COLOR parallel point_at " + povVector(ball.centre);
}

std::string place(const LightState& light, const View& view, const PovBall& ball)
{
  const LightTraits& kind = traitsOf(light.kind);
  const Eigen::Vector3d position = positionOf(light, view);
  const Eigen::Vector3d ahead = view.camera_from_world.rotation.row(2);
  const Eigen::Vector3d target = kind.placed ? light.target : Eigen::Vector3d(position + ahead);
  if (!kind.near)
  {
    return parallel(kind.placed ? Eigen::Vector3d((target - position).normalized()) : ahead, ball);
  }
  if (!kind.cone || light.coneAngle >= 90)
  {
    return povVector(position) + " COLOR";
  }
  const std::string cone = povNumber(light.coneAngle);
  return povVector(position) + " COLOR spotlight point_at " + povVector(target) + " radius " + cone + " falloff " +
         cone + " tightness " + povNumber(light.exponent);
}
} // namespace

bool povShadows(const SceneState& state, const PovOptions& options)
{
  return options.shadows ||
         std::any_of(state.lights.begin(), state.lights.end(), [](const LightState& light) { return light.shadows; });
}

Eigen::Vector3d povAmbient(const SceneState& state)
{
  Eigen::Vector3d sum(worldAmbient, worldAmbient, worldAmbient);
  for (const LightState& light : state.lights)
  {
    sum += light.ambient * light.intensity;
  }
  return sum;
}

std::string povLight(const LightState& light, const PovLightContext& context, std::vector<std::string>& warnings)
{
  const PovBall& ball = context.ball;
  const bool fades = traitsOf(light.kind).near;
  const Fade fade = fades ? fadeOf(light, context.view, ball, warnings) : Fade();
  std::string text = place(light, context.view, ball);
  const std::string word = "COLOR";
  text.replace(text.find(word), word.size(), povColor(light.diffuse * light.intensity * fade.scale));
  if (fade.power > 0)
  {
    text += " fade_distance " + povNumber(fade.distance * context.scale) + " fade_power " + std::to_string(fade.power);
  }
  if (fades && !light.ambient.isZero(0) && fade.power > 0)
  {
    warnings.push_back("light " + quoted(light.name) + ": its ambient light does not fall off");
  }
  const bool shadows = context.options.shadows || light.shadows;
  if (!shadows && context.shadows)
  {
    text += " shadowless";
    warnings.push_back(
      "light " + quoted(light.name) + ": without shadows among others that have them, it has no highlights");
  }
  if (shadows && context.options.areaLights > 1)
  {
    const std::string width = povNumber(areaWidth * ball.radius);
    const std::string points = std::to_string(context.options.areaLights);
    text += " area_light " + width + " * x, " + width + " * y, " + points + ", " + points + " circular orient";
  }
  return "light_source { " + text + povScale(context.scale) + " }\n";
}

} // namespace dgtk
