// SPDX-License-Identifier: BSD-3-Clause
// What views give to VTK, without drawing it.
#include "dgtkLineActor.h"
#include "dgtkMeshClusters.h"
#include "dgtkSyntheticScene.h"
#include "dgtkViewActors.h"
#include "dgtkViewChecks.h"
#include "dgtkViewLines.h"

#include <Eigen/Geometry>

#include <vtkGlyph3DMapper.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkTexture.h>

#include <cmath>
#include <vector>

namespace
{
using namespace dgtk;
using test::actorsOf;
using test::expectVector;
using test::viewTolerance;
using V = Eigen::Vector3d;

vtkPolyData* dataOf(vtkActor* actor) { return vtkPolyData::SafeDownCast(actor->GetMapper()->GetInputAsDataSet()); }

vtkIdType trianglesOf(vtkActor* actor) { return dataOf(actor)->GetNumberOfPolys(); }

TEST(ViewCopies, PlacesAreTurnedAndScaledButNotSheared)
{
  Affine3 place;
  place.linear = Eigen::AngleAxisd(0.5, V(1, 2, 2) / 3).toRotationMatrix() * V(2, 3, 4).asDiagonal();
  place.translation = V(5, 6, 7);
  auto found = ViewCopies::placeOf(place);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->position, V(5, 6, 7));
  EXPECT_LT((found->scale - V(2, 3, 4)).norm(), viewTolerance);
  const Eigen::Vector4d turned(std::cos(0.25), std::sin(0.25) / 3, 2 * std::sin(0.25) / 3, 2 * std::sin(0.25) / 3);
  EXPECT_LT((found->rotation - turned).norm(), viewTolerance);
  place.linear = V(2, -3, 4).asDiagonal();
  found = ViewCopies::placeOf(place);
  ASSERT_TRUE(found.has_value());
  const Eigen::Matrix3d made =
    Eigen::Quaterniond(found->rotation[0], found->rotation[1], found->rotation[2], found->rotation[3])
      .toRotationMatrix() *
    found->scale.asDiagonal();
  EXPECT_LT((made - place.linear).norm(), viewTolerance) << "a mirrored one";
  for (const auto& [shear, isPlace] : { std::pair(0.9e-6, true), std::pair(1.1e-6, false) })
  {
    place.linear = Eigen::Matrix3d::Identity();
    place.linear(0, 1) = shear;
    EXPECT_EQ(ViewCopies::placeOf(place).has_value(), isPlace) << shear;
  }
  for (const auto& [scale, isPlace] : { std::pair(0.9e-12, false), std::pair(1.1e-12, true) })
  {
    place.linear = V(1, scale, 1).asDiagonal();
    EXPECT_EQ(ViewCopies::placeOf(place).has_value(), isPlace) << scale;
  }
}

TEST(LineActor, IsThereWhenItHasLines)
{
  vtkNew<vtkRenderer> renderer;
  LineActor lines(renderer, V(0.1, 0.2, 0.3), 2.5);
  ASSERT_EQ(actorsOf(renderer).size(), 1u);
  vtkActor* const actor = actorsOf(renderer)[0];
  EXPECT_FALSE(actor->GetVisibility());
  lines.show(true);
  EXPECT_FALSE(actor->GetVisibility());
  lines.set({ { V(1, 2, 3), V(4, 5, 6) }, { V(7, 8, 9), V(0, 0, 1) } });
  EXPECT_TRUE(actor->GetVisibility());
  lines.show(false);
  EXPECT_FALSE(actor->GetVisibility());
  lines.show(true);
  EXPECT_TRUE(actor->GetVisibility());
  expectVector(actor->GetProperty()->GetColor(), V(0.1, 0.2, 0.3));
  EXPECT_EQ(actor->GetProperty()->GetLineWidth(), 2.5f);
  EXPECT_FALSE(actor->GetProperty()->GetLighting());
  vtkPolyData* const data = dataOf(actor);
  ASSERT_EQ(data->GetNumberOfPoints(), 4);
  EXPECT_EQ(data->GetNumberOfLines(), 2);
  expectVector(data->GetPoint(1), V(4, 5, 6));
  expectVector(data->GetPoint(2), V(7, 8, 9));
}

/// A scene of `copies` spheres along x, 10 apart, a box that is not visible, lights and a camera.
class ViewActorsTable : public testing::Test
{
protected:
  vtkNew<vtkRenderer> Renderer;
  ViewMeshes Meshes;
  SceneDescription Scene;
  ScenePlaces Places;
  std::shared_ptr<const Model> Sphere = test::makeSphere();
  std::shared_ptr<const SceneState> State;

  void place(int copies)
  {
    test::SceneBuilder builder;
    for (int i = 0; i < copies; ++i)
    {
      builder.add(this->Sphere, test::placement({ 10.0 * i, 0, 0 }, 2));
    }
    builder.add(test::makeBox());
    this->State = builder.state();
    this->Scene.lights.resize(2);
    this->Scene.lights[0].position = V(1, 2, 3);
    this->Scene.lights[0].diffuse = V(0.25, 0.5, 0);
    this->Scene.lights[1].kind = LightKind::Head;
    this->Scene.lights[1].enabled = false;
    this->Scene.cameras.resize(1);
    this->Places = placeScene(this->Scene, ModelLibrary(), 0);
    for (const Instance& instance : this->State->instances)
    {
      ObjectPlace place;
      place.instance = instance;
      for (const V& position : instance.geometry->positions)
      {
        place.box.add(instance.world_from_object * position);
      }
      this->Places.box.add(place.box);
      this->Places.objects.push_back(place);
    }
    this->Places.objects.back().visible = false;
  }
  void show(ViewActors& actors) { actors.show(this->Scene, this->Places, nullptr, this->Meshes); }
};

TEST_F(ViewActorsTable, ObjectsLightsCamerasGridAndAxes)
{
  ViewActors actors(this->Renderer, ViewKind::Perspective);
  ASSERT_EQ(actors.actors(), 6) << "the lines of grid, axes, boxes and cameras";
  this->place(2);
  this->show(actors);
  ASSERT_EQ(actors.actors(), 11);
  const std::vector<vtkActor*> all = actorsOf(this->Renderer);
  const double extent = 1.5 * 2 * this->Places.box.max.norm();
  EXPECT_EQ(actors.gridStep(), gridStep(extent));
  expectVector(all[0]->GetProperty()->GetColor(), V(0.42, 0.44, 0.47), "grid");
  LineList grid;
  addGrid(grid, V(0, 0, 0), V(1, 0, 0), V(0, 0, -1), extent);
  EXPECT_EQ(dataOf(all[0])->GetNumberOfLines(), vtkIdType(grid.size()));
  expectVector(dataOf(all[0])->GetPoint(0), grid[0].first);
  expectVector(dataOf(all[0])->GetPoint(1), grid[0].second);
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const V unit = V::Unit(Eigen::Index(axis));
    expectVector(all[1 + axis]->GetProperty()->GetColor(), V(0.25, 0.25, 0.25) + 0.65 * unit);
    expectVector(dataOf(all[1 + axis])->GetPoint(0), V(0, 0, 0));
    expectVector(dataOf(all[1 + axis])->GetPoint(1), 2 * actors.gridStep() * unit);
  }
  EXPECT_FALSE(all[4]->GetVisibility()) << "boxes";
  LineList frusta;
  addFrustum(frusta, this->Places.cameras[0], frustumLength(this->Places));
  EXPECT_EQ(dataOf(all[5])->GetNumberOfLines(), vtkIdType(frusta.size()));
  expectVector(dataOf(all[5])->GetPoint(1), frusta[0].second);
  for (std::size_t i = 0; i < 3; ++i)
  {
    vtkActor* const object = all[6 + i];
    EXPECT_EQ(bool(object->GetVisibility()), i < 2);
    EXPECT_EQ(trianglesOf(object), vtkIdType(this->State->instances[i].model->triangles.size()));
    const vtkMatrix4x4* const matrix = object->GetUserMatrix();
    if (i < 2)
    {
      ASSERT_NE(matrix, nullptr);
      EXPECT_EQ(matrix->GetElement(0, 0), 2);
      EXPECT_EQ(matrix->GetElement(1, 1), 2);
      EXPECT_EQ(matrix->GetElement(0, 3), 10.0 * double(i));
    }
  }
  EXPECT_EQ(dataOf(all[6]), dataOf(all[7])) << "one mesh for both";
  EXPECT_EQ(all[6]->GetProperty(), all[7]->GetProperty());
  expectVector(all[9]->GetProperty()->GetColor(), V(0.5, 1, 0), "as bright as can be");
  expectVector(all[9]->GetPosition(), V(1, 2, 3));
  EXPECT_NEAR(dataOf(all[9])->GetBounds()[5], 1, 1e-6) << "a ball of radius 1";
  EXPECT_EQ(all[9]->GetProperty()->GetAmbient(), 0.6);
  EXPECT_EQ(all[9]->GetProperty()->GetDiffuse(), 0.4);
  EXPECT_DOUBLE_EQ(all[9]->GetScale()[0], lightRadius(this->Places));
  EXPECT_TRUE(all[9]->GetVisibility());
  expectVector(all[10]->GetProperty()->GetColor(), V(0.35, 0.35, 0.35), "not enabled");
  EXPECT_FALSE(all[10]->GetVisibility()) << "it has no place";

  this->Scene.lights[0].diffuse.keys = { { 0, V(1, 1, 0) }, { 4, V(0.25, 1, 0) }, { 8, V(0.25, 1, 0) } };
  this->Scene.lights[0].diffuse.interpolation = Interpolation::Smooth;
  this->Places.frame = 6;
  this->show(actors);
  expectVector(all[9]->GetProperty()->GetColor(), V(0.25, 1, 0), "not beyond its keys");

  actors.showGrid(false);
  EXPECT_FALSE(all[0]->GetVisibility() || all[1]->GetVisibility() || all[3]->GetVisibility());
  actors.showGrid(true);
  EXPECT_TRUE(all[0]->GetVisibility() && all[1]->GetVisibility() && all[3]->GetVisibility());
  actors.showCoarse(this->Places);
  EXPECT_FALSE(all[6]->GetVisibility() || all[7]->GetVisibility() || all[8]->GetVisibility());
  EXPECT_EQ(dataOf(all[4])->GetNumberOfLines(), 24) << "of the two that are visible";
  EXPECT_TRUE(all[4]->GetVisibility());
  actors.showFine();
  EXPECT_TRUE(all[6]->GetVisibility() && all[7]->GetVisibility());
  EXPECT_FALSE(all[8]->GetVisibility());
  EXPECT_FALSE(all[4]->GetVisibility());

  actors.setStyle(ViewStyle::Wireframe);
  this->show(actors);
  EXPECT_EQ(actorsOf(this->Renderer).size(), 11u);
  for (vtkActor* const actor : actorsOf(this->Renderer))
  {
    if (trianglesOf(actor) == vtkIdType(this->Sphere->triangles.size()))
    {
      EXPECT_EQ(actor->GetProperty()->GetRepresentation(), VTK_WIREFRAME);
    }
  }
  this->Places.objects.pop_back();
  this->Places.lights.pop_back();
  this->show(actors);
  EXPECT_EQ(actors.actors(), 9) << "what is gone is not drawn";
}

TEST_F(ViewActorsTable, GridsOfParallelViewsAreBehindEverything)
{
  this->place(1);
  for (const UpAxis up : { UpAxis::Y, UpAxis::Z })
  {
    this->Scene.upAxis = up;
    for (const ViewKind kind : { ViewKind::Front, ViewKind::Top, ViewKind::Side, ViewKind::Perspective })
    {
      vtkNew<vtkRenderer> renderer;
      ViewActors actors(renderer, kind);
      actors.show(this->Scene, this->Places, nullptr, this->Meshes);
      const double extent = 3 * std::max({ this->Places.box.min.norm(), this->Places.box.max.norm(), 5.0 });
      const ViewCamera camera(kind, up);
      const bool parallel = kind != ViewKind::Perspective;
      const V normal = parallel ? camera.forward() : camera.up();
      vtkPolyData* const grid = dataOf(actorsOf(renderer)[0]);
      ASSERT_GT(grid->GetNumberOfPoints(), 0);
      for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i)
      {
        EXPECT_NEAR(V(grid->GetPoint(i)).dot(normal), parallel ? extent : 0, 1e-9);
      }
      const V origin = parallel ? V(extent * normal) : V(0, 0, 0);
      expectVector(dataOf(actorsOf(renderer)[2])->GetPoint(0), origin);
      EXPECT_EQ(actors.gridStep(), gridStep(extent));
    }
  }
}

/// It grows by doubling, so that it does not change with every motion.
TEST_F(ViewActorsTable, GridsChangeSeldom)
{
  ViewActors actors(this->Renderer, ViewKind::Perspective);
  const auto linesOf = [&](double size)
  {
    this->Places.objects.clear();
    this->Places.box = {};
    this->Places.box.add(V(0, 0, 0));
    this->Places.box.add(V(size, 0, 0));
    this->show(actors);
    return V(dataOf(actorsOf(this->Renderer)[0])->GetPoint(0)).norm();
  };
  this->Places = placeScene(this->Scene, ModelLibrary(), 0);
  const double ten = linesOf(10); // 30 across
  EXPECT_EQ(linesOf(14.9), ten);
  const double more = linesOf(15.1); // 45.3
  EXPECT_GT(more, ten);
  EXPECT_EQ(linesOf(5.8), more);
  EXPECT_LT(linesOf(5.6), more) << "it is four times as large as it must be";
}

TEST_F(ViewActorsTable, SixteenCopiesAreDrawnTogether)
{
  for (const auto& [copies, together] : { std::pair(15, false), std::pair(16, true) })
  {
    vtkNew<vtkRenderer> renderer;
    ViewMeshes meshes;
    this->Places = {};
    this->place(copies);
    ViewActors actors(renderer, ViewKind::Perspective);
    actors.show(this->Scene, this->Places, nullptr, meshes);
    ViewCamera camera(ViewKind::Perspective);
    camera.frame(this->Places.box, 4.0 / 3);
    EXPECT_EQ(actors.actors(), 6 + (together ? 0 : 15) + 1 + 2) << copies;
    actors.chooseDetail(camera, 4000, 3000, 10000000);
    EXPECT_EQ(actors.actors(), 6 + (together ? 1 : 15) + 1 + 2) << copies;
    EXPECT_EQ(actors.triangles(), std::size_t(copies) * this->Sphere->triangles.size());
    EXPECT_EQ(actors.coarserMeshes(), 0);
    EXPECT_TRUE(actors.takeFresh());
    EXPECT_FALSE(actors.takeFresh());
    actors.chooseDetail(camera, 4000, 3000, 10000000); // of another drawing: they are no more
    for (vtkActor* const actor : actorsOf(renderer))
    {
      auto* const mapper = vtkGlyph3DMapper::SafeDownCast(actor->GetMapper());
      if (mapper != nullptr)
      {
        EXPECT_TRUE(together);
        vtkPolyData* const points = vtkPolyData::SafeDownCast(mapper->GetInput());
        EXPECT_EQ(points->GetNumberOfPoints(), 16);
        EXPECT_TRUE(actor->GetVisibility());
        vtkDataArray* const scales = points->GetPointData()->GetArray("scale");
        ASSERT_NE(scales, nullptr);
        expectVector(
          scales->GetTuple3(15), this->Places.objects[15].instance.world_from_object.linear.colwise().norm());
        ASSERT_NE(points->GetPointData()->GetArray("rotation"), nullptr);
        actors.showCoarse(this->Places);
        EXPECT_FALSE(actor->GetVisibility());
        actors.showFine();
        actors.chooseDetail(camera, 4000, 3000, 10000000);
        EXPECT_TRUE(actor->GetVisibility());
      }
    }
  }
}

TEST_F(ViewActorsTable, ObjectsBecomeCopiesAndObjectsAgain)
{
  ViewActors actors(this->Renderer, ViewKind::Perspective);
  ViewCamera camera(ViewKind::Perspective);
  this->place(16);
  camera.frame(this->Places.box, 4.0 / 3);
  const auto actorsOfSpheres = [&]
  {
    this->show(actors);
    actors.chooseDetail(camera, 4000, 3000, 10000000);
    return actors.actors() - 9;
  };
  EXPECT_EQ(actorsOfSpheres(), 1);
  EXPECT_TRUE(actors.takeFresh());
  EXPECT_EQ(actorsOfSpheres(), 1);
  EXPECT_FALSE(actors.takeFresh()) << "nothing is made anew";
  const ObjectPlace last = this->Places.objects[15];
  this->Places.objects.erase(this->Places.objects.begin() + 15);
  EXPECT_EQ(actorsOfSpheres(), 15 + 1) << "and what drew them together";
  this->Places.objects.push_back(last);
  EXPECT_EQ(actorsOfSpheres(), 1);
  // What is sheared, or seen through, is drawn alone.
  this->Places.objects[0].instance.world_from_object.linear(0, 1) = 1;
  EXPECT_EQ(actorsOfSpheres(), 2);
}

TEST_F(ViewActorsTable, AnObjectComesBackToTheOrigin)
{
  this->place(1);
  ViewActors actors(this->Renderer, ViewKind::Perspective);
  for (const double x : { 3.0, 0.0, 2.0 })
  {
    Affine3& place = this->Places.objects[0].instance.world_from_object;
    place = {};
    place.translation = V(x, 0, 0);
    this->show(actors);
    int spheres = 0;
    for (vtkActor* const actor : actorsOf(this->Renderer))
    {
      if (trianglesOf(actor) == vtkIdType(this->Sphere->triangles.size()))
      {
        ++spheres;
        EXPECT_EQ(actor->GetMatrix()->GetElement(0, 3), x);
      }
    }
    EXPECT_EQ(spheres, 1);
  }
}

TEST_F(ViewActorsTable, WhatIsNearMayBeSeenAnywhere)
{
  this->place(1);
  ViewActors actors(this->Renderer, ViewKind::Perspective);
  this->show(actors);
  ViewCamera away(ViewKind::Perspective);
  const double radius = this->Places.objects[0].box.diagonal() / 2;
  for (const auto& [distance, seen] : { std::pair(2.9 * radius, true), std::pair(3.1 * radius, false) })
  {
    for (const double x : { 0.0, 50.0 })
    {
      ScenePlaces places = this->Places;
      places.objects[0].box = {};
      places.objects[0].box.add(this->Places.objects[0].box.min + V(x, 0, 0));
      places.objects[0].box.add(this->Places.objects[0].box.max + V(x, 0, 0));
      actors.show(this->Scene, places, nullptr, this->Meshes);
      away.look(V(x, 0, distance), V(x, 0, 2 * distance));
      actors.chooseDetail(away, 400, 300, 10000000);
      EXPECT_EQ(actors.triangles() > 0, seen) << distance;
    }
  }
  // Beside the picture by one and a half of its radius.
  ViewCamera front(ViewKind::Front);
  front.look(V(0, 0, 0), V(0, 0, 0));
  const double unit = front.unit(V(0, 0, 0), 300);
  for (const auto& [x, y, seen] :
    { std::tuple(200 * unit + 1.45 * radius, 0.0, true), std::tuple(200 * unit + 1.55 * radius, 0.0, false),
      std::tuple(-200 * unit - 1.45 * radius, 0.0, true), std::tuple(-200 * unit - 1.55 * radius, 0.0, false),
      std::tuple(0.0, 150 * unit + 1.45 * radius, true), std::tuple(0.0, 150 * unit + 1.55 * radius, false),
      std::tuple(0.0, -150 * unit - 1.45 * radius, true), std::tuple(0.0, -150 * unit - 1.55 * radius, false) })
  {
    WorldBox moved;
    moved.add(this->Places.objects[0].box.min + V(x, y, 0));
    moved.add(this->Places.objects[0].box.max + V(x, y, 0));
    ScenePlaces places = this->Places;
    places.objects[0].box = moved;
    actors.show(this->Scene, places, nullptr, this->Meshes);
    actors.chooseDetail(front, 400, 300, 10000000);
    EXPECT_EQ(actors.triangles() > 0, seen) << x << ' ' << y;
  }
}

TEST_F(ViewActorsTable, TexturesAreOfTheirStyle)
{
  for (const auto& [wrap, expected] :
    { std::pair(TextureWrap::Repeat, vtkTexture::Repeat), std::pair(TextureWrap::Clamp, vtkTexture::ClampToEdge),
      std::pair(TextureWrap::Mirror, vtkTexture::MirroredRepeat) })
  {
    this->Renderer->RemoveAllViewProps();
    auto model = std::make_shared<Model>(*this->Sphere);
    auto image = std::make_shared<Image>();
    image->width = image->height = 2;
    image->rgba.assign(16, 255);
    model->textures = { { "t", "", image } };
    model->textures[0].wrap.fill(wrap);
    model->uvs.assign(model->rest->positions.size(), Eigen::Vector2d(0, 0));
    model->materials[0].texture = 0;
    this->Sphere = model;
    this->place(1);
    ViewActors actors(this->Renderer, ViewKind::Perspective);
    for (const ViewStyle style : { ViewStyle::Textured, ViewStyle::Shaded, ViewStyle::Wireframe })
    {
      actors.setStyle(style);
      this->show(actors);
      for (vtkActor* const actor : actorsOf(this->Renderer))
      {
        if (trianglesOf(actor) != vtkIdType(model->triangles.size()))
        {
          continue;
        }
        EXPECT_EQ(actor->GetTexture() != nullptr, style == ViewStyle::Textured);
        EXPECT_EQ(
          actor->GetProperty()->GetRepresentation(), style == ViewStyle::Wireframe ? VTK_WIREFRAME : VTK_SURFACE);
        EXPECT_TRUE(actor->GetForceOpaque());
        if (actor->GetTexture() != nullptr)
        {
          EXPECT_TRUE(actor->GetTexture()->GetInterpolate() && actor->GetTexture()->GetMipmap());
          EXPECT_EQ(actor->GetTexture()->GetWrap(), expected);
          EXPECT_EQ(actor->GetTexture()->GetMaximumAnisotropicFiltering(), 1);
          EXPECT_EQ(actor->GetTexture()->GetInput(), this->Meshes.picture(image, false));
        }
      }
    }
  }
}

/// The nearer, the more triangles: below 56 pixels from corner to corner fewer, below 22 still fewer.
TEST_F(ViewActorsTable, DetailGoesWithTheSizeInTheImage)
{
  this->place(1);
  ViewActors actors(this->Renderer, ViewKind::Front);
  this->show(actors);
  vtkActor* const sphere = actorsOf(this->Renderer)[6];
  ViewCamera camera(ViewKind::Front);
  WorldBox unit;
  unit.add(V(-0.5, -0.5, -0.5));
  unit.add(V(0.5, 0.5, 0.5));
  camera.frame(unit, 1); // 1.08 units high
  const double diagonal = this->Places.objects[0].box.diagonal();
  const auto trianglesAt = [&](double pixels, std::size_t most = 10000000)
  {
    actors.chooseDetail(camera, 1000, 1.08 * pixels / diagonal, most);
    EXPECT_EQ(actors.triangles(), std::size_t(trianglesOf(sphere)));
    return actors.triangles();
  };
  const auto clustered = [&](double cells)
  {
    const auto fewer = clusterPart(*this->Sphere->rest, *this->Sphere, this->Sphere->parts[0], cells);
    return fewer->triangles.size();
  };
  const std::size_t levels[] = { this->Sphere->triangles.size(), clustered(14), clustered(6) };
  EXPECT_EQ(trianglesAt(57), levels[0]);
  EXPECT_EQ(actors.coarserMeshes(), 0);
  EXPECT_EQ(trianglesAt(55), levels[1]);
  EXPECT_EQ(actors.coarserMeshes(), 1);
  EXPECT_EQ(trianglesAt(23), levels[1]);
  EXPECT_EQ(trianglesAt(21), levels[2]);
  EXPECT_EQ(actors.coarserMeshes(), 2);
  // Where there would be too many: as if it were half as large, then a quarter.
  EXPECT_EQ(trianglesAt(111, levels[0]), levels[0]);
  EXPECT_EQ(trianglesAt(111, levels[0] - 1), levels[1]);
  EXPECT_EQ(trianglesAt(113, levels[0] - 1), levels[1]) << "a quarter";
  EXPECT_EQ(trianglesAt(225, levels[0] - 1), levels[0]) << "and no less";
  EXPECT_EQ(trianglesAt(87, levels[1] - 1), levels[2]);
  // Out of sight there is none.
  camera.pan(1e6, 0, 100);
  actors.chooseDetail(camera, 1000, 1000, 10000000);
  EXPECT_EQ(actors.triangles(), 0u);
}
} // namespace
