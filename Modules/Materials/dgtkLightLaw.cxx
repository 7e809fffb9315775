// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLightLaw.h"

#include "dgtkPortableMath.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr double noCone = 90; // degrees

LightRay parallelRay(const LightShape& light, const Eigen::Vector3d& /*point*/) { return { -light.axis, 1 }; }

LightRay pointRay(const LightShape& light, const Eigen::Vector3d& point)
{
  const Eigen::Vector3d away = light.position - point;
  const double distance = away.norm();
  const Eigen::Vector3d& k = light.attenuation;
  return { away / std::max(distance, 1e-30), 1 / (k.x() + k.y() * distance + k.z() * distance * distance) };
}

LightRay coneRay(const LightShape& light, const Eigen::Vector3d& point)
{
  LightRay ray = pointRay(light, point);
  const double inside = -ray.toLight.dot(light.axis);
  ray.strength *= inside >= light.coneCosine ? portable::pow(inside, light.exponent) : 0.0;
  return ray;
}

constexpr const char* parallelCode = "    vec3 L = -AXIS.xyz;\n"
                                     "    float s = 1.0;\n";

const std::string pointCode = "    vec3 away = POSITION.xyz - vertexVC.xyz;\n"
                              "    float d = length(away);\n"
                              "    vec3 L = away / max(d, 1e-30);\n"
                              "    vec3 k = FADING.xyz;\n"
                              "    float s = 1.0 / (k.x + k.y * d + k.z * d * d);\n";

const std::string coneCode = "    vec4 axis = AXIS;\n"
                             "    float inside = dot(-L, axis.xyz);\n"
                             "    s = inside >= POSITION.w ? s * pow(inside, axis.w) : 0.0;\n";
} // namespace

const LightLawRow& lightLaw(LightLaw law)
{
  // In the order of LightLaw.
  static const std::array<LightLawRow, lightLawCount> laws{ {
    { parallelRay, parallelCode },
    { pointRay, pointCode },
    { coneRay, pointCode + coneCode },
  } };
  return laws.at(std::size_t(law));
}

LightLaw lightLawOf(const LightState& light)
{
  const LightLaw law = traitsOf(light.kind).law;
  return law == LightLaw::Cone && light.coneAngle >= noCone ? LightLaw::Point : law;
}

LightShape lightShape(const LightState& light, const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation,
  const Eigen::Vector3d& ahead)
{
  LightShape shape;
  const bool placed = traitsOf(light.kind).placed;
  shape.position = placed ? Eigen::Vector3d(rotation * light.position + translation) : shape.position;
  shape.axis = placed ? Eigen::Vector3d((rotation * (light.target - light.position)).normalized()) : ahead;
  shape.attenuation = light.attenuation;
  shape.coneCosine = std::cos(light.coneAngle * pi / 180);
  shape.exponent = light.exponent;
  return shape;
}

} // namespace dgtk
