// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRasterLights.h"

#include "dgtkLightLaw.h"

namespace dgtk
{
namespace
{

std::array<float, 4> pack(const Eigen::Vector3d& xyz, double w = 0)
{
  return { float(xyz.x()), float(xyz.y()), float(xyz.z()), float(w) };
}

void append(RasterLights& lights, const LightState& light, const Eigen::Matrix4d& view_from_world, int map)
{
  const LightShape shape = lightShape(
    light, view_from_world.topLeftCorner<3, 3>(), view_from_world.topRightCorner<3, 1>(), Eigen::Vector3d(0, 0, -1));
  lights.values.push_back(pack(shape.position, shape.coneCosine));
  lights.values.push_back(pack(shape.axis, shape.exponent));
  lights.values.push_back(pack(shape.attenuation, map + 1));
  lights.values.push_back(pack(light.ambient * light.intensity));
  lights.values.push_back(pack(light.diffuse * light.intensity));
  lights.values.push_back(pack(light.specular * light.intensity));
}

} // namespace

RasterLights rasterLights(
  const std::vector<LightState>& lights, const Eigen::Matrix4d& view_from_world, const std::vector<int>& firstMaps)
{
  RasterLights result;
  for (std::size_t law = 0; law < lightLawCount; ++law)
  {
    for (std::size_t i = 0; i < lights.size(); ++i)
    {
      if (lightLawOf(lights[i]) == LightLaw(law))
      {
        append(result, lights[i], view_from_world, firstMaps.empty() ? -1 : firstMaps[i]);
        ++result.counts[law];
      }
    }
  }
  result.headOnly = lights.size() == 1 && lights[0].kind == LightKind::Head;
  return result;
}

} // namespace dgtk
