// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMissingFiles.h"

#include "dgtkSceneDescription.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace dgtk;

TEST(MissingFiles, TheLikeliestFileIsTaken)
{
  namespace fs = std::filesystem;
  const test::TemporaryFolder folder;
  for (const char* path : { "b/m.ac", "a/m.ac", "z/trees/m.ac", "z/old/trees/m.ac", "z/n.ac/inside.txt", "q/o.ac",
         "y/l.ac", "x/l.ac", "w/l.ac", "v/k.ac", "w/k.ac", "x/k.ac" })
  {
    fs::create_directories(fs::path(folder.path(path)).parent_path());
    std::ofstream(folder.path(path)) << path;
  }
  std::size_t reports = 0;
  const auto found =
    findModels({ "m.ac", "trees/m.ac", "old/trees/m.ac", "n.ac", "p.ac", "l.ac", "k.ac" }, folder.path());
  EXPECT_EQ(
    found, (std::map<std::string, std::string>{ { "k.ac", folder.path("v/k.ac") }, { "l.ac", folder.path("w/l.ac") },
             { "m.ac", folder.path("a/m.ac") }, { "trees/m.ac", folder.path("z/old/trees/m.ac") },
             { "old/trees/m.ac", folder.path("z/old/trees/m.ac") } }));
  EXPECT_TRUE(findModels({ "m.ac" }, folder.path("nowhere")).empty());
  for (int i = 0; i < 520; ++i)
  {
    std::ofstream(folder.path("q/" + std::to_string(i)));
  }
  findModels({ "p.ac" }, folder.path("q"),
    [&](std::size_t looked, std::size_t)
    {
      EXPECT_EQ(looked, 256 * ++reports);
      return true;
    });
  EXPECT_EQ(reports, 2u);
  reports = 0;
  findModels({ "p.ac" }, folder.path("q"), [&](std::size_t, std::size_t) { return ++reports > 1; });
  EXPECT_EQ(reports, 1u) << "it stops where it is told to";

  SceneDescription scene;
  scene.folder = folder.path("z");
  scene.objects.resize(3);
  scene.objects[0].model = "m.ac";
  scene.objects[1].model = "other.ac";
  scene.objects[2].model = "m.ac";
  EXPECT_EQ(modelsOf(scene, { 2, 1, 0 }), (std::vector<std::string>{ "m.ac", "other.ac" }));
  replaceModels(scene, { { "m.ac", folder.path("a/m.ac") } });
  EXPECT_EQ(scene.objects[0].model, "../a/m.ac");
  EXPECT_EQ(scene.objects[1].model, "other.ac");
  EXPECT_EQ(scene.objects[2].model, "../a/m.ac");
}
