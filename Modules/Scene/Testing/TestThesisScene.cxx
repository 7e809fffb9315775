// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneSamples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <charconv>
#include <vector>

using namespace dgtk;
using namespace dgtk::test;
using Vector = Eigen::Vector3d;

namespace
{
/// Every number of a text, in order; digits within names count, so that names are compared, too.
std::vector<double> numbersOf(const std::string& text)
{
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at < end)
  {
    double value = 0;
    const auto result = std::from_chars(at, end, value);
    if (result.ec == std::errc())
    {
      numbers.push_back(value);
      at = result.ptr;
    }
    else
    {
      ++at;
    }
  }
  return numbers;
}

void expectRoundTrip(const std::string& text)
{
  const TemporaryFolder folder;
  const SceneDescription scene = readText(folder, "a.scene", text);
  writeScene(scene, folder.path("direct.scene"));
  writeScene(scene, folder.path("b.json"));
  writeScene(readScene(folder.path("b.json")), folder.path("c.scene"));
  const std::string direct = contentsOf(folder.path("direct.scene"));
  EXPECT_EQ(numbersOf(direct), numbersOf(text));
  EXPECT_EQ(contentsOf(folder.path("c.scene")), direct);
  // and once more, now byte for byte
  writeScene(readScene(folder.path("direct.scene")), folder.path("again.scene"));
  EXPECT_EQ(contentsOf(folder.path("again.scene")), direct);
}
} // namespace

TEST(ThesisScene, ExampleOfAppendixB3)
{
  const TemporaryFolder folder;
  const SceneDescription scene = readText(folder, "b3.scene", thesisExample);
  ASSERT_EQ(scene.objects.size(), 2u);
  ASSERT_EQ(scene.cameras.size(), 1u);
  EXPECT_EQ(scene.objects[0].model, "tuxedo.ac");
  EXPECT_EQ(scene.objects[0].name, "tuxedo-1");
  EXPECT_EQ(scene.objects[1].model, "world.ac");
  EXPECT_EQ(scene.resolve(scene.objects[1].model), folder.path("world.ac"));
  const CameraDescription& camera = scene.cameras[0];
  EXPECT_EQ(camera.name, "Camera0");
  EXPECT_EQ(camera.fovY.at(0), 60);
  EXPECT_EQ(camera.near, 0.1);
  EXPECT_EQ(camera.far, 1000);
  EXPECT_EQ(camera.aspect, 1.33);
  EXPECT_EQ(camera.eye.at(1), Vector(2.45, 0, -7.24999));
  EXPECT_EQ(camera.lookAt.at(2), Vector(-4.5, 0, 4.09998));
  EXPECT_EQ(camera.up.at(0), Vector(0, 1, 0));
  EXPECT_EQ(scene.keyFrames(), (std::vector<int>{ 0, 2 }));
  EXPECT_EQ(scene.firstFrame(), 0);
  EXPECT_EQ(scene.lastFrame(), 2);
  EXPECT_EQ(scene.objects[0].line, 2);
}

TEST(ThesisScene, ExampleSurvivesNumberForNumber) { expectRoundTrip(thesisExample); }

TEST(ThesisScene, EverythingItCanSaySurvives) { expectRoundTrip(richThesisScene); }

TEST(ThesisScene, KeepsTheOrderOfItsLines)
{
  const TemporaryFolder folder;
  const SceneDescription scene = readText(folder, "a.scene", richThesisScene);
  using Kind = SceneItem::Kind;
  const std::vector<SceneItem> expected{ { Kind::Light, 0 }, { Kind::Object, 0 }, { Kind::Camera, 0 },
    { Kind::Light, 1 }, { Kind::Object, 1 } };
  EXPECT_EQ(scene.items(), expected);
  EXPECT_EQ(scene.objects[0].model, "monsters/orc one.md2");
  EXPECT_EQ(scene.objects[0].scale.at(0), Vector(2, 2, 0.5));
  EXPECT_EQ(scene.objects[1].scale.at(0), Vector(1, 1, 1));
  EXPECT_EQ(scene.lights[0].name, "sun");
  EXPECT_EQ(scene.lights[0].diffuse.value, Vector(1, 0.9, 0.8));
  EXPECT_EQ(scene.lights[1].name, "Light0");
  EXPECT_EQ(scene.lights[1].position.at(7), Vector(0, 7, 8));
}

TEST(ThesisScene, IsTolerantOfBlanksCommasAndLineEnds)
{
  const std::string messy = "\xef\xbb\xbf  1\r\n\r\n GLOBJECT_ac :   a b.ac  \r\n 2\r\n0 <0,0 0>{1,<0 0,0>}\r\n"
                            "4\r\n\r\n< 1,\t2,\r\n3 > \\{ +1.0 < 0. .0 0e5 > \\}[1,1,1]\r\n\r\n";
  const TemporaryFolder folder;
  const SceneDescription scene = readText(folder, "a.SCENE", messy);
  ASSERT_EQ(scene.objects.size(), 1u);
  EXPECT_EQ(scene.objects[0].model, "a b.ac");
  EXPECT_EQ(scene.objects[0].position.at(4), Vector(1, 2, 3));
  std::string returns = messy;
  returns.erase(std::remove(returns.begin(), returns.end(), '\n'), returns.end());
  EXPECT_EQ(toJson(readText(folder, "b.scene", returns), ""), toJson(scene, ""));
}

TEST(ThesisScene, ScaleBegunLateWasOneBefore)
{
  const TemporaryFolder folder;
  const SceneDescription scene =
    readText(folder, "a.scene", "1\nglObject_AC: a.ac\n2\n0\n<0 0 0> {1 <0 0 0>}\n10\n<0 0 0> {1 <0 0 0>} [3 1 1]\n");
  EXPECT_EQ(scene.objects[0].scale.at(0), Vector(1, 1, 1));
  EXPECT_EQ(scene.objects[0].scale.at(5), Vector(2, 1, 1));
}

TEST(ThesisScene, StaticTracksAreRepeatedAtEveryKeyFrame)
{
  SceneDescription scene;
  scene.objects.resize(2);
  scene.objects[0].model = "a.ac";
  scene.objects[0].position.value = { 1, 2, 3 };
  scene.objects[1].model = "a.ac";
  scene.objects[1].position.keys = { { 3, Vector(0, 0, 0) }, { 5, Vector(2, 0, 0) } };
  EXPECT_EQ(toThesisScene(scene, ""), "2\nglObject_AC: a.ac\nglObject_AC: a.ac\n2\n"
                                      "3\n< 1 2 3 > { 1, < 0, 0, 0 > }\n< 0 0 0 > { 1, < 0, 0, 0 > }\n"
                                      "5\n< 1 2 3 > { 1, < 0, 0, 0 > }\n< 2 0 0 > { 1, < 0, 0, 0 > }\n");
}

TEST(ThesisScene, WhatStandsSomewhereHasAKeyFrame)
{
  const TemporaryFolder folder;
  SceneDescription scene;
  scene.lights.resize(1);
  scene.lights[0].position.value = { 1, 2, 3 };
  const std::string light = toThesisScene(scene, "");
  EXPECT_EQ(light, "1\nglObject_Light:\n1\n0\n< 1 2 3 > { 1, < 0, 0, 0 > }\n");
  EXPECT_EQ(readText(folder, "a.scene", light).lights.at(0).position.at(0), Vector(1, 2, 3));
  scene = {};
  scene.objects.resize(1);
  scene.objects[0].model = "a.ac";
  scene.objects[0].scale.value = { 2, 2, 2 };
  EXPECT_EQ(readText(folder, "b.scene", toThesisScene(scene, "")).objects.at(0).scale.at(0), Vector(2, 2, 2));
  scene.objects[0].scale.value = { 1, 1, 1 };
  EXPECT_EQ(toThesisScene(scene, ""), "1\nglObject_AC: a.ac\n0\n");
}

TEST(ThesisScene, AFileWithoutKeyFramesStaysOne)
{
  expectRoundTrip("1\nglObject_Camera: ( 60, 0.1, 1000, 0 )\n[ 0 0 5, 0 0 0, 0 1 0 ]\n0\n");
  expectRoundTrip("0\n2\n0\n10\n");
}
