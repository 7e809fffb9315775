// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneDocument.h"

#include "dgtkError.h"
#include "dgtkSceneEdits.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace
{
using namespace dgtk;
using Strings = std::vector<std::string>;

const SceneItem first{ SceneItem::Kind::Light, 0 };
const SceneItem second{ SceneItem::Kind::Light, 1 };

/// Takes everything back; the texts of the steps, the last one first.
Strings stepsOf(SceneDocument& document)
{
  Strings steps;
  while (document.canUndo())
  {
    steps.push_back(document.undoText());
    document.undo();
  }
  return steps;
}

void twoLights(SceneDocument& document)
{
  document.addLight({});
  document.addLight({});
}

void put(SceneDocument& document, const SceneItem& item, double x, const std::string& merge, bool whole = false,
  const std::string& text = "Move")
{
  const auto change = [&](SceneDescription& scene) { setItemPosition(scene, item, 0, { x, 0, 0 }); };
  whole ? document.edit(text, change, merge) : document.editItem(text, item, change, merge);
}

TEST(DocumentSteps, WhichOnesAreOne)
{
  struct Row
  {
    const char* merge;
    SceneItem item;
    bool whole;
    std::size_t steps; ///< behind two lights and a move of the first one with "drag"
  };
  for (const Row& row : std::vector<Row>{ { "drag", first, false, 3 }, { "drag", second, false, 4 },
         { "drag", first, true, 4 }, { "other", first, false, 4 }, { "", first, false, 4 } })
  {
    SceneDocument document;
    twoLights(document);
    put(document, first, 1, "drag");
    put(document, row.item, 2, row.merge, row.whole, "Again");
    EXPECT_EQ(document.undoText(), row.steps == 3 ? "Move" : "Again");
    const std::string last = document.json();
    EXPECT_EQ(stepsOf(document).size(), row.steps) << row.merge;
    while (document.canRedo())
    {
      document.redo();
    }
    EXPECT_EQ(document.json(), last);
  }
  for (const bool whole : { false, true })
  {
    SceneDocument document;
    twoLights(document);
    put(document, first, 1, "", whole);
    put(document, first, 2, "", whole);
    EXPECT_EQ(stepsOf(document), (Strings{ "Move", "Move", "Add light", "Add light" })) << "they name nothing";
    EXPECT_EQ(document.undoText(), "");
    EXPECT_EQ(document.redoText(), "Add light");
    EXPECT_TRUE(document.scene().lights.empty());
  }
}

TEST(DocumentSteps, EndsOfMergedSteps)
{
  for (const bool whole : { false, true })
  {
    SceneDocument document;
    twoLights(document);
    document.abandon();
    document.finishMerging();
    EXPECT_EQ(document.undoText(), "Add light") << "nothing to end";
    put(document, first, 1, "drag", whole);
    put(document, first, 2, "drag", whole);
    document.abandon();
    EXPECT_EQ(document.scene().lights[0].position.value.x(), 0);
    EXPECT_EQ(document.undoText(), "Add light");
    EXPECT_FALSE(document.canRedo());
    put(document, first, 3, "drag", whole);
    document.finishMerging();
    document.abandon();
    EXPECT_EQ(document.scene().lights[0].position.value.x(), 3) << "it is ended";
    put(document, first, 4, "drag", whole);
    document.undo();
    EXPECT_EQ(document.scene().lights[0].position.value.x(), 3);
    // What was undone and done again is no drag any more, nor is the step before it.
    document.redo();
    put(document, first, 5, "drag", whole);
    document.undo();
    EXPECT_EQ(document.scene().lights[0].position.value.x(), 4);
    put(document, first, 6, "drag", whole);
    put(document, second, 7, "", whole);
    document.undo();
    put(document, first, 8, "drag", whole);
    document.undo();
    EXPECT_EQ(document.scene().lights[0].position.value.x(), 6);
    // An abandoned drag leaves what could be done again, a finished one does not.
    document.undo();
    ASSERT_EQ(document.scene().lights[0].position.value.x(), 4);
    put(document, first, 9, "drag", whole);
    EXPECT_FALSE(document.canRedo());
    document.abandon();
    ASSERT_TRUE(document.canRedo());
    document.redo();
    EXPECT_EQ(document.scene().lights[0].position.value.x(), 6);
    document.undo();
    put(document, first, 9, "drag", whole);
    document.finishMerging();
    EXPECT_FALSE(document.canRedo());
  }
}

TEST(DocumentSteps, ModifiedIsWhatTheFileHasNot)
{
  const test::TemporaryFolder folder;
  SceneDocument document;
  EXPECT_FALSE(document.modified());
  EXPECT_EQ(document.path(), "");
  EXPECT_EQ(document.scene().folder, std::filesystem::current_path().generic_string());
  int changes = 0;
  document.onChange([&] { ++changes; });
  const auto expectChange = [&](bool modified)
  {
    EXPECT_EQ(changes, 1);
    EXPECT_EQ(document.modified(), modified);
    changes = 0;
  };
  document.addLight({});
  expectChange(true);
  document.undo();
  expectChange(false);
  document.undo();
  document.redo();
  expectChange(true);
  document.redo();
  EXPECT_EQ(changes, 0);
  document.saveAs(folder.path("a.json"));
  expectChange(false);
  document.writeCopy(folder.path("b.json"));
  EXPECT_EQ(changes, 0);
  EXPECT_EQ(document.path(), folder.path("a.json"));
  EXPECT_EQ(test::contentsOf(folder.path("a.json")), test::contentsOf(folder.path("b.json")));
  document.undo();
  expectChange(true);
  document.addCamera({});
  expectChange(true);
  document.undo();
  expectChange(true); // the way to the saved scene is gone
  document.remove({});
  EXPECT_EQ(changes, 0);
  const std::size_t scenes = document.opened();
  document.open(folder.path("b.json"));
  expectChange(false);
  EXPECT_EQ(document.opened(), scenes + 1);
  EXPECT_EQ(document.path(), folder.path("b.json"));
  EXPECT_FALSE(document.canUndo() || document.canRedo());
  document.recover(*SceneDocument::read(folder.path("b.json")), folder.path("a.json"));
  expectChange(true);
  EXPECT_EQ(document.opened(), scenes + 2);
  EXPECT_EQ(document.path(), folder.path("a.json"));
  document.addLight({});
  document.undo();
  EXPECT_TRUE(document.modified());
  changes = 0;
  document.clear();
  expectChange(false);
  EXPECT_EQ(document.opened(), scenes + 3);
  EXPECT_EQ(document.path(), "");
  EXPECT_TRUE(document.scene().lights.empty());
  EXPECT_EQ(document.models().size(), 0u);
  put(document, document.addLight({}), 1, "drag");
  changes = 0;
  document.abandon();
  expectChange(true);
  // An abandoned drag does not close the way to the saved scene.
  document.saveAs(folder.path("c.json"));
  document.undo();
  put(document, document.addLight({}), 1, "drag");
  document.undo();
  document.undo();
  document.addLight({});
  document.saveAs(folder.path("c.json"));
  document.addLight({});
  document.undo();
  document.undo();
  document.addLight({});
  EXPECT_TRUE(document.modified());
  document.saveAs(folder.path("c.json"));
  document.addLight({});
  document.saveAs(folder.path("c.json"));
  document.undo();
  ASSERT_TRUE(document.canRedo());
  put(document, first, 1, "drag");
  EXPECT_FALSE(document.canRedo());
  document.abandon();
  document.redo();
  EXPECT_FALSE(document.modified());
}

TEST(DocumentSteps, ASaveEndsADrag)
{
  const test::TemporaryFolder folder;
  SceneDocument document;
  twoLights(document);
  put(document, first, 0, "drag"); // where it is
  document.saveAs(folder.path("a.json"));
  EXPECT_EQ(document.undoText(), "Add light") << "it changed nothing";
  put(document, first, 1, "drag");
  document.saveAs(folder.path("a.json"));
  document.abandon();
  EXPECT_EQ(document.scene().lights[0].position.value.x(), 1);
  EXPECT_FALSE(document.modified());
}

TEST(DocumentSteps, WhatIsAdded)
{
  const test::TemporaryFolder folder;
  std::filesystem::copy_file(test::sourceFile("Data/Models/crate.ac"), folder.path("crate.ac"));
  std::ofstream(folder.path("s.json")) << "{}";
  SceneDocument document;
  document.open(folder.path("s.json"));
  EXPECT_EQ(document.addModel(folder.path("crate.ac")), (SceneItem{ SceneItem::Kind::Object, 0 }));
  EXPECT_EQ(document.undoText(), "Import crate.ac");
  EXPECT_EQ(document.addModel(folder.path("crate.ac")), (SceneItem{ SceneItem::Kind::Object, 1 }));
  EXPECT_EQ(document.scene().objects[0].name, "crate-1");
  EXPECT_EQ(document.scene().objects[1].name, "crate-2");
  EXPECT_EQ(document.scene().objects[0].model, "crate.ac");
  EXPECT_EQ(document.models().size(), 1u);
  LightDescription named;
  named.name = "lamp";
  EXPECT_EQ(document.addLight(named), (SceneItem{ SceneItem::Kind::Light, 0 }));
  document.addLight({});
  document.addLight({});
  EXPECT_EQ(document.scene().lights[0].name, "lamp");
  EXPECT_EQ(document.scene().lights[1].name, "Light0");
  EXPECT_EQ(document.scene().lights[2].name, "Light1");
  EXPECT_EQ(document.undoText(), "Add light");
  EXPECT_EQ(document.addCamera({}), (SceneItem{ SceneItem::Kind::Camera, 0 }));
  EXPECT_EQ(document.scene().cameras[0].name, "Camera0");
  EXPECT_EQ(document.undoText(), "Add camera");
  const auto more = document.modelReader(test::sourceFile("Data/Models/tree.ac"))({});
  ASSERT_TRUE(more.has_value());
  EXPECT_EQ(more->size(), 2u);
  EXPECT_EQ(document.models().size(), 1u);
  ASSERT_NE(document.modelIn(*more, test::sourceFile("Data/Models/tree.ac")), nullptr);
  EXPECT_FALSE(
    document.modelReader(test::sourceFile("Data/Models/vase.pov"))([](std::size_t, std::size_t) { return false; }));
  document.remove({ { SceneItem::Kind::Object, 0 }, { SceneItem::Kind::Light, 1 } });
  EXPECT_EQ(document.undoText(), "Delete");
  EXPECT_EQ(document.scene().objects.size(), 1u);
  EXPECT_EQ(document.scene().lights[1].name, "Light1");
}

TEST(DocumentSteps, ARefusedEditOfAnItemLeavesItAsItWas)
{
  SceneDocument document;
  twoLights(document);
  document.addCamera({});
  document.addModel(test::sourceFile("Data/Models/crate.ac"));
  const std::string before = document.json();
  const std::vector<std::function<void(SceneDescription&)>> changes{ [](SceneDescription& s)
    { s.lights[0].intensity = -1; },
    [](SceneDescription& s) { s.cameras[0].near = -1; },
    [](SceneDescription& s) { s.objects[0].scale = Eigen::Vector3d(0, 1, 1); } };
  const SceneItem items[] = { first, { SceneItem::Kind::Camera, 0 }, { SceneItem::Kind::Object, 0 } };
  for (std::size_t i = 0; i < 3; ++i)
  {
    EXPECT_THROW(document.editItem("Change", items[i], changes[i]), InputError);
    EXPECT_EQ(document.json(), before);
  }
  EXPECT_EQ(document.undoText(), "Import crate.ac");
}

/// Whole scenes are kept up to 400,000 items: of 40,000 (20,000 before and behind) ten.
TEST(DocumentSteps, OldStepsOfLargeScenesAreForgotten)
{
  SceneDescription large;
  large.lights.resize(20000);
  for (std::size_t i = 0; i < large.lights.size(); ++i)
  {
    large.lights[i].name = std::to_string(i);
  }
  struct Row
  {
    std::size_t before, behind; ///< steps before and behind a save
    std::size_t undone;
    bool modified; ///< when all is undone
  };
  const test::TemporaryFolder folder;
  for (const Row& row : std::vector<Row>{ { 0, 10, 10, false }, { 2, 11, 10, true }, { 3, 10, 10, false } })
  {
    SceneDocument document;
    LoadedScene loaded;
    loaded.scene = large;
    document.install(std::move(loaded));
    const auto edit = [&](std::size_t count)
    {
      for (std::size_t i = 0; i < count; ++i)
      {
        document.edit("Fog", [](SceneDescription& scene) { scene.fog.density.value += 0.5; });
      }
    };
    edit(row.before);
    if (row.before > 0)
    {
      document.saveAs(folder.path("large.json"));
    }
    edit(row.behind);
    EXPECT_EQ(stepsOf(document).size(), row.undone);
    EXPECT_EQ(document.scene().fog.density.value, 0.5 * double(row.before + row.behind - row.undone));
    EXPECT_EQ(document.modified(), row.modified) << row.before;
  }
  // Steps of an item hold two.
  SceneDocument document;
  LoadedScene loaded;
  loaded.scene = large;
  document.install(std::move(loaded));
  for (int i = 0; i < 10; ++i)
  {
    document.edit("Fog", [](SceneDescription& scene) { scene.fog.density.value += 0.5; });
  }
  put(document, first, 1, "");
  put(document, first, 2, "");
  EXPECT_EQ(stepsOf(document).size(), 11u) << "one of the ten has gone";
  EXPECT_TRUE(document.modified());
}

TEST(DocumentSteps, RefusalsNameTheFileThatTheSceneHas)
{
  const test::TemporaryFolder folder;
  const std::string first_file = folder.path("a.json");
  const std::string second_file = folder.path("b.json");
  std::ofstream(first_file) << "{}";
  SceneDocument document;
  const auto expectFile = [&document](const std::string& file)
  {
    EXPECT_EQ(document.scene().file, file);
    const std::string message =
      test::thrownBy<InputError>([&] { document.edit("Rate", [](SceneDescription& scene) { scene.fps = -1; }); });
    EXPECT_EQ(message.rfind(file, 0), 0u) << message;
  };
  document.open(first_file);
  document.addLight({});
  document.addLight({});
  document.undo();
  expectFile(first_file);
  document.saveAs(second_file);
  expectFile(second_file);
  document.undo();
  expectFile(second_file);
  document.redo();
  document.redo();
  expectFile(second_file);
  document.recover(*SceneDocument::read(second_file), first_file);
  expectFile(first_file);
}
} // namespace
