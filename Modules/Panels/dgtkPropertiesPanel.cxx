// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPropertiesPanel.h"

#include "dgtkItemMotion.h"
#include "dgtkNumberRow.h"
#include "dgtkPortableMath.h"
#include "dgtkSequenceBar.h"

#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace dgtk
{

namespace
{

/// Digits beyond what degrees are good for would only be noise.
double tidy(double degrees) { return std::round(degrees * 1e9) / 1e9 + 0.0; }

/// Whether a row of one item is a row of the other, too, but for those of an object's sequences.
bool haveSameRows(const SceneDescription& scene, const SceneItem& item, const SceneItem& other)
{
  if (item.kind != other.kind)
  {
    return false;
  }
  switch (item.kind)
  {
    case SceneItem::Kind::Object:
      return true;
    case SceneItem::Kind::Light:
      return scene.lights[item.index].kind == scene.lights[other.index].kind;
    default:
    {
      const CameraDescription& a = scene.cameras[item.index];
      const CameraDescription& b = scene.cameras[other.index];
      return a.model == b.model && a.posed == b.posed && a.K.has_value() == b.K.has_value();
    }
  }
}

void swapItems(SceneDescription& scene, const SceneItem& item, std::size_t other)
{
  switch (item.kind)
  {
    case SceneItem::Kind::Object:
      std::swap(scene.objects[item.index], scene.objects[other]);
      break;
    case SceneItem::Kind::Light:
      std::swap(scene.lights[item.index], scene.lights[other]);
      break;
    default:
      std::swap(scene.cameras[item.index], scene.cameras[other]);
  }
}
} // namespace

Eigen::Vector3d degreesOf(const Quaternion& rotation)
{
  const Eigen::Matrix3d m = rotation.matrix();
  const double y = std::asin(std::fmax(-1.0, std::fmin(1.0, -m(2, 0))));
  const bool locked = std::abs(m(2, 0)) > 1 - 1e-12;
  const double x = locked ? 0.0 : std::atan2(m(2, 1), m(2, 2));
  const double z = locked ? std::atan2(-m(0, 1), m(1, 1)) : std::atan2(m(1, 0), m(0, 0));
  const Eigen::Vector3d degrees = Eigen::Vector3d(x, y, z) * (180 / pi);
  return { tidy(degrees.x()), tidy(degrees.y()), tidy(degrees.z()) };
}

Quaternion rotationOf(const Eigen::Vector3d& degrees)
{
  const Quaternion x = turn(Eigen::Vector3d::UnitX(), degrees.x());
  const Quaternion y = turn(Eigen::Vector3d::UnitY(), degrees.y());
  const Quaternion z = turn(Eigen::Vector3d::UnitZ(), degrees.z());
  return product(z, product(y, x));
}

PropertiesPanel::PropertiesPanel(EditorState& state, QWidget* parent)
  : QScrollArea(parent)
  , State(state)
{
  this->setObjectName("propertiesPanel");
  this->setWidgetResizable(true);
  this->setFrameShape(QFrame::NoFrame);
  connect(&state, &EditorState::selectionChanged, this, &PropertiesPanel::rebuild);
  connect(&state, &EditorState::changed, this, &PropertiesPanel::refresh);
  connect(&state, &EditorState::frameChanged, this, &PropertiesPanel::refresh);
  connect(&state, &EditorState::typingEnds, this, &PropertiesPanel::takeTyped);
  this->rebuild();
}

void PropertiesPanel::rebuildKeepingFocus()
{
  const QWidget* const focus = this->window()->focusWidget();
  const QString name = focus != nullptr && this->widget()->isAncestorOf(focus) ? focus->objectName() : QString();
  this->rebuild();
  if (QWidget* const same = name.isEmpty() ? nullptr : this->widget()->findChild<QWidget*>(name))
  {
    same->setFocus();
  }
}

void PropertiesPanel::rebuild()
{
  this->Refreshers.clear();
  this->Item.reset();
  auto* page = new QWidget;
  this->Form = new QFormLayout(page);
  this->Form->setContentsMargins(6, 6, 6, 6);
  this->Form->setVerticalSpacing(4);
  this->Form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  this->Form->setRowWrapPolicy(QFormLayout::WrapLongRows); // names are longer in some languages
  this->Rows = this->rowsWanted();
  const SceneItems& selection = this->State.selection();
  if (selection.empty())
  {
    auto* hint = new QLabel(tr("Nothing is selected: these are the values of the scene. Click an object, light or "
                               "camera in a view or in the scene tree to see its own."),
      page);
    hint->setWordWrap(true);
    this->Form->addRow(hint);
    this->buildScene();
  }
  else
  {
    this->Item = selection.front();
    if (selection.size() > 1)
    {
      auto* many = new QLabel(
        tr("%n selected: the first's values, changed for all with the same rows", nullptr, int(selection.size())),
        page);
      many->setWordWrap(true);
      this->Form->addRow(many);
    }
    const SceneItem item = *this->Item;
    this->addText(
      tr("Name"), "name", [item](const SceneDescription& scene) { return itemName(scene, item); },
      [item](SceneDescription& scene, const std::string& name) { renameItem(scene, item, name); }, false);
    switch (item.kind)
    {
      case SceneItem::Kind::Object:
        this->buildObject(item.index);
        break;
      case SceneItem::Kind::Light:
        this->buildLight(item.index);
        break;
      default:
        this->buildCamera(item.index);
    }
  }
  if (QWidget* const old = this->widget())
  {
    // One of its fields may have led here, and loses the focus with it; none may speak any more.
    for (QWidget* field : old->findChildren<QWidget*>())
    {
      field->blockSignals(true);
    }
    this->takeWidget();
    old->setObjectName("old");
    old->deleteLater();
  }
  for (QLineEdit* field : page->findChildren<QLineEdit*>())
  {
    field->setAcceptDrops(false); // a file dropped here is for the window
  }
  this->setWidget(page);
  this->refresh();
}

QString PropertiesPanel::rowsWanted() const
{
  const SceneDescription& scene = this->State.scene();
  QString rows = toText(scene.units) + '\n' + toText(this->State.document().path());
  if (this->State.selection().empty())
  {
    return rows;
  }
  const SceneItem item = this->State.selection().front();
  if (item.kind == SceneItem::Kind::Object && item.index < scene.objects.size())
  {
    const ObjectDescription& object = scene.objects[item.index];
    rows += '\n' + toText(object.model) + '\n' + toText(object.parent);
    for (const std::string& sequence : sequencesOf(scene, object, this->State.document().models()))
    {
      rows += '\n' + toText(sequence);
    }
  }
  if (item.kind == SceneItem::Kind::Light && item.index < scene.lights.size())
  {
    rows += QString("\n%1").arg(static_cast<int>(scene.lights[item.index].kind));
  }
  if (item.kind == SceneItem::Kind::Camera && item.index < scene.cameras.size())
  {
    const CameraDescription& camera = scene.cameras[item.index];
    rows += QString("\n%1 %2 %3").arg(toText(camera.model)).arg(camera.K.has_value()).arg(camera.posed);
    for (const auto& [name, value] : camera.parameters)
    {
      rows += QString(" %1").arg(value.numbers.size());
    }
  }
  return rows;
}

QString PropertiesPanel::withUnits(const QString& label) const
{
  const std::string& units = this->State.scene().units;
  return units.empty() ? label : tr("%1, %2").arg(label, toText(units));
}

void PropertiesPanel::refresh()
{
  // Between a deletion and the new selection the item may be gone.
  if (this->Item && (this->State.selection().empty() || !(this->State.selection().front() == *this->Item)))
  {
    return;
  }
  if (this->Rows != this->rowsWanted())
  {
    this->rebuildKeepingFocus();
    return;
  }
  // The rows' accessors serve for reading and for writing; here they read.
  auto& scene = const_cast<SceneDescription&>(this->State.scene());
  for (const auto& refresher : this->Refreshers)
  {
    refresher(scene);
  }
}

void PropertiesPanel::takeTyped()
{
  const QList<QLineEdit*> fields = this->widget()->findChildren<QLineEdit*>();
  const auto typed =
    std::find_if(fields.begin(), fields.end(), [](const QLineEdit* field) { return field->isModified(); });
  if (typed == fields.end())
  {
    return;
  }
  if (auto* row = qobject_cast<NumberRow*>((*typed)->parentWidget()))
  {
    row->commit();
  }
  else
  {
    emit(*typed)->editingFinished();
  }
}

SceneItems PropertiesPanel::others() const
{
  SceneItems others;
  if (this->Item)
  {
    const SceneItems& selected = this->State.selection();
    std::copy_if(selected.begin(), selected.end(), std::back_inserter(others),
      [this](const SceneItem& other)
      { return !(other == *this->Item) && haveSameRows(this->State.scene(), *this->Item, other); });
  }
  return others;
}

void PropertiesPanel::edit(const QString& label, const std::function<void(SceneDescription&)>& change)
{
  const std::string text = tr("Change %1").arg(label).toStdString();
  this->State.attempt(
    [&]
    {
      const SceneItems others = this->others();
      if (this->Item && others.empty())
      {
        this->State.document().editItem(text, *this->Item, change);
      }
      else
      {
        this->State.document().edit(text,
          [&](SceneDescription& scene)
          {
            change(scene);
            for (const SceneItem& other : others)
            {
              swapItems(scene, *this->Item, other.index);
              change(scene);
              swapItems(scene, *this->Item, other.index);
            }
          });
      }
    });
  this->refresh();
}

void PropertiesPanel::addLine(const QString& label, const QString& text)
{
  auto* value = new QLabel(text, this->Form->parentWidget());
  value->setTextFormat(Qt::PlainText);
  value->setTextInteractionFlags(Qt::TextSelectableByMouse);
  value->setWordWrap(true);
  this->Form->addRow(label, value);
}

} // namespace dgtk
