// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLineActor.h"

#include <vtkActor.h>
#include <vtkCellArray.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>

namespace dgtk
{

LineActor::LineActor(vtkRenderer* renderer, const Eigen::Vector3d& color, double width)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(this->Data);
  this->Actor->SetMapper(mapper);
  this->Actor->GetProperty()->SetLighting(false);
  this->Actor->GetProperty()->SetColor(color.x(), color.y(), color.z());
  this->Actor->GetProperty()->SetLineWidth(static_cast<float>(width));
  renderer->AddActor(this->Actor);
  this->set({});
}

LineActor::~LineActor() = default;

void LineActor::set(const LineList& lines)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> cells;
  for (const auto& [from, to] : lines)
  {
    const vtkIdType ends[2] = { points->InsertNextPoint(from.data()), points->InsertNextPoint(to.data()) };
    cells->InsertNextCell(2, ends);
  }
  this->Data->SetPoints(points);
  this->Data->SetLines(cells);
  this->Data->Modified();
  this->Filled = !lines.empty();
  this->Actor->SetVisibility(this->Filled);
}

void LineActor::show(bool on) { this->Actor->SetVisibility(on && this->Filled); }

} // namespace dgtk
