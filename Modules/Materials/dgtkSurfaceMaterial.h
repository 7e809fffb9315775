// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSurfaceMaterial_h
#define dgtkSurfaceMaterial_h

#include "dgtkMaterialsModule.h"
#include "dgtkModel.h"

#include <Eigen/Core>

namespace dgtk
{

/// Ambient light of the world, lights add theirs. It is OpenGL's light model, for which the ambient colours of AC3D,
/// 3DS and MD2 models are made: they are mostly the diffuse colour over again.
constexpr double worldAmbient = 0.2;

/// What a material is made of where it is shaded by microfacets.
struct FacetedSurface
{
  double metallic = 0;
  double roughness = 1;
  Eigen::Vector3d f0{ 0, 0, 0 }; ///< reflectance at normal incidence of what is not metal, linear
};

/// Of a material without metal and roughness: the lobe that is as wide as Phong's.
DGTKMATERIALS_EXPORT FacetedSurface facetsOf(const Material& material);

/// What turns normals where `m` turns positions: the cofactors, which also exist where it has no inverse, scaled to
/// about 1; of a mirroring one negative, so that they stay on their side.
DGTKMATERIALS_EXPORT Eigen::Matrix3d normalMatrix(const Eigen::Matrix3d& m);

/// GLSL: dgtkToLinear() and dgtkToDisplay(), the transfer function of IEC 61966-2-1.
DGTKMATERIALS_EXPORT const char* transferShader();

/// GLSL: dgtkIrradianceFrom(), which is EnvironmentLight::irradianceOn(). Needs uniform vec3 dgtkIrradiance[9].
DGTKMATERIALS_EXPORT const char* irradianceShader();

} // namespace dgtk

#endif
