// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovMaterials.h"

#include "dgtkPovText.h"

#include <algorithm>

namespace dgtk
{

namespace
{
/// A finish's ambient and emission are multiplied with the pigment: no component of it may vanish.
constexpr double SmallestTint = 1.0 / 1024;

constexpr const char* FlatFinish = " finish { ambient 0 diffuse 0 emission 1 }";

const Image* imageOf(const Model& model, const Material& material)
{
  return material.texture >= 0 && !model.uvs.empty()
           ? model.textures[static_cast<std::size_t>(material.texture)].image.get()
           : nullptr;
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
constexpr double MirrorShininess = 128;

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
  const double mirror = shine * std::min(material.shininess / MirrorShininess, 1.0);
  if (options.reflections && highlight && mirror > 0)
  {
    text += " reflection { " + povNumber(mirror) + " }";
  }
  return text + " }";
}
} // namespace

PovSurfaceOptions povSurfaceOptions(const SceneState& state, const PovOptions& options)
{
  PovSurfaceOptions surface;
  static_cast<PovOptions&>(surface) = options;
  surface.headLit = std::all_of(state.lights.begin(), state.lights.end(),
    [](const LightState& light) { return light.kind == LightState::Kind::Head; });
  return surface;
}

bool povCutOut(const Model& model, const Material& material) { return material.cutOut && imageOf(model, material); }

std::string povMaterial(
  const Model& model, const Material& material, const PovSurfaceOptions& options, PovImages& images)
{
  const double diffuse = material.diffuse.maxCoeff();
  Eigen::Vector3d tint(1, 1, 1);
  if (diffuse > 0)
  {
    tint = (material.diffuse / diffuse).cwiseMax(SmallestTint);
  }
  const double transmit = 1 - material.opacity;
  const bool cutOut = povCutOut(model, material);
  std::string pigment;
  if (imageOf(model, material))
  {
    pigment = "image_map { " + images.color(textureOf(model, material), tint) + " gamma srgb interpolate 2" +
              (transmit > 0 ? " transmit all " + povNumber(transmit) : "") + " }";
    pigment = cutOut ? masked(model, material, images, pigment) : "uv_mapping " + pigment;
  }
  else
  {
    pigment =
      transmit > 0 ? "rgbt " + povVector(Eigen::Vector4d(tint.x(), tint.y(), tint.z(), transmit)) : povColor(tint);
  }
  return "texture { pigment { " + pigment + " } " + finish(material, tint, diffuse, !cutOut, options) + " }";
}

namespace
{
std::string idColor(std::uint32_t id)
{
  return povColor(Eigen::Vector3d(id >> 16 & 255, id >> 8 & 255, id & 255) / 255);
}
} // namespace

std::string povFlatTexture(std::uint32_t id) { return "texture { pigment { " + idColor(id) + " }" + FlatFinish + " }"; }

std::string povFlatMaterial(const Model& model, const Material& material, std::uint32_t id, PovImages& images)
{
  return povCutOut(model, material)
           ? "texture { pigment { " + masked(model, material, images, idColor(id)) + " }" + FlatFinish + " }"
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
  return "texture { pigment { average pigment_map {" + pigments + " } }" + FlatFinish + " }";
}

} // namespace dgtk
