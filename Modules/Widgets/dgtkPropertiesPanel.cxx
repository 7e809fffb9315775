// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPropertiesPanel.h"

#include "dgtkItemMotion.h"
#include "dgtkNumberRow.h"

#include <QFormLayout>
#include <QLabel>
#include <QLineEdit>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr double pi = 3.14159265358979323846;

/// Digits beyond what degrees are good for would only be noise.
double tidy(double degrees) { return std::round(degrees * 1e9) / 1e9 + 0.0; }
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

void PropertiesPanel::rebuild()
{
  this->Refreshers.clear();
  this->Item.reset();
  auto* page = new QWidget;
  this->Form = new QFormLayout(page);
  this->Form->setContentsMargins(6, 6, 6, 6);
  this->Form->setVerticalSpacing(4);
  this->Form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
  const SceneItems& selection = this->State.selection();
  if (selection.empty())
  {
    auto* hint = new QLabel(tr("Nothing is selected.\n\nClick an object, light or camera in a view or in the scene "
                               "tree to see its values here."),
      page);
    hint->setWordWrap(true);
    this->Form->addRow(hint);
  }
  else
  {
    this->Item = selection.front();
    if (selection.size() > 1)
    {
      this->Form->addRow(new QLabel(tr("The first of %n selected:", nullptr, int(selection.size())), page));
    }
    const SceneItem item = *this->Item;
    this->addText(
      tr("Name"), "name", [item](const SceneDescription& scene) { return itemName(scene, item); },
      [item](SceneDescription& scene, const std::string& name) { renameItem(scene, item, name); });
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
  QWidget* const old = this->takeWidget();
  if (old != nullptr)
  {
    // One of its fields may have led here; none may speak for another item.
    for (QWidget* field : old->findChildren<QWidget*>())
    {
      field->blockSignals(true);
    }
    old->setObjectName("old");
    old->deleteLater();
  }
  this->setWidget(page);
  this->refresh();
}

void PropertiesPanel::refresh()
{
  // Between a deletion and the new selection the item may be gone.
  if (this->Item && (this->State.selection().empty() || !(this->State.selection().front() == *this->Item)))
  {
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

void PropertiesPanel::edit(const QString& label, const std::function<void(SceneDescription&)>& change)
{
  const std::string text = tr("Change %1").arg(label).toStdString();
  const SceneItem item = *this->Item;
  this->State.attempt([&] { this->State.document().editItem(text, item, change); });
  this->refresh();
}

void PropertiesPanel::addLine(const QString& label, const QString& text)
{
  auto* value = new QLabel(text, this->Form->parentWidget());
  value->setTextInteractionFlags(Qt::TextSelectableByMouse);
  value->setWordWrap(true);
  this->Form->addRow(label, value);
}

} // namespace dgtk
