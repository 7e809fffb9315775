// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMeshClusters.h"
#include "dgtkScenePlaces.h"
#include "dgtkViewLines.h"

#include "dgtkCameraEntry.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace
{
using namespace dgtk;

using V = Eigen::Vector3d;
constexpr double placeTolerance = 1e-12; // world units

void expectLines(const LineList& lines, const LineList& expected)
{
  ASSERT_EQ(lines.size(), expected.size());
  for (std::size_t i = 0; i < lines.size(); ++i)
  {
    EXPECT_LT((lines[i].first - expected[i].first).norm(), placeTolerance) << i << ": " << lines[i].first.transpose();
    EXPECT_LT((lines[i].second - expected[i].second).norm(), placeTolerance)
      << i << ": " << lines[i].second.transpose();
  }
}

WorldBox boxOf(const V& low, const V& high)
{
  WorldBox box;
  box.add(low);
  box.add(high);
  return box;
}

LineList edgesOf(const V& a, const V& b)
{
  const double x[2] = { a.x(), b.x() };
  const double y[2] = { a.y(), b.y() };
  const double z[2] = { a.z(), b.z() };
  const auto at = [&](int i, int j, int k) { return V(x[i], y[j], z[k]); };
  return { { at(0, 0, 0), at(1, 0, 0) }, { at(0, 0, 0), at(0, 1, 0) }, { at(0, 0, 0), at(0, 0, 1) },
    { at(1, 0, 0), at(1, 1, 0) }, { at(1, 0, 0), at(1, 0, 1) }, { at(0, 1, 0), at(1, 1, 0) },
    { at(0, 1, 0), at(0, 1, 1) }, { at(1, 1, 0), at(1, 1, 1) }, { at(0, 0, 1), at(1, 0, 1) },
    { at(0, 0, 1), at(0, 1, 1) }, { at(1, 0, 1), at(1, 1, 1) }, { at(0, 1, 1), at(1, 1, 1) } };
}

/// A camera at (0, 0, 10) that looks at the origin with an image of 200 x 100, half of its height a third of its depth.
SceneDescription lookout()
{
  SceneDescription scene;
  scene.cameras.resize(3);
  scene.cameras[0].name = "eye";
  scene.cameras[0].width = 200;
  scene.cameras[0].height = 100;
  scene.cameras[0].fovY = 2 * std::atan(1.0 / 3) * 180 / M_PI;
  scene.cameras[1].name = "beam";
  scene.cameras[1].model = "orthographic";
  scene.cameras[1].width = 200;
  scene.cameras[1].height = 100;
  scene.cameras[1].viewHeight = 4;
  scene.cameras[1].near = 0;
  scene.cameras[2].name = "lost";
  scene.cameras[2].eye = V(0, 5, 0);
  scene.cameras[2].lookAt = V(0, 5, 0);
  scene.lights.resize(2);
  scene.lights[0].position = V(30, 40, 10);
  scene.lights[1].kind = LightKind::Directional;
  scene.lights[1].position = V(1000, 0, 0);
  return scene;
}

TEST(ViewLines, Boxes)
{
  LineList lines;
  addBox(lines, boxOf({ 1, 2, 3 }, { 10, 20, 30 }));
  expectLines(lines, edgesOf({ 1, 2, 3 }, { 10, 20, 30 }));
}

TEST(ViewLines, FrustaOfEachKind)
{
  const ScenePlaces places = placeScene(lookout(), ModelLibrary(), 0);
  ASSERT_TRUE(places.cameras[0].valid);
  LineList lines;
  addFrustum(lines, places.cameras[0], 3);
  const V eye(0, 0, 10);
  const V corner[] = { { -2, 1, 7 }, { 2, 1, 7 }, { 2, -1, 7 }, { -2, -1, 7 } };
  const V mark(0, 1.5, 7);
  expectLines(lines, { { eye, corner[0] }, { corner[0], corner[1] }, { eye, corner[1] }, { corner[1], corner[2] },
                       { eye, corner[2] }, { corner[2], corner[3] }, { eye, corner[3] }, { corner[3], corner[0] },
                       { corner[0], mark }, { corner[1], mark } });
  lines.clear();
  addFrustum(lines, places.cameras[1], 3);
  const V near[] = { { -4, 2, 10 }, { 4, 2, 10 }, { 4, -2, 10 }, { -4, -2, 10 } };
  const V far[] = { { -4, 2, 7 }, { 4, 2, 7 }, { 4, -2, 7 }, { -4, -2, 7 } };
  const V top(0, 3, 7);
  expectLines(
    lines, { { near[0], far[0] }, { far[0], far[1] }, { near[0], near[1] }, { near[1], far[1] }, { far[1], far[2] },
             { near[1], near[2] }, { near[2], far[2] }, { far[2], far[3] }, { near[2], near[3] }, { near[3], far[3] },
             { far[3], far[0] }, { near[3], near[0] }, { far[0], top }, { far[1], top } });
  lines.clear();
  EXPECT_FALSE(places.cameras[2].valid);
  addFrustum(lines, places.cameras[2], 3);
  EXPECT_TRUE(lines.empty());
}

TEST(ViewLines, AFisheyeIsItsBorder)
{
  CameraPlace place;
  place.valid = true;
  Eigen::Matrix3d K;
  K << 10, 0, 50, 0, 10, 40, 0, 0, 1; // its circle is within the image
  place.view.model = makeCamera("fisheye", { 100, 80, K, { { "distortion", { -0.1, 0, 0, 0 } } } });
  LineList lines;
  addFrustum(lines, place, 3);
  EXPECT_EQ(lines.size(), 4u + 48u);
  const double last = std::sqrt(10.0 / 3); // where angle - angle^3 / 10 turns
  for (const auto& [from, to] : lines)
  {
    EXPECT_TRUE(from.isZero(0) || std::abs(from.norm() - 3) < placeTolerance);
    EXPECT_NEAR(to.z(), 3 * std::cos(last), 0.02); // where rays turn fastest
  }
}

/// Where the lens sees the whole image: the corners, and twelve parts of each side, clockwise from the top left.
TEST(ViewLines, ABentPictureIsItsBorder)
{
  CameraPlace place;
  place.valid = true;
  Eigen::Matrix3d K;
  K << 90, 0, 45, 0, 80, 42, 0, 0, 1;
  place.view.model = makeCamera("pinhole", { 96, 84, K, { { "distortion", { 0.1, 0, 0, 0 } } } });
  ASSERT_FALSE(place.view.model->linear().has_value());
  LineList lines;
  addFrustum(lines, place, 3);
  ASSERT_EQ(lines.size(), 4u + 48u);
  std::vector<Eigen::Vector2d> border;
  for (int i = 0; i < 12; ++i)
  {
    border.insert(border.begin() + i, { 8.0 * i, 0 });
    border.insert(border.begin() + 2 * i + 1, { 96, 7.0 * i });
    border.insert(border.begin() + 3 * i + 2, { 96 - 8.0 * i, 84 });
    border.emplace_back(0, 84 - 7.0 * i);
  }
  const auto expectSeen = [&](const V& point, std::size_t i)
  {
    Eigen::Vector2d pixel;
    ASSERT_TRUE(place.view.model->project(point, pixel));
    EXPECT_LT((pixel - border[i % 48]).norm(), 1e-6) << i;
    EXPECT_NEAR(point.norm(), 3, placeTolerance);
  };
  for (std::size_t i = 0; i < 4; ++i)
  {
    EXPECT_TRUE(lines[i].first.isZero(0));
    expectSeen(lines[i].second, 12 * i);
  }
  for (std::size_t i = 0; i < 48; ++i)
  {
    expectSeen(lines[4 + i].first, i);
    expectSeen(lines[4 + i].second, i + 1);
  }
}

TEST(ViewLines, SizesGoWithTheScene)
{
  const ScenePlaces places = placeScene(lookout(), ModelLibrary(), 0);
  // A light that comes from everywhere is nowhere: (0, 0, 0), (0, 0, 10), (0, 5, 0), (30, 40, 10)
  EXPECT_EQ(places.box.min, V(0, 0, 0));
  EXPECT_EQ(places.box.max, V(30, 40, 10));
  const double length = 0.04 * std::sqrt(900 + 1600 + 100.0);
  EXPECT_NEAR(frustumLength(places), length, placeTolerance);
  EXPECT_NEAR(lightRadius(places), 0.3 * length, placeTolerance);
  EXPECT_NEAR(frustumLength(ScenePlaces()), 0.04, placeTolerance);
  EXPECT_NEAR(lightRadius(ScenePlaces()), 0.012, placeTolerance);

  const SceneItem light{ SceneItem::Kind::Light, 0 };
  const SceneItem eye{ SceneItem::Kind::Camera, 0 };
  const SceneItem lost{ SceneItem::Kind::Camera, 2 };
  WorldBox drawn = drawnBox(places, light);
  EXPECT_LT((drawn.min - V(30 - length, 40 - length, 10 - length)).norm(), placeTolerance);
  EXPECT_LT((drawn.max - V(30 + length, 40 + length, 10 + length)).norm(), placeTolerance);
  drawn = drawnBox(places, eye);
  EXPECT_LT((drawn.min - length / 3 * V(-2, -1, -3) - V(0, 0, 10)).norm(), placeTolerance) << drawn.min.transpose();
  EXPECT_LT((drawn.max - length / 3 * V(2, 1.5, 0) - V(0, 0, 10)).norm(), placeTolerance) << drawn.max.transpose();
  drawn = drawnBox(places, lost);
  EXPECT_LT((drawn.min - V(-length, 5 - length, -length)).norm(), placeTolerance);
  EXPECT_TRUE(drawnBox(places, { SceneItem::Kind::Object, 0 }).empty());
  EXPECT_TRUE(drawnBox(places, { SceneItem::Kind::Light, 2 }).empty());

  LineList expected;
  addFrustum(expected, places.cameras[0], length);
  const V margin = V::Constant(1.4 * 0.3 * length);
  const LineList about = edgesOf(V(30, 40, 10) - margin, V(30, 40, 10) + margin);
  expected.insert(expected.end(), about.begin(), about.end());
  expectLines(selectionLines(places, { eye, light, lost, { SceneItem::Kind::Camera, 3 } }), expected);
}

TEST(ViewLines, GridsHaveRoundSteps)
{
  for (const auto& [extent, step] : { std::pair(20.0, 1.0), std::pair(20.2, 2.0), std::pair(39.0, 2.0),
         std::pair(41.0, 5.0), std::pair(99.0, 5.0), std::pair(101.0, 10.0), std::pair(199.0, 10.0),
         std::pair(201.0, 20.0), std::pair(0.03, 0.002), std::pair(0.019, 0.001) })
  {
    EXPECT_NEAR(gridStep(extent), step, 1e-12 * step) << extent;
  }
  LineList lines;
  addGrid(lines, { 1, 2, 3 }, { 1, 0, 0 }, { 0, 0, 1 }, 25); // squares of 2, 7 on each side
  ASSERT_EQ(lines.size(), 30u);
  expectLines({ lines[0], lines[1], lines[28], lines[29] },
    { { { -13, 2, -11 }, { -13, 2, 17 } }, { { -13, 2, -11 }, { 15, 2, -11 } }, { { 15, 2, -11 }, { 15, 2, 17 } },
      { { -13, 2, 17 }, { 15, 2, 17 } } });
  expectLines({ lines[2] }, { { { -11, 2, -11 }, { -11, 2, 17 } } });
}

TEST(ScenePlaces, BoxesOfItemsAndFieldsOfView)
{
  SceneDescription scene = lookout();
  scene.objects.resize(3);
  scene.objects[0].name = "crate";
  scene.objects[0].model = test::sourceFile("Data/Models/crate.ac");
  scene.objects[0].position = V(10, 0, 0);
  scene.objects[0].scale = V(2, 4, 6);
  scene.objects[1] = scene.objects[0];
  scene.objects[1].name = "hidden";
  scene.objects[1].visible = false;
  scene.objects[1].position = V(500, 0, 0);
  scene.objects[2].name = "child";
  scene.objects[2].model = scene.objects[0].model;
  scene.objects[2].parent = "crate";
  scene.objects[2].position = V(0, 1, 0);
  ModelLibrary models;
  models.load(scene);
  const ScenePlaces places = placeScene(scene, models, 3);
  EXPECT_EQ(places.frame, 3);
  const ObjectPlace& crate = places.objects[0];
  const V half = (crate.box.max - crate.box.min).cwiseQuotient(V(2, 4, 6)) / 2;
  EXPECT_EQ(crate.instance.name, "crate");
  EXPECT_TRUE(crate.visible);
  EXPECT_FALSE(places.objects[1].visible);
  EXPECT_EQ(crate.world_from_parent.linear, Eigen::Matrix3d(Eigen::Matrix3d::Identity()));
  EXPECT_EQ(places.objects[2].world_from_parent.linear, Eigen::Matrix3d(V(2, 4, 6).asDiagonal()));
  EXPECT_EQ(places.objects[2].world_from_parent.translation, V(10, 0, 0));
  EXPECT_EQ(places.objects[2].instance.world_from_object.translation, V(10, 4, 0));
  EXPECT_GT(half.minCoeff(), 0.1);
  EXPECT_LT((places.objects[1].box.min - crate.box.min - V(490, 0, 0)).norm(), 1e-9);
  EXPECT_LT(places.box.max.x(), 100) << "what is not visible is not there";
  scene.objects[1].visible.keys = { { 0, false }, { 4, true } };
  EXPECT_FALSE(placeScene(scene, models, 3).objects[1].visible);
  EXPECT_TRUE(placeScene(scene, models, 4).objects[1].visible);
  EXPECT_GT(placeScene(scene, models, 4).box.max.x(), 400);
  WorldBox all = crate.box;
  all.add(places.objects[2].box);
  all.add(boxOf({ 0, 0, 0 }, { 30, 40, 10 })); // lights and cameras
  EXPECT_EQ(places.box.min, all.min);
  EXPECT_EQ(places.box.max, all.max);
  EXPECT_LT(all.min.z(), -1);
  const WorldBox found = places.boxOf({ SceneItem::Kind::Object, 0 });
  EXPECT_EQ(found.min, crate.box.min);
  EXPECT_EQ(found.max, crate.box.max);
  EXPECT_EQ(places.boxOf({ SceneItem::Kind::Light, 0 }).min, V(30, 40, 10));
  EXPECT_EQ(places.boxOf({ SceneItem::Kind::Camera, 0 }).max, V(0, 0, 10));
  for (const SceneItem::Kind kind : { SceneItem::Kind::Object, SceneItem::Kind::Light, SceneItem::Kind::Camera })
  {
    EXPECT_TRUE(places.boxOf({ kind, 3 }).empty());
  }
  EXPECT_EQ(WorldBox().diagonal(), 0);
  EXPECT_EQ(boxOf({ 0, 0, 0 }, { 2, 3, 6 }).diagonal(), 7);
  CameraDescription camera;
  camera.width = 640;
  camera.height = 400;
  camera.K = Eigen::Matrix3d(V(300, 200, 1).asDiagonal());
  EXPECT_NEAR(fieldOfViewOf(camera).value(), 90, placeTolerance);
}

TEST(ScenePlaces, SurroundingsAreAsTheSceneSays)
{
  SceneDescription scene;
  scene.background = V(0.25, 0.5, 0.75);
  scene.fog.color = V(0.1, 0.2, 0.3);
  scene.fog.density = 0.5;
  scene.fog.start = 7;
  scene.upAxis = UpAxis::Z;
  scene.lights.resize(2);
  scene.lights[0].name = "a";
  scene.lights[0].position.keys = { { 0, V(0, 0, 0) }, { 10, V(10, 20, 30) } };
  scene.lights[1].name = "b";
  scene.lights[1].intensity = 0.5;
  const ScenePlaces places = placeScene(scene, ModelLibrary(), 4);
  const SceneState& found = *places.surroundings;
  EXPECT_EQ(found.background, V(0.25, 0.5, 0.75));
  ASSERT_TRUE(found.fog.density > 0);
  EXPECT_EQ(found.fog.color, V(0.1, 0.2, 0.3));
  EXPECT_EQ(found.fog.density, 0.5);
  EXPECT_EQ(found.fog.start, 7);
  ASSERT_EQ(found.lights.size(), 2u);
  EXPECT_EQ(found.lights[0].position, V(4, 8, 12));
  EXPECT_EQ(found.lights[1].intensity, 0.5);
  EXPECT_EQ(places.lights[0], V(4, 8, 12));
}

/// Files of single precision leave a little of a model's centre; more than a millionth of its size is meant.
TEST(ScenePlaces, CentresBesideTheOriginAreMeant)
{
  const test::TemporaryFolder folder;
  for (const bool isMeant : { false, true })
  {
    std::ofstream(folder.path("m.ac")) << "AC3Db\nOBJECT poly\nnumvert 3\n-1 -1 0\n1.00000" << (isMeant ? "8" : "4")
                                       << " 1 0\n-1 1 0\nnumsurf 1\nSURF 0x00\nrefs 3\n0\n1\n2\nkids 0\n";
    SceneDescription scene;
    scene.objects.resize(1);
    scene.objects[0].name = "m";
    scene.objects[0].model = folder.path("m.ac");
    scene.objects[0].position = V(5, 6, 7);
    scene.objects[0].scale = V(2, 2, 2);
    ModelLibrary models;
    models.load(scene);
    const ObjectPlace place = placeScene(scene, models, 0).objects[0];
    EXPECT_EQ(place.center != V(5, 6, 7), isMeant);
    EXPECT_NEAR(place.center.x(), isMeant ? 5.000008 : 5, 1e-12);
  }
}

TEST(ScenePlaces, PicksTheNearestOfWhatIsMet)
{
  SceneDescription scene;
  scene.objects.resize(2);
  for (int i = 0; i < 2; ++i)
  {
    scene.objects[std::size_t(i)].name = i == 0 ? "near" : "far";
    scene.objects[std::size_t(i)].model = test::sourceFile("Data/Models/crate.ac");
    scene.objects[std::size_t(i)].position = V(0, 0, -10.0 * i);
  }
  scene.lights.resize(2);
  scene.lights[0].position = V(0, 0, 5);
  scene.lights[1].position = V(0, 0, -20);
  scene.cameras.resize(1);
  scene.cameras[0].eye = V(0, 0, 7);
  ModelLibrary models;
  models.load(scene);
  const ScenePlaces places = placeScene(scene, models, 0);
  const double front = places.objects[0].box.max.z();
  const auto pick =
    [&](const V& origin, const V& direction, double least = 0, double most = std::numeric_limits<double>::infinity())
  {
    const auto item = pickItem(places, { origin, direction, least, most }, { 0.5, 0 });
    return item ? std::string(item->kind == SceneItem::Kind::Object  ? "object"
                              : item->kind == SceneItem::Kind::Light ? "light"
                                                                     : "camera") +
                    std::to_string(item->index)
                : std::string("nothing");
  };
  EXPECT_EQ(pick({ 0, 0, 20 }, { 0, 0, -1 }), "camera0");
  EXPECT_EQ(pick({ 0, 0, 20 }, { 0, 0, -2 }, 6.4), "camera0");
  EXPECT_EQ(pick({ 0, 0, 20 }, { 0, 0, -2 }, 6.6), "light0");
  EXPECT_EQ(pick({ 0, 0, 20 }, { 0, 0, -2 }, 7.6), "object0");
  EXPECT_EQ(pick({ 0, 0, 20 }, { 0, 0, -2 }, 14), "object1");
  EXPECT_EQ(pick({ 0, 0, 20 }, { 0, 0, -2 }, 18), "light1");
  EXPECT_EQ(pick({ 0, 0, 20 }, { 0, 0, -1 }, 16, 20 - front - 0.01), "nothing");
  EXPECT_EQ(pick({ 0, 0, 20 }, { 0, 0, -1 }, 16, 20 - front + 0.01), "object0");
  EXPECT_EQ(pick({ 0, 0, 6 }, { 0, 0, 1 }), "camera0");
  EXPECT_EQ(pick({ 0, 0, 8 }, { 0, 0, 1 }), "nothing");
  EXPECT_EQ(pick({ 0.49, 0, 20 }, { 0, 0, -1 }), "camera0");
  EXPECT_NE(pick({ 0.51, 0, 20 }, { 0, 0, -1 }), "camera0");
  EXPECT_EQ(pick({ 0, 0, 7 + 0.9e-6 }, { 0, 0, -1 }), "light0") << "the camera is at the eye";
  EXPECT_EQ(pick({ 0, 0, 7 + 1.1e-6 }, { 0, 0, -1 }), "camera0");
  ScenePlaces hidden = places;
  hidden.objects[0].visible = false;
  EXPECT_EQ(pickItem(hidden, { { 0, 0, 4 }, { 0, 0, -1 } }, { 0.5, 0 })->index, std::size_t(1));
}

/// A strip of four squares of 1 x 2: bottom vertices 0 to 4, top ones 5 to 9.
struct Strip
{
  Geometry geometry;
  Model model;
  Part part;

  Strip()
  {
    for (const double y : { 0.0, 2.0 })
    {
      for (int x = 0; x < 5; ++x)
      {
        this->geometry.positions.emplace_back(3 + x / 4.0, y / 4 - 2, 0.5); // cells may be anywhere, and small
      }
    }
    for (std::uint32_t i = 0; i < 4; ++i)
    {
      this->model.triangles.push_back({ i, i + 1, i + 6 });
      this->model.triangles.push_back({ i, i + 6, i + 5 });
    }
    this->part.triangles = 8;
  }
  std::optional<ClusteredPart> clustered(double side) const
  {
    const auto& p = this->geometry.positions;
    V low = p[0];
    V high = p[0];
    for (const V& x : p)
    {
      low = low.cwiseMin(x);
      high = high.cwiseMax(x);
    }
    return clusterPart(this->geometry, this->model, this->part, (high - low).norm() / side);
  }
};

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

TEST(MeshClusters, AStripByHand)
{
  Strip strip;
  const std::optional<ClusteredPart> half = strip.clustered(0.5);
  ASSERT_TRUE(half.has_value());
  const std::vector<std::uint32_t> sources{ 0, 2, 7, 5, 4, 9 };
  EXPECT_EQ(half->sources, sources);
  ASSERT_EQ(half->positions.size(), sources.size());
  for (std::size_t i = 0; i < sources.size(); ++i)
  {
    EXPECT_EQ(half->positions[i], strip.geometry.positions[sources[i]]);
  }
  EXPECT_EQ(half->triangles, (Triangles{ { 0, 1, 2 }, { 0, 2, 3 }, { 1, 4, 5 }, { 1, 5, 2 } }));
  strip.model.triangles[0] = { 1, 6, 0 }; // its first and its last corner become one
  EXPECT_EQ(strip.clustered(0.5)->triangles, half->triangles);
  EXPECT_FALSE(strip.clustered(0.25).has_value()) << "nothing is saved";
  EXPECT_FALSE(strip.clustered(1.25).has_value()) << "nothing is left";

  // The second half of the strip is another part.
  strip.part.firstTriangle = 4;
  strip.part.triangles = 4;
  const std::optional<ClusteredPart> part = strip.clustered(0.5);
  ASSERT_TRUE(part.has_value());
  EXPECT_EQ(part->sources, (std::vector<std::uint32_t>{ 2, 4, 9, 7 }));
  EXPECT_EQ(part->triangles, (Triangles{ { 0, 1, 2 }, { 0, 2, 3 } }));
}

TEST(MeshClusters, SeamsKeepTheirTwoSides)
{
  for (const int seam : { 0, 1, 2 }) // none, in u, in v
  {
    // Vertices 2 and 7 again, for the right half of the strip.
    Strip strip;
    strip.geometry.positions.push_back(strip.geometry.positions[2]);
    strip.geometry.positions.push_back(strip.geometry.positions[7]);
    strip.model.uvs.assign(12, Eigen::Vector2d(0.25, 0.5));
    strip.model.uvs[10] = strip.model.uvs[11] = Eigen::Vector2d(seam == 1 ? 0.75 : 0.25, seam == 2 ? 0.75 : 0.5);
    for (std::size_t t = 4; t < 8; ++t)
    {
      for (std::uint32_t& corner : strip.model.triangles[t])
      {
        corner = corner == 2 ? 10 : corner == 7 ? 11 : corner;
      }
    }
    const std::optional<ClusteredPart> half = strip.clustered(0.5);
    ASSERT_TRUE(half.has_value());
    EXPECT_EQ(half->sources, seam > 0 ? (std::vector<std::uint32_t>{ 0, 2, 7, 5, 10, 4, 9, 11 })
                                      : (std::vector<std::uint32_t>{ 0, 2, 7, 5, 4, 9 }));
    EXPECT_EQ(half->triangles, seam > 0 ? (Triangles{ { 0, 1, 2 }, { 0, 2, 3 }, { 4, 5, 6 }, { 4, 6, 7 } })
                                        : (Triangles{ { 0, 1, 2 }, { 0, 2, 3 }, { 1, 4, 5 }, { 1, 5, 2 } }));
    EXPECT_EQ(half->positions[seam > 0 ? 4 : 1], strip.geometry.positions[2]);
  }
}

/// `kept` triangles of half a unit that stay, and `lost` ones of nearly as much that fall into one cell each.
std::optional<ClusteredPart> islandsOf(int kept, int lost)
{
  Strip parts;
  parts.geometry.positions.clear();
  parts.model.triangles.clear();
  for (int i = 0; i < kept + lost; ++i)
  {
    const double side = i < kept ? 1 : 0.98;
    const auto first = std::uint32_t(parts.geometry.positions.size());
    for (const V& corner : { V(0, 0, 0), V(side, 0, 0), V(0, side, 0) })
    {
      parts.geometry.positions.push_back(corner + V(3 * (i % 4), 3 * (i / 4), 0));
    }
    parts.model.triangles.push_back({ first, first + 1, first + 2 });
  }
  parts.part.triangles = std::uint32_t(kept + lost);
  return parts.clustered(1);
}

TEST(MeshClusters, HalfTheAreaAndSevenTenthsOfTheTriangles)
{
  EXPECT_TRUE(islandsOf(3, 3).has_value()) << "1.5 of 2.94";
  EXPECT_FALSE(islandsOf(3, 4).has_value()) << "1.5 of 3.42";
  EXPECT_TRUE(islandsOf(7, 3).has_value());
  EXPECT_FALSE(islandsOf(8, 3).has_value());
  EXPECT_EQ(islandsOf(7, 3)->triangles.size(), 7u);
}

} // namespace
