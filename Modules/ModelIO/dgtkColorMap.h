// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkColorMap_h
#define dgtkColorMap_h

#include "dgtkModel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace dgtk
{

/// The texel of Model::colorMap at a place: R, G, B, A. Its border goes on.
inline std::array<std::uint8_t, 4> colorMapTexel(const Image& map, const Eigen::Vector2d& at)
{
  const auto within = [](double place, int size)
  { return place > 0 ? std::size_t(std::min(std::floor(place * size), size - 1.0)) : std::size_t(0); };
  const std::size_t x = within(at.x(), map.width);
  const std::size_t y = std::size_t(map.height) - 1 - within(at.y(), map.height);
  const std::uint8_t* const texel = &map.rgba[4 * (y * std::size_t(map.width) + x)];
  return { texel[0], texel[1], texel[2], texel[3] };
}

/// The index of the texel at a texture coordinate, of `size` along its axis; 0 where there is no number.
inline std::size_t wrappedTexel(double coordinate, int size, TextureWrap wrap)
{
  const double cell = std::floor(coordinate * size);
  const double period = wrap == TextureWrap::Mirror ? 2.0 * size : size;
  double index = wrap == TextureWrap::Clamp ? std::clamp(cell, 0.0, size - 1.0) : std::fmod(cell, period);
  index = index < 0 ? index + period : index;
  index = index < size ? index : period - 1 - index;
  return std::isfinite(index) ? std::size_t(index) : std::size_t(0);
}

/// The texel of Model::textures[texture] that is nearest to a point of a triangle, R, G, B, A; null where there is no
/// such texture, picture or coordinate. `barycentrics` of the second and third corner.
inline const std::uint8_t* nearestTexel(
  const Model& model, std::uint32_t triangle, const Eigen::Vector2d& barycentrics, int texture)
{
  if (texture < 0 || model.uvs.empty() || !model.textures[std::size_t(texture)].image)
  {
    return nullptr;
  }
  const TextureWraps& wrap = model.textures[std::size_t(texture)].wrap;
  const Image& image = *model.textures[std::size_t(texture)].image;
  const auto& corners = model.triangles[triangle];
  const Eigen::Vector2d& first = model.uvs[corners[0]];
  const Eigen::Vector2d uv =
    first + barycentrics.x() * (model.uvs[corners[1]] - first) + barycentrics.y() * (model.uvs[corners[2]] - first);
  if (!uv.allFinite() || image.width < 1 || image.height < 1)
  {
    return nullptr;
  }
  const std::size_t row = std::size_t(image.height) - 1 - wrappedTexel(uv.y(), image.height, wrap[1]);
  return &image.rgba[(row * std::size_t(image.width) + wrappedTexel(uv.x(), image.width, wrap[0])) * 4];
}

/// The colour of a vertex, R, G, B, A, whichever way the model has it; white where it has none.
inline std::array<std::uint8_t, 4> vertexColor(const Model& model, std::size_t vertex)
{
  if (!model.colors.empty())
  {
    return model.colors[vertex];
  }
  return model.colorMap ? colorMapTexel(*model.colorMap, model.colorMapAt[vertex])
                        : std::array<std::uint8_t, 4>{ 255, 255, 255, 255 };
}

/// Whether some colour of the vertices lets see what is behind.
inline bool hasTranslucentColors(const Model& model)
{
  return (model.colorMap && model.colorMap->hasAlpha) ||
         std::any_of(model.colors.begin(), model.colors.end(), [](const auto& color) { return color[3] < 255; });
}

} // namespace dgtk

#endif
