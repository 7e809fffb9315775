// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPortableMath.h"
#include "dgtkViewHandles.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace dgtk;

constexpr double handleWidth = 640;
constexpr double handleHeight = 480;
constexpr double handleTolerance = 1e-9; // world units, of a scene of a few units

using V = Eigen::Vector3d;
const Eigen::Vector3d pivot(1, 2, -0.5);

ViewCamera cameraOf(ViewKind kind)
{
  ViewCamera camera(kind);
  WorldBox box;
  box.add(Eigen::Vector3d(-3, -1, -2));
  box.add(Eigen::Vector3d(4, 5, 3));
  camera.frame(box, handleWidth / handleHeight);
  return camera;
}

HandlePlace placeOf(HandleMode mode)
{
  HandlePlace place;
  place.mode = mode;
  place.pivot = pivot;
  return place;
}

Eigen::Vector2d pixel(const ViewCamera& camera, const Eigen::Vector3d& point)
{
  return camera.pixel(point, handleWidth, handleHeight).value();
}

HandleDrag dragOf(HandleMode mode, const Handle& handle, const ViewCamera& camera, const Eigen::Vector3d& grasped)
{
  return HandleDrag(placeOf(mode), handle, pivot, camera, handleWidth, handleHeight, pixel(camera, grasped));
}

TEST(ViewCamera, PixelsAreThoseOfRays)
{
  for (const ViewKind kind : { ViewKind::Front, ViewKind::Top, ViewKind::Side, ViewKind::Perspective })
  {
    const ViewCamera camera = cameraOf(kind);
    const WorldRay ray = camera.ray(123.25, 301.5, handleWidth, handleHeight);
    EXPECT_LT((pixel(camera, ray.origin + 3.5 * ray.direction) - Eigen::Vector2d(123.25, 301.5)).norm(), 1e-9);
  }
}

TEST(ViewHandles, ArrowsAreHitWhereTheyAreDrawn)
{
  const ViewCamera camera = cameraOf(ViewKind::Perspective);
  const ViewHandles handles(placeOf(HandleMode::Move), camera, handleWidth, handleHeight);
  const double size = ViewHandles::length() * camera.unit(pivot, handleHeight);
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::optional<Handle> hit = handles.hit(pixel(camera, pivot + 0.7 * size * Eigen::Vector3d::Unit(axis)));
    ASSERT_TRUE(hit.has_value()) << axis;
    EXPECT_EQ(hit->kind, Handle::Kind::Axis);
    EXPECT_EQ(hit->axis, axis);
  }
  EXPECT_EQ(handles.hit(pixel(camera, pivot))->kind, Handle::Kind::Free);
  EXPECT_FALSE(handles.hit(pixel(camera, pivot) + Eigen::Vector2d(-200, 150)).has_value());
}

TEST(ViewHandles, AnAxisTowardsTheEyeIsNotShown)
{
  const ViewHandles handles(placeOf(HandleMode::Move), cameraOf(ViewKind::Front), handleWidth, handleHeight);
  for (const HandleShape& shape : handles.shapes())
  {
    EXPECT_FALSE(shape.handle == (Handle{ Handle::Kind::Axis, 2 }));
    EXPECT_FALSE(shape.handle == (Handle{ Handle::Kind::Plane, 0 }));
  }
}

TEST(ViewHandles, NothingBehindTheEye)
{
  HandlePlace place = placeOf(HandleMode::Rotate);
  const ViewCamera camera = cameraOf(ViewKind::Perspective);
  place.pivot = camera.eye() + 3 * (camera.eye() - camera.focus());
  EXPECT_TRUE(ViewHandles(place, camera, handleWidth, handleHeight).shapes().empty());
}

TEST(HandleDrag, TheGraspedPointOfAnArrowStaysUnderTheMouse)
{
  const ViewCamera camera = cameraOf(ViewKind::Perspective);
  for (int axis = 0; axis < 3; ++axis)
  {
    const Eigen::Vector3d along = Eigen::Vector3d::Unit(axis);
    HandleDrag drag = dragOf(HandleMode::Move, { Handle::Kind::Axis, axis }, camera, pivot + 0.6 * along);
    const WorldMotion& motion = drag.motion(pixel(camera, pivot + 1.85 * along), 0);
    EXPECT_LT((motion.translation - 1.25 * along).norm(), handleTolerance) << axis;
  }
}

TEST(HandleDrag, SquaresMoveInTheirPlane)
{
  const ViewCamera camera = cameraOf(ViewKind::Perspective);
  for (int normal = 0; normal < 3; ++normal)
  {
    const Eigen::Vector3d u = Eigen::Vector3d::Unit((normal + 1) % 3);
    const Eigen::Vector3d v = Eigen::Vector3d::Unit((normal + 2) % 3);
    HandleDrag drag = dragOf(HandleMode::Move, { Handle::Kind::Plane, normal }, camera, pivot + 0.3 * u + 0.3 * v);
    const WorldMotion& motion = drag.motion(pixel(camera, pivot + 0.8 * u - 0.1 * v), 0);
    EXPECT_LT((motion.translation - (0.5 * u - 0.4 * v)).norm(), handleTolerance) << normal;
  }
}

TEST(HandleDrag, StepsAreMultiplesInTheWorld)
{
  const ViewCamera camera = cameraOf(ViewKind::Perspective);
  HandleDrag drag = dragOf(HandleMode::Move, { Handle::Kind::Axis, 0 }, camera, pivot);
  EXPECT_EQ(
    drag.motion(pixel(camera, pivot + Eigen::Vector3d(0.33, 0, 0)), 0.1).translation, Eigen::Vector3d(0.3, 0, 0));
  EXPECT_EQ(
    drag.motion(pixel(camera, pivot + Eigen::Vector3d(-1.6, 0, 0)), 0.5).translation, Eigen::Vector3d(-1.5, 0, 0));
}

TEST(HandleDrag, RingsTurnByTheAngleAboutThePivot)
{
  for (const ViewKind kind : { ViewKind::Front, ViewKind::Perspective })
  {
    const ViewCamera camera = cameraOf(kind);
    const auto onRing = [&](double degrees)
    {
      const double angle = degrees * pi / 180;
      return pixel(camera, pivot + 0.8 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0));
    };
    HandleDrag drag(
      placeOf(HandleMode::Rotate), { Handle::Kind::Axis, 2 }, pivot, camera, handleWidth, handleHeight, onRing(30));
    EXPECT_NEAR(drag.motion(onRing(75), 0).degrees, 45, 1e-9);
    // Half a turn is not the end.
    for (int degrees = 75; degrees <= 430; degrees += 60)
    {
      drag.motion(onRing(degrees), 0);
    }
    EXPECT_NEAR(drag.motion(onRing(430), 0).degrees, 400, 1e-9);
    EXPECT_EQ(drag.motion(onRing(430), 1).degrees, 405);
    EXPECT_EQ(drag.motion(onRing(430), 1).axis, Eigen::Vector3d(0, 0, 1));
  }
}

TEST(HandleDrag, ARingSeenFromItsEdgeTurnsLikeAWheel)
{
  const ViewCamera camera = cameraOf(ViewKind::Front);
  const Eigen::Vector2d start = pixel(camera, pivot);
  HandleDrag drag(
    placeOf(HandleMode::Rotate), { Handle::Kind::Axis, 1 }, pivot, camera, handleWidth, handleHeight, start);
  // The way along the rim is the angle times the radius; the front goes to the right about +y.
  EXPECT_NEAR(drag.motion(start + Eigen::Vector2d(ViewHandles::length(), 13), 0).degrees, 180 / pi, 1e-9);
}

TEST(HandleDrag, ScalesByTheShareOfTheDistance)
{
  const ViewCamera camera = cameraOf(ViewKind::Perspective);
  const Eigen::Vector3d y = Eigen::Vector3d::UnitY();
  HandleDrag drag = dragOf(HandleMode::Scale, { Handle::Kind::Axis, 1 }, camera, pivot + 0.8 * y);
  EXPECT_LT(
    (drag.motion(pixel(camera, pivot + 1.4 * y), 0).factors - Eigen::Vector3d(1, 1.75, 1)).norm(), handleTolerance);
  EXPECT_EQ(drag.motion(pixel(camera, pivot + 1.42 * y), 1).factors, Eigen::Vector3d(1, 1.8, 1));
  // Never through 0.
  EXPECT_GT(drag.motion(pixel(camera, pivot - 2 * y), 0).factors.y(), 0);
  drag.constrain({});
  const Eigen::Vector2d start = pixel(camera, pivot + 0.8 * y);
  const double half = ViewHandles::length() / 2 / std::sqrt(2.0);
  EXPECT_LT((drag.motion(start + Eigen::Vector2d(half, -half), 0).factors - Eigen::Vector3d::Constant(1.5)).norm(),
    handleTolerance);
}

TEST(HandleDrag, AKeyKeepsAFreeMotionToAnAxis)
{
  const ViewCamera camera = cameraOf(ViewKind::Top);
  HandleDrag drag = dragOf(HandleMode::Move, {}, camera, pivot);
  const Eigen::Vector2d to = pixel(camera, pivot + Eigen::Vector3d(1.5, 0, 0.75));
  EXPECT_LT((drag.motion(to, 0).translation - Eigen::Vector3d(1.5, 0, 0.75)).norm(), handleTolerance);
  drag.constrain({ Handle::Kind::Axis, 0 });
  EXPECT_LT((drag.motion(to, 0).translation - Eigen::Vector3d(1.5, 0, 0)).norm(), handleTolerance);
  drag.constrain({ Handle::Kind::Axis, 1 }); // towards the eye: no motion belongs to the mouse
  EXPECT_EQ(drag.motion(to, 0).translation, Eigen::Vector3d(0, 0, 0));
  drag.constrain({ Handle::Kind::Plane, 0 }); // seen from its edge
  EXPECT_EQ(drag.motion(to, 0).translation, Eigen::Vector3d(0, 0, 0));
}

TEST(HandleDrag, AnAxisTowardsTheEyeGoesNowhere)
{
  const ViewCamera camera = cameraOf(ViewKind::Perspective);
  HandlePlace place = placeOf(HandleMode::Move);
  place.axes = Eigen::Quaterniond::FromTwoVectors(V::UnitZ(), camera.towardsEye(pivot)).toRotationMatrix();
  const Eigen::Vector2d start = pixel(camera, pivot);
  HandleDrag drag(place, {}, pivot, camera, handleWidth, handleHeight, start);
  drag.constrain({ Handle::Kind::Axis, 2 });
  EXPECT_EQ(drag.motion(start + Eigen::Vector2d(200, 0), 0).translation, V(0, 0, 0)) << "grasped along it";
}

/// As if the mouse had gone down where it did, on the other ring.
TEST(HandleDrag, AKeyTurnsAboutAnotherAxisFromTheBeginning)
{
  const ViewCamera camera = cameraOf(ViewKind::Perspective);
  const V grasped = pivot + V(0.5, 0.4, 0.3);
  const Eigen::Vector2d to = pixel(camera, pivot + V(-0.4, 0.5, 0.2));
  HandleDrag turned = dragOf(HandleMode::Rotate, { Handle::Kind::Axis, 0 }, camera, grasped);
  EXPECT_GT(std::abs(turned.motion(to, 0).degrees), 5);
  turned.constrain({ Handle::Kind::Axis, 2 });
  HandleDrag other = dragOf(HandleMode::Rotate, { Handle::Kind::Axis, 2 }, camera, grasped);
  EXPECT_NEAR(turned.motion(to, 0).degrees, other.motion(to, 0).degrees, 1e-9);
}
} // namespace
