// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneView.h"

#include <QApplication>
#include <QElapsedTimer>
#include <QMouseEvent>
#include <QTimer>
#include <QWheelEvent>

#include <vtkCamera.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr double pickPixels = 8; // around cameras and lights
constexpr double degreesPerPixel = 0.4;
constexpr double zoomPerPixel = 0.008; // natural logarithm
constexpr double slowSeconds = 0.1;    // of a drawing; slower ones are replaced by boxes while the mouse moves
constexpr double zoomPerStep = 0.15;   // of the wheel
} // namespace

SceneView::SceneView(ViewKind kind, QWidget* parent)
  : QVTKOpenGLNativeWidget(parent)
  , Camera(kind)
  , Renderer(vtkSmartPointer<vtkRenderer>::New())
{
  vtkNew<vtkGenericOpenGLRenderWindow> window;
  window->SetMultiSamples(0);
  this->setRenderWindow(window);
  window->AddRenderer(this->Renderer);
  window->GetInteractor()->SetInteractorStyle(nullptr);
  this->Renderer->SetBackground(0.30, 0.31, 0.33);
  this->Renderer->SetBackground2(0.20, 0.21, 0.23);
  this->Renderer->GradientBackgroundOn();
  this->Actors = std::make_unique<ViewActors>(this->Renderer, kind);
  this->setFocusPolicy(Qt::StrongFocus);
  this->setMinimumSize(120, 90);
  this->Camera.frame({}, 1);
  this->placeCamera();
}

SceneView::~SceneView() = default;

void SceneView::placeCamera()
{
  vtkCamera* const camera = this->Renderer->GetActiveCamera();
  Eigen::Vector3d eye = this->Camera.eye();
  Eigen::Vector3d focus = this->Camera.focus();
  Eigen::Vector3d up = this->Camera.up();
  camera->SetPosition(eye.data());
  camera->SetFocalPoint(focus.data());
  camera->SetViewUp(up.data());
  camera->SetViewAngle(ViewCamera::angle());
  camera->SetParallelProjection(this->Camera.parallel());
  camera->SetParallelScale(this->Camera.height() / 2);
  emit this->cameraMoved();
  this->drawSoon();
}

void SceneView::drawSoon()
{
  if (!this->DrawWanted)
  {
    this->DrawWanted = true;
    QTimer::singleShot(0, this,
      [this]
      {
        this->DrawWanted = false;
        this->draw();
      });
  }
}

void SceneView::setCovered(bool on)
{
  this->Covered = on;
  this->drawSoon();
}

void SceneView::setHurried(bool on)
{
  this->Hurried = on;
  this->drawSoon();
}

void SceneView::draw()
{
  if (!this->isVisible() || this->Covered)
  {
    return;
  }
  const bool moving = this->Hurried || (this->Moving != Motion::None && this->Moved);
  const bool coarse = moving && this->FineSeconds > slowSeconds;
  if (coarse)
  {
    this->Actors->showCoarse(*this->Places);
  }
  else
  {
    this->Actors->showFine();
  }
  QElapsedTimer clock;
  clock.start();
  this->Renderer->ResetCameraClippingRange();
  this->renderWindow()->Render();
  this->renderWindow()->WaitForCompletion();
  this->FineSeconds = coarse ? this->FineSeconds : clock.nsecsElapsed() * 1e-9;
}

void SceneView::resetCamera(UpAxis upAxis) { this->Camera = ViewCamera(this->kind(), upAxis); }

void SceneView::frame(const WorldBox& box)
{
  this->Camera.frame(box, double(std::max(this->width(), 1)) / std::max(this->height(), 1));
  this->placeCamera();
}

void SceneView::lookThrough(const CameraDescription& camera, double frame)
{
  Eigen::Vector3d eye = camera.eye.at(frame);
  Eigen::Vector3d focus = camera.lookAt.at(frame);
  if (camera.posed)
  {
    eye = camera.position.at(frame);
    const double distance = std::max(1.0, (this->Camera.focus() - eye).norm());
    focus = eye + distance * camera.orientation.at(frame).matrix().col(2);
  }
  this->Camera.look(eye, focus);
  this->placeCamera();
}

void SceneView::showScene(const SceneDescription& scene, const std::shared_ptr<const ScenePlaces>& places,
  const SceneItems& selected, ViewMeshes& meshes)
{
  this->Places = places;
  this->Selected = selected;
  this->Actors->show(scene, *places, selected, meshes);
  this->drawSoon();
}

void SceneView::showGrid(bool on)
{
  this->Actors->showGrid(on);
  this->drawSoon();
}

std::optional<SceneItem> SceneView::itemAt(const QPoint& position) const
{
  if (this->Places == nullptr)
  {
    return std::nullopt;
  }
  return pickItem(*this->Places,
    this->Camera.ray(position.x() + 0.5, position.y() + 0.5, this->width(), this->height()),
    this->Camera.reach(pickPixels, this->height()));
}

void SceneView::pick(const QPoint& position, bool add)
{
  const std::optional<SceneItem> item = this->itemAt(position);
  emit this->picked(
    item.has_value(), item ? static_cast<int>(item->kind) : 0, item ? static_cast<int>(item->index) : 0, add);
}

void SceneView::mousePressEvent(QMouseEvent* event)
{
  emit this->activated();
  this->Pressed = event->pos();
  this->Last = event->pos();
  this->Moved = false;
  if (event->button() == Qt::MiddleButton ||
      (event->button() == Qt::LeftButton && event->modifiers() & Qt::ShiftModifier))
  {
    this->Moving = Motion::Pan;
  }
  else if (event->button() == Qt::RightButton)
  {
    this->Moving = Motion::Zoom;
  }
  else if (event->button() == Qt::LeftButton)
  {
    const std::optional<SceneItem> item = this->itemAt(event->pos());
    const bool onSelected =
      item && std::find(this->Selected.begin(), this->Selected.end(), *item) != this->Selected.end();
    this->Moving = onSelected ? Motion::Drag : this->Camera.parallel() ? Motion::Pan : Motion::Orbit;
    if (onSelected)
    {
      const WorldBox box = this->Places->boxOf(*item);
      this->Grasped = box.center();
    }
  }
}

void SceneView::mouseMoveEvent(QMouseEvent* event)
{
  if (this->Moving == Motion::None)
  {
    return;
  }
  if (!this->Moved && (event->pos() - this->Pressed).manhattanLength() < QApplication::startDragDistance())
  {
    return;
  }
  if (!this->Moved && this->Moving == Motion::Drag)
  {
    emit this->dragStarted();
  }
  this->Moved = true;
  if (this->Moving == Motion::Drag)
  {
    const QPoint way = event->pos() - this->Pressed;
    const Eigen::Vector3d motion = this->Camera.motion(this->Grasped, way.x(), way.y(), this->height());
    emit this->dragged(motion.x(), motion.y(), motion.z());
    return;
  }
  this->moveView(event->pos() - this->Last);
  this->Last = event->pos();
}

void SceneView::moveView(const QPoint& step)
{
  switch (this->Moving)
  {
    case Motion::Orbit:
      this->Camera.orbit(degreesPerPixel * step.x(), degreesPerPixel * step.y());
      break;
    case Motion::Pan:
      this->Camera.pan(step.x(), step.y(), this->height());
      break;
    default:
      this->Camera.zoom(std::exp(-zoomPerPixel * step.y()));
      break;
  }
  this->placeCamera();
}

void SceneView::mouseReleaseEvent(QMouseEvent* event)
{
  const Motion was = this->Moving;
  this->Moving = Motion::None;
  if (this->Moved)
  {
    this->drawSoon(); // all of it, after a coarse motion
    if (was == Motion::Drag)
    {
      emit this->dragFinished();
    }
    return;
  }
  if (event->button() == Qt::LeftButton)
  {
    this->pick(event->pos(), event->modifiers() & Qt::ControlModifier);
  }
  else if (event->button() == Qt::RightButton)
  {
    const std::optional<SceneItem> item = this->itemAt(event->pos());
    if (!item || std::find(this->Selected.begin(), this->Selected.end(), *item) == this->Selected.end())
    {
      this->pick(event->pos(), false);
    }
    emit this->menuAsked(event->globalPos());
  }
}

void SceneView::mouseDoubleClickEvent(QMouseEvent* event)
{
  if (event->button() == Qt::LeftButton)
  {
    this->Moving = Motion::None;
    this->Moved = true; // the release that follows selects nothing
    emit this->maximizeAsked();
  }
}

void SceneView::wheelEvent(QWheelEvent* event)
{
  this->Camera.zoom(std::exp(zoomPerStep * event->angleDelta().y() / 120.0));
  this->placeCamera();
  event->accept();
}

void SceneView::resizeEvent(QResizeEvent* event)
{
  QVTKOpenGLNativeWidget::resizeEvent(event);
  this->drawSoon();
}

} // namespace dgtk
