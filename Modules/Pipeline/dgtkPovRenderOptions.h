// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovRenderOptions_h
#define dgtkPovRenderOptions_h

#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dgtk
{

/// What POV-Ray shall show beyond the built-in renderer: of the layer `pov`, and of the colours when POV-Ray draws
/// them.
struct PovRenderOptions
{
  bool shadows = false;
  int areaLights = 0;       ///< lights sampled at N x N points, 2 to 64; 0: points. They cast shadows
  bool reflections = false; ///< shiny materials reflect
  bool radiosity = false;   ///< light between surfaces in place of ambient light
  double aperture = 0;      ///< diameter of the lens, scene units; 0: none
  double focus = 0;         ///< distance of the plane in focus, scene units, > 0 with an aperture
  bool flatIds = false;     ///< objects in the colours of their ids, without light
  /// Surfaces in the colours of their places in the world: black at (low), white at (high); x, y, z low, x, y, z high.
  /// Not with flatIds.
  std::optional<std::array<double, 6>> positionColors;
  int antialias = 0; ///< N x N points a pixel, on a grid, 1 to 9; 0: as many as `samples`

  /// Shortest text of a number that reads back the same.
  static std::string number(double value)
  {
    char text[32];
    return std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
  }
  /// What differs from the defaults, as keys and values of the manifest.
  std::vector<std::pair<std::string, std::string>> describe() const
  {
    std::vector<std::pair<std::string, std::string>> pairs;
    const auto add = [&pairs](bool used, const char* key, const std::string& value)
    {
      if (used)
      {
        pairs.emplace_back(key, value);
      }
    };
    add(this->shadows, "pov_shadows", "on");
    add(this->areaLights > 0, "pov_area_lights", std::to_string(this->areaLights));
    add(this->reflections, "pov_reflections", "on");
    add(this->radiosity, "pov_radiosity", "on");
    add(this->aperture > 0, "pov_focal_blur", number(this->aperture) + ',' + number(this->focus));
    add(this->flatIds, "pov_flat_ids", "on");
    std::string box;
    for (const double value : this->positionColors.value_or(std::array<double, 6>{}))
    {
      box += (box.empty() ? "" : ",") + number(value);
    }
    add(this->positionColors.has_value(), "pov_position_colors", box);
    add(this->antialias > 0, "pov_antialias", std::to_string(this->antialias));
    return pairs;
  }
};

} // namespace dgtk

#endif
