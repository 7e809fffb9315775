// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCameraEntry.h"
#include "dgtkSyntheticScene.h"
#include "dgtkWarpSources.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace dgtk;
using namespace dgtk::test;

namespace
{
View lensAt(const std::string& model, const CameraParameters& of)
{
  View view = viewAt({ 0, 0, 0 });
  view.model = makeCamera(model, of);
  return view;
}

View fisheye(double scale = 30)
{
  Eigen::Matrix3d K = Eigen::Matrix3d::Identity();
  K(0, 0) = K(1, 1) = scale;
  K(0, 2) = 60;
  K(1, 2) = 60;
  return lensAt("fisheye", { 120, 120, K, { { "distortion", { 0, 0, 0, 0 } } } });
}

View panorama(int columns) { return lensAt("equirectangular", { columns, columns / 2, std::nullopt }); }

/// The inside of a ball around the camera, of the colours of directions.
std::array<std::uint8_t, 4> colourOf(const Eigen::Vector3d& direction)
{
  const auto channel = [](double v) { return std::uint8_t(std::lround(127 + 120 * v)); };
  const Eigen::Vector3d d = direction.normalized();
  return { channel(d.x()), channel(d.y()), channel(d.z()), 255 };
}

WarpSource ball(const View& view, double radius)
{
  return [view, radius](const std::function<void(int, int, const WarpSample&)>& visit)
  {
    for (int y = 0; y < view.model->height(); ++y)
    {
      for (int x = 0; x < view.model->width(); ++x)
      {
        const CameraRay ray = view.model->rayThrough({ x + 0.5, y + 0.5 });
        if (ray.exists())
        {
          visit(
            x, y, { colourOf(ray.direction), radius / ray.direction.norm(), splatIndex(1, -ray.direction, 0.1, 10) });
        }
      }
    }
  };
}

/// Largest difference from the colours of the directions; pixels without a ray are holes.
void expectBall(const WarpedImage& image, const View& view, int most)
{
  int worst = 0;
  for (int i = 0; i < image.width * image.height; ++i)
  {
    const CameraRay ray = view.model->rayThrough({ i % image.width + 0.5, i / image.width + 0.5 }); // NOLINT: its row
    ASSERT_EQ(image.holes[std::size_t(i)] == 0, ray.exists()) << i % image.width << ' ' << i / image.width;
    const auto expected = colourOf(ray.direction);
    for (int c = 0; c < 3 && ray.exists(); ++c)
    {
      worst = std::max(worst, std::abs(image.rgb[std::size_t(3 * i + c)] - expected[std::size_t(c)]));
    }
  }
  EXPECT_LE(worst, most);
}
} // namespace

TEST(WarpLenses, ALensThatIsAPinholeIsWarpedAsIt)
{
  View lens = viewAt({ 0, 0, 0 });
  lens.model = hideLinear(lens.model);
  const View there = viewAt({ 0.3, 0.1, 0.2 }, 0.05);
  const WarpedImage expected = warpLayeredDepth(both(patch(2), wall(5)), viewAt({ 0, 0, 0 }), there);
  const WarpedImage image = warpLayeredDepth(both(patch(2), wall(5)), lens, there);
  int differing = 0;
  for (std::size_t i = 0; i < image.rgb.size(); ++i)
  {
    differing += std::abs(image.rgb[i] - expected.rgb[i]) > 1 ? 1 : 0;
  }
  EXPECT_LE(differing, int(image.rgb.size() / 100)) << "edges of splats";
  EXPECT_NEAR(double(image.holeCount), double(expected.holeCount), 3);
}

/// What lies close behind a plane that runs away to the right and down shows as much where the camera turns about its
/// axis.
TEST(WarpLenses, ALensThatIsAPinholeSeesTheSameBehindASlantedPlane)
{
  const Eigen::Vector3d normal = Eigen::Vector3d(-0.8, -0.5, -1).normalized();
  const View from = viewAt({ 0, 0, 0 });
  const WarpSource plane = [&](const std::function<void(int, int, const WarpSample&)>& visit)
  {
    wall(5)(
      [&](int x, int y, const WarpSample&)
      {
        const Eigen::Vector3d ray = from.model->rayThrough({ x + 0.5, y + 0.5 }).direction;
        const double depth = normal.z() * 5 / normal.dot(ray);
        const std::uint32_t size = splatIndex(depth * ray.norm(), normal, 0.1, 1000);
        visit(x, y, { { 0, 0, 0, 255 }, depth, size });
        visit(x, y, { { 0, 0, 255, 255 }, depth + 0.02, size });
      });
  };
  View lens = from;
  lens.model = hideLinear(lens.model);
  for (const double roll : { 0.3, 0.7, 1.2, 1.9, 2.5 })
  {
    View there = viewAt({ 0.1, 0.05, 2 });
    const Eigen::Matrix3d R = Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    there.camera_from_world = { R, R * there.camera_from_world.translation };
    const auto behind = [&](const View& first)
    {
      const WarpedImage image = warpLayeredDepth(plane, first, there);
      return std::accumulate(image.rgb.begin(), image.rgb.end(), 0.0);
    };
    EXPECT_GT(behind(from), 1000) << roll;
    EXPECT_NEAR(behind(lens) / behind(from), 1, 0.05) << roll;
  }
}

TEST(WarpLenses, FromAFisheyeToAPinholeAndBack)
{
  const View wide = fisheye();
  const View narrow = viewAt({ 0, 0, 0 });
  expectBall(warpLayeredDepth(ball(wide, 3), wide, narrow), narrow, 6);
  const WarpedImage back = warpLayeredDepth(ball(narrow, 3), narrow, wide);
  EXPECT_GT(back.holeCount, std::uint64_t(10000)) << "all that the pinhole does not see";
  EXPECT_LT(back.holeCount, std::uint64_t(120 * 120 - 350));
}

TEST(WarpLenses, AllAroundToItself)
{
  const View wide = fisheye();
  expectBall(warpLayeredDepth(ball(wide, 3), wide, wide), wide, 3); // a pixel's step is 4
  const View round = panorama(60);
  expectBall(warpLayeredDepth(ball(round, 3), round, round), round, 12); // 12; normals are known coarsely
}

/// What is nearly beside the camera is far outside its picture, not large in it.
TEST(WarpLenses, FromAllAroundToLensesThatSeeForward)
{
  const View round = panorama(128);
  const WarpSource all = ball(round, 3);
  View flat = viewAt({ 0, 0, 0 });
  flat.near = 0.01;
  expectBall(warpLayeredDepth(all, round, flat), flat, 12);
  View bent = flat;
  bent.model =
    makeCamera("pinhole", { width, height, flat.model->linear()->K, { { "distortion", { 0.001, 0, 0, 0 } } } });
  ASSERT_FALSE(bent.model->linear());
  expectBall(warpLayeredDepth(all, round, bent), bent, 12);
}

TEST(WarpLenses, OfAllAroundAPixelMayFillAPicture)
{
  View narrow = viewAt({ 0, 0, 0 });
  Eigen::Matrix3d K = narrow.model->linear()->K;
  K(0, 0) = K(1, 1) = 3000;
  narrow.model = makePinhole(width, height, K);
  EXPECT_EQ(warpLayeredDepth(ball(panorama(60), 3), panorama(60), narrow).holeCount, 0u);
}

TEST(WarpLenses, PolesOfAPanoramaAreClosed)
{
  const View from = panorama(64);
  for (const double turn : { 0.3, 1.0, 1.5 })
  {
    for (const int columns : { 64, 128 })
    {
      View to = panorama(columns);
      to.camera_from_world.rotation =
        Eigen::AngleAxisd(turn, Eigen::Vector3d(1, 0.2, 0.5).normalized()).toRotationMatrix();
      std::vector<std::uint8_t> holes = warpLayeredDepth(ball(from, 3), from, to).holes;
      EXPECT_EQ(std::count(holes.begin(), holes.end(), 255), 0) << turn << ' ' << columns;
    }
  }
}

TEST(WarpLenses, TheEndOfAFisheyeIsNotSmeared)
{
  const View round = panorama(128);
  const View wide = fisheye(19); // 180 degrees are 59.7 pixels from the middle
  expectBall(warpLayeredDepth(ball(round, 3), round, wide), wide, 20);
}

TEST(WarpLenses, TheSeamOfAPanoramaIsClosed)
{
  // half a pixel: samples fall on it
  const View from = panorama(64);
  View to = panorama(128);
  to.camera_from_world.rotation = Eigen::AngleAxisd(EIGEN_PI / 64, Eigen::Vector3d::UnitY()).toRotationMatrix();
  EXPECT_EQ(warpLayeredDepth(ball(from, 3), from, to).holeCount, 0u);
}

TEST(WarpLenses, PixelsWithoutARayAreHoles)
{
  const View round = panorama(64);
  const View wide = fisheye(15); // 180 degrees are 47 pixels from the middle
  for (const std::uint8_t alpha : { 255, 128 })
  {
    const WarpSource all = [&](const std::function<void(int, int, const WarpSample&)>& visit)
    {
      ball(round, 3)(
        [&](int x, int y, WarpSample sample)
        {
          sample.rgba[3] = alpha;
          visit(x, y, sample);
        });
    };
    const WarpedImage image = warpLayeredDepth(all, round, wide);
    for (int i = 0; i < 120 * 120; ++i)
    {
      const double radius = std::hypot(i % 120 + 0.5 - 60, i / 120 + 0.5 - 60); // NOLINT: its row
      const int sum = image.rgb[std::size_t(3 * i)] + image.rgb[std::size_t(3 * i + 1)];
      ASSERT_TRUE(radius < 15 * EIGEN_PI || (image.holes[std::size_t(i)] == 255 && sum == 0)) << radius;
      ASSERT_TRUE(radius > 30 || (image.holes[std::size_t(i)] == 0 && sum > 0)) << radius;
    }
  }
}

TEST(WarpLenses, OfALensNearAndFarAreAlongTheRay)
{
  const View wide = fisheye();
  const WarpSource all = ball(wide, 3);
  const auto holes = [&](double near, double far)
  {
    View to = wide;
    to.near = near;
    to.far = far;
    return warpLayeredDepth(all, wide, to).holeCount;
  };
  const std::uint64_t pixels = 120 * 120;
  EXPECT_LT(holes(2, 4), pixels / 2);
  EXPECT_EQ(holes(0.1, 2), pixels);
  EXPECT_EQ(holes(4, 100), pixels);
}
