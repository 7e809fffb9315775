// SPDX-License-Identifier: BSD-3-Clause
// Cameras of a model that has parameters of its own; they begin with "odd".
#include "dgtkSceneSamples.h"

#include "dgtkCameraEntry.h"
#include "dgtkError.h"
#include "dgtkStrangeCamera.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace dgtk;
using namespace dgtk::test;
using testing::HasSubstr;

namespace
{
std::shared_ptr<const CameraModel> makeStrange(const CameraParameters& of)
{
  if (of.number("oddXi") == 3)
  {
    throw UsageError("oddXi is 3");
  }
  return std::make_shared<StrangeCamera>(of);
}

CameraEntry entry()
{
  CameraParameter xi{ "oddXi", "", "a number that moves", { 0, 5, false, false, "a number from 0 to 5" }, { 1 } };
  xi.moves = true;
  CameraParameter still{ "oddStill", "", "a number", { 0, 5, false, false, "a number from 0 to 5" }, { 0 } };
  CameraParameter list{ "oddList", "", "a list", { -1, 1, false, false, "a number from -1 to 1" }, { 0, 0, 0, 0 } };
  list.counts = { 4, 5, 8, 12, 14 };
  CameraParameter file{ "oddFile", "", "a file" };
  file.kind = CameraParameter::Kind::File;
  return { { xi, still, list, file, fieldOfViewParameter() }, &makeStrange };
}

const CameraEntry strange = entry();
const bool added = addCamera({ "strange", "for a test", &strange });

std::string sceneWith(const std::string& keys)
{
  return "{\"version\": 1, \"cameras\": [\n{\"model\": \"strange\", \"oddFile\": \"a.npy\", \"eye\": [0, 0, 9], "
         "\"lookAt\": [0, 0, 0]" +
         (keys.empty() ? "" : ", " + keys) + "}]}";
}
} // namespace

TEST(SceneCameras, ParametersOfAModelAreReadAndWritten)
{
  ASSERT_TRUE(added);
  const TemporaryFolder folder;
  const std::string keys = "\"oddStill\": 2, \"fovY\": 90, \"oddList\": [0.1, 0, 0, 0, -0.5], "
                           "\"oddXi\": {\"keys\": [[0, 1], [10, 2]]}";
  std::string text = sceneWith(keys);
  for (int time = 0; time < 2; ++time) // as read, and as read from what is written
  {
    const SceneDescription scene = readText(folder, "a.json", text);
    const CameraDescription& camera = scene.cameras.at(0);
    EXPECT_EQ(camera.model, "strange");
    EXPECT_EQ(camera.parameters.at("oddFile").file, "a.npy");
    EXPECT_EQ(scene.keyFrames(), (std::vector<int>{ 0, 10 })) << "its track counts";
    const CameraParameters of = cameraParameters(camera, 5, 8, 6, folder.path());
    EXPECT_EQ(of.number("oddXi"), 1.5);
    EXPECT_EQ(of.number("oddStill"), 2);
    EXPECT_EQ(of.number("fovY"), 90);
    EXPECT_EQ(of.numbers.at("oddList"), (std::vector<double>{ 0.1, 0, 0, 0, -0.5 }));
    EXPECT_EQ(of.numbers.count("viewHeight"), 0u);
    EXPECT_EQ(of.files.at("oddFile"), folder.path("a.npy"));
    text = toJson(scene, folder.path());
    EXPECT_THAT(text, HasSubstr("\"oddList\": [0.1, 0, 0, 0, -0.5]"));
  }
  const SceneDescription usual = readText(folder, "a.json", sceneWith("\"oddXi\": 1, \"oddList\": [0, 0, 0, 0]"));
  EXPECT_EQ(toJson(usual, folder.path()).find("oddXi"), std::string::npos) << "only what is not usual";
  EXPECT_EQ(toJson(usual, folder.path()).find("oddList"), std::string::npos);
}

TEST(SceneCameras, FilesMoveWithTheScene)
{
  const TemporaryFolder folder;
  makeFolders(folder.path("deep"));
  writeScene(readText(folder, "a.json", sceneWith("")), folder.path("deep/b.json"));
  EXPECT_EQ(readScene(folder.path("deep/b.json")).cameras.at(0).parameters.at("oddFile").file, "../a.npy");
}

TEST(SceneCameras, FilesAreNotOpenedYet)
{
  const TemporaryFolder folder;
  const SceneDescription scene = readText(folder, "a.json",
    "{\"cameras\": [{\"model\": \"raytable\", \"rays\": \"none.npy\", \"eye\": [0, 0, 9], \"lookAt\": [0, 0, 0]}]}");
  EXPECT_EQ(scene.cameras.at(0).parameters.at("rays").file, "none.npy");
}

// Of motions of more than 20000 frames only the keys are looked at.
TEST(SceneCameras, PosesAreCheckedAtAllFramesOfAMotion)
{
  const auto refusal = [](int last)
  {
    return refusalOf("a.json", "{\"cameras\": [{\"eye\": {\"keys\": [[0, [0, 0, 5]], [" + std::to_string(last) +
                                 ", [0, 0, -5]]]}, \"lookAt\": [0, 0, 0]}]}");
  };
  EXPECT_THAT(refusal(20000), testing::HasSubstr("is the eye itself at frame 10000"));
  EXPECT_EQ(refusal(20002), "");
}

TEST(SceneCameras, MatricesAreOfOneForm)
{
  const auto refusal = [](const std::string& rows)
  {
    return refusalOf("a.json", "{\"cameras\": [{\"width\": 9, \"height\": 9, \"K\": [" + rows +
                                 "], \"eye\": [0, 0, 9], \"lookAt\": [0, 0, 0]}]}");
  };
  EXPECT_EQ(refusal("[5, 1, 4], [0, 6, 3], [0, 0, 1]"), "");
  for (const char* rows :
    { "[0, 1, 4], [0, 6, 3], [0, 0, 1]", "[5, 1, 4], [0, -6, 3], [0, 0, 1]", "[5, 1, 4], [1, 6, 3], [0, 0, 1]",
      "[5, 1, 4], [0, 6, 3], [1, 0, 1]", "[5, 1, 4], [0, 6, 3], [0, 1, 1]", "[5, 1, 4], [0, 6, 3], [0, 0, 2]" })
  {
    EXPECT_THAT(refusal(rows), testing::HasSubstr("expected [[fx, s, cx], [0, fy, cy], [0, 0, 1]]")) << rows;
  }
}

TEST(SceneCameras, WhatAModelDoesNotHaveIsRefused)
{
  const std::pair<std::string, std::string> table[] = {
    { "\"oddYi\": 1", "a.json:2: cameras[0].oddYi is an unknown key (expected perhaps 'oddXi', found 'oddYi')" },
    { "\"oddXi\": 6", "a.json:2: cameras[0].oddXi is out of range (expected a number from 0 to 5, found 6)" },
    { "\"oddXi\": {\"keys\": [[0, 1], [4, -1]]}", "cameras[0].oddXi.keys[1][1] is out of range" },
    { "\"oddStill\": {\"keys\": [[0, 1]]}", "cameras[0].oddStill has the wrong type (expected a number from 0 to 5" },
    { "\"oddList\": 1", "cameras[0].oddList has the wrong type" },
    { "\"oddList\": [1, 1]", "cameras[0].oddList has the wrong length (expected 4, 5, 8, 12 or 14 numbers, found 2)" },
    { "\"oddList\": [0, 0, 2, 0]", "cameras[0].oddList[2] is out of range (expected a number from -1 to 1" },
    { "\"viewHeight\": 2",
      "cameras[0].viewHeight is not for a camera of the model 'strange' (expected oddXi, oddStill, " },
    { "\"lens\": {\"aperture\": 1}", "cameras[0].lens is not for this camera" },
  };
  for (const auto& [keys, expected] : table)
  {
    EXPECT_THAT(refusalOf("a.json", sceneWith(keys)), HasSubstr(expected)) << keys;
  }
  std::string pinhole = sceneWith("");
  pinhole.replace(pinhole.find("strange"), 7, "pinhole");
  EXPECT_THAT(refusalOf("a.json", pinhole),
    HasSubstr("cameras[0].oddFile is not for a camera of the model 'pinhole' (expected fovY, aspect, K, "));
  std::string unknown = sceneWith("");
  unknown.replace(unknown.find("strange"), 7, "unknown");
  EXPECT_THAT(refusalOf("a.json", unknown), HasSubstr("cameras[0].model is not known (expected one of pinhole, "));
}

TEST(SceneCameras, WhatDoesNotGoTogetherIsRefusedWithTheScene)
{
  SceneDescription scene;
  scene.cameras.resize(1);
  scene.cameras[0].model = "strange";
  scene.cameras[0].parameters["oddXi"].numbers = { 3.0 };
  EXPECT_THROW(validate(scene), InputError) << "it has no file";
  const auto message = [&]
  {
    return thrownBy<InputError>(
      [&]
      {
        nameAll(scene);
        validate(scene);
      });
  };
  EXPECT_THAT(
    message(), HasSubstr("camera 'Camera0': model cannot be: a camera of the model 'strange' needs 'oddFile'"));
  scene.cameras[0].parameters["other"].numbers = { 3.0 };
  EXPECT_THAT(message(), HasSubstr("camera 'Camera0': other is an unknown key"));
  scene.cameras[0].model = "none";
  EXPECT_THAT(message(), HasSubstr("camera 'Camera0': model is not known"));
}

/// What each model is made with in an image of another size, at a frame between keys.
TEST(SceneCameras, ParametersAreThoseOfTheFrameAndTheSize)
{
  CameraDescription camera;
  camera.fovY.keys = { { 0, 40 }, { 10, 60 } };
  camera.viewHeight.keys = { { 0, 2 }, { 10, 4 } };
  camera.aspect = 1.5;
  using Numbers = std::map<std::string, std::vector<double>>;
  CameraParameters made = cameraParameters(camera, 5, 320, 240);
  EXPECT_EQ(made.width, 320);
  EXPECT_EQ(made.height, 240);
  EXPECT_FALSE(made.K);
  EXPECT_EQ(made.numbers, (Numbers{ { "fovY", { 50 } }, { "aspect", { 1.5 } } }));
  camera.model = "orthographic";
  made = cameraParameters(camera, 5, 320, 240);
  EXPECT_EQ(made.numbers, (Numbers{ { "viewHeight", { 3 } }, { "aspect", { 1.5 } } }));
  camera.model = "pinhole";
  camera.width = 200;
  camera.height = 100;
  camera.K = Eigen::Matrix3d::Zero();
  *camera.K << 80, 0.5, 90, 0, 70, 40, 0, 0, 1;
  made = cameraParameters(camera, 5, 600, 150);
  ASSERT_TRUE(made.K);
  Eigen::Matrix3d expected;
  expected << 240, 1.5, 270, 0, 105, 60, 0, 0, 1;
  EXPECT_EQ(*made.K, expected);
  EXPECT_EQ(made.numbers, Numbers{}) << "K says them";
  camera.model = "strange";
  camera.K.reset();
  camera.parameters["oddXi"].numbers.resize(1);
  camera.parameters["oddXi"].numbers[0].keys = { { 0, 1 }, { 10, 2 } };
  camera.parameters["oddFile"].file = "rays.npy";
  made = cameraParameters(camera, 5, 320, 240, "/scenes");
  EXPECT_EQ(made.numbers.at("oddXi"), std::vector<double>{ 1.5 });
  EXPECT_EQ(made.numbers.at("fovY"), std::vector<double>{ 50 });
  EXPECT_EQ(made.files, (std::map<std::string, std::string>{ { "oddFile", "/scenes/rays.npy" } }));
  // A smooth curve stays between its keys, as it would leave what a model may have otherwise.
  const std::vector<Key<double>> steep{ { 0, 20 }, { 10, 170 }, { 20, 170 }, { 30, 20 } };
  for (Track<double>* track : { &camera.fovY, &camera.viewHeight, &camera.parameters["oddXi"].numbers[0] })
  {
    track->keys = steep;
    track->interpolation = Interpolation::Smooth;
    ASSERT_GT(track->at(15), 180);
  }
  EXPECT_EQ(cameraParameters(camera, 15, 320, 240).numbers.at("fovY"), std::vector<double>{ 170 });
  EXPECT_EQ(cameraParameters(camera, 15, 320, 240).numbers.at("oddXi"), std::vector<double>{ 170 });
  camera.model = "orthographic";
  EXPECT_EQ(cameraParameters(camera, 15, 320, 240).numbers.at("viewHeight"), std::vector<double>{ 170 });
}
