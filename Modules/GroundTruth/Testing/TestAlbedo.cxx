// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAlbedo.h"

#include "dgtkSyntheticScene.h"

#include <gtest/gtest.h>

#include <limits>

using namespace dgtk;

namespace
{
using Color = std::array<std::uint8_t, 3>;

/// A square with a picture of 4 x 2 texels: red is 10 times the column from the left, green 100 times the row from the
/// top. Its first corner has the texture coordinates `at`, and so has all of it.
Instance pictured(const Eigen::Vector2d& at)
{
  const auto quad = test::makeQuad();
  auto image = std::make_shared<Image>();
  image->width = 4;
  image->height = 2;
  for (int i = 0; i < 8; ++i)
  {
    image->rgba.insert(image->rgba.end(), { std::uint8_t(10 * (i % 4)), std::uint8_t(100 * (i / 4)), 255, 255 });
  }
  quad->textures = { Texture{} };
  quad->textures[0].image = image;
  quad->materials[0].texture = 0;
  quad->materials[0].diffuse = { 1, 1, 1 };
  quad->uvs.assign(4, at);
  return test::SceneBuilder().add(quad).state()->instances[0];
}

Color at(const Instance& instance) { return albedoAt(instance, 0, { 0.25, 0.5 }); }
} // namespace

TEST(Albedo, HasTheTexelOfPicturesThatRepeat)
{
  EXPECT_EQ(at(pictured({ 0.1, 0.9 })), (Color{ 0, 0, 255 }));
  EXPECT_EQ(at(pictured({ 0.6, 0.9 })), (Color{ 20, 0, 255 }));
  EXPECT_EQ(at(pictured({ 0.6, 0.1 })), (Color{ 20, 100, 255 })) << "v is up";
  EXPECT_EQ(at(pictured({ 3.9, -0.9 })), (Color{ 30, 100, 255 }));
  EXPECT_EQ(at(pictured({ -0.1, -1.1 })), (Color{ 30, 0, 255 }));
  EXPECT_EQ(at(pictured({ -1.9, 2.6 })), (Color{ 0, 0, 255 }));
  EXPECT_EQ(at(pictured({ -2, 0 })), (Color{ 0, 100, 255 }));
  // white where there is no place in the picture
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(at(pictured({ nan, 0.5 })), (Color{ 255, 255, 255 }));
  EXPECT_EQ(at(pictured({ 0.5, std::numeric_limits<double>::infinity() })), (Color{ 255, 255, 255 }));
}

TEST(Albedo, IsThatOfTheObjectsOwnMaterials)
{
  Instance instance = pictured({ 0.6, 0.1 });
  instance.materials = nullptr;
  EXPECT_EQ(at(instance), (Color{ 20, 100, 255 }));
  auto own = std::make_shared<std::vector<Material>>(instance.model->materials);
  (*own)[0].diffuse = { 0.5, 0.25, 2 };
  instance.materials = own;
  EXPECT_EQ(at(instance), (Color{ 10, 25, 255 })) << "no more than white";
  (*own)[0].texture = -1;
  EXPECT_EQ(at(instance), (Color{ 128, 64, 255 })) << "127.5 and 63.75";
}
