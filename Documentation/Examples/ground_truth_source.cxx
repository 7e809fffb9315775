// SPDX-License-Identifier: BSD-3-Clause
// Exact depth and object ids of a renderer in a VTK pipeline: the largest depth of each object, without a window.
#include <dgtkGroundTruthSource.h>
#include <vtkActor.h>
#include <vtkConeSource.h>
#include <vtkDataArray.h>
#include <vtkImageData.h>
#include <vtkImageThreshold.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>
#include <vtkSphereSource.h>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <map>

int main()
{
  vtkNew<vtkSphereSource> sphere;
  vtkNew<vtkConeSource> cone;
  cone->SetCenter(1.2, 0, -0.5);
  vtkNew<vtkRenderer> renderer;
  for (vtkAlgorithm* source : { static_cast<vtkAlgorithm*>(sphere), static_cast<vtkAlgorithm*>(cone) })
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputConnection(source->GetOutputPort());
    vtkNew<vtkActor> actor;
    actor->SetMapper(mapper);
    renderer->AddActor(actor);
  }

  vtkNew<dgtkGroundTruthSource> truth;
  truth->SetRenderer(renderer);
  truth->SetLayers("depth,objects");
  truth->SetSize(160, 120);
  vtkNew<vtkImageThreshold> near; // any filter of images: 1 where something is nearer than 4
  near->SetInputConnection(truth->GetOutputPort());
  near->ThresholdByLower(4);
  near->SetInValue(1);
  near->SetOutValue(0);
  near->SetOutputScalarTypeToUnsignedChar();
  near->Update();

  vtkPointData* const arrays = truth->GetOutput()->GetPointData();
  std::map<int, double> farthest;
  for (vtkIdType i = 0; i < arrays->GetScalars()->GetNumberOfTuples(); ++i)
  {
    const int object = int(arrays->GetArray("objects")->GetComponent(i, 0));
    double& far = farthest[object];
    far = std::max(far, arrays->GetArray("depth")->GetComponent(i, 0));
  }
  for (const auto& [object, depth] : farthest)
  {
    std::cout << (object == 0 ? "background" : "object " + std::to_string(object)) << ": " << depth << '\n';
  }
  const bool right = farthest.size() == 3 && farthest[1] < farthest[2] && farthest[2] < farthest[0];
  return right ? EXIT_SUCCESS : EXIT_FAILURE;
}
