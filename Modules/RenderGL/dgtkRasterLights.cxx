// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRasterLights.h"

#include "dgtkPortableMath.h"

#include <cmath>

namespace dgtk
{
namespace
{

std::array<float, 4> pack(const Eigen::Vector3d& xyz, double w = 0)
{
  return { float(xyz.x()), float(xyz.y()), float(xyz.z()), float(w) };
}

/// A cone of 90 degrees and more is no cone, as in VTK.
bool spot(const LightState& light) { return traitsOf(light.kind).cone && light.coneAngle < 90; }

void append(RasterLights& lights, const LightState& light, const Eigen::Matrix4d& view_from_world, int map)
{
  const Eigen::Matrix3d rotation = view_from_world.topLeftCorner<3, 3>();
  const LightTraits& kind = traitsOf(light.kind);
  Eigen::Vector3d axis(0, 0, -1);
  Eigen::Vector3d position(0, 0, 0);
  if (kind.placed)
  {
    axis = (rotation * (light.target - light.position)).normalized();
    position = rotation * light.position + view_from_world.topRightCorner<3, 1>();
  }
  position = kind.near ? position : Eigen::Vector3d(-axis);
  lights.values.push_back(pack(position, std::cos(light.coneAngle * pi / 180)));
  lights.values.push_back(pack(axis, light.exponent));
  lights.values.push_back(pack(light.attenuation, map + 1));
  lights.values.push_back(pack(light.ambient * light.intensity));
  lights.values.push_back(pack(light.diffuse * light.intensity));
  lights.values.push_back(pack(light.specular * light.intensity));
}

} // namespace

RasterLights rasterLights(
  const std::vector<LightState>& lights, const Eigen::Matrix4d& view_from_world, const std::vector<int>& firstMaps)
{
  RasterLights result;
  for (int group = 0; group < 3; ++group)
  {
    for (std::size_t i = 0; i < lights.size(); ++i)
    {
      const LightState& light = lights[i];
      const int own = !traitsOf(light.kind).near ? 0 : spot(light) ? 2 : 1;
      if (own == group)
      {
        append(result, light, view_from_world, firstMaps.empty() ? -1 : firstMaps[i]);
        ++(group == 0 ? result.directional : group == 1 ? result.points : result.spots);
      }
    }
  }
  result.headOnly = lights.size() == 1 && lights[0].kind == LightKind::Head;
  return result;
}

} // namespace dgtk
