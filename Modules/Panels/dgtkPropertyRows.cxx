// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPropertiesPanel.h"

#include "dgtkVectorRows.h"

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
  const std::function<void(SceneDescription&, const std::string&)>& set, bool forAll)
{
  auto* field = new QLineEdit(this->Form->parentWidget());
  field->setObjectName(name);
  leaveUndo(field);
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
    [this, field, label, get, set, forAll]
    {
      const std::string text = field->text().toStdString();
      const std::string old = get(this->State.scene());
      // What a refusal leaves; its dialog takes the focus, which ends the typing once more.
      field->setText(toText(old));
      if (text == old)
      {
        return;
      }
      const auto change = [&](SceneDescription& scene) { set(scene, text); };
      if (forAll)
      {
        this->edit(label, change);
        return;
      }
      // A name stands in other items too.
      const std::string step = tr("Change %1").arg(label).toStdString();
      this->State.attempt([&] { this->State.document().edit(step, change); });
      this->refresh();
    });
}

NumberRow* PropertiesPanel::addNumbers(
  const QString& label, const QString& name, int count, const GetNumbers& get, const SetNumbers& set)
{
  auto* row = new NumberRow(name, count, this->Form->parentWidget());
  this->Form->addRow(label, row);
  this->Refreshers.push_back([row, get](SceneDescription& scene) { row->setValues(get(scene)); });
  row->onEdit(
    [this, row, label, get, set](const Numbers& values)
    {
      const Numbers before = get(this->State.scene());
      this->edit(label,
        [&](SceneDescription& scene)
        {
          Numbers own = get(scene); // another item's keep what was not typed
          for (std::size_t i = 0; i < std::min(own.size(), values.size()); ++i)
          {
            own[i] = row->areTakenTogether() || values[i] != before[i] ? values[i] : own[i];
          }
          set(scene, own);
        });
    });
  return row;
}

void PropertiesPanel::addNumber(
  const QString& label, const QString& name, const std::function<double&(SceneDescription&)>& value)
{
  this->addNumbers(
    label, name, 1, [value](const SceneDescription& scene) { return Numbers{ value(readable(scene)) }; },
    [value](SceneDescription& scene, const Numbers& numbers) { value(scene) = numbers[0]; });
}

void PropertiesPanel::addVector(
  const QString& label, const QString& name, const std::function<Eigen::Vector3d&(SceneDescription&)>& value)
{
  this->addNumbers(
    label, name, 3, [value](const SceneDescription& scene) { return listOf(value(readable(scene))); },
    [value](SceneDescription& scene, const Numbers& numbers) { value(scene) = vectorOf(numbers); });
}

void PropertiesPanel::addTrack(const QString& label, const QString& name,
  const std::function<Track<Eigen::Vector3d>&(SceneDescription&)>& track, bool color)
{
  this->addNumbers(
    label, name, 3,
    [this, track, color](const SceneDescription& scene)
    { return listOf(valueAt(track(readable(scene)), this->State.frame(), color)); },
    [this, track](SceneDescription& scene, const Numbers& numbers)
    { setTrackAt(track(scene), this->State.frame(), vectorOf(numbers)); });
}

void PropertiesPanel::addTrack(
  const QString& label, const QString& name, const std::function<Track<double>&(SceneDescription&)>& track)
{
  this->addNumbers(
    label, name, 1,
    [this, track](const SceneDescription& scene)
    { return Numbers{ boundedAt(track(readable(scene)), this->State.frame()) }; },
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

void PropertiesPanel::addTrack(
  const QString& label, const QString& name, const std::function<Track<bool>&(SceneDescription&)>& track)
{
  this->addCheck(
    label, name,
    [this, track](const SceneDescription& scene) { return track(readable(scene)).at(this->State.frame()); },
    [this, track](SceneDescription& scene, bool on) { setTrackAt(track(scene), this->State.frame(), on); });
}

void PropertiesPanel::addCheck(
  const QString& label, const QString& name, const std::function<bool&(SceneDescription&)>& value)
{
  this->addCheck(
    label, name, [value](const SceneDescription& scene) { return value(readable(scene)); },
    [value](SceneDescription& scene, bool on) { value(scene) = on; });
}

void PropertiesPanel::addCheck(const QString& label, const QString& name,
  const std::function<bool(const SceneDescription&)>& get, const std::function<void(SceneDescription&, bool)>& set)
{
  auto* box = new QCheckBox(this->Form->parentWidget());
  box->setObjectName(name);
  this->Form->addRow(label, box);
  this->Refreshers.push_back(
    [box, get](SceneDescription& scene)
    {
      const bool blocked = box->blockSignals(true);
      box->setChecked(get(scene));
      box->blockSignals(blocked);
    });
  connect(box, &QCheckBox::toggled, this,
    [this, label, set](bool on) { this->edit(label, [&](SceneDescription& scene) { set(scene, on); }); });
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

} // namespace dgtk
