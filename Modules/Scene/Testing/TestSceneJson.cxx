// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneFromText.h"
#include "dgtkSceneSamples.h"

#include <gtest/gtest.h>

#include <filesystem>

using namespace dgtk;
using namespace dgtk::test;
using Vector = Eigen::Vector3d;

TEST(SceneJson, ReadsEveryKey)
{
  const TemporaryFolder folder;
  const SceneDescription scene = readText(folder, "rich.json", richJson);
  EXPECT_EQ(scene.units, "m");
  EXPECT_EQ(scene.upAxis, UpAxis::Z);
  EXPECT_EQ(scene.fps, 12.5);
  EXPECT_EQ(scene.background.value, Vector(0.25, 0.5, 1));
  EXPECT_EQ(scene.seed, 9007199254740991u);
  EXPECT_EQ(scene.keyFrames(), (std::vector<int>{ 0, 3, 4, 9, 10, 30, 50 }));
  ASSERT_EQ(scene.objects.size(), 2u);
  const ObjectDescription& table = scene.objects[0];
  EXPECT_EQ(table.className, "furniture");
  EXPECT_FALSE(table.visible.value);
  EXPECT_EQ(table.scale.at(0), Vector(2, 2, 2));
  EXPECT_EQ(table.line, 12);
  const ObjectDescription& orc = scene.objects[1];
  EXPECT_EQ(orc.name, "orc-1");
  EXPECT_EQ(orc.parent, "table");
  EXPECT_EQ(orc.position.interpolation, Interpolation::Smooth);
  EXPECT_EQ(orc.position.at(10), Vector(1, 0, 0));
  EXPECT_EQ(orc.orientation.at(3.9), (Quaternion{ 1, 0, 0, 0 }));
  EXPECT_EQ(orc.scale.value, Vector(1, 2, 3));
  EXPECT_EQ(orc.scale.at(8), Vector(1, 1, 1));
  EXPECT_EQ(orc.scale.keys[0].interpolation, Interpolation::Step);
  EXPECT_FALSE(orc.scale.keys[1].interpolation);
  EXPECT_EQ(orc.animation.sequence, "run");
  EXPECT_EQ(orc.animation.start, 2.5);
  EXPECT_EQ(orc.animation.rate, 0.5);
  EXPECT_FALSE(orc.animation.loop);
  ASSERT_EQ(orc.materials.size(), 2u);
  EXPECT_EQ(orc.materials[0].material, "*");
  EXPECT_EQ(orc.materials[0].diffuse->value, Vector(1, 0, 0));
  EXPECT_EQ(orc.materials[1].opacity->value, 0.5);
  EXPECT_EQ(*orc.materials[1].texture, "textures/a.png");
  EXPECT_EQ(orc.skin, "2");
  ASSERT_EQ(scene.lights.size(), 4u);
  EXPECT_EQ(scene.lights[0].kind, LightKind::Directional);
  EXPECT_EQ(scene.lights[1].name, "Light0");
  EXPECT_EQ(scene.lights[1].attenuation, Vector(1, 0.5, 0.25));
  EXPECT_FALSE(scene.lights[1].enabled.value);
  ASSERT_EQ(scene.cameras.size(), 3u);
  EXPECT_TRUE(scene.cameras[0].posed);
  EXPECT_EQ((*scene.cameras[0].K)(1, 2), 480.25);
  EXPECT_EQ(scene.cameras[1].fovY.at(25), 40);
  EXPECT_EQ(scene.cameras[1].up.at(0), Vector(0, 1, 0));
  EXPECT_EQ(scene.cameras[2].model, "orthographic");
  EXPECT_EQ(scene.cameras[2].up.at(0), Vector(0, 0, 1)); // the default of a z-up scene
  EXPECT_EQ(scene.items()[0].kind, SceneItem::Kind::Camera);
}

TEST(SceneJson, CanonicalTextIsAFixedPoint)
{
  const TemporaryFolder folder;
  const std::string once = toJson(readText(folder, "rich.json", richJson), folder.path());
  EXPECT_EQ(once.back(), '\n');
  EXPECT_EQ(once[once.size() - 2], '}');
  EXPECT_EQ(toJson(readText(folder, "again.json", once), folder.path()), once);
}

TEST(SceneJson, WritesOnlyWhatIsNotTheDefault)
{
  SceneDescription scene;
  EXPECT_EQ(toJson(scene, ""), "{\n  \"version\": 1\n}\n");
  scene.cameras.resize(1);
  EXPECT_EQ(toJson(scene, ""),
    "{\n  \"version\": 1,\n  \"cameras\": [\n    {\n      \"name\": \"Camera0\",\n      \"eye\": [0, 0, 10],\n"
    "      \"lookAt\": [0, 0, 0]\n    }\n  ]\n}\n");
}

TEST(SceneJson, NumbersAreTheShortestThatReadBack)
{
  const TemporaryFolder folder;
  SceneDescription scene;
  scene.objects.resize(1);
  scene.objects[0].model = "a.ac";
  const Vector values(0.1 + 0.2, 1.0 / 3, -5e-324);
  scene.objects[0].position.value = values;
  scene.objects[0].scale.value = Vector(1e-7, 123456789012, 100000);
  const std::string text = toJson(scene, "");
  EXPECT_NE(text.find("[0.30000000000000004, 0.3333333333333333, -5e-324]"), std::string::npos) << text;
  EXPECT_NE(text.find("[1e-07, 123456789012, 100000]"), std::string::npos) << text;
  EXPECT_EQ(readText(folder, "a.json", text).objects[0].position.value, values);
}

TEST(SceneJson, RewritesRelativePaths)
{
  const TemporaryFolder folder;
  makeFolders(folder.path("deep/er"));
  SceneDescription scene = readText(folder, "a.json",
    R"({"objects": [{"model": "models/a.ac"}, {"model": "/abs/b.ac"},
      {"model": "../c.ac", "materials": {"*": {"texture": "t/x.png"}}}]})");
  writeScene(scene, folder.path("deep/er/b.json"));
  const SceneDescription moved = readScene(folder.path("deep/er/b.json"));
  EXPECT_EQ(moved.objects[0].model, "../../models/a.ac");
  EXPECT_EQ(moved.objects[1].model, "/abs/b.ac");
  EXPECT_EQ(moved.objects[2].model, "../../../c.ac");
  EXPECT_EQ(*moved.objects[2].materials[0].texture, "../../t/x.png");
  writeScene(moved, folder.path("c.json"));
  EXPECT_EQ(readScene(folder.path("c.json")).objects[2].model, "../c.ac");
}

TEST(SceneJson, ANameIsFoundForEverything)
{
  const TemporaryFolder folder;
  const SceneDescription scene = readText(folder, "a.json",
    R"({"objects": [{"model": "m/tree.ac"}, {"model": "tree.ac", "name": "tree-1"}, {"model": "tree.ac"}]})");
  EXPECT_EQ(scene.objects[0].name, "tree-2");
  EXPECT_EQ(scene.objects[1].name, "tree-1");
  EXPECT_EQ(scene.objects[2].name, "tree-3");
}

TEST(SceneJson, ARefusedWriteLeavesWhatWasThere)
{
  const TemporaryFolder folder;
  writeFile(folder.path("a.json"), "precious");
  SceneDescription scene;
  scene.objects.resize(1);
  scene.objects[0].model = "a.ac";
  scene.objects[0].scale.value = Vector(1, 0, 1);
  EXPECT_THROW(writeScene(scene, folder.path("a.json")), InputError);
  EXPECT_EQ(contentsOf(folder.path("a.json")), "precious");
  EXPECT_THROW(writeScene(SceneDescription(), folder.path("a.txt")), UsageError);
  EXPECT_THROW(writeScene(SceneDescription(), folder.path("no/such/a.json")), MachineError);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(SceneJson, IsWrittenWhereALinkLeadsAndKeepsTheModeOfTheFile)
{
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  writeFile(folder.path("real.json"), "{}");
  fs::permissions(folder.path("real.json"), fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("real.json", folder.path("link.json"));
  const SceneDescription scene = readText(folder, "a.json", R"({"objects": [{"model": "m/a.ac"}]})");
  writeScene(scene, folder.path("link.json"));
  EXPECT_TRUE(fs::is_symlink(folder.path("link.json")));
  EXPECT_EQ(contentsOf(folder.path("real.json")), toJson(scene, folder.path()));
  EXPECT_EQ(fs::status(folder.path("real.json")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  makeFolders(folder.path("other"));
  writeFile(folder.path("other/real.json"), "{}");
  fs::create_symlink("other/real.json", folder.path("away.json"));
  EXPECT_THAT(thrownBy<MachineError>([&] { writeScene(scene, folder.path("away.json")); }),
    HasSubstr("is a link into another folder"));
  EXPECT_EQ(contentsOf(folder.path("other/real.json")), "{}");
}

TEST(SceneJson, ClassesKeepTheirNumbersAndTheirFile)
{
  const TemporaryFolder folder;
  makeFolders(folder.path("deep"));
  writeFile(folder.path("classes.json"), R"({"vehicle": 7, "tree": {"id": 2}})");
  const SceneDescription inside = readText(folder, "a.json",
    R"({"classes": {"vehicle": 7, "tree": {"id": 2}}, "objects": [{"model": "a.ac", "class": "tree"}]})");
  EXPECT_EQ(inside.classIdOf("vehicle"), 7);
  EXPECT_EQ(inside.classIdOf("tree"), 2);
  EXPECT_EQ(inside.classIdOf(""), 0);
  EXPECT_NE(toJson(inside, "").find("\"classes\": {\n    \"vehicle\": 7,\n    \"tree\": 2\n  }"), std::string::npos)
    << toJson(inside, "");
  writeScene(inside, folder.path("deep/a.json"));
  EXPECT_EQ(readScene(folder.path("deep/a.json")).classIdOf("vehicle"), 7);

  const SceneDescription beside =
    readText(folder, "b.json", R"({"classes": "classes.json", "objects": [{"model": "a.ac", "class": "tree"}]})");
  writeScene(beside, folder.path("deep/b.json"));
  const SceneDescription moved = readScene(folder.path("deep/b.json"));
  EXPECT_EQ(moved.classFile, "../classes.json");
  EXPECT_EQ(moved.classIdOf("vehicle"), 7);
  EXPECT_EQ(moved.classes.size(), 2u);
}

TEST(SceneJson, WhatClassesSayIsKept)
{
  const TemporaryFolder folder;
  const SceneDescription scene = readText(folder, "a.json",
    R"({"classes": {"car": {"id": 3, "supercategory": "vehicle", "thing": true, "color": [1, 2, 255],
      "keypoints": ["nose", "tail"], "skeleton": [[1, 2], [2, 1]]}, "sky": {"thing": false, "id": 1}, "tree": {"id": 2}}})");
  const ClassDescription& car = scene.classes.at(0);
  EXPECT_EQ(car.supercategory, "vehicle");
  EXPECT_EQ(car.thing, true);
  EXPECT_EQ(car.color, (std::array<int, 3>{ 1, 2, 255 }));
  EXPECT_EQ(car.keypoints, (std::vector<std::string>{ "nose", "tail" }));
  EXPECT_EQ(car.skeleton, (std::vector<std::array<int, 2>>{ { 1, 2 }, { 2, 1 } }));
  EXPECT_EQ(scene.classes.at(1).thing, false);
  EXPECT_FALSE(scene.classes.at(2).thing);
  const std::string once = toJson(scene, folder.path());
  EXPECT_EQ(toJson(readText(folder, "b.json", once), folder.path()), once);
  EXPECT_NE(once.find("\"skeleton\": [[1, 2], [2, 1]]"), std::string::npos) << once;
  EXPECT_NE(once.find("\"tree\": 2"), std::string::npos) << "a number alone stays one: " << once;
}

TEST(SceneJson, KeypointsAndTheDatasetAreKept)
{
  const TemporaryFolder folder;
  const SceneDescription scene = readText(folder, "a.json",
    R"({"metresPerUnit": 0.25, "dataset": {"url": "u", "name": "n"},
      "objects": [{"model": "a.ac", "keypoints": {"nose": [1, 2.5, 3], "tip": 7}}]})");
  EXPECT_EQ(scene.metres(), 0.25);
  EXPECT_EQ(scene.dataset, (std::map<std::string, std::string>{ { "name", "n" }, { "url", "u" } }));
  const std::vector<KeypointDescription>& points = scene.objects.at(0).keypoints;
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].name, "nose");
  EXPECT_EQ(points[0].position, Vector(1, 2.5, 3));
  EXPECT_FALSE(points[0].vertex);
  EXPECT_EQ(points[1].vertex, 7u);
  const std::string once = toJson(scene, folder.path());
  EXPECT_EQ(toJson(readText(folder, "b.json", once), folder.path()), once);
  EXPECT_LT(once.find("\"name\": \"n\""), once.find("\"url\": \"u\"")) << "in the order of the words";
}

TEST(SceneJson, UnitsOfLength)
{
  const std::pair<const char*, double> table[] = { { "m", 1 }, { "mm", 1e-3 }, { "Metres", 1 }, { "meter", 1 },
    { "MILLIMETERS", 1e-3 }, { "kilometre", 1e3 }, { "\xc2\xb5m", 1e-6 }, { "inches", 0.0254 }, { "in", 0.0254 },
    { "Feet", 0.3048 }, { "foot", 0.3048 }, { "yards", 0.9144 }, { "mile", 1609.344 }, { "dm", 0.1 }, { "", 0 },
    { "Mm", 0 }, { "s", 0 }, { "ms", 0 }, { "units", 0 }, { "meterx", 0 } };
  for (const auto& [name, metres] : table)
  {
    EXPECT_EQ(metresOfUnit(name), metres) << name;
    SceneDescription scene;
    scene.units = name;
    EXPECT_EQ(scene.metres(), metres);
  }
}

TEST(SceneJson, MetresAreThoseOfTheUnits)
{
  const auto refusal = [](const std::string& metres)
  { return refusalOf("a.json", "{\"units\": \"mm\", \"metresPerUnit\": " + metres + "}"); };
  EXPECT_EQ(refusal("0.001"), "");
  EXPECT_EQ(refusal("0.0010000005"), "") << "of numbers that were rounded";
  EXPECT_THAT(refusal("0.001005"), testing::HasSubstr("metresPerUnit contradicts units 'mm'"));
  EXPECT_THAT(refusal("0.000995"), testing::HasSubstr("metresPerUnit contradicts units 'mm'"));
}

TEST(SceneJson, ATextThatIsInNoFile)
{
  const TemporaryFolder folder;
  const SceneDescription scene = readSceneText(richJson, folder.path());
  EXPECT_EQ(scene.file, "");
  EXPECT_EQ(scene.objects.at(0).line, 0);
  EXPECT_EQ(toJson(scene, folder.path()), toJson(readText(folder, "rich.json", richJson), folder.path()));
  const auto refusal = [&folder](const std::string& text)
  { return thrownBy<InputError>([&] { readSceneText(text, folder.path()); }); };
  EXPECT_EQ(refusal("{\"objects\": [\n{\"model\": \"a.ac\", \"position\": [0, \"far\", 0]}]}"),
    "scene: objects[0].position[1] has the wrong type (expected a number from -1e15 to 1e15, found 'far')");
  EXPECT_EQ(refusal("{\"cameras\": [{\"near\": 2, \"far\": 1}]}").rfind("scene: cameras[0] has no pose ", 0), 0u);
  EXPECT_EQ(refusal("{\n\"fps\": }").rfind("scene:2: ", 0), 0u) << "what is no JSON has a line";
}
