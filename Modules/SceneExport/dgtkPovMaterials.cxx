// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovMaterials.h"

#include "dgtkPovLights.h"
#include "dgtkPovMeshes.h"
#include "dgtkPovText.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
/// A finish's ambient and emission are multiplied with the pigment: no component of it may vanish.
constexpr double smallestTint = 1.0 / 1024;

constexpr const char* flatFinish = " finish { ambient 0 diffuse 0 emission 1 }";

const Image* imageOf(const Model& model, const Material& material)
{
  return material.texture >= 0 && !model.uvs.empty()
           ? model.textures[static_cast<std::size_t>(material.texture)].image.get()
           : nullptr;
}

const Image* bumpImage(const Model& model, const Material& material)
{
  return material.bumpMap >= 0 && !model.uvs.empty()
           ? model.textures[static_cast<std::size_t>(material.bumpMap)].image.get()
           : nullptr;
}

/// `normal { ... }`: POV-Ray's slopes are differences between neighbouring texels, in texels. Its axes on the surface
/// follow from the normal as in a left-handed world, which the mirror undoes.
std::string bumps(const PovSurface& surface, PovImages& images)
{
  const Material& material = surface.material;
  if (!bumpImage(surface.model, material))
  {
    return {};
  }
  const Texture& texture = surface.model.textures[static_cast<std::size_t>(material.bumpMap)];
  return "normal { uv_mapping bump_map { " + images.color(texture, { 1, 1, 1 }, false) + " interpolate 2 bump_size " +
         povNumber(material.bumpScale / surface.texel) + " } scale <1, 1, -1> } ";
}

const Texture& textureOf(const Model& model, const Material& material)
{
  return model.textures[static_cast<std::size_t>(material.texture)];
}

/// `inside` where the texture's texels are, nothing elsewhere.
std::string masked(const Model& model, const Material& material, PovImages& images, const std::string& inside)
{
  return "uv_mapping image_pattern { " + images.mask(textureOf(model, material)) +
         " gamma 1 } pigment_map { [0.5 rgbt <1, 1, 1, 1>] [0.5 " + inside + "] }";
}

/// Largest Phong exponent of a material: a mirror.
constexpr double mirrorShininess = 128;

std::string finish(const Material& material, const Eigen::Vector3d& tint, double diffuse, bool highlight,
  const PovSurfaceOptions& options)
{
  std::string text =
    "finish { ambient " + povColor(material.ambient.cwiseQuotient(tint)) + " diffuse " + povNumber(diffuse);
  if (!material.emission.isZero(0))
  {
    text += " emission " + povColor(material.emission.cwiseQuotient(tint));
  }
  const double shine = material.specular.mean();
  if (shine > 0 && highlight)
  {
    text += options.headLit
              ? " specular " + povNumber(shine) + " roughness " + povNumber(1 / std::max(material.shininess, 1.0))
              : " phong " + povNumber(shine) + " phong_size " + povNumber(material.shininess);
  }
  const double mirror = shine * std::min(material.shininess / mirrorShininess, 1.0);
  if (options.reflections && highlight && mirror > 0)
  {
    text += " reflection { " + povNumber(mirror) + " }";
  }
  return text + " }";
}
} // namespace

PovSurface povSurfaceOf(const Instance& instance, std::size_t material)
{
  const Model& model = *instance.model;
  PovSurface surface{ model, povMaterialsOf(instance)[material], 1 };
  if (const Image* image = bumpImage(model, surface.material))
  {
    double space = 0;
    double picture = 0;
    for (const Part& part : model.parts)
    {
      for (std::uint32_t i = 0; std::size_t(part.material) == material && i < part.triangles; ++i)
      {
        const auto& triangle = model.triangles[part.firstTriangle + i];
        const auto& at = instance.geometry->positions;
        space += (at[triangle[1]] - at[triangle[0]]).cross(at[triangle[2]] - at[triangle[0]]).norm();
        const Eigen::Vector2d u = model.uvs[triangle[1]] - model.uvs[triangle[0]];
        const Eigen::Vector2d v = model.uvs[triangle[2]] - model.uvs[triangle[0]];
        picture += std::abs(u.x() * v.y() - u.y() * v.x());
      }
    }
    const double texels = picture * image->width * image->height;
    surface.texel = texels > 0 && space > 0 ? std::sqrt(space / texels) * povUnitOf(instance) : 1;
  }
  return surface;
}

double povUnitOf(const Instance& instance)
{
  const std::vector<Material>& materials = povMaterialsOf(instance);
  const bool bumpy = std::any_of(materials.begin(), materials.end(),
    [&](const Material& material) { return bumpImage(*instance.model, material) != nullptr; });
  return bumpy ? std::cbrt(std::abs(instance.world_from_object.linear.determinant())) : 1;
}

PovSurfaceOptions povSurfaceOptions(const SceneState& state, const PovOptions& options)
{
  PovSurfaceOptions surface;
  static_cast<PovOptions&>(surface) = options;
  surface.cast = povShadows(state, options);
  surface.headLit = std::all_of(
    state.lights.begin(), state.lights.end(), [](const LightState& light) { return light.kind == LightKind::Head; });
  return surface;
}

bool povCutOut(const Model& model, const Material& material) { return material.cutOut && imageOf(model, material); }

std::string povMaterial(const PovSurface& surface, const PovSurfaceOptions& options, PovImages& images)
{
  const Model& model = surface.model;
  const Material& material = surface.material;
  const double diffuse = material.diffuse.maxCoeff();
  Eigen::Vector3d tint(1, 1, 1);
  if (diffuse > 0)
  {
    tint = (material.diffuse / diffuse).cwiseMax(smallestTint);
  }
  const double transmit = 1 - material.opacity;
  const bool cutOut = povCutOut(model, material);
  std::string pigment;
  if (imageOf(model, material))
  {
    pigment = "image_map { " + images.color(textureOf(model, material), tint, cutOut) + " gamma srgb interpolate 2" +
              (transmit > 0 ? " transmit all " + povNumber(transmit) : "") + " }";
    pigment = cutOut ? masked(model, material, images, pigment) : "uv_mapping " + pigment;
  }
  else
  {
    pigment =
      transmit > 0 ? "rgbt " + povVector(Eigen::Vector4d(tint.x(), tint.y(), tint.z(), transmit)) : povColor(tint);
  }
  return "texture { pigment { " + pigment + " } " + bumps(surface, images) +
         finish(material, tint, diffuse, !cutOut, options) + " }";
}

namespace
{
std::string idColor(std::uint32_t id)
{
  return povColor(Eigen::Vector3d(id >> 16 & 255, id >> 8 & 255, id & 255) / 255);
}
} // namespace

std::string povFlatTexture(std::uint32_t id) { return "texture { pigment { " + idColor(id) + " }" + flatFinish + " }"; }

std::string povFlatMaterial(const Model& model, const Material& material, std::uint32_t id, PovImages& images)
{
  return povCutOut(model, material)
           ? "texture { pigment { " + masked(model, material, images, idColor(id)) + " }" + flatFinish + " }"
           : povFlatTexture(id);
}

std::string povPositionTexture(const PovBox& box)
{
  std::string pigments;
  for (int axis = 0; axis < 3; ++axis)
  {
    // three pigments are averaged
    pigments += std::string(" [1 gradient ") + "xyz"[axis] + " color_map { [0 rgb 0] [1 " +
                povColor(3 * Eigen::Vector3d::Unit(axis)) + "] } scale " + povNumber(box.high[axis] - box.low[axis]) +
                " translate " + povNumber(box.low[axis]) + " * " + "xyz"[axis] + ']';
  }
  return "texture { pigment { average pigment_map {" + pigments + " } }" + flatFinish + " }";
}

} // namespace dgtk
