// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkScenePlaces.h"

#include "dgtkStage.h"
#include "dgtkSyntheticScene.h"
#include "dgtkTestSupport.h"
#include "dgtkViewCamera.h"

#include <gtest/gtest.h>

#include <utility>

namespace
{
using namespace dgtk;
using test::sourceFile;

constexpr double scenePlaceTolerance = 1e-12; // relative: the same products in the same order, up to their contraction

TEST(ScenePlaces, AreThoseOfTheStage)
{
  for (const char* name : { "demo.json", "parenting.json", "fig_4_14_bouncing_ball.scene" })
  {
    const SceneDescription scene = readScene(sourceFile(std::string("Data/Scenes/") + name));
    const std::shared_ptr<const Stage> stage = Stage::load(scene);
    ModelLibrary models;
    models.load(scene);
    for (const double frame : { 0.0, 1.0, 1.5, 40.0 })
    {
      const ScenePlaces places = placeScene(scene, models, frame);
      const std::shared_ptr<const SceneState> state = stage->at(frame);
      std::size_t next = 0;
      for (const ObjectPlace& place : places.objects)
      {
        if (!place.visible || place.instance.model == nullptr)
        {
          continue;
        }
        const Instance& expected = state->instances.at(next++);
        EXPECT_EQ(place.instance.name, expected.name);
        EXPECT_TRUE(
          place.instance.world_from_object.linear.isApprox(expected.world_from_object.linear, scenePlaceTolerance));
        EXPECT_TRUE((place.instance.world_from_object.translation - expected.world_from_object.translation).norm() <
                    scenePlaceTolerance);
        EXPECT_EQ(place.instance.geometry->positions, expected.geometry->positions) << place.instance.name;
        EXPECT_EQ(place.instance.materials->size(), expected.materials->size());
        for (std::size_t m = 0; m < expected.materials->size(); ++m)
        {
          EXPECT_EQ((*place.instance.materials)[m].diffuse, (*expected.materials)[m].diffuse);
        }
      }
      EXPECT_EQ(next, state->instances.size());
    }
  }
}

TEST(ScenePlaces, SurroundingsAreTheEnvironmentOfTheStage)
{
  for (const UpAxis up : { UpAxis::Y, UpAxis::Z })
  {
    SceneDescription scene = readScene(sourceFile("Data/Scenes/materials_environment.json"));
    scene.upAxis = up;
    scene.fog.density = Track<double>(0.25);
    scene.background = Eigen::Vector3d(0.1, 0.2, 0.3);
    ModelLibrary models;
    models.load(scene);
    const std::shared_ptr<const SceneState> found = placeScene(scene, models, 0).surroundings;
    const std::shared_ptr<const SceneState> expected = Stage::load(scene)->at(0);
    ASSERT_TRUE(found->environment && expected->environment);
    EXPECT_EQ(found->environment->image_from_world, expected->environment->image_from_world);
    EXPECT_EQ(found->environment->image->rgb, expected->environment->image->rgb);
    EXPECT_EQ(found->environment->intensity, expected->environment->intensity);
    EXPECT_EQ(found->environment->background, expected->environment->background);
    EXPECT_EQ(found->background, Eigen::Vector3d(0.1, 0.2, 0.3));
    EXPECT_EQ(found->fog.density, 0.25);
    ASSERT_EQ(found->lights.size(), expected->lights.size());
  }
}

TEST(ScenePlaces, PickingFindsWhatARendererSees)
{
  const SceneDescription scene = readScene(sourceFile("Data/Scenes/parenting.json"));
  ModelLibrary models;
  models.load(scene);
  const ScenePlaces places = placeScene(scene, models, 0);
  const std::shared_ptr<const Stage> stage = Stage::load(scene);
  const View view = stage->view(0, 0, 32, 24);
  const VisibilityBuffer seen = test::bruteForce(*stage->at(0), view);
  const std::vector<std::string> names = stage->objectNames();
  const Rigid3 world_from_camera = view.camera_from_world.inverse();
  int hits = 0;
  for (int row = 0; row < 24; ++row)
  {
    for (int column = 0; column < 32; ++column)
    {
      const CameraRay ray = view.model->rayThrough({ column + 0.5, row + 0.5 });
      const auto item = pickItem(
        places, { world_from_camera * ray.origin, world_from_camera.rotation * ray.direction, view.near }, { -1, 0 });
      const std::uint32_t id = seen.at(column, row).object;
      ASSERT_EQ(item.has_value(), id != 0) << column << ' ' << row;
      if (item)
      {
        ++hits;
        EXPECT_EQ(scene.objects[item->index].name, names[id - 1]) << column << ' ' << row;
      }
    }
  }
  EXPECT_GT(hits, 50);
}

TEST(ScenePlaces, CamerasAndLightsArePickedByTheirPlace)
{
  SceneDescription scene;
  scene.cameras.resize(1);
  scene.lights.resize(1);
  scene.lights[0].position = Eigen::Vector3d(0, 0, -10);
  const ScenePlaces places = placeScene(scene, ModelLibrary(), 0);
  const auto camera = pickItem(places, { { 0.05, 0, 20 }, { 0, 0, -1 }, 0 }, { 0.1, 0 });
  ASSERT_TRUE(camera.has_value());
  EXPECT_EQ(camera->kind, SceneItem::Kind::Camera);
  const auto light = pickItem(places, { { 0.15, 0, 20 }, { 0, 0, -1 }, 0 }, { 0, 0.006 });
  ASSERT_TRUE(light.has_value()) << "0.18 units around it at a distance of 30";
  EXPECT_EQ(light->kind, SceneItem::Kind::Light);
  EXPECT_FALSE(pickItem(places, { { 5, 0, 20 }, { 0, 0, -1 }, 0 }, { 0.1, 0 }).has_value());
}

TEST(ScenePlaces, ACameraIsNotPickedByItsOwnEye)
{
  SceneDescription scene;
  scene.cameras.resize(2);
  scene.cameras[0].eye = Eigen::Vector3d(0.1, 7, 3.3);
  scene.cameras[1].eye = Eigen::Vector3d(0, 0, 0);
  const ScenePlaces places = placeScene(scene, ModelLibrary(), 0);
  ViewCamera eye(ViewKind::Perspective);
  eye.look(scene.cameras[0].eye.value, scene.cameras[1].eye.value);
  const PickReach reach = eye.reach(8, 300);
  for (const auto& [x, y] : { std::pair(3, 4), std::pair(120, 299), std::pair(390, 7) })
  {
    EXPECT_FALSE(pickItem(places, eye.ray(x, y, 400, 300), reach).has_value()) << x << ' ' << y;
  }
  const auto before = pickItem(places, eye.ray(200, 150, 400, 300), reach);
  ASSERT_TRUE(before.has_value());
  EXPECT_EQ(before->index, std::size_t(1));
}

TEST(ScenePlaces, NothingIsPickedBeyondTheRaysEnd)
{
  SceneDescription scene;
  scene.lights.resize(1);
  scene.lights[0].position = Eigen::Vector3d(0, 0, -10);
  const ScenePlaces places = placeScene(scene, ModelLibrary(), 0);
  EXPECT_TRUE(pickItem(places, { { 0, 0, 0 }, { 0, 0, -1 }, 0, 10.1 }, { 0.1, 0 }).has_value());
  EXPECT_FALSE(pickItem(places, { { 0, 0, 0 }, { 0, 0, -1 }, 0, 9.9 }, { 0.1, 0 }).has_value());
}
} // namespace
