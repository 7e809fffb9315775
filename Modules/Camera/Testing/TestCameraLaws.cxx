// SPDX-License-Identifier: BSD-3-Clause
// What holds for every model of the registry, whatever its parameters.
#include "dgtkRandomCameras.h"

#include "dgtkFinerCamera.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>

using namespace dgtk;

namespace
{
constexpr int cameras = 60; // of each model
constexpr int points = 200; // of each camera
constexpr double pixelTolerance = 1e-9;
/// Radians. A step of a pixel is a step of the ray at least 1 / (leastStretch * pixels a radian) as long.
constexpr double angleTolerance = 1e-9;

Eigen::Vector2d anyPixel(test::RandomCameras& random, const CameraModel& camera, double margin)
{
  return { random.between(-margin, 1 + margin) * camera.width(),
    random.between(-margin, 1 + margin) * camera.height() };
}

Eigen::Vector3d anyPoint(test::RandomCameras& random)
{
  return { random.between(-3, 3), random.between(-3, 3), random.between(-3, 3) };
}

bool throughOnePoint(const CameraModel& camera)
{
  for (const double part : { 0.31, 0.47, 0.62 })
  {
    if (!camera.rayThrough({ part * camera.width(), 0.55 * camera.height() }).origin.isZero(0))
    {
      return false;
    }
  }
  return true;
}

/// Angle at the ray's origin between the ray and a point.
double angleTo(const CameraRay& ray, const Eigen::Vector3d& x)
{
  const Eigen::Vector3d way = x - ray.origin;
  return std::atan2(way.cross(ray.direction).norm(), way.dot(ray.direction));
}

/// `body` of some cameras of each model; of what it counts, `least` of each camera are expected in the mean.
template <class Body>
void forCameras(int least, const Body& body)
{
  for (const CameraRow& row : cameraRows())
  {
    if (row.model == "strange") // of another test; it sees nothing
    {
      continue;
    }
    SCOPED_TRACE(row.model);
    test::RandomCameras random(17);
    int counted = 0;
    int made = 0;
    for (int i = 0; i < cameras; ++i)
    {
      const auto camera = random.make(row);
      if (camera && !testing::Test::HasFatalFailure())
      {
        ++made;
        body(random, *camera, counted);
      }
    }
    EXPECT_GT(made, cameras / 2) << "are refused together";
    EXPECT_GE(counted, least * made);
  }
}
} // namespace

TEST(CameraLaws, RaysOfCentralModelsStartAtTheCentre)
{
  forCameras(0,
    [](test::RandomCameras&, const CameraModel& camera, int&)
    {
      EXPECT_TRUE(!camera.isCentral() || throughOnePoint(camera));
      EXPECT_TRUE(camera.isCentral() || camera.linear() || camera.name() == "raytable");
    });
}

TEST(CameraLaws, APixelsRayIsProjectedToThePixel)
{
  forCameras(10,
    [](test::RandomCameras& random, const CameraModel& camera, int& counted)
    {
      for (int i = 0; i < points; ++i)
      {
        const Eigen::Vector2d pixel = anyPixel(random, camera, i % 4 == 0 ? 0.5 : 0);
        const CameraRay ray = camera.rayThrough(pixel);
        ASSERT_TRUE(ray.origin.allFinite() && ray.direction.allFinite());
        if (!ray.exists())
        {
          continue;
        }
        ++counted;
        ASSERT_NEAR(camera.linear() ? ray.direction.z() : ray.direction.norm(), 1, 1e-14);
        for (const double t : { 0.01, 1.0, 300.0 })
        {
          Eigen::Vector2d back(-1, -1);
          ASSERT_TRUE(camera.project(ray.origin + t * ray.direction, back)) << pixel.transpose();
          ASSERT_LE((back - pixel).norm(), pixelTolerance) << pixel.transpose();
        }
      }
    });
}

TEST(CameraLaws, APointIsOnTheRayOfItsPixel)
{
  forCameras(10,
    [](test::RandomCameras& random, const CameraModel& camera, int& counted)
    {
      for (int i = 0; i < points; ++i)
      {
        const Eigen::Vector3d x = anyPoint(random);
        Eigen::Vector2d pixel(-1, -2);
        if (!camera.project(x, pixel))
        {
          ASSERT_EQ(pixel, Eigen::Vector2d(-1, -2)) << "it is left";
          continue;
        }
        ++counted;
        ASSERT_TRUE(pixel.allFinite());
        const CameraRay ray = camera.rayThrough(pixel);
        ASSERT_TRUE(ray.exists()) << x.transpose();
        ASSERT_LE(angleTo(ray, x), angleTolerance) << x.transpose();
      }
    });
}

TEST(CameraLaws, TheLengthOfARayMeansNothing)
{
  forCameras(0,
    [](test::RandomCameras& random, const CameraModel& camera, int&)
    {
      for (int i = 0; throughOnePoint(camera) && i < points; ++i)
      {
        const Eigen::Vector3d x = anyPoint(random);
        Eigen::Vector2d near;
        Eigen::Vector2d far;
        ASSERT_EQ(camera.project(1e-3 * x, near), camera.project(1e4 * x, far));
      }
    });
}

TEST(CameraLaws, ManyAtOnceAreEachAlone)
{
  forCameras(0,
    [](test::RandomCameras& random, const CameraModel& camera, int&)
    {
      constexpr std::size_t count = 16;
      std::vector<Eigen::Vector2d> pixels(count);
      std::vector<Eigen::Vector3d> x(count);
      for (std::size_t i = 0; i < count; ++i)
      {
        pixels[i] = anyPixel(random, camera, 0.5);
        x[i] = anyPoint(random);
      }
      std::vector<CameraRay> rays(count);
      std::vector<Eigen::Vector2d> found(count, Eigen::Vector2d(-7, -7));
      std::vector<std::uint8_t> seen(count, 9);
      camera.raysThrough(pixels.data(), count, rays.data());
      camera.projectAll(x.data(), count, found.data(), seen.data());
      for (std::size_t i = 0; i < count; ++i)
      {
        const CameraRay ray = camera.rayThrough(pixels[i]);
        ASSERT_EQ(rays[i].origin, ray.origin);
        ASSERT_EQ(rays[i].direction, ray.direction);
        Eigen::Vector2d pixel(-7, -7);
        ASSERT_EQ(seen[i], camera.project(x[i], pixel) ? 1 : 0);
        ASSERT_EQ(found[i], pixel);
      }
    });
}

/// Each of its pixels, whose rays may be kept, and any other point.
TEST(CameraLaws, FinerImagesHaveTheSameRaysToTheBit)
{
  int finer = 0;
  forCameras(0,
    [&finer](test::RandomCameras& random, const CameraModel& camera, int&)
    {
      EXPECT_EQ(finerCamera(camera, 3), nullptr);
      EXPECT_EQ(finerCamera(camera, 1 << 20), nullptr);
      const auto fine = finerCamera(camera, 4);
      finer += fine ? 1 : 0;
      for (int i = 0; i < 20 && fine; ++i)
      {
        ASSERT_EQ(fine->width(), 4 * camera.width());
        Eigen::Vector2d pixel = anyPixel(random, *fine, 0.2);
        pixel = i % 2 == 0 ? Eigen::Vector2d(pixel.array().floor() + 0.5) : pixel;
        ASSERT_EQ(fine->rayThrough(pixel).direction, camera.rayThrough(pixel / 4).direction);
        const Eigen::Vector3d x = anyPoint(random);
        Eigen::Vector2d found(-8, -8);
        Eigen::Vector2d coarse(-2, -2);
        ASSERT_EQ(fine->project(x, found), camera.project(x, coarse));
        ASSERT_EQ(found, 4 * coarse);
      }
    });
  EXPECT_GT(finer, 3 * cameras);
}

TEST(CameraLaws, CamerasAreMadeAgainOfTheirParameters)
{
  forCameras(0,
    [](test::RandomCameras& random, const CameraModel& camera, int&)
    {
      const auto again = makeCamera(camera.name(), camera.parameters());
      for (int i = 0; i < 20; ++i)
      {
        const Eigen::Vector2d pixel = anyPixel(random, camera, 0.2);
        ASSERT_EQ(again->rayThrough(pixel).direction, camera.rayThrough(pixel).direction);
        ASSERT_EQ(again->rayThrough(pixel).origin, camera.rayThrough(pixel).origin);
      }
    });
}

TEST(CameraLaws, NothingIsSeenAtNoPlace)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  forCameras(0,
    [&](test::RandomCameras&, const CameraModel& camera, int&)
    {
      Eigen::Vector2d pixel(-1, -2);
      ASSERT_FALSE(camera.project({ 0.1, 0.2, nan }, pixel));
      if (throughOnePoint(camera))
      {
        ASSERT_FALSE(camera.project({ 0, 0, 0 }, pixel));
        ASSERT_EQ(pixel, Eigen::Vector2d(-1, -2));
      }
    });
}

/// Twice the size with twice the K is the same picture, finer.
TEST(CameraLaws, LargerImagesAreFiner)
{
  forCameras(0,
    [](test::RandomCameras& random, const CameraModel& camera, int&)
    {
      CameraParameters large = camera.parameters();
      large.width *= 2;
      large.height *= 2;
      if (large.K)
      {
        large.K->topRows<2>() *= 2;
      }
      const auto twice = makeCamera(camera.name(), large);
      for (int i = 0; i < 20; ++i)
      {
        const Eigen::Vector2d pixel = anyPixel(random, camera, 0);
        const CameraRay a = camera.rayThrough(pixel);
        const CameraRay b = twice->rayThrough(2 * pixel);
        ASSERT_EQ(a.exists(), b.exists());
        ASSERT_LE((a.direction - b.direction).norm() + (a.origin - b.origin).norm(), 1e-9);
      }
    });
}
