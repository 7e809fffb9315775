// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRasterShaders_h
#define dgtkRasterShaders_h

#include "dgtkRasterLights.h"

#include "dgtkModel.h"

#include <array>
#include <string>
#include <tuple>

namespace dgtk
{

/// What a fragment shader has to do.
struct ShaderVariant
{
  /// Pictures, in the order of `wraps`.
  enum Picture : std::size_t
  {
    Base,
    Normal,
    Bump,
    MetallicRoughness,
    Emission,
    Occlusion,
    Pictures
  };

  std::array<int, lightLawCount> lights{}; ///< number of those of each law
  bool headOnly = false;                   ///< one head light and nothing else: VTK's short form
  bool lightTexture = false;               ///< lights come from a buffer texture: more than fit in uniforms
  bool specular = false;
  bool textured = false;
  bool colored = false; ///< vertices have colours
  bool cutOut = false;
  std::array<TextureWraps, Pictures> wraps{};
  bool pieces = false;  ///< the triangle comes from a vertex attribute
  bool peel = false;    ///< fragments up to those of the layer before are not there
  bool collect = false; ///< fragments are appended to a FragmentList
  bool shadows = false; ///< some light has a shadow map
  bool fog = false;
  bool environment = false; ///< light from everywhere; goes with `physical`
  bool physical = false;    ///< computed in linear light from metal and roughness
  bool normalMap = false;
  bool bumpMap = false;
  bool metallicRoughnessMap = false;
  bool emissionMap = false;
  bool occlusionMap = false;

  /// Some picture is read with a filter.
  bool samples() const
  {
    return this->textured || this->normalMap || this->bumpMap || this->metallicRoughnessMap || this->emissionMap ||
           this->occlusionMap;
  }

  /// Everything above.
  auto key() const
  {
    return std::make_tuple(this->lights, this->wraps,
      std::array<bool, 18>{ this->colored, this->headOnly, this->lightTexture, this->specular, this->textured,
        this->cutOut, this->pieces, this->peel, this->collect, this->shadows, this->fog, this->environment,
        this->physical, this->normalMap, this->bumpMap, this->metallicRoughnessMap, this->emissionMap,
        this->occlusionMap });
  }
  bool operator==(const ShaderVariant& o) const { return this->key() == o.key(); }
};

/// Lights that are held in uniforms; OpenGL 3.2 promises 1024 components.
constexpr int uniformLights = 32;

/// Substitutes our parts into VTK's templates, before VTK does. Output 0 is the colour, output 1 the number of the
/// draw, the triangle and the depth.
void substituteColor(const ShaderVariant& variant, std::string& vertex, std::string& fragment);

/// A whole program that writes output 1 only. `vertexMC` and, for cut-outs, `tcoord` are its attributes.
std::string idVertexShader(const ShaderVariant& variant);
std::string idFragmentShader(const ShaderVariant& variant);

} // namespace dgtk

#endif
