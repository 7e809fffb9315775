// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayeredDepth.h"
#include "dgtkSyntheticScene.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dgtk;
using namespace dgtk::test;

namespace
{
/// Three squares that face the camera at depths 4, 5 and 6, and what is peeled of them.
struct Squares
{
  Squares()
  {
    for (const double z : { 1.0, 0.0, -1.0 })
    {
      QuadOptions quad;
      quad.corner = { -9, -9, z };
      quad.sideU = { 18, 0, 0 };
      quad.sideV = { 0, 18, 0 };
      this->Builder.add(makeQuad(quad));
    }
    ViewOptions options;
    options.width = 4;
    options.height = 1;
    this->Seen = makeView(options);
    this->First = { this->hit(1), this->hit(1), this->hit(1), this->hit(1) };
    this->Hits = { this->First, { this->hit(2), this->hit(2), this->hit(2), this->hit(2) },
      { this->hit(3), this->hit(3), this->hit(3), this->hit(3) } };
    for (int rank = 0; rank < 3; ++rank)
    {
      this->Colors.emplace_back(16, 1.0f);
      for (int i = 0; i < 4; ++i)
      {
        this->Colors.back()[4 * i] = 0.25f * static_cast<float>(rank);
      }
    }
  }

  /// The triangle of square `object` that stands at the middle of every pixel of the row.
  Hit hit(std::uint32_t object) const { return { object, 0 }; }

  LayeredRows rows(const float* rgb = nullptr)
  {
    LayeredInput in;
    in.rect = { 0, 0, 4, 1 };
    in.first = this->First.data();
    in.rgb = rgb;
    std::vector<std::uint32_t> begins{ 0 };
    std::vector<Hit> hits;
    std::vector<float> rgba;
    for (std::size_t i = 0; i < 4; ++i)
    {
      for (std::size_t r = 0; r < this->Hits.size(); ++r)
      {
        if (this->Hits[r][i].object != 0)
        {
          hits.push_back(this->Hits[r][i]);
          rgba.insert(rgba.end(), &this->Colors[r][4 * i], &this->Colors[r][4 * i] + 4);
        }
      }
      begins.push_back(static_cast<std::uint32_t>(hits.size()));
    }
    in.begins = begins.data();
    in.hits = hits.data();
    in.rgba = rgba.data();
    LayeredRows out;
    layeredDepthRows(*this->Builder.state(), this->Seen, in, out);
    return out;
  }

  SceneBuilder Builder;
  View Seen;
  std::vector<Hit> First;
  std::vector<std::vector<Hit>> Hits;
  std::vector<std::vector<float>> Colors;
};
} // namespace

TEST(SplatIndex, PacksDistanceAndNormal)
{
  // dddddxxxyyy
  EXPECT_EQ(splatIndex(1, { 0, 0, -1 }, 1, 100), 0b00000'100'100u);
  EXPECT_EQ(splatIndex(100, { -1, 1, 0 }, 1, 100), 0b11111'000'111u);
  EXPECT_EQ(splatIndex(10.0001, { 0.3, -0.3, -0.9 }, 1, 100), 0b10000'101'010u);
  EXPECT_EQ(splatIndex(9.9999, { 0.3, -0.3, -0.9 }, 1, 100) >> 6, 15u);
  EXPECT_EQ(splatIndex(0.5, { 0, 0, -1 }, 1, 100) >> 6, 0u);
  EXPECT_EQ(splatIndex(1e9, { 0, 0, -1 }, 1, 100) >> 6, 31u);
}

TEST(SplatIndex, UnpacksWithinHalfAStep)
{
  for (int i = 0; i < 500; ++i)
  {
    const double a = 0.013 * i;
    const double tilt = 1.5 * std::sin(0.7 * i);
    const Eigen::Vector3d normal(std::sin(tilt) * std::cos(a), std::sin(tilt) * std::sin(a), -std::cos(tilt));
    const double distance = 0.5 * std::pow(2000.0, i / 500.0);
    const std::uint32_t index = splatIndex(distance, normal, 0.5, 1000);
    EXPECT_LT(index, 2048u);
    const Eigen::Vector3d read = splatNormal(index);
    EXPECT_NEAR(read.norm(), 1, 1e-12);
    EXPECT_LE(std::abs(read.x() - normal.x()), 0.1251 + 0.1); // 0.1: beyond the circle it is pulled back to it
    EXPECT_LE(std::abs(read.y() - normal.y()), 0.1251 + 0.1);
    EXPECT_LE(std::abs(std::log(splatDistance(index, 0.5, 1000) / distance)), std::log(2000.0) / 64 + 1e-12);
  }
}

TEST(LayeredDepth, GivesAllSurfacesWithExactDepthAndTheirOwnColour)
{
  const LayeredRows rows = Squares().rows();
  EXPECT_EQ(rows.counts, (std::vector<std::uint32_t>{ 3, 3, 3, 3 }));
  for (std::size_t i = 0; i < rows.surfaces.size(); ++i)
  {
    EXPECT_NEAR(rows.surfaces[i].depth, 4.0 + static_cast<double>(i % 3), 1e-12);
    EXPECT_EQ(rows.surfaces[i].hit.object, i % 3 + 1);
    EXPECT_FLOAT_EQ(rows.surfaces[i].rgba[0], 0.25f * static_cast<float>(i % 3));
  }
}

TEST(LayeredDepth, FirstSurfaceIsThatOfTheVisibilityBuffer)
{
  Squares squares;
  squares.First[0] = {};             // nothing there: no surface at all
  squares.First[1] = squares.hit(2); // settled: the nearer one is not there
  squares.Hits[0][2] = {};           // not peeled at all
  std::swap(squares.Hits[1][3], squares.Hits[2][3]);
  const LayeredRows rows = squares.rows();
  EXPECT_EQ(rows.counts, (std::vector<std::uint32_t>{ 0, 2, 3, 3 }));
  std::vector<std::uint32_t> objects;
  for (const LayeredSurface& surface : rows.surfaces)
  {
    objects.push_back(surface.hit.object);
  }
  EXPECT_EQ(objects, (std::vector<std::uint32_t>{ 2, 3, 1, 2, 3, 1, 2, 3 }));
}

TEST(LayeredDepth, FirstColourIsThePicturesWhereItIsOpaque)
{
  Squares squares;
  squares.Colors[0][4 * 1 + 3] = 0.5f;
  squares.Hits[1][2] = squares.Hits[0][2]; // peeled twice
  const std::vector<float> picture(12, 0.125f);
  const LayeredRows rows = squares.rows(picture.data());
  EXPECT_EQ(rows.counts, (std::vector<std::uint32_t>{ 3, 3, 2, 3 }));
  EXPECT_EQ(rows.surfaces[0].rgba, (std::array<float, 4>{ 0.125f, 0.125f, 0.125f, 1 }));
  EXPECT_EQ(rows.surfaces[1].rgba, (std::array<float, 4>{ 0.25f, 1, 1, 1 }));
  EXPECT_EQ(rows.surfaces[3].rgba, (std::array<float, 4>{ 0, 1, 1, 0.5f })); // its own shade
}

TEST(LayeredDepth, SurfacesThatDrawingCannotTellApartStayInOrder)
{
  Squares squares;
  QuadOptions quad;
  quad.corner = { -9, -9, 1 + 4e-6 }; // a millionth nearer than the first
  quad.sideU = { 18, 0, 0 };
  quad.sideV = { 0, 18, 0 };
  squares.Builder.add(makeQuad(quad));
  squares.Hits[2] = std::vector<Hit>(4, squares.hit(4));
  const LayeredRows rows = squares.rows();
  EXPECT_EQ(rows.counts, (std::vector<std::uint32_t>{ 3, 3, 3, 3 }));
  EXPECT_EQ(rows.surfaces[0].hit.object, 1u);
  EXPECT_EQ(rows.surfaces[1].hit.object, 4u);
  EXPECT_EQ(rows.surfaces[1].depth, rows.surfaces[0].depth);
}

TEST(LayeredDepth, NearAndFarCount)
{
  Squares squares;
  squares.Seen.far = 5.5;
  EXPECT_EQ(squares.rows().counts, (std::vector<std::uint32_t>{ 2, 2, 2, 2 }));
}
