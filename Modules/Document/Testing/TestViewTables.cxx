// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkItemMotion.h"
#include "dgtkViewHandles.h"

#include "dgtkCameraModel.h"
#include "dgtkPortableMath.h"
#include "dgtkSyntheticScene.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{
using namespace dgtk;

constexpr double viewWidth = 640;
constexpr double viewHeight = 480;
constexpr double viewTolerance = 1e-9; // pixels, world units

/// What is drawn in a view, and of which handle.
struct Drawn
{
  Handle handle;
  bool closed = false;
  bool filled = false;
  std::vector<Eigen::Vector2d> points;
};

const Handle freely{};
const Handle alongX{ Handle::Kind::Axis, 0 };
const Handle alongY{ Handle::Kind::Axis, 1 };
const Handle alongZ{ Handle::Kind::Axis, 2 };

void expectShapes(const std::vector<HandleShape>& shapes, const std::vector<Drawn>& expected)
{
  ASSERT_EQ(shapes.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    EXPECT_TRUE(shapes[i].handle == expected[i].handle) << i;
    EXPECT_EQ(shapes[i].closed, expected[i].closed) << i;
    EXPECT_EQ(shapes[i].filled, expected[i].filled) << i;
    ASSERT_EQ(shapes[i].points.size(), expected[i].points.size()) << i;
    for (std::size_t k = 0; k < expected[i].points.size(); ++k)
    {
      EXPECT_LT((shapes[i].points[k] - expected[i].points[k]).norm(), viewTolerance) << i << ' ' << k;
    }
  }
}

/// In the front view the origin is in the middle, x goes to the right and y up, and an axis is 80 pixels long.
ViewHandles frontHandles(
  HandleMode mode, const ViewCamera& front, const Eigen::Matrix3d& axes = Eigen::Matrix3d::Identity())
{
  HandlePlace place;
  place.mode = mode;
  place.axes = axes;
  return { place, front, viewWidth, viewHeight };
}

/// Axes of which the third has this cosine with the direction to the eye of the front view, the second still up.
Eigen::Matrix3d tilted(double cosine)
{
  const double sine = std::sqrt(1 - cosine * cosine);
  Eigen::Matrix3d axes;
  axes.col(0) = Eigen::Vector3d(cosine, 0, -sine);
  axes.col(1) = Eigen::Vector3d(0, 1, 0);
  axes.col(2) = Eigen::Vector3d(sine, 0, cosine);
  return axes;
}

bool shows(const ViewHandles& handles, const Handle& handle)
{
  return std::any_of(
    handles.shapes().begin(), handles.shapes().end(), [&](const HandleShape& shape) { return shape.handle == handle; });
}

std::vector<Eigen::Vector2d> box(double x, double y, double reach)
{
  return { { x - reach, y - reach }, { x + reach, y - reach }, { x + reach, y + reach }, { x - reach, y + reach } };
}

TEST(ViewHandles, EveryPixelOfTheFrontView)
{
  const ViewCamera front(ViewKind::Front);
  const std::vector<Drawn> moves{
    { { Handle::Kind::Plane, 2 }, true, true,
      { { 342.4, 217.6 }, { 358.4, 217.6 }, { 358.4, 201.6 }, { 342.4, 201.6 } } },
    { alongX, false, false, { { 332, 240 }, { 387, 240 } } },
    { alongX, true, true, { { 387, 245 }, { 400, 240 }, { 387, 235 } } },
    { alongY, false, false, { { 320, 228 }, { 320, 173 } } },
    { alongY, true, true, { { 325, 173 }, { 320, 160 }, { 315, 173 } } },
    { freely, true, true, box(320, 240, 6) },
  };
  expectShapes(frontHandles(HandleMode::Move, front).shapes(), moves);
  const std::vector<Drawn> scales{
    { alongX, false, false, { { 332, 240 }, { 400, 240 } } },
    { alongX, true, true, box(400, 240, 5) },
    { alongY, false, false, { { 320, 228 }, { 320, 160 } } },
    { alongY, true, true, box(320, 160, 5) },
    { freely, true, true, box(320, 240, 6) },
  };
  expectShapes(frontHandles(HandleMode::Scale, front).shapes(), scales);
  std::vector<Drawn> rings{ { freely, true, false, {} }, { alongX, false, false, {} }, { alongY, false, false, {} },
    { alongZ, true, false, {} } };
  for (int i = 0; i < 96; ++i)
  {
    const double angle = i * 3.75 * pi / 180;
    rings[0].points.emplace_back(320 + 97.6 * std::cos(angle), 240 + 97.6 * std::sin(angle));
    rings[3].points.emplace_back(320 + 80 * std::sin(angle), 240 + 80 * std::cos(angle));
  }
  for (int i = 0; i <= 48; ++i)
  {
    const double angle = (i * 3.75 - 90) * pi / 180;
    rings[1].points.emplace_back(320, 240 + 80 * std::sin(angle));
    rings[2].points.emplace_back(320 + 80 * std::sin(angle), 240);
  }
  expectShapes(frontHandles(HandleMode::Rotate, front).shapes(), rings);
  EXPECT_TRUE(frontHandles(HandleMode::None, front).shapes().empty());
}

TEST(ViewHandles, WhatIsTooShortOrTooFlatIsNotShown)
{
  const ViewCamera front(ViewKind::Front);
  // An axis of less than a fifth of its length, a plane of less than a fifth of its cosine.
  for (const HandleMode mode : { HandleMode::Move, HandleMode::Scale })
  {
    EXPECT_TRUE(shows(frontHandles(mode, front, tilted(0.21)), alongX));
    EXPECT_FALSE(shows(frontHandles(mode, front, tilted(0.19)), alongX));
    EXPECT_TRUE(shows(frontHandles(mode, front, tilted(0.19)), alongZ));
    EXPECT_TRUE(shows(frontHandles(mode, front, tilted(0.19)), alongY));
  }
  EXPECT_TRUE(shows(frontHandles(HandleMode::Move, front, tilted(0.21)), { Handle::Kind::Plane, 2 }));
  EXPECT_FALSE(shows(frontHandles(HandleMode::Move, front, tilted(0.19)), { Handle::Kind::Plane, 2 }));
  EXPECT_TRUE(shows(frontHandles(HandleMode::Move, front, tilted(-0.21)), { Handle::Kind::Plane, 2 }));
  EXPECT_TRUE(shows(frontHandles(HandleMode::Move, front, tilted(0.19)), { Handle::Kind::Plane, 0 }));
  // A ring is drawn whole where it is seen nearly from the front.
  EXPECT_EQ(frontHandles(HandleMode::Rotate, front, tilted(0.991)).shapes()[3].points.size(), 96u);
  EXPECT_TRUE(frontHandles(HandleMode::Rotate, front, tilted(-0.991)).shapes()[3].closed);
  EXPECT_EQ(frontHandles(HandleMode::Rotate, front, tilted(0.989)).shapes()[3].points.size(), 49u);
  EXPECT_FALSE(frontHandles(HandleMode::Rotate, front, tilted(0.989)).shapes()[3].closed);
}

TEST(ViewHandles, HalfARingIsTheOneTowardsTheEye)
{
  const ViewCamera camera(ViewKind::Perspective);
  HandlePlace place;
  place.mode = HandleMode::Rotate;
  place.pivot = Eigen::Vector3d(0.5, -0.25, 1);
  place.axes = turn(Eigen::Vector3d(2, 1, 2) / 3, 40).matrix();
  const ViewHandles handles(place, camera, viewWidth, viewHeight);
  const double radius = 80 * camera.unit(place.pivot, viewHeight);
  const Eigen::Vector3d toEye = (camera.eye() - place.pivot).normalized();
  ASSERT_EQ(handles.shapes().size(), 4u);
  for (int axis = 0; axis < 3; ++axis)
  {
    const Eigen::Vector3d normal = place.axes.col(axis);
    const Eigen::Vector3d near = (toEye - toEye.dot(normal) * normal).normalized();
    const std::vector<Eigen::Vector2d>& points = handles.shapes()[std::size_t(axis) + 1].points;
    ASSERT_EQ(points.size(), 49u);
    EXPECT_LT((points[24] - *camera.pixel(place.pivot + radius * near, viewWidth, viewHeight)).norm(), viewTolerance);
    const Eigen::Vector3d side = radius * normal.cross(near);
    EXPECT_LT((points[0] - *camera.pixel(place.pivot - side, viewWidth, viewHeight)).norm(), viewTolerance);
    EXPECT_LT((points[48] - *camera.pixel(place.pivot + side, viewWidth, viewHeight)).norm(), viewTolerance);
  }
}

TEST(ViewHandles, AreHitWithinSevenPixels)
{
  const ViewCamera front(ViewKind::Front);
  struct Row
  {
    HandleMode mode;
    double x, y;
    std::optional<Handle> handle;
  };
  const Handle plane{ Handle::Kind::Plane, 2 };
  for (const Row& row : std::vector<Row>{
         { HandleMode::Move, 370, 246.9, alongX },
         { HandleMode::Move, 370, 233.1, alongX },
         { HandleMode::Move, 370, 247.1, {} },
         { HandleMode::Move, 406.9, 240, alongX },
         { HandleMode::Move, 407.1, 240, {} },
         { HandleMode::Move, 320, 153.1, alongY },
         { HandleMode::Move, 320, 152.9, {} },
         { HandleMode::Move, 350, 210, plane },
         { HandleMode::Move, 335.5, 209, plane }, // beside the edge that closes it
         { HandleMode::Move, 365.3, 205, plane },
         { HandleMode::Move, 365.5, 205, {} },
         { HandleMode::Move, 325, 245, freely },
         { HandleMode::Move, 313, 247, freely },
         { HandleMode::Move, 306, 240, {} },
         { HandleMode::Move, 329.5, 240, alongX }, // 2.5 from the line, 3.5 from the patch
         { HandleMode::Move, 328.5, 240, freely },
         { HandleMode::Scale, 404, 244, alongX },
         { HandleMode::Scale, 411.9, 240, alongX },
         { HandleMode::Scale, 412.1, 240, {} },
         { HandleMode::Scale, 320, 148.1, alongY },
         { HandleMode::Scale, 320, 147.9, {} },
         { HandleMode::Rotate, 320, 240, alongY }, // the later one lies above
         { HandleMode::Rotate, 320, 280, alongX },
         { HandleMode::Rotate, 280, 240, alongY },
         { HandleMode::Rotate, 320 + 60, 240 + 60, alongZ },
         { HandleMode::Rotate, 424.5, 238, freely },
         { HandleMode::Rotate, 424.8, 238, {} },
         { HandleMode::Rotate, 320 + 51, 240 + 51, {} },
       })
  {
    const std::optional<Handle> hit = frontHandles(row.mode, front).hit({ row.x, row.y });
    ASSERT_EQ(hit.has_value(), row.handle.has_value()) << row.x << ' ' << row.y;
    EXPECT_TRUE(hit == row.handle) << row.x << ' ' << row.y;
  }
}

/// Drags in the front view, in whose middle 80 pixels are `size` world units.
TEST(HandleDrag, EveryModeOfTheFrontView)
{
  const ViewCamera front(ViewKind::Front);
  const double size = 80 * front.unit(Eigen::Vector3d(0, 0, 0), viewHeight);
  const auto drag = [&](HandleMode mode, const Handle& handle)
  {
    HandlePlace place;
    place.mode = mode;
    return HandleDrag(place, handle, Eigen::Vector3d(0, 0, 0), front, viewWidth, viewHeight, { 360, 240 });
  };
  const auto expectVector = [](const Eigen::Vector3d& found, double x, double y, double z)
  { EXPECT_LT((found - Eigen::Vector3d(x, y, z)).norm(), viewTolerance) << found.transpose(); };
  expectVector(drag(HandleMode::Move, freely).motion({ 400, 220 }, 0).translation, size / 2, size / 4, 0);
  expectVector(drag(HandleMode::Move, alongX).motion({ 400, 220 }, 0).translation, size / 2, 0, 0);
  expectVector(drag(HandleMode::Move, alongY).motion({ 400, 220 }, 0).translation, 0, size / 4, 0);
  expectVector(
    drag(HandleMode::Move, { Handle::Kind::Plane, 2 }).motion({ 400, 220 }, 0).translation, size / 2, size / 4, 0);
  // Factors: by the share of the distance where the handle is grasped, by the way in lengths of a handle elsewhere.
  expectVector(drag(HandleMode::Scale, alongX).motion({ 400, 220 }, 0).factors, 2, 1, 1);
  expectVector(drag(HandleMode::Scale, alongX).motion({ 377, 220 }, 1).factors, 1.4, 1, 1);
  expectVector(drag(HandleMode::Scale, alongX).motion({ 320.2, 240 }, 0).factors, 0.01, 1, 1);
  expectVector(drag(HandleMode::Scale, alongX).motion({ 321, 240 }, 1).factors, 0.1, 1, 1);
  expectVector(drag(HandleMode::Scale, alongY).motion({ 400, 220 }, 0).factors, 1, 1.25, 1);
  HandleDrag constrained = drag(HandleMode::Scale, freely);
  expectVector(constrained.motion({ 400, 220 }, 0).factors, 1 + 60 / std::sqrt(2.0) / 80, 1 + 60 / std::sqrt(2.0) / 80,
    1 + 60 / std::sqrt(2.0) / 80);
  constrained.constrain(alongX);
  expectVector(constrained.motion({ 400, 220 }, 0).factors, 1.5, 1, 1);
  EXPECT_TRUE(constrained.handle() == alongX);
  constrained.constrain({ Handle::Kind::Plane, 1 });
  const double both = 1 + 60 / std::sqrt(2.0) / 80;
  expectVector(constrained.motion({ 400, 220 }, 0).factors, both, 1, both);
  // From below the pivot it is by the way, too: there is no share of a negative distance.
  HandlePlace place;
  place.mode = HandleMode::Scale;
  HandleDrag below(place, alongX, Eigen::Vector3d(0, 0, 0), front, viewWidth, viewHeight, { 300, 240 });
  expectVector(below.motion({ 340, 240 }, 0).factors, 1.5, 1, 1);
  // Rotations: about the direction to the eye, about an axis towards it, about one across.
  EXPECT_NEAR(drag(HandleMode::Rotate, freely).motion({ 320, 200 }, 0).degrees, 90, viewTolerance);
  EXPECT_EQ(drag(HandleMode::Rotate, freely).motion({ 320, 200 }, 0).axis, Eigen::Vector3d(0, 0, 1));
  EXPECT_NEAR(drag(HandleMode::Rotate, alongZ).motion({ 320, 280 }, 0).degrees, -90, viewTolerance);
  EXPECT_NEAR(drag(HandleMode::Rotate, alongX).motion({ 400, 280 }, 0).degrees, 90 / pi, viewTolerance);
  EXPECT_EQ(drag(HandleMode::Rotate, alongX).motion({ 400, 280 }, 0).axis, Eigen::Vector3d(1, 0, 0));
  EXPECT_NEAR(drag(HandleMode::Rotate, alongY).motion({ 400, 280 }, 0).degrees, 90 / pi, viewTolerance);
  EXPECT_EQ(drag(HandleMode::Rotate, alongX).motion({ 400, 280 }, 1).degrees, 30);
  for (const HandleMode mode : { HandleMode::Move, HandleMode::Rotate, HandleMode::Scale })
  {
    place.mode = mode;
    place.pivot = Eigen::Vector3d(1, 2, 3);
    place.axes = tilted(0.5);
    HandleDrag begun(place, alongX, place.pivot, front, viewWidth, viewHeight, { 360, 200 });
    const WorldMotion& motion = begun.motion({ 360, 200 }, 0);
    EXPECT_EQ(motion.mode, mode);
    EXPECT_EQ(motion.pivot, place.pivot);
    EXPECT_EQ(motion.axes, place.axes);
    EXPECT_EQ(motion.axis, place.axes.col(0));
    EXPECT_LT(motion.translation.norm() + std::abs(motion.degrees), viewTolerance);
    EXPECT_LT((motion.factors - Eigen::Vector3d(1, 1, 1)).norm(), viewTolerance);
  }
}

/// Handles are grasped at the pivot, things where they are: in a perspective both have depths of their own.
TEST(HandleDrag, ThingsFollowAtTheirOwnDepth)
{
  const ViewCamera camera(ViewKind::Perspective);
  const Eigen::Vector3d grasped(1, 0.5, 4);
  const auto at = [&](const Eigen::Vector3d& point) { return *camera.pixel(point, viewWidth, viewHeight); };
  HandlePlace place;
  place.mode = HandleMode::Move;
  place.pivot = Eigen::Vector3d(-1, 0, -3);
  for (const Handle& handle : { alongX, alongY, alongZ, Handle{ Handle::Kind::Plane, 0 },
         Handle{ Handle::Kind::Plane, 1 }, Handle{ Handle::Kind::Plane, 2 } })
  {
    Eigen::Vector3d way = 0.7 * Eigen::Vector3d::Unit(handle.axis);
    if (handle.kind == Handle::Kind::Plane)
    {
      way = Eigen::Vector3d(0.7, -0.4, 0.5) -
            Eigen::Vector3d(0.7, -0.4, 0.5).cwiseProduct(Eigen::Vector3d::Unit(handle.axis));
    }
    HandleDrag byHandle(place, handle, grasped, camera, viewWidth, viewHeight, at(place.pivot));
    EXPECT_LT((byHandle.motion(at(place.pivot + way), 0).translation - way).norm(), viewTolerance) << handle.axis;
    HandleDrag byThing(place, freely, grasped, camera, viewWidth, viewHeight, at(grasped));
    byThing.constrain(handle);
    EXPECT_LT((byThing.motion(at(grasped + way), 0).translation - way).norm(), viewTolerance) << handle.axis;
  }
  HandleDrag free(place, freely, grasped, camera, viewWidth, viewHeight, at(grasped));
  const Eigen::Vector2d to = at(grasped) + Eigen::Vector2d(30, -12);
  const Eigen::Vector3d translation = free.motion(to, 0).translation;
  EXPECT_LT((at(grasped + translation) - to).norm(), viewTolerance);
  EXPECT_NEAR(translation.dot(camera.forward()), 0, viewTolerance);
}

TEST(HandleDrag, StepsAreDecimalNumbers)
{
  const ViewCamera front(ViewKind::Front);
  HandlePlace place;
  place.mode = HandleMode::Move;
  HandleDrag drag(place, freely, Eigen::Vector3d(0, 0, 0), front, viewWidth, viewHeight, { 320, 240 });
  const double unit = front.unit(Eigen::Vector3d(0, 0, 0), viewHeight);
  for (const auto& [step, world, expected] : { std::tuple(0.1, 0.69, 0.7), std::tuple(0.1, 0.26, 0.3),
         std::tuple(0.5, 0.74, 0.5), std::tuple(0.5, 0.76, 1.0), std::tuple(2.0, 2.9, 2.0), std::tuple(2.0, 3.1, 4.0),
         std::tuple(0.3, 1.0, 0.3 * 3), std::tuple(1.0, -1.4, -1.0), std::tuple(0.02, 0.0691, 0.06) })
  {
    EXPECT_EQ(drag.motion({ 320 + world / unit, 240 }, step).translation, Eigen::Vector3d(expected, 0, 0)) << step;
  }
}

/// Eyes, horizons and sizes of all views in both worlds.
TEST(ViewCamera, BeginsWhereItsKindSays)
{
  const double oblique = 10 / std::sqrt(1 + 0.36 + 0.25);
  struct Row
  {
    ViewKind kind;
    UpAxis axis;
    Eigen::Vector3d eye, up;
  };
  for (const Row& row : std::vector<Row>{
         { ViewKind::Front, UpAxis::Y, { 0, 0, 10 }, { 0, 1, 0 } },
         { ViewKind::Top, UpAxis::Y, { 0, 10, 0 }, { 0, 0, -1 } },
         { ViewKind::Side, UpAxis::Y, { 10, 0, 0 }, { 0, 1, 0 } },
         { ViewKind::Perspective, UpAxis::Y, oblique * Eigen::Vector3d(0.5, 0.6, 1), { 0, 1, 0 } },
         { ViewKind::Front, UpAxis::Z, { 0, -10, 0 }, { 0, 0, 1 } },
         { ViewKind::Top, UpAxis::Z, { 0, 0, 10 }, { 0, 1, 0 } },
         { ViewKind::Side, UpAxis::Z, { 10, 0, 0 }, { 0, 0, 1 } },
         { ViewKind::Perspective, UpAxis::Z, oblique * Eigen::Vector3d(0.5, -1, 0.6), { 0, 0, 1 } },
       })
  {
    const ViewCamera camera(row.kind, row.axis);
    EXPECT_LT((camera.eye() - row.eye).norm(), viewTolerance) << int(row.kind);
    EXPECT_EQ(camera.up(), row.up) << int(row.kind);
    EXPECT_EQ(camera.focus(), Eigen::Vector3d(0, 0, 0));
    EXPECT_EQ(camera.kind(), row.kind);
    EXPECT_EQ(camera.parallel(), row.kind != ViewKind::Perspective);
    EXPECT_NEAR(camera.height(), 20 * std::tan(15 * pi / 180), viewTolerance);
    EXPECT_LT((camera.forward() + row.eye / 10).norm(), viewTolerance);
  }
  EXPECT_EQ(ViewCamera::angle(), 30);
}

TEST(ViewCamera, FramesWithAMarginOfEightHundredths)
{
  WorldBox box;
  box.add(Eigen::Vector3d(1, 2, 3));
  box.add(Eigen::Vector3d(5, 4, 9));
  const auto heightOf = [](ViewKind kind, const WorldBox& shown, double aspect)
  {
    ViewCamera camera(kind);
    camera.frame(shown, aspect);
    EXPECT_EQ(camera.focus(), shown.empty() ? Eigen::Vector3d(0, 0, 0) : shown.center());
    return camera.height();
  };
  EXPECT_NEAR(heightOf(ViewKind::Front, box, 4), 1.08 * 2, viewTolerance);
  EXPECT_NEAR(heightOf(ViewKind::Front, box, 0.5), 1.08 * 8, viewTolerance);
  EXPECT_NEAR(heightOf(ViewKind::Top, box, 4), 1.08 * 6, viewTolerance);
  EXPECT_NEAR(heightOf(ViewKind::Side, box, 1), 1.08 * 6, viewTolerance);
  const double sphere = 1.08 * std::sqrt(16 + 4 + 36.0) / std::cos(15 * pi / 180);
  EXPECT_NEAR(heightOf(ViewKind::Perspective, box, 2), sphere, viewTolerance);
  EXPECT_NEAR(heightOf(ViewKind::Perspective, box, 0.5), 2 * sphere, viewTolerance);
  EXPECT_NEAR(heightOf(ViewKind::Perspective, {}, 1), 10.8 / std::cos(15 * pi / 180), viewTolerance);
  EXPECT_NEAR(heightOf(ViewKind::Front, {}, 1), 10.8 / std::cos(15 * pi / 180), viewTolerance);
  WorldBox point;
  point.add(Eigen::Vector3d(1, 1, 1));
  EXPECT_NEAR(heightOf(ViewKind::Front, point, 1), 1.08e-3, 1e-12);
  EXPECT_NEAR(heightOf(ViewKind::Perspective, point, 1), 1.08e-3 / std::cos(15 * pi / 180), 1e-12);
}

TEST(ViewCamera, MotionsByNumbers)
{
  ViewCamera camera(ViewKind::Perspective);
  ASSERT_TRUE(camera.look({ 0, 0, 8 }, { 0, 0, 0 }));
  camera.zoom(2);
  EXPECT_LT((camera.eye() - Eigen::Vector3d(0, 0, 4)).norm(), viewTolerance);
  camera.zoom(1e9);
  EXPECT_LT((camera.eye() - Eigen::Vector3d(0, 0, 4)).norm(), viewTolerance) << "nothing is nearer than a millionth";
  camera.zoom(2e6);
  EXPECT_LT((camera.eye() - Eigen::Vector3d(0, 0, 2e-6)).norm(), 1e-15);
  camera.look({ 0, 0, 4 }, { 0, 0, 0 });
  camera.orbit(90, 0);
  EXPECT_LT((camera.eye() - Eigen::Vector3d(-4, 0, 0)).norm(), viewTolerance) << "the scene turns to the right";
  camera.orbit(0, 30);
  EXPECT_LT((camera.eye() - Eigen::Vector3d(-4 * std::cos(pi / 6), 2, 0)).norm(), viewTolerance);
  camera.orbit(0, 300);
  EXPECT_NEAR(camera.eye().y(), 4 * std::sin(89 * pi / 180), viewTolerance);
  camera.orbit(0, -300);
  EXPECT_NEAR(camera.eye().y(), -4 * std::sin(89 * pi / 180), viewTolerance);
  camera.look({ 0, 0, 4 }, { 0, 0, 0 });
  const double unit = 8 * std::tan(15 * pi / 180) / viewHeight;
  camera.pan(10, 5, viewHeight);
  EXPECT_LT((camera.focus() - Eigen::Vector3d(-10 * unit, 5 * unit, 0)).norm(), viewTolerance);
  EXPECT_LT((camera.eye() - Eigen::Vector3d(-10 * unit, 5 * unit, 4)).norm(), viewTolerance);
  camera.look({ 0, 0, 4 }, { 0, 0, 0 });
  EXPECT_NEAR(camera.unit({ 1, 2, 2 }, viewHeight), unit / 2, viewTolerance);
  EXPECT_LT(
    (camera.motion({ 1, 2, 2 }, 6, 4, viewHeight) - Eigen::Vector3d(3 * unit, -2 * unit, 0)).norm(), viewTolerance);
  EXPECT_EQ(camera.reach(8, viewHeight).constant, 0);
  EXPECT_NEAR(camera.reach(8, viewHeight).slope, 8 * unit / 4, viewTolerance);
  EXPECT_NEAR(ViewCamera(ViewKind::Front).reach(8, viewHeight).constant, 20 * unit, viewTolerance);
  EXPECT_EQ(ViewCamera(ViewKind::Front).reach(8, viewHeight).slope, 0);
  EXPECT_LT((camera.towardsEye({ 3, 0, 0 }) - Eigen::Vector3d(-0.6, 0, 0.8)).norm(), viewTolerance);
  EXPECT_LT((ViewCamera(ViewKind::Front).towardsEye({ 3, 0, 0 }) - Eigen::Vector3d(0, 0, 1)).norm(), viewTolerance);
  EXPECT_FALSE(camera.pixel({ 0, 0, 4 }, viewWidth, viewHeight).has_value());
  EXPECT_FALSE(ViewCamera(ViewKind::Front).look({ 0, 0, 3 }, { 0, 0, 0 }));
  EXPECT_FALSE(camera.look({ 0, 0, 1e-6 }, { 0, 0, 0 }));
  EXPECT_TRUE(camera.look({ 0, 0, 1.1e-6 }, { 0, 0, 0 }));
}

TEST(ViewCamera, SegmentsAreCutBeforeTheEye)
{
  ViewCamera camera(ViewKind::Perspective);
  camera.look({ 0, 0, 10 }, { 0, 0, 0 });
  const Eigen::Vector3d before(1, 0, 5); // the plane of the cut is at z = 9.9
  const Eigen::Vector3d behind(1, 2, 19.8);
  const Eigen::Vector3d cut(1, 2 * 4.9 / 14.8, 9.9);
  const auto expectSegment = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to, const Eigen::Vector3d& first,
                               const Eigen::Vector3d& last)
  {
    const auto segment = camera.segment(from, to, viewWidth, viewHeight);
    ASSERT_TRUE(segment.has_value());
    EXPECT_LT((segment->first - *camera.pixel(first, viewWidth, viewHeight)).norm(), 1e-6);
    EXPECT_LT((segment->second - *camera.pixel(last, viewWidth, viewHeight)).norm(), 1e-6);
  };
  expectSegment(before, behind, before, cut);
  expectSegment(behind, before, cut, before);
  expectSegment(before, { 0, 1, 0 }, before, { 0, 1, 0 });
  expectSegment(before, { 0, 1, 9.89 }, before, { 0, 1, 9.89 });
  expectSegment(before, { 1, 0, 9.95 }, before, { 1, 0, 9.9 });
  EXPECT_FALSE(camera.segment(behind, { 0, 0, 9.91 }, viewWidth, viewHeight).has_value());
  const ViewCamera front(ViewKind::Front);
  const auto all = front.segment(before, behind, viewWidth, viewHeight);
  ASSERT_TRUE(all.has_value());
  EXPECT_EQ(all->second, *front.pixel(behind, viewWidth, viewHeight));
}
} // namespace
