// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampler.h"

#include "dgtkFile.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

using namespace dgtk;
using testing::HasSubstr;

namespace
{
/// A camera on a path, as it is sampled; `members` of the camera besides it.
CameraDescription onPath(const std::string& path, const std::string& members = "", const std::string& up = "y")
{
  const std::string json = "{\"seed\": 2, \"upAxis\": \"" + up + "\", \"cameras\": [{\"name\": \"c\", \"path\": {" +
                           path + "}" + members + "}]}";
  return Sampler(RandomScene::ofText(json, ".")).draw(0).scene.cameras.at(0);
}

std::string refusalOfPath(const std::string& path, const std::string& members = "")
{
  return test::thrownBy<Error>([&] { onPath(path, members); });
}

void expectNear(const Eigen::Vector3d& found, const Eigen::Vector3d& expected)
{
  EXPECT_LE((found - expected).norm(), 1e-12) << found.transpose() << " for " << expected.transpose();
}

std::vector<int> framesOfKeys(const Track<Eigen::Vector3d>& track)
{
  std::vector<int> frames;
  for (const auto& key : track.keys)
  {
    frames.push_back(key.frame);
  }
  return frames;
}
} // namespace

// y is up: longitude 0 is +z, 90 degrees +x.
TEST(CameraPath, OrbitsGoAroundOnceAtTheHeightOfTheirCentre)
{
  const CameraDescription camera = onPath("\"orbit\": {\"center\": [1, 2, 3], \"radius\": [5, 9], \"frames\": [0, 4]}");
  EXPECT_EQ(framesOfKeys(camera.eye), (std::vector<int>{ 0, 1, 2, 3, 4 }));
  expectNear(camera.eye.at(0), { 1, 2, 8 });
  expectNear(camera.eye.at(1), { 7, 2, 3 });
  expectNear(camera.eye.at(2), { 1, 2, -4 });
  expectNear(camera.eye.at(3), { -7, 2, 3 });
  expectNear(camera.eye.at(4), { 1, 2, 12 });
  expectNear(camera.lookAt.at(3), { 1, 2, 3 });
}

// z is up: longitude 0 is +x, 90 degrees +y.
TEST(CameraPath, OrbitsGoAroundWhatIsUpInTheScene)
{
  const CameraDescription camera =
    onPath("\"orbit\": {\"center\": [1, 2, 3], \"radius\": 5, \"elevation\": [0, 60], \"frames\": [0, 4]}", "", "z");
  expectNear(camera.eye.at(0), { 6, 2, 3 });
  expectNear(camera.eye.at(1), { 1, 2 + 5 * std::cos(M_PI / 12), 3 + 5 * std::sin(M_PI / 12) });
  expectNear(camera.eye.at(2), { 1 - 5 * std::cos(M_PI / 6), 2, 5.5 });
  expectNear(camera.eye.at(4), { 3.5, 2, 3 + 5 * std::sin(M_PI / 3) });
}

TEST(CameraPath, OrbitsMayRiseAndTurnAsFarAsTheySay)
{
  const CameraDescription camera = onPath("\"orbit\": {\"center\": [0, 0, 0], \"radius\": 2, \"elevation\": [0, 60], "
                                          "\"azimuth\": [90, -90], \"frames\": [3, 8], "
                                          "\"every\": 2}",
    ", \"lookAt\": [7, 7, 7]");
  EXPECT_EQ(framesOfKeys(camera.eye), (std::vector<int>{ 3, 5, 7, 8 }));
  expectNear(camera.eye.at(3), { 2, 0, 0 });
  expectNear(camera.eye.at(8), { -1, std::sqrt(3.0), 0 });
  const double turn = (90 - 2 * 36) * M_PI / 180; // two fifths of the way
  const double height = 24 * M_PI / 180;
  expectNear(camera.eye.at(5),
    { 2 * std::sin(turn) * std::cos(height), 2 * std::sin(height), 2 * std::cos(turn) * std::cos(height) });
  expectNear(camera.lookAt.at(5), { 7, 7, 7 });
  for (const char* pole : { "90", "-90", "[0, 90]" })
  {
    EXPECT_THAT(refusalOfPath("\"orbit\": {\"center\": [0, 0, 0], \"radius\": 2, \"frames\": [0, 4], \"elevation\": " +
                              std::string(pole) + "}"),
      HasSubstr("degrees between -90 and 90"))
      << pole;
  }
}

TEST(CameraPath, CurvesThroughPointsOfALineAreTheLine)
{
  for (const char* points : { "[[0, 1, 0], [10, 1, 0]]", "[[0, 1, 0], [2, 1, 0], [3, 1, 0], [10, 1, 0]]" })
  {
    const CameraDescription camera =
      onPath("\"spline\": {\"frames\": [0, 4], \"points\": " + std::string(points) + "}");
    for (int frame = 0; frame <= 4; ++frame)
    {
      expectNear(camera.eye.at(frame), { 2.5 * frame, 1, 0 });
      expectNear(camera.lookAt.at(frame), { 2.5 * frame + 1, 1, 0 });
    }
  }
}

// The view is along the curve: that from the place before to the one behind it.
TEST(CameraPath, CurvesAreLookedAlong)
{
  const CameraDescription camera =
    onPath("\"spline\": {\"frames\": [0, 1000], \"points\": [[0, 0, 0], [1, 0, 0], [1, 0, 1], [3, 2, 1]]}");
  for (int frame = 1; frame < 1000; ++frame)
  {
    const Eigen::Vector3d along = (camera.eye.at(frame + 1) - camera.eye.at(frame - 1)).normalized();
    ASSERT_LE((camera.lookAt.at(frame) - camera.eye.at(frame) - along).norm(), 0.01) << frame;
  }
  const std::string there = "\"spline\": {\"frames\": [0, 2], \"points\": [[0, 0, 0], [1, 0, 0], [0, 0, 0]]}";
  EXPECT_THAT(refusalOfPath(there), HasSubstr("stands still")) << "where it turns back";
  EXPECT_EQ(refusalOfPath(there, ", \"lookAt\": [0, 0, 5]"), "");
}

TEST(CameraPath, WalksTurnAndGoAsFarAsTheySayInAFrame)
{
  for (const std::string level : { "true", "false" })
  {
    const CameraDescription camera =
      onPath("\"walk\": {\"box\": [[-100, -100, -100], [100, 100, 100]], \"start\": [1, 2, 3], \"speed\": 0.25, "
             "\"turn\": 20, \"level\": " +
             level + ", \"frames\": [0, 300]}");
    double most = 0;
    double height = 0;
    for (int frame = 1; frame < 300; ++frame)
    {
      const Eigen::Vector3d before = camera.eye.at(frame) - camera.eye.at(frame - 1);
      const Eigen::Vector3d step = camera.eye.at(frame + 1) - camera.eye.at(frame);
      ASSERT_NEAR(step.norm(), 0.25, 1e-12) << frame;
      most = std::max(most, std::atan2(before.cross(step).norm(), before.dot(step)) * 180 / M_PI);
      height = std::max(height, std::abs(step.y()));
    }
    EXPECT_LE(most, 20 + 1e-9) << level;
    EXPECT_GE(most, 19) << level;
    EXPECT_EQ(height == 0, level == "true");
    expectNear(camera.eye.at(0), { 1, 2, 3 });
  }
}

// A wall across x, at 9, 6.5, 4 and 1.5 at the frames.
TEST(CameraPath, WalksKeepClearOfWhatComesTowardsThem)
{
  const test::TemporaryFolder folder;
  writeFile(folder.path("wall.obj"), "v 0 -50 -50\nv 0 50 -50\nv 0 50 50\nv 0 -50 50\nf 1 2 3 4\n");
  const std::string json = R"({"seed": 2, "objects": [{"name": "wall", "model": "wall.obj",
    "position": {"keys": [[0, [9, 0, 0]], [3, [1.5, 0, 0]]]}}], "cameras": [{"name": "c", "path": {"walk": {
    "box": [[-9, -9, -9], [9, 9, 9]], "start": [0, 0, 0], "speed": 1, "turn": 180, "clearance": 1,
    "frames": [0, 3]}}}]})";
  Sampler sampler(RandomScene::ofText(json, folder.path()));
  for (int sample = 0; sample < 20; ++sample)
  {
    const CameraDescription camera = sampler.draw(sample).scene.cameras.at(0);
    for (int frame = 0; frame <= 3; ++frame)
    {
      EXPECT_LE(camera.eye.at(frame).x(), 9 - 2.5 * frame - 1 + 1e-6) << sample << ' ' << frame;
    }
  }
}

// Of the objects one is too large for its place, one has no instances, one is there.
TEST(CameraPath, NamesOfObjectsThatAreNotInTheSampleRefuseIt)
{
  const test::TemporaryFolder folder;
  writeFile(folder.path("wall.obj"), "v 0 -5 -5\nv 0 5 -5\nv 0 5 5\nv 0 -5 5\nf 1 2 3 4\n");
  const auto sampled = [&](const std::string& camera)
  {
    const std::string json = R"({"objects": [{"name": "here", "model": "wall.obj", "position": [1, 2, 3]},
      {"name": "big", "model": "wall.obj", "place": {"in": [[0, 0, 0], [1, 1, 1]]}},
      {"name": "none", "model": "wall.obj", "count": {"integer": [0, 0]}}, {"name": "on", "parent": "none",
      "model": "wall.obj"}], "cameras": [{"name": "a~b", )" +
                             camera + "}]}";
    return Sampler(RandomScene::ofText(json, folder.path())).draw(0);
  };
  const auto refusal = [&](const std::string& camera)
  { return test::thrownBy<SampleRefused>([&] { sampled(camera); }); };
  const std::string walk = R"("walk": {"box": [[0, 0, 0], [9, 9, 9]], "speed": 1, "frames": [0, 2], "start": )";
  for (const auto& [name, why] : { std::pair<std::string, std::string>{ "\"big\"", "'big' is left out of the sample" },
         { "\"none*\"", "'none*' has no instance in this sample" },
         { "\"on#2\"", "'on#2' has no instance in this sample" } })
  {
    for (const std::string& path : { R"("orbit": {"radius": 5, "frames": [0, 2], "center": )" + name + "}",
           R"("spline": {"frames": [0, 2], "points": [[0, 0, 0], )" + name + "]}", walk + name + "}" })
    {
      EXPECT_EQ(refusal("\"path\": {" + path + "}"), "cameras/a~0b/path: " + why) << path;
      const SceneSample sample = sampled("\"path\": {" + path + R"(, "otherwise": "omit"})");
      EXPECT_TRUE(sample.scene.cameras.empty());
      EXPECT_EQ(sample.notes.back().path, "cameras/a~0b/path");
    }
    EXPECT_EQ(refusal("\"eye\": [9, 9, 9], \"lookAt\": " + name), "cameras/a~0b/lookAt: " + why);
  }
  const auto curve = [&](const std::string& name)
  { return sampled(R"("path": {"spline": {"frames": [0, 2], "points": [[0, 0, 0], ")" + name + "\"]}}"); };
  expectNear(curve("here").scene.cameras.at(0).eye.at(2), { 1, 2, 3 });
  for (const std::string name : { "nobody", "here#1" })
  {
    EXPECT_THAT(
      test::thrownBy<InputError>([&] { curve(name); }), HasSubstr("cameras[0].path.spline.points[1] names no object"));
  }
}

// Outside of objects, lights and cameras a refusal has the scene's own word; a count that is not drawn is wrong always.
TEST(CameraPath, NamesThatAreMissingElsewhere)
{
  const test::TemporaryFolder folder;
  writeFile(folder.path("wall.obj"), "v 0 -5 -5\nv 0 5 -5\nv 0 5 5\nv 0 -5 5\nf 1 2 3 4\n");
  const auto draw = [&](const std::string& count, const std::string& more)
  {
    const std::string json = R"({"parameters": {"n": 0, "d": {"integer": [0, 0]}}, "objects": [{"name": "cup", "model":
      "wall.obj", "count": )" +
                             count + "}], " + more + '}';
    Sampler(RandomScene::ofText(json, folder.path())).draw(0);
  };
  const std::string fog = R"("fog": {"color": {"keys": [{"frame": 0, "value": {"centerOf": "cup"}}]}})";
  const std::string lookAt = R"("cameras": [{"name": "a", "eye": [9, 9, 9], "lookAt": "cup"}])";
  const std::string visible = R"("cameras": [{"name": "a", "eye": [9, 9, 9], "lookAt": [0, 0, 0], "require":
    {"visible": {"cup*": 0.5}, "attempts": 2}}])";
  for (const char* drawn : { R"({"integer": [0, 0]})", R"("$d")" })
  {
    EXPECT_EQ(test::thrownBy<SampleRefused>([&] { draw(drawn, visible); }),
      "cameras/a/require: 'cup*' has no instance in this sample");
    const std::string why = "'cup' has no instance in this sample";
    EXPECT_EQ(test::thrownBy<SampleRefused>([&] { draw(drawn, fog); }), "fog: " + why);
    EXPECT_EQ(test::thrownBy<SampleRefused>([&] { draw(drawn, lookAt); }), "cameras/a/lookAt: " + why);
  }
  for (const char* fixed : { "0", R"("$n")" })
  {
    for (const std::string& one : { lookAt, visible })
    {
      EXPECT_THAT(test::thrownBy<InputError>([&] { draw(fixed, one); }),
        HasSubstr("names an object whose count is 0 (expected one of which there are some, found 'cup"))
        << fixed;
    }
  }
}

TEST(CameraPath, PointsOfACurveAreApart)
{
  const auto refusal = [](const std::string& points)
  { return refusalOfPath("\"spline\": {\"frames\": [0, 2], \"points\": [" + points + "]}"); };
  EXPECT_THAT(refusal("[0, 0, 0]"), HasSubstr("makes no curve (expected 2 to 10000 points, found 1)"));
  EXPECT_THAT(refusal("[0, 0, 0], [0, 0, 0]"), HasSubstr("points[1] is where the point before is"));
  EXPECT_THAT(refusal("[0, 0, 0], [1, 0, 0], [1, 0, 0]"), HasSubstr("points[2] is where the point before is"));
  EXPECT_THAT(refusalOfPath("\"spline\": {\"frames\": [2, 2], \"points\": [[0, 0, 0], [1, 0, 0]]}"),
    HasSubstr("is empty (expected [first, last], found 2, 2)"));
  EXPECT_THAT(refusalOfPath("\"otherwise\": \"omit\""), HasSubstr("found 0 of them"));
}
