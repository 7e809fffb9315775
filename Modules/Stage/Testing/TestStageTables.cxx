// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelClock.h"
#include "dgtkModelLibrary.h"
#include "dgtkStageSamples.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

using namespace dgtk;
using namespace dgtk::test;
using testing::ElementsAre;
using testing::HasSubstr;
using Vector = Eigen::Vector3d;

namespace
{
/// Sequences "walk" (frames 4 to 7), "1" (8 to 9), "stand" (10), of 10 frames a second.
Model animated(const std::string& format)
{
  Model model;
  model.format = format;
  model.animations = { { "walk", 4, 7, 10, false }, { "1", 8, 9, 10, false }, { "stand", 10, 10, 10, false } };
  return model;
}

/// The material of the first triangle of the first object.
Material drawn(const Stage& stage)
{
  const Instance& instance = stage.at(0)->instances[0];
  return instance.materials->at(std::size_t(instance.model->parts.at(0).material));
}

std::vector<std::string> warningsOf(const ModelFolder& folder, const std::string& json)
{
  std::vector<std::string> warnings;
  folder.load(json,
    [&](std::string line)
    {
      for (std::size_t at; (at = line.find(folder.path() + '/')) != std::string::npos;)
      {
        line.erase(at, folder.path().size() + 1);
      }
      warnings.push_back(line);
    });
  return warnings;
}
} // namespace

TEST(StageTables, MomentsOfSequences)
{
  struct Row
  {
    const char* format;
    int animation;
    bool loop;
    double start, offset, rate;
    double frame;           ///< of the scene, 20 a second
    double expected, onWay; ///< model frame; part of the way from the last frame to the first
  };
  const Row rows[] = {
    { "md2", 0, true, 0, 0, 1, 0, 4, 0 },
    { "md2", 0, true, 0, 0, 1, 5, 6.5, 0 },
    { "md2", 0, true, 0, 0, 1, 6, 7, 0 },
    { "md2", 0, true, 0, 0, 1, 7, 7, 0.5 },
    { "md2", 0, true, 0, 0, 1, 8, 4, 0 },
    { "md2", 0, true, 0, 0, 1, 13, 6.5, 0 },
    { "gltf", 0, true, 0, 0, 1, 5, 6.5, 0 },
    { "gltf", 0, true, 0, 0, 1, 6, 4, 0 },
    { "gltf", 0, true, 0, 0, 1, 7, 4.5, 0 },
    { "md2", 0, false, 0, 0, 1, 5, 6.5, 0 },
    { "md2", 0, false, 0, 0, 1, 7, 7, 0 },
    { "gltf", 0, false, 0, 0, 1, 700, 7, 0 },
    { "md2", 0, true, 10, 0, 1, 3, 4, 0 },
    { "md2", 0, true, 10, 0, 1, 13, 5.5, 0 },
    { "md2", 0, true, 10, 1.5, 1, 0, 5.5, 0 },
    { "md2", 0, true, 10, 1.5, 1, 12, 6.5, 0 },
    { "md2", 0, true, 10, 1.5, 1, 14, 7, 0.5 },
    { "md2", 0, true, 0, 5, 1, 0, 5, 0 },
    { "md2", 0, false, 0, 5, 1, 0, 7, 0 },
    { "md2", 0, true, 0, 0, 4, 1, 6, 0 },
    { "md2", 0, true, 0, 0.5, 0, 99, 4.5, 0 },
    { "md2", 1, true, 0, 0, 1, 1, 8.5, 0 },
    { "md2", 1, true, 0, 0, 1, 3, 9, 0.5 },
    { "gltf", 1, true, 0, 0, 1, 2, 8, 0 },
    { "md2", 2, true, 0, 0, 1, 5, 10, 0 },
    { "md2", 2, false, 0, 0, 1, 5, 10, 0 },
  };
  for (const Row& row : rows)
  {
    AnimationDescription description;
    description.start = row.start;
    description.offset = row.offset;
    description.rate = row.rate;
    description.loop = row.loop;
    const ModelMoment moment = momentAt(description, animated(row.format), row.animation, row.frame, 20);
    EXPECT_EQ(moment.animation, row.animation);
    EXPECT_NEAR(moment.frame, row.expected, 1e-12) << row.format << ' ' << row.frame;
    EXPECT_NEAR(moment.wrap, row.onWay, 1e-12) << row.format << ' ' << row.frame;
  }
  const double spans[][3] = { { 3, 4, 3 }, { 1, 2, 1 }, { 0, 0, 0 } }; // held, looped, looped in other formats
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_EQ(sequenceSpan(animated("md2"), i, false), spans[i][0]);
    EXPECT_EQ(sequenceSpan(animated("md2"), i, true), spans[i][1]);
    EXPECT_EQ(sequenceSpan(animated("gltf"), i, true), spans[i][2]);
  }
}

TEST(StageTables, SequencesMayEndBetweenFrames)
{
  Model model;
  model.format = "gltf";
  const double length = 30 * double(41.f / 24); // as files have it
  model.animations = { { "walk", 0, 51, 30, false, length }, { "blink", 0, 0, 30, false, 0.3125 } };
  const auto frameAt = [&model](int animation, double frame, bool loop)
  {
    AnimationDescription description;
    description.loop = loop;
    const ModelMoment moment = momentAt(description, model, animation, frame, 24);
    EXPECT_EQ(moment.wrap, 0);
    return moment.frame;
  };
  EXPECT_NEAR(frameAt(0, 40, false), 50, 1e-12);
  EXPECT_NEAR(frameAt(0, 41, false), 51.25, 1e-5);
  EXPECT_NEAR(frameAt(0, 700, false), 51.25, 1e-5);
  for (const int round : { 1, 2, 3, 1000 })
  {
    EXPECT_EQ(frameAt(0, 41 * round, true), 0) << round;
    EXPECT_NEAR(frameAt(0, 41 * round + 1, true), 1.25, 1e-5 * round) << round;
    EXPECT_NEAR(frameAt(0, 41 * round - 1, true), 50, 1e-5 * round) << round;
  }
  // so late that what is known of the place in the round is no more than the round: still moving
  EXPECT_GT(frameAt(0, 1e9 + 1, true), frameAt(0, 1e9, true));
  EXPECT_EQ(sequenceSpan(model, 0, true), length);
  EXPECT_EQ(sequenceSpan(model, 1, false), 0.3125);
  EXPECT_EQ(frameAt(1, 1, false), 0.3125);
  EXPECT_EQ(frameAt(1, 0.125, true), 0.15625);
}

TEST(StageTables, SequencesByNameThenByNumber)
{
  SceneDescription scene;
  scene.file = "s.json";
  const auto found = [&](const std::string& sequence, const Model& model)
  {
    ObjectDescription object;
    object.name = "it";
    object.model = "m.md2";
    object.line = 7;
    object.animation.sequence = sequence;
    std::string number;
    const std::string refusal =
      thrownBy<InputError>([&] { number = std::to_string(findAnimation(scene, object, model)); });
    return number + refusal;
  };
  const Model model = animated("md2");
  EXPECT_EQ(found("", model), "0");
  EXPECT_EQ(found("", Model()), "-1");
  EXPECT_EQ(found("stand", model), "2");
  EXPECT_EQ(found("1", model), "1");
  EXPECT_EQ(found("0", model), "0");
  EXPECT_EQ(found("2", model), "2");
  EXPECT_EQ(found("000002", model), "2");
  const std::string refused = "s.json:7: object 'it': animation.sequence is no sequence of m.md2 (expected ";
  for (const char* wrong : { "3", "0000002", "2 ", "Walk", "-1" })
  {
    EXPECT_EQ(found(wrong, model), refused + "one of walk, 1, stand, found '" + wrong + "')");
  }
  EXPECT_EQ(found("walk", Model()), refused + "none, found 'walk')");
  Model many;
  std::string names;
  for (int i = 0; i < 50; ++i)
  {
    many.animations.push_back({ "s" + std::to_string(i), i, i, 10, false });
    names += i >= 40 ? "" : (i == 0 ? "s" : ", s") + std::to_string(i);
  }
  EXPECT_EQ(found("x", many), refused + "one of " + names + ", found 'x')") << "a list of forty is long enough";
  EXPECT_EQ(found("s49", many), "49");
}

TEST(StageTables, EveryKeyOfMaterials)
{
  const ModelFolder folder;
  const std::string object = R"({"model": "models/square.ac", "materials": {"red": {)";
  const auto changed = [&](const std::string& keys)
  { return drawn(*folder.load("{\"objects\": [" + object + keys + "}}}]}")); };
  const auto textOf = [](const Material& m)
  {
    std::ostringstream out;
    out << m.ambient.transpose() << " | " << m.diffuse.transpose() << " | " << m.specular.transpose() << " | "
        << m.emission.transpose() << " | " << m.shininess << ' ' << m.opacity << ' ' << m.bumpScale << " | "
        << m.texture << ' ' << m.normalMap << ' ' << m.bumpMap << ' ' << m.metallicRoughnessMap << ' ' << m.emissionMap
        << ' ' << m.occlusionMap;
    if (m.physical)
    {
      out << " | " << m.physical->metallic << ' ' << m.physical->roughness << ' ' << m.physical->wanted;
    }
    return out.str();
  };
  const std::string picture = R"(": "models/other.ppm")";
  const std::pair<std::string, const char*> rows[] = {
    { "", "0.2 0.2 0.2 | 1 0 0 | 0.5 0.5 0.5 | 0 0 0 | 10 1 1 | 0 -1 -1 -1 -1 -1" },
    { R"("ambient": [0.1, 0.3, 0.4])", "0.1 0.3 0.4 | 1 0 0 | 0.5 0.5 0.5 | 0 0 0 | 10 1 1 | 0 -1 -1 -1 -1 -1" },
    { R"("diffuse": [0.1, 0.3, 0.4])", "0.2 0.2 0.2 | 0.1 0.3 0.4 | 0.5 0.5 0.5 | 0 0 0 | 10 1 1 | 0 -1 -1 -1 -1 -1" },
    { R"("specular": [0.1, 0.3, 0.4])", "0.2 0.2 0.2 | 1 0 0 | 0.1 0.3 0.4 | 0 0 0 | 10 1 1 | 0 -1 -1 -1 -1 -1" },
    { R"("emission": [0.1, 0.3, 0.4])", "0.2 0.2 0.2 | 1 0 0 | 0.5 0.5 0.5 | 0.1 0.3 0.4 | 10 1 1 | 0 -1 -1 -1 -1 -1" },
    { R"("shininess": 20)", "0.2 0.2 0.2 | 1 0 0 | 0.5 0.5 0.5 | 0 0 0 | 20 1 1 | 0 -1 -1 -1 -1 -1" },
    { R"("opacity": 0.25)", "0.2 0.2 0.2 | 1 0 0 | 0.5 0.5 0.5 | 0 0 0 | 10 0.25 1 | 0 -1 -1 -1 -1 -1" },
    { R"("bumpScale": 0.25)", "0.2 0.2 0.2 | 1 0 0 | 0.5 0.5 0.5 | 0 0 0 | 10 1 0.25 | 0 -1 -1 -1 -1 -1" },
    { R"("texture": "")", "0.2 0.2 0.2 | 1 0 0 | 0.5 0.5 0.5 | 0 0 0 | 10 1 1 | -1 -1 -1 -1 -1 -1" },
    { "\"texture" + picture, "0.2 0.2 0.2 | 1 0 0 | 0.5 0.5 0.5 | 0 0 0 | 10 1 1 | 1 -1 -1 -1 -1 -1" },
    { "\"normalMap" + picture, "0.2 0.2 0.2 | 1 0 0 | 0.5 0.5 0.5 | 0 0 0 | 10 1 1 | 0 1 -1 -1 -1 -1" },
    { "\"bump" + picture, "0.2 0.2 0.2 | 1 0 0 | 0.5 0.5 0.5 | 0 0 0 | 10 1 1 | 0 -1 1 -1 -1 -1" },
    { "\"metallicRoughnessMap" + picture, "0.2 0.2 0.2 | 1 0 0 | 0.5 0.5 0.5 | 0 0 0 | 10 1 1 | 0 -1 -1 1 -1 -1" },
    { "\"emissionMap" + picture, "0.2 0.2 0.2 | 1 0 0 | 0.5 0.5 0.5 | 0 0 0 | 10 1 1 | 0 -1 -1 -1 1 -1" },
    { "\"occlusionMap" + picture, "0.2 0.2 0.2 | 1 0 0 | 0.5 0.5 0.5 | 0 0 0 | 10 1 1 | 0 -1 -1 -1 -1 1" },
    { "\"texture" + picture + ", \"bump" + picture, // of colours and of data, which files of light tell apart
      "0.2 0.2 0.2 | 1 0 0 | 0.5 0.5 0.5 | 0 0 0 | 10 1 1 | 1 -1 2 -1 -1 -1" },
    { R"("metallic": 0.5)", "0.2 0.2 0.2 | 1 0 0 | 0.5 0.5 0.5 | 0 0 0 | 10 1 1 | 0 -1 -1 -1 -1 -1 | 0.5 1 1" },
    { R"("roughness": 0.5)", "0.2 0.2 0.2 | 1 0 0 | 0.5 0.5 0.5 | 0 0 0 | 10 1 1 | 0 -1 -1 -1 -1 -1 | 0 0.5 1" },
  };
  for (const auto& [keys, expected] : rows)
  {
    EXPECT_EQ(textOf(changed(keys)), expected) << keys;
  }
  // A later one finds what an earlier one has left; names of no material are refused.
  const std::string two = "{\"objects\": [" + object + "\"bump" + picture + "}, \"*\": {\"bump\": \"\"}}}]}";
  EXPECT_EQ(textOf(drawn(*folder.load(two))), rows[0].second);
  EXPECT_EQ(folder.refusalOf("{\"objects\": [\n{\"model\": \"models/square.ac\", \"materials\": {\"Red\": {}}}]}"),
    "scene.json:2: object 'square-1': materials: no material of models/square.ac has this name (expected * or one of "
    "red, found 'Red')");
}

TEST(StageTables, SkinsByEachOfTheirNames)
{
  const ModelFolder folder;
  std::string bytes = triangleMd2();
  bytes.replace(68, 14, std::string("a\\b/one.ppm\0\0\0", 14));
  writeFile(folder.path("models/runner.md2"), bytes);
  const auto skin = [&](const std::string& name)
  {
    const std::string json = "{\"objects\": [{\"model\": \"models/runner.md2\", \"skin\": \"" + name + "\"}]}";
    return folder.refusalOf(json).empty() ? std::to_string(drawn(*folder.load(json)).texture) : folder.refusalOf(json);
  };
  for (const char* name : { "a\\\\b/one.ppm", "a/b/one.ppm", "one.ppm", "one", "0", "000000" })
  {
    EXPECT_EQ(skin(name), "0") << name;
  }
  for (const char* name : { "two.ppm", "two", "1" })
  {
    EXPECT_EQ(skin(name), "1") << name;
  }
  for (const char* name : { "2", "0000001", "b/one.ppm", "1 ", "One" })
  {
    EXPECT_EQ(skin(name),
      std::string("scene.json:1: object 'runner-1': skin is no texture of models/runner.md2 (expected one of "
                  "a\\b/one.ppm, two.ppm, found '") +
        name + "')");
  }
  // A name that begins with a dot is all stem; its file is called otherwise. What the model says comes first.
  bytes.replace(68, 14, std::string(".one\0\0\0\0\0\0\0\0\0\0", 14));
  writeFile(folder.path("models/runner.md2"), bytes);
  for (const char* name : { ".one", "one", "one.ppm" })
  {
    EXPECT_EQ(skin(name), "0") << name;
  }
  bytes.replace(68, 4, ".two");
  writeFile(folder.path("models/runner.md2"), bytes);
  EXPECT_EQ(skin("two"), "1");
}

TEST(StageTables, WarningsOfPicturesAndModels)
{
  const ModelFolder folder;
  writeFile(folder.path("bad.png"), "no picture");
  const auto warnings = [&](const std::string& texture)
  {
    return warningsOf(
      folder, R"({"objects": [{"model": "models/square.ac", "materials": {"*": {"texture": ")" + texture + "\"}}}]}");
  };
  EXPECT_THAT(warnings("models/one.ppm"), ElementsAre());
  EXPECT_THAT(warnings("one.ppm"), ElementsAre(HasSubstr("scene.json: texture 'one.ppm': not found (tried: ")));
  EXPECT_THAT(warnings("/one.ppm"), ElementsAre("scene.json: texture '/one.ppm': not found (tried: as written)"));
  EXPECT_THAT(warnings("bad.png"), ElementsAre(HasSubstr("scene.json: texture 'bad.png': ")));
  EXPECT_THAT(warningsOf(folder, R"({"objects": [{"model": "models/empty.ac"}, {"model": "models/empty.ac"}]})"),
    ElementsAre("models/empty.ac: has no surfaces; its objects are not there and have no id"));
}

TEST(StageTables, FilesOfASceneAreListedOnce)
{
  const ModelFolder folder;
  writeFile(folder.path("classes.json"), R"({"a": 1, "": 2})");
  writeFile(folder.path("sky.ppm"), redPpm);
  writeFile(folder.path("models/runner.anm"), "pair 0 1 10\n");
  const auto stage = folder.load(R"({"classes": "classes.json", "environment": {"image": "sky.ppm"}, "objects": [
    {"model": "models/square.ac", "class": "a"}, {"model": "models/runner.md2"}, {"model": "models/square.ac",
     "materials": {"*": {"texture": "sky.ppm", "bump": "models/other.ppm"}}}]})");
  std::vector<std::string> files;
  for (const std::string& file : stage->inputFiles())
  {
    files.push_back(std::filesystem::path(file).lexically_relative(folder.path()).generic_string());
  }
  EXPECT_THAT(
    files, ElementsAre("scene.json", "classes.json", "models/square.ac", "models/red.ppm", "sky.ppm",
             "models/other.ppm", "models/runner.md2", "models/runner.anm", "models/one.ppm", "models/two.ppm"));
  ASSERT_EQ(stage->models().size(), 2u);
  EXPECT_EQ(stage->models()[0]->format, "ac3d");
  EXPECT_EQ(stage->models()[1]->format, "md2");
  EXPECT_EQ(stage->at(0)->instances[0].classId, 1u);
  EXPECT_EQ(stage->at(0)->instances[1].classId, 2u);
  EXPECT_EQ(stage->at(0)->instances[0].className, "a");
}

TEST(StageTables, EnvironmentsAndTheirRefusal)
{
  const ModelFolder folder;
  writeFile(folder.path("sky.ppm"), redPpm);
  const auto environment = folder
                             .load(R"({"environment": {"image": "sky.ppm", "intensity": 0.25, "background": false,
    "rotation": 30}})")
                             ->at(0)
                             ->environment;
  ASSERT_TRUE(environment);
  EXPECT_EQ(environment->intensity, 0.25);
  EXPECT_FALSE(environment->background);
  ASSERT_TRUE(environment->image);
  EXPECT_EQ(environment->image->rgb, (std::vector<float>{ 1, 0, 0 }));
  Eigen::Matrix3d unturn;
  unturn << std::sqrt(0.75), 0, -0.5, 0, 1, 0, 0.5, 0, std::sqrt(0.75);
  EXPECT_LT((environment->image_from_world - unturn).norm(), 1e-15);
  EXPECT_TRUE(folder.load(R"({"environment": {"image": "sky.ppm"}})")->at(0)->environment->background);
  EXPECT_EQ(folder.load("{}")->at(0)->environment, nullptr);
  EXPECT_EQ(
    folder.refusalOf(R"({"environment": {"image": "none.hdr"}})"), "scene.json: environment: 'none.hdr' not found");
  EXPECT_THAT(
    folder.refusalOf(R"({"environment": {"image": "models"}})"), HasSubstr("environment: 'models' not found"));
}

/// Vogel's spiral: point k of n at radius sqrt((k + 1/2) / n) and k golden angles, in the order of the mirrored bits.
TEST(StageTables, PointsOfALens)
{
  const ModelFolder folder;
  const auto stage = folder.load(R"({"cameras": [{"eye": [0, 0, 0], "lookAt": [0, 0, -9], "near": 0.25, "far": 60,
    "lens": {"aperture": 4, "focus": 10, "exposures": 6}}]})");
  const std::vector<Exposure> exposures = stage->exposures(0, 3, 64, 48);
  const int order[] = { 0, 4, 2, 1, 5, 3 }; // 000 100 010 (110) 001 101 011 (111)
  ASSERT_EQ(exposures.size(), 6u);
  for (std::size_t i = 0; i < 6; ++i)
  {
    const double radius = 2 * std::sqrt((order[i] + 0.5) / 6);
    const double angle = order[i] * std::acos(-1) * (3 - std::sqrt(5.0));
    const View& view = exposures[i].view;
    EXPECT_LT(
      (view.camera_from_world.translation + Vector(radius * std::cos(angle), radius * std::sin(angle), 0)).norm(),
      1e-14);
    EXPECT_EQ(exposures[i].frame, 3);
    EXPECT_EQ(view.near, 0.25);
    EXPECT_EQ(view.far, 60);
    EXPECT_EQ(view.model->width(), 64);
    EXPECT_EQ(view.model->height(), 48);
  }
}

TEST(StageTables, RefusalsOfCamerasAndFrames)
{
  const ModelFolder folder;
  const auto stage = folder.load("{\"cameras\": [{\"eye\": [0, 0, 1], \"lookAt\": [0, 0, 0]},\n{\"name\": \"lost\", "
                                 "\"eye\": {\"keys\": [[0, [0, 0, 1]], [1, [0, 0, -1]]]}, \"lookAt\": [0, 0, 0]}]}");
  const auto refusal = [&](std::size_t camera, double frame)
  {
    const std::string text = thrownBy<Error>([&] { stage->view(camera, frame); });
    const std::size_t at = text.find("scene.json");
    return at == std::string::npos ? text : text.substr(at);
  };
  EXPECT_EQ(refusal(1, 0.25), "");
  EXPECT_THAT(refusal(1, 0.5), HasSubstr("scene.json:2: camera 'lost' at frame 0.5: "));
  EXPECT_EQ(refusal(2, 0), "camera 2 does not exist (the scene has 2)");
  EXPECT_EQ(refusal(0, INFINITY), "frame is not a finite number");
  EXPECT_EQ(
    folder.refusalOf("{\"objects\": [\n{\"model\": \"models/square.ac\", \"scale\": {\"keys\": [[0, [1, 1, -1]], "
                     "[2, [1, 1, 1]]], \"interpolation\": \"step\"}}]}"),
    "");
}
