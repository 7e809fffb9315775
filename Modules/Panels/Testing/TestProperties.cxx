// SPDX-License-Identifier: BSD-3-Clause
// The panel of properties, on no display: every row of every kind of item, what it shows and what typing changes.
#include "dgtkCameraEntry.h"
#include "dgtkEditorState.h"
#include "dgtkLightKind.h"
#include "dgtkNumberRow.h"
#include "dgtkPortableMath.h"
#include "dgtkPropertiesPanel.h"
#include "dgtkScenePlaces.h"

#include "dgtkTestSupport.h"
#include "dgtkTestWidgets.h"

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace
{
using namespace dgtk;
using V = Eigen::Vector3d;
using Kind = SceneItem::Kind;

const char* const whole = R"({ "units": "m", "upAxis": "z", "background": [0.1, 0.2, 0.3],
  "fog": { "color": [0.4, 0.5, 0.6], "density": 0.25, "start": 3 },
  "objects": [ { "name": "a", "model": "crate.ac", "class": "box", "position": [1, 2, 3], "scale": [2, 3, 4],
      "orientation": [0.5, 0.5, 0.5, 0.5] },
    { "name": "b", "model": "crate.ac", "parent": "a", "visible": false,
      "position": { "keys": [ [0, [0, 0, 0]], [4, [4, 8, 12]] ] } } ],
  "lights": [
    { "name": "sun", "kind": "directional", "position": [0, 1, 9], "diffuse": [0.1, 0.2, 0.3], "intensity": 2 },
    { "name": "lamp", "kind": "point", "position": [1, 1, 1], "attenuation": [1, 0.5, 0.25], "shadows": true },
    { "name": "spot", "kind": "spot", "position": [2, 2, 2], "target": [0, 0, 1], "coneAngle": 20, "exponent": 3,
      "specular": [0.7, 0.8, 0.9], "ambient": [0.01, 0.02, 0.03], "enabled": false } ],
  "cameras": [
    { "name": "eye", "eye": [0, -5, 1], "lookAt": [0, 0, 1], "up": [0, 0, 1], "fovY": 40, "aspect": 1.5,
      "near": 0.5, "far": 50, "width": 640, "height": 480 },
    { "name": "posed", "position": [1, 2, 3], "orientation": [1, 0, 0, 0], "width": 100, "height": 80,
      "K": [[90, 1, 50], [0, 80, 40], [0, 0, 1]] },
    { "name": "flat", "model": "orthographic", "eye": [0, -5, 1], "lookAt": [0, 0, 1], "viewHeight": 7 } ] })";

class Plain final : public CameraModel
{
public:
  explicit Plain(const CameraParameters& of)
    : CameraModel(of)
  {
  }
  std::string name() const override { return "panels"; }
  CameraRay rayThrough(const Eigen::Vector2d&) const override { return { { 0, 0, 0 }, { 0, 0, 1 } }; }
  bool project(const Eigen::Vector3d&, Eigen::Vector2d&) const override { return false; }
};

/// A model of cameras that has parameters of its own.
CameraEntry entry()
{
  CameraParameter xi{ "panelXi", "px", "a number that moves", { 0, 5, false, false, "a number from 0 to 5" }, { 1 } };
  xi.moves = true;
  CameraParameter list{ "panelList", "", "a list", { -1, 1, false, false, "a number from -1 to 1" }, { 0.5, 0.25 } };
  list.counts = { 2 };
  CameraParameter file{ "panelFile", "", "a file" };
  file.kind = CameraParameter::Kind::File;
  return { { xi, list, file },
    [](const CameraParameters& of) -> std::shared_ptr<const CameraModel> { return std::make_shared<Plain>(of); } };
}
const CameraEntry ofPanels = entry();
const bool added = addCamera({ "panels", "for a test", &ofPanels });

class Properties : public testing::Test
{
protected:
  void SetUp() override
  {
    test::needApplication();
    std::filesystem::copy_file(test::sourceFile("Data/Models/crate.ac"), this->Folder.path("crate.ac"));
    std::ofstream(this->Folder.path("s.json")) << whole;
    this->State = std::make_unique<EditorState>(nullptr);
    this->Panel = std::make_unique<PropertiesPanel>(*this->State, nullptr);
    this->State->document().open(this->Folder.path("s.json"));
    QObject::connect(this->State.get(), &EditorState::failed,
      [this](const QString& message) { this->Failure = message.toStdString(); });
  }

  /// Each row: its label, the field's name and what it shows.
  std::string rows() const
  {
    const auto* const form = qobject_cast<QFormLayout*>(this->Panel->widget()->layout());
    std::string text;
    for (int i = 0; form != nullptr && i < form->rowCount(); ++i)
    {
      QLayoutItem* const label = form->itemAt(i, QFormLayout::LabelRole);
      QLayoutItem* const spanning = form->itemAt(i, QFormLayout::SpanningRole);
      QWidget* const field = spanning ? spanning->widget() : form->itemAt(i, QFormLayout::FieldRole)->widget();
      text += label ? qobject_cast<QLabel*>(label->widget())->text().toStdString() + " | " : std::string();
      text += field->objectName().toStdString();
      if (const auto* const numbers = qobject_cast<NumberRow*>(field))
      {
        for (const double value : numbers->values())
        {
          text += " " + numberText(value).toStdString();
        }
      }
      else if (const auto* const line = qobject_cast<QLineEdit*>(field))
      {
        text += " " + line->text().toStdString();
      }
      else if (const auto* const box = qobject_cast<QCheckBox*>(field))
      {
        text += box->isChecked() ? " on" : " off";
      }
      else if (const auto* const choice = qobject_cast<QComboBox*>(field))
      {
        text += " " + choice->currentText().toStdString() + " of " + std::to_string(choice->count());
      }
      else if (const auto* const words = qobject_cast<QLabel*>(field))
      {
        text += words->text().left(30).toStdString();
      }
      text += "\n";
    }
    return text;
  }
  template <typename Field>
  Field* field(const char* name) const
  {
    return this->Panel->widget()->findChild<Field*>(name);
  }
  void type(const char* name, const char* text) const
  {
    auto* const line = this->field<QLineEdit>(name);
    ASSERT_TRUE(line) << name;
    line->setText(text);
    line->setModified(true);
    emit line->editingFinished();
  }
  void choose(const char* name, int place) const
  {
    auto* const box = this->field<QComboBox>(name);
    ASSERT_TRUE(box) << name;
    box->setCurrentIndex(place);
    emit box->activated(place);
  }
  void select(Kind kind, std::size_t index) { this->State->select({ { kind, index } }); }
  const SceneDescription& scene() const { return this->State->scene(); }

  test::TemporaryFolder Folder;
  std::unique_ptr<EditorState> State;
  std::unique_ptr<PropertiesPanel> Panel;
  std::string Failure;
};

TEST_F(Properties, RowsOfTheScene)
{
  EXPECT_EQ(this->rows(), R"(Nothing is selected: these are
Units | units m
Up axis | upAxis z of 2
Background | background 0.1 0.2 0.3
Fog | fogColor 0.4 0.5 0.6
Fog's density | fogDensity 0.25
Fog begins at, m | fogStart 3
)");
  SceneDescription wanted = this->scene();
  this->type("background.1", "0.9");
  wanted.background.y() = 0.9;
  EXPECT_EQ(this->State->document().undoText(), "Change Background");
  this->type("fogColor.2", "1");
  wanted.fog.color.z() = 1;
  this->type("fogDensity.0", "0.5");
  wanted.fog.density = 0.5;
  this->type("fogStart.0", "6");
  wanted.fog.start = 6;
  EXPECT_EQ(this->State->document().undoText(), "Change Fog begins at, m");
  this->choose("upAxis", 0);
  wanted.upAxis = UpAxis::Y;
  this->type("units", "mm");
  wanted.units = "mm";
  EXPECT_EQ(toJson(this->scene(), ""), toJson(wanted, ""));
  EXPECT_NE(this->rows().find("Fog begins at, mm | fogStart 6\n"), std::string::npos) << "the labels follow the units";
  this->type("units", "");
  EXPECT_NE(this->rows().find("Fog begins at | fogStart 6\n"), std::string::npos);
  this->type("fogDensity.0", "-1");
  EXPECT_FALSE(this->Failure.empty());
  EXPECT_EQ(this->scene().fog.density, 0.5);
  EXPECT_NE(this->rows().find("fogDensity 0.5\n"), std::string::npos) << "what is shown is what holds";
}

TEST_F(Properties, RowsOfObjects)
{
  this->select(Kind::Object, 0);
  EXPECT_EQ(this->rows(), R"(Name | name a
Class | class box
Model | crate.ac
Position, m | position 1 2 3
Rotation, ° | rotation 90 0 90
Quaternion | orientation 0.5 0.5 0.5 0.5
Scale | scale 2 3 4
Visible | visible on
)");
  SceneDescription wanted = this->scene();
  this->type("name", "crate");
  wanted.objects[0].name = "crate";
  wanted.objects[1].parent = "crate";
  this->type("class", "case");
  wanted.objects[0].className = "case";
  EXPECT_EQ(this->State->document().undoText(), "Change Class");
  this->type("position.0", "-7");
  wanted.objects[0].position = V(-7, 2, 3);
  this->type("scale.2", "5");
  wanted.objects[0].scale = V(2, 3, 5);
  this->field<QCheckBox>("visible")->setChecked(false);
  wanted.objects[0].visible = false;
  EXPECT_EQ(this->State->document().undoText(), "Change Visible");
  EXPECT_EQ(toJson(this->scene(), ""), toJson(wanted, ""));
  // Four numbers of any length are a rotation; angles too.
  auto* const numbers = this->field<NumberRow>("orientation");
  for (const auto& [name, text] : { std::pair("orientation.0", "1"), std::pair("orientation.1", "4"),
         std::pair("orientation.2", "2"), std::pair("orientation.3", "2") })
  {
    this->field<QLineEdit>(name)->setText(text);
    this->field<QLineEdit>(name)->setModified(true);
  }
  numbers->commit();
  const Quaternion q = this->scene().objects[0].orientation.at(0);
  EXPECT_DOUBLE_EQ(q.w, 0.2);
  EXPECT_DOUBLE_EQ(q.x, 0.8);
  EXPECT_DOUBLE_EQ(q.y, 0.4);
  EXPECT_DOUBLE_EQ(q.z, 0.4);
  this->type("rotation.0", "0");
  this->type("rotation.1", "0");
  this->type("rotation.2", "90");
  const Quaternion turned = this->scene().objects[0].orientation.at(0);
  EXPECT_NEAR(std::abs(turned.w), std::sqrt(0.5), 1e-9);
  EXPECT_NEAR(turned.w * turned.z, 0.5, 1e-9);
  // Of an item with keys, the values at the frame, and typing sets a key there.
  this->select(Kind::Object, 1);
  this->State->setFrame(2);
  EXPECT_EQ(this->rows(), R"(Name | name b
Class | class 
Model | crate.ac
Parent | crate
Position, m | position 2 4 6
Rotation, ° | rotation 0 0 0
Quaternion | orientation 1 0 0 0
Scale | scale 1 1 1
Visible | visible off
)");
  this->type("position.1", "5");
  ASSERT_EQ(this->scene().objects[1].position.keys.size(), 3u);
  EXPECT_EQ(this->scene().objects[1].position.at(2), V(2, 5, 6));
  EXPECT_EQ(this->scene().objects[1].position.at(4), V(4, 8, 12));
  this->type("name", "crate");
  EXPECT_FALSE(this->Failure.empty()) << "it is taken";
  EXPECT_EQ(this->field<QLineEdit>("name")->text(), "b");
  this->State->select({ { Kind::Light, 0 }, { Kind::Object, 1 } });
  EXPECT_EQ(this->rows().substr(0, 45), "The first of 2 selected:\nName | name sun\nKind");
}

TEST_F(Properties, RowsOfLights)
{
  this->select(Kind::Light, 0);
  const std::string colors = R"(Diffuse | diffuse 0.1 0.2 0.3
Specular | specular 1 1 1
Ambient | ambient 0 0 0
Intensity | intensity 2
)";
  const std::string sun = this->rows();
  EXPECT_NE(sun.find(colors), std::string::npos) << sun;
  EXPECT_EQ(sun.find("attenuation"), std::string::npos);
  EXPECT_EQ(sun.find("cone"), std::string::npos);
  this->select(Kind::Light, 1);
  EXPECT_EQ(this->rows(), R"(Name | name lamp
Kind | kind point of 4
Position, m | position 1 1 1
Diffuse | diffuse 1 1 1
Specular | specular 1 1 1
Ambient | ambient 0 0 0
Intensity | intensity 1
Attenuation (constant, linear, quadratic) | attenuation 1 0.5 0.25
Enabled | enabled on
Shadows | shadows on
)");
  this->select(Kind::Light, 2);
  EXPECT_EQ(this->rows(), R"(Name | name spot
Kind | kind spot of 4
Position, m | position 2 2 2
Target, m | target 0 0 1
Diffuse | diffuse 1 1 1
Specular | specular 0.7 0.8 0.9
Ambient | ambient 0.01 0.02 0.03
Intensity | intensity 1
Attenuation (constant, linear, quadratic) | attenuation 1 0 0
Cone, ° | coneAngle 20
Exponent | exponent 3
Enabled | enabled off
Shadows | shadows off
)");
  SceneDescription wanted = this->scene();
  LightDescription& spot = wanted.lights[2];
  this->type("position.2", "8");
  spot.position = V(2, 2, 8);
  this->type("target.0", "-1");
  spot.target = V(-1, 0, 1);
  this->type("diffuse.0", "0.5");
  spot.diffuse.x() = 0.5;
  this->type("specular.1", "0.5");
  spot.specular.y() = 0.5;
  this->type("ambient.2", "0.5");
  spot.ambient.z() = 0.5;
  this->type("intensity.0", "4");
  spot.intensity = 4;
  this->type("attenuation.1", "2");
  spot.attenuation.y() = 2;
  this->type("coneAngle.0", "30");
  spot.coneAngle = 30;
  this->type("exponent.0", "7");
  spot.exponent = 7;
  this->field<QCheckBox>("enabled")->setChecked(true);
  spot.enabled = true;
  this->field<QCheckBox>("shadows")->setChecked(true);
  spot.shadows = true;
  EXPECT_EQ(toJson(this->scene(), ""), toJson(wanted, ""));
  // Another kind has other rows.
  for (int place = 0; place < 4; ++place)
  {
    this->choose("kind", place);
    const LightTraits& traits = lightKinds()[std::size_t(place)];
    EXPECT_EQ(this->scene().lights[2].kind, traits.kind);
    const std::string rows = this->rows();
    EXPECT_EQ(rows.find("| position") != std::string::npos, traits.placed) << place;
    EXPECT_EQ(rows.find("| target") != std::string::npos, traits.aimed) << place;
    EXPECT_EQ(rows.find("| attenuation") != std::string::npos, traits.near) << place;
    EXPECT_EQ(rows.find("| coneAngle") != std::string::npos, traits.cone) << place;
  }
}

TEST_F(Properties, RowsOfCameras)
{
  this->select(Kind::Camera, 0);
  EXPECT_EQ(this->rows(), R"(Name | name eye
Eye, m | eye 0 -5 1
Look at, m | lookAt 0 0 1
Up | up 0 0 1
Lens | lens by its field of view of 2
Field of view, ° | fovY 40
Aspect (0: square) | aspect 1.5
Near, m | near 0.5
Far, m | far 50
Size, pixels | size 640 480
)");
  SceneDescription wanted = this->scene();
  CameraDescription& eye = wanted.cameras[0];
  this->type("eye.0", "2");
  eye.eye = V(2, -5, 1);
  this->type("lookAt.1", "3");
  eye.lookAt = V(0, 3, 1);
  this->type("up.0", "0.5");
  eye.up = V(0.5, 0, 1);
  this->type("fovY.0", "50");
  eye.fovY = 50;
  this->type("aspect.0", "2");
  eye.aspect = 2;
  this->type("near.0", "0.25");
  eye.near = 0.25;
  this->type("far.0", "60");
  eye.far = 60;
  this->type("size.0", "320");
  this->type("size.1", "200");
  eye.width = 320;
  eye.height = 200;
  EXPECT_EQ(toJson(this->scene(), ""), toJson(wanted, ""));
  this->select(Kind::Camera, 2);
  EXPECT_EQ(this->rows(), R"(Name | name flat
Eye, m | eye 0 -5 1
Look at, m | lookAt 0 0 1
Up | up 0 0 1
View height, m | viewHeight 7
Near, m | near 0.1
Far, m | far 1000
Size, pixels | size 0 0
)");
  this->type("viewHeight.0", "9");
  EXPECT_EQ(this->scene().cameras[2].viewHeight.at(0), 9);
}

TEST_F(Properties, SizesAreGivenWhole)
{
  this->select(Kind::Camera, 2);
  const auto size = [&] { return std::pair(this->scene().cameras[2].width, this->scene().cameras[2].height); };
  this->type("size.0", "400");
  EXPECT_EQ(size(), std::pair(400, 300));
  this->type("size.0", "0");
  EXPECT_EQ(size(), std::pair(0, 0));
  this->type("size.1", "300");
  EXPECT_EQ(size(), std::pair(400, 300));
  this->type("size.1", "0");
  EXPECT_EQ(size(), std::pair(0, 0));
  this->type("size.0", "1");
  EXPECT_EQ(size(), std::pair(1, 1));
  this->type("size.1", "7");
  EXPECT_EQ(size(), std::pair(1, 7));
}

TEST_F(Properties, LensesByAngleAndByMatrix)
{
  this->select(Kind::Camera, 1);
  EXPECT_EQ(this->rows(), R"(Name | name posed
Position, m | position 1 2 3
Rotation, ° | rotation 0 0 0
Quaternion | orientation 1 0 0 0
Lens | lens by its matrix K of 2
fx, fy, pixels | focal 90 80
cx, cy, pixels | principal 50 40
Skew, pixels | skew 1
Near, m | near 0.1
Far, m | far 1000
Size, pixels | size 100 80
)");
  this->type("focal.0", "100");
  this->type("focal.1", "50");
  this->type("principal.0", "51");
  this->type("principal.1", "42");
  this->type("skew.0", "2");
  Eigen::Matrix3d K;
  K << 100, 2, 51, 0, 50, 42, 0, 0, 1;
  EXPECT_EQ(*this->scene().cameras[1].K, K);
  this->type("position.1", "-2");
  EXPECT_EQ(this->scene().cameras[1].position.at(0), V(1, -2, 3));
  this->choose("lens", 0);
  ASSERT_FALSE(this->scene().cameras[1].K);
  EXPECT_NEAR(this->scene().cameras[1].fovY.at(0), 2 * std::atan(40. / 50) * 180 / pi, 1e-9);
  EXPECT_DOUBLE_EQ(this->scene().cameras[1].aspect, 0.5 * 100 / 80);
  this->choose("lens", 1);
  ASSERT_TRUE(this->scene().cameras[1].K);
  K << 100, 0, 50, 0, 50, 40, 0, 0, 1;
  EXPECT_LT((*this->scene().cameras[1].K - K).norm(), 1e-9) << *this->scene().cameras[1].K;
  EXPECT_EQ(this->scene().cameras[1].aspect, 0);
  EXPECT_EQ(this->scene().cameras[1].fovY.at(0), CameraDescription().fovY.at(0));
  this->type("focal.0", "50");
  this->choose("lens", 0);
  EXPECT_EQ(this->scene().cameras[1].aspect, 0) << "square pixels";
  // Without a size of its own the camera gets the usual one; an angle with keys stays.
  this->State->document().edit("Size",
    [](SceneDescription& scene)
    {
      scene.cameras[1].width = 0;
      scene.cameras[1].height = 0;
    });
  this->choose("lens", 1);
  EXPECT_EQ(this->scene().cameras[1].width, usualImageSize[0]);
  EXPECT_EQ(this->scene().cameras[1].height, usualImageSize[1]);
  this->choose("lens", 0);
  this->State->document().edit("Keys",
    [](SceneDescription& scene) {
      scene.cameras[1].fovY.keys = { { 0, 30 }, { 4, 40 } };
    });
  this->choose("lens", 1);
  EXPECT_EQ(this->Failure, "The field of view has key frames, which a matrix cannot have: remove them first.");
  EXPECT_FALSE(this->scene().cameras[1].K);
}

TEST_F(Properties, AnglesAreThoseOfTheRotation)
{
  for (const auto& [angles, x, y] : std::vector<std::tuple<V, V, V>>{ { V(90, 0, 0), V(1, 0, 0), V(0, 0, 1) },
         { V(0, 90, 0), V(0, 0, -1), V(0, 1, 0) }, { V(0, 0, 90), V(0, 1, 0), V(-1, 0, 0) },
         { V(90, 0, 90), V(0, 1, 0), V(0, 0, 1) }, { V(0, 90, 90), V(0, 0, -1), V(-1, 0, 0) } })
  {
    const Eigen::Matrix3d m = rotationOf(angles).matrix();
    EXPECT_LT((m.col(0) - x).norm(), 1e-12) << angles.transpose();
    EXPECT_LT((m.col(1) - y).norm(), 1e-12) << angles.transpose();
  }
  for (const V& angles : std::vector<V>{ V(10, 20, 30), V(-170, -80, 175), V(0, 90, 25), V(0, -90, -25), V(0, 89, 0) })
  {
    EXPECT_LT((degreesOf(rotationOf(angles)) - angles).norm(), 1e-6) << angles.transpose();
  }
  EXPECT_EQ(degreesOf(rotationOf(V(10, 20, 30))), V(10, 20, 30)) << "no noise";
}

TEST_F(Properties, WhatIsBeingTypedIsTakenBeforeOtherThings)
{
  this->select(Kind::Object, 0);
  auto* line = this->field<QLineEdit>("position.0");
  line->setText("4");
  line->setModified(true);
  this->State->finishTyping();
  EXPECT_EQ(this->scene().objects[0].position.at(0), V(4, 2, 3));
  line = this->field<QLineEdit>("class");
  line->setText("typed");
  line->setModified(true);
  this->State->document().edit("Other", [](SceneDescription& scene) { scene.objects[0].className = "other"; });
  EXPECT_EQ(line->text(), "typed") << "while something is typed there, it stays";
  this->State->finishTyping();
  EXPECT_EQ(this->scene().objects[0].className, "typed");
  EXPECT_FALSE(line->acceptDrops());
}

TEST_F(Properties, SequencesOfModels)
{
  std::filesystem::copy_file(test::sourceFile("Data/Models/creature.md2"), this->Folder.path("crate2.md2"));
  this->State->document().edit("Model", [](SceneDescription& scene) { scene.objects[0].model = "crate2.md2"; });
  this->select(Kind::Object, 0);
  const std::string rows = this->rows();
  EXPECT_EQ(rows.substr(rows.find("Sequence")), R"(Sequence | sequence stand of 3
Begins at frame | sequenceStart 0
Speed | sequenceRate 1
Repeat | sequenceLoop on
)");
  SceneDescription wanted = this->scene();
  AnimationDescription& animation = wanted.objects[0].animation;
  this->choose("sequence", 2);
  animation.sequence = this->field<QComboBox>("sequence")->itemText(2).toStdString();
  EXPECT_EQ(this->State->document().undoText(), "Change Sequence");
  this->type("sequenceStart.0", "3");
  animation.start = 3;
  this->type("sequenceRate.0", "2");
  animation.rate = 2;
  this->field<QCheckBox>("sequenceLoop")->setChecked(false);
  animation.loop = false;
  EXPECT_EQ(toJson(this->scene(), ""), toJson(wanted, ""));
  EXPECT_EQ(this->field<QComboBox>("sequence")->currentIndex(), 2);
}

TEST_F(Properties, ParametersOfACamerasModel)
{
  ASSERT_TRUE(added);
  this->State->document().edit("Camera",
    [](SceneDescription& scene)
    {
      CameraDescription camera = scene.cameras[2];
      camera.name = "own";
      camera.model = "panels";
      camera.viewHeight = CameraDescription().viewHeight;
      camera.parameters["panelXi"].numbers = { 2.0 };
      camera.parameters["panelXi"].numbers[0].keys = { { 0, 1.0 }, { 4, 3.0 } };
      camera.parameters["panelFile"].file = "a.npy";
      scene.cameras.push_back(camera);
    });
  this->select(Kind::Camera, 3);
  this->State->setFrame(2);
  EXPECT_EQ(this->rows(), R"(Name | name own
Eye, m | eye 0 -5 1
Look at, m | lookAt 0 0 1
Up | up 0 0 1
panelXi, px | panelXi 2
panelList | panelList 0.5 0.25
panelFile | a.npy
Near, m | near 0.1
Far, m | far 1000
Size, pixels | size 0 0
)");
  this->type("panelXi.0", "4");
  this->type("panelList.1", "-1");
  EXPECT_EQ(this->Failure, "");
  const auto& own = this->scene().cameras[3].parameters;
  ASSERT_EQ(own.at("panelXi").numbers.at(0).keys.size(), 3u);
  EXPECT_EQ(own.at("panelXi").numbers[0].at(2), 4);
  EXPECT_EQ(own.at("panelXi").numbers[0].at(4), 3);
  ASSERT_EQ(own.at("panelList").numbers.size(), 2u);
  EXPECT_EQ(own.at("panelList").numbers[0].at(2), 0.5);
  EXPECT_EQ(own.at("panelList").numbers[1].at(2), -1);
}
} // namespace
