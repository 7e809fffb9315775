// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovRenderOptions_h
#define dgtkPovRenderOptions_h

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
  int antialias = 0;        ///< N x N points a pixel, on a grid, 1 to 9; 0: as many as `samples`

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
    add(this->aperture > 0, "pov_focal_blur", std::to_string(this->aperture) + ',' + std::to_string(this->focus));
    add(this->antialias > 0, "pov_antialias", std::to_string(this->antialias));
    return pairs;
  }
};

} // namespace dgtk

#endif
