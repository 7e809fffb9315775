// SPDX-License-Identifier: BSD-3-Clause
// Surfaces, colours and views of VTK scenes that VTK itself, or the way to a model, would have otherwise.
#include "dgtkSnapshotTest.h"

#include "dgtkSceneState.h"
#include "dgtkStage.h"

#include <Eigen/Geometry>
#include <vtkAssembly.h>
#include <vtkCellArray.h>
#include <vtkCellTypeSource.h>
#include <vtkCompositePolyDataMapper2.h>
#include <vtkDataSetMapper.h>
#include <vtkDoubleArray.h>
#include <vtkFloatArray.h>
#include <vtkFollower.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageData.h>
#include <vtkLookupTable.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkTexture.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <utility>

namespace
{
TEST_F(Snapshots, NumberCellsOfAnyOrderAsTheirDataDo)
{
  for (const int type : { VTK_HEXAHEDRON, VTK_QUADRATIC_HEXAHEDRON, VTK_LAGRANGE_HEXAHEDRON })
  {
    vtkNew<vtkCellTypeSource> source;
    source->SetCellType(type);
    source->SetCellOrder(2);
    source->SetBlocksDimensions(2, 2, 1); // from 0 to 2
    vtkNew<vtkDataSetMapper> mapper;
    mapper->SetInputConnection(source->GetOutputPort());
    const auto actor = this->add(mapper.Get());
    EXPECT_EQ(counts(*this->take(), 0), std::vector<double>(4, 100)) << type;
    this->Renderer->RemoveActor(actor);
  }
}

/// One cell with these corners at z = 0.
vtkSmartPointer<vtkPolyData> polygon(const std::vector<std::array<double, 2>>& corners)
{
  auto data = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> cells;
  cells->InsertNextCell(int(corners.size()));
  for (const auto& corner : corners)
  {
    cells->InsertCellPoint(points->InsertNextPoint(corner[0], corner[1], 0));
  }
  data->SetPoints(points);
  data->SetPolys(cells);
  return data;
}

TEST_F(Snapshots, FillConcaveQuadsFromEachCorner)
{
  int expected = 0;
  for (int i = 0; i < side; ++i)
  {
    for (int j = 0; j < side; ++j)
    {
      expected += 5 * i + 14 * j < 85.5 || 14 * i + 5 * j < 85.5 ? 1 : 0; // left of the sides that meet in the notch
    }
  }
  std::vector<std::array<double, 2>> corners{ { 0, 0 }, { 1.9, 0 }, { 0.5, 0.5 }, { 0, 1.9 } };
  for (int first = 0; first < 4; ++first)
  {
    const auto actor = this->add(polygon(corners));
    EXPECT_EQ(counts(*this->take(), 0), std::vector<double>({ double(expected) })) << first;
    this->Renderer->RemoveActor(actor);
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
  }
}

/// As VTK draws it.
TEST_F(Snapshots, FillWhatIsLeftOfAPolygonWithoutThePointThatIsNoNumber)
{
  this->add(
    polygon({ { 0, 0 }, { std::numeric_limits<double>::quiet_NaN(), 0 }, { 1, 0.97 }, { 0.5, 0.985 }, { 0, 1 } }));
  EXPECT_EQ(counts(*this->take(), 0), std::vector<double>({ 55 })); // on and above the diagonal of ten pixels
}

/// A square whose second corner goes over the diagonal, and back: the first view's two triangles say what goes where.
TEST_F(Snapshots, FollowAPolygonThatIsCutOtherwise)
{
  const vtkSmartPointer<vtkPolyData> data = polygon({ { -1, -1 }, { 1, -1 }, { 1, 1 }, { -1, 1 } });
  this->add(data.Get());
  const auto whole = this->take();
  data->GetPoints()->SetPoint(1, -0.47, 0.47, 0);
  data->GetPoints()->Modified();
  const auto notched = this->take();
  ASSERT_TRUE(whole->Correspond(notched)) << whole->GetErrorMessage();
  ASSERT_TRUE(notched->Correspond(whole)) << notched->GetErrorMessage();
  for (int i = 0; i < side * side; ++i)
  {
    const double right = (i % side + 0.5) / 10 - 1; // of the corner at the upper left
    const double down = (i / side + 0.5) / 10 - 1;
    const double least = std::min(right, down);
    const double most = std::max(right, down);
    const bool isThere = least > 0 && most < 2 && 1.47 * least < 0.53 * (2 - most); // before a side of the notch
    EXPECT_EQ(whole->GetClasses()->GetComponent(i, 0), isThere ? 1 : 0) << right << ' ' << down;
    EXPECT_EQ(notched->GetClasses()->GetComponent(i, 0), isThere ? 1 : 0) << right << ' ' << down;
    if (isThere)
    {
      EXPECT_NEAR(whole->GetPositions()->GetComponent(i, 0), i % side + 0.5, 1e-5);
      EXPECT_NEAR(whole->GetPositions()->GetComponent(i, 1), i / side + 0.5, 1e-5);
      const double towards = 2 * least / 0.53; // the corner that moves; the rest is along the side that stays
      EXPECT_NEAR(notched->GetPositions()->GetComponent(i, 0), 10 * (1 + towards + right - least), 1e-5);
      EXPECT_NEAR(notched->GetPositions()->GetComponent(i, 1), 10 * (1 + towards + down - least), 1e-5);
    }
  }
}

TEST_F(Snapshots, GiveABlockWithoutScalarsTheColourOfNoNumber)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, square(-1.5, 0));
  blocks->SetBlock(1, square(0.5, 0));
  vtkNew<vtkDoubleArray> scalars;
  scalars->SetNumberOfTuples(4);
  scalars->Fill(0);
  vtkPolyData::SafeDownCast(blocks->GetBlock(0))->GetPointData()->SetScalars(scalars);
  vtkNew<vtkLookupTable> table;
  table->SetNanColor(0.2, 0.4, 0.6, 1);
  vtkNew<vtkCompositePolyDataMapper2> mapper;
  mapper->SetInputDataObject(blocks);
  mapper->SetLookupTable(table);
  this->add(mapper.Get());
  for (const bool missing : { false, true })
  {
    mapper->SetColorMissingArraysWithNanColor(missing);
    const std::vector<dgtk::Material> materials = *this->take()->GetStage()->at(0)->instances.at(0).materials;
    ASSERT_EQ(materials.size(), 2u);
    const Eigen::Vector3d expected = missing ? Eigen::Vector3d(0.2, 0.4, 0.6) : Eigen::Vector3d(1, 1, 1);
    EXPECT_LT((materials[1].diffuse - expected).norm(), 1e-9);
  }
}

/// Of two triangles that share a corner whose normal has no direction each has its own normal there.
TEST_F(Snapshots, GiveTrianglesTheirNormalWhereThatOfAPointHasNoDirection)
{
  constexpr double noNumber = std::numeric_limits<double>::quiet_NaN();
  for (const double x : { 0.0, noNumber })
  {
    const auto data = polygon({ { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 } });
    data->GetPoints()->SetPoint(1, 1, 0, -1);
    data->GetPoints()->SetPoint(3, 0, 1, -1);
    vtkNew<vtkFloatArray> normals;
    normals->SetNumberOfComponents(3);
    for (int i = 0; i < 4; ++i)
    {
      normals->InsertNextTuple3(i == 0 ? x : 0, i == 1 ? 3 : 0, i >= 2 ? 2 : 0);
    }
    data->GetPointData()->SetNormals(normals);
    const auto actor = this->add(data);
    const auto state = this->take()->GetStage()->at(0);
    const dgtk::Model& model = *state->instances.at(0).model;
    ASSERT_EQ(model.triangles.size(), 2u);
    ASSERT_EQ(model.rest->positions.size(), 5u);
    for (const auto& corners : model.triangles)
    {
      const auto& p = model.rest->positions;
      const Eigen::Vector3d own = (p[corners[1]] - p[corners[0]]).cross(p[corners[2]] - p[corners[0]]).normalized();
      for (const std::uint32_t corner : corners)
      {
        const Eigen::Vector3d place = p[corner];
        const Eigen::Vector3d expected = place.head<2>().isZero()         ? own
                                         : place.z() < 0 && place.x() > 0 ? Eigen::Vector3d(0, 1, 0)
                                                                          : Eigen::Vector3d(0, 0, 1);
        EXPECT_LT((model.rest->normals[corner].cast<double>() - expected).norm(), 1e-6) << corner;
      }
    }
    this->Renderer->RemoveActor(actor);
  }
}

TEST_F(Snapshots, RefuseLevelsOfDetailOfGlyphs)
{
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(square(0, 0));
  mapper->SetSourceData(square(0, 0));
  this->add(mapper.Get());
  this->take();
  mapper->SetCullingAndLOD(true);
  this->refuses("actor-1: levels of detail of its glyphs");
}

/// What has no texture coordinates is told from what has (0, 0), also after clipping and in a scene that is saved.
TEST_F(Snapshots, GiveABlockWithoutTextureCoordinatesNone)
{
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, square(-1.5, 0));
  blocks->SetBlock(1, square(0.5, 0));
  vtkPolyData::SafeDownCast(blocks->GetBlock(1))->GetPointData()->SetTCoords(nullptr);
  vtkNew<vtkCompositePolyDataMapper2> mapper;
  mapper->SetInputDataObject(blocks);
  this->add(mapper.Get());
  vtkNew<vtkPlane> plane;
  plane->SetNormal(0, 1, 0);
  plane->SetOrigin(0, 0.5, 0);
  for (const bool isClipped : { false, true })
  {
    if (isClipped)
    {
      mapper->AddClippingPlane(plane);
    }
    const auto state = this->take()->GetStage()->at(0);
    const dgtk::Model& model = *state->instances.at(0).model;
    ASSERT_EQ(model.parts.size(), 2u);
    ASSERT_GE(model.triangles.size(), 4u);
    for (std::uint32_t t = 0; t < model.triangles.size(); ++t)
    {
      EXPECT_EQ(model.hasUvs(t), model.partOf(t) == 0) << t;
    }
  }
  mapper->RemoveAllClippingPlanes();
  const std::string folder = testing::TempDir() + "dgtk-placed/";
  std::filesystem::create_directories(folder);
  const auto shot = this->take();
  ASSERT_TRUE(shot->Save(folder + "scene.json")) << shot->GetErrorMessage();
  std::string faces;
  for (const auto& entry : std::filesystem::directory_iterator(folder + "models"))
  {
    std::ifstream file(entry.path());
    for (std::string line; entry.path().extension() == ".obj" && std::getline(file, line);)
    {
      faces += line[0] == 'f' ? line + '\n' : "";
    }
  }
  EXPECT_EQ(faces, "f 1/1/1 2/2/2 3/3/3\nf 1/1/1 3/3/3 4/4/4\nf 5//5 6//6 7//7\nf 5//5 7//7 8//8\n");
  std::filesystem::remove_all(folder);
}

/// VTK turns a follower to its camera after the assembly has placed it.
TEST_F(Snapshots, RefuseAFollowerInAnAssembly)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(square(0, 0));
  vtkNew<vtkFollower> follower;
  follower->SetMapper(mapper);
  this->Renderer->AddActor(follower);
  EXPECT_EQ(counts(*this->take(), 0), std::vector<double>({ 100 }));
  this->Renderer->RemoveActor(follower);
  vtkNew<vtkAssembly> assembly;
  assembly->AddPart(follower);
  this->Renderer->AddActor(assembly);
  this->refuses("vtkFollower (prop 1) in an assembly");
}

TEST_F(Snapshots, RefuseATextureThatVtkMultipliesWith)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(1, 1, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  const auto actor = this->add(square(0, 0));
  actor->GetProperty()->SetTexture("normalTex", texture); // of physically based surfaces
  this->take();
  actor->GetProperty()->SetTexture("paint", texture);
  this->refuses("the texture paint of its property");
}

/// As VTK sees all for the first time: a sphere around the bounds in the narrower of both angles.
TEST(Overviews, HaveTheWholeSceneInTallAndWidePictures)
{
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(square(-0.5, -0.5));
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  vtkNew<vtkRenderer> renderer;
  renderer->AddActor(actor);
  for (const auto& [width, height] : { std::pair(40, 10), std::pair(40, 40), std::pair(10, 40) })
  {
    vtkNew<dgtkSnapshot> shot;
    ASSERT_TRUE(shot->Take(renderer, width, height)) << shot->GetErrorMessage();
    double t[3];
    shot->GetT(t);
    const double slope = std::tan(15 * EIGEN_PI / 180) * std::min(1.0, double(width) / height);
    EXPECT_NEAR(t[2], std::sqrt(0.5) / std::sin(std::atan(slope)), 1e-9) << width;
  }
}
} // namespace
