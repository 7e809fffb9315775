// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovRenderOptions.h"

#include "dgtkError.h"

namespace dgtk
{

namespace
{
constexpr int leastLights = 2;
constexpr int mostLights = 64;
constexpr int mostPoints = 9;
constexpr double largestNumber = 1e30;

const SwitchOption shadows("pov_shadows", "POV-Ray: objects cast shadows");
const IntegerOption areaLights(
  "pov_area_lights", std::nullopt, leastLights, mostLights, "POV-Ray: soft shadows, lights of N x N points");
const SwitchOption reflections("pov_reflections", "POV-Ray: shiny materials reflect");
const SwitchOption radiosity("pov_radiosity", "POV-Ray: light between surfaces in place of ambient light");
const NumbersOption focalBlur(
  "pov_focal_blur", "APERTURE,DISTANCE", 2, 0, "POV-Ray: diameter of the lens, distance in focus, scene units");
const SwitchOption flatIds("pov_flat_ids", "POV-Ray: every object in the colour of its id, without light");
const NumbersOption positionColors("pov_position_colors", "X0,Y0,Z0,X1,Y1,Z1", 6, -largestNumber,
  "POV-Ray: surfaces in the colour of their place in that box");
const IntegerOption antialias(
  "pov_antialias", std::nullopt, 1, mostPoints, "POV-Ray: N x N points a pixel (default: as many as samples)");
} // namespace

const std::vector<const OptionRow*>& povOptionRows()
{
  static const std::vector<const OptionRow*> rows{ &shadows, &areaLights, &reflections, &radiosity, &focalBlur,
    &flatIds, &positionColors, &antialias };
  return rows;
}

PovOptions povOptionsOf(const OptionValues& values)
{
  PovOptions pov;
  pov.areaLights = areaLights.of(values);
  pov.shadows = shadows.of(values) || pov.areaLights > 0;
  pov.reflections = reflections.of(values);
  pov.radiosity = radiosity.of(values);
  pov.antialias = antialias.given(values).value_or(1);
  pov.flatIds = flatIds.of(values);
  if (const std::vector<double> box = positionColors.of(values); !box.empty())
  {
    if (!(box[0] < box[3] && box[1] < box[4] && box[2] < box[5]))
    {
      throw UsageError(positionColors.name + ": the first corner of the box must be below the second");
    }
    pov.positionColors = PovBox{ { box[0], box[1], box[2] }, { box[3], box[4], box[5] } };
  }
  if (pov.flatIds && pov.positionColors)
  {
    throw UsageError(flatIds.name + ": excludes " + positionColors.name);
  }
  if (const std::vector<double> lens = focalBlur.of(values); !lens.empty())
  {
    pov.lens = PovLens{ lens[0], lens[1] };
  }
  return pov;
}

std::vector<std::string> povLines(const SceneState& state, const View& view, const OptionValues& values)
{
  std::vector<std::string> lines;
  for (const std::string& note : povNotes(state, view, povOptionsOf(values)))
  {
    lines.push_back("POV-Ray: " + note);
  }
  return lines;
}

std::optional<int> povAntialiasOf(const OptionValues& values) { return antialias.given(values); }

} // namespace dgtk
