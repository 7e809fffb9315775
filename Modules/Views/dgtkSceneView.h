// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneView_h
#define dgtkSceneView_h

#include "dgtkDrawingRate.h"
#include "dgtkViewActors.h"
#include "dgtkViewHandles.h"
#include "dgtkViewLines.h"
#include "dgtkViewWidget.h"

#include <functional>
#include <memory>
#include <optional>

class QLabel;

namespace dgtk
{

class ViewOverlay;

/// One view of the scene. Mouse, as in VTK: left turns the perspective (and pans parallel views), middle pans, right
/// and wheel zoom; a click selects, with Control adds; a left drag on a handle, or on what is selected, is told to
/// whoever moves things.
class SceneView : public ViewWidget
{
  Q_OBJECT
  // What no picture shows, for tests.
  Q_PROPERTY(int actors READ actors)
  Q_PROPERTY(int coarserMeshes READ coarserMeshes)

public:
  /// What a drag holds.
  struct Grasp
  {
    std::optional<Handle> handle; ///< none: the thing itself
    QPoint pressed;
    Eigen::Vector3d point{ 0, 0, 0 }; ///< of the thing, world
  };

  SceneView(ViewKind kind, QWidget* parent);
  ~SceneView() override;

  ViewKind kind() const { return this->Camera.kind(); }
  /// Looks the way of its kind again; for a scene with another up axis.
  void resetCamera(UpAxis upAxis);
  /// Again when the view is shown, where it is hidden: its shape is not known yet.
  void frame(const WorldBox& box);
  /// Takes the place and direction of a camera; the field of view stays the view's own. False, and nothing changes,
  /// where the camera looks at its own place.
  bool lookThrough(const CameraDescription& camera, double frame);
  /// `environment` of the places' surroundings.
  void showScene(const SceneDescription& scene, const std::shared_ptr<const ScenePlaces>& places,
    const std::shared_ptr<const EnvironmentLight>& environment, ViewMeshes& meshes);
  /// Of the scene that is shown: nothing is drawn anew but the lines about it.
  void showSelected(const SceneItems& selected);
  void setStyle(ViewStyle style) { this->Actors->setStyle(style); }
  void setSceneLights(bool on) { this->Actors->setSceneLights(on); }
  void showGrid(bool on);
  /// Something is being dragged in another view: this one may be coarse, too.
  void setHurried(bool on);
  /// Something opaque is in front of the view: it need not draw.
  void setCovered(bool on);
  /// A picture with another eye covers the view: `rays` are those of its pixels (none: outside of it), by which its
  /// objects are met. There are no handles, and nothing is dragged. Empty: the view's own eye again.
  using PictureRays = std::function<std::optional<WorldRay>(const QPoint&)>;
  void setPictureRays(const PictureRays& rays);
  /// The word at its corner: what is seen is not the renderer's.
  void showDraft(bool on);
  /// Nothing where only the background is.
  std::optional<SceneItem> itemAt(const QPoint& position) const;

  int actors() const;
  int coarserMeshes() const;

  /// The view that keys and menus mean has a frame.
  void setActive(bool on);
  void showHandles(const std::optional<HandlePlace>& place);
  const Grasp& grasp() const { return this->Grasped; }
  /// While it is dragged: this handle alone is shown, with a text beside the mouse.
  void showDrag(const Handle& handle, const QString& text);
  /// World units of a square of the grid.
  double gridStep() const { return this->Actors->gridStep(); }

signals:
  void activated();
  void cameraMoved();
  void picked(bool hit, int kind, int index, bool add);
  void dragStarted();
  void dragged(const QPointF& pixel, bool snap);
  void constrained(int axis, bool plane);
  void dragFinished();
  void dragCancelled();
  void maximizeAsked();
  void menuAsked(const QPoint& global);

protected:
  bool event(QEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void focusInEvent(QFocusEvent* event) override;
  void contextMenuEvent(QContextMenuEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void showEvent(QShowEvent* event) override;
  void draw() override;
  void placeCamera() override;

private:
  void stepBack();
  void pick(const QPoint& position, bool add);
  /// What lies over the view, for where its camera is now.
  void placeOverlay();
  Motion motionFor(const QMouseEvent& event);
  std::optional<Handle> handleAt(const QPoint& position) const;
  void endDrag();

  std::unique_ptr<ViewActors> Actors;
  std::shared_ptr<const ScenePlaces> Places;
  SceneItems Selected;
  LineList Chosen; ///< about what is selected
  bool Hurried = false;
  bool Covered = false;
  std::optional<WorldBox> FrameWanted;
  PictureRays Rays;
  double FineSeconds = 0; ///< that the latest whole drawing took
  DrawingRate Rate;
  Grasp Grasped;
  ViewOverlay* Overlay;
  QLabel* Draft;
  std::optional<HandlePlace> Handles;
  bool Holds = false; ///< a handle, or the thing itself, is being dragged
};

} // namespace dgtk

#endif
