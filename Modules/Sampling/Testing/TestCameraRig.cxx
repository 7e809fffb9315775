// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampler.h"
#include "dgtkStage.h"

#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

using namespace dgtk;

namespace
{
SceneSample sampled(const std::string& cameras, int number = 0)
{
  const std::string ball = test::sourceFile("Data/Models/ball.ac");
  const std::string json =
    R"({ "seed": 2, "objects": [ { "name": "ball", "model": ")" + ball + R"(" } ], "cameras": [ )" + cameras + " ] }";
  return Sampler(RandomScene::ofText(json, ".")).draw(std::uint64_t(number));
}

Rigid3 worldOf(const CameraDescription& camera, double frame)
{
  return cameraView(camera, frame).camera_from_world.inverse();
}

/// Largest difference of the second camera's pose from the one that it has on the first.
double offBy(const SceneDescription& scene, const Rigid3& base_from_mounted, double frame)
{
  const Rigid3 expected = worldOf(scene.cameras[0], frame) * base_from_mounted;
  const Rigid3 found = worldOf(scene.cameras[1], frame);
  return std::max((expected.rotation - found.rotation).cwiseAbs().maxCoeff(),
    (expected.translation - found.translation).cwiseAbs().maxCoeff());
}

std::string refusal(const std::string& cameras)
{
  return test::thrownBy<Error>([&] { sampled(cameras); });
}

const std::string left = R"({ "name": "left", "eye": { "inBox": [[3, 1, 3], [6, 5, 6]] }, "lookAt": "ball" })";
const std::string right = R"({ "name": "right", "fovY": 40, "rig": { "camera": "left", "position": [0.1, 0, 0] } })";
} // namespace

TEST(CameraRig, SharesARandomPose)
{
  const Rigid3 aside{ Eigen::Matrix3d::Identity(), { 0.1, 0, 0 } };
  for (int number = 0; number < 5; ++number)
  {
    const SceneDescription scene = sampled(left + ", " + right, number).scene;
    ASSERT_EQ(scene.cameras.size(), 2U);
    EXPECT_LT(offBy(scene, aside, 0), 1e-12);
    EXPECT_EQ(scene.cameras[1].fovY.value, 40) << "the lens is its own";
    EXPECT_EQ(toJson(scene, ".").find("\"rig\""), std::string::npos) << "a plain scene";
    // The list's order is kept, whichever comes first, and changes nothing.
    const SceneDescription swapped = sampled(right + ", " + left, number).scene;
    EXPECT_EQ(swapped.cameras[0].name, "right");
    EXPECT_EQ(swapped.cameras[0].position.value, scene.cameras[1].position.value);
    EXPECT_EQ(swapped.cameras[1].eye.value, scene.cameras[0].eye.value);
  }
  EXPECT_EQ(sampled(left, 3).scene.cameras[0].eye.value, sampled(left + ", " + right, 3).scene.cameras[0].eye.value);
}

TEST(CameraRig, TurnsWithItsCameraAndCarriesOthers)
{
  // 90 degrees about the first camera's y; what is mounted on that looks back, half a unit behind it.
  const SceneDescription scene = sampled(left + R"(, { "name": "side", "rig": { "camera": "left", "orientation":
      [0.70710678118654752, 0, 0.70710678118654752, 0] } },
    { "name": "third", "rig": { "camera": "side", "position": [0, 0, -0.5], "orientation": [0, 0, 1, 0] } })")
                                   .scene;
  Rigid3 turn;
  turn.rotation << 0, 0, 1, 0, 1, 0, -1, 0, 0;
  EXPECT_LT(offBy(scene, turn, 0), 1e-12);
  const Rigid3 first = worldOf(scene.cameras[0], 0);
  const Rigid3 third = worldOf(scene.cameras[2], 0);
  EXPECT_LT((third.translation - (first.translation - 0.5 * first.rotation.col(0))).norm(), 1e-12);
  EXPECT_LT((third.rotation.col(2) + first.rotation.col(0)).norm(), 1e-12);
}

TEST(CameraRig, BeginsWithTheQuaternionOfTheShorterTurn)
{
  const SceneDescription scene = sampled(R"({ "name": "left", "position": [0, 0, 0], "orientation": [1, 0, 0, 0] },
    { "name": "right", "rig": { "camera": "left", "orientation": [0.1, -0.99498743710662, 0, 0] } })")
                                   .scene;
  EXPECT_NEAR(scene.cameras[1].orientation.at(0).w, 0.1, 1e-9);
  EXPECT_NEAR(scene.cameras[1].orientation.at(0).x, -0.99498743710662, 1e-9);
}

TEST(CameraRig, FollowsAPathAtEveryFrame)
{
  const std::string orbit = R"({ "name": "left", "path": { "orbit": { "center": [0, 0, 0], "radius": 5, "elevation": 20,
    "azimuth": [10, 350], "frames": [2, 42], "every": 10 } } })";
  const SceneDescription scene = sampled(orbit + ", " + right).scene;
  const Rigid3 aside{ Eigen::Matrix3d::Identity(), { 0.1, 0, 0 } };
  ASSERT_EQ(scene.cameras[1].position.keys.size(), 41U);
  for (int frame = 0; frame <= 44; ++frame)
  {
    EXPECT_LT(offBy(scene, aside, frame), 1e-12) << frame;
  }
  for (std::size_t i = 1; i < scene.cameras[1].orientation.keys.size(); ++i)
  {
    EXPECT_GT(scene.cameras[1].orientation.keys[i].value.dot(scene.cameras[1].orientation.keys[i - 1].value), 0);
  }
}

TEST(CameraRig, WhatWasDrawnIsThatOfTheLastAttempt)
{
  const std::string ball = test::sourceFile("Data/Models/ball.ac");
  const Sampler sampler(
    RandomScene::ofText(R"({ "seed": 2, "objects": [ { "name": "ball", "model": ")" + ball +
                          R"(" } ], "cameras": [ { "name": "left", "orientation": { "rotation": "any" },
        "position": { "choice": [ { "inBox": [[3, 1, 3], [6, 5, 6]] }, { "inBox": [[-6, 1, 3], [-3, 5, 6]] } ] } },
      { "name": "right", "fovY": { "uniform": [40, 60] }, "rig": { "camera": "left" },
        "require": { "visible": { "ball": 0.9 }, "attempts": 1000 } } ] })",
      "."));
  int again = 0;
  for (std::uint64_t number = 0; number < 8; ++number)
  {
    std::vector<SampleValue> values;
    SampleWatch watch;
    watch.values = &values;
    again += sampler.draw(number, watch).notes.at(0).attempts > 1;
    std::vector<std::string> paths;
    paths.reserve(values.size());
    for (const SampleValue& value : values)
    {
      paths.push_back(value.path);
    }
    // The rotation, which of both places, the place, and the angle.
    EXPECT_EQ(paths.size(), 4U) << number << ": " << testing::PrintToString(paths);
  }
  EXPECT_GT(again, 4);
}

TEST(CameraRig, IsDrawnAgainTogether)
{
  // The left camera asks for nothing; the right one, which looks away from it, must see the ball.
  const std::string any = R"({ "name": "left", "position": [0, 0, 6], "orientation": { "rotation": "any" } })";
  const auto mounted = [](const std::string& more)
  {
    return R"(, { "name": "right", "rig": { "camera": "left", "orientation": [0, 0, 1, 0] },
      "require": { "visible": { "ball": 0.9 }, "pixels": 40)" +
           more + " } }";
  };
  const SceneSample found = sampled(any + mounted(R"(, "attempts": 1000)"));
  ASSERT_EQ(found.notes.size(), 1U);
  EXPECT_EQ(found.notes[0].path, "cameras/right/require");
  EXPECT_GT(found.notes[0].attempts, 1);
  Rigid3 back;
  back.rotation << -1, 0, 0, 0, 1, 0, 0, 0, -1;
  EXPECT_LT(offBy(found.scene, back, 0), 1e-12);
  EXPECT_GT(worldOf(found.scene.cameras[0], 0).rotation(2, 2), 0) << "it looks away from the ball";

  const std::string never = mounted(R"(, "attempts": 1)");
  int refused = 0;
  for (int number = 0; number < 8; ++number)
  {
    try
    {
      sampled(any + never, number);
    }
    catch (const SampleRefused& error)
    {
      EXPECT_EQ(error.path(), "cameras/right/require");
      ++refused;
    }
  }
  EXPECT_GT(refused, 4);
  const SceneSample out = sampled(any + mounted(R"(, "clearance": 100, "attempts": 2, "otherwise": "omit")") +
                                  R"(, { "name": "alone", "eye": [0, 0, 9], "lookAt": [0, 0, 0] })");
  ASSERT_EQ(out.scene.cameras.size(), 1U) << "they go together";
  EXPECT_EQ(out.scene.cameras[0].name, "alone");
  ASSERT_EQ(out.notes.size(), 2U);
  EXPECT_EQ(out.notes[0].path, "cameras/left/rig");
  EXPECT_FALSE(out.notes[0].kept || out.notes[1].kept);
  EXPECT_NE(out.notes[0].why.find("right"), std::string::npos);
  EXPECT_EQ(out.notes[1].path, "cameras/right/require");
}

TEST(CameraRig, SaysWhatIsWrong)
{
  const auto mounted = [](const std::string& name, const std::string& rig, const std::string& more = {})
  { return R"({ "name": ")" + name + R"(", "rig": { )" + rig + " }" + more + " }"; };
  const auto expect = [](const std::string& cameras, const std::string& path, const std::string& says)
  {
    const std::string line = refusal(cameras);
    EXPECT_NE(line.find(path), std::string::npos) << line;
    EXPECT_NE(line.find(says), std::string::npos) << line;
  };
  expect(left + ", " + mounted("r", R"("camera": "lest")"), "cameras[1].rig.camera", "names no camera");
  expect(left + ", " + mounted("r", R"("camera": { "choice": ["left"] })"), "cameras[1].rig.camera", "");
  expect(left + ", " + mounted("r", R"("position": [1, 0, 0])"), "cameras[1].rig", "camera");
  expect(mounted("a", R"("camera": "a")"), "cameras[0].rig.camera", "is mounted on itself");
  expect(left + ", " + mounted("a", R"("camera": "b")") + ", " + mounted("b", R"("camera": "a")"), ".rig.camera",
    "is mounted on itself");
  expect(left + ", " + mounted("r", R"("camera": "left", "offset": 1)"), "cameras[1].rig", "offset");
  expect(left + ", " + mounted("r", R"("camera": "left", "position": [1, 2])"), "cameras[1].rig.position", "");
  expect(left + ", " + mounted("r", R"("camera": "left", "orientation": [1, 1, 0, 0])"), "cameras[1].rig.orientation",
    "is not a rotation");
  expect(left + ", " + mounted("r", R"("camera": "left")", R"(, "eye": [0, 0, 1])"), "cameras[1].eye",
    "stands beside a rig");
  expect(left + ", " +
           mounted("r", R"("camera": "left")",
             R"(, "path": { "orbit": { "center": [0, 0, 0], "radius": 1, "frames": [0, 1] } })"),
    "cameras[1].path", "stands beside a rig");
}
