// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPointCloudSource.h"

#include "dgtkViewOutputs.h"

#include "vtkCellArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

vtkStandardNewMacro(dgtkPointCloudSource);

struct dgtkPointCloudSource::Internal
{
  dgtk::ViewRequest request;
};

namespace
{
/// The tuples of an array at some places.
vtkSmartPointer<vtkDataArray> chosen(vtkDataArray& from, const std::vector<vtkIdType>& places, const char* name)
{
  vtkSmartPointer<vtkDataArray> to = vtkSmartPointer<vtkDataArray>::Take(from.NewInstance());
  to->SetName(name);
  to->SetNumberOfComponents(from.GetNumberOfComponents());
  to->SetNumberOfTuples(vtkIdType(places.size()));
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    to->SetTuple(vtkIdType(i), places[i], &from);
  }
  return to;
}

/// From the axes of the camera to those of the world.
void turn(vtkDataArray& normals, dgtkSnapshot& shot)
{
  double R[9];
  shot.GetR(R);
  for (vtkIdType i = 0; i < normals.GetNumberOfTuples(); ++i)
  {
    double n[3];
    normals.GetTuple(i, n);
    for (int axis = 0; axis < 3; ++axis)
    {
      normals.SetComponent(i, axis, R[axis] * n[0] + R[3 + axis] * n[1] + R[6 + axis] * n[2]);
    }
  }
}
} // namespace

dgtkPointCloudSource::dgtkPointCloudSource()
  : Self(new Internal)
{
  this->SetNumberOfInputPorts(0);
  this->Self->request.layers = "position,normal,objects,color,cells";
}

dgtkPointCloudSource::~dgtkPointCloudSource() = default;

void dgtkPointCloudSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Size: " << this->Self->request.width << " x " << this->Self->request.height << "\n";
}

void dgtkPointCloudSource::SetRenderer(vtkRenderer* renderer)
{
  this->Self->request.renderer = renderer;
  this->Modified();
}

void dgtkPointCloudSource::SetSize(int width, int height)
{
  this->Self->request.width = width;
  this->Self->request.height = height;
  this->Modified();
}

void dgtkPointCloudSource::SetSkipUnsupported(bool skip)
{
  this->Self->request.skip = skip;
  this->Modified();
}

vtkMTimeType dgtkPointCloudSource::GetMTime()
{
  const vtkMTimeType own = this->Superclass::GetMTime();
  return this->Self->request.renderer ? std::max(own, dgtk::modifiedTime(*this->Self->request.renderer)) : own;
}

int dgtkPointCloudSource::RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  vtkPolyData* const cloud = vtkPolyData::GetData(outputs, 0);
  try
  {
    const dgtk::ViewOutputs found = dgtk::outputsOf(this->Self->request);
    vtkDataArray& objects = *found.find("objects");
    std::vector<vtkIdType> places;
    for (vtkIdType i = 0; i < objects.GetNumberOfTuples(); ++i)
    {
      if (objects.GetComponent(i, 0) != 0)
      {
        places.push_back(i);
      }
    }
    const auto count = vtkIdType(places.size());
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    points->SetData(chosen(*found.find("position"), places, "Points"));
    vtkNew<vtkCellArray> vertices;
    vtkNew<vtkDoubleArray> pixels;
    pixels->SetName("pixels");
    pixels->SetNumberOfComponents(2);
    pixels->SetNumberOfTuples(count);
    for (vtkIdType i = 0; i < count; ++i)
    {
      vertices->InsertNextCell(1, &i);
      const vtkIdType place = places[std::size_t(i)];
      pixels->SetTuple2(i, double(place % found.width) + 0.5, double(place / found.width) + 0.5);
    }
    const vtkSmartPointer<vtkDataArray> normals = chosen(*found.find("normal"), places, "Normals");
    turn(*normals, *found.shot);
    cloud->SetPoints(points);
    cloud->SetVerts(vertices);
    cloud->GetPointData()->SetNormals(normals);
    cloud->GetPointData()->SetScalars(chosen(*found.find("color"), places, "Colors"));
    cloud->GetPointData()->AddArray(chosen(objects, places, "objects"));
    cloud->GetPointData()->AddArray(chosen(*found.find("cells"), places, "cells"));
    cloud->GetPointData()->AddArray(pixels);
    return 1;
  }
  catch (const std::exception& error)
  {
    cloud->Initialize();
    vtkErrorMacro(<< error.what());
    return 0;
  }
}
