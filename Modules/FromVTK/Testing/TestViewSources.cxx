// SPDX-License-Identifier: BSD-3-Clause
// Sources of pipelines, and settings of VTK that a view cannot honour.
#include "dgtkSnapshotTest.h"

#include "dgtkGroundTruthSource.h"

#include <vtkCallbackCommand.h>
#include <vtkExecutive.h>
#include <vtkFollower.h>
#include <vtkImageData.h>
#include <vtkInformation.h>
#include <vtkInformationDoubleVectorKey.h>
#include <vtkLight.h>
#include <vtkLookupTable.h>
#include <vtkMapper.h>
#include <vtkMatrix4x4.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkTexture.h>
#include <vtkTransform.h>

#include <vector>

namespace
{
/// Of a view's ground truth.
class Sources : public Snapshots
{
public:
  Sources()
  {
    this->Source->SetRenderer(this->Renderer);
    this->Source->SetSize(side, side);
    this->Told->SetClientData(&this->Errors);
    this->Told->SetCallback([](vtkObject*, unsigned long, void* errors, void* text)
      { static_cast<std::vector<std::string>*>(errors)->emplace_back(static_cast<const char*>(text)); });
    this->Source->AddObserver(vtkCommand::ErrorEvent, this->Told);
    this->Source->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->Told);
  }

  vtkNew<dgtkGroundTruthSource> Source;
  std::vector<std::string> Errors;

private:
  vtkNew<vtkCallbackCommand> Told;
};

TEST_F(Sources, WantALayer)
{
  this->add(square(0, 0));
  this->Source->SetLayers("");
  this->Source->Update();
  ASSERT_FALSE(this->Errors.empty());
  EXPECT_NE(this->Errors.front().find("no layers are set"), std::string::npos) << this->Errors.front();
}

TEST_F(Sources, GiveCellsThatAreAskedForTwice)
{
  this->add(square(0, 0));
  this->Source->SetLayers("cells,depth,cells");
  this->Source->Update();
  EXPECT_TRUE(this->Errors.empty()) << this->Errors.front();
  vtkPointData& data = *this->Source->GetOutput()->GetPointData();
  ASSERT_EQ(data.GetNumberOfArrays(), 2);
  EXPECT_STREQ(data.GetScalars()->GetName(), "cells");
  EXPECT_NE(data.GetArray("depth"), nullptr);
}

TEST_F(Sources, AreOlderThanWhatOthersHold)
{
  vtkCamera& camera = *this->Renderer->GetActiveCamera();
  vtkNew<vtkTransform> lens;
  camera.SetUserTransform(lens);
  vtkNew<vtkMatrix4x4> model;
  camera.SetModelTransformMatrix(model);
  vtkNew<vtkMatrix4x4> projection;
  camera.SetExplicitProjectionTransformMatrix(projection);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(square(0, 0));
  vtkNew<vtkCamera> faced;
  vtkNew<vtkFollower> follower;
  follower->SetMapper(mapper);
  follower->SetCamera(faced);
  this->Renderer->AddActor(follower);
  vtkNew<vtkLookupTable> table;
  vtkNew<vtkTexture> texture;
  texture->SetLookupTable(table);
  follower->SetTexture(texture);
  vtkNew<vtkMatrix4x4> turned;
  vtkNew<vtkLight> light;
  light->SetTransformMatrix(turned);
  this->Renderer->AddLight(light);
  this->Source->GetMTime(); // which brings inputs up to date
  for (vtkObject* const one : std::vector<vtkObject*>{ lens, model, projection, faced, table, turned })
  {
    const vtkMTimeType before = this->Source->GetMTime();
    EXPECT_EQ(this->Source->GetMTime(), before);
    one->Modified();
    EXPECT_GT(this->Source->GetMTime(), before) << one->GetClassName();
  }
}

TEST_F(Snapshots, NameEachActorThatCannotBeHonoured)
{
  const auto first = this->add(square(-1, 0));
  const auto second = this->add(first->GetMapper());
  second->SetProperty(first->GetProperty());
  this->add(square(0, 0));
  first->GetProperty()->EdgeVisibilityOn();
  this->refuses("honoured: actor-1: visible edges, actor-2: visible edges");
}

TEST_F(Snapshots, RefuseChangesOfTextureCoordinates)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(1, 1, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  texture->UseSRGBColorSpaceOn();
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(square(0, 0));
  const auto actor = this->add(mapper.Get());
  for (const bool physical : { false, true })
  {
    physical ? actor->GetProperty()->SetInterpolationToPBR() : actor->GetProperty()->SetInterpolationToGouraud();
    mapper->SeamlessUOn();
    this->take(); // there is no texture
    physical ? actor->GetProperty()->SetBaseColorTexture(texture) : actor->SetTexture(texture);
    this->refuses("actor-1: seamless texture coordinates");
    mapper->SeamlessUOff();
    this->take();
    mapper->SeamlessVOn();
    this->refuses("actor-1: seamless texture coordinates");
    mapper->SeamlessVOff();
    vtkNew<vtkInformation> keys;
    actor->SetPropertyKeys(keys);
    this->take();
    const double twice[16] = { 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1 };
    keys->Set(vtkProp::GeneralTextureTransform(), twice, 16);
    this->refuses("actor-1: a transform of texture coordinates among its property keys");
    actor->SetPropertyKeys(nullptr);
    actor->SetTexture(nullptr);
  }
}

TEST_F(Snapshots, RefuseARendererThatDoesNotDraw)
{
  this->add(square(0, 0));
  this->Renderer->DrawOff();
  this->refuses("a renderer that does not draw");
}

/// Which VTK has where coincident topology is resolved by offsets.
TEST_F(Snapshots, RefuseARelativeOffsetThatCounts)
{
  this->add(square(0, 0));
  const auto near = this->add(square(0, 0));
  for (const auto& [factor, units] : { std::pair(-2.0, 0.0), std::pair(0.0, -2.0) })
  {
    near->GetMapper()->SetRelativeCoincidentTopologyPolygonOffsetParameters(factor, units);
    EXPECT_EQ(counts(*this->take(), 0), std::vector<double>({ 100 })); // the first actor's
    vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
    this->refuses("honoured: actor-2: a relative offset of its polygons");
    near->GetMapper()->SetRelativeCoincidentTopologyPolygonOffsetParameters(0, 0);
    this->take();
    vtkMapper::SetResolveCoincidentTopologyToDefault();
  }
}

TEST_F(Snapshots, HaveNoMemoryForAPictureThatIsTooLarge)
{
  this->add(square(0, 0));
  vtkNew<dgtkSnapshot> shot;
  ASSERT_TRUE(shot->Take(this->Renderer, 1 << 20, 1 << 20)) << shot->GetErrorMessage();
  EXPECT_EQ(shot->TraceCells(), nullptr);
  const std::string begins = "not enough memory: arrays of 1048576 x 1048576 pixels take ";
  EXPECT_EQ(shot->GetErrorMessage().rfind(begins + "17592 GB", 0), 0u) << shot->GetErrorMessage();
  EXPECT_EQ(shot->GetErrorCode(), 4);
  EXPECT_FALSE(shot->Correspond(shot));
  EXPECT_EQ(shot->GetErrorMessage().rfind(begins + "27487 GB", 0), 0u) << shot->GetErrorMessage();
}
} // namespace
