// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLikeScene.h"
#include "dgtkMissingModels.h"
#include "dgtkStageSamples.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

using namespace dgtk;
using namespace dgtk::test;
using testing::HasSubstr;
using Vector = Eigen::Vector3d;

TEST(StageMaterials, MaterialsAreReplaced)
{
  const ModelFolder folder;
  const auto stage = folder.load(R"({"objects": [
    {"model": "models/square.ac"},
    {"model": "models/square.ac", "materials": {"*": {"diffuse": [0, 0, 1], "opacity": 0.5}, "red": {"shininess": 3, "bumpScale": 0.25,
      "ambient": [0.1, 0, 0], "specular": [0, 0.1, 0], "emission": [0, 0, 0.1]}}},
    {"model": "models/square.ac", "materials": {"red": {"texture": ""}}},
    {"model": "models/square.ac", "materials": {"*": {"texture": "models/other.ppm"}}}]})");
  const auto state = stage->at(0);
  ASSERT_EQ(state->instances.size(), 4u);
  const auto material = [&](std::size_t i) { return state->instances[i].materials->at(0); };
  EXPECT_EQ(material(0).diffuse, Vector(1, 0, 0));
  EXPECT_EQ(material(1).diffuse, Vector(0, 0, 1));
  EXPECT_EQ(material(1).opacity, 0.5);
  EXPECT_EQ(material(1).shininess, 3);
  EXPECT_EQ(material(1).bumpScale, 0.25);
  EXPECT_EQ(material(1).ambient, Vector(0.1, 0, 0));
  EXPECT_EQ(material(1).specular, Vector(0, 0.1, 0));
  EXPECT_EQ(material(1).emission, Vector(0, 0, 0.1));
  EXPECT_EQ(material(2).ambient, material(0).ambient);
  EXPECT_EQ(material(2).specular, material(0).specular);
  EXPECT_EQ(material(2).texture, -1);
  const Model& model = *state->instances[3].model;
  EXPECT_EQ(model.textures.at(std::size_t(material(3).texture)).path, folder.path("models/other.ppm"));
  EXPECT_NE(model.textures.at(std::size_t(material(3).texture)).image, nullptr);
  EXPECT_EQ(state->instances[3].model, state->instances[0].model);
}

TEST(StageMaterials, MaterialsHaveTheNumbersOfTheirTracks)
{
  const ModelFolder folder;
  const auto stage = folder.load(R"({"objects": [
    {"name": "plain", "model": "models/square.ac", "materials": {"red": {"diffuse": [0, 1, 0]}}},
    {"name": "all", "model": "models/square.ac", "materials": {
      "*": {"diffuse": {"keys": [[0, [0, 0, 0]], [4, [1, 1, 1]]]}, "opacity": {"keys": [[0, 1], [4, 0]]}},
      "red": {"opacity": 0.75, "ambient": {"keys": [[0, [0, 0, 0]], [4, [0, 1, 0]]]},
        "specular": {"keys": [[0, [0, 0, 0]], [4, [0, 0, 1]]]}, "emission": {"keys": [[0, [0, 0, 0]], [4, [1, 0, 0]]]},
        "shininess": {"keys": [[0, 0], [4, 100]]}, "metallic": {"keys": [[0, 0], [4, 1]]}, "roughness": 0.5,
        "bumpScale": {"keys": [[0, -4], [4, 4]]}, "texture": ""}}},
    {"name": "steps", "model": "models/square.ac",
      "materials": {"*": {"opacity": {"keys": [[0, 1], [2, 0.5]], "interpolation": "step"}}}}]})");
  const auto state = stage->at(1);
  const auto material = [](const std::shared_ptr<const SceneState>& of, std::size_t i)
  { return of->instances[i].materials->at(0); };
  const Material all = material(state, 1);
  EXPECT_EQ(all.diffuse, Vector(0.25, 0.25, 0.25));
  EXPECT_EQ(all.opacity, 0.75) << "the last override that has it counts, moving or not";
  EXPECT_EQ(all.ambient, Vector(0, 0.25, 0));
  EXPECT_EQ(all.specular, Vector(0, 0, 0.25));
  EXPECT_EQ(all.emission, Vector(0.25, 0, 0));
  EXPECT_EQ(all.shininess, 25);
  EXPECT_EQ(all.physical->metallic, 0.25);
  EXPECT_EQ(all.physical->roughness, 0.5);
  EXPECT_EQ(all.bumpScale, -2);
  EXPECT_EQ(all.texture, -1);
  EXPECT_EQ(material(stage->at(4), 1).diffuse, Vector(1, 1, 1));
  EXPECT_EQ(material(state, 0).diffuse, Vector(0, 1, 0));
  // What has no tracks is the same at all frames; equal numbers share a list.
  EXPECT_EQ(stage->at(3)->instances[0].materials, state->instances[0].materials);
  EXPECT_NE(stage->at(3)->instances[1].materials, state->instances[1].materials);
  EXPECT_EQ(stage->at(5)->instances[2].materials, stage->at(3)->instances[2].materials);
  EXPECT_EQ(material(state, 2).opacity, 1);
  EXPECT_EQ(material(stage->at(3), 2).opacity, 0.5);
}

TEST(StageMaterials, MissingTexelsAreThoseOfTheTextureThatIsUsed)
{
  const ModelFolder folder;
  // Two texels of 32 bits, the second one transparent.
  writeFile(folder.path("models/holes.tga"),
    std::string("\0\0\2\0\0\0\0\0\0\0\0\0\2\0\1\0\x20\x28", 18) + "\1\2\3\xff\4\5\6" + '\0');
  const auto stage = folder.load(R"({"objects": [
    {"model": "models/square.ac"}, {"model": "models/square.ac", "materials": {"*": {"texture": "models/holes.tga"}}},
    {"model": "models/square.ac", "materials": {"*": {"texture": "models/holes.tga"}, "red": {"texture": ""}}},
    {"model": "models/square.ac", "materials": {"*": {"texture": "models/holes.tga"},
      "red": {"texture": "models/other.ppm"}}}]})");
  const auto state = stage->at(0);
  for (const auto& [object, cutOut] :
    { std::pair(0, false), std::pair(1, true), std::pair(2, false), std::pair(3, false) })
  {
    EXPECT_EQ(state->instances[std::size_t(object)].materials->at(0).cutOut, cutOut) << object;
  }
}

TEST(StageMaterials, MetalAndRoughnessAreAskedFor)
{
  const ModelFolder folder;
  const auto stage = folder.load(R"({"objects": [{"model": "models/square.ac"},
    {"model": "models/square.ac", "materials": {"*": {"metallic": 0.75}}},
    {"model": "models/square.ac", "materials": {"*": {"roughness": 0.25}}},
    {"model": "models/square.ac", "materials": {"*": {"metallic": 0.75}, "red": {"roughness": 0.25}}}]})");
  const auto physical = [&](std::size_t i) { return stage->at(0)->instances[i].materials->at(0).physical; };
  EXPECT_FALSE(physical(0));
  for (const std::size_t i : { 1u, 2u, 3u })
  {
    ASSERT_TRUE(physical(i));
    EXPECT_TRUE(physical(i)->wanted);
    EXPECT_EQ(physical(i)->metallic, i != 2 ? 0.75 : 0);
    EXPECT_EQ(physical(i)->roughness, i != 1 ? 0.25 : 1);
  }
}

TEST(StageMaterials, AllMaterialsOfNone)
{
  const ModelFolder folder;
  writeFile(folder.path("models/bare.ac"), "AC3Db\nOBJECT world\nkids 0\n");
  EXPECT_EQ(
    folder.refusalOf(R"({"objects": [{"model": "models/bare.ac", "materials": {"*": {"opacity": 0.5}}}]})"), "");
}

TEST(StageMaterials, AMissingTextureIsAWarning)
{
  const ModelFolder folder;
  std::vector<std::string> warnings;
  folder.load(R"({"objects": [{"model": "models/square.ac", "materials": {"*": {"texture": "no.png"}}}]})",
    [&](const std::string& line) { warnings.push_back(line); });
  EXPECT_THAT(warnings, testing::Contains(HasSubstr("texture 'no.png': not found")));
}

TEST(StageMaterials, TexturesOfAbsoluteNamesAreNotLookedForElsewhere)
{
  const ModelFolder folder;
  writeFile(folder.path("beside.ppm"), redPpm);
  for (const auto& [name, found] : { std::pair("nowhere/beside.ppm", true), std::pair("/nowhere/beside.ppm", false) })
  {
    std::vector<std::string> warnings;
    folder.load(
      std::string(R"({"objects": [{"model": "models/square.ac", "materials": {"*": {"texture": ")") + name + "\"}}}]}",
      [&](const std::string& line) { warnings.push_back(line); });
    EXPECT_EQ(warnings.empty(), found) << name;
  }
}

TEST(StageMaterials, ATextureWithoutCoordinatesIsAWarning)
{
  const ModelFolder folder;
  std::string bare = squareAc;
  for (const char* refs : { "1 1 0\n", "2 1 1\n", "3 0 1\n" })
  {
    bare.replace(bare.rfind(refs), 6, std::string(1, refs[0]) + " 0 0\n");
  }
  writeFile(folder.path("models/bare.ac"), bare);
  std::vector<std::string> warnings;
  folder.load(R"({"objects": [{"model": "models/bare.ac", "materials": {"*": {"texture": "models/one.ppm"}}}]})",
    [&](const std::string& line) { warnings.push_back(line); });
  EXPECT_THAT(warnings, testing::ElementsAre(HasSubstr("bare.ac has no texture coordinates")));
  warnings.clear();
  writeFile(folder.path("models/half.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 1 0\nf 1/1 2/1 3/1\nf 1 2 3\n");
  folder.load(R"({"objects": [{"model": "models/half.obj", "materials": {"*": {"texture": "models/one.ppm"}}}]})",
    [&](const std::string& line) { warnings.push_back(line); });
  EXPECT_THAT(warnings, testing::ElementsAre(HasSubstr("half.obj has surfaces without texture coordinates")));
  warnings.clear();
  writeFile(folder.path("models/half.mtl"), "newmtl n\nmap_Kd one.ppm\n");
  writeFile(folder.path("models/half.obj"),
    "mtllib half.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 1 0\nusemtl n\nf 1/1 2/1 3/1\nf 1 2 3\n");
  folder.load(R"({"objects": [{"model": "models/half.obj", "materials": {"*": {"texture": "models/two.ppm"}}}]})",
    [&](const std::string& line) { warnings.push_back(line); });
  EXPECT_THAT(warnings, testing::ElementsAre(HasSubstr("1 triangle has pictures but no texture coordinates")));
}

TEST(StageMaterials, SurfacesWithoutCoordinatesHaveNoPicturesOfTheScene)
{
  const ModelFolder folder;
  writeFile(folder.path("models/half.mtl"), "newmtl m\nKd 0 0 0\nKe 1 0 0\nmap_Ke one.ppm\nnewmtl n\nmap_Kd one.ppm\n");
  writeFile(folder.path("models/half.obj"),
    "mtllib half.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 1 0\nusemtl m\nf 1/1 2/1 3/1\nf 1 2 3\n"
    "usemtl n\nf 1/1 2/1 3/1\nf 1 2 3\n");
  const auto stage = folder.load(R"({"objects": [{"model": "models/half.obj", "materials": {"*": {
    "texture": "models/two.ppm", "normalMap": "models/one.ppm", "emission": [0, 1, 0]}}}, {"model": "models/half.obj",
    "materials": {"n": {"emissionMap": "models/two.ppm", "emission": [0, 1, 0]}}}]})");
  const auto state = stage->at(0);
  const auto look = [&](std::size_t object, std::size_t part) -> const Material&
  {
    const Instance& instance = state->instances[object];
    return (*instance.materials)[std::size_t(instance.model->parts.at(part).material)];
  };
  for (const std::size_t part : { 1u, 3u })
  {
    EXPECT_EQ(look(0, part).texture, -1);
    EXPECT_EQ(look(0, part).normalMap, -1);
    EXPECT_GE(look(0, part - 1).texture, 0);
    EXPECT_GE(look(0, part - 1).normalMap, 0);
    EXPECT_EQ(look(0, part - 1).emission, Vector(0, 1, 0));
  }
  EXPECT_EQ(look(0, 1).emission, Vector(0, 0, 0)) << "a picture says where the other glows";
  EXPECT_EQ(look(0, 3).emission, Vector(0, 1, 0));
  EXPECT_EQ(look(1, 3).emission, Vector(0, 0, 0));
  EXPECT_EQ(look(1, 2).emission, Vector(0, 1, 0));
  const auto plain = folder.load(R"({"objects": [{"model": "models/half.obj", "materials": {"*": {
    "texture": "", "emissionMap": "", "emission": [0, 1, 0]}}}]})");
  for (const Material& material : *plain->at(0)->instances[0].materials)
  {
    EXPECT_EQ(material.emission, Vector(0, 1, 0)) << "no picture says where";
  }
}

TEST(StageMaterials, MapsAreThoseThatTheSceneNames)
{
  const ModelFolder folder;
  const auto stage = folder.load(R"({"objects": [{"model": "models/square.ac", "materials": {"*": {
    "emissionMap": "models/one.ppm", "occlusionMap": "models/two.ppm", "metallicRoughnessMap": "models/other.ppm",
    "normalMap": "models/red.ppm"}}}]})");
  const Instance& instance = stage->at(0)->instances[0];
  const Material& material = instance.materials->at(0);
  const auto file = [&](int map)
  { return std::filesystem::path(instance.model->textures.at(std::size_t(map)).path).filename().string(); };
  EXPECT_EQ(file(material.emissionMap), "one.ppm");
  EXPECT_EQ(file(material.occlusionMap), "two.ppm");
  EXPECT_EQ(file(material.metallicRoughnessMap), "other.ppm");
  EXPECT_EQ(file(material.normalMap), "red.ppm");
}

TEST(StageMaterials, SkinsAreTexturesOfTheModel)
{
  const ModelFolder folder;
  for (const char* skin : { "two.ppm", "two", "1" })
  {
    const auto stage =
      folder.load(std::string(R"({"objects": [{"model": "models/runner.md2", "skin": ")") + skin + "\"}]}");
    const Instance& instance = stage->at(0)->instances[0];
    const int texture = instance.materials->at(0).texture;
    ASSERT_GE(texture, 0);
    EXPECT_EQ(instance.model->textures[std::size_t(texture)].name, "two.ppm") << skin;
  }
  EXPECT_THAT(folder.refusalOf("{\"objects\": [\n{\"model\": \"models/runner.md2\", \"skin\": \"three\"}]}"),
    HasSubstr("scene.json:2: object 'runner-1': skin is no texture of models/runner.md2 (expected one of one.ppm, "
              "two.ppm, found 'three')"));
}

TEST(StageMaterials, SkinsReplaceTexturesOnly)
{
  const ModelFolder folder;
  std::string two = squareAc;
  two.replace(two.find("kids 1"), 6, "kids 2");
  std::string plain = squareAc.substr(squareAc.find("OBJECT poly"));
  plain.replace(plain.find("texture \"red.ppm\"\n"), 18, "");
  writeFile(folder.path("models/two.ac"), two + plain);
  const auto stage = folder.load(R"({"objects": [{"model": "models/two.ac", "skin": "red"}]})");
  const Instance& instance = stage->at(0)->instances[0];
  std::vector<int> textures;
  for (const Part& part : instance.model->parts)
  {
    textures.push_back(instance.materials->at(std::size_t(part.material)).texture);
  }
  EXPECT_THAT(textures, testing::ElementsAre(0, -1));
}
