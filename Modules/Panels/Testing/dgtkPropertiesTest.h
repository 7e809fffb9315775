// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPropertiesTest_h
#define dgtkPropertiesTest_h

#include "dgtkEditorState.h"
#include "dgtkNumberRow.h"
#include "dgtkPropertiesPanel.h"

#include "dgtkTestSupport.h"
#include "dgtkTestWidgets.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

namespace dgtk::test
{

/// A scene with something of each kind.
constexpr const char* sceneOfAll = R"({ "units": "m", "upAxis": "z", "background": [0.1, 0.2, 0.3],
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

/// The panel of properties of that scene, on no display.
class PropertiesTest : public testing::Test
{
protected:
  void SetUp() override
  {
    needApplication();
    std::filesystem::copy_file(sourceFile("Data/Models/crate.ac"), this->Folder.path("crate.ac"));
    std::ofstream(this->Folder.path("s.json")) << sceneOfAll;
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
  void select(SceneItem::Kind kind, std::size_t index) { this->State->select({ { kind, index } }); }
  const SceneDescription& scene() const { return this->State->scene(); }

  TemporaryFolder Folder;
  std::unique_ptr<EditorState> State;
  std::unique_ptr<PropertiesPanel> Panel;
  std::string Failure;
};

} // namespace dgtk::test

#endif
