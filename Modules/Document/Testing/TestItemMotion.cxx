// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkItemMotion.h"

#include "dgtkCameraModel.h"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

namespace
{
using namespace dgtk;

constexpr double motionTolerance = 1e-12; // scene units and entries of matrices

const SceneItem firstMoved{ SceneItem::Kind::Object, 0 };
const SceneItem secondMoved{ SceneItem::Kind::Object, 1 };
const SceneItem camera{ SceneItem::Kind::Camera, 0 };
const SceneItem light{ SceneItem::Kind::Light, 0 };

/// A child in a parent that is turned, mirrored and evenly scaled; a camera; a spot.
SceneDescription family()
{
  SceneDescription scene;
  scene.objects.resize(2);
  scene.objects[0].name = "parent";
  scene.objects[0].position = Eigen::Vector3d(1, 2, 3);
  scene.objects[0].orientation = turn(Eigen::Vector3d(0, 0.6, 0.8), 70);
  scene.objects[0].scale = Eigen::Vector3d(-2, 2, 2);
  scene.objects[1].name = "child";
  scene.objects[1].parent = "parent";
  scene.objects[1].position = Eigen::Vector3d(0.5, -1, 2);
  scene.objects[1].orientation = turn(Eigen::Vector3d(1, 0, 0), 20);
  scene.objects[1].scale = Eigen::Vector3d(1, 2, 3);
  scene.cameras.resize(1);
  scene.cameras[0].name = "eye";
  scene.cameras[0].eye = Eigen::Vector3d(3, 1, 5);
  scene.cameras[0].lookAt = Eigen::Vector3d(0, 1, 0);
  scene.lights.resize(1);
  scene.lights[0].name = "spot";
  scene.lights[0].kind = LightKind::Spot;
  scene.lights[0].position = Eigen::Vector3d(0, 4, 0);
  scene.lights[0].target = Eigen::Vector3d(1, 0, 0);
  return scene;
}

ScenePlaces placesOf(const SceneDescription& scene, int frame = 0) { return placeScene(scene, ModelLibrary(), frame); }

Affine3 worldOf(const SceneDescription& scene, std::size_t object)
{
  return placesOf(scene).objects[object].instance.world_from_object;
}

WorldMotion rotation(const ItemMotion& items, const Eigen::Vector3d& axis, double degrees)
{
  WorldMotion motion;
  motion.mode = HandleMode::Rotate;
  motion.pivot = items.pivot();
  motion.axis = axis;
  motion.degrees = degrees;
  return motion;
}

TEST(ItemMotion, ChildrenGoAndTurnInTheWorld)
{
  SceneDescription scene = family();
  const Affine3 before = worldOf(scene, 1);
  WorldMotion move;
  move.mode = HandleMode::Move;
  move.translation = Eigen::Vector3d(0.25, -3, 1);
  ItemMotion(scene, placesOf(scene), { secondMoved }, 0).apply(scene, move);
  EXPECT_LT((worldOf(scene, 1).translation - before.translation - move.translation).norm(), motionTolerance);
  EXPECT_EQ(worldOf(scene, 1).linear, before.linear);

  scene = family();
  const ItemMotion items(scene, placesOf(scene), { secondMoved }, 0);
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, -2) / 3;
  items.apply(scene, rotation(items, axis, 50));
  EXPECT_LT((worldOf(scene, 1).linear - turn(axis, 50).matrix() * before.linear).norm(), motionTolerance);
  EXPECT_EQ(scene.objects[1].position.value, family().objects[1].position.value);
}

/// The sense of a turn is that of the parent's axes.
TEST(ItemMotion, ChildrenOfTurnedParentsTurnTheSameWay)
{
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, -2) / 3;
  for (int degrees = -170; degrees < 180; degrees += 20)
  {
    SceneDescription scene = family();
    scene.objects[0].orientation = turn(Eigen::Vector3d(0, 0.6, 0.8), degrees);
    scene.objects[0].scale = Eigen::Vector3d(2, 2, 2);
    const Affine3 before = worldOf(scene, 1);
    const ItemMotion items(scene, placesOf(scene), { secondMoved }, 0);
    items.apply(scene, rotation(items, axis, 50));
    EXPECT_LT((worldOf(scene, 1).linear - turn(axis, 50).matrix() * before.linear).norm(), 1e-11) << degrees;
  }
}

/// Below a parent that is scaled unevenly a turn shears, unless it is about the axis of the odd scale; back is as
/// before.
TEST(ItemMotion, ATurnThatShearsIsKnown)
{
  SceneDescription scene = family();
  EXPECT_FALSE(ItemMotion(scene, placesOf(scene), { secondMoved }, 0)
                 .shears(rotation(ItemMotion(scene, placesOf(scene), { secondMoved }, 0), { 0, 0, 1 }, 45)));
  const Quaternion parent = turn(Eigen::Vector3d(0, 0.6, 0.8), 70);
  scene.objects[0].scale = Eigen::Vector3d(2, 0.5, 2);
  const Affine3 before = worldOf(scene, 1);
  const ItemMotion items(scene, placesOf(scene), { firstMoved }, 0);
  EXPECT_FALSE(items.shears(rotation(items, { 0, 0, 1 }, 45))) << "it has no parent";
  const ItemMotion child(scene, placesOf(scene), { secondMoved }, 0);
  const Eigen::Vector3d odd = parent.matrix().col(1);
  EXPECT_FALSE(child.shears(rotation(child, odd, 45)));
  EXPECT_FALSE(child.shears(rotation(child, { 0, 0, 1 }, 0)));
  EXPECT_TRUE(child.shears(rotation(child, { 0, 0, 1 }, 45)));
  WorldMotion other = rotation(child, { 0, 0, 1 }, 45);
  other.mode = HandleMode::Move;
  EXPECT_FALSE(child.shears(other));
  EXPECT_TRUE(ItemMotion(scene, placesOf(scene), { secondMoved, light }, 0).shears(rotation(child, { 0, 0, 1 }, 45)));
  for (const double degrees : { 45.0, 60.0, -105.0 })
  {
    const ItemMotion next(scene, placesOf(scene), { secondMoved }, 0);
    next.apply(scene, rotation(next, Eigen::Vector3d(1, 2, -2) / 3, degrees));
  }
  EXPECT_LT((worldOf(scene, 1).linear - before.linear).norm(), 1e-11);
}

TEST(ItemMotion, SeveralTurnAboutTheirCentreAndChildrenOnce)
{
  SceneDescription scene = family();
  const Affine3 before[2] = { worldOf(scene, 0), worldOf(scene, 1) };
  const ItemMotion items(scene, placesOf(scene), { firstMoved, secondMoved, light }, 0);
  ASSERT_EQ(items.items().size(), 2u); // the child hangs on its parent
  const Eigen::Vector3d center = (Eigen::Vector3d(1, 2, 3) + Eigen::Vector3d(0, 4, 0)) / 2;
  EXPECT_LT((items.pivot() - center).norm(), motionTolerance);
  const Eigen::Vector3d axis = Eigen::Vector3d::UnitY();
  items.apply(scene, rotation(items, axis, 90));
  const Eigen::Matrix3d R = turn(axis, 90).matrix();
  for (int i = 0; i < 2; ++i)
  {
    const Affine3 now = worldOf(scene, std::size_t(i));
    EXPECT_LT((now.linear - R * before[i].linear).norm(), 1e-11);
    EXPECT_LT((now.translation - center - R * (before[i].translation - center)).norm(), 1e-11);
  }
  EXPECT_LT(
    (scene.lights[0].position.value - center - R * (Eigen::Vector3d(0, 4, 0) - center)).norm(), motionTolerance);
  EXPECT_LT((scene.lights[0].target.value - center - R * (Eigen::Vector3d(1, 0, 0) - center)).norm(), motionTolerance);
}

/// Only objects have children: the first light is not the first object.
TEST(ItemMotion, AChildGoesBesideALight)
{
  const SceneDescription scene = family();
  for (const SceneItem& other : { light, camera })
  {
    EXPECT_EQ(
      ItemMotion(scene, placesOf(scene), { other, secondMoved }, 0).items(), (SceneItems{ other, secondMoved }));
  }
}

TEST(ItemMotion, ScalesAnObjectAlongItsOwnAxes)
{
  SceneDescription scene = family();
  const Affine3 before = worldOf(scene, 1);
  const ItemMotion items(scene, placesOf(scene), { secondMoved }, 0);
  WorldMotion motion;
  motion.mode = HandleMode::Scale;
  motion.pivot = items.pivot();
  motion.axes = items.axes(HandleMode::Scale);
  motion.factors = Eigen::Vector3d(1.5, 1, 0.5);
  EXPECT_LT((motion.axes.transpose() * motion.axes - Eigen::Matrix3d::Identity()).norm(), motionTolerance);
  items.apply(scene, motion);
  EXPECT_EQ(scene.objects[1].scale.value, Eigen::Vector3d(1.5, 2, 1.5));
  const Eigen::Matrix3d D = motion.axes * motion.factors.asDiagonal() * motion.axes.transpose();
  EXPECT_LT((worldOf(scene, 1).linear - D * before.linear).norm(), 1e-11);
}

TEST(ItemMotion, ACamerasPoseTurnsExactlyAndItsUpOnlyWhereItMust)
{
  for (const bool roll : { false, true })
  {
    SceneDescription scene = family();
    const CameraDescription before = scene.cameras[0];
    const Rigid3 old = lookAtPose(before.eye.value, before.lookAt.value, before.up.value).inverse();
    const ItemMotion items(scene, placesOf(scene), { camera }, 0);
    const Eigen::Vector3d axis = roll ? Eigen::Vector3d(old.rotation.col(2)) : Eigen::Vector3d(0, 1, 0);
    items.apply(scene, rotation(items, axis, 33));
    const CameraDescription& now = scene.cameras[0];
    const Rigid3 turned = lookAtPose(now.eye.value, now.lookAt.value, now.up.value).inverse();
    EXPECT_LT((turned.rotation - turn(axis, 33).matrix() * old.rotation).norm(), motionTolerance);
    EXPECT_EQ(now.eye.value, before.eye.value);
    EXPECT_EQ(now.up.value == before.up.value, !roll);
  }
}

TEST(ItemMotion, OnlyWhatChangesGetsKeys)
{
  SceneDescription scene = family();
  ObjectDescription& object = scene.objects[0];
  object.position.keys = { { 0, Eigen::Vector3d(0, 0, 0) }, { 10, Eigen::Vector3d(10, 0, 0) } };
  object.orientation.keys = { { 0, Quaternion() }, { 10, Quaternion() } };
  const ItemMotion items(scene, placesOf(scene, 4), { firstMoved }, 4);
  items.apply(scene, rotation(items, Eigen::Vector3d::UnitZ(), 90));
  ASSERT_EQ(object.orientation.keys.size(), 3u);
  EXPECT_EQ(object.orientation.keys[1].frame, 4);
  EXPECT_EQ(object.position.keys.size(), 2u);
  EXPECT_FALSE(object.scale.animated());
}

/// A model far from its origin turns and grows where it stands.
TEST(ItemMotion, ThePivotStaysWhereItIs)
{
  const Eigen::Vector3d middle(40, -25, 60); // in the child's own axes
  for (const bool uneven : { false, true })
  {
    SceneDescription scene = family();
    if (uneven)
    {
      scene.objects[0].scale = Eigen::Vector3d(-2, 3, 0.5);
    }
    const SceneDescription before = scene;
    ScenePlaces places = placesOf(scene);
    const Eigen::Vector3d pivot = worldOf(scene, 1) * middle;
    places.objects[1].center = pivot;
    const ItemMotion items(scene, places, { secondMoved }, 0);
    EXPECT_EQ(items.pivot(), pivot);
    EXPECT_EQ(items.pivot(HandlePivot::Origin), places.objects[1].instance.world_from_object.translation);
    items.apply(scene, rotation(items, Eigen::Vector3d(1, 2, -2) / 3, 50));
    EXPECT_NE(scene.objects[1].position.value, before.objects[1].position.value);
    EXPECT_LT((worldOf(scene, 1) * middle - pivot).norm(), 1e-10);

    scene = before;
    WorldMotion motion;
    motion.mode = HandleMode::Scale;
    motion.pivot = pivot;
    motion.axes = items.axes(HandleMode::Scale);
    motion.factors = Eigen::Vector3d(1.5, 1, 0.5);
    items.apply(scene, motion);
    EXPECT_EQ(scene.objects[1].scale.value, Eigen::Vector3d(1.5, 2, 1.5));
    EXPECT_LT((worldOf(scene, 1) * middle - pivot).norm(), 1e-10);

    scene = before;
    motion.pivot = items.pivot(HandlePivot::Origin);
    items.apply(scene, motion);
    EXPECT_EQ(scene.objects[1].position.value, before.objects[1].position.value);
  }
}

/// A turn about another point than the origin changes the position, at this frame alone.
TEST(ItemMotion, PosesAtOtherKeysStay)
{
  SceneDescription scene = family();
  ObjectDescription& object = scene.objects[0];
  object.orientation.keys = { { 0, Quaternion() }, { 10, Quaternion() } };
  ScenePlaces places = placesOf(scene, 10);
  places.objects[0].center = object.position.value + Eigen::Vector3d(5, 0, 0);
  const ItemMotion items(scene, places, { firstMoved }, 10);
  items.apply(scene, rotation(items, Eigen::Vector3d::UnitZ(), 180));
  EXPECT_EQ(object.position.at(0), Eigen::Vector3d(1, 2, 3));
  EXPECT_LT((object.position.at(10) - Eigen::Vector3d(11, 2, 3)).norm(), motionTolerance);
  EXPECT_FALSE(object.scale.animated());
}

/// What has keys for its position alone turns and grows at all frames: everywhere about its own middle.
TEST(ItemMotion, AMovingObjectTurnsInPlaceAtAllFrames)
{
  const Eigen::Vector3d middle(4, -3, 2); // in its own axes
  for (const HandleMode mode : { HandleMode::Rotate, HandleMode::Scale })
  {
    SceneDescription scene = family();
    ObjectDescription& object = scene.objects[1];
    object.position.keys = { { 0, Eigen::Vector3d(0, 0, 0) }, { 10, Eigen::Vector3d(10, 0, 0) },
      { 20, Eigen::Vector3d(10, 5, 0), Interpolation::Smooth }, { 30, Eigen::Vector3d(0, 5, 5) } };
    scene.objects[0].orientation.keys = { { 0, Quaternion() }, { 30, turn(Eigen::Vector3d::UnitX(), 80) } };
    const SceneDescription before = scene;
    const auto middleAt = [&](const SceneDescription& of, int frame)
    { return placesOf(of, frame).objects[1].instance.world_from_object * middle; };
    ScenePlaces places = placesOf(scene, 14);
    places.objects[1].center = middleAt(scene, 14);
    const ItemMotion items(scene, places, { secondMoved }, 14);
    WorldMotion motion = rotation(items, Eigen::Vector3d(2, 1, 2) / 3, 70);
    motion.mode = mode;
    motion.axes = items.axes(mode);
    motion.factors = Eigen::Vector3d(2, 1, 0.5);
    const auto expectNoKeys = [&]
    {
      EXPECT_FALSE(object.orientation.animated() || object.scale.animated());
      EXPECT_EQ(object.position.keys.size(), 4u);
    };
    items.apply(scene, motion);
    items.apply(scene, motion); // as the drag goes on
    expectNoKeys();
    for (const int frame : { -5, 0, 7, 14, 20, 26, 40 })
    {
      EXPECT_LT((middleAt(scene, frame) - middleAt(before, frame)).norm(), 1e-10) << "frame " << frame;
    }
    EXPECT_GT((object.position.at(0) - before.objects[1].position.at(0)).norm(), 0.5);
    motion.degrees = 0;
    motion.factors = Eigen::Vector3d(1, 1, 1);
    items.apply(scene, motion); // and back
    expectNoKeys();
    EXPECT_TRUE(object.position.keys == before.objects[1].position.keys);
  }
}

TEST(ItemMotion, NoMotionChangesNothing)
{
  for (const HandleMode mode : { HandleMode::Move, HandleMode::Rotate, HandleMode::Scale })
  {
    SceneDescription scene = family();
    scene.objects[0].orientation = Quaternion{ 0.981, 0.1, 0.02, 0.3 }; // as somebody typed it
    const ItemMotion items(scene, placesOf(scene), { firstMoved, camera, light }, 0);
    WorldMotion motion = rotation(items, Eigen::Vector3d::UnitX(), 0);
    motion.mode = mode;
    items.apply(scene, motion);
    EXPECT_EQ(scene.objects[0].position.value, family().objects[0].position.value);
    EXPECT_TRUE(scene.objects[0].orientation.value == (Quaternion{ 0.981, 0.1, 0.02, 0.3 }));
    EXPECT_EQ(scene.cameras[0].eye.value, family().cameras[0].eye.value);
    EXPECT_EQ(scene.cameras[0].up.value, family().cameras[0].up.value);
    EXPECT_EQ(scene.lights[0].target.value, family().lights[0].target.value);
  }
}
} // namespace
