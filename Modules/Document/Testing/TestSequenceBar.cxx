// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneDocument.h"
#include "dgtkSequenceBar.h"

#include "dgtkError.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace dgtk;
using test::sourceFile;

const ObjectDescription& only(const SceneDocument& document) { return document.scene().objects.front(); }

std::optional<SequenceBar> barOf(const SceneDocument& document)
{
  return sequenceBar(document.scene(), only(document), document.models());
}

void change(SceneDocument& document, const std::function<void(ObjectDescription&)>& act)
{
  document.editItem(
    "change", { SceneItem::Kind::Object, 0 }, [&](SceneDescription& scene) { act(scene.objects.front()); });
}

/// The creature stands for 8 poses at 10 a second and walks for 12; the scene has 25 frames a second.
TEST(SequenceBar, LastsAsLongAsThePoses)
{
  SceneDocument document;
  document.addModel(sourceFile("Data/Models/creature.md2"));
  EXPECT_EQ(barOf(document)->name, "stand");
  EXPECT_EQ(barOf(document)->start, 0);
  EXPECT_TRUE(barOf(document)->loop);
  EXPECT_DOUBLE_EQ(barOf(document)->length, 8 * 2.5) << "the way back to the first pose included";
  change(document,
    [](ObjectDescription& object)
    {
      object.animation.sequence = "walk";
      object.animation.start = 7;
      object.animation.rate = 2;
      object.animation.loop = false;
    });
  EXPECT_EQ(barOf(document)->name, "walk");
  EXPECT_EQ(barOf(document)->start, 7);
  EXPECT_DOUBLE_EQ(barOf(document)->length, 11 * 2.5 / 2);
  change(document, [](ObjectDescription& object) { object.animation.offset = 3; });
  EXPECT_DOUBLE_EQ(barOf(document)->length, 8 * 2.5 / 2) << "what it leaves out at its beginning";
  change(document, [](ObjectDescription& object) { object.animation.rate = 0; });
  EXPECT_TRUE(std::isinf(barOf(document)->length));
  EXPECT_EQ(sequencesOf(document.scene(), only(document), document.models()),
    (std::vector<std::string>{ "stand", "walk", "jump" }));
}

TEST(SequenceBar, ItsEndIsWhereTheSequenceEnds)
{
  for (const char* model : { "creature.md2", "windmill.gltf" })
  {
    SceneDocument document;
    document.addModel(sourceFile(std::string("Data/Models/") + model));
    change(document,
      [&](ObjectDescription& object)
      {
        object.animation.start = 3;
        object.animation.loop = false;
        setSequenceLength(document.scene(), object, document.models(), 40);
      });
    EXPECT_NEAR(barOf(document)->length, 40, 1e-12);
    const auto shown = [&](double frame) { return document.models().at(document.scene(), only(document), frame); };
    EXPECT_EQ(shown(0).geometry, shown(3).geometry) << "it stands before its start";
    EXPECT_NE(shown(42).geometry->positions, shown(43).geometry->positions);
    EXPECT_EQ(shown(43.5).geometry->positions, shown(60).geometry->positions) << "and holds its last pose";
    // The same poses as those of a rendered scene.
    const auto stage = Stage::load(document.scene());
    for (const double frame : { 0.0, 17.5, 43.0 })
    {
      EXPECT_EQ(stage->at(frame)->instances[0].geometry->positions, shown(frame).geometry->positions) << frame;
    }
  }
}

TEST(SequenceBar, RigidModelsHaveNone)
{
  SceneDocument document;
  document.addModel(sourceFile("Data/Models/crate.ac"));
  EXPECT_FALSE(barOf(document));
  EXPECT_EQ(currentSequence(document.scene(), only(document), document.models()), -1);
  EXPECT_TRUE(sequencesOf(document.scene(), only(document), document.models()).empty());
  EXPECT_TRUE(sequencesOf(document.scene(), only(document), ModelLibrary()).empty()) << "not read yet";
}

TEST(SequenceBar, UnknownSequencesAreRefusedAndNothingIsReadAgain)
{
  SceneDocument document;
  document.addModel(sourceFile("Data/Models/creature.md2"));
  const std::string before = document.json();
  const std::string refusal = test::thrownBy<InputError>(
    [&] { change(document, [](ObjectDescription& object) { object.animation.sequence = "fly"; }); });
  EXPECT_NE(refusal.find("one of stand, walk, jump"), std::string::npos) << refusal;
  EXPECT_EQ(document.json(), before);
  change(document, [](ObjectDescription& object) { object.animation.sequence = "jump"; });
  EXPECT_EQ(document.models().size(), 1u);
}

TEST(ModelLibrary, StopsBetweenFilesAndIsThenAsBefore)
{
  SceneDocument document;
  document.open(sourceFile("Data/Scenes/demo.json"));
  ModelLibrary store;
  std::size_t asked = 0;
  std::size_t files = 0;
  const bool done = store.load(document.scene(),
    [&](std::size_t at, std::size_t total)
    {
      EXPECT_EQ(at, asked);
      files = total;
      return ++asked < 3;
    });
  EXPECT_FALSE(done);
  EXPECT_EQ(asked, 3u);
  EXPECT_GT(files, 3u);
  EXPECT_EQ(store.size(), 0u);
  EXPECT_TRUE(store.load(document.scene()));
  EXPECT_EQ(store.size(), document.models().size());
}
} // namespace
