// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAssimpConvert.h"
#include "dgtkColladaText.h"
#include "dgtkPortableMath.h"

#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

namespace dgtk::import
{

namespace
{
/// Largest side of an uncompressed embedded picture.
constexpr unsigned largestSide = 16384;

const aiTextureType pictureTypes[] = { aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE };
/// Of Collada, those that are drawn.
const aiTextureType colladaTypes[] = { aiTextureType_DIFFUSE, aiTextureType_EMISSIVE, aiTextureType_OPACITY };

std::array<double, 3> rgb(const aiColor4D& color) { return { color.r, color.g, color.b }; }

void readColor(const aiMaterial& from, const char* key, std::array<double, 3>& to)
{
  aiColor4D color;
  if (from.Get(key, 0, 0, color) == aiReturn_SUCCESS)
  {
    to = rgb(color);
  }
}

double number(const aiMaterial& from, const char* key, double otherwise)
{
  ai_real value = 0;
  return from.Get(key, 0, 0, value) == aiReturn_SUCCESS ? static_cast<double>(value) : otherwise;
}

bool hasNumber(const aiMaterial& from, const char* key)
{
  ai_real value = 0;
  return from.Get(key, 0, 0, value) == aiReturn_SUCCESS;
}

Wrap wrapOf(const aiMaterial& from, const char* key, aiTextureType type)
{
  int mode = aiTextureMapMode_Wrap;
  from.Get(key, type, 0, mode);
  return mode == aiTextureMapMode_Wrap ? Wrap::Repeat : mode == aiTextureMapMode_Mirror ? Wrap::Mirror : Wrap::Clamp;
}

Map mapOf(const aiMaterial& from, aiTextureType type)
{
  aiString name;
  if (from.GetTexture(type, 0, &name) != aiReturn_SUCCESS)
  {
    return {};
  }
  return { name.C_Str(), { wrapOf(from, "$tex.mapmodeu", type), wrapOf(from, "$tex.mapmodev", type) } };
}

void readPicture(const aiMaterial& from, Material& to)
{
  for (const aiTextureType type : pictureTypes)
  {
    to.texture = to.texture.name.empty() ? mapOf(from, type) : to.texture;
  }
}

/// Metal and roughness as a Phong material: reflectance at normal incidence 0.04 for what is not metal, exponent
/// 2 / roughness^4 - 2 (Karis 2013, of the microfacet distribution), highlights fading with roughness.
void fromMetalRoughness(const aiMaterial& from, Material& to)
{
  aiColor4D base(1, 1, 1, 1);
  from.Get(AI_MATKEY_BASE_COLOR, base);
  aiColor3D emission(0, 0, 0);
  from.Get(AI_MATKEY_COLOR_EMISSIVE, emission);
  const double metal = std::clamp(number(from, "$mat.metallicFactor", 1), 0.0, 1.0);
  const double rough = std::clamp(number(from, "$mat.roughnessFactor", 1), 0.0, 1.0);
  to.physical = 1;
  to.metallic = metal;
  to.roughness = rough;
  const double color[3] = { base.r, base.g, base.b };
  const double light[3] = { emission.r, emission.g, emission.b };
  for (std::size_t i = 0; i < 3; ++i)
  {
    to.diffuse[i] = portable::srgbFromLinear(color[i]);
    to.ambient[i] = 0.2 * to.diffuse[i];
    to.specular[i] = portable::srgbFromLinear((0.04 + (color[i] - 0.04) * metal) * (1 - rough));
    to.emission[i] = portable::srgbFromLinear(light[i]);
  }
  const double alpha = std::max(rough * rough, 0.1);
  to.shininess = std::clamp(2 / (alpha * alpha) - 2, 0.0, 128.0);
  to.opacity = base.a;
}

/// KHR_materials_pbrSpecularGlossiness, as a Phong material.
void fromSpecularGlossiness(const aiMaterial& from, Material& to)
{
  aiColor4D diffuse(1, 1, 1, 1);
  from.Get(AI_MATKEY_COLOR_DIFFUSE, diffuse);
  aiColor4D specular(1, 1, 1, 1);
  from.Get(AI_MATKEY_COLOR_SPECULAR, specular);
  const double gloss = std::clamp(number(from, "$mat.glossinessFactor", 1), 0.0, 1.0);
  to.physical = 0;
  for (unsigned i = 0; i < 3; ++i)
  {
    to.diffuse[i] = portable::srgbFromLinear(double(diffuse[i]));
    to.ambient[i] = 0.2 * to.diffuse[i];
    to.specular[i] = portable::srgbFromLinear(double(specular[i]) * gloss);
  }
  const double alpha = std::max((1 - gloss) * (1 - gloss), 0.1);
  to.shininess = std::clamp(2 / (alpha * alpha) - 2, 0.0, 128.0);
  to.opacity = diffuse.a;
}

/// KHR_materials_unlit: its colour, whatever the light.
void makeUnlit(Material& to)
{
  to.emission = to.diffuse;
  to.ambient = to.diffuse = to.specular = { 0, 0, 0 };
  to.physical = 0;
  to.shininess = 0;
  to.emissionMap = {};
}

/// A property of the material's first texture of a type.
double ofPicture(const aiMaterial& from, const char* key, aiTextureType type, double otherwise)
{
  ai_real value = 0;
  return from.Get(key, type, 0, value) == aiReturn_SUCCESS ? static_cast<double>(value) : otherwise;
}

void readMaps(const aiMaterial& from, Material& to)
{
  to.normalMap = mapOf(from, aiTextureType_NORMALS);
  to.metallicRoughnessMap = mapOf(from, aiTextureType_UNKNOWN); // where Assimp 5 keeps it
  to.emissionMap = mapOf(from, aiTextureType_EMISSIVE);
  to.occlusionMap = mapOf(from, aiTextureType_LIGHTMAP);
  to.normalScale = ofPicture(from, "$tex.scale", aiTextureType_NORMALS, 1);
  to.occlusionStrength = std::clamp(ofPicture(from, "$tex.strength", aiTextureType_LIGHTMAP, 1), 0.0, 1.0);
}

/// Whether a picture that is read wants its texels, not what is between them.
bool isNearest(const aiMaterial& from)
{
  constexpr int nearest = 9728; // of OpenGL, as the file has it
  const aiTextureType read[] = { aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE, aiTextureType_NORMALS,
    aiTextureType_UNKNOWN, aiTextureType_EMISSIVE, aiTextureType_LIGHTMAP };
  return std::any_of(std::begin(read), std::end(read),
    [&from](aiTextureType type)
    {
      int filter = 0;
      return from.Get("$tex.mappingfiltermag", type, 0, filter) == aiReturn_SUCCESS && filter == nearest;
    });
}

void readAlpha(const aiMaterial& from, Material& to)
{
  aiString mode;
  to.alpha = AlphaMode::Opaque;
  if (from.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == aiReturn_SUCCESS)
  {
    const std::string text = mode.C_Str();
    to.alpha = text == "MASK" ? AlphaMode::Mask : text == "BLEND" ? AlphaMode::Blend : AlphaMode::Opaque;
  }
  to.alphaCutoff = number(from, "$mat.gltf.alphaCutoff", 0.5);
}

bool has(const aiMaterial& from, aiTextureType type) { return from.GetTextureCount(type) > 0; }

/// Whether Collada's ambient light has a picture that is not the one of colour, as it is as a rule.
bool hasOwnAmbient(const aiMaterial& from)
{
  return has(from, aiTextureType_LIGHTMAP) &&
         mapOf(from, aiTextureType_LIGHTMAP).name != mapOf(from, aiTextureType_DIFFUSE).name;
}

bool isInverse(const aiMaterial& from)
{
  return has(from, aiTextureType_OPACITY) && ofPicture(from, "$tex.blend", aiTextureType_OPACITY, 1) == inverseWeight;
}

/// Colours are white where a picture drives them.
void readColladaMaps(const aiMaterial& from, Material& to)
{
  to.emissionMap = mapOf(from, aiTextureType_EMISSIVE);
  to.ambient = hasOwnAmbient(from) ? std::array<double, 3>{ 0, 0, 0 } : to.ambient;
  to.specular = has(from, aiTextureType_SPECULAR) ? std::array<double, 3>{ 0, 0, 0 } : to.specular;
  aiColor4D light;
  to.maskIsLuminance = from.Get(AI_MATKEY_COLOR_TRANSPARENT, light) == aiReturn_SUCCESS ? 1 : 0;
  const Map mask = mapOf(from, aiTextureType_OPACITY);
  if (isInverse(from))
  {
    to.maskInverse = std::clamp(1 - to.opacity, 0.0, 1.0); // Assimp's opacity is what <transparency> leaves
    to.opacity = 1;
    to.mask = to.maskInverse > 0 ? mask : to.mask;
    return;
  }
  to.mask = mask.name == to.texture.name && to.maskIsLuminance == 0 ? to.mask : mask; // its own alpha counts
}

/// Elements of Collada's materials whose pictures are not drawn.
std::set<std::string> unreadPictures(const aiMaterial& from)
{
  std::set<std::string> names;
  for (const auto& [isUnread, name] :
    { std::pair(hasOwnAmbient(from), "\"ambient\""), { has(from, aiTextureType_SPECULAR), "\"specular\"" },
      { has(from, aiTextureType_REFLECTION), "\"reflective\"" }, { has(from, aiTextureType_NORMALS), "\"bump\"" } })
  {
    if (isUnread)
    {
      names.insert(name);
    }
  }
  return names;
}

aiUVTransform placementOf(const aiMaterial& from, aiTextureType type)
{
  aiUVTransform to;
  from.Get(AI_MATKEY_UVTRANSFORM(type, 0), to);
  return to;
}

/// Of Collada's pictures that are drawn, by Maya's words.
void warnOfPlaces(const aiMaterial& from, std::vector<std::string>& warnings)
{
  std::vector<aiUVTransform> all;
  for (const aiTextureType type : colladaTypes)
  {
    if (has(from, type))
    {
      all.push_back(placementOf(from, type));
    }
  }
  const auto some = [&all](auto holds) { return std::any_of(all.begin(), all.end(), holds); };
  const std::string name = "material \"" + std::string(from.GetName().C_Str()).substr(0, 200) + '"';
  if (some([](const aiUVTransform& one) { return one.mRotation != 0; }))
  {
    warnings.push_back(name + " turns its pictures: they are drawn without that");
  }
  if (some([&all](const aiUVTransform& one)
        { return one.mScaling != all.front().mScaling || one.mTranslation != all.front().mTranslation; }))
  {
    warnings.push_back(name + " has pictures in several places: all lie where the first does");
  }
}

void warnOfPictures(const aiScene& from, const std::set<unsigned>& used, std::vector<std::string>& warnings)
{
  std::set<std::string> unread;
  for (const unsigned index : used)
  {
    unread.merge(unreadPictures(*from.mMaterials[index]));
    warnOfPlaces(*from.mMaterials[index], warnings);
  }
  std::string names;
  for (const std::string& name : unread)
  {
    names += (names.empty() ? "" : ", ") + name;
  }
  if (!names.empty())
  {
    warnings.push_back("pictures of " + names + " are not drawn");
  }
}

Material converted(const aiMaterial& from, bool gltf)
{
  Material to;
  to.name = from.GetName().C_Str();
  int twoSided = 0;
  from.Get(AI_MATKEY_TWOSIDED, twoSided);
  to.twoSided = twoSided != 0 ? 1 : 0;
  readPicture(from, to);
  if (gltf)
  {
    fromMetalRoughness(from, to);
    if (hasNumber(from, "$mat.glossinessFactor"))
    {
      fromSpecularGlossiness(from, to);
    }
    readMaps(from, to);
    readAlpha(from, to);
    int shading = 0;
    if (from.Get(AI_MATKEY_SHADING_MODEL, shading) == aiReturn_SUCCESS && shading == aiShadingMode_Unlit)
    {
      makeUnlit(to);
    }
    return to;
  }
  readColor(from, "$clr.ambient", to.ambient);
  readColor(from, "$clr.diffuse", to.diffuse);
  readColor(from, "$clr.specular", to.specular);
  readColor(from, "$clr.emissive", to.emission);
  to.shininess = number(from, "$mat.shininess", 0);
  to.opacity = number(from, "$mat.opacity", 1);
  if (!(to.shininess > 0))
  {
    to.specular = { 0, 0, 0 }; // an exponent of 0 would shine everywhere
  }
  readColladaMaps(from, to);
  return to;
}

Texture converted(const aiTexture& from)
{
  Texture to;
  to.name = from.mFilename.C_Str();
  to.type = from.achFormatHint;
  if (from.mHeight == 0)
  {
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(from.pcData);
    to.data.assign(bytes, bytes + from.mWidth);
    return to;
  }
  if (from.mWidth > largestSide || from.mHeight > largestSide)
  {
    return to;
  }
  to.width = static_cast<std::int32_t>(from.mWidth);
  to.height = static_cast<std::int32_t>(from.mHeight);
  for (std::size_t i = 0; i < std::size_t(from.mWidth) * from.mHeight; ++i)
  {
    const aiTexel& texel = from.pcData[i];
    to.data.insert(to.data.end(), { texel.r, texel.g, texel.b, texel.a });
  }
  return to;
}
} // namespace

PicturePlace placeOf(const aiScene& from, unsigned material, bool gltf)
{
  PicturePlace to;
  if (material >= from.mNumMaterials)
  {
    return to;
  }
  const aiMaterial& of = *from.mMaterials[material];
  const auto* const begin = gltf ? std::begin(pictureTypes) : std::begin(colladaTypes);
  const auto* const end = gltf ? std::end(pictureTypes) : std::end(colladaTypes);
  const auto* const first = std::find_if(begin, end, [&of](aiTextureType type) { return has(of, type); });
  if (first != end)
  {
    int channel = 0;
    of.Get(AI_MATKEY_UVWSRC(*first, 0), channel);
    to.channel = channel > 0 && channel < AI_MAX_NUMBER_OF_TEXTURECOORDS ? static_cast<unsigned>(channel) : 0;
    const aiUVTransform transform = gltf ? aiUVTransform() : placementOf(of, *first);
    to.scale = { transform.mScaling.x, transform.mScaling.y };
    to.offset = { transform.mTranslation.x, transform.mTranslation.y };
  }
  return to;
}

void convertMaterials(const aiScene& from, bool gltf, Scene& to)
{
  for (unsigned i = 0; i < from.mNumMaterials; ++i)
  {
    to.materials.push_back(converted(*from.mMaterials[i], gltf));
  }
  std::set<unsigned> used;
  std::for_each(from.mMeshes, from.mMeshes + from.mNumMeshes,
    [&](const aiMesh* mesh)
    {
      if (mesh->mMaterialIndex < from.mNumMaterials)
      {
        used.insert(mesh->mMaterialIndex);
      }
    });
  if (!gltf)
  {
    warnOfPictures(from, used, to.warnings);
  }
  else if (std::any_of(
             used.begin(), used.end(), [&from](unsigned index) { return isNearest(*from.mMaterials[index]); }))
  {
    to.warnings.emplace_back("pictures whose magFilter is NEAREST are interpolated between their texels all the same");
  }
  for (unsigned i = 0; i < from.mNumTextures; ++i)
  {
    to.textures.push_back(converted(*from.mTextures[i]));
    // pictures that the file holds are also named by their file name
    for (Material& material : to.materials)
    {
      for (const auto map : mapsOfMaterials)
      {
        std::string& name = (material.*map).name;
        if (!name.empty() && name == to.textures.back().name)
        {
          name = "*" + std::to_string(i);
        }
      }
    }
  }
}

} // namespace dgtk::import
