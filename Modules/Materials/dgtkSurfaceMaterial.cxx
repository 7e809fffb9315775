// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceMaterial.h"

#include "dgtkCofactors.h"

#include <Eigen/LU>

#include <cmath>

namespace dgtk
{

FacetedSurface facetsOf(const Material& material)
{
  constexpr double dielectric = 0.04; // reflectance of glass of index 1.5
  if (material.physical)
  {
    return { material.physical->metallic, material.physical->roughness, Eigen::Vector3d::Constant(dielectric) };
  }
  // The width of the GGX lobe that is as wide as Phong's.
  return { 0, std::sqrt(std::sqrt(2 / (material.shininess + 2))), dielectric * material.specular };
}

Eigen::Matrix3d normalMatrix(const Eigen::Matrix3d& m)
{
  const Eigen::Matrix3d cofactors = cofactorsOf(m);
  const double size = cofactors.cwiseAbs().maxCoeff();
  return cofactors * ((m.determinant() < 0 ? -1.0 : 1.0) / (size > 0 ? size : 1.0));
}

const char* transferShader()
{
  return R"(
vec3 dgtkToLinear(vec3 c)
{
  return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(vec3(0.04045), c));
}
vec3 dgtkToDisplay(vec3 c)
{
  c = max(c, vec3(0.0));
  return mix(c * 12.92, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(vec3(0.0031308), c));
}
)";
}

/// Real spherical harmonics up to degree 2 of a direction (Ramamoorthi and Hanrahan 2001); the coefficients hold the
/// constants.
const char* irradianceShader()
{
  return R"(
vec3 dgtkIrradianceFrom(vec3 d)
{
  vec3 sum = dgtkIrradiance[0] + dgtkIrradiance[1] * d.y + dgtkIrradiance[2] * d.z + dgtkIrradiance[3] * d.x +
    dgtkIrradiance[4] * (d.x * d.y) + dgtkIrradiance[5] * (d.y * d.z) + dgtkIrradiance[6] * (3.0 * d.z * d.z - 1.0) +
    dgtkIrradiance[7] * (d.x * d.z) + dgtkIrradiance[8] * (d.x * d.x - d.y * d.y);
  return max(sum, vec3(0.0));
}
)";
}

} // namespace dgtk
