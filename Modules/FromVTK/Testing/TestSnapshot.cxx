// SPDX-License-Identifier: BSD-3-Clause
// Snapshots of small VTK scenes whose answers are known in closed form.
#include "dgtkSnapshotTest.h"

#include "dgtkSceneState.h"
#include "dgtkStage.h"

#include <vtkActor.h>
#include <vtkBitArray.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCompositeDataDisplayAttributes.h>
#include <vtkCompositePolyDataMapper2.h>
#include <vtkDoubleArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkLight.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkProperty.h>
#include <vtkTransform.h>

#include <memory>
#include <utility>
#include <vector>

namespace
{
TEST_F(Snapshots, FollowTheMatrixOfAnActor)
{
  const vtkSmartPointer<vtkActor> actor = this->add(square(0, 0));
  actor->SetPosition(-1, 0.5, 0.25);
  actor->SetScale(2, 0.5, 1);
  actor->RotateZ(90);
  const auto shot = this->take();
  const dgtk::Instance& instance = shot->GetStage()->at(0)->instances.at(0);
  const Eigen::Vector3d moved = instance.world_from_object * Eigen::Vector3d(1, 1, 0); // scale, turn, move
  EXPECT_LT((moved - Eigen::Vector3d(-1.5, 2.5, 0.25)).norm(), 1e-12);
  EXPECT_EQ(counts(*shot, 0), std::vector<double>({ 5 * 15 })); // 0.5 x 1.5 of it are in the picture
}

TEST_F(Snapshots, NumberTheCellsOfBlocksThroughAll)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, square(-1.5, 0, 2));
  blocks->SetBlock(2, square(0.5, 0));
  vtkNew<vtkCompositePolyDataMapper2> mapper;
  mapper->SetInputDataObject(blocks);
  this->add(mapper.Get());
  EXPECT_EQ(counts(*this->take(), 0), std::vector<double>({ 25, 25, 25, 25, 100 }));
}

TEST_F(Snapshots, GiveBlocksWhatThoseAroundThemHave)
{
  vtkNew<vtkMultiBlockDataSet> inner;
  inner->SetBlock(0, square(0.5, 0));
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, square(-1.5, 0));
  blocks->SetBlock(1, inner);
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  vtkNew<vtkCompositePolyDataMapper2> mapper;
  mapper->SetInputDataObject(blocks);
  mapper->SetCompositeDataDisplayAttributes(attributes);
  this->add(mapper.Get());
  attributes->SetBlockColor(inner, vtkColor3d(0.25, 0.5, 0.75).GetData());
  const auto colored = this->take();
  EXPECT_EQ(counts(*colored, 0), std::vector<double>({ 100, 100 }));
  const std::vector<dgtk::Material>& materials = *colored->GetStage()->at(0)->instances.at(0).materials;
  ASSERT_EQ(materials.size(), 2u);
  EXPECT_EQ(materials[0].diffuse, Eigen::Vector3d(1, 1, 1));
  EXPECT_EQ(materials[1].diffuse, Eigen::Vector3d(0.25, 0.5, 0.75));
  attributes->SetBlockVisibility(inner, false);
  EXPECT_EQ(counts(*this->take(), 0), std::vector<double>({ 100, 0 }));
}

TEST_F(Snapshots, GiveABlockItsOpacity)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, square(-1.5, 0));
  blocks->SetBlock(1, square(0.5, 0));
  vtkNew<vtkCompositeDataDisplayAttributes> attributes;
  attributes->SetBlockOpacity(blocks->GetBlock(1), 0.3);
  vtkNew<vtkCompositePolyDataMapper2> mapper;
  mapper->SetInputDataObject(blocks);
  mapper->SetCompositeDataDisplayAttributes(attributes);
  this->add(mapper.Get())->GetProperty()->SetOpacity(0.8);
  const std::vector<dgtk::Material> materials = *this->take()->GetStage()->at(0)->instances.at(0).materials;
  ASSERT_EQ(materials.size(), 2u);
  EXPECT_EQ(materials[0].opacity, 0.8);
  EXPECT_EQ(materials[1].opacity, 0.3);
}

TEST_F(Snapshots, GiveAPolygonAndAStripTheirCells)
{
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  const double corners[][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 }, { -1, -1 }, { -0.5, -1 }, { -1, -0.5 },
    { -0.5, -0.5 }, { -1, 0 }, { -0.5, 0 } };
  for (const auto& corner : corners)
  {
    points->InsertNextPoint(corner[0], corner[1], 0);
  }
  vtkNew<vtkCellArray> polygons;
  const vtkIdType polygon[] = { 0, 1, 2, 3 };
  polygons->InsertNextCell(4, polygon);
  vtkNew<vtkCellArray> strips;
  const vtkIdType strip[] = { 4, 5, 6, 7, 8, 9 };
  strips->InsertNextCell(6, strip);
  data->SetPoints(points);
  data->SetPolys(polygons);
  data->SetStrips(strips);
  this->add(data.Get());
  EXPECT_EQ(counts(*this->take(), 0), std::vector<double>({ 100, 50 }));
}

TEST_F(Snapshots, GiveGlyphsOneIdAndTheCellOfTheirPoint)
{
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(-1.5, -1, 0);
  points->InsertNextPoint(0.5, 0.25, 0);
  data->SetPoints(points);
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetSourceData(square(0, 0, 3));
  mapper->SetScaleFactor(0.5);
  this->add(mapper.Get());
  const auto shot = this->take();
  EXPECT_EQ(shot->GetNumberOfProps(), 1);
  EXPECT_EQ(counts(*shot, 0), std::vector<double>({ 25, 25 }));
}

TEST_F(Snapshots, LeaveOutGlyphsThatAreMasked)
{
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(-1.5, -1, 0);
  points->InsertNextPoint(0.5, 0.25, 0);
  data->SetPoints(points);
  vtkNew<vtkBitArray> mask;
  mask->SetName("mask");
  mask->InsertNextValue(1);
  mask->InsertNextValue(0);
  data->GetPointData()->AddArray(mask);
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetSourceData(square(0, 0));
  mapper->SetScaleFactor(0.5);
  mapper->SetMaskArray("mask");
  mapper->MaskingOn();
  this->add(mapper.Get());
  EXPECT_EQ(counts(*this->take(), 0), std::vector<double>({ 25, 0 }));
}

/// The range becomes 0 to 1, times the factor (vtkGlyph3DMapper::SetRange).
TEST_F(Snapshots, ClampTheSizesOfGlyphs)
{
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> sizes;
  sizes->SetName("size");
  for (const double size : { 1.5, 2.0, 3.0, 4.0 })
  {
    points->InsertNextPoint(0, 0, 0);
    sizes->InsertNextValue(size);
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(sizes);
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetSourceData(square(0, 0));
  mapper->SetScaleArray("size");
  mapper->SetScaleModeToScaleByMagnitude();
  mapper->SetScaleFactor(0.5);
  mapper->ClampingOn();
  mapper->SetRange(1, 3);
  this->add(mapper.Get());
  const auto shot = this->take();
  const std::vector<dgtk::Instance>& instances = shot->GetStage()->at(0)->instances;
  const double expected[] = { 0.125, 0.25, 0.5, 0.5 };
  ASSERT_EQ(instances.size(), 1 + std::size(expected));
  for (std::size_t i = 0; i < std::size(expected); ++i)
  {
    EXPECT_LT((instances[i + 1].object_from_model.linear - expected[i] * Eigen::Matrix3d::Identity()).norm(), 1e-9)
      << i;
  }
}

/// From 90 degrees on a light has no cone (vtkLight::SetConeAngle).
TEST_F(Snapshots, GiveALightThatIsWideOpenNoCone)
{
  this->add(square(0, 0));
  vtkNew<vtkLight> light;
  light->SetLightTypeToSceneLight();
  light->PositionalOn();
  this->Renderer->AddLight(light);
  for (const auto& [angle, kind] : { std::pair(40.0, dgtk::LightKind::Spot), std::pair(89.5, dgtk::LightKind::Spot),
         std::pair(90.0, dgtk::LightKind::Point), std::pair(120.0, dgtk::LightKind::Point) })
  {
    light->SetConeAngle(angle);
    const std::shared_ptr<const dgtk::Stage> stage = this->take()->GetStage();
    ASSERT_TRUE(stage) << angle;
    EXPECT_EQ(stage->at(0)->lights.at(0).kind, kind) << angle;
  }
}

TEST_F(Snapshots, TurnGlyphsAsVtkDoes)
{
  vtkNew<vtkTransform> judge;
  const double arrays[][3] = { { 1, 0, 0 }, { -1, 0, 0 }, { -2.5, 0, 0 }, { 0, 0, 0 }, { 0, 1, 0 }, { 0, 0, -3 },
    { 0, 1e-3, 0 }, { 20, 130, -75 }, { -90, 10, 200 } };
  vtkNew<vtkPolyData> data;
  vtkNew<vtkPoints> points;
  vtkNew<vtkDoubleArray> turns;
  turns->SetName("turn");
  turns->SetNumberOfComponents(3);
  for (const auto& turn : arrays)
  {
    points->InsertNextPoint(0.1, 0.2, 0.3);
    turns->InsertNextTuple(turn);
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(turns);
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(data);
  mapper->SetSourceData(square(0, 0));
  mapper->SetOrientationArray("turn");
  this->add(mapper.Get());
  for (const bool rotation : { false, true })
  {
    mapper->SetOrientationMode(rotation ? vtkGlyph3DMapper::ROTATION : vtkGlyph3DMapper::DIRECTION);
    const auto shot = this->take();
    const std::vector<dgtk::Instance>& instances = shot->GetStage()->at(0)->instances;
    ASSERT_EQ(instances.size(), 1 + std::size(arrays)); // the object, and its copies
    for (std::size_t i = 0; i < std::size(arrays); ++i)
    {
      const Eigen::Vector3d v(arrays[i]);
      judge->Identity();
      if (rotation)
      {
        judge->RotateZ(v.z());
        judge->RotateX(v.x());
        judge->RotateY(v.y());
      }
      else if (v.y() == 0 && v.z() == 0)
      {
        judge->RotateY(v.x() < 0 ? 180 : 0);
      }
      else
      {
        judge->RotateWXYZ(180, v.x() + v.norm(), v.y(), v.z());
      }
      const Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>> expected(judge->GetMatrix()->GetData());
      EXPECT_LT(
        (instances[i + 1].object_from_model.linear - expected.topLeftCorner<3, 3>()).cwiseAbs().maxCoeff(), 1e-12)
        << rotation << ' ' << v.transpose();
      EXPECT_LT((instances[i + 1].object_from_model.translation - Eigen::Vector3d(0.1, 0.2, 0.3)).norm(), 1e-6);
    }
  }
}

TEST_F(Snapshots, ShareWhatDidNotChange)
{
  const vtkSmartPointer<vtkPolyData> data = square(0, 0);
  this->add(data.Get());
  const auto model = [](dgtkSnapshot& shot) { return shot.GetStage()->at(0)->instances.at(0).model; };
  const auto first = this->take();
  this->Renderer->GetActiveCamera()->Azimuth(10);
  const auto second = this->take();
  EXPECT_EQ(model(*first), model(*second));
  *static_cast<float*>(data->GetPoints()->GetVoidPointer(0)) = -1; // without telling VTK
  const auto third = this->take();
  EXPECT_NE(model(*first), model(*third));
  EXPECT_EQ(first->GetStage()->at(0)->instances.at(0).geometry->positions[0].x(), 0);
}
} // namespace
