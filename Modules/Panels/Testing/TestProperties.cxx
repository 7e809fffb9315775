// SPDX-License-Identifier: BSD-3-Clause
// The panel of properties: every row of the scene, of objects and lights, what it shows and what typing changes.
#include "dgtkPropertiesTest.h"

#include "dgtkLightKind.h"
#include "dgtkScenePlaces.h"

#include <cmath>
#include <filesystem>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace
{
using namespace dgtk;
using V = Eigen::Vector3d;
using Kind = SceneItem::Kind;

class Properties : public test::PropertiesTest
{
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
  wanted.background.value.y() = 0.9;
  EXPECT_EQ(this->State->document().undoText(), "Change Background");
  this->type("fogColor.2", "1");
  wanted.fog.color.value.z() = 1;
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
  EXPECT_EQ(this->scene().fog.density.value, 0.5);
  EXPECT_NE(this->rows().find("fogDensity 0.5\n"), std::string::npos) << "what is shown is what holds";
}

// The value at the frame; what is typed is a key there. Undo takes it away.
TEST_F(Properties, ValuesWithKeyFramesAreThoseOfTheFrame)
{
  this->State->document().edit("keys",
    [](SceneDescription& scene)
    {
      scene.background.keys = { { 0, V(0, 0, 0) }, { 4, V(1, 0.5, 0) } };
      scene.fog.density.keys = { { 0, 0 }, { 4, 1 } };
      scene.objects[0].visible.keys = { { 0, true }, { 3, false } };
      scene.lights[1].intensity.keys = { { 0, 1 }, { 4, 5 } };
      scene.lights[1].enabled.keys = { { 0, false }, { 2, true } };
    });
  const std::string before = toJson(this->scene(), "");
  this->State->setFrame(2);
  EXPECT_NE(this->rows().find("background 0.5 0.25 0\n"), std::string::npos) << this->rows();
  EXPECT_NE(this->rows().find("fogDensity 0.5\n"), std::string::npos);
  this->type("background.2", "1");
  ASSERT_EQ(this->scene().background.keys.size(), 3u);
  EXPECT_EQ(this->scene().background.at(2), V(0.5, 0.25, 1));
  this->State->document().undo();
  this->select(Kind::Object, 0);
  EXPECT_TRUE(this->field<QCheckBox>("visible")->isChecked());
  this->State->setFrame(3);
  EXPECT_FALSE(this->field<QCheckBox>("visible")->isChecked());
  this->State->setFrame(5);
  this->field<QCheckBox>("visible")->setChecked(true);
  EXPECT_FALSE(this->scene().objects[0].visible.at(4));
  EXPECT_TRUE(this->scene().objects[0].visible.at(5));
  EXPECT_EQ(this->State->document().undoText(), "Change Visible");
  this->State->document().undo();
  this->select(Kind::Light, 1);
  this->State->setFrame(1);
  EXPECT_NE(this->rows().find("intensity 2\n"), std::string::npos);
  EXPECT_NE(this->rows().find("enabled off\n"), std::string::npos);
  this->State->setFrame(2);
  EXPECT_NE(this->rows().find("enabled on\n"), std::string::npos);
  EXPECT_EQ(toJson(this->scene(), ""), before);
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
  EXPECT_EQ(this->rows().substr(0, 51), "2 selected: the first's values\nName | name sun\nKind");
}

/// Of the same kind; numbers that were not typed, names, and what only one model has stay each one's own.
TEST_F(Properties, ChangesAreForAllThatAreSelected)
{
  SceneDescription wanted = this->scene();
  const auto expectWanted = [&](const char* what)
  {
    EXPECT_EQ(toJson(this->scene(), ""), toJson(wanted, "")) << what;
    this->State->document().undo();
    EXPECT_NE(toJson(this->scene(), ""), toJson(wanted, "")) << what;
    this->State->document().redo();
  };
  this->State->select({ { Kind::Object, 0 }, { Kind::Light, 0 }, { Kind::Object, 1 } });
  this->field<QCheckBox>("visible")->setChecked(false);
  wanted.objects[0].visible = false;
  expectWanted("one is hidden already");
  this->field<QCheckBox>("visible")->setChecked(true);
  wanted.objects[0].visible = true;
  wanted.objects[1].visible = true;
  expectWanted("shown");
  this->type("class", "case");
  wanted.objects[0].className = wanted.objects[1].className = "case";
  expectWanted("class");
  this->State->setFrame(4);
  this->type("position.1", "5");
  wanted.objects[0].position = V(1, 5, 3);
  wanted.objects[1].position.keys[1].value.y() = 5;
  expectWanted("one number");
  this->type("name", "crate");
  wanted.objects[0].name = wanted.objects[1].parent = "crate";
  expectWanted("the name is the first's");
  this->State->select({ { Kind::Light, 0 }, { Kind::Light, 1 } });
  this->type("intensity.0", "3");
  wanted.lights[0].intensity = 3;
  expectWanted("lights of other kinds have other rows");
  this->State->select({ { Kind::Camera, 1 }, { Kind::Camera, 0 }, { Kind::Camera, 2 } });
  this->type("focal.0", "95");
  (*wanted.cameras[1].K)(0, 0) = 95;
  expectWanted("only one has a matrix");
  EXPECT_TRUE(this->Failure.empty()) << this->Failure;
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
  spot.diffuse.value.x() = 0.5;
  this->type("specular.1", "0.5");
  spot.specular.value.y() = 0.5;
  this->type("ambient.2", "0.5");
  spot.ambient.value.z() = 0.5;
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
  this->select(Kind::Object, 0);
  EXPECT_EQ(this->rows().find("Sequence"), std::string::npos);
  EXPECT_NE(this->rows().find("Model | crate.ac"), std::string::npos);
  this->State->document().edit("Model", [](SceneDescription& scene) { scene.objects[0].model = "crate2.md2"; });
  EXPECT_NE(this->rows().find("Model | crate2.md2"), std::string::npos) << "it has another one";
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

TEST_F(Properties, SequencesComeWithTheirModel)
{
  std::ofstream(this->Folder.path("t.json")) << R"({ "objects": [ { "name": "c", "model": "lost.md2" } ] })";
  this->State->document().open(this->Folder.path("t.json"));
  this->select(Kind::Object, 0);
  EXPECT_EQ(this->rows().find("Sequence"), std::string::npos);
  std::filesystem::copy_file(test::sourceFile("Data/Models/creature.md2"), this->Folder.path("lost.md2"));
  ModelLibrary models;
  models.load(this->scene());
  this->State->document().adopt(models);
  this->State->document().edit("Other", [](SceneDescription& scene) { scene.fps = 50; });
  EXPECT_NE(this->rows().find("Sequence | sequence stand of 3"), std::string::npos);
}

TEST_F(Properties, AParentIsNamedAsItIs)
{
  this->State->document().edit("Rename", [](SceneDescription& scene) { renameItem(scene, { Kind::Object, 0 }, "z"); });
  this->select(Kind::Object, 1);
  EXPECT_NE(this->rows().find("Parent | z\n"), std::string::npos);
  this->State->document().undo();
  EXPECT_NE(this->rows().find("Parent | a\n"), std::string::npos);
}

TEST_F(Properties, SmoothCurvesStayWithinTheirKeysWhereThereIsARange)
{
  const auto smooth = [](auto& track, const auto& from, const auto& to)
  {
    track.keys = { { 0, from }, { 4, to }, { 8, to } };
    track.interpolation = Interpolation::Smooth;
  };
  this->State->document().edit("keys",
    [&smooth](SceneDescription& scene)
    {
      for (auto* const color : { &scene.background, &scene.fog.color, &scene.lights[2].diffuse,
             &scene.lights[2].specular, &scene.lights[2].ambient })
      {
        smooth(*color, V(0, 0, 1), V(1, 0.2, 0.5));
      }
      smooth(scene.fog.density, 1.0, 0.0);
      smooth(scene.lights[2].intensity, 2.0, 0.0);
      smooth(scene.lights[2].position, V(0, 0, 2), V(1, 0, 1));
    });
  this->State->setFrame(6);
  const std::string rows = this->rows();
  EXPECT_NE(rows.find("background 1 0.2 0.5\n"), std::string::npos) << rows;
  EXPECT_NE(rows.find("fogColor 1 0.2 0.5\n"), std::string::npos) << rows;
  EXPECT_NE(rows.find("fogDensity 0\n"), std::string::npos) << rows;
  this->type("background.1", "0.25");
  EXPECT_EQ(this->Failure, "");
  EXPECT_EQ(this->scene().background.keys.at(2), (Key<V>{ 6, V(1, 0.25, 0.5) }));
  this->select(Kind::Light, 2);
  const std::string ofLight = this->rows();
  for (const char* color : { "diffuse", "specular", "ambient" })
  {
    EXPECT_NE(ofLight.find(color + std::string(" 1 0.2 0.5\n")), std::string::npos) << ofLight;
  }
  EXPECT_NE(ofLight.find("intensity 0\n"), std::string::npos) << ofLight;
  EXPECT_NE(ofLight.find("position 1.0625 0 0.9375\n"), std::string::npos) << ofLight;
}

TEST_F(Properties, UndoIsTheWindowsWhereNoTextIsTyped)
{
  this->select(Kind::Object, 0);
  auto* const line = this->field<QLineEdit>("class");
  for (const bool typed : { false, true })
  {
    line->setModified(typed);
    EXPECT_EQ(test::takesUndo(*line), typed);
  }
}
} // namespace
