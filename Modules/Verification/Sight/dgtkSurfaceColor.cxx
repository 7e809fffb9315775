// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSurfaceColor.h"

#include <algorithm>

namespace dgtk
{

namespace
{
/// Texels: as close to the border of two, either is right.
constexpr double texelSlack = 1e-6;
} // namespace

void meterColor(const Instance& instance, const Hit& hit, const Eigen::Vector3d& weights, const std::uint8_t* color,
  const std::function<Offender(const std::string& found, const std::string& expected)>& where, Meter& meter)
{
  const Model& model = *instance.model;
  const Material& material = (*instance.materials)[model.parts[model.partOf(hit.triangle)].material];
  Eigen::Vector3d expected = material.diffuse;
  if (!model.colors.empty())
  {
    Eigen::Vector3d mixed(0, 0, 0);
    for (int i = 0; i < 3; ++i)
    {
      const std::array<std::uint8_t, 4>& corner = model.colors[model.triangles[hit.triangle][i]];
      mixed += weights[i] / 255 * Eigen::Vector3d(corner[0], corner[1], corner[2]);
    }
    expected = expected.cwiseProduct(mixed).eval();
  }
  if (material.texture >= 0 && !model.uvs.empty() && model.textures[material.texture].image)
  {
    Eigen::Vector2d uv(0, 0);
    for (int i = 0; i < 3; ++i)
    {
      uv += weights[i] * model.uvs[model.triangles[hit.triangle][i]];
    }
    const Image& image = *model.textures[material.texture].image;
    const Eigen::Array2d size(image.width, image.height);
    const Eigen::Array2d texel = uv.array() * size;
    if (!((texel - texel.round()).abs() > texelSlack).all())
    {
      meter.skip();
      return;
    }
    const Eigen::Array2d cell = texel.floor() - (texel.floor() / size).floor() * size;
    const std::size_t row = std::size_t(image.height) - 1 - std::size_t(cell.y());
    const std::uint8_t* rgba = &image.rgba[(row * image.width + std::size_t(cell.x())) * 4];
    expected = expected.cwiseProduct(Eigen::Vector3d(rgba[0], rgba[1], rgba[2]) / 255);
  }
  const Eigen::Vector3d found(color[0], color[1], color[2]);
  for (int i = 0; i < 3; ++i)
  {
    expected[i] = 255 * std::clamp(expected[i], 0.0, 1.0);
  }
  meter.add((found - expected).cwiseAbs().maxCoeff(),
    [&] { return where(numbersText(found.data(), 3), numbersText(expected.data(), 3)); });
}

} // namespace dgtk
