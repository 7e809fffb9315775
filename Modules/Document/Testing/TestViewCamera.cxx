// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkViewCamera.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace dgtk;

constexpr double width = 400;
constexpr double height = 300;
constexpr double tolerance = 1e-9; // world units, of a scene of a few units

const ViewKind kinds[] = { ViewKind::Front, ViewKind::Top, ViewKind::Side, ViewKind::Perspective };

/// Distance of a point from the ray through a pixel.
double distance(const ViewCamera& camera, double x, double y, const Eigen::Vector3d& point)
{
  const WorldRay ray = camera.ray(x, y, width, height);
  return ray.direction.cross(point - ray.origin).norm() / ray.direction.norm();
}

TEST(ViewCamera, ADraggedPointStaysUnderTheMouse)
{
  for (const ViewKind kind : kinds)
  {
    ViewCamera camera(kind);
    WorldBox box;
    box.add(Eigen::Vector3d(-2, 0, 1));
    box.add(Eigen::Vector3d(3, 4, 5));
    camera.frame(box, width / height);
    camera.orbit(25, 10);
    const WorldRay ray = camera.ray(120, 80, width, height);
    const Eigen::Vector3d point = ray.origin + 7.5 * ray.direction;
    EXPECT_LT(distance(camera, 170, 50, point + camera.motion(point, 50, -30, height)), tolerance) << int(kind);
  }
}

TEST(ViewCamera, PanningMovesTheSceneWithTheMouse)
{
  for (const ViewKind kind : kinds)
  {
    ViewCamera camera(kind);
    const Eigen::Vector3d focus = camera.focus();
    EXPECT_LT(distance(camera, width / 2, height / 2, focus), tolerance);
    camera.pan(40, -25, height);
    EXPECT_LT(distance(camera, width / 2 + 40, height / 2 - 25, focus), tolerance) << int(kind);
  }
}

TEST(ViewCamera, AFramedBoxIsInSight)
{
  WorldBox box;
  box.add(Eigen::Vector3d(10, -3, 2));
  box.add(Eigen::Vector3d(14, 9, 3));
  for (const UpAxis up : { UpAxis::Y, UpAxis::Z })
  {
    for (const ViewKind kind : kinds)
    {
      for (const double aspect : { 0.5, 1.0, 2.5 })
      {
        ViewCamera camera(kind, up);
        camera.frame(box, aspect);
        const Eigen::Vector3d forward = (camera.focus() - camera.eye()).normalized();
        const Eigen::Vector3d right = forward.cross(camera.up()).normalized();
        const Eigen::Vector3d upward = right.cross(forward);
        for (int corner = 0; corner < 8; ++corner)
        {
          const Eigen::Vector3d x = Eigen::Vector3d((corner & 1 ? box.max : box.min).x(),
                                      (corner & 2 ? box.max : box.min).y(), (corner & 4 ? box.max : box.min).z()) -
                                    camera.eye();
          const double depth = camera.parallel() ? (camera.focus() - camera.eye()).norm() : x.dot(forward);
          const double half = depth * std::tan(ViewCamera::angle() / 2 * M_PI / 180);
          EXPECT_GT(depth, 0);
          EXPECT_LT(std::abs(x.dot(upward)), half) << int(kind);
          EXPECT_LT(std::abs(x.dot(right)), half * aspect) << int(kind);
        }
      }
    }
  }
}

TEST(ViewCamera, OrbitingKeepsDistanceAndHorizon)
{
  ViewCamera camera(ViewKind::Perspective);
  const double arm = (camera.eye() - camera.focus()).norm();
  for (int i = 0; i < 100; ++i)
  {
    camera.orbit(13, i < 50 ? 9 : -9);
    EXPECT_NEAR((camera.eye() - camera.focus()).norm(), arm, tolerance);
    EXPECT_GT(std::abs((camera.focus() - camera.eye()).normalized().cross(camera.up()).norm()), 0.01);
  }
  ViewCamera front(ViewKind::Front);
  const Eigen::Vector3d eye = front.eye();
  front.orbit(30, 30);
  EXPECT_EQ(front.eye(), eye);
}

TEST(ViewCamera, LooksStraightDownAndUp)
{
  for (const UpAxis axis : { UpAxis::Y, UpAxis::Z })
  {
    const Eigen::Vector3d up = ViewCamera(ViewKind::Front, axis).up();
    for (const double sign : { 1.0, -1.0 })
    {
      const Eigen::Vector3d eye = 20 * sign * up;
      ViewCamera camera(ViewKind::Perspective, axis);
      EXPECT_TRUE(camera.look(eye, Eigen::Vector3d(0, 0, 0), -Eigen::Vector3d::UnitX()));
      EXPECT_EQ(camera.eye(), eye);
      const auto left = camera.pixel(-Eigen::Vector3d::UnitX(), width, height);
      ASSERT_TRUE(left.has_value());
      EXPECT_NEAR(left->x(), width / 2, tolerance);
      EXPECT_LT(left->y(), height / 2) << "the given direction is upwards";
      EXPECT_LT(distance(camera, width / 2, height / 2, Eigen::Vector3d(0, 0, 0)), tolerance);
      camera.zoom(1.5);
      camera.orbit(0, -sign * 5); // from 90 degrees; the steepest of the mouse is 89
      EXPECT_LT((camera.up() - up).norm(), tolerance);
      EXPECT_GT(camera.forward().dot(sign * -Eigen::Vector3d::UnitX()), 0) << "no turn about the up axis";
      EXPECT_NEAR(camera.pixel(-Eigen::Vector3d::UnitX(), width, height)->x(), width / 2, tolerance);
    }
  }
}

TEST(ViewCamera, LookingDownKeepsTheHeadingWithoutAnotherOne)
{
  ViewCamera camera(ViewKind::Perspective);
  camera.look(Eigen::Vector3d(0, 1, 10), Eigen::Vector3d(0, 0, 0));
  EXPECT_TRUE(camera.look(Eigen::Vector3d(0, 20, 0), Eigen::Vector3d(0, 0, 0)));
  EXPECT_LT((camera.up() + Eigen::Vector3d::UnitZ()).norm(), tolerance);
  EXPECT_FALSE(camera.look(Eigen::Vector3d(1, 2, 3), Eigen::Vector3d(1, 2, 3)));
  EXPECT_EQ(camera.eye(), Eigen::Vector3d(0, 20, 0));
}
} // namespace
