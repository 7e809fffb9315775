// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkHandleTool_h
#define dgtkHandleTool_h

#include "dgtkEditorState.h"
#include "dgtkItemMotion.h"

#include <QObject>
#include <QPointF>

#include <optional>

namespace dgtk
{

class SceneView;

/// Moves, rotates and scales what is selected by the mouse: one drag at a time, one step of undo each.
class HandleTool : public QObject
{
  Q_OBJECT

public:
  HandleTool(EditorState& state, QObject* parent);

  HandleMode mode() const { return this->Mode; }
  void setMode(HandleMode mode) { this->Mode = mode; }
  void setPivot(HandlePivot pivot) { this->Pivot = pivot; }
  /// For what is selected; nothing where the mode can do nothing.
  std::optional<HandlePlace> place(const ScenePlaces& places) const;

  void start(const SceneView& view, const ScenePlaces& places);
  /// Pixels of the view in which the drag started.
  void drag(const QPointF& pixel, bool snap);
  /// To an axis or, with `plane`, to the plane of the two others; free again when it was so already.
  void constrain(int axis, bool plane);
  void finish();
  /// Everything is as before the drag.
  void cancel();
  bool active() const { return this->Drag.has_value(); }
  /// What is held now.
  Handle handle() const { return this->Drag ? this->Drag->handle() : Handle{}; }
  /// The numbers of the drag.
  QString text() const { return this->Text; }

signals:
  void told(const QString& text);

private:
  void apply();
  QString describe(const WorldMotion& motion) const;

  EditorState& State;
  HandleMode Mode = HandleMode::Move;
  HandlePivot Pivot = HandlePivot::Center;
  HandleMode Doing = HandleMode::Move; ///< of the drag
  std::optional<ItemMotion> Items;
  std::optional<HandleDrag> Drag;
  double Step = 1; ///< world units, when it snaps
  QPointF Pixel;
  bool Snap = false;
  bool Applied = false;
  QString Text;
};

} // namespace dgtk

#endif
