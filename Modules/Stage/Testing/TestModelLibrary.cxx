// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelClock.h"
#include "dgtkModelLibrary.h"
#include "dgtkStageSamples.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

using namespace dgtk;
using namespace dgtk::test;
using testing::ElementsAre;
using testing::HasSubstr;
using Vector = Eigen::Vector3d;

TEST(ModelLibrary, TheBoxOfAModelThatIsNotThere)
{
  const ModelFolder folder;
  SceneDescription scene;
  scene.folder = folder.path();
  scene.objects.resize(2);
  scene.objects[0].name = "lost";
  scene.objects[0].model = "models/lost.ac";
  scene.objects[1].name = "there";
  scene.objects[1].model = "models/square.ac";
  ModelLibrary library;
  EXPECT_THROW(library.load(scene), InputError);
  EXPECT_EQ(library.size(), 0u);
  ASSERT_TRUE(library.load(scene, {}, AbsentModel::Box));
  EXPECT_EQ(library.absent(scene), std::vector<std::size_t>{ 0 });
  EXPECT_EQ(library.size(), 2u);
  EXPECT_TRUE(library.lookOf(scene, scene.objects[0]).standsIn);
  EXPECT_FALSE(library.lookOf(scene, scene.objects[1]).standsIn);
  const std::shared_ptr<const Model> box = library.modelOf(scene, scene.objects[0]);
  ASSERT_TRUE(box);
  EXPECT_EQ(box->boundsMin, Vector(-0.5, -0.5, -0.5));
  EXPECT_EQ(box->boundsMax, Vector(0.5, 0.5, 0.5));
  EXPECT_EQ(box->sourceVertices, 24u);
  EXPECT_EQ(box->sourceVertex.size(), 24u);
  EXPECT_EQ(box->materials.at(0).diffuse, Vector(0.5, 0.5, 0.5));
  EXPECT_EQ(box->materials.at(0).ambient, Vector(0.5, 0.5, 0.5));
  ASSERT_EQ(box->parts.size(), 1u);
  EXPECT_EQ(box->parts[0].name, "missing");
  EXPECT_EQ(box->parts[0].triangles, 12u);
  ASSERT_EQ(box->triangles.size(), 12u);
  double area = 0;
  double volume = 0;
  std::set<std::uint32_t> used;
  for (const auto& t : box->triangles)
  {
    const Vector a = box->rest->positions[t[0]];
    const Vector b = box->rest->positions[t[1]];
    const Vector c = box->rest->positions[t[2]];
    const Vector across = (b - a).cross(c - a) / 2;
    area += across.norm();
    volume += a.dot(across) / 3;
    for (const std::uint32_t v : t)
    {
      used.insert(v);
      EXPECT_EQ(box->rest->positions[v].cwiseAbs(), Vector(0.5, 0.5, 0.5));
      EXPECT_LT((box->rest->normals[v].cast<double>() - across.normalized()).norm(), 1e-6) << "from outside";
      EXPECT_EQ(box->sourceVertex[v], v);
    }
  }
  EXPECT_EQ(used.size(), 24u);
  EXPECT_NEAR(area, 6, 1e-12);
  EXPECT_NEAR(volume, 1, 1e-12);

  // It stays a box without being asked for, until the file is there.
  EXPECT_TRUE(library.load(scene));
  ModelLibrary other;
  other.adopt(library);
  EXPECT_EQ(other.size(), 2u);
  EXPECT_EQ(other.absent(scene), std::vector<std::size_t>{ 0 });
  writeFile(folder.path("models/lost.ac"), squareAc);
  EXPECT_EQ(other.absent(scene), std::vector<std::size_t>{ 0 }) << "nobody has looked";
  EXPECT_TRUE(other.load(scene));
  EXPECT_EQ(other.absent(scene), std::vector<std::size_t>{});
  EXPECT_EQ(other.modelOf(scene, scene.objects[0])->format, "ac3d");
  library.adopt(other);
  EXPECT_EQ(library.modelOf(scene, scene.objects[0])->format, "ac3d") << "in place of the box";
}

TEST(ModelLibrary, LooksAreSharedAndWarningsSaidOnce)
{
  const ModelFolder folder;
  std::filesystem::remove(folder.path("models/red.ppm"));
  SceneDescription scene;
  scene.folder = folder.path();
  scene.objects.resize(5);
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
  {
    scene.objects[i].name = "o" + std::to_string(i);
    scene.objects[i].model = i == 4 ? "models/../models/empty.ac" : "models/square.ac";
  }
  scene.objects[1].position = Vector(1, 2, 3);
  scene.objects[1].className = "other";
  scene.objects[1].visible = false;
  MaterialOverride blue;
  blue.material = "*";
  blue.diffuse = Vector(0, 0, 1);
  scene.objects[2].materials = { blue };
  scene.objects[3].materials = { blue };
  scene.objects[3].scale = Vector(2, 2, 2);
  scene.objects[3].position = Vector(1, 2, 3);
  scene.objects[3].orientation = Quaternion{ 0, 1, 0, 0 };
  scene.objects[3].className = "third";
  scene.objects[3].parent = "o1";
  scene.objects[3].visible = false;
  scene.objects[3].animation.start = 7;
  scene.environment.image = "none.hdr";
  ModelLibrary library;
  EXPECT_TRUE(library.load(scene));
  EXPECT_EQ(library.size(), 3u) << "plain, blue, empty";
  ASSERT_EQ(library.warnings().size(), 3u);
  EXPECT_THAT(library.warnings()[0], HasSubstr("texture 'red.ppm' not found"));
  EXPECT_THAT(library.warnings()[1], HasSubstr(folder.path("models/empty.ac: has no surfaces")));
  EXPECT_THAT(library.warnings()[2], HasSubstr("environment: 'none.hdr' not found"));
  EXPECT_TRUE(library.load(scene));
  EXPECT_EQ(library.warnings().size(), 3u);
  EXPECT_EQ(library.environment(scene), nullptr);
  const auto at = [&](std::size_t i) { return library.at(scene, scene.objects[i], 0); };
  EXPECT_EQ(at(0).materials, at(1).materials);
  EXPECT_EQ(at(2).materials, at(3).materials);
  EXPECT_EQ(at(0).model, at(2).model);
  EXPECT_EQ(at(0).materials->at(0).diffuse, Vector(1, 0, 0));
  EXPECT_EQ(at(2).materials->at(0).diffuse, Vector(0, 0, 1));
  EXPECT_EQ(at(4).model, nullptr);
  EXPECT_NE(library.modelOf(scene, scene.objects[4]), nullptr);
  ObjectDescription unknown;
  unknown.model = "models/other.ac";
  EXPECT_EQ(library.modelOf(scene, unknown), nullptr);
  EXPECT_EQ(library.lookOf(scene, unknown).model, nullptr);
  writeFile(folder.path("sky.ppm"), redPpm);
  scene.environment.image = "sky.ppm";
  EXPECT_EQ(library.environment(scene), nullptr) << "not loaded yet";
  EXPECT_TRUE(library.load(scene));
  ASSERT_NE(library.environment(scene), nullptr);
  ModelLibrary other;
  other.adopt(library);
  EXPECT_EQ(other.environment(scene), library.environment(scene));
  EXPECT_EQ(other.warnings(), library.warnings());
  EXPECT_EQ(other.size(), 3u);
  scene.objects[0].animation.sequence = "walk";
  EXPECT_THROW(library.load(scene), InputError);
}

TEST(ModelLibrary, LooksThatMoveAreOneLook)
{
  const ModelFolder folder;
  SceneDescription scene;
  scene.folder = folder.path();
  scene.objects.resize(2);
  for (std::size_t i = 0; i < scene.objects.size(); ++i)
  {
    scene.objects[i].name = "o" + std::to_string(i);
    scene.objects[i].model = "models/square.ac";
    scene.objects[i].materials.resize(1);
    scene.objects[i].materials[0].material = "*";
    scene.objects[i].materials[0].opacity = Track<double>();
    scene.objects[i].materials[0].opacity->keys = { { 0, 1 }, { 4, 0.5 * double(i) } };
  }
  ModelLibrary library;
  EXPECT_TRUE(library.load(scene));
  EXPECT_EQ(library.size(), 1u) << "key frames are no other look";
  const auto at = [&](std::size_t i, double frame) { return library.at(scene, scene.objects[i], frame).materials; };
  EXPECT_EQ(at(0, 2)->at(0).opacity, 0.5);
  EXPECT_EQ(at(1, 2)->at(0).opacity, 0.75);
  EXPECT_EQ(at(0, 2), at(0, 2)) << "nothing to draw anew";
  scene.objects[0].materials[0].opacity->keys[1].value = 0.75;
  EXPECT_EQ(at(0, 4)->at(0).opacity, 0.75) << "without loading";
  const auto stage = Stage::make(scene, library);
  EXPECT_EQ(stage->at(4)->instances[0].materials->at(0).opacity, 0.75);
  EXPECT_EQ(stage->at(4)->instances[1].materials->at(0).opacity, 0.5);
}

/// A stage whose models somebody else has.
TEST(ModelLibrary, FeedsAStage)
{
  const ModelFolder folder;
  SceneDescription scene;
  scene.folder = folder.path();
  scene.objects.resize(4);
  const char* const models[] = { "models/runner.md2", "models/square.ac", "models/runner.md2", "models/lost.ac" };
  for (std::size_t i = 0; i < 4; ++i)
  {
    scene.objects[i].name = "o" + std::to_string(i);
    scene.objects[i].model = models[i];
  }
  scene.objects[3].animation.sequence = "of a model that is not there";
  ModelLibrary library;
  library.load(scene, {}, AbsentModel::Box);
  const auto stage = Stage::make(scene, library);
  EXPECT_EQ(stage->objectNames(), (std::vector<std::string>{ "o0", "o1", "o2", "o3" }));
  ASSERT_EQ(stage->models().size(), 3u);
  EXPECT_EQ(stage->models()[0]->format, "md2");
  EXPECT_EQ(stage->models()[1]->format, "ac3d");
  const auto state = stage->at(2.5);
  ASSERT_EQ(state->instances.size(), 4u);
  EXPECT_EQ(state->instances[0].geometry, state->instances[2].geometry);
  EXPECT_EQ(state->instances[0].geometry, library.at(scene, scene.objects[0], 2.5).geometry);
  EXPECT_EQ(state->instances[0].model, library.at(scene, scene.objects[0], 2.5).model);
  EXPECT_EQ(stage->at(2.5), state) << "the latest states are kept";
}
