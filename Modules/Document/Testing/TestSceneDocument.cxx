// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneDocument.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkMissingFiles.h"
#include "dgtkScenePlaces.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>

namespace
{
using namespace dgtk;
using test::contentsOf;
using test::sourceFile;

constexpr int edits = 500;
constexpr std::size_t mostItems = 30; // each edit writes the whole scene

class RandomEditor
{
public:
  RandomEditor(SceneDocument& document, unsigned int seed)
    : Document(document)
    , Engine(seed)
  {
  }

  // One edit of a random kind; refused ones are part of the game.
  void edit()
  {
    const SceneItem item = this->anyItem();
    const int frame = this->below(20);
    const bool full = this->Document.scene().items().size() > mostItems;
    switch (full ? 0 : this->below(10))
    {
      case 0:
        this->Document.remove({ item });
        break;
      case 1:
        this->Document.paste("Duplicate", extractItems(this->Document.scene(), { item, this->anyItem() }));
        break;
      case 2:
        this->Document.edit("Key", [&](SceneDescription& scene) { makeKeyFrame(scene, frame); });
        break;
      case 3:
        this->Document.edit("Key", [&](SceneDescription& scene) { removeKeyFrame(scene, frame); });
        break;
      case 4:
        this->Document.edit("Rename",
          [&](SceneDescription& scene) { renameItem(scene, item, "name" + std::to_string(this->below(40))); });
        break;
      case 5:
        this->Document.addLight({});
        break;
      case 6:
        this->Document.addModel(sourceFile(this->below(2) ? "Data/Models/crate.ac" : "Data/Models/vase.pov"));
        break;
      case 7:
        this->turn(item, frame);
        break;
      default:
        this->Document.editItem(
          "Move", item, [&](SceneDescription& scene) { setItemPosition(scene, item, frame, this->vector()); },
          this->below(2) ? "drag" : "");
    }
  }

  int below(int end) { return int(this->Engine() % unsigned(end)); }

private:
  Eigen::Vector3d vector()
  {
    return { this->below(2000) / 100.0 - 10, this->below(2000) / 100.0 - 10, this->below(2000) / 100.0 - 10 };
  }

  SceneItem anyItem()
  {
    const std::vector<SceneItem> items = this->Document.scene().items();
    if (items.empty())
    {
      return this->Document.addLight({});
    }
    return items[std::size_t(this->below(int(items.size())))];
  }

  void turn(const SceneItem& item, int frame)
  {
    if (item.kind == SceneItem::Kind::Object)
    {
      const double angle = this->below(628) / 100.0;
      this->Document.editItem("Turn", item,
        [&](SceneDescription& scene)
        {
          setTrackAt(
            scene.objects[item.index].orientation, frame, Quaternion{ std::cos(angle), 0, std::sin(angle), 0 });
          setTrackAt<Eigen::Vector3d>(scene.objects[item.index].scale, frame, Eigen::Vector3d(1, this->below(3), 1));
        });
    }
  }

  SceneDocument& Document;
  std::mt19937 Engine;
};

TEST(SceneDocument, FiveHundredRandomEditsAreUndoneAndRedoneExactly)
{
  for (const unsigned int seed : { 1u })
  {
    SceneDocument document;
    document.open(sourceFile("Data/Scenes/demo.json"));
    const std::string first = document.json();
    RandomEditor editor(document, seed);
    int refused = 0;
    for (int i = 0; i < edits; ++i)
    {
      const std::string before = document.json();
      try
      {
        editor.edit();
      }
      catch (const InputError&)
      {
        ++refused;
        ASSERT_EQ(document.json(), before) << "a refused edit left something behind";
      }
    }
    EXPECT_GT(refused, 0);
    EXPECT_LT(refused, edits / 2);
    const std::string last = document.json();
    EXPECT_NE(last, first);
    std::vector<std::string> way;
    while (document.canUndo())
    {
      way.push_back(document.json());
      document.undo();
    }
    EXPECT_GT(way.size(), std::size_t(edits / 4));
    EXPECT_EQ(document.json(), first);
    EXPECT_FALSE(document.modified());
    while (document.canRedo())
    {
      document.redo();
      ASSERT_EQ(document.json(), way.back());
      way.pop_back();
    }
    EXPECT_EQ(document.json(), last);
    EXPECT_TRUE(way.empty());
  }
}

TEST(SceneDocument, SavedAndReopenedItIsTheSameScene)
{
  const test::TemporaryFolder folder;
  for (const char* name : { "demo.json", "parenting.json", "cameras_all_kinds.json", "fig_b1_half_circle.scene" })
  {
    SceneDocument document;
    document.open(sourceFile(std::string("Data/Scenes/") + name));
    RandomEditor editor(document, 7);
    for (int i = 0; i < 20; ++i)
    {
      try
      {
        editor.edit();
      }
      catch (const InputError&)
      {
      }
    }
    ASSERT_TRUE(document.modified());
    const std::string path = folder.path("saved.json");
    document.saveAs(path);
    EXPECT_FALSE(document.modified());
    EXPECT_EQ(document.path(), path);
    SceneDocument again;
    again.open(path);
    EXPECT_EQ(toJson(document.scene(), folder.path()), toJson(again.scene(), folder.path()));
    EXPECT_EQ(again.models().size() > 0, !again.scene().objects.empty());
  }
}

TEST(SceneDocument, NumbersOfClassesStay)
{
  const test::TemporaryFolder folder;
  std::filesystem::create_directories(folder.path("scenes"));
  std::ofstream(folder.path("classes.json")) << R"({ "tree": 7, "house": 3 })";
  for (const std::string classes : { R"("../classes.json")", R"({ "tree": 7, "house": 3 })" })
  {
    std::ofstream(folder.path("scenes/a.json")) << "{ \"classes\": " << classes << " }";
    SceneDocument document;
    document.open(folder.path("scenes/a.json"));
    document.addLight({});
    document.saveAs(folder.path("b.json"));
    SceneDocument again;
    again.open(folder.path("b.json"));
    EXPECT_EQ(again.scene().classIdOf("tree"), 7) << classes;
    EXPECT_EQ(again.scene().classIdOf("house"), 3) << classes;
    EXPECT_EQ(again.scene().classFile, classes[0] == '"' ? "classes.json" : "");
  }
}

TEST(SceneDocument, ThesisScenesSayWhatTheyCannotHold)
{
  const test::TemporaryFolder folder;
  SceneDocument document;
  document.open(sourceFile("Data/Scenes/demo.json"));
  document.addLight({});
  const std::string path = folder.path("old.scene");
  std::ofstream(path) << "what was there";
  EXPECT_THAT(
    test::thrownBy<InputError>([&] { document.saveAs(path); }), testing::HasSubstr("cannot be said in .scene"))
    << "a scene with classes became a .scene";
  EXPECT_EQ(contentsOf(path), "what was there");
  EXPECT_TRUE(document.modified());
  EXPECT_EQ(document.path(), sourceFile("Data/Scenes/demo.json"));

  SceneDocument plain;
  plain.open(sourceFile("Data/Scenes/fig_b1_half_circle.scene"));
  const std::string before = plain.json();
  plain.saveAs(folder.path("plain.scene"));
  SceneDocument again;
  again.open(folder.path("plain.scene"));
  EXPECT_EQ(toJson(again.scene(), folder.path()), toJson(plain.scene(), folder.path()));
  EXPECT_EQ(plain.json(), before);
}

TEST(SceneDocument, WhatCannotBeReadLeavesTheSceneAsItWas)
{
  const test::TemporaryFolder folder;
  SceneDocument document;
  document.open(sourceFile("Data/Scenes/demo.json"));
  document.addLight({});
  const std::string before = document.json();
  std::ofstream(folder.path("broken.json")) << "{ \"objects\": [ { ] }";
  std::ofstream(folder.path("lost.json")) << R"({ "objects": [ { "model": "broken.ac" } ] })";
  std::ofstream(folder.path("broken.ac")) << "no model at all\n";
  for (const char* name : { "broken.json", "lost.json", "missing.json", "missing.scene" })
  {
    EXPECT_THROW(document.open(folder.path(name)), InputError) << name;
  }
  for (const char* name : { "broken.ac", "missing.ac", "name.xyz" })
  {
    EXPECT_THROW(document.addModel(folder.path(name)), InputError) << name;
  }
  EXPECT_THROW(
    document.edit("Scale", [](SceneDescription& scene) { scene.objects[0].scale = Eigen::Vector3d(0, 1, 1); }),
    InputError);
  EXPECT_EQ(document.json(), before);
  EXPECT_EQ(document.path(), sourceFile("Data/Scenes/demo.json"));
  EXPECT_TRUE(document.modified());
  document.undo();
  EXPECT_FALSE(document.modified());
}

TEST(SceneDocument, WhatIsNotThereIsABoxUntilItIsFound)
{
  namespace fs = std::filesystem;
  const test::TemporaryFolder folder;
  const std::string text = R"({ "objects": [ { "name": "a", "model": "models/crate.ac", "position": [4, 0, 0] },
    { "name": "b", "model": "models/crate.ac", "materials": { "*": { "diffuse": [1, 0, 0] } } },
    { "name": "c", "model": "models/walker.md2", "animation": { "sequence": "walk" } },
    { "name": "d", "model": "none.ac" } ] })";
  std::ofstream(folder.path("lost.json")) << text;
  SceneDocument document;
  document.open(folder.path("lost.json"));
  EXPECT_EQ(document.absent(), (std::vector<std::size_t>{ 0, 1, 2, 3 }));
  const ScenePlaces boxes = placeScene(document.scene(), document.models(), 0);
  EXPECT_EQ(boxes.objects[0].box.min, Eigen::Vector3d(3.5, -0.5, -0.5));
  EXPECT_EQ(boxes.objects[0].box.max, Eigen::Vector3d(4.5, 0.5, 0.5));

  // Edits and saving leave the paths as they are.
  document.editItem("Move", document.scene().items().front(),
    [](SceneDescription& scene) { scene.objects[0].position = Eigen::Vector3d(5, 0, 0); });
  document.saveAs(folder.path("again.json"));
  SceneDocument again;
  again.open(folder.path("again.json"));
  EXPECT_EQ(again.json(), document.json());
  EXPECT_EQ(again.scene().objects[2].animation.sequence, "walk");
  EXPECT_THROW(document.addModel(folder.path("models/other.ac")), InputError) << "what is imported is there";

  const std::string library = folder.path("library");
  fs::create_directories(library + "/models");
  fs::create_directories(library + "/aaa");
  for (const char* place : { "/models/crate.ac", "/aaa/crate.ac" })
  {
    fs::copy_file(sourceFile("Data/Models/crate.ac"), library + place);
  }
  const std::vector<std::string> wanted = modelsOf(document.scene(), document.absent());
  EXPECT_EQ(wanted, (std::vector<std::string>{ "models/crate.ac", "models/walker.md2", "none.ac" }));
  const std::map<std::string, std::string> found = findModels(wanted, library);
  EXPECT_EQ(found, (std::map<std::string, std::string>{ { "models/crate.ac", library + "/models/crate.ac" } }));
  const std::string before = document.json();
  document.edit("Find models", [&](SceneDescription& scene) { replaceModels(scene, found); });
  EXPECT_EQ(document.absent(), (std::vector<std::size_t>{ 2, 3 }));
  EXPECT_EQ(document.scene().objects[1].model, "library/models/crate.ac");
  EXPECT_EQ(document.models().modelOf(document.scene(), document.scene().objects[0])->format, "ac3d");
  document.undo();
  EXPECT_EQ(document.json(), before);
  EXPECT_EQ(document.absent().size(), 4u);

  // A file that is there again is read by the next edit.
  fs::copy_file(sourceFile("Data/Models/crate.ac"), folder.path("none.ac"));
  document.redo();
  document.addLight({});
  EXPECT_EQ(document.absent(), (std::vector<std::size_t>{ 2 }));
}

TEST(SceneDocument, StepsOfADragAreOneStepAndASaveIsBetween)
{
  const test::TemporaryFolder folder;
  SceneDocument document;
  document.open(sourceFile("Data/Scenes/demo.json"));
  const std::string first = document.json();
  const SceneItem house{ SceneItem::Kind::Object, 1 };
  const auto drag = [&](double x)
  {
    document.editItem(
      "Move", house,
      [&](SceneDescription& s) {
        setItemPosition(s, house, 0, { x, 0, 0 });
      },
      "drag");
  };
  for (int i = 0; i < 100; ++i)
  {
    drag(i);
  }
  document.saveAs(folder.path("dragged.json"));
  const std::string saved = document.json();
  drag(1000);
  EXPECT_TRUE(document.modified());
  document.undo();
  EXPECT_EQ(document.json(), saved);
  EXPECT_FALSE(document.modified());
  document.undo();
  EXPECT_EQ(document.json(), first);
  EXPECT_TRUE(document.modified());
  drag(5);
  document.finishMerging();
  drag(6);
  document.undo();
  EXPECT_EQ(document.scene().objects[1].position.value.x(), 5);
  document.undo();
  EXPECT_FALSE(document.canUndo());
  EXPECT_TRUE(document.modified()) << "the file holds another position";
}

TEST(SceneDocument, ADragThatChangesNothingIsNoStep)
{
  SceneDocument document;
  document.open(sourceFile("Data/Scenes/demo.json"));
  const std::string first = document.json();
  const SceneItem house{ SceneItem::Kind::Object, 1 };
  const Eigen::Vector3d place = itemPosition(document.scene(), house, 0);
  document.editItem("Move", house, [&](SceneDescription& s) { setItemPosition(s, house, 0, { 1, 2, 3 }); });
  document.undo();
  const auto drag = [&](const Eigen::Vector3d& to, bool whole)
  {
    const auto change = [&](SceneDescription& s) { setItemPosition(s, house, 0, to); };
    whole ? document.edit("Move", change, "drag") : document.editItem("Move", house, change, "drag");
  };
  for (const bool whole : { false, true })
  {
    drag({ 4, 5, 6 }, whole);
    EXPECT_TRUE(document.modified());
    drag(place, whole);
    document.finishMerging();
    EXPECT_FALSE(document.canUndo()) << whole;
    EXPECT_FALSE(document.modified()) << whole;
    EXPECT_TRUE(document.canRedo()) << whole;
    EXPECT_EQ(document.json(), first);
  }
  document.redo();
  drag(place, false);
  document.finishMerging();
  EXPECT_TRUE(document.modified() && document.canUndo()) << "there and back are two steps";
  // Also of an object whose parent is another one.
  document.edit("Parent", [](SceneDescription& s) { s.objects[2].parent = s.objects[1].name; });
  const SceneItem child{ SceneItem::Kind::Object, 2 };
  document.editItem(
    "Move", child, [&](SceneDescription& s) { s.objects[2].visible = true; }, "drag");
  document.finishMerging();
  EXPECT_EQ(document.undoText(), "Parent");
}

TEST(SceneDocument, WhatOthersWriteIntoItsFileIsNoticed)
{
  const test::TemporaryFolder folder;
  const std::string path = folder.path("scene.json");
  const auto writeFog = [&](const char* density)
  { writeFile(path, R"({"fog": {"density": )" + std::string(density) + "}}"); };
  writeFog("0.25");
  SceneDocument document;
  EXPECT_FALSE(document.isReplaced()) << "it has no file";
  document.open(path);
  EXPECT_FALSE(document.isReplaced());
  writeFog("0.25");
  EXPECT_FALSE(document.isReplaced()) << "the same bytes";
  writeFog("0.75");
  EXPECT_TRUE(document.isReplaced());
  document.saveAs(path);
  EXPECT_FALSE(document.isReplaced());
  std::filesystem::remove(path);
  EXPECT_TRUE(document.isReplaced()) << "it has gone";
  writeFog("0.5");
  document.recover(*SceneDocument::read(path), path);
  EXPECT_FALSE(document.isReplaced());
  writeFog("0.75");
  EXPECT_TRUE(document.isReplaced());
  document.clear();
  EXPECT_FALSE(document.isReplaced());
}

TEST(SceneDocument, ModelsThatHaveChangedSinceTheyWereReadAreNamed)
{
  using testing::ElementsAre;
  using testing::IsEmpty;
  const test::TemporaryFolder folder;
  const auto writeModel = [&](const char* name, const char* side)
  { writeFile(folder.path(name), "v 0 0 0\nv " + std::string(side) + " 0 0\nv 0 1 0\nf 1 2 3\n"); };
  writeModel("a.obj", "1");
  writeModel("b.obj", "1");
  writeFile(
    folder.path("scene.json"), R"({"objects": [{"name": "a", "model": "a.obj"}, {"name": "c", "model": "gone.obj"}]})");
  SceneDocument document;
  document.open(folder.path("scene.json"));
  document.addModel(folder.path("b.obj"));
  EXPECT_THAT(document.takeReplacedModels(), IsEmpty());
  writeModel("a.obj", "22");
  EXPECT_THAT(document.takeReplacedModels(), ElementsAre(folder.path("a.obj")));
  writeModel("b.obj", "22");
  EXPECT_THAT(document.takeReplacedModels(), ElementsAre(folder.path("b.obj"))) << "once each";
  document.undo();
  writeModel("a.obj", "333");
  writeModel("b.obj", "333");
  EXPECT_THAT(document.takeReplacedModels(), ElementsAre(folder.path("a.obj"))) << "of the scene as it is";
  document.open(folder.path("scene.json"));
  EXPECT_THAT(document.takeReplacedModels(), IsEmpty()) << "read again";
  std::filesystem::remove(folder.path("a.obj"));
  EXPECT_THAT(document.takeReplacedModels(), ElementsAre(folder.path("a.obj")));
  document.clear();
  writeModel("a.obj", "3");
  document.addModel(folder.path("a.obj"));
  EXPECT_THAT(document.takeReplacedModels(), IsEmpty());
}

TEST(SceneDocument, CommentsThatSavingRemovesAreKnown)
{
  const test::TemporaryFolder folder;
  const std::string path = folder.path("scene.json");
  for (const auto& [text, has] : std::vector<std::pair<const char*, bool>>{ { R"({"units": "m"})", false },
         { R"({"units": "km//h"})", false }, { R"({"units": "a\"//b"})", false }, { R"({"units": "a\\"} // b)", true },
         { R"({"units": /* of length */ "m"})", true } })
  {
    writeFile(path, text);
    SceneDocument document;
    document.open(path);
    EXPECT_EQ(document.losesComments(), has) << text;
    document.saveAs(path);
    EXPECT_FALSE(document.losesComments()) << text;
  }
  SceneDocument document;
  EXPECT_FALSE(document.losesComments());
  document.saveAs(folder.path("scene.scene"));
  writeFile(folder.path("scene.scene"), "Model /a.ac\n");
  EXPECT_FALSE(document.losesComments()) << "not JSON";
}

TEST(SceneDocument, AThousandCopiesShareOneModel)
{
  SceneDocument document;
  const SceneItem tree = document.addModel(sourceFile("Data/Models/tree.ac"));
  const SceneDescription one = extractItems(document.scene(), { tree });
  document.edit("Forest",
    [&](SceneDescription& scene)
    {
      for (int i = 0; i < 1000; ++i)
      {
        appendItems(scene, one);
      }
    });
  EXPECT_EQ(document.models().size(), 1u);
  const Instance first = document.models().at(document.scene(), document.scene().objects.front(), 0);
  for (const ObjectDescription& object : document.scene().objects)
  {
    const Instance copy = document.models().at(document.scene(), object, 3);
    ASSERT_EQ(copy.geometry, first.geometry);
    ASSERT_EQ(copy.materials, first.materials);
  }
}
} // namespace
