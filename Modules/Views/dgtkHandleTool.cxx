// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkHandleTool.h"

#include "dgtkSceneView.h"

#include <string>

namespace dgtk
{

namespace
{
constexpr int digits = 4; // shown of a number while it changes

QString shown(double value) { return QString::number(value, 'g', digits); }

/// What steps of undo are called.
std::string nameOf(HandleMode mode)
{
  return mode == HandleMode::Rotate ? "Rotate" : mode == HandleMode::Scale ? "Scale" : "Move";
}

QString axisName(int axis) { return QString(QChar('X' + axis)); }
} // namespace

HandleTool::HandleTool(EditorState& state, QObject* parent)
  : QObject(parent)
  , State(state)
{
  // What is dragged may go: deleted by its key, or taken back.
  connect(&state, &EditorState::selectionChanged, this, &HandleTool::finish);
}

std::optional<HandlePlace> HandleTool::place(const ScenePlaces& places) const
{
  if (this->State.selection().empty() || this->Mode == HandleMode::None)
  {
    return std::nullopt;
  }
  const ItemMotion items(this->State.scene(), places, this->State.selection(), this->State.frame());
  if (!items.can(this->Mode))
  {
    return std::nullopt;
  }
  return HandlePlace{ this->Mode, items.pivot(this->Pivot), items.axes(this->Mode) };
}

void HandleTool::start(const SceneView& view, const ScenePlaces& places)
{
  this->State.document().finishMerging();
  const SceneView::Grasp& grasp = view.grasp();
  // What is dragged itself moves, whatever its handles would do.
  this->Doing = grasp.handle ? this->Mode : HandleMode::Move;
  this->Items.emplace(this->State.scene(), places, this->State.selection(), this->State.frame());
  const HandlePlace place{ this->Doing, this->Items->pivot(this->Pivot), this->Items->axes(this->Doing) };
  this->Drag.emplace(place, grasp.handle.value_or(Handle{}), grasp.handle ? place.pivot : grasp.point, view.camera(),
    view.width(), view.height(), Eigen::Vector2d(grasp.pressed.x(), grasp.pressed.y()));
  this->Step = view.gridStep();
  this->Applied = false;
  this->Snap = false;
  this->Pixel = grasp.pressed;
}

void HandleTool::drag(const QPointF& pixel, bool snap)
{
  this->Pixel = pixel;
  this->Snap = snap;
  this->apply();
}

void HandleTool::constrain(int axis, bool plane)
{
  if (this->Drag)
  {
    const Handle wanted{ plane ? Handle::Kind::Plane : Handle::Kind::Axis, axis };
    this->Drag->constrain(this->Drag->handle() == wanted ? Handle{} : wanted);
    this->apply();
  }
}

void HandleTool::apply()
{
  if (!this->Drag)
  {
    return;
  }
  const WorldMotion motion =
    this->Drag->motion(Eigen::Vector2d(this->Pixel.x(), this->Pixel.y()), this->Snap ? this->Step : 0.0);
  const auto change = [&](SceneDescription& scene) { this->Items->apply(scene, motion); };
  const std::string name = nameOf(this->Doing);
  this->Text = this->describe(motion);
  emit this->told(this->Text + tr("     X, Y, Z: one axis, Shift: the two others; Ctrl: steps; Esc: as it was"));
  this->Applied = this->State.attempt(
                    [&]
                    {
                      if (this->Items->items().size() == 1)
                      {
                        this->State.document().editItem(name, this->Items->items().front(), change, "drag");
                      }
                      else
                      {
                        this->State.document().edit(name, change, "drag");
                      }
                    }) ||
                  this->Applied;
}

QString HandleTool::describe(const WorldMotion& motion) const
{
  const Handle grip = this->Drag->handle();
  const Eigen::Vector3d& t = motion.translation;
  const Eigen::Vector3d& f = motion.factors;
  switch (motion.mode)
  {
    case HandleMode::Rotate:
    {
      const QString turned = grip.kind == Handle::Kind::Axis
                               ? tr("Rotate %1\u00b0 about %2").arg(shown(motion.degrees), axisName(grip.axis))
                               : tr("Rotate %1\u00b0").arg(shown(motion.degrees));
      return this->Items->shears(motion) ? tr("%1, sheared by the parent's uneven scale").arg(turned) : turned;
    }
    case HandleMode::Scale:
      return f.x() == f.y() && f.y() == f.z() ? tr("Scale by %1").arg(shown(f.x()))
                                              : tr("Scale by %1, %2, %3").arg(shown(f.x()), shown(f.y()), shown(f.z()));
    default:
      return tr("Move by %1, %2, %3").arg(shown(t.x()), shown(t.y()), shown(t.z()));
  }
}

void HandleTool::finish()
{
  if (this->Drag)
  {
    this->Drag.reset();
    this->Text.clear();
    this->State.document().finishMerging();
  }
}

void HandleTool::cancel()
{
  if (!this->Drag)
  {
    return;
  }
  this->Drag.reset();
  this->Text.clear();
  if (this->Applied)
  {
    this->State.document().abandon();
  }
  emit this->told(tr("As it was before the drag"));
}

} // namespace dgtk
