// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkCloudView.h"

#include <QMouseEvent>

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr double pickPixels = 12;
constexpr double frustumShare = 0.07; // of the diagonal of everything
constexpr double markerShare = 0.015;
constexpr double axisShare = 0.05;
constexpr double smallestExtent = 1e-3;
constexpr double fromAbove = 0.5; // part of the way forward
constexpr double fromAside = -0.45;
constexpr double outlying = 0.03; // part of the points that may be out of sight on either side
constexpr std::size_t mostSorted = 20000;
constexpr float pointSize = 2;
const Eigen::Vector3d cameraColor(0.85, 0.65, 0.25);
const Eigen::Vector3d chosenColor(0.2, 1.0, 0.2);
const Eigen::Vector3d markerColor(1.0, 0.2, 0.9);
const Eigen::Vector3d topColor(0.11, 0.11, 0.12);
const Eigen::Vector3d bottomColor(0.20, 0.21, 0.23);
} // namespace

CloudView::CloudView(QWidget* parent)
  : ViewWidget(ViewKind::Perspective, topColor, bottomColor, parent)
  , Points(vtkSmartPointer<vtkPolyData>::New())
  , PointActor(vtkSmartPointer<vtkActor>::New())
{
  this->setObjectName("cloudView");
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(this->Points);
  this->PointActor->SetMapper(mapper);
  this->PointActor->GetProperty()->SetLighting(false);
  this->PointActor->GetProperty()->SetPointSize(pointSize);
  this->PointActor->VisibilityOff();
  this->Renderer->AddActor(this->PointActor);
  this->Frusta = std::make_unique<LineActor>(this->Renderer, cameraColor, 1.5f);
  this->Chosen = std::make_unique<LineActor>(this->Renderer, chosenColor, 2.5f);
  this->Marker = std::make_unique<LineActor>(this->Renderer, markerColor, 2.0f);
  for (int axis = 0; axis < 3; ++axis)
  {
    const Eigen::Vector3d color = 0.25 * Eigen::Vector3d::Ones() + 0.65 * Eigen::Vector3d::Unit(axis);
    this->Axes[axis] = std::make_unique<LineActor>(this->Renderer, color, 2.0f);
  }
  this->setMinimumSize(160, 120);
  this->placeCamera();
}

CloudView::~CloudView() = default;

void CloudView::reset(UpAxis upAxis)
{
  this->Camera = ViewCamera(ViewKind::Perspective, upAxis);
  this->Places.clear();
  this->MarkerPoint.reset();
  this->setCloud(nullptr);
}

void CloudView::draw()
{
  if (this->isVisible())
  {
    this->Renderer->ResetCameraClippingRange();
    this->renderWindow()->Render();
  }
}

WorldBox CloudView::box() const
{
  WorldBox box = this->CloudBox;
  for (const CameraPlace& place : this->Places)
  {
    box.add(place.center);
  }
  return box;
}

void CloudView::setCameras(const std::vector<View>& views, const std::string& chosen)
{
  this->Places.clear();
  for (const View& view : views)
  {
    CameraPlace place;
    place.valid = true;
    place.view = view;
    place.center = view.camera_from_world.inverse().translation;
    this->Places.push_back(place);
  }
  this->ChosenName = chosen;
  this->refreshLines();
}

void CloudView::refreshLines()
{
  const double extent = std::max(this->box().diagonal(), smallestExtent);
  LineList frusta;
  LineList chosen;
  for (const CameraPlace& place : this->Places)
  {
    addFrustum(place.view.name == this->ChosenName ? chosen : frusta, place, frustumShare * extent);
  }
  this->Frusta->set(frusta);
  this->Chosen->set(chosen);
  LineList cross;
  for (int axis = 0; axis < 3; ++axis)
  {
    const Eigen::Vector3d direction = Eigen::Vector3d::Unit(axis);
    this->Axes[axis]->set({ { Eigen::Vector3d::Zero(), axisShare * extent * direction } });
    if (this->MarkerPoint)
    {
      const Eigen::Vector3d arm = markerShare * extent * direction;
      cross.emplace_back(*this->MarkerPoint - arm, *this->MarkerPoint + arm);
    }
  }
  this->Marker->set(cross);
  this->drawSoon();
}

/// Of most of the points: a few of them far away do not make the rest small.
WorldBox CloudView::middleOf(const std::vector<Eigen::Vector3d>& points)
{
  WorldBox box;
  const std::size_t every = std::max<std::size_t>(1, points.size() / mostSorted);
  std::vector<double> values;
  for (int axis = 0; axis < 3 && !points.empty(); ++axis)
  {
    values.clear();
    for (std::size_t i = 0; i < points.size(); i += every)
    {
      values.push_back(points[i][axis]);
    }
    std::sort(values.begin(), values.end());
    const auto cut = static_cast<std::size_t>(outlying * double(values.size()));
    box.min[axis] = values[cut];
    box.max[axis] = values[values.size() - 1 - cut];
  }
  return box;
}

void CloudView::setCloud(const std::shared_ptr<const PointCloud>& cloud)
{
  this->Cloud = cloud;
  this->CloudBox = cloud ? middleOf(cloud->points) : WorldBox();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetNumberOfComponents(3);
  vtkNew<vtkCellArray> cells;
  const vtkIdType count = static_cast<vtkIdType>(this->pointCount());
  points->SetNumberOfPoints(count);
  colors->SetNumberOfTuples(count);
  std::vector<vtkIdType> ids(static_cast<std::size_t>(count));
  for (vtkIdType i = 0; i < count; ++i)
  {
    const std::size_t at = static_cast<std::size_t>(i);
    points->SetPoint(i, cloud->points[at].data());
    colors->SetTypedTuple(i, cloud->colors[at].data());
    ids[at] = i;
  }
  if (count > 0)
  {
    cells->InsertNextCell(count, ids.data());
  }
  this->Points->SetPoints(points);
  this->Points->SetVerts(cells);
  this->Points->GetPointData()->SetScalars(colors);
  this->PointActor->SetVisibility(count > 0);
  this->refreshLines();
}

void CloudView::setMarker(const std::optional<Eigen::Vector3d>& point)
{
  if (point != this->MarkerPoint)
  {
    this->MarkerPoint = point;
    this->refreshLines();
  }
}

void CloudView::frameFrom(const std::string& name)
{
  for (const CameraPlace& place : this->Places)
  {
    if (place.view.name == name)
    {
      const Eigen::Matrix3d& axes = place.view.camera_from_world.rotation;
      const Eigen::Vector3d way = (axes.row(2) + fromAbove * axes.row(1) + fromAside * axes.row(0)).transpose();
      const Eigen::Vector3d focus = this->box().center();
      this->Camera.look(focus - way, focus);
    }
  }
  this->frameAll();
}

void CloudView::frameAll() { this->frameBox(this->box()); }

void CloudView::lookThrough(const std::string& name)
{
  for (const CameraPlace& place : this->Places)
  {
    if (place.view.name == name)
    {
      const Eigen::Vector3d forward = place.view.camera_from_world.rotation.row(2).transpose();
      const double distance =
        this->CloudBox.empty() ? 1.0 : std::max((this->CloudBox.center() - place.center).dot(forward), smallestExtent);
      const Eigen::Vector3d up = -place.view.camera_from_world.rotation.row(1).transpose();
      this->Camera.look(place.center, place.center + distance * forward, up);
      this->placeCamera();
    }
  }
}

void CloudView::mousePressEvent(QMouseEvent* event)
{
  const bool shifted = event->modifiers() & Qt::ShiftModifier;
  const bool pans = event->button() == Qt::MiddleButton || (event->button() == Qt::LeftButton && shifted);
  this->beginMotion(*event, pans ? Motion::Pan : event->button() == Qt::RightButton ? Motion::Zoom : Motion::Orbit);
}

void CloudView::mouseMoveEvent(QMouseEvent* event)
{
  if (this->isMoving(*event))
  {
    this->moveView(*event);
  }
}

void CloudView::mouseReleaseEvent(QMouseEvent* event)
{
  this->Moving = Motion::None;
  if (!this->Moved && event->button() == Qt::LeftButton)
  {
    this->pick(event->pos());
  }
}

void CloudView::pick(const QPoint& at)
{
  const WorldRay ray = this->Camera.ray(at.x() + 0.5, at.y() + 0.5, this->width(), this->height());
  const double reach = this->Camera.reach(pickPixels, this->height()).slope;
  double nearest = -1;
  std::string name;
  for (const CameraPlace& place : this->Places)
  {
    const Eigen::Vector3d way = place.center - ray.origin;
    const double along = way.dot(ray.direction) / ray.direction.squaredNorm();
    const double aside = (way - along * ray.direction).norm();
    if (along > 0 && aside <= reach * along && (nearest < 0 || along < nearest))
    {
      nearest = along;
      name = place.view.name;
    }
  }
  if (!name.empty())
  {
    emit this->cameraPicked(QString::fromStdString(name));
  }
}

} // namespace dgtk
