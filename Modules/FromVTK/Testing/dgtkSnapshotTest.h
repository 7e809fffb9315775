// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSnapshotTest_h
#define dgtkSnapshotTest_h

#include "dgtkSnapshot.h"

#include <gtest/gtest.h>
#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkDataArray.h>
#include <vtkNew.h>
#include <vtkPlaneSource.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkRenderer.h>

#include <string>
#include <vector>

constexpr int side = 40; ///< pixels

/// The square [x, x + 1] x [y, y + 1] at z = 0, in cells x cells quads.
inline vtkSmartPointer<vtkPolyData> square(double x, double y, int cells = 1)
{
  vtkNew<vtkPlaneSource> plane;
  plane->SetOrigin(x, y, 0);
  plane->SetPoint1(x + 1, y, 0);
  plane->SetPoint2(x, y + 1, 0);
  plane->SetResolution(cells, cells);
  plane->Update();
  return plane->GetOutput();
}

/// A view along -z of [-2, 2] x [-2, 2], a tenth of a unit a pixel.
class Snapshots : public testing::Test
{
public:
  Snapshots()
  {
    vtkCamera* const camera = this->Renderer->GetActiveCamera();
    camera->ParallelProjectionOn();
    camera->SetParallelScale(2);
    camera->SetPosition(0, 0, 5);
    camera->SetFocalPoint(0, 0, 0);
  }

  vtkSmartPointer<vtkActor> add(vtkMapper* mapper)
  {
    auto actor = vtkSmartPointer<vtkActor>::New();
    actor->SetMapper(mapper);
    this->Renderer->AddActor(actor);
    return actor;
  }

  vtkSmartPointer<vtkActor> add(vtkPolyData* data)
  {
    vtkNew<vtkPolyDataMapper> mapper;
    mapper->SetInputData(data);
    return this->add(mapper.Get());
  }

  vtkSmartPointer<dgtkSnapshot> take()
  {
    auto shot = vtkSmartPointer<dgtkSnapshot>::New();
    EXPECT_TRUE(shot->Take(this->Renderer, side, side)) << shot->GetErrorMessage();
    EXPECT_TRUE(shot->CountCells()) << shot->GetErrorMessage();
    return shot;
  }

  void refuses(const std::string& words)
  {
    vtkNew<dgtkSnapshot> shot;
    EXPECT_FALSE(shot->Take(this->Renderer, side, side));
    EXPECT_NE(shot->GetErrorMessage().find(words), std::string::npos) << shot->GetErrorMessage();
  }

  static std::vector<double> counts(dgtkSnapshot& shot, int prop)
  {
    std::vector<double> all;
    vtkDataArray* const array = shot.CountPixels(prop);
    for (vtkIdType i = 0; array != nullptr && i < array->GetNumberOfTuples(); ++i)
    {
      all.push_back(array->GetComponent(i, 0));
    }
    return all;
  }

  vtkNew<vtkRenderer> Renderer;
};

#endif
