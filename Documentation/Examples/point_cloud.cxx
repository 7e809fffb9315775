// SPDX-License-Identifier: BSD-3-Clause
// What a renderer shows as points with normals: all of them lie on the sphere that is shown.
#include <dgtkPointCloudSource.h>
#include <vtkActor.h>
#include <vtkDataArray.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>

int main()
{
  vtkNew<vtkSphereSource> sphere; // of radius 0.5 about the origin
  sphere->SetThetaResolution(60);
  sphere->SetPhiResolution(60);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(sphere->GetOutputPort());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);

  vtkNew<dgtkPointCloudSource> points;
  points->SetRenderer(renderer);
  points->SetSize(200, 200);
  points->Update();
  vtkPolyData* const cloud = points->GetOutput();
  double away = 0;
  double turned = 1;
  for (vtkIdType i = 0; i < cloud->GetNumberOfPoints(); ++i)
  {
    double point[3];
    double normal[3];
    cloud->GetPoint(i, point);
    cloud->GetPointData()->GetNormals()->GetTuple(i, normal);
    const double radius = vtkMath::Norm(point);
    away = std::max(away, std::abs(radius - 0.5));
    turned = std::min(turned, vtkMath::Dot(point, normal) / radius);
  }
  std::cout << cloud->GetNumberOfPoints() << " points, at most " << away << " from the sphere, normals within "
            << std::acos(turned) << " of its own\n";
  return cloud->GetNumberOfPoints() > 9000 && away < 0.002 && turned > 0.99 ? EXIT_SUCCESS : EXIT_FAILURE;
}
