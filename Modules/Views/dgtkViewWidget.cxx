// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkViewWidget.h"

#include <QApplication>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QTimer>
#include <QWheelEvent>

#include <vtkCamera.h>
#include <vtkGenericOpenGLRenderWindow.h>
#include <vtkNew.h>
#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLState.h>
#include <vtkRenderWindowInteractor.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <cmath>

namespace dgtk
{

namespace
{
constexpr double degreesPerPixel = 0.4;
constexpr double degreesPerKey = 5;
constexpr double panPerKey = 30;       // pixels
constexpr double zoomPerPixel = 0.008; // natural logarithm
constexpr double zoomPerStep = 0.15;   // of the wheel
constexpr double wheelStep = 120;      // Qt's unit, eighths of a degree
} // namespace

ViewWidget::ViewWidget(ViewKind kind, const Eigen::Vector3d& top, const Eigen::Vector3d& bottom, QWidget* parent)
  : QVTKOpenGLNativeWidget(parent)
  , Camera(kind)
  , Renderer(vtkSmartPointer<vtkRenderer>::New())
{
  vtkNew<vtkGenericOpenGLRenderWindow> window;
  window->SetMultiSamples(0);
  this->setRenderWindow(window);
  window->AddRenderer(this->Renderer);
  window->GetInteractor()->SetInteractorStyle(nullptr);
  this->Renderer->SetBackground(bottom.x(), bottom.y(), bottom.z());
  this->Renderer->SetBackground2(top.x(), top.y(), top.z());
  this->Renderer->GradientBackgroundOn();
  this->setFocusPolicy(Qt::StrongFocus);
}

ViewWidget::~ViewWidget() = default;

void ViewWidget::drawSoon()
{
  if (!this->DrawWanted)
  {
    this->DrawWanted = true;
    QTimer::singleShot(0, this, &ViewWidget::drawWanted);
  }
}

void ViewWidget::drawWanted()
{
  if (this->DrawWanted)
  {
    this->DrawWanted = false;
    this->draw();
  }
}

/// VTK's way draws once more after each change of the size, and copies with a filter, for which software OpenGL
/// compiles programs in each view.
void ViewWidget::paintGL()
{
  if (this->Resizing)
  {
    return;
  }
  auto* const window = vtkOpenGLRenderWindow::SafeDownCast(this->renderWindow());
  const auto isDrawn = [window]
  {
    vtkOpenGLFramebufferObject& drawn = *window->GetDisplayFramebuffer();
    return drawn.GetFBOIndex() != 0 && std::equal(drawn.GetLastSize(), drawn.GetLastSize() + 2, window->GetSize());
  };
  this->DrawWanted = this->DrawWanted || !isDrawn();
  this->drawWanted();
  this->makeCurrent();
  if (isDrawn())
  {
    window->GetState()->Reset(); // Qt has its own
    window->GetState()->Push();
    const int* const size = window->GetSize();
    window->BlitDisplayFramebuffer(0, 0, 0, size[0], size[1], 0, 0, size[0], size[1], GL_COLOR_BUFFER_BIT, GL_NEAREST);
    window->GetState()->Pop();
  }
}

void ViewWidget::placeCamera()
{
  vtkCamera* const camera = this->Renderer->GetActiveCamera();
  camera->SetPosition(this->Camera.eye().data());
  camera->SetFocalPoint(this->Camera.focus().data());
  camera->SetViewUp(this->Camera.up().data());
  camera->SetViewAngle(ViewCamera::angle());
  camera->SetParallelProjection(this->Camera.parallel());
  camera->SetParallelScale(this->Camera.height() / 2);
  this->drawSoon();
}

void ViewWidget::frameBox(const WorldBox& box)
{
  this->Camera.frame(box, double(std::max(this->width(), 1)) / std::max(this->height(), 1));
  this->placeCamera();
}

void ViewWidget::beginMotion(const QMouseEvent& event, Motion motion)
{
  this->Pressed = event.pos();
  this->Last = event.pos();
  this->Moved = false;
  this->Moving = motion;
}

bool ViewWidget::isMoving(const QMouseEvent& event) const
{
  return this->Moving != Motion::None &&
         (this->Moved || (event.pos() - this->Pressed).manhattanLength() >= QApplication::startDragDistance());
}

void ViewWidget::moveView(const QMouseEvent& event)
{
  const QPoint step = event.pos() - this->Last;
  this->Last = event.pos();
  this->Moved = true;
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

void ViewWidget::keyPressEvent(QKeyEvent* event)
{
  const int key = event->key();
  const int dx = key == Qt::Key_Left ? -1 : key == Qt::Key_Right ? 1 : 0;
  const int dy = key == Qt::Key_Up ? -1 : key == Qt::Key_Down ? 1 : 0;
  const int closer = key == Qt::Key_Plus || key == Qt::Key_Equal ? 1 : key == Qt::Key_Minus ? -1 : 0;
  if (closer != 0)
  {
    this->Camera.zoom(std::exp(zoomPerStep * closer));
  }
  else if (dx == 0 && dy == 0)
  {
    QVTKOpenGLNativeWidget::keyPressEvent(event);
    return;
  }
  else if (this->Camera.parallel() || event->modifiers() & Qt::ShiftModifier)
  {
    this->Camera.pan(panPerKey * dx, panPerKey * dy, this->height());
  }
  else
  {
    this->Camera.orbit(degreesPerKey * dx, degreesPerKey * dy);
  }
  this->placeCamera();
}

void ViewWidget::wheelEvent(QWheelEvent* event)
{
  event->accept();
  this->Camera.zoom(std::exp(zoomPerStep * event->angleDelta().y() / wheelStep));
  this->placeCamera();
}

void ViewWidget::resizeEvent(QResizeEvent* event)
{
  this->Resizing = true; // Qt paints at once, and again when all have their sizes
  QVTKOpenGLNativeWidget::resizeEvent(event);
  this->Resizing = false;
  this->drawSoon();
}

} // namespace dgtk
