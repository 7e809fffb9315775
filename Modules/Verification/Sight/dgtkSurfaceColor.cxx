// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceColor.h"

#include <vector>

namespace dgtk
{

namespace
{
/// Texels: as close to the border of two, either is right.
constexpr double texelSlack = 1e-6;

/// The texel that holds a place, counted from the lower left; a texture repeats.
Eigen::Vector3d texelAt(const Texture& texture, const Eigen::Array2d& place)
{
  const Image& image = *texture.image;
  const Eigen::Array2d size(image.width, image.height);
  Eigen::Array2d cell = place.floor();
  for (int i = 0; i < 2; ++i)
  {
    const bool odd = std::fmod(std::floor(cell[i] / size[i]), 2) != 0;
    const double tiled = cell[i] - std::floor(cell[i] / size[i]) * size[i];
    const TextureWrap wrap = texture.wrap[std::size_t(i)];
    cell[i] = wrap == TextureWrap::Clamp           ? std::min(std::max(cell[i], 0.0), size[i] - 1)
              : wrap == TextureWrap::Mirror && odd ? size[i] - 1 - tiled
                                                   : tiled;
  }
  const std::size_t row = std::size_t(image.height) - 1 - std::size_t(cell.y());
  const std::uint8_t* rgba = &image.rgba[(row * image.width + std::size_t(cell.x())) * 4];
  return Eigen::Vector3d(rgba[0], rgba[1], rgba[2]) / 255;
}
} // namespace

void meterColor(const Instance& instance, const Hit& hit, const Eigen::Vector3d& weights, const std::uint8_t* color,
  const std::function<Offender(const std::string& found, const std::string& expected)>& where, Meter& meter)
{
  const Model& model = *instance.model;
  const Material& material = (*instance.materials)[model.parts[model.partOf(hit.triangle)].material];
  Eigen::Vector3d albedo = material.diffuse;
  if (!model.colors.empty())
  {
    Eigen::Vector3d mixed(0, 0, 0);
    for (int i = 0; i < 3; ++i)
    {
      const std::array<std::uint8_t, 4>& corner = model.colors[model.triangles[hit.triangle][i]];
      mixed += weights[i] / 255 * Eigen::Vector3d(corner[0], corner[1], corner[2]);
    }
    albedo = albedo.cwiseProduct(mixed).eval();
  }
  std::vector<Eigen::Vector3d> texels{ { 1, 1, 1 } };
  if (material.texture >= 0 && !model.uvs.empty() && model.textures[material.texture].image)
  {
    Eigen::Vector2d uv(0, 0);
    for (int i = 0; i < 3; ++i)
    {
      uv += weights[i] * model.uvs[model.triangles[hit.triangle][i]];
    }
    const Texture& texture = model.textures[material.texture];
    const Image& image = *texture.image;
    const Eigen::Array2d place = uv.array() * Eigen::Array2d(image.width, image.height);
    texels.clear();
    for (const double x : { -texelSlack, texelSlack })
    {
      for (const double y : { -texelSlack, texelSlack })
      {
        texels.push_back(texelAt(texture, place + Eigen::Array2d(x, y)));
      }
    }
  }
  const Eigen::Vector3d found(color[0], color[1], color[2]);
  double least = infinite;
  Eigen::Vector3d nearest(0, 0, 0);
  for (const Eigen::Vector3d& texel : texels)
  {
    const Eigen::Vector3d expected = 255 * albedo.cwiseProduct(texel).cwiseMax(0).cwiseMin(1);
    const double error = (found - expected).cwiseAbs().maxCoeff();
    if (error < least)
    {
      least = error;
      nearest = expected;
    }
  }
  meter.add(least, [&] { return where(numbersText(found.data(), 3), numbersText(nearest.data(), 3)); });
}

} // namespace dgtk
