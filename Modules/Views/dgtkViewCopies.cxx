// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkViewCopies.h"

#include "dgtkViewLights.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <vtkActor.h>
#include <vtkDoubleArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkShaderProperty.h>
#include <vtkUnsignedCharArray.h>

#include <cmath>

namespace dgtk
{

namespace
{
constexpr double leastScale = 1e-12;
constexpr double mostShear = 1e-6; // cosine between axes: no pixel shows it
} // namespace

std::optional<ViewCopies::Place> ViewCopies::placeOf(const Affine3& world_from_object)
{
  Place place;
  place.position = world_from_object.translation;
  place.scale = world_from_object.linear.colwise().norm();
  if (!(place.scale.minCoeff() > leastScale))
  {
    return std::nullopt;
  }
  Eigen::Matrix3d axes = world_from_object.linear * place.scale.cwiseInverse().asDiagonal();
  if (axes.determinant() < 0)
  {
    axes.col(2) *= -1;
    place.scale.z() *= -1;
  }
  if (!((axes.transpose() * axes - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() < mostShear))
  {
    return std::nullopt;
  }
  const Eigen::Quaterniond rotation(axes);
  place.rotation = Eigen::Vector4d(rotation.w(), rotation.x(), rotation.y(), rotation.z());
  return place;
}

ViewCopies::ViewCopies(vtkRenderer* renderer, vtkPolyData* part, vtkProperty* property, ViewLights& lights)
  : Renderer(renderer)
  , Lights(lights)
  , Shading(lights.makeShading(true))
{
  this->Points->SetDataTypeToDouble();
  this->Data->SetPoints(this->Points);
  this->Rotations->SetName("rotation");
  this->Rotations->SetNumberOfComponents(4);
  this->Data->GetPointData()->AddArray(this->Rotations);
  this->Scales->SetName("scale");
  this->Scales->SetNumberOfComponents(3);
  this->Data->GetPointData()->AddArray(this->Scales);
  this->Colors->SetNumberOfComponents(4);
  this->Data->GetPointData()->SetScalars(this->Colors);
  this->Mapper->SetInputData(this->Data);
  this->Mapper->SetSourceData(part);
  this->Mapper->SetOrientationModeToQuaternion();
  this->Mapper->SetOrientationArray("rotation");
  this->Mapper->SetScaleModeToScaleByVectorComponents();
  this->Mapper->SetScaleArray("scale");
  this->Mapper->SetScalarModeToUsePointData();
  this->Mapper->SetColorModeToDirectScalars();
  this->Mapper->StaticOn();
  this->Actor->SetMapper(this->Mapper);
  this->Actor->SetProperty(property);
  ViewLights::setGlow(*this->Shading, *property);
  this->Actor->SetShaderProperty(this->Shading);
  this->Actor->ForceOpaqueOn();
  this->Actor->VisibilityOff();
  renderer->AddActor(this->Actor);
}

ViewCopies::~ViewCopies()
{
  this->Lights.forget(this->Shading);
  this->Renderer->RemoveActor(this->Actor);
}

void ViewCopies::hide() { this->Actor->VisibilityOff(); }

void ViewCopies::show(const std::vector<Place>& places)
{
  this->Actor->SetVisibility(!places.empty());
  if (places.empty() || places == this->Shown)
  {
    return;
  }
  this->Shown = places;
  // Numbers on the graphics card have single precision: they are kept small.
  const Eigen::Vector3d origin = places.front().position;
  const auto count = static_cast<vtkIdType>(places.size());
  this->Points->SetNumberOfPoints(count);
  this->Rotations->SetNumberOfTuples(count);
  this->Scales->SetNumberOfTuples(count);
  this->Colors->SetNumberOfTuples(count);
  double color[3];
  this->Actor->GetProperty()->GetDiffuseColor(color);
  for (int channel = 0; channel < 4; ++channel)
  {
    this->Colors->FillComponent(channel, channel < 3 ? std::round(255 * color[channel]) : 255);
  }
  for (vtkIdType i = 0; i < count; ++i)
  {
    const Place& place = places[std::size_t(i)];
    const Eigen::Vector3d position = place.position - origin;
    this->Points->SetPoint(i, position.data());
    this->Rotations->SetTypedTuple(i, place.rotation.data());
    this->Scales->SetTypedTuple(i, place.scale.data());
  }
  this->Points->Modified();
  this->Rotations->Modified();
  this->Scales->Modified();
  this->Colors->Modified();
  this->Data->Modified();
  this->Actor->SetPosition(origin.x(), origin.y(), origin.z());
}

} // namespace dgtk
