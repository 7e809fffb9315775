// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneView.h"

#include "dgtkDraftLabel.h"
#include "dgtkViewOverlay.h"

#include <QElapsedTimer>
#include <QLabel>
#include <QTimer>

#include <vtkCamera.h>
#include <vtkCullerCollection.h>
#include <vtkFrustumCoverageCuller.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include <algorithm>
#include <utility>

namespace dgtk
{

namespace
{
constexpr double pickPixels = 8;          // around cameras and lights
constexpr PickReach objectsOnly{ -1, 0 }; // a camera's picture shows no cameras and lights
constexpr double spareDepth = 0.05;       // before the nearest, of the depth of everything
constexpr double slowSeconds = 0.1;       // of a drawing; slower ones are replaced by boxes while the mouse moves
const Eigen::Vector3d topColor(0.20, 0.21, 0.23);
const Eigen::Vector3d bottomColor(0.30, 0.31, 0.33);
} // namespace

SceneView::SceneView(ViewKind kind, QWidget* parent)
  : ViewWidget(kind, topColor, bottomColor, parent)
  , Overlay(new ViewOverlay(this))
  , Draft(makeDraftLabel(this))
{
  this->Actors = std::make_unique<ViewActors>(this->Renderer, kind);
  // What is hidden need not be shaded: without a graphics card that is most of the work.
  vtkNew<vtkFrustumCoverageCuller> culler;
  culler->SetSortingStyleToFrontToBack();
  this->Renderer->GetCullers()->RemoveAllItems();
  this->Renderer->AddCuller(culler);
  this->setMouseTracking(true);
  this->setMinimumSize(120, 90);
  this->Camera.frame({}, 1);
  this->SceneView::placeCamera();
}

SceneView::~SceneView() = default;

void SceneView::placeCamera()
{
  ViewWidget::placeCamera();
  emit this->cameraMoved();
  this->placeOverlay();
}

void SceneView::showHandles(const std::optional<HandlePlace>& place)
{
  this->Handles = place;
  this->Overlay->raise(); // also above a picture that covers the view
  this->placeOverlay();
}

void SceneView::placeOverlay()
{
  std::vector<HandleShape> shapes;
  if (this->Handles)
  {
    shapes = ViewHandles(*this->Handles, this->Camera, this->width(), this->height()).shapes();
  }
  this->Overlay->showHandles(std::move(shapes));
  std::vector<QLineF> lines;
  for (const auto& [from, to] : this->Chosen)
  {
    if (const auto seen = this->Camera.segment(from, to, this->width(), this->height()))
    {
      lines.emplace_back(seen->first.x(), seen->first.y(), seen->second.x(), seen->second.y());
    }
  }
  this->Overlay->showLines(std::move(lines));
}

void SceneView::showDrag(const Handle& handle, const QString& text)
{
  this->Overlay->highlight(handle);
  this->Overlay->showText(text, this->Last);
}

int SceneView::actors() const { return this->Actors->actors(); }

int SceneView::coarserMeshes() const { return this->Actors->coarserMeshes(); }

void SceneView::setCovered(bool on)
{
  this->Covered = on;
  this->drawSoon();
}

void SceneView::setPictureRays(const PictureRays& rays)
{
  this->Rays = rays;
  this->Overlay->setVisible(!rays);
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
    this->Actors->chooseDetail(this->Camera, this->width(), this->height(), this->Rate.mostTriangles());
  }
  QElapsedTimer clock;
  clock.start();
  this->Actors->aim(this->Camera);
  this->stepBack();
  this->Renderer->ResetCameraClippingRange();
  this->renderWindow()->Render();
  this->renderWindow()->WaitForCompletion();
  if (!coarse)
  {
    this->FineSeconds = clock.nsecsElapsed() * 1e-9;
    if (!this->Actors->takeFresh())
    {
      this->Rate.add(this->Actors->triangles(), this->FineSeconds);
    }
  }
}

/// A parallel view has everything before it, but VTK clips what is behind the eye.
void SceneView::stepBack()
{
  double bounds[6];
  this->Renderer->ComputeVisiblePropBounds(bounds);
  if (!this->Camera.parallel() || vtkMath::AreBoundsInitialized(bounds) == 0)
  {
    return;
  }
  const Eigen::Vector3d forward = this->Camera.forward();
  double nearest = 0; // along the view, from the focus
  double farthest = 0;
  for (int corner = 0; corner < 8; ++corner)
  {
    const Eigen::Vector3d point(bounds[corner & 1], bounds[2 + (corner >> 1 & 1)], bounds[4 + (corner >> 2 & 1)]);
    const double along = (point - this->Camera.focus()).dot(forward);
    nearest = std::min(nearest, along);
    farthest = std::max(farthest, along);
  }
  // The nearest that VTK draws is a hundredth of the farthest.
  const double distance = this->Camera.height() + spareDepth * (farthest - nearest) - nearest;
  const Eigen::Vector3d eye = this->Camera.focus() - distance * forward;
  this->Renderer->GetActiveCamera()->SetPosition(eye.data());
}

void SceneView::resetCamera(UpAxis upAxis) { this->Camera = ViewCamera(this->kind(), upAxis); }

void SceneView::frame(const WorldBox& box)
{
  this->FrameWanted = this->isVisible() ? std::nullopt : std::optional(box);
  this->frameBox(box);
}

void SceneView::showEvent(QShowEvent* event)
{
  ViewWidget::showEvent(event);
  QTimer::singleShot(0, this,
    [this]
    {
      if (this->FrameWanted && this->isVisible())
      {
        this->frame(WorldBox(*this->FrameWanted));
      }
    });
}

bool SceneView::lookThrough(const CameraDescription& camera, double frame)
{
  Eigen::Vector3d eye = camera.eye.at(frame);
  Eigen::Vector3d focus = camera.lookAt.at(frame);
  Eigen::Vector3d up = camera.up.at(frame);
  if (camera.posed)
  {
    eye = camera.position.at(frame);
    const double distance = std::max(1.0, (this->Camera.focus() - eye).norm());
    const Eigen::Matrix3d axes = camera.orientation.at(frame).matrix();
    focus = eye + distance * axes.col(2);
    up = -axes.col(1);
  }
  if (!this->Camera.look(eye, focus, up))
  {
    return false;
  }
  this->FrameWanted.reset();
  this->placeCamera();
  return true;
}

void SceneView::showScene(const SceneDescription& scene, const std::shared_ptr<const ScenePlaces>& places,
  const std::shared_ptr<const EnvironmentLight>& environment, ViewMeshes& meshes)
{
  this->Places = places;
  this->Actors->show(scene, *places, environment, meshes);
  this->drawSoon();
}

void SceneView::showSelected(const SceneItems& selected)
{
  this->Selected = selected;
  this->Chosen = selectionLines(*this->Places, selected);
  this->placeOverlay();
}

void SceneView::showDraft(bool on)
{
  this->Draft->setVisible(on);
  this->Draft->raise(); // also above a picture that covers the view
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
  if (this->Rays)
  {
    const std::optional<WorldRay> ray = this->Rays(position);
    return ray ? pickItem(*this->Places, *ray, objectsOnly) : std::nullopt;
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

void SceneView::resizeEvent(QResizeEvent* event)
{
  ViewWidget::resizeEvent(event);
  this->Overlay->setGeometry(this->rect());
  this->placeOverlay();
}

} // namespace dgtk
