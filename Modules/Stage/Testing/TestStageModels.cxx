// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLikeScene.h"
#include "dgtkMissingModels.h"
#include "dgtkModelClock.h"
#include "dgtkSceneFromText.h"
#include "dgtkStageSamples.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

using namespace dgtk;
using namespace dgtk::test;
using testing::HasSubstr;
using Vector = Eigen::Vector3d;

namespace
{
/// How far the runner is from where it is at frame 0.
double advanced(const Stage& stage, double frame)
{
  const auto first = stage.at(0)->instances[0].geometry;
  const auto here = stage.at(frame)->instances[0].geometry;
  return (here->positions[0] - first->positions[0]).norm();
}

std::string runner(const std::string& animation)
{
  return "{\"fps\": 20, \"objects\": [{\"model\": \"models/runner.md2\", \"animation\": {" + animation + "}}]}";
}
} // namespace

TEST(StageModels, AreLoadedOnceAndShared)
{
  const ModelFolder folder;
  std::filesystem::create_symlink(folder.path("models"), folder.path("link"));
  const auto stage = folder.load(R"({"objects": [{"model": "models/square.ac"}, {"model": "models/../models/square.ac"},
    {"model": "link/square.ac"}, {"model": ")" +
                                 folder.path("models/square.ac") + R"("}, {"model": "models/empty.ac"}]})");
  EXPECT_EQ(stage->models().size(), 2u);
  const auto state = stage->at(0);
  ASSERT_EQ(state->instances.size(), 4u);
  for (const Instance& instance : state->instances)
  {
    EXPECT_EQ(instance.model, state->instances[0].model);
    EXPECT_EQ(instance.geometry, instance.model->rest);
    EXPECT_EQ(instance.materials, state->instances[0].materials);
  }
  const auto next = stage->at(1);
  EXPECT_EQ(next->instances[0].geometry, state->instances[0].geometry);
  EXPECT_EQ(stage->at(1), next);
}

TEST(StageModels, ThoseOfASceneLikeItAreNotReadAgain)
{
  const ModelFolder folder;
  const std::string picture = R"("materials": {"*": {"texture": "models/other.ppm"}})";
  const std::string square = R"({"model": "models/square.ac")";
  const auto like = [&folder](const StageWithFiles* known, const std::string& text)
  { return loadLike(readSceneText(text, folder.path()), known ? known->files.get() : nullptr); };
  const std::string light = R"({"environment": {"image": "models/red.ppm")";
  const StageWithFiles first =
    like(nullptr, light + R"(}, "objects": [)" + square + ", " + picture + R"(}, {"model": "models/runner.md2"}]})");
  ASSERT_EQ(first.stage->models().size(), 2u);
  const std::shared_ptr<const Model> model = first.stage->models()[0];
  std::filesystem::rename(folder.path("models/other.ppm"), folder.path("other.ppm"));
  for (const char* const name : { "models/square.ac", "models/runner.md2", "models/red.ppm" })
  {
    std::filesystem::remove(folder.path(name));
  }

  const StageWithFiles moved = like(&first, light + R"(, "intensity": 2}, "objects": [)" + square +
                                              R"(, "position": [1, 0, 0], )" + picture + "}, " + square + "}]}");
  const auto state = moved.stage->at(0);
  ASSERT_EQ(state->instances.size(), 2u);
  EXPECT_EQ(state->instances[0].model, model) << "the same pictures";
  EXPECT_EQ(state->instances[0].geometry, model->rest);
  EXPECT_EQ(state->instances[0].world_from_object.translation, Vector(1, 0, 0));
  EXPECT_EQ(state->environment->image, first.stage->at(0)->environment->image);
  EXPECT_EQ(state->environment->intensity, 2);
  EXPECT_EQ(moved.stage->models().size(), 1u);

  const StageWithFiles plain = like(&moved, R"({"objects": [)" + square + "}]}"); // without the picture
  EXPECT_EQ(plain.stage->models()[0]->textures.size(), 1u);
  EXPECT_EQ(plain.stage->models()[0]->rest, model->rest);
  std::filesystem::rename(folder.path("other.ppm"), folder.path("models/other.ppm"));
  const StageWithFiles again = like(&plain, R"({"objects": [)" + square + ", " + picture + "}]}");
  EXPECT_NE(again.stage->models()[0]->textures.at(1).image, nullptr);
  EXPECT_EQ(again.stage->models()[0]->rest, model->rest);

  EXPECT_THROW(like(&first, R"({"objects": [{"model": "models/other.ac"}]})"), InputError);
  EXPECT_THROW(like(&plain, R"({"objects": [{"model": "models/runner.md2"}]})"), InputError)
    << "it was in no scene of late";
  EXPECT_THROW(like(nullptr, R"({"objects": [)" + square + "}]}"), InputError);
}

TEST(StageModels, PicturesAreThoseOfTheSceneThatNamesThem)
{
  const ModelFolder first;
  const TemporaryFolder second;
  writeFile(first.path("t.ppm"), redPpm);
  writeFile(second.path("t.ppm"), std::string("P6\n1 1\n255\n\0\0\xff", 14));
  const std::string text = R"({"objects": [{"model": ")" + first.path("models/square.ac") +
                           R"(", "materials": {"*": {"texture": "t.ppm"}}}]})";
  const auto texel = [](const StageWithFiles& loaded)
  { return loaded.stage->models().at(0)->textures.at(1).image->rgba; };
  const StageWithFiles before = loadLike(readSceneText(text, first.path()), nullptr);
  EXPECT_THAT(texel(before), testing::ElementsAre(255, 0, 0, 255));
  const StageWithFiles after = loadLike(readSceneText(text, second.path()), before.files.get());
  EXPECT_THAT(texel(after), testing::ElementsAre(0, 0, 255, 255));
}

TEST(StageModels, PicturesThatWereMissingAreLookedForAgain)
{
  const ModelFolder folder;
  const std::string text =
    R"({"objects": [{"model": "models/square.ac", "materials": {"*": {"texture": "late.ppm"}}}]})";
  const auto image = [](const StageWithFiles& loaded) { return loaded.stage->models().at(0)->textures.at(1).image; };
  const StageWithFiles before = loadLike(readSceneText(text, folder.path()), nullptr);
  EXPECT_EQ(image(before), nullptr);
  writeFile(folder.path("late.ppm"), redPpm);
  EXPECT_NE(image(loadLike(readSceneText(text, folder.path()), before.files.get())), nullptr);
}

TEST(StageModels, ASeriesWithoutRoomKeepsWhatItsLastSceneUses)
{
  const ModelFolder folder;
  SceneSeries series(0);
  const auto load = [&](const char* model)
  {
    const std::string text = R"({"objects": [{"model": ")" + std::string(model) + "\"}]}";
    return std::weak_ptr<const Model>(series.load(readSceneText(text, folder.path()))->models().at(0));
  };
  const auto square = load("models/square.ac");
  EXPECT_FALSE(square.expired());
  const auto runner = load("models/runner.md2");
  EXPECT_TRUE(square.expired());
  EXPECT_FALSE(runner.expired());
}

TEST(StageModels, FilesAreListed)
{
  const ModelFolder folder;
  const auto stage = folder.load(R"({"objects": [{"model": "models/square.ac",
    "materials": {"red": {"texture": "models/other.ppm"}}}, {"model": "models/square.ac"}]})");
  EXPECT_EQ(stage->inputFiles(), (std::vector<std::string>{ folder.path("scene.json"), folder.path("models/square.ac"),
                                   folder.path("models/red.ppm"), folder.path("models/other.ppm") }));
}

TEST(StageModels, FilesBesideAModelAreListed)
{
  const ModelFolder folder;
  writeFile(folder.path("models/runner.anm"), "jump 0 1 5\n");
  const auto stage = folder.load(runner(R"("sequence": "jump")"));
  EXPECT_EQ(stage->inputFiles(),
    (std::vector<std::string>{ folder.path("scene.json"), folder.path("models/runner.md2"),
      folder.path("models/runner.anm"), folder.path("models/one.ppm"), folder.path("models/two.ppm") }));
}

TEST(StageModels, ObjectsWithoutSurfacesHaveNoId)
{
  const ModelFolder folder;
  std::vector<std::string> warnings;
  const auto stage = folder.load(
    R"({"objects": [{"model": "models/empty.ac"}, {"model": "models/square.ac", "class": "wall", "name": "w"}]})",
    [&](const std::string& line) { warnings.push_back(line); });
  EXPECT_EQ(stage->objectNames(), std::vector<std::string>{ "w" });
  EXPECT_EQ(stage->at(0)->instances[0].className, "wall");
  EXPECT_THAT(warnings, testing::Contains(HasSubstr("has no surfaces")));
}

TEST(StageModels, IdsFollowTheOrderOfTheScene)
{
  const ModelFolder folder;
  const auto stage = folder.load(R"({"objects": [{"name": "a", "model": "models/square.ac"},
    {"name": "b", "model": "models/square.ac"}], "lights": [{}], "order": ["object", "light", "object"]})");
  EXPECT_EQ(stage->objectNames(), (std::vector<std::string>{ "a", "b" }));
}

TEST(StageModels, WarningsOfAModelNameItsFile)
{
  const ModelFolder folder;
  std::filesystem::remove(folder.path("models/red.ppm"));
  std::vector<std::string> warnings;
  folder.load(R"({"objects": [{"model": "models/square.ac"}, {"model": "models/square.ac"}]})",
    [&](const std::string& line) { warnings.push_back(line); });
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].rfind(folder.path("models/square.ac") + ": texture 'red.ppm' not found", 0), 0u) << warnings[0];
}

TEST(StageModels, AllPicturesOfASceneAreInOneStore)
{
  const ModelFolder folder;
  const std::string picture = "P6 512 512 255\n" + std::string(512 * 512 * 3, 'r'); // 1 MiB of texels
  writeFile(folder.path("models/other.ac"), squareAc);
  writeFile(folder.path("models/red.ppm"), picture);
  writeFile(folder.path("models/blue.ppm"), picture);
  const auto load = [&folder](const std::string& more)
  { return folder.load(R"({"objects": [{"model": "models/square.ac"}, {"model": "models/square.ac"})" + more); };
  ::setenv("DGTK_TEXTURE_MEMORY", "1", 1);
  EXPECT_EQ(load("]}")->models().size(), 1u);
  const auto both = load(
    R"(, {"model": "models/other.ac", "materials": {"*": {"texture": "models/red.ppm", "emissionMap": "red.ppm"}}}]})");
  ASSERT_EQ(both->models().size(), 2u);
  EXPECT_EQ(both->models()[0]->textures.at(0).image, both->models()[1]->textures.at(0).image) << "decoded once";
  EXPECT_EQ(both->models()[0]->textures.at(0).image, both->models()[1]->textures.at(1).image);
  for (const std::string more : { R"(], "environment": {"image": "models/red.ppm"}})",
         R"(, {"model": "models/square.ac", "materials": {"*": {"texture": "models/blue.ppm"}}}]})" })
  {
    EXPECT_THAT(thrownBy<MachineError>([&] { load(more); }),
      HasSubstr(".ppm: a texture of 512 x 512 pixels; with it, all textures take "))
      << more;
  }
  ::unsetenv("DGTK_TEXTURE_MEMORY");
}

// They are read beside one another.
TEST(StageModels, ManyModelsAreToldOfInTheScenesOrder)
{
  const ModelFolder folder;
  std::filesystem::remove(folder.path("models/red.ppm"));
  std::string objects;
  std::vector<std::string> expected;
  for (int i = 0; i < 40; ++i)
  {
    const std::string name = "models/" + std::to_string(i) + ".ac";
    writeFile(folder.path(name), squareAc);
    objects += (i == 0 ? "" : ",\n") + ("{\"model\": \"" + name) + "\"}";
    expected.push_back(folder.path(name));
  }
  std::vector<std::string> warned;
  const auto stage = folder.load("{\"objects\": [" + objects + "]}",
    [&](const std::string& line) { warned.push_back(line.substr(0, line.find(": "))); });
  EXPECT_EQ(warned, expected) << "of the missing picture";
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    EXPECT_EQ(stage->models().at(i)->path, expected[i]);
  }
  writeFile(folder.path("models/38.ac"), "no model");
  writeFile(folder.path("models/11.ac"), "no model");
  EXPECT_THAT(folder.refusalOf("{\"objects\": [" + objects + "]}"), HasSubstr("scene.json:12: object '11-1': model: "));
}

// MD2 plays 10 frames a second: at 20 scene frames a second, half a model frame each.
TEST(StageModels, AnimationsFollowTheirClock)
{
  const ModelFolder folder;
  const auto looped = folder.load(runner(""));
  for (const auto& [frame, expected] : std::vector<std::pair<double, double>>{
         { 0, 0 }, { 1, 0.5 }, { 2, 1 }, { 6, 3 }, { 7, 1.5 }, { 8, 0 }, { 9, 0.5 } })
  {
    EXPECT_NEAR(advanced(*looped, frame), expected, 1e-12) << frame;
  }
  const auto held = folder.load(runner(R"("loop": false, "start": 4, "rate": 2)"));
  for (const auto& [frame, expected] :
    std::vector<std::pair<double, double>>{ { 0, 0 }, { 4, 0 }, { 5, 1 }, { 7, 3 }, { 8, 3 }, { 1e6, 3 } })
  {
    EXPECT_NEAR(advanced(*held, frame), expected, 1e-12) << frame;
  }
  EXPECT_EQ(held->at(8)->instances[0].geometry, held->at(1e6)->instances[0].geometry);
  const Model& model = *looped->models().at(0);
  EXPECT_EQ(sequenceSpan(model, 0, true), 4);
  EXPECT_EQ(sequenceSpan(model, 0, false), 3);
  EXPECT_EQ(sequenceSpan(model, 1, true), 0);
  const auto still = folder.load(runner(R"("rate": 0, "offset": 2)"));
  EXPECT_EQ(advanced(*still, 50), 0);
  const auto other = folder.load(runner(R"("sequence": "rest")"));
  const auto number = folder.load(runner(R"("sequence": "1")"));
  writeFile(folder.path("models/runner.anm"), "pair 0 1 10\n");
  const auto pair = folder.load(runner(R"("sequence": "pair")"));
  for (const auto& [frame, expected] : std::vector<std::pair<double, double>>{ { 2, 1 }, { 3, 0.5 }, { 4, 0 } })
  {
    EXPECT_NEAR(advanced(*pair, frame), expected, 1e-12) << frame;
  }
  const Vector moved =
    other->at(0)->instances[0].geometry->positions[0] - looped->at(0)->instances[0].geometry->positions[0];
  EXPECT_NEAR(moved.norm(), 10, 1e-12);
  EXPECT_EQ(number->at(0)->instances[0].geometry->positions[0], other->at(0)->instances[0].geometry->positions[0]);
}

TEST(StageModels, InstancesInTheSamePoseShareIt)
{
  const ModelFolder folder;
  const auto stage = folder.load(R"({"objects": [{"model": "models/runner.md2"}, {"model": "models/runner.md2"},
    {"model": "models/runner.md2", "animation": {"offset": 1}},
    {"model": "models/runner.md2", "animation": {"rate": 0}}]})");
  const auto state = stage->at(1);
  EXPECT_EQ(state->instances[0].geometry, state->instances[1].geometry);
  EXPECT_NE(state->instances[0].geometry, state->instances[2].geometry);
  EXPECT_EQ(state->instances[3].geometry, stage->at(2)->instances[3].geometry);
}

namespace
{
/// A triangle in the plane z = 0 whose third corner is as high as the number of the frame.
class Flap : public Deformation
{
public:
  void positionsAt(int /*animation*/, double frame, std::vector<Vector>& positions) const override
  {
    positions = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, frame } };
  }
};

std::shared_ptr<Model> makeFlap()
{
  auto model = std::make_shared<Model>();
  model->triangles = { { 0, 1, 2 } };
  model->sourceVertex = { 0, 1, 2 };
  model->sourceVertices = 3;
  model->normalGroup = { 0, 0, 0 };
  model->animations = { { "flap", 0, 1, 10, false } };
  model->deformation = std::make_shared<Flap>();
  model->rest = geometryAt(*model, 0, 0);
  return model;
}
} // namespace

// On the way from the last frame to the first one.
TEST(StageModels, NormalsPassFromTheEndToTheBeginning)
{
  const auto flap = makeFlap();
  const auto there = GeometryCache().get(*flap, { 0, 1, 0.25 });
  EXPECT_EQ(there->positions[2], Vector(0, 1, 0.75));
  const Eigen::Vector3f up(0, 0, 1);
  const Eigen::Vector3f tilted = Eigen::Vector3f(0, -1, 1).normalized();
  EXPECT_LT((there->normals[0] - (0.75f * tilted + 0.25f * up).normalized()).norm(), 1e-6f);
  const Eigen::Vector3f upright = Eigen::Vector3f(0, -10, 1).normalized();
  EXPECT_LT((GeometryCache().get(*flap, { 0, 10, 0.5 })->normals[0] - (upright + up).normalized()).norm(), 1e-6f);
}

TEST(StageModels, KeypointsAreVerticesOfTheFileByItsNumbers)
{
  const ModelFolder folder;
  writeFile(folder.path("a.obj"), "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\nf 4 3 5\n");
  writeFile(folder.path("a.stl"),
    "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n");
  const auto scene = [](const std::string& file, const std::string& points)
  { return R"({"objects": [{"name": "a", "model": ")" + file + R"(", "keypoints": )" + points + "}]}"; };
  const auto state = folder.load(scene("a.obj", R"({"x": 2, "y": 3, "first": 1, "last": 4})"))->at(0);
  std::vector<Vector> places;
  for (const KeypointState& point : state->instances[0].keypoints)
  {
    places.push_back(point.x_in_object);
  }
  EXPECT_EQ(places, (std::vector<Vector>{ { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 0 }, { 0, 0, 0 } }));
  const std::string prefix = "scene.json:1: object 'a': keypoints.k is ";
  EXPECT_EQ(folder.refusalOf(scene("a.obj", R"({"k": 0})")),
    prefix + "a vertex of no triangle of a.obj (expected a vertex of a surface, found 0)");
  EXPECT_EQ(folder.refusalOf(scene("a.obj", R"({"k": 5})")),
    prefix + "no vertex of a.obj (expected a whole number below 5, found 5)");
  EXPECT_EQ(folder.refusalOf(scene("a.stl", R"({"k": 0})")),
    prefix + "the number of a vertex: those of a.stl are not numbered (expected a point [x, y, z], found 0)");
  EXPECT_EQ(folder.refusalOf(scene("a.stl", R"({"k": [0, 0, 0]})")), "");
}

TEST(StageModels, RefusalsNameTheSceneAndTheObject)
{
  const ModelFolder folder;
  EXPECT_EQ(folder.refusalOf("{\"objects\": [\n{\"name\": \"x\", \"model\": \"models/none.ac\"}]}"),
    "scene.json:2: object 'x': model: models/none.ac: cannot be read: No such file or directory");
  EXPECT_THAT(folder.refusalOf("{\"objects\": [\n{\"model\": \"scene.json\"}]}"),
    HasSubstr("scene.json:2: object 'scene-1': model: scene.json: "));
  EXPECT_THAT(folder.refusalOf("{\"objects\": [{\"model\": \"models\"}]}"), HasSubstr("scene.json:1: object"));
  EXPECT_THAT(
    folder.refusalOf("{\"objects\": [{\"model\": \"models/square.ac\", \"animation\": {\"sequence\": \"run\"}}]}"),
    HasSubstr("animation.sequence is no sequence of models/square.ac (expected none, found 'run')"));
  EXPECT_THAT(
    folder.refusalOf("{\"objects\": [{\"model\": \"models/runner.md2\", \"animation\": {\"sequence\": \"run\"}}]}"),
    HasSubstr("(expected one of go, rest, found 'run')"));
  EXPECT_THAT(
    folder.refusalOf("{\"objects\": [{\"model\": \"models/runner.md2\", \"animation\": {\"sequence\": \"2\"}}]}"),
    HasSubstr("(expected one of go, rest, found '2')"));
  EXPECT_THAT(folder.refusalOf("{\"objects\": [{\"model\": \"models/square.ac\", \"materials\": {\"blue\": {}}}]}"),
    HasSubstr("materials: no material of models/square.ac has this name (expected * or one of red, found 'blue')"));
}

TEST(StageModels, AllThatAreMissingAreNamedAtOnce)
{
  const ModelFolder folder;
  const std::string json = "{\"objects\": [{\"model\": \"models/a.ac\"},\n{\"model\": \"models/square.ac\"},\n"
                           "{\"model\": \"models/../models/a.ac\"},\n{\"model\": \"b.obj\"}]}";
  EXPECT_EQ(folder.refusalOf(json), "scene.json: 2 model files are missing: models/a.ac (line 1), b.obj (line 4)");
  const std::vector<MissingModel> missing = missingModels(readScene(folder.path("scene.json")));
  ASSERT_EQ(missing.size(), 2u);
  EXPECT_EQ(missing[0].model, "models/a.ac");
  EXPECT_EQ(missing[0].path, folder.path("models/a.ac"));
  EXPECT_EQ(missing[0].objects, (std::vector<std::size_t>{ 0, 2 }));
  EXPECT_EQ(missing[1].objects, (std::vector<std::size_t>{ 3 }));
}

TEST(StageModels, FixedClassesAreThoseOfTheInstancesAndAnInput)
{
  const ModelFolder folder;
  writeFile(folder.path("classes.json"), R"({"wall": 12, "": 300})");
  const auto stage = folder.load(R"({"classes": "classes.json", "objects": [{"model": "models/square.ac"},
    {"model": "models/square.ac", "class": "wall"}]})");
  EXPECT_EQ(stage->at(0)->instances[0].classId, 300u);
  EXPECT_EQ(stage->at(0)->instances[1].classId, 12u);
  EXPECT_EQ(stage->inputFiles()[1], folder.path("classes.json"));
}

TEST(StageModels, ThesisScenesLoad)
{
  const ModelFolder folder;
  writeFile(folder.path("a.scene"),
    "3\nglObject_AC: models/square.ac\nglObject_Light:\nglObject_Camera: ( 60, 0.1, 1000, 1.33 )\n"
    "[ 0 0 5, 0 0 0, 0 1 0 ]\n2\n0\n< 0 0 0 > { 1, < 0, 0, 0 > }\n< 0 9 0 > { 1, < 0, 0, 0 > }\n"
    "< 0 0 5 > { 1, < 0, 0, 0 > }\n< 0 0 0 > { 1, < 0, 0, 0 > }\n4\n< 4 0 0 > { 1, < 0, 0, 0 > } [ 3 1 1 ]\n"
    "< 0 9 0 > { 1, < 0, 0, 0 > }\n< 0 0 5 > { 1, < 0, 0, 0 > }\n< 0 0 0 > { 1, < 0, 0, 0 > }\n");
  const auto stage = Stage::load(readScene(folder.path("a.scene")));
  const auto state = stage->at(2);
  EXPECT_EQ(state->instances.at(0).world_from_object * Vector(1, 1, 0), Vector(4, 1, 0));
  EXPECT_EQ(state->lights.at(0).position, Vector(0, 9, 0));
  // gluPerspective's aspect: fx differs from fy a little at 640 x 480.
  const Eigen::Matrix3d K = stage->view(0, 0).model->linear()->K;
  EXPECT_NEAR(K(0, 0) / K(1, 1), 640.0 / 480 / 1.33, 1e-12);
}
