// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkWarpSources.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dgtk;
using namespace dgtk::test;

namespace
{
/// The wall without what the patch hides.
WarpSource wallBehindPatch(double depth)
{
  return [depth](const std::function<void(int, int, const WarpSample&)>& visit)
  {
    wall(depth)(
      [&](int x, int y, const WarpSample& sample)
      {
        if (y < 10 || y >= 20 || x < 15 || x >= 25)
        {
          visit(x, y, sample);
        }
      });
  };
}
} // namespace

TEST(Warp, ToItsOwnCameraIsTheFirstLayer)
{
  const View view = viewAt({ 1, 2, 3 }, 0.3);
  const WarpedImage image = warpLayeredDepth(both(patch(2), wall(5)), view, view);
  EXPECT_EQ(image.holeCount, 0u);
  for (int y = 0; y < height; ++y)
  {
    for (int x = 0; x < width; ++x)
    {
      const bool inside = y >= 10 && y < 20 && x >= 15 && x < 25;
      ASSERT_EQ(image.rgb[(y * width + x) * 3], inside ? 200 : x);
      ASSERT_EQ(image.rgb[(y * width + x) * 3 + 1], inside ? 100 : y);
    }
  }
}

TEST(Warp, ToItsOwnCameraOfSkewedPixels)
{
  View view = viewAt({ 1, 2, 3 }, 0.3);
  Eigen::Matrix3d K = view.model->linear()->K;
  K(0, 1) = -40; // a step down is 0.8 of one to the side
  view.model = makePinhole(width, height, K);
  const WarpSource stripes = [](const std::function<void(int, int, const WarpSample&)>& visit)
  {
    wall(5)(
      [&](int x, int y, WarpSample sample)
      {
        sample.rgba = { std::uint8_t(x % 2 * 200), std::uint8_t(y % 2 * 200), 0, 255 };
        visit(x, y, sample);
      });
  };
  const WarpedImage image = warpLayeredDepth(stripes, view, view);
  EXPECT_EQ(image.holeCount, 0u);
  for (int i = 0; i < width * height; ++i)
  {
    ASSERT_EQ(image.rgb[3 * i], i % width % 2 * 200);
    ASSERT_EQ(image.rgb[3 * i + 1], i / width % 2 * 200);
  }
}

TEST(Warp, AStepAsideShiftsByFocalLengthOverDepth)
{
  // 5 units deep, 0.3 to the right: 3 pixels to the left; three columns at the right have no sample
  const WarpedImage image = warpLayeredDepth(wall(5), viewAt({ 0, 0, 0 }), viewAt({ 0.3, 0, 0 }));
  EXPECT_EQ(image.holeCount, 3u * height);
  for (int x = 0; x < width; ++x)
  {
    EXPECT_EQ(image.rgb[(12 * width + x) * 3], x < width - 3 ? x + 3 : 0) << x;
    EXPECT_EQ(image.holes[12 * width + x], x < width - 3 ? 0 : 255) << x;
  }
}

TEST(Warp, LayersFillWhatADepthMapLeavesOpen)
{
  // the patch moves by 10 pixels, the wall by 2
  const View from = viewAt({ 0, 0, 0 });
  const View to = viewAt({ 0.2, 0, 0 });
  const WarpedImage map = warpLayeredDepth(both(patch(1), wallBehindPatch(5)), from, to);
  const WarpedImage layers = warpLayeredDepth(both(patch(1), wall(5)), from, to);
  EXPECT_EQ(map.holeCount, 2u * height + 8u * 10);
  EXPECT_EQ(layers.holeCount, 2u * height);
  EXPECT_EQ(layers.rgb[(15 * width + 10) * 3], 200); // the patch stands before the wall
  EXPECT_EQ(layers.rgb[(15 * width + 20) * 3], 22);
}

TEST(Warp, OrderOfTheSamplesDoesNotDecideWhatIsInFront)
{
  const View from = viewAt({ 0, 0, 0 });
  const View to = viewAt({ 0.11, 0.05, 0.2 }, 0.05);
  EXPECT_EQ(
    warpLayeredDepth(both(patch(1), wall(5)), from, to).rgb, warpLayeredDepth(both(wall(5), patch(1)), from, to).rgb);
}

// A pixel of the wall is 0.1 wide and high; a twentieth of both is what a depth may be off, of either sample.
TEST(Warp, SamplesThatMayBeOneSurfaceAreMixed)
{
  const View view = viewAt({ 0, 0, 0 });
  const auto sample = [](std::uint8_t red, double depth) -> WarpSource
  {
    return [=](const std::function<void(int, int, const WarpSample&)>& visit) {
      visit(20, 15, { { red, 0, 0, 255 }, depth, facing });
    };
  };
  const std::pair<double, int> rows[] = { { 5.001, 150 }, { 5.015, 150 }, { 5.025, 100 }, { 5.1, 100 } };
  for (const auto& [depth, red] : rows)
  {
    for (const WarpSource& samples :
      { both(sample(100, 5), sample(200, depth)), both(sample(200, depth), sample(100, 5)) })
    {
      EXPECT_NEAR(warpLayeredDepth(samples, view, view).rgb[(15 * width + 20) * 3], red, 1) << depth;
    }
  }
}

TEST(Warp, SplatsGrowWithThePixel)
{
  // twice as near: each pixel becomes 2 x 2, nothing stays open
  EXPECT_EQ(warpLayeredDepth(wall(6), viewAt({ 0, 0, 0 }), viewAt({ 0, 0, 3 })).holeCount, 0u);
  EXPECT_EQ(warpLayeredDepth(wall(6), viewAt({ 0, 0, 0 }), viewAt({ 0, 0, 5.2 })).holeCount, 0u);
}

TEST(Warp, SplatsGrowWithTheLargerOfTwoFocalLengths)
{
  for (const int axis : { 0, 1 })
  {
    View to = viewAt({ 0, 0, 0 });
    Eigen::Matrix3d K = to.model->linear()->K;
    K(axis, axis) *= 10; // a pixel becomes 10 x 1
    to.model = makePinhole(width, height, K);
    EXPECT_EQ(warpLayeredDepth(wall(6), viewAt({ 0, 0, 0 }), to).holeCount, 0u) << axis;
  }
}

TEST(Warp, ASlantedPlaneStaysWhole)
{
  // A plane that runs away to the right, seen by a camera to which it turns its face: n.x = depth.
  for (const double slant : { 0.2, 0.5, 0.8, 1.1 })
  {
    const Eigen::Vector3d normal(-std::sin(slant), 0, -std::cos(slant));
    const View from = viewAt({ 0, 0, 0 });
    const WarpSource plane = [&](const std::function<void(int, int, const WarpSample&)>& visit)
    {
      for (int y = 0; y < height; ++y)
      {
        for (int x = 0; x < width; ++x)
        {
          const Eigen::Vector3d ray = from.model->rayThrough({ x + 0.5, y + 0.5 }).direction;
          const double depth = -5 * std::cos(slant) / normal.dot(ray);
          if (depth > 0 && depth < 100)
          {
            visit(x, y, { { 1, 2, 3, 255 }, depth, splatIndex(depth * ray.norm(), normal, 0.1, 1000) });
          }
        }
      }
    };
    // the camera goes round (0, 0, 5) towards the normal
    const double turn = slant / 2;
    const View to = viewAt({ -5 * std::sin(turn), 0, 5 - 5 * std::cos(turn) }, turn);
    const WarpedImage image = warpLayeredDepth(plane, from, to);
    std::uint64_t inside = 0;
    for (int y = 8; y < height - 8; ++y)
    {
      for (int x = 14; x < width - 14; ++x)
      {
        inside += image.holes[y * width + x] != 0;
      }
    }
    EXPECT_EQ(inside, 0u) << slant;
  }
}

TEST(Warp, GlassIsLaidOverWhatIsBehind)
{
  const View view = viewAt({ 0, 0, 0 });
  const WarpedImage image = warpLayeredDepth(both(patch(2, 51), wall(5)), view, view);
  EXPECT_EQ(image.rgb[(15 * width + 20) * 3], 56); // 20 + (200 - 20) / 5
  const WarpedImage alone = warpLayeredDepth(patch(2, 51), view, view);
  EXPECT_EQ(alone.holeCount, std::uint64_t(width * height - 100));
  EXPECT_EQ(alone.holes[15 * width + 20], 0);
  EXPECT_EQ(alone.holes[5 * width + 20], 255);
  EXPECT_EQ(alone.rgb[(15 * width + 20) * 3], 40);
}

TEST(Warp, PanesAreLaidFarToNear)
{
  // A second pane of another colour and opacity behind the first, whichever comes first in the file.
  const WarpSource far = [](const std::function<void(int, int, const WarpSample&)>& visit) {
    visit(20, 15, { { 40, 60, 240, 102 }, 3, facing });
  };
  const View view = viewAt({ 0, 0, 0 });
  for (const WarpSource& panes : { both(patch(2, 51), far), both(far, patch(2, 51)) })
  {
    const WarpedImage image = warpLayeredDepth(both(panes, wall(5)), view, view);
    const double behind[3] = { 20, 15, 9 };
    const double farther[3] = { 40, 60, 240 };
    const double nearer[3] = { 200, 100, 0 };
    for (int c = 0; c < 3; ++c)
    {
      const double middle = behind[c] + 0.4 * (farther[c] - behind[c]);
      EXPECT_EQ(image.rgb[(15 * width + 20) * 3 + c], std::lround(middle + 0.2 * (nearer[c] - middle))) << c;
    }
  }
}

namespace
{
/// A plane through (0, 0, 5) of one colour and an opacity of a half; farther by `behind` along the rays.
WarpSource veil(
  const Eigen::Vector3d& normal, double behind = 0, const std::array<std::uint8_t, 4>& rgba = { 200, 0, 0, 128 })
{
  return [=](const std::function<void(int, int, const WarpSample&)>& visit)
  {
    wall(5)(
      [&](int x, int y, const WarpSample&)
      {
        const Eigen::Vector3d ray((x + 0.5 - width / 2.0) / focal, (y + 0.5 - height / 2.0) / focal, 1);
        const double depth = 5 * normal.z() / normal.dot(ray);
        visit(x, y, { rgba, depth + behind, splatIndex(depth * ray.norm(), normal, 0.1, 1000) });
      });
  };
}

/// Pixels inside that a picture has in another red.
int others(const WarpedImage& image, int red)
{
  int count = 0;
  for (int y = 3; y < height - 3; ++y)
  {
    for (int x = 3; x < width - 3; ++x)
    {
      count += std::abs(image.rgb[(y * width + x) * 3] - red) > 1;
    }
  }
  return count;
}
} // namespace

TEST(Warp, AVeilIsLaidOnceHoweverItsNormalIsRounded)
{
  for (const Eigen::Vector3d& normal : { Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(0.01, -0.01, -1),
         Eigen::Vector3d(-0.26, 0.01, -1), Eigen::Vector3d(-0.5, 0.3, -1), Eigen::Vector3d(0.6, 0.6, -1) })
  {
    for (const double forward : { 0.1, 0.9, 1.7, 2.5, 3.1 })
    {
      const View to = viewAt({ 0.05, 0.03, forward });
      EXPECT_EQ(others(warpLayeredDepth(veil(normal.normalized()), viewAt({ 0, 0, 0 }), to), 100), 0)
        << normal.transpose() << ", " << forward;
    }
  }
}

TEST(Warp, SheetsThatOnePixelSeesAreTwoHoweverNear)
{
  const Eigen::Vector3d normal(0, 0, -1);
  for (const double apart : { 0.001, 0.01, 0.1, 1.0 })
  {
    const WarpSource sheets = both(veil(normal), veil(normal, apart));
    for (const double forward : { 0.0, 0.9, 2.5 })
    {
      const View to = viewAt({ 0, 0, forward });
      EXPECT_EQ(others(warpLayeredDepth(sheets, viewAt({ 0, 0, 0 }), to), 150), 0) << apart << ", " << forward;
    }
  }
}

// Whichever is in front: of samples of two pixels, in the order of their depths, those of one sheet may lie between
// those of the other.
TEST(Warp, CloseVeilsOfDifferentSlopesAreLaidOnceEach)
{
  const auto turned = [](double degrees)
  {
    const double angle = degrees * std::acos(-1.0) / 180;
    return Eigen::Vector3d(std::sin(angle), 0, -std::cos(angle));
  };
  for (const double behind : { 0.05, 0.2 })
  {
    const WarpSource sheets = both(veil(turned(40)), veil(turned(44), behind, { 0, 0, 200, 128 }));
    for (const Eigen::Vector3d& eye :
      { Eigen::Vector3d(0, 0, 0.9), Eigen::Vector3d(-0.4, 0, 1), Eigen::Vector3d(0.3, 0, 2) })
    {
      const WarpedImage image = warpLayeredDepth(sheets, viewAt({ 0, 0, 0 }), viewAt(eye));
      int wrong = 0;
      for (int i = 3 * width; i < (height - 3) * width; ++i)
      {
        const std::uint8_t* const rgb = image.rgb.data() + 3 * i;
        const int more = std::max(rgb[0], rgb[2]);
        wrong += more > 0 && (std::abs(more - 100) > 1 || std::abs(rgb[0] + rgb[2] - 150) > 2) ? 1 : 0;
      }
      EXPECT_LE(wrong, 6) << behind << ", " << eye.transpose();
    }
  }
}

// A tenth of a pixel's width and height, 0.1 each, is what a depth may be off, of either sample.
TEST(Warp, VeilsOfTwoPixelsAreOneWhereTheyMayBe)
{
  for (const auto& [depth, red] : { std::pair(5.02, 100), std::pair(4.98, 100), std::pair(5.06, 150) })
  {
    const WarpSource two = [depth = depth](const std::function<void(int, int, const WarpSample&)>& visit)
    {
      visit(20, 15, { { 200, 0, 0, 128 }, 5, facing });
      visit(21, 15, { { 200, 0, 0, 128 }, depth, facing });
    };
    const WarpedImage image = warpLayeredDepth(two, viewAt({ 0, 0, 0 }), viewAt({ 0.05, 0, 0 })); // half a pixel
    EXPECT_NEAR(image.rgb[(15 * width + 20) * 3], red, 1) << depth;
  }
}

TEST(Warp, OfAPaneTheSampleNearestToThePixelIsLaidOver)
{
  // A shift of 0.4 pixels: the sample of the pixel itself is 0.4 away, that of the next column 0.6.
  const WarpSource stripes = [](const std::function<void(int, int, const WarpSample&)>& visit)
  {
    wall(2, 51)(
      [&](int x, int y, WarpSample sample)
      {
        sample.rgba[0] = x % 2 == 0 ? 100 : 200;
        visit(x, y, sample);
      });
  };
  const WarpedImage image = warpLayeredDepth(stripes, viewAt({ 0, 0, 0 }), viewAt({ 0.016, 0, 0 }));
  for (int x = 0; x < width; ++x)
  {
    EXPECT_EQ(image.rgb[(15 * width + x) * 3], x % 2 == 0 ? 20 : 40) << x;
  }
}

TEST(Warp, WhatIsBehindTheCameraIsGone)
{
  EXPECT_EQ(
    warpLayeredDepth(wall(5), viewAt({ 0, 0, 0 }), viewAt({ 0, 0, 6 })).holeCount, std::uint64_t(width * height));
}
