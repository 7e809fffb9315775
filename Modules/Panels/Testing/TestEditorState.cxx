// SPDX-License-Identifier: BSD-3-Clause
// What is selected, the current frame, the clipboard and texts of numbers; on no display.
#include "dgtkEditorState.h"

#include "dgtkEditorLanguage.h"
#include "dgtkFourItems.h"
#include "dgtkNumberRow.h"
#include "dgtkTestWidgets.h"

#include <QSpinBox>
#include <QTranslator>

#include <gtest/gtest.h>

#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace
{
using namespace dgtk;
using namespace dgtk::test;

TEST(EditorState, SelectionsFollowTheirNames)
{
  EditorState state(nullptr);
  fill(state.document());
  int selections = 0;
  int changes = 0;
  std::vector<int> frames;
  QObject::connect(&state, &EditorState::selectionChanged, [&] { ++selections; });
  QObject::connect(&state, &EditorState::changed, [&] { ++changes; });
  QObject::connect(&state, &EditorState::frameChanged, [&](int frame) { frames.push_back(frame); });
  state.select({ lamp });
  state.select({ lamp });
  EXPECT_EQ(selections, 1);
  state.toggle(eye);
  EXPECT_EQ(state.selection(), (SceneItems{ lamp, eye }));
  EXPECT_TRUE(state.isSelected(eye) && !state.isSelected(crate));
  state.toggle(lamp);
  EXPECT_EQ(state.selection(), SceneItems{ eye });
  EXPECT_EQ(selections, 3);
  state.select({ crate });
  state.document().remove({ creature });
  EXPECT_EQ(state.selection(), SceneItems{ creature }) << "the crate is the first object now";
  EXPECT_EQ(itemName(state.scene(), state.selection()[0]), "crate");
  EXPECT_EQ(changes, 1);
  EXPECT_EQ(selections, 5);
  state.document().edit("Rename",
    [](SceneDescription& scene) {
      renameItem(scene, { SceneItem::Kind::Object, 0 }, "box");
    });
  EXPECT_EQ(selections, 5) << "it is the same";
  state.document().remove({ creature });
  EXPECT_TRUE(state.selection().empty());
  state.document().undo();
  state.document().undo();
  state.document().undo();
  state.selectAll();
  EXPECT_EQ(state.selection(), (SceneItems{ creature, crate, lamp, eye }));
  for (const auto& [frame, expected] : { std::pair(7, 7), std::pair(-3, 0), std::pair(5000000, largestFrame) })
  {
    state.setFrame(frame);
    state.setFrame(frame);
    EXPECT_EQ(state.frame(), expected);
  }
  EXPECT_EQ(frames, (std::vector<int>{ 7, 0, largestFrame }));
}

TEST(EditorState, TheClipboardHoldsFamilies)
{
  EditorState state(nullptr);
  fill(state.document());
  state.document().edit("Parent", [](SceneDescription& scene) { scene.objects[1].parent = "creature"; });
  std::vector<std::string> failures;
  QObject::connect(&state, &EditorState::failed, [&](const QString& text) { failures.push_back(text.toStdString()); });
  EXPECT_FALSE(state.canPaste());
  const std::string before = state.document().json();
  state.copy();
  state.paste();
  state.duplicate();
  state.cut();
  state.remove();
  EXPECT_FALSE(state.canPaste());
  EXPECT_EQ(state.document().json(), before) << "nothing is selected";
  state.select({ creature });
  state.copy();
  EXPECT_TRUE(state.canPaste());
  state.paste();
  EXPECT_EQ(state.document().undoText(), "Paste");
  ASSERT_EQ(state.scene().objects.size(), 4u) << "with what hangs on it";
  EXPECT_EQ(state.scene().objects[3].parent, state.scene().objects[2].name);
  EXPECT_EQ(state.selection().size(), 2u) << "the copies";
  state.document().undo();
  state.select({ lamp });
  state.duplicate();
  EXPECT_EQ(state.document().undoText(), "Duplicate");
  EXPECT_EQ(state.scene().lights.size(), 2u);
  EXPECT_EQ(state.selection(), (SceneItems{ { SceneItem::Kind::Light, 1 } }));
  state.cut();
  EXPECT_EQ(state.document().undoText(), "Cut");
  EXPECT_EQ(state.scene().lights.size(), 1u);
  EXPECT_TRUE(state.selection().empty());
  state.select({ creature });
  state.remove();
  EXPECT_EQ(state.document().undoText(), "Delete");
  EXPECT_TRUE(state.scene().objects.empty());
  state.paste();
  EXPECT_EQ(state.scene().lights.size(), 2u) << "what was cut last";
  EXPECT_TRUE(failures.empty());
  EXPECT_TRUE(state.attempt([] {}));
  EXPECT_FALSE(state.attempt([&] { state.document().addModel("/none.ac"); }));
  EXPECT_FALSE(state.attempt([] { throw std::bad_alloc(); }));
  ASSERT_EQ(failures.size(), 2u);
  EXPECT_NE(failures[0].find("/none.ac"), std::string::npos);
  EXPECT_EQ(failures[1], "The memory of this machine is not enough.");
}

TEST(EditorLanguage, OneThingIsNotSeveral)
{
  needApplication();
  SceneDescription scene;
  scene.lights.resize(1);
  scene.cameras.resize(2);
  EXPECT_EQ(contentsText(scene), "0 objects, 1 light, 2 cameras");
  QTranslator german;
  ASSERT_TRUE(german.load("dgtk-editor_de", ":/dgtk/translations"));
  QCoreApplication::installTranslator(&german);
  EXPECT_EQ(contentsText(scene), "0 Objekte, 1 Licht, 2 Kameras");
  scene.objects.resize(1);
  scene.lights.resize(3);
  scene.cameras.resize(1);
  EXPECT_EQ(contentsText(scene), "1 Objekt, 3 Lichter, 1 Kamera");
  QCoreApplication::removeTranslator(&german);
  EXPECT_EQ(contentsText(scene), "1 object, 3 lights, 1 camera");
}

TEST(NumberRow, TextsOfNumbers)
{
  needApplication();
  for (const auto& [text, value] :
    std::vector<std::pair<const char*, std::optional<double>>>{ { "1", 1 }, { " 1.5 ", 1.5 }, { "1,5", 1.5 },
      { "+2", 2 }, { "-0.25", -0.25 }, { "1e3", 1000 }, { "", {} }, { "1 2", {} }, { "1.5x", {} }, { "nan", {} },
      { "inf", {} }, { "1e999", {} }, { "--1", {} }, { "+-1", {} }, { "++1", {} }, { "+", {} }, { "x", {} } })
  {
    EXPECT_EQ(numberOf(text), value) << text;
  }
  EXPECT_EQ(numberText(0.1), "0.1");
  EXPECT_EQ(numberText(1e21), "1e+21");
  for (const auto& [number, pixels] :
    { std::pair(640.0, 640), std::pair(640.9, 640), std::pair(-5.0, -1), std::pair(1e30, 1 << 24), std::pair(0.0, 0) })
  {
    EXPECT_EQ(pixelsOf(number), pixels) << number;
  }
  QSpinBox* const box = makeNumber("n", 2, 9, 5);
  EXPECT_EQ(box->objectName(), "n");
  EXPECT_EQ(box->minimum(), 2);
  EXPECT_EQ(box->maximum(), 9);
  EXPECT_EQ(box->value(), 5);
  delete box;
}
} // namespace
