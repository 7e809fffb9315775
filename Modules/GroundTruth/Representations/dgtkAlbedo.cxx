// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAlbedo.h"

#include "dgtkColorMap.h"

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
/// Colour of a model's vertices, or of its map of colours, sRGB in [0, 1].
Eigen::Vector3d vertexColorAt(const Model& model, std::uint32_t triangle, const Eigen::Vector2d& barycentrics)
{
  const auto& corners = model.triangles[triangle];
  const auto between = [&](const auto& first, const auto& second, const auto& third)
  { return (first + barycentrics.x() * (second - first) + barycentrics.y() * (third - first)).eval(); };
  const auto bytes = [](const std::array<std::uint8_t, 4>& color)
  { return Eigen::Vector3d(color[0], color[1], color[2]); };
  if (!model.colors.empty())
  {
    const auto& colors = model.colors;
    return between(bytes(colors[corners[0]]), bytes(colors[corners[1]]), bytes(colors[corners[2]])) / 255;
  }
  if (model.colorMap)
  {
    const auto& at = model.colorMapAt;
    return bytes(colorMapTexel(*model.colorMap, between(at[corners[0]], at[corners[1]], at[corners[2]]))) / 255;
  }
  return Eigen::Vector3d::Ones();
}
} // namespace

const Material* materialOf(const Instance& instance, std::uint32_t triangle)
{
  const Model& model = *instance.model;
  const std::vector<Material>& materials = instance.materials ? *instance.materials : model.materials;
  return materials.empty() ? nullptr : &materials[model.parts[model.partOf(triangle)].material];
}

Eigen::Vector3d texelAt(
  const Instance& instance, std::uint32_t triangle, const Eigen::Vector2d& barycentrics, int texture)
{
  const std::uint8_t* const texel = nearestTexel(*instance.model, triangle, barycentrics, texture);
  return texel == nullptr ? Eigen::Vector3d::Ones()
                          : Eigen::Vector3d(Eigen::Vector3d(texel[0], texel[1], texel[2]) / 255);
}

std::array<std::uint8_t, 3> albedoAt(
  const Instance& instance, std::uint32_t triangle, const Eigen::Vector2d& barycentrics)
{
  Eigen::Vector3d color = vertexColorAt(*instance.model, triangle, barycentrics);
  if (const Material* const material = materialOf(instance, triangle))
  {
    const Eigen::Vector3d texel = texelAt(instance, triangle, barycentrics, material->texture);
    color = color.cwiseProduct(material->diffuse).cwiseProduct(texel).eval();
  }
  std::array<std::uint8_t, 3> rounded;
  for (int i = 0; i < 3; ++i)
  {
    rounded[i] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(color[i], 0.0, 1.0)));
  }
  return rounded;
}

} // namespace dgtk
