// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSurfaceShaders_h
#define dgtkSurfaceShaders_h

#include "dgtkRasterShaders.h"

#include <string>

namespace dgtk
{

/// GLSL of what goes beyond VTK's Phong model; each is empty where the variant does not need it.

/// Uniforms and functions.
std::string surfaceDeclarations(const ShaderVariant& variant);
/// Turns normalVC by a normal map or a bump map. Needs vertexVC and tcoordVCVSOutput.
std::string perturbedNormal(const ShaderVariant& variant);
/// `float lit`: the part of light i that is not in shadow. Needs L, df and the light's values.
std::string litPart(const ShaderVariant& variant, const std::string& shadowIndex);
/// Defines what addPhysicalLight() needs: linear colours of the surface, and dgtkSum.
std::string beginPhysical(const ShaderVariant& variant);
/// Adds a light of unit vector L, strength s, lit part `lit` and display-referred colours.
std::string addPhysicalLight(const std::string& ambient, const std::string& diffuse, const std::string& specular);
/// Adds the environment or the world's ambient light and the emission; defines dgtkColor, display-referred but for fog.
std::string endPhysical(const ShaderVariant& variant);
/// Mixes dgtkColor with the fog.
std::string fogCode(const ShaderVariant& variant);

} // namespace dgtk

#endif
