// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRasterLights_h
#define dgtkRasterLights_h

#include "dgtkSceneState.h"

#include <array>
#include <vector>

namespace dgtk
{

/// Lights in view coordinates, as the fragment shader reads them: law by law.
struct RasterLights
{
  static constexpr int stride = 6;
  /// Per light: position and cosine of the cone; axis and exponent; attenuation and number of its first shadow map,
  /// from 1, 0 for none; ambient; diffuse; specular. Colours are multiplied by the intensity.
  std::vector<std::array<float, 4>> values;
  std::array<int, lightLawCount> counts{}; ///< of each law
  bool headOnly = false;                   ///< a single head light

  int count() const { return static_cast<int>(this->values.size()) / stride; }
};

/// `firstMaps`: each light's first shadow map, -1 for none; empty: no light has one.
RasterLights rasterLights(const std::vector<LightState>& lights, const Eigen::Matrix4d& view_from_world,
  const std::vector<int>& firstMaps = {});

} // namespace dgtk

#endif
