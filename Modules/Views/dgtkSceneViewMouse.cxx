// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneView.h"

#include "dgtkViewOverlay.h"

#include <QContextMenuEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QWheelEvent>

#include <algorithm>

namespace dgtk
{

namespace
{
bool isDragKey(int key) { return key == Qt::Key_X || key == Qt::Key_Y || key == Qt::Key_Z || key == Qt::Key_Escape; }
} // namespace

SceneView::Motion SceneView::motionFor(const QMouseEvent& event)
{
  if (event.button() == Qt::MiddleButton || (event.button() == Qt::LeftButton && event.modifiers() & Qt::ShiftModifier))
  {
    return Motion::Pan;
  }
  if (event.button() != Qt::LeftButton)
  {
    return event.button() == Qt::RightButton ? Motion::Zoom : Motion::None;
  }
  this->Grasped.handle = this->handleAt(event.pos());
  this->Grasped.pressed = event.pos();
  if (this->Grasped.handle)
  {
    return Motion::Drag;
  }
  const std::optional<SceneItem> item = this->Rays ? std::nullopt : this->itemAt(event.pos());
  if (item && std::find(this->Selected.begin(), this->Selected.end(), *item) != this->Selected.end())
  {
    this->Grasped.point = this->Places->boxOf(*item).center();
    return Motion::Drag;
  }
  return this->Camera.parallel() ? Motion::Pan : Motion::Orbit;
}

std::optional<Handle> SceneView::handleAt(const QPoint& position) const
{
  if (!this->Handles || this->Rays)
  {
    return std::nullopt;
  }
  return ViewHandles(*this->Handles, this->Camera, this->width(), this->height())
    .hit(Eigen::Vector2d(position.x(), position.y()));
}

void SceneView::mousePressEvent(QMouseEvent* event)
{
  if (this->Holds)
  {
    return; // another button during a drag
  }
  emit this->activated();
  this->beginMotion(*event, this->motionFor(*event));
}

void SceneView::mouseMoveEvent(QMouseEvent* event)
{
  if (this->Moving == Motion::None)
  {
    this->Overlay->highlight(event->buttons() == Qt::NoButton ? this->handleAt(event->pos()) : std::nullopt);
    return;
  }
  if (!this->isMoving(*event))
  {
    return;
  }
  if (this->Moving != Motion::Drag)
  {
    this->moveView(*event);
    return;
  }
  if (!this->Moved)
  {
    this->Holds = true;
    emit this->dragStarted();
  }
  this->Moved = true;
  this->Last = event->pos();
  emit this->dragged(event->localPos(), event->modifiers() & Qt::ControlModifier);
}

void SceneView::endDrag()
{
  this->Holds = false;
  this->Moving = Motion::None;
  this->Overlay->highlight(std::nullopt);
  this->Overlay->showText({}, {});
}

void SceneView::mouseReleaseEvent(QMouseEvent* event)
{
  if (this->Holds)
  {
    if (event->button() == Qt::LeftButton)
    {
      this->endDrag();
      emit this->dragFinished();
    }
    return;
  }
  this->Moving = Motion::None;
  if (this->Moved)
  {
    this->drawSoon(); // all of it, after a coarse motion
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

bool SceneView::event(QEvent* event)
{
  if (event->type() == QEvent::ShortcutOverride && this->Holds)
  {
    // During a drag these keys are its own, not the window's.
    const auto* key = static_cast<QKeyEvent*>(event);
    if (isDragKey(key->key()))
    {
      event->accept();
      return true;
    }
  }
  return ViewWidget::event(event);
}

void SceneView::keyPressEvent(QKeyEvent* event)
{
  if (!this->Holds)
  {
    ViewWidget::keyPressEvent(event);
    return;
  }
  if (!isDragKey(event->key()))
  {
    QWidget::keyPressEvent(event); // NOLINT(bugprone-parent-virtual-call): the view's own keys wait for the drag's end
    return;
  }
  if (event->key() == Qt::Key_Escape)
  {
    this->endDrag();
    this->Moved = true; // the release that follows selects nothing
    emit this->dragCancelled();
  }
  else
  {
    emit this->constrained(event->key() - Qt::Key_X, event->modifiers() & Qt::ShiftModifier);
  }
}

void SceneView::focusInEvent(QFocusEvent* event)
{
  ViewWidget::focusInEvent(event);
  emit this->activated();
}

/// The menu key; the mouse's menu comes with its release.
void SceneView::contextMenuEvent(QContextMenuEvent* event)
{
  if (event->reason() == QContextMenuEvent::Keyboard && !this->Holds)
  {
    emit this->menuAsked(this->mapToGlobal(this->rect().center()));
  }
  event->accept();
}

void SceneView::setActive(bool on) { this->Overlay->showFrame(on); }

void SceneView::leaveEvent(QEvent* event)
{
  if (!this->Holds)
  {
    this->Overlay->highlight(std::nullopt);
  }
  ViewWidget::leaveEvent(event);
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
  event->accept();
  if (!this->Holds)
  {
    ViewWidget::wheelEvent(event);
  }
}

} // namespace dgtk
