// SPDX-License-Identifier: BSD-3-Clause
// What views give to VTK, without drawing it.
#include "dgtkLineActor.h"
#include "dgtkMeshClusters.h"
#include "dgtkSyntheticScene.h"
#include "dgtkTestSupport.h"
#include "dgtkViewActors.h"
#include "dgtkViewLines.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <vtkActor.h>
#include <vtkActorCollection.h>
#include <vtkCellArray.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkLightCollection.h>
#include <vtkMatrix4x4.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderer.h>
#include <vtkTexture.h>

#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace
{
using namespace dgtk;
using V = Eigen::Vector3d;

constexpr double tolerance = 1e-12;

std::vector<vtkActor*> actorsOf(vtkRenderer* renderer)
{
  std::vector<vtkActor*> actors;
  vtkActorCollection* const all = renderer->GetActors();
  all->InitTraversal();
  while (vtkActor* const actor = all->GetNextActor())
  {
    actors.push_back(actor);
  }
  return actors;
}

std::vector<vtkLight*> lightsOf(vtkRenderer* renderer)
{
  std::vector<vtkLight*> lights;
  vtkLightCollection* const all = renderer->GetLights();
  all->InitTraversal();
  while (vtkLight* const light = all->GetNextItem())
  {
    lights.push_back(light);
  }
  return lights;
}

vtkPolyData* dataOf(vtkActor* actor) { return vtkPolyData::SafeDownCast(actor->GetMapper()->GetInputAsDataSet()); }

vtkIdType trianglesOf(vtkActor* actor) { return dataOf(actor)->GetNumberOfPolys(); }

void expectVector(const double* found, const V& expected, const char* what = "")
{
  EXPECT_LT((V(found[0], found[1], found[2]) - expected).norm(), tolerance)
    << what << ": " << found[0] << ' ' << found[1] << ' ' << found[2];
}

TEST(ViewCopies, PlacesAreTurnedAndScaledButNotSheared)
{
  Affine3 place;
  place.linear = Eigen::AngleAxisd(0.5, V(1, 2, 2) / 3).toRotationMatrix() * V(2, 3, 4).asDiagonal();
  place.translation = V(5, 6, 7);
  auto found = ViewCopies::placeOf(place);
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(found->position, V(5, 6, 7));
  EXPECT_LT((found->scale - V(2, 3, 4)).norm(), tolerance);
  const Eigen::Vector4d turned(std::cos(0.25), std::sin(0.25) / 3, 2 * std::sin(0.25) / 3, 2 * std::sin(0.25) / 3);
  EXPECT_LT((found->rotation - turned).norm(), tolerance);
  place.linear = V(2, -3, 4).asDiagonal();
  found = ViewCopies::placeOf(place);
  ASSERT_TRUE(found.has_value());
  const Eigen::Matrix3d made =
    Eigen::Quaterniond(found->rotation[0], found->rotation[1], found->rotation[2], found->rotation[3])
      .toRotationMatrix() *
    found->scale.asDiagonal();
  EXPECT_LT((made - place.linear).norm(), tolerance) << "a mirrored one";
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

TEST(ViewMeshes, EveryLevelOfASphere)
{
  const auto model = test::makeSphere();
  const auto state = test::SceneBuilder().add(model).state();
  const Instance& instance = state->instances[0];
  EXPECT_EQ(ViewMeshes::pixels(0), 0);
  EXPECT_EQ(ViewMeshes::pixels(1), 56);
  EXPECT_EQ(ViewMeshes::pixels(2), 22);
  ViewMeshes meshes;
  vtkPolyData* const all = meshes.part(instance, 0);
  EXPECT_EQ(all, meshes.part(instance, 0)) << "made once";
  EXPECT_EQ(all, meshes.part(*instance.geometry, *model, 0, 0));
  ASSERT_EQ(all->GetNumberOfPoints(), vtkIdType(model->rest->positions.size()));
  ASSERT_EQ(all->GetNumberOfPolys(), vtkIdType(model->triangles.size()));
  vtkIdType count = 0;
  const vtkIdType* corners = nullptr;
  all->GetPolys()->InitTraversal();
  for (std::size_t t = 0; all->GetPolys()->GetNextCell(count, corners); ++t)
  {
    ASSERT_EQ(count, 3);
    for (std::size_t k = 0; k < 3; ++k)
    {
      ASSERT_EQ(corners[k], vtkIdType(model->triangles[t][k]));
    }
  }
  for (vtkIdType i = 0; i < all->GetNumberOfPoints(); ++i)
  {
    const auto k = std::size_t(i);
    ASSERT_LT((V(all->GetPoint(i)) - model->rest->positions[k]).norm(), 1e-6);
    ASSERT_LT(
      (V(all->GetPointData()->GetNormals()->GetTuple3(i)) - model->rest->normals[k].cast<double>()).norm(), tolerance);
  }
  const double cells[] = { 0, 14, 6 };
  for (int level = 1; level < 3; ++level)
  {
    const auto fewer = clusterPart(*instance.geometry, *model, model->parts[0], cells[level]);
    ASSERT_TRUE(fewer.has_value());
    vtkPolyData* const coarse = meshes.part(*instance.geometry, *model, 0, level);
    EXPECT_EQ(coarse->GetNumberOfPolys(), vtkIdType(fewer->triangles.size()));
    ASSERT_EQ(coarse->GetNumberOfPoints(), vtkIdType(fewer->positions.size()));
    for (vtkIdType i = 0; i < coarse->GetNumberOfPoints(); ++i)
    {
      const auto k = std::size_t(i);
      ASSERT_LT((V(coarse->GetPoint(i)) - fewer->positions[k]).norm(), 1e-6);
      ASSERT_LT(
        (V(coarse->GetPointData()->GetNormals()->GetTuple3(i)) - model->rest->normals[fewer->sources[k]].cast<double>())
          .norm(),
        tolerance);
    }
    coarse->GetPolys()->InitTraversal();
    for (std::size_t t = 0; coarse->GetPolys()->GetNextCell(count, corners); ++t)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        ASSERT_EQ(corners[k], vtkIdType(fewer->triangles[t][k]));
      }
    }
  }
  // A box has no fewer triangles.
  const auto box = test::SceneBuilder().add(test::makeBox()).state();
  vtkPolyData* const own = meshes.part(box->instances[0], 0);
  EXPECT_EQ(meshes.part(*box->instances[0].geometry, *box->instances[0].model, 0, 2), own);
}

TEST(ViewMeshes, PicturesAreFromBelow)
{
  ViewMeshes meshes;
  auto image = std::make_shared<Image>();
  EXPECT_EQ(meshes.picture(nullptr, false), nullptr);
  EXPECT_EQ(meshes.picture(image, false), nullptr);
  image->width = 2;
  image->height = 2;
  image->rgba = { 1, 2, 3, 255, 4, 5, 6, 255, 7, 8, 9, 255, 10, 11, 12, 200 };
  vtkImageData* const plain = meshes.picture(image, false);
  vtkImageData* const cut = meshes.picture(image, true);
  EXPECT_NE(plain, cut);
  EXPECT_EQ(meshes.picture(image, false), plain);
  ASSERT_EQ(plain->GetNumberOfScalarComponents(), 3);
  ASSERT_EQ(cut->GetNumberOfScalarComponents(), 4);
  const auto* rgb = static_cast<const unsigned char*>(plain->GetScalarPointer());
  EXPECT_EQ(std::vector<int>(rgb, rgb + 12), (std::vector<int>{ 7, 8, 9, 10, 11, 12, 1, 2, 3, 4, 5, 6 }));
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

class ViewLightsTable : public testing::Test
{
protected:
  vtkNew<vtkRenderer> Renderer;
  ViewLights Lights{ Renderer };
  SceneState Surroundings;
  ViewCamera Front{ ViewKind::Front };
};

TEST_F(ViewLightsTable, EveryKindOfLight)
{
  LightState light;
  light.position = V(1, 2, 3);
  light.target = V(4, 5, 6);
  light.attenuation = V(0.5, 0.25, 0.125);
  light.diffuse = V(0.1, 0.2, 0.3);
  light.specular = V(0.4, 0.5, 0.6);
  light.coneAngle = 35;
  light.exponent = 7;
  light.intensity = 0.75;
  struct Row
  {
    LightKind kind;
    bool head, positional;
    double cone;
  };
  const Row rows[] = { { LightKind::Point, false, true, 180 }, { LightKind::Head, true, false, 180 },
    { LightKind::Directional, false, false, 180 }, { LightKind::Spot, false, true, 35 } };
  for (const Row& row : rows)
  {
    light.kind = row.kind;
    this->Surroundings.lights.push_back(light);
  }
  EXPECT_TRUE(this->Lights.show(this->Surroundings, nullptr, this->Front));
  EXPECT_FALSE(this->Lights.show(this->Surroundings, nullptr, this->Front)) << "nothing looks otherwise";
  const std::vector<vtkLight*> lights = lightsOf(this->Renderer);
  ASSERT_EQ(lights.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i)
  {
    EXPECT_EQ(bool(lights[i]->LightTypeIsHeadlight()), rows[i].head) << i;
    EXPECT_EQ(bool(lights[i]->LightTypeIsSceneLight()), !rows[i].head) << i;
    EXPECT_EQ(bool(lights[i]->GetPositional()), rows[i].positional) << i;
    EXPECT_EQ(lights[i]->GetConeAngle(), rows[i].cone) << i;
    EXPECT_EQ(lights[i]->GetExponent(), 7);
    EXPECT_EQ(lights[i]->GetIntensity(), 0.75);
    expectVector(lights[i]->GetAttenuationValues(), V(0.5, 0.25, 0.125));
    expectVector(lights[i]->GetDiffuseColor(), V(0.1, 0.2, 0.3));
    expectVector(lights[i]->GetSpecularColor(), V(0.4, 0.5, 0.6));
    if (!rows[i].head)
    {
      expectVector(lights[i]->GetPosition(), V(1, 2, 3));
      expectVector(lights[i]->GetFocalPoint(), V(4, 5, 6));
    }
  }
  // Dark ones fill up to a power of two.
  for (const auto& [added, shown] : { std::pair(1, 8u), std::pair(4, 8u), std::pair(5, 16u) })
  {
    this->Surroundings.lights.assign(std::size_t(4 + added), light);
    this->Lights.show(this->Surroundings, nullptr, this->Front);
    ASSERT_EQ(lightsOf(this->Renderer).size(), shown) << added;
    if (added != 4)
    {
      expectVector(lightsOf(this->Renderer).back()->GetDiffuseColor(), V(0, 0, 0));
    }
  }
  this->Lights.setSceneLights(false);
  EXPECT_TRUE(this->Lights.show(this->Surroundings, nullptr, this->Front));
  ASSERT_EQ(lightsOf(this->Renderer).size(), 1u);
  EXPECT_TRUE(lightsOf(this->Renderer)[0]->LightTypeIsHeadlight());
}

TEST_F(ViewLightsTable, MaterialsOfEachLight)
{
  Material material;
  material.ambient = V(0.1, 0.2, 0.4);
  material.diffuse = V(0.5, 0.6, 0.8);
  material.specular = V(0.3, 0.2, 0.1);
  material.emission = V(0.05, 0.9, 0);
  material.shininess = 0.25;
  material.opacity = 0.75;
  LightState light;
  light.diffuse = V(1, 0.5, 0.5);
  light.specular = V(0.25, 0.25, 0);
  light.ambient = V(0.5, 0, 1);
  light.intensity = 2;
  this->Surroundings.lights = { light };
  this->Lights.show(this->Surroundings, nullptr, this->Front);
  vtkNew<vtkProperty> property;
  this->Lights.fill(material, *property);
  // The world's ambient light of 0.2 and the lights' own.
  expectVector(property->GetAmbientColor(), V(0.05 + 1.2 * 0.1, 0.9 + 0.2 * 0.2, 2.2 * 0.4), "ambient");
  expectVector(property->GetDiffuseColor(), material.diffuse, "diffuse");
  expectVector(property->GetSpecularColor(), material.specular, "specular");
  EXPECT_EQ(property->GetAmbient(), 1);
  EXPECT_EQ(property->GetDiffuse(), 1);
  EXPECT_DOUBLE_EQ(property->GetSpecular(), 0.25) << "the part of the lights' specular light";
  EXPECT_EQ(property->GetSpecularPower(), 1);
  EXPECT_EQ(property->GetOpacity(), 0.75);
  material.shininess = 20;
  material.emission = V(1, 1, 1);
  this->Surroundings.lights[0].specular = V(1, 1, 1);
  this->Surroundings.lights[0].diffuse = V(0, 0, 1);
  EXPECT_TRUE(this->Lights.show(this->Surroundings, nullptr, this->Front));
  this->Lights.fill(material, *property);
  expectVector(property->GetAmbientColor(), V(1, 1, 1), "no more than white");
  EXPECT_EQ(property->GetSpecular(), 1) << "no more than all";
  EXPECT_EQ(property->GetSpecularPower(), 20);
  this->Surroundings.lights[0].diffuse = V(0, 0, 0);
  this->Lights.show(this->Surroundings, nullptr, this->Front);
  this->Lights.fill(material, *property);
  EXPECT_EQ(property->GetSpecular(), 1) << "nothing to compare with";
  material.emission = V(0.05, 0.1, 0);
  this->Lights.setSceneLights(false);
  this->Lights.show(this->Surroundings, nullptr, this->Front);
  this->Lights.fill(material, *property);
  expectVector(property->GetAmbientColor(), V(0.05 + 0.125, 0.1 + 0.15, 0.2), "head");
  EXPECT_EQ(property->GetDiffuse(), 0.85);
  EXPECT_EQ(property->GetSpecular(), 0.5);
}

TEST_F(ViewLightsTable, Backgrounds)
{
  this->Surroundings.background = V(0.25, 0.5, 0.75);
  this->Lights.show(this->Surroundings, nullptr, this->Front);
  expectVector(this->Renderer->GetBackground(), V(0.25, 0.5, 0.75));
  EXPECT_FALSE(this->Renderer->GetGradientBackground());
  this->Lights.setSceneLights(false);
  this->Lights.show(this->Surroundings, nullptr, this->Front);
  expectVector(this->Renderer->GetBackground(), V(0, 0, 0), "the renderer's own");
  EXPECT_TRUE(this->Renderer->GetGradientBackground());
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
  EXPECT_DOUBLE_EQ(all[9]->GetScale()[0], lightRadius(this->Places));
  EXPECT_TRUE(all[9]->GetVisibility());
  expectVector(all[10]->GetProperty()->GetColor(), V(0.35, 0.35, 0.35), "not enabled");
  EXPECT_FALSE(all[10]->GetVisibility()) << "it has no place";

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
    for (vtkActor* const actor : actorsOf(renderer))
    {
      auto* const mapper = vtkGlyph3DMapper::SafeDownCast(actor->GetMapper());
      if (mapper != nullptr)
      {
        EXPECT_TRUE(together);
        EXPECT_EQ(vtkPolyData::SafeDownCast(mapper->GetInput())->GetNumberOfPoints(), 16);
        EXPECT_TRUE(actor->GetVisibility());
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
