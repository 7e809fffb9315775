// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLightLaw.h"

#include "dgtkPortableMath.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <emmintrin.h>

namespace dgtk
{

namespace
{
constexpr double noCone = 90; // degrees

void parallelRays(const LightShape& light, const LightPoints& /*points*/, LightRays& rays)
{
  rays.x.fill(-light.axis.x());
  rays.y.fill(-light.axis.y());
  rays.z.fill(-light.axis.z());
  rays.strength.fill(1);
}

void pointRays(const LightShape& light, const LightPoints& points, LightRays& rays)
{
  const double at[3] = { light.position.x(), light.position.y(), light.position.z() };
  const double k[3] = { light.attenuation.x(), light.attenuation.y(), light.attenuation.z() };
  // Loops without branches or calls: the compiler works on several points at a time. (It takes std::sqrt() for a call.)
  alignas(64) double distances[LightPoints::count];
  for (std::size_t i = 0; i < LightPoints::count; ++i)
  {
    rays.x[i] = at[0] - points.x[i];
    rays.y[i] = at[1] - points.y[i];
    rays.z[i] = at[2] - points.z[i];
    distances[i] = rays.x[i] * rays.x[i] + rays.y[i] * rays.y[i] + rays.z[i] * rays.z[i];
  }
  for (std::size_t i = 0; i < LightPoints::count; i += 2)
  {
    _mm_store_pd(distances + i, _mm_sqrt_pd(_mm_load_pd(distances + i)));
  }
  for (std::size_t i = 0; i < LightPoints::count; ++i)
  {
    const double length = distances[i] > 1e-30 ? distances[i] : 1e-30;
    rays.x[i] /= length;
    rays.y[i] /= length;
    rays.z[i] /= length;
    rays.strength[i] = 1 / (k[0] + k[1] * distances[i] + k[2] * distances[i] * distances[i]);
  }
}

void coneRays(const LightShape& light, const LightPoints& points, LightRays& rays)
{
  pointRays(light, points, rays);
  for (std::size_t i = 0; i < LightPoints::count; ++i)
  {
    const double inside = -(rays.x[i] * light.axis.x() + rays.y[i] * light.axis.y() + rays.z[i] * light.axis.z());
    rays.strength[i] *= inside >= light.coneCosine ? portable::pow(inside, light.exponent) : 0.0;
  }
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
    { parallelRays, parallelCode },
    { pointRays, pointCode },
    { coneRays, pointCode + coneCode },
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
