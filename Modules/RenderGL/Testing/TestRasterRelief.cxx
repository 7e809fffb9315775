// SPDX-License-Identifier: BSD-3-Clause
// Normal and bump maps of both renderers: the back of a sheet shows its front's relief from below, as glTF says.
#include "dgtkTestScene.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace dgtk;
using namespace dgtk::test;

namespace
{
constexpr int columns = 8;
constexpr int rise = 25; ///< of 255, from a texel of heights to the next

/// A square of side 2 in the plane z = 0, facing +z.
std::shared_ptr<const Model> sheet(int Material::*map, const std::vector<std::array<int, 3>>& texels)
{
  auto image = std::make_shared<Image>();
  image->width = columns;
  image->height = 1;
  for (const auto& [red, green, blue] : texels)
  {
    for (const int value : { red, green, blue, 255 })
    {
      image->rgba.push_back(std::uint8_t(value));
    }
  }
  ModelBuilder model;
  Material& material = model.part(matte({ 1, 1, 1 }));
  material.*map = model.texture(image);
  material.bumpScale = 1;
  model.quad({ -1, -1, 0 }, { 1, -1, 0 }, { 1, 1, 0 }, { -1, 1, 0 });
  return model.finish();
}

/// Its front has the normal `tilt`, which is mirrored with it.
void expectRelief(const std::shared_ptr<const Model>& model, const Eigen::Vector3d& tilt, double tolerance)
{
  for (const char* renderer : { "ray", "vtk" })
  {
    usePictures(renderer);
    for (const double side : { 1.0, -1.0 })
    {
      const View view = viewOf(makeOrthographic(64, 48, 2, 0), { 0, 0, 10 * side }, { 0, 0, 0 }, 0.1, 100);
      for (const Eigen::Vector3d& scale : { Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(-1, 1, 1),
             Eigen::Vector3d(1, -1, 1), Eigen::Vector3d(-1, -1, 1), Eigen::Vector3d(1, 1, -1) })
      {
        const auto state = stateOf({ model });
        state->instances[0].world_from_object.linear = scale.asDiagonal();
        LightState light;
        light.kind = LightKind::Directional;
        light.position = { 2, 1, 3 * side };
        state->lights = { light };
        const Eigen::Vector3d front = scale.cwiseProduct(tilt).normalized();
        const double cosine = front.dot(light.position.normalized()) * (front.z() * side > 0 ? 1 : -1);
        EXPECT_NEAR(colorAt(renderColor(state, view), 32, 24).x(), std::max(0.0, cosine), tolerance)
          << renderer << " from " << side << ", scaled by " << scale.transpose();
      }
    }
  }
  usePictures("vtk");
}
} // namespace

TEST(Relief, OfNormalMaps)
{
  const std::vector<std::array<int, 3>> texels(columns, { 128 + 60, 128 + 30, 128 + 107 });
  expectRelief(sheet(&Material::normalMap, texels), { 60, 30, 107 }, 2e-5);
}

TEST(Relief, OfHeights)
{
  std::vector<std::array<int, 3>> texels;
  for (int i = 0; i < columns; ++i)
  {
    texels.push_back({ rise * i, rise * i, rise * i });
  }
  expectRelief(sheet(&Material::bumpMap, texels), { -rise / 255.0 * columns / 2, 0, 1 }, 1e-4);
}
