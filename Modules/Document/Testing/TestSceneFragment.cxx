// SPDX-License-Identifier: BSD-3-Clause
// Items on their way to a scene of another folder or program.
#include "dgtkSceneFragment.h"

#include "dgtkSceneEdits.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace
{
using namespace dgtk;

SceneDescription crates(const std::string& folder)
{
  SceneDescription scene;
  scene.folder = folder;
  scene.objects.resize(2);
  scene.objects[0].name = "below";
  scene.objects[0].model = "../models/crate.ac";
  scene.objects[0].parent = "elsewhere";
  scene.objects[1].name = "above";
  scene.objects[1].model = "/models/crate.ac";
  scene.objects[1].parent = "below";
  scene.objects[1].position = Eigen::Vector3d(0.1, -2, 1e-9);
  scene.cameras.emplace_back().name = "eye";
  return scene;
}

TEST(SceneFragment, PathsLeadToTheSameFilesInAnotherFolder)
{
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder.path("models"));
  const SceneDescription from = crates(folder.path("from"));
  const std::optional<SceneDescription> part = unpackFragment(packFragment(from));
  ASSERT_TRUE(part);
  SceneDescription to;
  to.folder = folder.path("a/b");
  EXPECT_EQ(appendItems(to, *part).size(), 3u);
  EXPECT_EQ(to.objects[0].model, "../../models/crate.ac");
  EXPECT_EQ(to.objects[0].parent, "") << "it is not there";
  EXPECT_EQ(to.objects[1].model, "/models/crate.ac");
  EXPECT_EQ(to.objects[1].parent, "below");
  EXPECT_EQ(to.objects[1].position.value, from.objects[1].position.value);
  EXPECT_EQ(to.cameras[0].name, "eye");
  // A text has no folder: its paths are those of the scene that it comes to.
  EXPECT_EQ(readFragment(fragmentText(from, from.folder), "/x")->objects[0].model, "../models/crate.ac");
}

TEST(SceneFragment, WhatIsDamagedOrForeignIsNone)
{
  const std::string packed = packFragment(crates("/x"));
  for (std::size_t size = 0; size + 3 < packed.size(); ++size)
  {
    ASSERT_FALSE(unpackFragment(packed.substr(0, size))) << size;
  }
  EXPECT_FALSE(unpackFragment(fragmentText(crates("/x"), "/x"))) << "it says no folder";
  for (const char* text : { "", "words", "[]", "{}", R"({"lights": []})", R"({"objects": [{"model": 3}]})" })
  {
    EXPECT_FALSE(readFragment(text, "/x")) << text;
  }
  EXPECT_TRUE(readFragment(R"({"lights": [{"kind": "point"}]})", "/x"));
}

/// The table of a camera's rays goes along, too.
TEST(SceneFragment, FilesOfCamerasAreFoundInAnotherFolder)
{
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder.path("from"));
  SceneDescription from;
  from.folder = folder.path("from");
  from.cameras.emplace_back().parameters["rays"].file = "table.npy";
  SceneDescription to;
  to.folder = folder.path("to");
  appendItems(to, from);
  EXPECT_EQ(to.cameras[0].parameters["rays"].file, "../from/table.npy");
}
} // namespace
