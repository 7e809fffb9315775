// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkViewWidget_h
#define dgtkViewWidget_h

#include "dgtkViewCamera.h"
#include "dgtkViewsModule.h"

#include <QPoint>
#include <QVTKOpenGLNativeWidget.h>

#include <vtkSmartPointer.h>

class vtkRenderer;

namespace dgtk
{

/// One renderer, seen by a ViewCamera that the mouse moves. What a button does is for derived classes to say. Keys:
/// arrows turn the perspective and pan parallel views, with Shift they always pan; plus and minus zoom.
class DGTKVIEWS_EXPORT ViewWidget : public QVTKOpenGLNativeWidget
{
  Q_OBJECT

public:
  /// `top` and `bottom`: the background, RGB in [0, 1].
  ViewWidget(ViewKind kind, const Eigen::Vector3d& top, const Eigen::Vector3d& bottom, QWidget* parent);
  ~ViewWidget() override;

  const ViewCamera& camera() const { return this->Camera; }
  /// Draws when the event loop is reached; many calls draw once.
  void drawSoon();

protected:
  enum class Motion
  {
    None,
    Orbit,
    Pan,
    Zoom,
    Drag ///< of something in the view
  };

  virtual void draw() = 0;
  /// After a change of the camera.
  virtual void placeCamera();
  void beginMotion(const QMouseEvent& event, Motion motion);
  /// Whether the mouse was moved, with a button held, farther than a hand shakes.
  bool isMoving(const QMouseEvent& event) const;
  /// Turns, pans or zooms by what the mouse has moved since the last time.
  void moveView(const QMouseEvent& event);
  void frameBox(const WorldBox& box);
  void keyPressEvent(QKeyEvent* event) override;
  void wheelEvent(QWheelEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  void paintGL() override;

  ViewCamera Camera;
  vtkSmartPointer<vtkRenderer> Renderer;
  Motion Moving = Motion::None;
  QPoint Pressed;
  QPoint Last;
  bool Moved = false; ///< since the button was pressed

private:
  void drawWanted();

  bool DrawWanted = false;
  bool Resizing = false;
};

} // namespace dgtk

#endif
