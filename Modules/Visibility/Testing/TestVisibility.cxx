// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkPixelFilter.h"
#include "dgtkSyntheticScene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>

using dgtk::PixelRect;

TEST(TileGrid, UpToFourMegapixelsIsOneTile)
{
  for (const auto& [width, height] :
    { std::pair(1, 1), std::pair(640, 480), std::pair(2048, 2048), std::pair(4096, 1024), std::pair(1024, 4096) })
  {
    const dgtk::TileGrid grid(width, height);
    EXPECT_EQ(grid.columns() * grid.rows(), 1);
    EXPECT_EQ(grid.tile(0, 0), (PixelRect{ 0, 0, width, height }));
  }
}

TEST(TileGrid, LargerImagesAreCutAtFixedPlaces)
{
  const dgtk::TileGrid wide(4097, 100); // too long a side
  EXPECT_EQ(wide.columns(), 3);
  EXPECT_EQ(wide.rows(), 1);
  EXPECT_EQ(wide.tile(2, 0), (PixelRect{ 4096, 0, 1, 100 }));
  const dgtk::TileGrid large(2049, 2048); // too many pixels
  EXPECT_EQ(large.columns(), 2);
  EXPECT_EQ(large.rows(), 4);
  EXPECT_EQ(large.tile(0, 1), (PixelRect{ 0, 512, 2048, 512 }));
}

TEST(TileGrid, CoversEveryPixelOnce)
{
  const dgtk::TileGrid grid(5000, 3001);
  long pixels = 0;
  for (int row = 0; row < grid.rows(); ++row)
  {
    for (int column = 0; column < grid.columns(); ++column)
    {
      const PixelRect tile = grid.tile(column, row);
      EXPECT_EQ(tile.x, column * 2048);
      EXPECT_EQ(tile.y, row * 512);
      EXPECT_GT(tile.width, 0);
      EXPECT_GT(tile.height, 0);
      pixels += long(tile.width) * tile.height;
    }
  }
  EXPECT_EQ(pixels, 5000L * 3001);
}

TEST(TileGrid, RefusesSizesAndTilesThatAreNot)
{
  EXPECT_THROW(dgtk::TileGrid(0, 5), dgtk::UsageError);
  EXPECT_THROW(dgtk::TileGrid(5, (1 << 20) + 1), dgtk::UsageError);
  EXPECT_NO_THROW(dgtk::TileGrid(1 << 20, 1 << 20));
  try
  {
    dgtk::TileGrid(5000, 3000).tile(3, 0);
    FAIL();
  }
  catch (const dgtk::UsageError& error)
  {
    EXPECT_STREQ(error.what(), "no tile 3, 0 in a grid of 3 x 6");
  }
}

TEST(TriangleInWorld, AppliesThePlacement)
{
  const auto state = dgtk::test::SceneBuilder()
                       .add(dgtk::test::makeQuad())
                       .add(dgtk::test::makeQuad(), dgtk::test::placement({ 10, 20, 30 }, 2))
                       .state();
  Eigen::Vector3d corners[3];
  dgtk::triangleInWorld(*state, { 2, 1 }, corners);
  EXPECT_EQ(corners[0], Eigen::Vector3d(8, 18, 30));
  EXPECT_EQ(corners[1], Eigen::Vector3d(12, 22, 30));
  EXPECT_EQ(corners[2], Eigen::Vector3d(8, 22, 30));
}

namespace
{
/// A quad whose picture of 4 x 2 texels is opaque but for the upper left texel and the one right of it with alpha 127.
std::shared_ptr<dgtk::SceneState> quadWithHoles()
{
  auto model = dgtk::test::makeQuad();
  auto image = std::make_shared<dgtk::Image>();
  image->width = 4;
  image->height = 2;
  image->hasAlpha = true;
  image->rgba.assign(32, 255);
  image->rgba[3] = 0;
  image->rgba[7] = 127;
  image->rgba[11] = 128;
  model->textures.resize(1);
  model->textures[0].image = image;
  model->materials[0].texture = 0;
  model->materials[0].cutOut = true;
  return dgtk::test::SceneBuilder().add(model).state();
}

/// isCutOut at texture coordinates of triangle 0, whose corners have (0, 0), (1, 0), (1, 1).
bool cutOutAt(const dgtk::SceneState& state, double u, double v)
{
  return dgtk::isCutOut(state.instances[0], 0, { u - v, v });
}
} // namespace

TEST(IsCutOut, CountsRowsFromTheBottomAndRepeats)
{
  const auto state = quadWithHoles();
  for (const double turns : { 0.0, 1.0, -3.0 })
  {
    EXPECT_TRUE(cutOutAt(*state, turns + 0.125, 0.75));
    EXPECT_TRUE(cutOutAt(*state, turns + 0.25, 0.5));    // a texel owns its left and lower border
    EXPECT_FALSE(cutOutAt(*state, turns + 0.5, 0.75));   // alpha 128 is there
    EXPECT_FALSE(cutOutAt(*state, turns + 0.125, 0.25)); // lower row
    EXPECT_FALSE(cutOutAt(*state, turns + 0.125, 1.25));
    EXPECT_TRUE(cutOutAt(*state, turns + 0.125, -0.25));
  }
  EXPECT_FALSE(cutOutAt(*state, std::nan(""), 0.25));
}

TEST(IsCutOut, OnlyMaterialsThatSayIt)
{
  auto state = quadWithHoles();
  auto materials = std::make_shared<std::vector<dgtk::Material>>(*state->instances[0].materials);
  (*materials)[0].cutOut = false;
  state->instances[0].materials = materials;
  EXPECT_FALSE(cutOutAt(*state, 0.125, 0.75));
}

/// Mitchell and Netravali 1988 with B = C = 1/3, times 18; Gauss's curve of standard deviation 1/2; Duchon 1979.
TEST(PixelFilter, HasItsShape)
{
  const auto mitchell = [](double x)
  { return x < 1 ? 21 * x * x * x - 36 * x * x + 16 : -7 * x * x * x + 36 * x * x - 60 * x + 32; };
  const auto gaussian = [](double x) { return std::exp(-2 * x * x) - std::exp(-4.5); };
  const auto lanczos = [](double x)
  { return x == 0 ? 1 : 3 * std::sin(M_PI * x) * std::sin(M_PI * x / 3) / (M_PI * M_PI * x * x); };
  struct
  {
    const char* name;
    double radius;
    std::function<double(double)> at;
  } const shapes[] = { { "box", 0.5, [](double) { return 1; } }, { "triangle", 1, [](double x) { return 1 - x; } },
    { "gaussian", 1.5, gaussian }, { "mitchell", 2, mitchell }, { "lanczos", 3, lanczos } };
  for (const auto& shape : shapes)
  {
    for (const int samples : { 1, 2, 3, 5 })
    {
      int margin = 0;
      const auto weights = dgtk::pixelFilterWeights(dgtk::pixelFilterFromName(shape.name), samples, margin);
      ASSERT_EQ(weights.size(), std::size_t((2 * margin + 1) * samples));
      const std::size_t middle = weights.size() / 2;
      for (std::size_t i = 0; i < weights.size(); ++i)
      {
        const double x = std::abs((double(i) + 0.5) / samples - margin - 0.5);
        const double centre = std::abs((double(middle) + 0.5) / samples - margin - 0.5);
        const double expected = x < shape.radius ? shape.at(x) / shape.at(centre) : 0;
        EXPECT_NEAR(weights[i] / weights[middle], expected, 1e-12) << shape.name << ' ' << samples << ' ' << i;
      }
      EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), 1, 1e-12);
    }
  }
}
