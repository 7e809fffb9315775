// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkStageSamples.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <thread>

using namespace dgtk;
using namespace dgtk::test;
using testing::HasSubstr;
using Vector = Eigen::Vector3d;

namespace
{
constexpr double rounding = 1e-14; // of a few products of numbers of size 1 to 10
}

TEST(Stage, ParentsCarryTheirChildren)
{
  const ModelFolder folder;
  // child is listed before its parent; a turn of 90 degrees about z takes x to y.
  const auto stage = folder.load(R"({"objects": [
    {"name": "child", "model": "models/square.ac", "parent": "arm", "position": [1, 0, 0], "scale": [1, 2, -3]},
    {"name": "arm", "model": "models/empty.ac", "parent": "root", "visible": false, "scale": 2,
     "orientation": {"keys": [[0, [1, 0, 0, 0]], [10, [0.7071067811865476, 0, 0, 0.7071067811865476]]]}},
    {"name": "root", "model": "models/square.ac", "position": [10, 20, 30]}]})");
  EXPECT_EQ(stage->objectNames(), (std::vector<std::string>{ "child", "root" }));
  const auto before = stage->at(0);
  ASSERT_EQ(before->instances.size(), 2u);
  EXPECT_LE((before->instances[0].world_from_object * Vector(1, 1, 1) - Vector(14, 24, 24)).norm(), rounding);
  const auto after = stage->at(10);
  EXPECT_LE((after->instances[0].world_from_object * Vector(1, 1, 1) - Vector(6, 24, 24)).norm(), 4 * rounding);
  EXPECT_EQ(after->instances[1].world_from_object * Vector(0, 0, 0), Vector(10, 20, 30));
  EXPECT_EQ(before->frame, 0);
  EXPECT_EQ(after->frame, 10);
}

TEST(Stage, ViewsOfAFieldOfView)
{
  const ModelFolder folder;
  const auto stage = folder.load(R"({"cameras": [
    {"fovY": {"keys": [[0, 90], [10, 60]]}, "eye": {"keys": [[0, [0, 0, 5]], [10, [0, 0, 15]]]}, "lookAt": [0, 0, 0],
     "near": 0.5, "far": 9},
    {"aspect": 2, "fovY": 90, "width": 100, "height": 50, "eye": [0, 0, 5], "lookAt": [0, 0, 0]}]})");
  EXPECT_EQ(stage->cameraNames(), (std::vector<std::string>{ "Camera0", "Camera1" }));
  const View view = stage->view(0, 0);
  EXPECT_EQ(view.model->width(), 640);
  EXPECT_EQ(view.model->height(), 480);
  EXPECT_EQ(view.near, 0.5);
  EXPECT_EQ(view.far, 9);
  const Eigen::Matrix3d K = view.model->linear()->K;
  EXPECT_NEAR(K(0, 0), 240, 1e-12 * 240);
  EXPECT_NEAR(K(1, 1), 240, 1e-12 * 240);
  EXPECT_LE((view.camera_from_world * Vector(1, 1, 0) - Vector(1, -1, 5)).norm(), rounding);
  EXPECT_LE((stage->view(0, 5).camera_from_world * Vector(0, 0, 0) - Vector(0, 0, 10)).norm(), rounding);
  EXPECT_NEAR(stage->view(0, 10).model->linear()->K(1, 1), 240 / std::tan(3.14159265358979323846 / 6), 1e-9);
  EXPECT_EQ(stage->view(1, 0).model->width(), 100);
  EXPECT_EQ(stage->view(1, 0).model->height(), 50);
  EXPECT_NEAR(stage->view(1, 0, 200, 100).model->linear()->K(0, 0), 50, 1e-12 * 50);
  EXPECT_THROW(stage->view(2, 0), UsageError);
  EXPECT_THROW(stage->view(0, 0, -1, 5), UsageError);
  EXPECT_THROW(stage->view(0, 0, 0, 5), UsageError);
  EXPECT_THROW(stage->view(0, std::nan("")), UsageError);
  EXPECT_THROW(stage->at(std::nan("")), UsageError);
}

TEST(Stage, CalibratedCamerasScaleWithTheImage)
{
  const ModelFolder folder;
  const auto stage = folder.load(R"({"cameras": [{"width": 100, "height": 50, "K": [[80, 0.5, 40], [0, 90, 20],
    [0, 0, 1]], "position": [1, 2, 3], "orientation": [0, 1, 0, 0]}]})");
  const View own = stage->view(0, 0);
  EXPECT_EQ(own.model->width(), 100);
  const Vector point(1.5, 2.5, -1);
  // The camera looks along -z with +y up: x right, y down.
  EXPECT_LE((own.camera_from_world * point - Vector(0.5, -0.5, 4)).norm(), rounding);
  Eigen::Vector2d small, large;
  ASSERT_TRUE(own.model->project(own.camera_from_world * point, small));
  const View twice = stage->view(0, 0, 200, 150);
  ASSERT_TRUE(twice.model->project(twice.camera_from_world * point, large));
  EXPECT_NEAR(large[0], 2 * small[0], 1e-12);
  EXPECT_NEAR(large[1], 3 * small[1], 1e-12);
}

TEST(Stage, OrthographicViews)
{
  const ModelFolder folder;
  const auto stage = folder.load(R"({"cameras": [{"model": "orthographic", "viewHeight": 4, "eye": [0, 0, 9],
    "lookAt": [0, 0, 0]}]})");
  const View view = stage->view(0, 0, 400, 200);
  Eigen::Vector2d pixel;
  ASSERT_TRUE(view.model->project(view.camera_from_world * Vector(1, 1, 3), pixel));
  EXPECT_LE((pixel - Eigen::Vector2d(250, 50)).norm(), 1e-12);
  const auto zoom = folder.load(R"({"cameras": [{"model": "orthographic", "eye": [0, 0, 9], "lookAt": [0, 0, 0],
    "viewHeight": {"keys": [[0, 4], [10, 8]]}}]})");
  const View wide = zoom->view(0, 10, 400, 200);
  ASSERT_TRUE(wide.model->project(wide.camera_from_world * Vector(1, 1, 3), pixel));
  EXPECT_LE((pixel - Eigen::Vector2d(225, 75)).norm(), 1e-12);
}

TEST(Stage, Lights)
{
  const ModelFolder folder;
  const auto none = folder.load("{}")->at(0);
  ASSERT_EQ(none->lights.size(), 1u);
  EXPECT_EQ(none->lights[0].kind, LightKind::Head);
  const auto some = folder
                      .load(R"({"background": [0.1, 0.2, 0.3], "lights": [
    {"enabled": false}, {"name": "s", "kind": "spot", "position": {"keys": [[0, [0, 0, 0]], [4, [4, 0, 0]]]},
    "target": {"keys": [[0, [0, 0, 1]], [4, [0, 0, 9]]]}, "intensity": 3, "coneAngle": 20, "exponent": 7,
    "ambient": [0.1, 0.2, 0.3], "diffuse": [0.4, 0.5, 0.6], "specular": [0.7, 0.8, 0.9], "attenuation": [1, 2, 3],
    "shadows": true, "shadowSize": 512}]})")
                      ->at(1);
  ASSERT_EQ(some->lights.size(), 1u);
  EXPECT_EQ(some->lights[0].kind, LightKind::Spot);
  EXPECT_EQ(some->lights[0].name, "s");
  EXPECT_EQ(some->lights[0].position, Vector(1, 0, 0));
  EXPECT_EQ(some->lights[0].target, Vector(0, 0, 3));
  EXPECT_EQ(some->lights[0].ambient, Vector(0.1, 0.2, 0.3));
  EXPECT_EQ(some->lights[0].diffuse, Vector(0.4, 0.5, 0.6));
  EXPECT_EQ(some->lights[0].specular, Vector(0.7, 0.8, 0.9));
  EXPECT_EQ(some->lights[0].attenuation, Vector(1, 2, 3));
  EXPECT_EQ(some->lights[0].exponent, 7);
  EXPECT_TRUE(some->lights[0].shadows);
  EXPECT_EQ(some->lights[0].shadowSize, 512);
  EXPECT_EQ(some->lights[0].intensity, 3);
  EXPECT_EQ(some->lights[0].coneAngle, 20);
  EXPECT_EQ(some->background, Vector(0.1, 0.2, 0.3));
  EXPECT_TRUE(folder.load(R"({"lights": [{"enabled": false}]})")->at(0)->lights.empty());
}

// The picture's centre column lies towards -z (z up: +y), and turns counter-clockwise as seen from above.
TEST(Stage, EnvironmentsTurnAboutTheUpAxis)
{
  const ModelFolder folder;
  writeFile(folder.path("sky.hdr"), "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 1\n\x40\x40\x40\x80");
  const double c = std::cos(0.52359877559829887), s = 0.5; // of 30 degrees
  struct Case
  {
    const char* upAxis;
    Vector ahead, right, up; ///< of the picture, in the world
  };
  for (const Case& one :
    { Case{ "y", { -s, 0, -c }, { c, 0, -s }, { 0, 1, 0 } }, Case{ "z", { -s, c, 0 }, { c, s, 0 }, { 0, 0, 1 } } })
  {
    const auto stage = folder.load(std::string(R"({"upAxis": ")") + one.upAxis +
                                   R"(", "environment": {"image": "sky.hdr", "rotation": 30, "intensity": 2,
                                  "background": false}})");
    const auto state = stage->at(0);
    EXPECT_EQ(stage->inputFiles(), (std::vector<std::string>{ folder.path("scene.json"), folder.path("sky.hdr") }));
    ASSERT_TRUE(state->environment);
    EXPECT_EQ(state->environment->intensity, 2);
    EXPECT_FALSE(state->environment->background);
    const Eigen::Matrix3d& turn = state->environment->image_from_world;
    EXPECT_LT((turn * one.ahead - Vector(0, 0, -1)).norm(), rounding) << one.upAxis;
    EXPECT_LT((turn * one.right - Vector(1, 0, 0)).norm(), rounding) << one.upAxis;
    EXPECT_LT((turn * one.up - Vector(0, 1, 0)).norm(), rounding) << one.upAxis;
  }
}

TEST(Stage, ExposuresAreInTheMiddleOfTheirPartsOfTheShutter)
{
  const ModelFolder folder;
  const std::vector<std::vector<double>> expected = { { 3.25 }, { 3, 3.5 }, { 2.875, 3.125, 3.375, 3.625 } };
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    const auto stage = folder.load(R"({"cameras": [{"name": "c", "eye": {"keys": [[0, [0, 0, 0]], [8, [8, 0, 0]]]},
      "lookAt": [0, 0, -9], "fovY": 40, "near": 1, "far": 9, "shutter": {"open": -0.25, "close": 0.75, "exposures": )" +
                                   std::to_string(1 << i) + "}}]}");
    const std::vector<Exposure> exposures = stage->exposures(0, 3, 8, 8);
    ASSERT_EQ(exposures.size(), expected[i].size());
    for (std::size_t k = 0; k < exposures.size(); ++k)
    {
      EXPECT_EQ(exposures[k].frame, expected[i][k]);
      const Rigid3& pose = exposures[k].view.camera_from_world;
      EXPECT_LT((-(pose.rotation.transpose() * pose.translation) - Vector(expected[i][k], 0, 0)).norm(), 8 * rounding);
    }
  }
}

TEST(Stage, AShutterOfOneInstantIsOneExposureAtIt)
{
  const ModelFolder folder;
  const std::string camera = R"({"cameras": [{"eye": [0, 0, 0], "lookAt": [0, 0, -9])";
  for (const auto& [parts, frame] : { std::pair<std::string, double>(R"("shutter": {"open": 0.5, "close": 0.5})", 3.5),
         { R"("shutter": {"open": -1, "close": -1, "exposures": 1})", 2 },
         { R"("lens": {"aperture": 1, "exposures": 1})", 3 } })
  {
    const std::vector<Exposure> exposures = folder.load(camera + ", " + parts + "}]}")->exposures(0, 3, 8, 8);
    ASSERT_EQ(exposures.size(), 1u) << parts;
    EXPECT_EQ(exposures[0].frame, frame);
  }
  EXPECT_TRUE(folder.load(camera + R"(, "shutter": {"exposures": 7}}]})")->exposures(0, 3, 8, 8).empty());
}

TEST(Stage, ExposuresOfALensAreSpreadOverItAndMeetInTheFocus)
{
  const ModelFolder folder;
  const auto stage = folder.load(R"({"cameras": [{"eye": [0, 0, 0], "lookAt": [0, 0, -9], "fovY": 40,
    "lens": {"aperture": 0.5, "focus": {"keys": [[0, 4], [2, 8]]}, "exposures": 12},
    "shutter": {"open": 0, "close": 2, "exposures": 8}}]})");
  const Eigen::Matrix3d K = stage->view(0, 0, 64, 48).model->linear()->K;
  const std::vector<Exposure> exposures = stage->exposures(0, 0, 64, 48);
  ASSERT_EQ(exposures.size(), 12u); // as many as the one of the two that needs more
  std::vector<double> radii;
  for (const Exposure& one : exposures)
  {
    const Vector point(0.5, -0.25, -4 - 2 * one.frame); // in focus at that time
    Eigen::Vector2d pixel;
    ASSERT_TRUE(one.view.model->project(one.view.camera_from_world * point, pixel));
    const Vector x(point.x(), -point.y(), -point.z());
    EXPECT_LT((pixel - (K * x / x.z()).head<2>()).norm(), 1e-12);
    radii.push_back(one.view.camera_from_world.translation.norm());
  }
  // Circles that cut the disc into parts of one size pass between the points.
  std::sort(radii.begin(), radii.end());
  for (std::size_t i = 0; i < radii.size(); ++i)
  {
    EXPECT_NEAR(radii[i], 0.25 * std::sqrt((double(i) + 0.5) / 12), rounding);
  }
}

// Catmull-Rom through the keys would be behind the camera.
TEST(Stage, FocusStaysBetweenItsKeys)
{
  const ModelFolder folder;
  const auto stage = folder.load(R"({"cameras": [{"eye": [0, 0, 0], "lookAt": [0, 0, -9], "fovY": 40,
    "lens": {"aperture": 0.5, "exposures": 4,
      "focus": {"keys": [[0, 10], [10, 0.1], [20, 0.1]], "interpolation": "smooth"}}}]})");
  const View middle = stage->view(0, 15, 64, 48);
  const Eigen::Matrix3d K = middle.model->linear()->K;
  for (const Exposure& one : stage->exposures(0, 15, 64, 48))
  {
    const Eigen::Vector2d point =
      (middle.camera_from_world.translation - one.view.camera_from_world.translation).head<2>();
    const Eigen::Vector2d shift = (one.view.model->linear()->K - K).topRightCorner<2, 1>();
    EXPECT_LT((shift - K.topLeftCorner<2, 2>() * point / 0.1).norm(), 1e-9 * shift.norm());
  }
}

TEST(Stage, FogIsThatOfTheScene)
{
  const ModelFolder folder;
  const auto state = folder.load(R"({"fog": {"color": [0.1, 0.2, 0.3], "density": 0.5, "start": 2}})")->at(0);
  EXPECT_EQ(state->fog.color, Vector(0.1, 0.2, 0.3));
  EXPECT_EQ(state->fog.density, 0.5);
  EXPECT_EQ(state->fog.start, 2);
}

TEST(Stage, LightsBackgroundAndFogHaveTheirTracksValues)
{
  const ModelFolder folder;
  const auto stage = folder.load(R"({"background": {"keys": [[0, [0, 0, 0]], [4, [1, 0.5, 0]]]},
    "fog": {"color": {"keys": [[0, [0, 0, 0]], [4, [0, 0, 1]]]}, "density": {"keys": [[0, 0], [4, 2]]},
      "start": {"keys": [[0, 4], [4, 8]], "interpolation": "step"}},
    "lights": [{"name": "a", "enabled": {"keys": [[0, true], [2, false], [3, true]]},
      "intensity": {"keys": [[0, 0], [4, 8]]}, "coneAngle": {"keys": [[0, 10], [4, 30]]},
      "exponent": {"keys": [[0, 0], [4, 4]]}, "ambient": {"keys": [[0, [0, 0, 0]], [4, [4, 0, 0]]]},
      "diffuse": {"keys": [[0, [0, 0, 0]], [4, [0, 4, 0]]]}, "specular": {"keys": [[0, [0, 0, 0]], [4, [0, 0, 4]]]}},
      {"name": "b", "intensity": {"keys": [[0, 1], [2, 0], [4, 0], [6, 1]], "interpolation": "smooth"}}]})");
  const auto state = stage->at(1);
  EXPECT_EQ(state->background, Vector(0.25, 0.125, 0));
  EXPECT_EQ(state->fog.color, Vector(0, 0, 0.25));
  EXPECT_EQ(state->fog.density, 0.5);
  EXPECT_EQ(state->fog.start, 4);
  ASSERT_EQ(state->lights.size(), 2u);
  const LightState& light = state->lights[0];
  EXPECT_EQ(light.intensity, 2);
  EXPECT_EQ(light.coneAngle, 15);
  EXPECT_EQ(light.exponent, 1);
  EXPECT_EQ(light.ambient, Vector(1, 0, 0));
  EXPECT_EQ(light.diffuse, Vector(0, 1, 0));
  EXPECT_EQ(light.specular, Vector(0, 0, 1));
  ASSERT_EQ(stage->at(2.5)->lights.size(), 1u);
  EXPECT_EQ(stage->at(2.5)->lights[0].name, "b");
  EXPECT_EQ(stage->at(3)->lights.size(), 2u);
  EXPECT_EQ(stage->at(3)->lights[1].intensity, 0) << "not below the range";
  EXPECT_EQ(stage->at(4)->fog.start, 8);
}

TEST(Stage, ObjectsKeepTheirIdsWhileTheyAreNotVisible)
{
  const ModelFolder folder;
  const auto stage = folder.load(R"({"objects": [
    {"name": "a", "model": "models/square.ac", "visible": {"keys": [[0, true], [2, false], [4, true]]},
      "position": {"keys": [[0, [0, 0, 0]], [4, [4, 0, 0]]]}},
    {"name": "never", "model": "models/square.ac", "visible": {"keys": [[0, false], [3, false]]}},
    {"name": "b", "model": "models/square.ac", "parent": "a"},
    {"name": "hidden", "model": "models/square.ac", "visible": false}]})");
  EXPECT_EQ(stage->objectNames(), (std::vector<std::string>{ "a", "b" }));
  for (const double frame : { 0.0, 1.5, 2.0, 3.5, 4.0 })
  {
    SCOPED_TRACE(frame);
    const auto state = stage->at(frame);
    ASSERT_EQ(state->instances.size(), 2u);
    EXPECT_EQ(state->instances[0].name, "a");
    EXPECT_EQ(state->instances[0].visible, frame < 2 || frame >= 4);
    EXPECT_EQ(state->instances[0].world_from_object.translation, Vector(frame, 0, 0)) << "it moves on";
    EXPECT_TRUE(state->instances[1].visible);
    EXPECT_EQ(state->instances[1].world_from_object.translation, Vector(frame, 0, 0)) << "its child is there";
  }
}

TEST(Stage, IsTheSameFromManyThreads)
{
  const ModelFolder folder;
  const auto stage = folder.load(R"({"objects": [{"model": "models/runner.md2", "position": {"keys": [[0, [0, 0, 0]],
    [100, [1, 2, 3]]]}}]})");
  std::vector<Vector> alone;
  for (int frame = 0; frame < 100; ++frame)
  {
    const auto state = folder.load(contentsOf(folder.path("scene.json")))->at(frame);
    alone.push_back(state->instances[0].world_from_object * state->instances[0].geometry->positions[0]);
    if (frame == 9)
    {
      break;
    }
  }
  std::vector<std::thread> threads;
  std::vector<int> wrong(4, 0);
  for (std::size_t t = 0; t < wrong.size(); ++t)
  {
    threads.emplace_back(
      [&, t]
      {
        for (std::size_t i = 0; i < 200; ++i)
        {
          const std::size_t frame = (i * (t + 1)) % alone.size();
          const auto state = stage->at(double(frame));
          const Instance& it = state->instances[0];
          wrong[t] += it.world_from_object * it.geometry->positions[0] != alone[frame];
        }
      });
  }
  for (std::thread& thread : threads)
  {
    thread.join();
  }
  EXPECT_EQ(wrong, std::vector<int>(4, 0));
}

TEST(Stage, ObjectsThatOnlyGrowMove)
{
  const ModelFolder folder;
  const auto stage = folder.load(R"({"objects": [
    {"name": "root", "model": "models/square.ac", "scale": {"keys": [[0, 1], [4, 3]]}},
    {"name": "child", "model": "models/square.ac", "parent": "root", "position": [1, 0, 0]}]})");
  for (const auto& [frame, scale] : { std::pair(0, 1), std::pair(2, 2), std::pair(4, 3) })
  {
    const auto state = stage->at(frame);
    EXPECT_EQ(state->instances[0].world_from_object * Vector(1, 1, 0), Vector(scale, scale, 0));
    EXPECT_EQ(state->instances[1].world_from_object * Vector(1, 1, 0), Vector(2 * scale, scale, 0));
  }
}

TEST(Stage, UndefinedMomentsAreRefused)
{
  const ModelFolder folder;
  const auto stage = folder.load(R"({"objects": [
    {"name": "flat", "model": "models/square.ac", "scale": {"keys": [[0, [1, -1, 2]], [3, [1, 1, 2]]]}}],
    "cameras": [{"eye": {"keys": [[0, [0, 0, 5]], [3, [0, 0, -5]]]}, "lookAt": [0, 0, 0]}, {"name": "rolling",
      "eye": {"keys": [[0, [0, 0, 5]], [3, [0, 0, -5]]]}, "lookAt": [0, 0, 0], "rollingShutter": {"duration": 1}}]})");
  EXPECT_NO_THROW(stage->at(0));
  EXPECT_THAT(thrownBy<InputError>(
                [&]
                {
                  stage->at(1.5); // frames of the scene are refused when it is read
                }),
    HasSubstr("scene.json:2: object 'flat': scale passes through 0"));
  EXPECT_THAT(thrownBy<InputError>([&] { stage->view(0, 1.5); }),
    HasSubstr("scene.json:3: camera 'Camera0' at frame 1.5: eye and look-at"));
  const View rolling = stage->view(1, 1); // within whose frame they meet
  EXPECT_THAT(thrownBy<InputError>([&] { rolling.instants->poseAt(1.5); }),
    HasSubstr("scene.json:3: camera 'rolling' at frame 1.5: eye and look-at"));
}
