// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceShaders.h"

#include "dgtkEnvironmentLight.h"
#include "dgtkShadowMaps.h"
#include "dgtkSurfaceMaterial.h"

namespace dgtk
{
namespace
{

/// The frame of the texture coordinates follows from how position and coordinates change between pixels.
constexpr const char* tangentFrame = R"(
mat3 dgtkTextureFrame(vec3 p, vec3 n, vec2 uv)
{
  vec3 right = dFdx(p);
  vec3 up = dFdy(p);
  vec2 uvRight = dFdx(uv);
  vec2 uvUp = dFdy(uv);
  vec3 a = cross(up, n);
  vec3 b = cross(n, right);
  float side = dot(cross(right, up), n) < 0.0 ? -1.0 : 1.0;
  vec3 s = a * uvRight.y + b * uvUp.y;
  float size = dot(s, s);
  s *= size > 0.0 ? side * inversesqrt(size) : 0.0;
  vec3 t = cross(s, n);
  return mat3(t * sign(side * dot(t, a * uvRight.x + b * uvUp.x)), s, n);
}
)";

/// Blinn 1978; central differences of the height over a texel, or over a pixel where that is larger.
constexpr const char* bumpedNormal = R"(
vec3 dgtkBumped(vec3 p, vec3 n, sampler2D heights, vec2 uv, float scale)
{
  vec3 right = dFdx(p);
  vec3 up = dFdy(p);
  vec2 uvRight = dFdx(uv);
  vec2 uvUp = dFdy(uv);
  vec2 cells = vec2(textureSize(heights, 0));
  float texels = max(1.0, max(length(uvRight * cells), length(uvUp * cells)));
  vec2 s = texels / cells;
  vec2 slope = scale / (2.0 * s) *
    vec2(dgtkTexel(heights, uv + vec2(s.x, 0.0)).r - dgtkTexel(heights, uv - vec2(s.x, 0.0)).r,
         dgtkTexel(heights, uv + vec2(0.0, s.y)).r - dgtkTexel(heights, uv - vec2(0.0, s.y)).r);
  float toRight = dot(slope, uvRight);
  float toUp = dot(slope, uvUp);
  vec3 a = cross(up, n);
  vec3 b = cross(n, right);
  float area = dot(right, a);
  vec3 gradient = sign(area) * (toRight * a + toUp * b);
  vec3 turned = abs(area) * n - gradient;
  float size = dot(turned, turned);
  return size > 0.0 ? turned * inversesqrt(size) : n;
}
)";

/// Mean of 3 x 3 comparisons that are interpolated between texels: the larger depth is nearer to the light. The point
/// is moved off its surface by what lies between the texels compared, which grows with the surface's tilt against the
/// map. Of the nested maps of a light, the first that holds the point counts.
std::string shadowFunction()
{
  const std::string stride = std::to_string(ShadowMaps::stride);
  return "uniform sampler2DArray dgtkShadowMaps;\n"
         "uniform samplerBuffer dgtkShadowData;\n"
         "float dgtkLit(int map, vec3 L, vec3 p, vec3 n)\n"
         "{\n"
         "  vec4 info = texelFetch(dgtkShadowData, map * " +
         stride +
         " + 4);\n"
         "  if (info.z > 0.5)\n"
         "  {\n"
         "    vec3 d = -(dgtkWorldFromView * L);\n"
         "    vec3 size = abs(d);\n"
         "    map += size.x >= size.y && size.x >= size.z ? (d.x > 0.0 ? 0 : 1)\n"
         "         : size.y >= size.z ? (d.y > 0.0 ? 2 : 3) : (d.z > 0.0 ? 4 : 5);\n"
         "  }\n"
         "  vec3 place;\n"
         "  for (int left = int(info.w);; --left, ++map)\n"
         "  {\n"
         "    int at = map * " +
         stride +
         ";\n"
         "    mat4 m = mat4(texelFetch(dgtkShadowData, at), texelFetch(dgtkShadowData, at + 1),\n"
         "      texelFetch(dgtkShadowData, at + 2), texelFetch(dgtkShadowData, at + 3));\n"
         "    info = texelFetch(dgtkShadowData, at + 4);\n"
         "    float texel = info.x * dot(vec4(m[0].w, m[1].w, m[2].w, m[3].w), vec4(p, 1.0));\n"
         "    float tilt = dot(n, normalize(vec3(m[0].z, m[1].z, m[2].z)));\n"
         "    vec4 clip = m * vec4(p + n * (texel * (0.5 + 3.0 * sqrt(max(0.0, 1.0 - tilt * tilt)))), 1.0);\n"
         "    place = clip.xyz / clip.w;\n"
         "    if (left <= 1 || (max(abs(place.x), abs(place.y)) <= 1.0 - 4.0 / info.y && place.z >= 0.0)) { break; }\n"
         "  }\n"
         "  vec2 uv = (place.xy * 0.5 + 0.5) * info.y - 0.5;\n"
         "  vec2 low = floor(uv);\n"
         "  vec2 part = uv - low;\n"
         "  float sum = 0.0;\n"
         "  for (int y = -1; y < 3; ++y)\n"
         "  {\n"
         "    float row = y < 0 ? 1.0 - part.y : y > 1 ? part.y : 1.0;\n"
         "    for (int x = -1; x < 3; ++x)\n"
         "    {\n"
         "      float column = x < 0 ? 1.0 - part.x : x > 1 ? part.x : 1.0;\n"
         "      ivec2 t = clamp(ivec2(low) + ivec2(x, y), ivec2(0), ivec2(int(info.y) - 1));\n"
         "      float depth = texelFetch(dgtkShadowMaps, ivec3(t, map), 0).r;\n"
         "      sum += row * column * (place.z >= depth ? 1.0 : 0.0);\n"
         "    }\n"
         "  }\n"
         "  return sum / 9.0;\n"
         "}\n";
}

constexpr const char* environmentTerms = R"(
uniform vec3 dgtkIrradiance[9];
uniform mat3 dgtkImageFromView;
uniform sampler2D dgtkEnvironment;
uniform sampler2D dgtkReflectance;
)";

/// Where a direction of the image's axes lies in an equirectangular picture whose rows go down.
constexpr const char* equirectangular = R"(
vec2 dgtkEquirectangular(vec3 d)
{
  return vec2(0.5 + atan(d.x, -d.z) * 0.15915494309189535, acos(clamp(d.y, -1.0, 1.0)) * 0.3183098861837907);
}
)";

/// Cook-Torrance with the GGX distribution and Smith's joint masking (Walter et al. 2007; Heitz 2014), Schlick's
/// Fresnel term, Lambert's diffuse part for what is not reflected. Times pi: a light of strength 1 shows a white
/// diffuse surface white.
constexpr const char* microfacets = R"(
vec3 dgtkReflected(vec3 f0, float a2, float nl, float nv, float nh, float vh, out vec3 fresnel)
{
  float d = nh * nh * (a2 - 1.0) + 1.0;
  float masking = nl * sqrt(nv * nv * (1.0 - a2) + a2) + nv * sqrt(nl * nl * (1.0 - a2) + a2);
  fresnel = f0 + (1.0 - f0) * pow(clamp(1.0 - vh, 0.0, 1.0), 5.0);
  return fresnel * (a2 / (d * d) * 0.5 / max(masking, 1e-7));
}
)";

} // namespace

std::string surfaceDeclarations(const ShaderVariant& variant)
{
  std::string text;
  if (variant.physical || variant.fog)
  {
    text += transferShader();
  }
  if (variant.shadows || variant.environment)
  {
    text += "uniform mat3 dgtkWorldFromView;\n";
  }
  text += variant.normalMap
            ? std::string("uniform sampler2D dgtkNormalMap;\nuniform float dgtkNormalScale;\n") + tangentFrame
            : std::string();
  text += variant.bumpMap ? std::string("uniform sampler2D dgtkBumpMap;\nuniform float dgtkBumpScale;\n") + bumpedNormal
                          : std::string();
  text += variant.shadows ? shadowFunction() : std::string();
  text += variant.fog ? "uniform vec3 dgtkFog;\nuniform vec2 dgtkFogDensity;\n" : "";
  if (variant.physical)
  {
    text += "uniform vec2 dgtkMetalRough;\nuniform vec3 dgtkF0;\n";
    text += microfacets;
    text += variant.metallicRoughnessMap ? "uniform sampler2D dgtkMetalRoughMap;\n" : "";
    text += variant.occlusionMap ? "uniform sampler2D dgtkOcclusionMap;\nuniform float dgtkOcclusionStrength;\n" : "";
  }
  text += variant.emissionMap ? "uniform sampler2D dgtkEmissionMap;\n" : "";
  if (variant.environment)
  {
    text += environmentTerms;
    text += irradianceShader();
    text += equirectangular;
  }
  return text;
}

std::string perturbedNormal(const ShaderVariant& variant)
{
  std::string text;
  if (variant.bumpMap)
  {
    text += "  normalVC = dgtkBumped(vertexVC.xyz, normalVC, dgtkBumpMap, tcoordVCVSOutput, dgtkBumpScale);\n";
  }
  if (variant.normalMap)
  {
    text += "  vec3 dgtkTurn = dgtkTexel(dgtkNormalMap, tcoordVCVSOutput).xyz * (255.0 / 127.0) - 128.0 / 127.0;\n"
            "  dgtkTurn.xy *= dgtkNormalScale;\n"
            "  vec3 dgtkTurned = dgtkTextureFrame(vertexVC.xyz, normalVC, tcoordVCVSOutput) * dgtkTurn;\n"
            "  float dgtkTurnedSize = dot(dgtkTurned, dgtkTurned);\n"
            "  normalVC = dgtkTurnedSize > 0.0 ? dgtkTurned * inversesqrt(dgtkTurnedSize) : normalVC;\n";
  }
  return text;
}

std::string litPart(const ShaderVariant& variant, const std::string& shadowIndex)
{
  return variant.shadows ? "    int shadow = int(" + shadowIndex +
                             ");\n"
                             "    float lit = shadow > 0 && df > 0.0 ? dgtkLit(shadow - 1, L, vertexVC.xyz, normalVC) "
                             ": 1.0;\n"
                         : std::string();
}

std::string beginPhysical(const ShaderVariant& variant)
{
  std::string text = "  vec3 dgtkViewer = cameraParallel == 1 ? vec3(0.0, 0.0, 1.0) : normalize(-vertexVC.xyz);\n"
                     "  vec3 base = dgtkToLinear(diffuseColor";
  text += variant.textured ? " * dgtkTexel(actortexture, tcoordVCVSOutput).rgb);\n" : ");\n";
  text += "  vec2 metalRough = dgtkMetalRough;\n";
  text += variant.metallicRoughnessMap ? "  metalRough *= dgtkTexel(dgtkMetalRoughMap, tcoordVCVSOutput).bg;\n" : "";
  return text + "  float rough = clamp(metalRough.y, 0.03, 1.0);\n"
                "  float a2 = rough * rough * rough * rough;\n"
                "  vec3 f0 = mix(dgtkF0, base, metalRough.x);\n"
                "  vec3 albedo = base * (1.0 - metalRough.x);\n"
                "  float nv = max(dot(normalVC, dgtkViewer), 1e-4);\n"
                "  vec3 dgtkAmbient = vec3(0.0);\n"
                "  vec3 dgtkSum = vec3(0.0);\n";
}

std::string addPhysicalLight(const std::string& ambient, const std::string& diffuse, const std::string& specular)
{
  return "    dgtkAmbient += s * " + ambient +
         ";\n"
         "    if (df > 0.0)\n"
         "    {\n"
         "      vec3 h = normalize(L + dgtkViewer);\n"
         "      vec3 fresnel;\n"
         "      vec3 shine = dgtkReflected(f0, a2, df, nv, max(dot(normalVC, h), 0.0), max(dot(dgtkViewer, h), 0.0), "
         "fresnel);\n"
         "      dgtkSum += (s * lit * df) * (albedo * (1.0 - fresnel) * " +
         diffuse + " + shine * " + specular +
         ");\n"
         "    }\n";
}

std::string endPhysical(const ShaderVariant& variant)
{
  std::string text = "  float occlusion = 1.0;\n";
  if (variant.occlusionMap)
  {
    text += "  occlusion = 1.0 + dgtkOcclusionStrength * (dgtkTexel(dgtkOcclusionMap, tcoordVCVSOutput).r - 1.0);\n";
  }
  if (variant.environment)
  {
    text += "  vec2 reflectance = texture(dgtkReflectance, vec2(nv, rough)).rg;\n"
            "  vec3 mirrored = f0 * reflectance.x + reflectance.y;\n"
            "  vec3 away = dgtkImageFromView * reflect(-dgtkViewer, normalVC);\n"
            "  vec3 seen = textureLod(dgtkEnvironment, dgtkEquirectangular(away), rough * " +
            std::to_string(EnvironmentLight::levels - 1) +
            ".0).rgb;\n"
            "  dgtkSum += occlusion * (albedo * (1.0 - mirrored) * dgtkIrradianceFrom(dgtkImageFromView * normalVC) + "
            "mirrored * seen);\n"
            "  dgtkSum += dgtkAmbient * albedo;\n";
  }
  else
  {
    text += "  dgtkSum += dgtkToLinear(dgtkAmbient + dgtkWorldAmbient) * occlusion * (albedo + f0);\n";
  }
  text += "  dgtkSum += dgtkToLinear(dgtkEmission";
  text += variant.emissionMap ? " * dgtkTexel(dgtkEmissionMap, tcoordVCVSOutput).rgb);\n" : ");\n";
  return text + "  vec3 dgtkColor = dgtkToDisplay(dgtkSum);\n";
}

std::string fogCode(const ShaderVariant& variant)
{
  if (!variant.fog)
  {
    return {};
  }
  const std::string clear = "  float dgtkAway = cameraParallel == 1 ? -vertexVC.z : length(vertexVC.xyz);\n"
                            "  float dgtkClear = exp(-dgtkFogDensity.x * max(dgtkAway - dgtkFogDensity.y, 0.0));\n";
  return clear + (variant.physical ? "  dgtkColor = dgtkToDisplay(mix(dgtkToLinear(dgtkFog), dgtkSum, dgtkClear));\n"
                                   : "  dgtkColor = mix(dgtkFog, dgtkColor, dgtkClear);\n");
}

} // namespace dgtk
