// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSceneView_h
#define dgtkSceneView_h

// Private to Widgets.

#include "dgtkViewActors.h"
#include "dgtkViewCamera.h"

#include <QPoint>
#include <QVTKOpenGLNativeWidget.h>

#include <vtkSmartPointer.h>

#include <memory>
#include <optional>

class vtkRenderer;

namespace dgtk
{

/// One view of the scene. Mouse, as in VTK: left turns the perspective (and pans parallel views), middle pans, right
/// and wheel zoom; a click selects, with Control adds; a left drag on what is selected moves it in the view's plane.
class SceneView : public QVTKOpenGLNativeWidget
{
  Q_OBJECT

public:
  SceneView(ViewKind kind, QWidget* parent);
  ~SceneView() override;

  const ViewCamera& camera() const { return this->Camera; }
  ViewKind kind() const { return this->Camera.kind(); }
  /// Looks the way of its kind again; for a scene with another up axis.
  void resetCamera(UpAxis upAxis);
  void frame(const WorldBox& box);
  /// Takes the place and direction of a camera; the field of view stays the view's own.
  void lookThrough(const CameraDescription& camera, double frame);
  void showScene(const SceneDescription& scene, const std::shared_ptr<const ScenePlaces>& places,
    const SceneItems& selected, ViewMeshes& meshes);
  void setStyle(ViewStyle style) { this->Actors->setStyle(style); }
  void showGrid(bool on);
  /// Something is being dragged in another view: this one may be coarse, too.
  void setHurried(bool on);
  /// Draws when the event loop is reached; many calls draw once.
  void drawSoon();
  /// Something opaque is in front of the view: it need not draw.
  void setCovered(bool on);
  /// Nothing where only the background is.
  std::optional<SceneItem> itemAt(const QPoint& position) const;

signals:
  void activated();
  void cameraMoved();
  void picked(bool hit, int kind, int index, bool add);
  void dragStarted();
  void dragged(double x, double y, double z); ///< world, since the start
  void dragFinished();
  void maximizeAsked();
  void menuAsked(const QPoint& global);

protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;

private:
  enum class Motion
  {
    None,
    Orbit,
    Pan,
    Zoom,
    Drag
  };
  void draw();
  void moveView(const QPoint& step);
  void pick(const QPoint& position, bool add);
  void placeCamera();

  ViewCamera Camera;
  vtkSmartPointer<vtkRenderer> Renderer;
  std::unique_ptr<ViewActors> Actors;
  std::shared_ptr<const ScenePlaces> Places;
  SceneItems Selected;
  Motion Moving = Motion::None;
  QPoint Pressed;
  QPoint Last;
  bool Moved = false;
  bool DrawWanted = false;
  bool Hurried = false;
  bool Covered = false;
  double FineSeconds = 0; ///< that the latest whole drawing took
  Eigen::Vector3d Grasped{ 0, 0, 0 };
};

} // namespace dgtk

#endif
