// SPDX-License-Identifier: BSD-3-Clause
// Rows of numbers, the tree of a scene and the dialogs of cameras, lights and camera arrays, on no display.
#include "dgtkCameraArrayDialog.h"
#include "dgtkEditorState.h"
#include "dgtkItemDialogs.h"
#include "dgtkNumberRow.h"
#include "dgtkSceneTree.h"

#include "dgtkTestSupport.h"
#include "dgtkTestWidgets.h"

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QSpinBox>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

namespace
{
using namespace dgtk;
using V = Eigen::Vector3d;
using Numbers = std::vector<double>;

class PanelTables : public testing::Test
{
protected:
  void SetUp() override { test::needApplication(); }
};

TEST_F(PanelTables, RowsTakeWhatIsTyped)
{
  NumberRow row("p", 3, nullptr);
  std::vector<Numbers> edits;
  row.onEdit([&](const Numbers& values) { edits.push_back(values); });
  auto* const second = row.findChild<QLineEdit*>("p.1");
  auto* const third = row.findChild<QLineEdit*>("p.2");
  ASSERT_TRUE(second && third && row.findChild<QLineEdit*>("p.0"));
  row.setValues({ 1, 2.5, -3 });
  EXPECT_EQ(second->text(), "2.5");
  EXPECT_EQ(second->toolTip(), "2.5");
  EXPECT_TRUE(edits.empty());
  const auto type = [](QLineEdit* field, const char* text)
  {
    field->setText(text);
    field->setModified(true);
  };
  type(second, "7,25");
  row.setValues({ 4, 5, 6 });
  EXPECT_EQ(second->text(), "7,25") << "while something is typed there, it stays";
  EXPECT_EQ(third->text(), "6");
  row.commit();
  EXPECT_EQ(edits, (std::vector<Numbers>{ { 4, 7.25, 6 } }));
  EXPECT_EQ(row.values(), (Numbers{ 4, 7.25, 6 }));
  EXPECT_EQ(second->text(), "7.25");
  type(third, "no number");
  row.commit();
  EXPECT_EQ(edits.size(), 1u);
  EXPECT_EQ(third->text(), "6") << "the old value";
  type(third, "8");
  emit third->returnPressed();
  EXPECT_EQ(edits.back(), (Numbers{ 4, 7.25, 8 }));
  type(third, "9");
  emit third->editingFinished();
  EXPECT_EQ(edits.back(), (Numbers{ 4, 7.25, 9 }));
  row.takeTogether();
  type(third, "10");
  emit third->editingFinished();
  EXPECT_EQ(edits.size(), 3u) << "the row is not left: the focus is nowhere";
  emit third->returnPressed();
  EXPECT_EQ(edits.back(), (Numbers{ 4, 7.25, 10 }));
  // Undo is the window's where nothing is being typed.
  for (const bool typed : { false, true })
  {
    third->setModified(typed);
    EXPECT_EQ(test::takesUndo(*third), typed);
  }
}

/// The rows of a tree: name, kind, and what is selected.
std::string textOf(const QTreeWidget& tree)
{
  std::string text;
  for (int group = 0; group < tree.topLevelItemCount(); ++group)
  {
    const QTreeWidgetItem* const top = tree.topLevelItem(group);
    text += top->text(0).toStdString() + ":";
    for (int i = 0; i < top->childCount(); ++i)
    {
      text += " " + top->child(i)->text(0).toStdString() + "/" + top->child(i)->text(1).toStdString() +
              (top->child(i)->isSelected() ? "*" : "") + (top->child(i)->icon(0).isNull() ? "" : "!");
    }
    text += "\n";
  }
  return text;
}

TEST_F(PanelTables, TheTreeOfAScene)
{
  const test::TemporaryFolder folder;
  std::filesystem::copy_file(test::sourceFile("Data/Models/crate.ac"), folder.path("crate.ac"));
  std::ofstream(folder.path("s.json")) << R"({ "objects": [ { "name": "a", "model": "crate.ac", "class": "box" },
    { "name": "b", "model": "crate.ac", "visible": false }, { "name": "c", "model": "lost.ac" } ],
    "lights": [ { "name": "sun", "kind": "directional", "position": [0, 1, 0] }, { "name": "lamp" } ],
    "cameras": [ { "name": "eye", "eye": [0, 0, 5], "lookAt": [0, 0, 0] } ] })";
  EditorState state(nullptr);
  SceneTree tree(state, nullptr);
  EXPECT_EQ(textOf(tree), "Objects:\nLights:\nCameras:\n");
  state.document().open(folder.path("s.json"));
  EXPECT_EQ(
    textOf(tree), "Objects: a/box b/hidden c/missing!\nLights: sun/directional lamp/point\nCameras: eye/pinhole\n");
  EXPECT_TRUE(tree.topLevelItem(0)->child(2)->toolTip(0).contains("lost.ac"));
  state.select({ { SceneItem::Kind::Object, 1 }, { SceneItem::Kind::Camera, 0 } });
  EXPECT_EQ(
    textOf(tree), "Objects: a/box b/hidden* c/missing!\nLights: sun/directional lamp/point\nCameras: eye/pinhole*\n");
  state.select({ { SceneItem::Kind::Object, 0 }, { SceneItem::Kind::Object, 1 }, { SceneItem::Kind::Light, 1 } });
  EXPECT_EQ(
    textOf(tree), "Objects: a/box* b/hidden* c/missing!\nLights: sun/directional lamp/point*\nCameras: eye/pinhole\n");
  tree.clearSelection();
  EXPECT_TRUE(state.selection().empty());
  tree.topLevelItem(1)->child(0)->setSelected(true);
  EXPECT_EQ(state.selection(), (SceneItems{ { SceneItem::Kind::Light, 0 } }));
  state.document().edit("Hide", [](SceneDescription& scene) { scene.objects[0].visible = false; });
  EXPECT_EQ(textOf(tree).substr(0, 34), "Objects: a/box, hidden b/hidden c/") << "it keeps its class";
  state.document().undo();
  // What changes in the scene is seen; a name that is typed is an edit.
  state.document().edit("Class", [](SceneDescription& scene) { scene.objects[1].visible = true; });
  EXPECT_EQ(textOf(tree), "Objects: a/box b/ c/missing!\nLights: sun/directional* lamp/point\nCameras: eye/pinhole\n");
  state.document().edit("Model", [](SceneDescription& scene) { scene.cameras[0].model = "equirectangular"; });
  tree.topLevelItem(0)->child(0)->setText(0, "renamed");
  QApplication::processEvents();
  EXPECT_EQ(state.document().undoText(), "Rename");
  EXPECT_EQ(state.scene().objects[0].name, "renamed");
  std::string failure;
  QObject::connect(&state, &EditorState::failed, [&](const QString& message) { failure = message.toStdString(); });
  tree.topLevelItem(0)->child(1)->setText(0, "renamed");
  QApplication::processEvents();
  EXPECT_FALSE(failure.empty()) << "it is taken";
  EXPECT_EQ(state.scene().objects[1].name, "b");
  EXPECT_EQ(textOf(tree),
    "Objects: renamed/box b/ c/missing!\nLights: sun/directional* lamp/point\nCameras: eye/equirectangular\n");
}

TEST_F(PanelTables, ANameThatIsBeingTypedIsTakenBeforeOtherThings)
{
  EditorState state(nullptr);
  SceneTree tree(state, nullptr);
  std::vector<CameraDescription> cameras(2);
  cameras[0].name = "eye";
  cameras[1].name = "other";
  state.document().edit("all", [&](SceneDescription& scene) { scene.cameras = cameras; });
  const auto type = [&](const char* name)
  {
    tree.rename({ SceneItem::Kind::Camera, 0 });
    for (QLineEdit* editor : tree.viewport()->findChildren<QLineEdit*>())
    {
      editor->setText(editor->isHidden() ? "gone" : name);
    }
  };
  type("far eye");
  state.finishTyping();
  EXPECT_EQ(state.scene().cameras[0].name, "far eye");
  EXPECT_EQ(state.document().undoText(), "Rename");
  state.finishTyping();
  std::string failure;
  QObject::connect(&state, &EditorState::failed, [&](const QString& message) { failure = message.toStdString(); });
  type("other");
  state.finishTyping();
  EXPECT_FALSE(failure.empty()) << "it is taken";
  EXPECT_EQ(state.scene().cameras[0].name, "far eye");
  state.document().undo();
  EXPECT_EQ(state.scene().cameras[0].name, "eye") << "one step";
  QApplication::processEvents();
  EXPECT_EQ(textOf(tree), "Objects:\nLights:\nCameras: eye/pinhole other/pinhole\n");
}

/// What a dialog of camera arrays adds, or why not.
class ArrayDialog
{
public:
  explicit ArrayDialog(const CameraPath& path = {})
    : Dialog(first(), path, nullptr)
  {
    this->Dialog.onAdd([this](const std::vector<CameraDescription>& cameras) { this->Added = cameras; });
  }
  static CameraDescription first()
  {
    CameraDescription camera;
    camera.name = "c";
    camera.eye = V(1, 2, 8);
    camera.lookAt = V(1, 2, 0);
    camera.fovY = 35;
    camera.near = 0.5;
    return camera;
  }
  template <typename Field>
  Field* field(const char* name)
  {
    return this->Dialog.findChild<Field*>(name);
  }
  void type(const char* name, const char* text)
  {
    auto* const line = this->field<QLineEdit>(name);
    line->setText(text);
    line->setModified(true);
  }
  std::string add()
  {
    this->Added.clear();
    this->Dialog.accept();
    return this->Added.empty() ? this->field<QLabel>("fault")->text().toStdString() : std::string();
  }
  CameraArrayDialog Dialog;
  std::vector<CameraDescription> Added;
};

TEST_F(PanelTables, EachKindOfArrayHasItsFields)
{
  ArrayDialog array;
  auto* const kind = array.field<QComboBox>("kind");
  EXPECT_EQ(kind->currentIndex(), 0);
  ASSERT_EQ(kind->count(), 5);
  const char* const fields[] = { "eye", "count", "columns", "rows", "spacing", "path" };
  const char* const enabled[] = { "110000", "110000", "101110", "100010", "010001" };
  for (int i = 0; i < 5; ++i)
  {
    kind->setCurrentIndex(i);
    std::string found;
    for (const char* const name : fields)
    {
      found += array.field<QWidget>(name)->isEnabled() ? '1' : '0';
    }
    EXPECT_EQ(found, enabled[i]) << i;
    EXPECT_TRUE(array.field<QWidget>("lookAt")->isEnabled() && array.field<QWidget>("fovY")->isEnabled());
  }
  EXPECT_EQ(array.field<QSpinBox>("count")->value(), 8);
  EXPECT_EQ(array.field<QSpinBox>("count")->maximum(), 10000);
  EXPECT_EQ(array.field<QSpinBox>("columns")->value(), 3);
  EXPECT_EQ(array.field<QSpinBox>("rows")->maximum(), 100);
  EXPECT_EQ(array.field<QSpinBox>("rows")->minimum(), 1);
  EXPECT_EQ(array.field<NumberRow>("spacing")->values(), Numbers{ 0.1 });
  EXPECT_EQ(array.field<NumberRow>("eye")->values(), (Numbers{ 1, 2, 8 }));
  EXPECT_EQ(array.field<NumberRow>("lookAt")->values(), (Numbers{ 1, 2, 0 }));
  EXPECT_EQ(array.field<NumberRow>("fovY")->values(), Numbers{ 35 });
}

TEST_F(PanelTables, ArraysAreThoseOfTheFields)
{
  ArrayDialog array;
  auto* const kind = array.field<QComboBox>("kind");
  array.type("eye.0", "3");
  array.type("lookAt.2", "-1");
  array.type("fovY.0", "50");
  array.field<QSpinBox>("count")->setValue(5);
  ASSERT_EQ(array.add(), "");
  ASSERT_EQ(array.Added.size(), 5u);
  EXPECT_EQ(array.Added[0].name, "c-1");
  EXPECT_LT((array.Added[0].eye.value - V(3, 2, 8)).norm(), 1e-12);
  EXPECT_EQ(array.Added[0].lookAt.value, V(1, 2, -1));
  EXPECT_EQ(array.Added[0].fovY.value, 50);
  EXPECT_EQ(array.Added[0].near, 0.5);
  kind->setCurrentIndex(1);
  ASSERT_EQ(array.add(), "");
  EXPECT_EQ(array.Added.size(), 5u);
  EXPECT_GT(array.Added[4].eye.value.y(), array.Added[0].eye.value.y()) << "a hemisphere";
  kind->setCurrentIndex(2);
  array.field<QSpinBox>("columns")->setValue(4);
  array.field<QSpinBox>("rows")->setValue(2);
  array.type("spacing.0", "0.5");
  ASSERT_EQ(array.add(), "");
  ASSERT_EQ(array.Added.size(), 8u);
  EXPECT_NEAR((array.Added[1].eye.value - array.Added[0].eye.value).norm(), 0.5, 1e-12);
  kind->setCurrentIndex(3);
  ASSERT_EQ(array.add(), "");
  ASSERT_EQ(array.Added.size(), 2u);
  EXPECT_EQ(array.Added[1].name, "c-right");
  array.type("spacing.0", "0");
  EXPECT_NE(array.add().find("spacing"), std::string::npos);
  EXPECT_FALSE(array.field<QLabel>("fault")->isHidden());
  for (const int without : { 0, 1 })
  {
    kind->setCurrentIndex(without);
    EXPECT_EQ(array.add(), "") << "what a kind does not have is not asked about";
  }
  array.type("spacing.0", "1");
  kind->setCurrentIndex(0);
  array.Dialog.onAdd([](const std::vector<CameraDescription>&) { throw std::runtime_error("no room"); });
  EXPECT_EQ(array.add(), "no room");
}

TEST_F(PanelTables, PathsAreLinesOfPoints)
{
  ArrayDialog filled(CameraPath{ { V(0, 0, 5), V(1.5, 0, 5) }, { V(0, 0, 0), V(1, 2, 3) } });
  EXPECT_EQ(filled.field<QComboBox>("kind")->currentIndex(), 4);
  EXPECT_EQ(filled.field<QPlainTextEdit>("path")->toPlainText(), "0 0 5 0 0 0\n1.5 0 5 1 2 3");
  filled.field<QSpinBox>("count")->setValue(2);
  ASSERT_EQ(filled.add(), "");
  ASSERT_EQ(filled.Added.size(), 2u);
  EXPECT_EQ(filled.Added[1].eye.value, V(1.5, 0, 5));
  EXPECT_EQ(filled.Added[1].lookAt.value, V(1, 2, 3));
  EXPECT_EQ(ArrayDialog(CameraPath{ { V(0, 0, 5) }, { V(0, 0, 0) } }).field<QComboBox>("kind")->currentIndex(), 0)
    << "one point is no path";
  const auto path = [&](const char* text)
  {
    filled.field<QPlainTextEdit>("path")->setPlainText(text);
    return filled.add();
  };
  EXPECT_EQ(path("0, 0; 5\n\n 2 0 5 \n"), "");
  EXPECT_EQ(filled.Added[0].lookAt.value, V(1, 2, 0)) << "that of all";
  EXPECT_EQ(filled.Added[1].eye.value, V(2, 0, 5));
  EXPECT_EQ(path("0 0 5\n1 0\n").substr(0, 60), "path: line 2: expected 3 or 6 numbers, found 2");
  EXPECT_EQ(path("0 0 5\n1 0 5 6\n").substr(0, 60), "path: line 2: expected 3 or 6 numbers, found 4");
  EXPECT_EQ(path("0 0 5\n\n1 x 5\n"), "path: line 3: \"x\" is no number");
  EXPECT_EQ(path("0 0 5"), "path: expected at least two different points");
}

TEST_F(PanelTables, NewCamerasAreThoseOfTheDialog)
{
  CameraDescription from;
  from.name = "c";
  from.eye = V(1, 2, 3);
  from.lookAt = V(4, 5, 6);
  from.up = V(0, 0, 1);
  from.fovY = 90;
  from.aspect = 1.5;
  from.width = 300;
  from.height = 200;
  from.near = 0.5;
  from.far = 70;
  CameraDialog dialog(from, nullptr);
  EXPECT_EQ(dialog.windowTitle(), "Add camera");
  const auto text = [](const CameraDescription& camera)
  {
    SceneDescription scene;
    scene.cameras = { camera };
    return toJson(scene, "");
  };
  EXPECT_EQ(text(dialog.camera()), text(from));
  const auto enabled = [&]
  {
    std::string found;
    for (const char* const name : { "fovY", "aspect", "K", "size" })
    {
      found += dialog.findChild<NumberRow*>(name)->isEnabled() ? '1' : '0';
    }
    return found;
  };
  EXPECT_EQ(enabled(), "1101");
  dialog.findChild<QComboBox*>("lens")->setCurrentIndex(1);
  EXPECT_EQ(enabled(), "0011");
  CameraDescription wanted = from;
  wanted.fovY = CameraDescription().fovY;
  wanted.aspect = 0;
  wanted.K = Eigen::Matrix3d::Identity();
  wanted.K->diagonal() = V(100, 100, 1);
  wanted.K->col(2) = V(150, 100, 1);
  CameraDescription got = dialog.camera();
  ASSERT_TRUE(got.K);
  EXPECT_LT((*got.K - *wanted.K).norm(), 1e-9);
  got.K = wanted.K;
  EXPECT_EQ(text(got), text(wanted));
  const auto type = [&](const char* name, const char* words)
  {
    auto* const line = dialog.findChild<QLineEdit*>(name);
    line->setText(words);
    line->setModified(true);
  };
  type("K.0", "11");
  type("K.1", "12");
  type("K.2", "13");
  type("K.3", "14");
  type("name", "d");
  wanted.name = "d";
  type("range.1", "80");
  wanted.far = 80;
  *wanted.K << 11, 0, 13, 0, 12, 14, 0, 0, 1;
  bool taken = false;
  dialog.onAdd(
    [&](const CameraDescription& camera)
    {
      EXPECT_EQ(text(camera), text(wanted)) << "what is being typed is taken";
      return taken;
    });
  dialog.show();
  dialog.accept();
  EXPECT_TRUE(dialog.isVisible()) << "it was refused";
  // A matrix that was typed stays; without a size the usual one is taken.
  dialog.findChild<QComboBox*>("lens")->setCurrentIndex(0);
  dialog.findChild<QComboBox*>("lens")->setCurrentIndex(1);
  taken = true;
  dialog.accept();
  EXPECT_FALSE(dialog.isVisible());
  // Without a whole size the usual one is taken.
  for (const auto& [width, height, whole] : { std::tuple(0, 200, false), std::tuple(300, 0, false),
         std::tuple(0, 0, false), std::tuple(1, 1, true), std::tuple(300, 200, true) })
  {
    from.width = width;
    from.height = height;
    CameraDialog sized(from, nullptr);
    sized.findChild<QComboBox*>("lens")->setCurrentIndex(1);
    EXPECT_EQ(sized.camera().width, whole ? width : 640);
    EXPECT_EQ(sized.camera().height, whole ? height : 480);
    EXPECT_NEAR((*sized.camera().K)(0, 0), sized.camera().height / 2.0, 1e-9);
    EXPECT_EQ((*sized.camera().K)(0, 2), sized.camera().width / 2.0);
    EXPECT_EQ((*sized.camera().K)(1, 2), sized.camera().height / 2.0);
  }
}

TEST_F(PanelTables, NewLightsAreThoseOfTheDialog)
{
  EXPECT_EQ(lightKindNames(), (QStringList{ "point", "head", "directional", "spot" }));
  EXPECT_EQ(lightKindPlace(LightKind::Directional), 2);
  LightDescription from;
  from.name = "l";
  from.kind = LightKind::Spot;
  from.enabled = false;
  from.position = V(1, 2, 3);
  from.target = V(4, 5, 6);
  from.diffuse = V(0.1, 0.2, 0.3);
  from.specular = V(0.4, 0.5, 0.6);
  from.ambient = V(0.7, 0.8, 0.9);
  from.intensity = 2;
  from.attenuation = V(1, 0.5, 0.25);
  from.coneAngle = 25;
  from.exponent = 4;
  LightDialog dialog(from, nullptr);
  EXPECT_EQ(dialog.windowTitle(), "Add light");
  const auto text = [](const LightDescription& light)
  {
    SceneDescription scene;
    scene.lights = { light };
    return toJson(scene, "");
  };
  EXPECT_EQ(text(dialog.light()), text(from));
  const char* const enabled[] = { "10100", "00000", "11000", "11111" };
  for (int kind = 0; kind < 4; ++kind)
  {
    dialog.findChild<QComboBox*>("kind")->setCurrentIndex(kind);
    std::string found;
    for (const char* const name : { "position", "target", "attenuation", "coneAngle", "exponent" })
    {
      found += dialog.findChild<NumberRow*>(name)->isEnabled() ? '1' : '0';
    }
    EXPECT_EQ(found, enabled[kind]) << kind;
    EXPECT_EQ(dialog.light().kind, lightKinds()[std::size_t(kind)].kind);
  }
  dialog.findChild<QCheckBox*>("enabled")->setChecked(true);
  dialog.findChild<QLineEdit*>("intensity.0")->setText("3");
  dialog.findChild<QLineEdit*>("intensity.0")->setModified(true);
  bool taken = false;
  from.enabled = true;
  from.intensity = 3;
  dialog.onAdd(
    [&](const LightDescription& light)
    {
      EXPECT_EQ(text(light), text(from));
      return taken;
    });
  dialog.show();
  dialog.accept();
  EXPECT_TRUE(dialog.isVisible());
  taken = true;
  dialog.accept();
  EXPECT_FALSE(dialog.isVisible());
}
} // namespace
