// SPDX-License-Identifier: BSD-3-Clause
// The records of layered depth images: of a surface with an edge at a pixel's centre either is right, of others not.
#include "dgtkHandMade.h"

#include "dgtkPortableMath.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <utility>

namespace
{
using namespace dgtk;
using test::HandMade;
using test::triangleModel;
using test::wallModel;

using Depths = std::vector<double>;
using Found = std::pair<std::uint64_t, std::uint64_t>; ///< bad and open pixels

template <typename Number>
void append(std::string& bytes, Number number)
{
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

/// What a row says of an image with these records.
Found foundAt(const std::vector<std::string>& models, const std::function<Depths(int x, int y)>& depthsAt,
  const std::string& layer = "surfaces")
{
  HandMade made(models);
  std::string bytes;
  append(bytes, std::int32_t(HandMade::width));
  append(bytes, std::int32_t(HandMade::height));
  for (int i = 0; i < HandMade::width * HandMade::height; ++i)
  {
    const Depths depths = depthsAt(i % HandMade::width, i / HandMade::width);
    append(bytes, std::uint32_t(depths.size()));
    for (const double depth : depths)
    {
      append(bytes, std::uint32_t(0xff808080));
      append(bytes, depth);
      append(bytes, std::uint32_t(0));
    }
  }
  made.file("a/ldi/000000.ldi", bytes);
  const Residual residual = made.verify("ldi", layer);
  EXPECT_EQ(residual.count + residual.skipped, 48u);
  return { residual.bad, residual.skipped };
}
/// Of column 4, and left and right of it.
Found found(const std::vector<std::string>& models, const Depths& left, const Depths& middle, const Depths& right,
  const std::string& layer = "surfaces")
{
  return foundAt(
    models, [&](int x, int) { return x < 4    ? left
                                     : x == 4 ? middle
                                              : right; }, layer);
}
Found found(const std::vector<std::string>& models, const Depths& all, const std::string& layer = "surfaces")
{
  return found(models, all, all, all, layer);
}

/// Between two vertical lines, in pixels from the centre of pixel (4, 2).
std::string between(double left, double right, double depth)
{
  const double a = left * depth / 100;
  const double b = right * depth / 100;
  return "v " + std::to_string(a) + " -90 " + std::to_string(depth) + "\nv " + std::to_string(b) + " -90 " +
         std::to_string(depth) + "\nv " + std::to_string(b) + " 90 " + std::to_string(depth) + "\nv " +
         std::to_string(a) + " 90 " + std::to_string(depth) + "\nf 1 2 3\nf 1 3 4\n";
}
} // namespace

TEST(CheckLdi, EverySurfaceHasItsRecord)
{
  const std::vector<std::string> walls{ wallModel(2), wallModel(3) };
  EXPECT_EQ(found(walls, { 2, 3 }), Found(0, 0));
  EXPECT_EQ(found(walls, { 2, 3 * (1 + 1e-10) }), Found(0, 0));
  EXPECT_EQ(found(walls, { 2, 3 * (1 + 1e-8) }), Found(48, 0));
  EXPECT_EQ(found(walls, { 2, 3 * (1 - 1e-8) }), Found(48, 0));
  EXPECT_EQ(found(walls, { 2 }), Found(48, 0));
  EXPECT_EQ(found(walls, { 3 }), Found(48, 0));
  EXPECT_EQ(found(walls, {}), Found(48, 0));
  EXPECT_EQ(found(walls, { 2, 3, 4 }), Found(48, 0));
  EXPECT_EQ(found(walls, { 2, 2, 3 }), Found(0, 48)) << "coincident ones may be two records";
  EXPECT_EQ(found(walls, { 2, 3 }, { 2 }, { 2, 3 }), Found(6, 0));
}

TEST(CheckLdi, RecordsAreNearToFar)
{
  const std::vector<std::string> walls{ wallModel(2), wallModel(3) };
  EXPECT_EQ(found(walls, { 2, 3 }, "order"), Found(0, 0));
  EXPECT_EQ(found(walls, { 2, 2 }, "order"), Found(0, 0));
  EXPECT_EQ(found(walls, { 3, 2 }, "order"), Found(48, 0));
  EXPECT_EQ(found(walls, { 2, 3 }, { 2, 5, 4 }, {}, "order"), Found(6, 0));
}

/// Something ends beside the centres of column 4, within the reach of an edge or not.
TEST(CheckLdi, WhatEndsAtACentreMayHaveARecord)
{
  for (const double side : { 1.0, -1.0 })
  {
    const auto scene = [&](double off) -> std::vector<std::string> {
      return { wallModel(2), between(side * off, 4.2, 3), wallModel(5) };
    };
    const Depths with{ 2, 3, 5 };
    const Depths without{ 2, 5 };
    EXPECT_EQ(found(scene(0.01), without, with, with), Found(0, side > 0 ? 6 : 0));
    EXPECT_EQ(found(scene(0.01), without, without, with), Found(0, side > 0 ? 0 : 6));
    EXPECT_EQ(found(scene(0.03), without, with, with), Found(side > 0 ? 6 : 0, 0));
    EXPECT_EQ(found(scene(0.03), without, without, with), Found(side > 0 ? 0 : 6, 0));
    // All rays meet the walls, and none anything else.
    for (const Depths& wrong :
      { Depths{}, { 2 }, { 5 }, { 3, 5 }, { 2, 3 }, { 2, 3, 4, 5 }, { 2, 4, 5 }, { 2, 3, 5 * (1 + 1e-8) } })
    {
      EXPECT_EQ(found(scene(0.01), without, wrong, with), Found(6, 0)) << wrong.size();
    }
  }
}

/// A surface that even one of the rays around misses may have no record; a direction each of the outermost rays.
TEST(CheckLdi, EdgesInAllDirections)
{
  for (int i = 0; i < 16; ++i)
  {
    for (const double off : { 0.0155, 0.0158 })
    {
      const Eigen::Vector2d out(std::cos(i * pi / 8), std::sin(i * pi / 8));
      const Eigen::Vector2d along(-out.y(), out.x());
      const auto corner = [](const Eigen::Vector2d& pixels)
      { return Eigen::Vector3d(pixels.x() / 100, pixels.y() / 100, 1); };
      const std::string small =
        triangleModel(corner(off * out + 0.4 * along), corner(off * out - 0.4 * along), corner(-0.4 * out));
      const auto found = foundAt({ wallModel(2), small }, [](int, int) { return Depths{ 2 }; });
      EXPECT_EQ(found, off < 1.0 / 64 ? Found(0, 1) : Found(1, 0)) << i;
    }
  }
}

/// Thinner than the reach: met by some of the rays around alone.
TEST(CheckLdi, SliversBesideACentre)
{
  for (const double at : { 0.003125, 0.00625, 0.009375, 0.0125, 0.015625 })
  {
    for (const double side : { 1.0, -1.0 })
    {
      const std::vector<std::string> scene{ wallModel(2), between(side * at - 1e-4, side * at + 1e-4, 3) };
      EXPECT_EQ(found(scene, { 2 }, { 2 }, { 2 }), Found(0, 0)) << at;
      EXPECT_EQ(found(scene, { 2 }, { 2, 3 }, { 2 }), Found(0, 6)) << at;
      EXPECT_EQ(found(scene, { 2, 3 }, { 2 }, { 2 }), Found(24, 0)) << at;
    }
  }
  const double outside = 1.2 / 64 * std::cos(pi / 8);
  EXPECT_EQ(found({ wallModel(2), between(outside - 1e-4, outside + 1e-4, 3) }, { 2 }, { 2, 3 }, { 2 }), Found(6, 0));
}
