// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkRasterShaders.h"

#include "dgtkLightLaw.h"
#include "dgtkSurfaceMaterial.h"
#include "dgtkSurfaceShaders.h"
#include "dgtkText.h"

#include <vtkShaderProgram.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace dgtk
{
namespace
{

void put(std::string& source, const char* tag, const std::string& text)
{
  vtkShaderProgram::Substitute(source, tag, text, true);
}

/// The texel whose alpha decides: repeated, at full resolution, (0, 0) the lower left one.
constexpr const char* goneTexel = R"(
bool dgtkGone(sampler2D picture, vec2 uv)
{
  ivec2 size = textureSize(picture, 0);
  vec2 texel = floor(uv * vec2(size));
  texel -= vec2(size) * floor(texel / vec2(size));
  return texelFetch(picture, clamp(ivec2(texel), ivec2(0), size - 1), 0).a < 0.5;
}
)";

/// What a pixel sees of a picture: trilinear probes along the longer axis of its footprint, at most four, as
/// EXT_texture_filter_anisotropic defines it. By single texels, because software OpenGL either filters in 8 bits or
/// weighs every texel of an ellipse, for which it takes as long as for all the rest of a frame. Loops in place of
/// conditions: only they end early there.
constexpr const char* filteredTexel = R"(
vec3 dgtkBilinear(sampler2D picture, vec2 uv, int level, vec2 size)
{
  vec2 at = fract(uv) * size - 0.5;
  vec2 low = floor(at);
  vec2 part = at - low;
  low += size * vec2(lessThan(low, vec2(0.0)));
  vec2 high = low + 1.0;
  high *= vec2(lessThan(high, size));
  ivec4 t = ivec4(low, high);
  vec3 below = mix(texelFetch(picture, t.xy, level).rgb, texelFetch(picture, t.zy, level).rgb, part.x);
  vec3 above = mix(texelFetch(picture, t.xw, level).rgb, texelFetch(picture, t.zw, level).rgb, part.x);
  return mix(below, above, part.y);
}
vec3 dgtkTexel(sampler2D picture, vec2 uv)
{
  ivec2 cells = textureSize(picture, 0);
  vec2 right = dFdx(uv);
  vec2 up = dFdy(uv);
  float across = dot(right * vec2(cells), right * vec2(cells));
  float along = dot(up * vec2(cells), up * vec2(cells));
  vec2 axis = across > along ? right : up;
  float longest = max(max(across, along), 1.0);
  float ratio = longest / max(min(across, along), 1e-30);
  float probes = longest > 1.0 ? clamp(floor(sqrt(ratio) + 0.5), 1.0, 4.0) : 1.0;
  float last = floor(log2(float(max(cells.x, cells.y))) + 1e-5);
  float detail = clamp(0.5 * log2(longest) - log2(probes), 0.0, last);
  vec3 sum = vec3(0.0);
  for (float level = floor(detail); level < detail + 1.0 && level <= last; level += 1.0)
  {
    vec2 size = vec2(max(cells >> int(level), ivec2(1)));
    for (float i = 0.5; i < probes; i += 1.0)
    {
      sum += (1.0 - abs(level - detail)) * dgtkBilinear(picture, uv + axis * (i / probes - 0.5), int(level), size);
    }
  }
  return sum / probes;
}
)";

/// `repeat`, `clamp` or `mirror` of each axis, `$` in them being "x" and "y".
std::string perAxis(
  const TextureWraps& wraps, const std::string& repeat, const std::string& clamp, const std::string& mirror)
{
  std::string code;
  for (std::size_t i = 0; i < wraps.size(); ++i)
  {
    code += wraps[i] == TextureWrap::Repeat ? repeat : wraps[i] == TextureWrap::Clamp ? clamp : mirror;
    std::replace(code.begin(), code.end(), '$', "xy"[i]);
  }
  return code;
}

/// Texels around a picture that does not repeat.
std::string goneCode(const ShaderVariant& variant)
{
  std::string code = variant.cutOut ? goneTexel : "";
  if (const TextureWraps& wraps = variant.wraps[ShaderVariant::Base]; wraps != TextureWraps{})
  {
    put(code, "  texel -= vec2(size) * floor(texel / vec2(size));\n",
      "  vec2 tiled = vec2(size);\n" + perAxis(wraps, "  texel.$ -= tiled.$ * floor(texel.$ / tiled.$);\n", "",
                                         "  texel.$ -= 2.0 * tiled.$ * floor(texel.$ / (2.0 * tiled.$));\n"
                                         "  texel.$ = min(texel.$, 2.0 * tiled.$ - 1.0 - texel.$);\n"));
  }
  return code;
}

/// What is behind the name of dgtkTexel() for pictures that are wrapped so.
std::string suffixOf(const TextureWraps& wraps)
{
  return wraps == TextureWraps{} ? "" : perAxis(wraps, "Repeat", "Clamp", "Mirror");
}

std::string filterCode(const ShaderVariant& variant)
{
  std::string code = variant.samples() ? filteredTexel : "";
  for (const TextureWraps& wraps :
    variant.samples() ? std::set<TextureWraps>(variant.wraps.begin(), variant.wraps.end()) : std::set<TextureWraps>())
  {
    if (wraps != TextureWraps{})
    {
      std::string other = filteredTexel;
      put(other, "vec2 at = fract(uv) * size - 0.5;",
        "vec2 at;\n" +
          perAxis(wraps, "  at.$ = fract(uv.$) * size.$ - 0.5;\n",
            "  at.$ = clamp(uv.$ * size.$, 0.5, size.$ - 0.5) - 0.5;\n",
            "  at.$ = clamp(abs(uv.$ - 2.0 * floor(0.5 * uv.$ + 0.5)) * size.$, 0.5, size.$ - 0.5) - 0.5;\n"));
      put(other, "dgtkBilinear", "dgtkBilinear" + suffixOf(wraps));
      put(other, "dgtkTexel", "dgtkTexel" + suffixOf(wraps));
      code += other;
    }
  }
  return code;
}

/// Lets each picture be read by the function of its wraps.
void putWraps(const ShaderVariant& variant, std::string& fragment)
{
  constexpr std::array<const char*, ShaderVariant::Pictures> names{ "actortexture", "dgtkNormalMap", "heights",
    "dgtkMetalRoughMap", "dgtkEmissionMap", "dgtkOcclusionMap" };
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    if (variant.wraps[i] != TextureWraps{})
    {
      const std::string read = std::string("(") + names[i] + ',';
      put(fragment, ("dgtkTexel" + read).c_str(), "dgtkTexel" + suffixOf(variant.wraps[i]) + read);
    }
  }
}

constexpr const char* peeling = R"(
uniform sampler2D dgtkLayer; // draw, triangle and depth of the layer before; depth 2 before the first
bool dgtkPeeled(vec2 id)
{
  vec3 before = texelFetch(dgtkLayer, ivec2(gl_FragCoord.xy), 0).xyz;
  if (gl_FragCoord.z != before.z) { return gl_FragCoord.z > before.z; }
  return id.x < before.x || (id.x == before.x && id.y <= before.y);
}
)";

/// See FragmentList.
constexpr const char* collecting = R"(
layout(std430) buffer dgtkFragments
{
  uint dgtkCount;
  uint dgtkCapacity;
  uint dgtkWidth;
  uint dgtkUnused;
  vec4 dgtkData[];
};
void dgtkAppend(vec2 id, vec4 color)
{
  uint at = atomicAdd(dgtkCount, 1u);
  if (at < dgtkCapacity)
  {
    uvec2 place = uvec2(gl_FragCoord.xy);
    dgtkData[2u * at] = vec4(float(place.y * dgtkWidth + place.x), gl_FragCoord.z, id);
    dgtkData[2u * at + 1u] = color;
  }
}
)";

/// Flat: of the triangle's last vertex. gl_PrimitiveID would cost Mesa's slow path for every triangle.
constexpr const char* triangleIn = "flat in float dgtkTriangleVSOutput;\n";

std::string triangleOut(const ShaderVariant& variant)
{
  return std::string(variant.pieces ? "in float dgtkTriangle;\n" : "uniform int dgtkFirstTriangle;\n") +
         "flat out float dgtkTriangleVSOutput;\n";
}

std::string triangleCode(const ShaderVariant& variant)
{
  return std::string("  dgtkTriangleVSOutput = ") +
         (variant.pieces ? "dgtkTriangle;\n" : "float(gl_VertexID - dgtkFirstTriangle);\n");
}

constexpr const char* identity = "  vec2 dgtkId = vec2(dgtkDraw.x, dgtkTriangleVSOutput);\n";

std::string lightValue(const ShaderVariant& variant, int slot)
{
  const std::string index = "i * " + std::to_string(RasterLights::stride) + " + " + std::to_string(slot);
  return variant.lightTexture ? "texelFetch(dgtkLights, " + index + ")" : "dgtkLights[" + index + "]";
}

/// Adds one light, whose unit vector towards it is L and whose strength at the surface is s.
std::string addLight(const ShaderVariant& variant)
{
  std::string text = "    float df = dot(normalVC, L);\n" + litPart(variant, lightValue(variant, 2) + ".w");
  const std::string ambient = lightValue(variant, 3) + ".rgb";
  const std::string diffuse = lightValue(variant, 4) + ".rgb";
  const std::string specular = lightValue(variant, 5) + ".rgb";
  if (variant.physical)
  {
    return text + (variant.shadows ? "" : "    float lit = 1.0;\n") + addPhysicalLight(ambient, diffuse, specular);
  }
  text += "    df *= s;\n"
          "    dgtkAmbient += s * " +
          ambient + ";\n" + (variant.shadows ? "    df *= lit;\n    s *= lit;\n" : "") +
          "    dgtkDiffuse += max(df, 0.0) * " + diffuse + ";\n";
  if (variant.specular)
  {
    text += "    if (df > 0.0)\n"
            "    {\n"
            "      float toViewer = max(0.0, dot(reflect(-L, normalVC), dgtkViewer));\n"
            "      dgtkSpecular += s * pow(toViewer, specularPower) * " +
            specular +
            ";\n"
            "    }\n";
  }
  return text;
}

std::string loop(int from, int count, const std::string& body)
{
  return count == 0 ? std::string()
                    : "  for (int i = " + std::to_string(from) + "; i < " + std::to_string(from + count) +
                        "; ++i)\n  {\n" + body + "  }\n";
}

/// VTK's own formula for a single head light, which takes the viewer to be where the light is.
std::string headLighting(const ShaderVariant& variant)
{
  const std::string text = "  float df = max(0.0, normalVC.z);\n"
                           "  vec3 dgtkColor = (" +
                           shortest(worldAmbient) +
                           " + dgtkLights[3].rgb) * ambientColor + dgtkEmission + df * diffuseColor * "
                           "dgtkLights[4].rgb";
  return text + (variant.specular ? " + pow(df, specularPower) * specularColor * dgtkLights[5].rgb;\n" : ";\n");
}

std::string lawCode(const ShaderVariant& variant, std::string code)
{
  const char* const words[] = { "POSITION", "AXIS", "FADING" };
  for (int slot = 0; slot < 3; ++slot)
  {
    vtkShaderProgram::Substitute(code, words[slot], lightValue(variant, slot), true);
  }
  return code;
}

std::string lighting(const ShaderVariant& variant)
{
  if (variant.headOnly && !variant.physical)
  {
    return headLighting(variant);
  }
  std::string text = variant.physical ? beginPhysical(variant)
                                      : "  vec3 dgtkAmbient = vec3(" + shortest(worldAmbient) +
                                          ");\n"
                                          "  vec3 dgtkDiffuse = vec3(0.0);\n";
  if (variant.specular && !variant.physical)
  {
    text += "  vec3 dgtkSpecular = vec3(0.0);\n"
            "  vec3 dgtkViewer = cameraParallel == 1 ? vec3(0.0, 0.0, 1.0) : normalize(-vertexVC.xyz);\n";
  }
  const std::string add = addLight(variant);
  int first = 0;
  for (std::size_t law = 0; law < variant.lights.size(); ++law)
  {
    text += loop(first, variant.lights[law], lawCode(variant, lightLaw(LightLaw(law)).code) + add);
    first += variant.lights[law];
  }
  if (variant.physical)
  {
    return text + endPhysical(variant);
  }
  text += "  vec3 dgtkColor = dgtkAmbient * ambientColor + dgtkEmission + dgtkDiffuse * diffuseColor";
  text += variant.specular ? " + dgtkSpecular * specularColor;\n" : ";\n";
  return text;
}

} // namespace

void substituteColor(const ShaderVariant& variant, std::string& vertex, std::string& fragment)
{
  std::string declarations = "uniform vec2 dgtkDraw; // number of the draw; 1 when its instance is mirrored\n"
                             "uniform vec3 dgtkEmission;\n";
  const int lights = std::accumulate(variant.lights.begin(), variant.lights.end(), 0);
  if (lights > 0)
  {
    declarations += variant.lightTexture
                      ? std::string("uniform samplerBuffer dgtkLights;\n")
                      : "uniform vec4 dgtkLights[" + std::to_string(lights * RasterLights::stride) + "];\n";
  }
  declarations += triangleIn;
  put(vertex, "//VTK::ValuePass::Dec", triangleOut(variant));
  put(vertex, "//VTK::ValuePass::Impl", triangleCode(variant));
  declarations += filterCode(variant);
  declarations += goneCode(variant);
  declarations += variant.peel ? peeling : "";
  declarations += variant.collect ? collecting : "";
  if (variant.collect)
  {
    put(
      fragment, "//VTK::System::Dec", "//VTK::System::Dec\n#extension GL_ARB_shader_storage_buffer_object : require\n");
  }
  declarations += "const float dgtkWorldAmbient = " + shortest(worldAmbient) + ";\n" + surfaceDeclarations(variant);
  put(fragment, "//VTK::ValuePass::Dec", declarations);
  // Everything is two-sided: the normal of the front, as pictures turn it, points to where it is seen from then.
  put(fragment, "//VTK::Normal::Impl",
    "  vec3 normalVC = normalVCVSOutput * inversesqrt(max(dot(normalVCVSOutput, normalVCVSOutput), 1e-30));\n" +
      perturbedNormal(variant) + "  if (gl_FrontFacing == (dgtkDraw.y > 0.5)) { normalVC = -normalVC; }\n");
  std::string light = lighting(variant);
  const bool ownEmission = variant.emissionMap && !variant.physical;
  if (ownEmission)
  {
    const std::string plain = " + dgtkEmission";
    light.erase(light.find(plain), plain.size());
  }
  // VTK has the vertices' colours in place of the material's.
  const char* const tint = "  ambientColor *= ambientColorUniform;\n  diffuseColor *= diffuseColorUniform;\n";
  put(fragment, "//VTK::Light::Impl", (variant.colored ? tint : "") + light);
  std::string finish =
    variant.textured && !variant.physical ? "  dgtkColor *= dgtkTexel(actortexture, tcoordVCVSOutput);\n" : "";
  finish += ownEmission ? "  dgtkColor += dgtkEmission * dgtkTexel(dgtkEmissionMap, tcoordVCVSOutput).rgb;\n" : "";
  finish += fogCode(variant);
  finish += identity;
  if (variant.cutOut)
  {
    finish += "  if (dgtkGone(actortexture, tcoordVCVSOutput)) { discard; }\n";
  }
  if (variant.peel)
  {
    finish += "  if (dgtkPeeled(dgtkId)) { discard; }\n";
  }
  finish += variant.collect ? "  dgtkAppend(dgtkId, vec4(dgtkColor, opacity));\n" : "";
  finish += "  gl_FragData[0] = vec4(dgtkColor, opacity);\n"
            "  gl_FragData[1] = vec4(dgtkId, gl_FragCoord.z, 1.0);\n";
  put(fragment, "//VTK::TCoord::Impl", finish);
  // VTK's test of alpha would cost the early depth test.
  put(fragment, "if (gl_FragData[0].a <= 0.0)\n    {\n    discard;\n    }", "");
  putWraps(variant, fragment);
}

std::string idVertexShader(const ShaderVariant& variant)
{
  std::string text = "#version 150\n"
                     "in vec4 vertexMC;\n"
                     "uniform mat4 MCDCMatrix;\n";
  text += variant.cutOut ? "in vec2 tcoord;\nout vec2 tcoordVCVSOutput;\n" : "";
  text += triangleOut(variant);
  text += "void main()\n{\n";
  text += variant.cutOut ? "  tcoordVCVSOutput = tcoord;\n" : "";
  text += triangleCode(variant);
  return text + "  gl_Position = MCDCMatrix * vertexMC;\n}\n";
}

std::string idFragmentShader(const ShaderVariant& variant)
{
  std::string text = "#version 150\n"
                     "uniform vec2 dgtkDraw;\n"
                     "out vec4 dgtkOutput;\n";
  text += variant.cutOut ? "uniform sampler2D actortexture;\nin vec2 tcoordVCVSOutput;\n" : "";
  text += triangleIn;
  text += goneCode(variant);
  text += variant.peel ? peeling : "";
  text += "void main()\n{\n";
  text += identity;
  text += variant.cutOut ? "  if (dgtkGone(actortexture, tcoordVCVSOutput)) { discard; }\n" : "";
  text += variant.peel ? "  if (dgtkPeeled(dgtkId)) { discard; }\n" : "";
  return text + "  dgtkOutput = vec4(dgtkId, gl_FragCoord.z, 1.0);\n}\n";
}

} // namespace dgtk
