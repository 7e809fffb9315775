// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPropertiesPanel.h"

#include "dgtkNumberRow.h"

#include <QCheckBox>
#include <QComboBox>
#include <QFormLayout>
#include <QLineEdit>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr double roundingOfLength = 1e-12; // of four numbers that were rounded to double precision

std::vector<double> listOf(const Eigen::Vector3d& v) { return { v.x(), v.y(), v.z() }; }
Eigen::Vector3d vectorOf(const std::vector<double>& v) { return { v[0], v[1], v[2] }; }

/// The rotation of four numbers of any length. Those whose length is 1 stay as they are; of length 0 they are refused.
Quaternion unitOf(const std::vector<double>& v)
{
  const Quaternion q{ v[0], v[1], v[2], v[3] };
  const double length = q.norm();
  return length == 0 || std::abs(length - 1) < roundingOfLength
           ? q
           : Quaternion{ q.w / length, q.x / length, q.y / length, q.z / length };
}

/// For an accessor that also serves for writing and is only read here.
SceneDescription& readable(const SceneDescription& scene) { return const_cast<SceneDescription&>(scene); }
} // namespace

void PropertiesPanel::addText(const QString& label, const QString& name,
  const std::function<std::string(const SceneDescription&)>& get,
  const std::function<void(SceneDescription&, const std::string&)>& set)
{
  auto* field = new QLineEdit(this->Form->parentWidget());
  field->setObjectName(name);
  this->Form->addRow(label, field);
  this->Refreshers.push_back(
    [field, get](SceneDescription& scene)
    {
      if (!field->isModified())
      {
        field->setText(toText(get(scene)));
        field->setCursorPosition(0);
      }
    });
  connect(field, &QLineEdit::editingFinished, this,
    [this, field, label, get, set]
    {
      const std::string text = field->text().toStdString();
      const std::string old = get(this->State.scene());
      // What a refusal leaves; its dialog takes the focus, which ends the typing once more.
      field->setText(toText(old));
      if (text == old)
      {
        return;
      }
      // A name stands in other items too.
      const std::string step = tr("Change %1").arg(label).toStdString();
      this->State.attempt(
        [&] { this->State.document().edit(step, [&](SceneDescription& scene) { set(scene, text); }); });
      this->refresh();
    });
}

NumberRow* PropertiesPanel::addNumbers(
  const QString& label, const QString& name, int count, const GetNumbers& get, const SetNumbers& set)
{
  auto* row = new NumberRow(name, count, this->Form->parentWidget());
  this->Form->addRow(label, row);
  this->Refreshers.push_back([row, get](SceneDescription& scene) { row->setValues(get(scene)); });
  row->onEdit([this, label, set](const Numbers& values)
    { this->edit(label, [&](SceneDescription& scene) { set(scene, values); }); });
  return row;
}

void PropertiesPanel::addNumber(
  const QString& label, const QString& name, const std::function<double&(SceneDescription&)>& value)
{
  this->addNumbers(
    label, name, 1, [value](const SceneDescription& scene) { return Numbers{ value(readable(scene)) }; },
    [value](SceneDescription& scene, const Numbers& numbers) { value(scene) = numbers[0]; });
}

void PropertiesPanel::addColor(
  const QString& label, const QString& name, const std::function<Eigen::Vector3d&(SceneDescription&)>& value)
{
  this->addNumbers(
    label, name, 3, [value](const SceneDescription& scene) { return listOf(value(readable(scene))); },
    [value](SceneDescription& scene, const Numbers& numbers) { value(scene) = vectorOf(numbers); });
}

void PropertiesPanel::addTrack(
  const QString& label, const QString& name, const std::function<Track<Eigen::Vector3d>&(SceneDescription&)>& track)
{
  this->addNumbers(
    label, name, 3,
    [this, track](const SceneDescription& scene) { return listOf(track(readable(scene)).at(this->State.frame())); },
    [this, track](SceneDescription& scene, const Numbers& numbers)
    { setTrackAt(track(scene), this->State.frame(), vectorOf(numbers)); });
}

void PropertiesPanel::addTrack(
  const QString& label, const QString& name, const std::function<Track<double>&(SceneDescription&)>& track)
{
  this->addNumbers(
    label, name, 1,
    [this, track](const SceneDescription& scene) { return Numbers{ track(readable(scene)).at(this->State.frame()) }; },
    [this, track](SceneDescription& scene, const Numbers& numbers)
    { setTrackAt(track(scene), this->State.frame(), numbers[0]); });
}

void PropertiesPanel::addOrientation(const std::function<Track<Quaternion>&(SceneDescription&)>& track)
{
  const auto now = [this, track](const SceneDescription& scene)
  { return track(readable(scene)).at(this->State.frame()); };
  this->addNumbers(
    tr("Rotation, \u00b0"), "rotation", 3,
    [now](const SceneDescription& scene) { return listOf(degreesOf(now(scene))); },
    [this, track](SceneDescription& scene, const Numbers& numbers)
    { setTrackAt(track(scene), this->State.frame(), rotationOf(vectorOf(numbers))); });
  NumberRow* const quaternion = this->addNumbers(
    tr("Quaternion"), "orientation", 4,
    [now](const SceneDescription& scene)
    {
      const Quaternion q = now(scene);
      return Numbers{ q.w, q.x, q.y, q.z };
    },
    [this, track](SceneDescription& scene, const Numbers& numbers)
    { setTrackAt(track(scene), this->State.frame(), unitOf(numbers)); });
  quaternion->takeTogether();
}

void PropertiesPanel::addCheck(
  const QString& label, const QString& name, const std::function<bool&(SceneDescription&)>& value)
{
  auto* box = new QCheckBox(this->Form->parentWidget());
  box->setObjectName(name);
  this->Form->addRow(label, box);
  this->Refreshers.push_back(
    [box, value](SceneDescription& scene)
    {
      const bool blocked = box->blockSignals(true);
      box->setChecked(value(scene));
      box->blockSignals(blocked);
    });
  connect(box, &QCheckBox::toggled, this,
    [this, label, value](bool on) { this->edit(label, [&](SceneDescription& scene) { value(scene) = on; }); });
}

void PropertiesPanel::addChoice(const QString& label, const QString& name, const QStringList& words,
  const std::function<int(const SceneDescription&)>& get, const std::function<void(SceneDescription&, int)>& set)
{
  auto* box = new QComboBox(this->Form->parentWidget());
  box->setObjectName(name);
  box->addItems(words);
  this->Form->addRow(label, box);
  this->Refreshers.push_back([box, get](SceneDescription& scene) { box->setCurrentIndex(get(scene)); });
  connect(box, QOverload<int>::of(&QComboBox::activated), this,
    [this, label, set](int choice) { this->edit(label, [&](SceneDescription& scene) { set(scene, choice); }); });
}

void PropertiesPanel::buildObject(std::size_t index)
{
  const ObjectDescription& now = this->State.scene().objects[index];
  const auto object = [index](SceneDescription& scene) -> ObjectDescription& { return scene.objects[index]; };
  this->addText(
    tr("Class"), "class", [index](const SceneDescription& scene) { return scene.objects[index].className; },
    [index](SceneDescription& scene, const std::string& text) { scene.objects[index].className = text; });
  this->addLine(tr("Model"), toText(now.model));
  if (!now.parent.empty())
  {
    this->addLine(tr("Parent"), toText(now.parent));
  }
  const QString units = toText(this->State.scene().units);
  this->addTrack(units.isEmpty() ? tr("Position") : tr("Position, %1").arg(units), "position",
    [object](SceneDescription& scene) -> Track<Eigen::Vector3d>& { return object(scene).position; });
  this->addOrientation([object](SceneDescription& scene) -> Track<Quaternion>& { return object(scene).orientation; });
  this->addTrack(
    tr("Scale"), "scale", [object](SceneDescription& scene) -> Track<Eigen::Vector3d>& { return object(scene).scale; });
  this->addCheck(
    tr("Visible"), "visible", [object](SceneDescription& scene) -> bool& { return object(scene).visible; });
  this->buildSequence(index);
}

void PropertiesPanel::buildLight(std::size_t index)
{
  const auto light = [index](SceneDescription& scene) -> LightDescription& { return scene.lights[index]; };
  this->addChoice(
    tr("Kind"), "kind", { tr("point"), tr("head"), tr("directional"), tr("spot") },
    [index](const SceneDescription& scene) { return static_cast<int>(scene.lights[index].kind); },
    [index](SceneDescription& scene, int kind) { scene.lights[index].kind = static_cast<LightKind>(kind); });
  this->addCheck(tr("Enabled"), "enabled", [light](SceneDescription& scene) -> bool& { return light(scene).enabled; });
  using Vectors = Track<Eigen::Vector3d>;
  this->addTrack(
    tr("Position"), "position", [light](SceneDescription& scene) -> Vectors& { return light(scene).position; });
  this->addTrack(tr("Target"), "target", [light](SceneDescription& scene) -> Vectors& { return light(scene).target; });
  using Color = Eigen::Vector3d;
  this->addColor(tr("Diffuse"), "diffuse", [light](SceneDescription& scene) -> Color& { return light(scene).diffuse; });
  this->addColor(
    tr("Specular"), "specular", [light](SceneDescription& scene) -> Color& { return light(scene).specular; });
  this->addColor(tr("Ambient"), "ambient", [light](SceneDescription& scene) -> Color& { return light(scene).ambient; });
  this->addColor(
    tr("Attenuation"), "attenuation", [light](SceneDescription& scene) -> Color& { return light(scene).attenuation; });
  this->addNumber(
    tr("Intensity"), "intensity", [light](SceneDescription& scene) -> double& { return light(scene).intensity; });
  this->addNumber(
    tr("Cone, \u00b0"), "coneAngle", [light](SceneDescription& scene) -> double& { return light(scene).coneAngle; });
  this->addNumber(
    tr("Exponent"), "exponent", [light](SceneDescription& scene) -> double& { return light(scene).exponent; });
  this->addCheck(tr("Shadows"), "shadows", [light](SceneDescription& scene) -> bool& { return light(scene).shadows; });
}

void PropertiesPanel::buildCamera(std::size_t index)
{
  const CameraDescription& now = this->State.scene().cameras[index];
  const auto camera = [index](SceneDescription& scene) -> CameraDescription& { return scene.cameras[index]; };
  using Vectors = Track<Eigen::Vector3d>;
  if (now.posed)
  {
    this->addTrack(
      tr("Position"), "position", [camera](SceneDescription& scene) -> Vectors& { return camera(scene).position; });
    this->addOrientation([camera](SceneDescription& scene) -> Track<Quaternion>& { return camera(scene).orientation; });
  }
  else
  {
    this->addTrack(tr("Eye"), "eye", [camera](SceneDescription& scene) -> Vectors& { return camera(scene).eye; });
    this->addTrack(
      tr("Look at"), "lookAt", [camera](SceneDescription& scene) -> Vectors& { return camera(scene).lookAt; });
    this->addTrack(tr("Up"), "up", [camera](SceneDescription& scene) -> Vectors& { return camera(scene).up; });
  }
  if (now.kind == CameraKind::Orthographic)
  {
    this->addTrack(tr("View height"), "viewHeight",
      [camera](SceneDescription& scene) -> Track<double>& { return camera(scene).viewHeight; });
  }
  else if (now.K)
  {
    this->addLine(tr("Lens"), tr("by its matrix K"));
  }
  else
  {
    this->addTrack(tr("Field of view, \u00b0"), "fovY",
      [camera](SceneDescription& scene) -> Track<double>& { return camera(scene).fovY; });
    this->addNumber(tr("Aspect (0: square)"), "aspect",
      [camera](SceneDescription& scene) -> double& { return camera(scene).aspect; });
  }
  this->addNumber(tr("Near"), "near", [camera](SceneDescription& scene) -> double& { return camera(scene).near; });
  this->addNumber(tr("Far"), "far", [camera](SceneDescription& scene) -> double& { return camera(scene).far; });
  this->addNumbers(
    tr("Size, pixels"), "size", 2,
    [index](const SceneDescription& scene) {
      return Numbers{ double(scene.cameras[index].width), double(scene.cameras[index].height) };
    },
    [camera](SceneDescription& scene, const Numbers& size)
    {
      // A size is given whole or not at all: the first number typed makes the usual shape.
      CameraDescription& its = camera(scene);
      const bool widthTyped = pixelsOf(size[0]) != its.width;
      its.width = pixelsOf(size[0]);
      its.height = pixelsOf(size[1]);
      if ((its.width == 0) != (its.height == 0) && widthTyped)
      {
        its.height = its.width == 0 ? 0 : std::max(1, its.width * 3 / 4);
      }
      else if ((its.width == 0) != (its.height == 0))
      {
        its.width = its.height == 0 ? 0 : std::max(1, its.height * 4 / 3);
      }
    });
}

} // namespace dgtk
