// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkEyeLens.h"
#include "dgtkRaySource.h"
#include "dgtkSight.h"
#include "dgtkTimedSight.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace dgtk;
using Eigen::Vector2d;
using Eigen::Vector3d;

CameraRecord makeRecord(const char* model)
{
  CameraRecord record;
  record.name = "c";
  record.width = 64;
  record.height = 48;
  record.K << 80, 0, 30, 0, 70, 25, 0, 0, 1;
  record.R << 0, 0, -1, 0, 1, 0, 1, 0, 0; // looks along +x
  record.t << 0.5, -0.25, 2;
  record.model = model;
  record.near = 0.1;
  record.far = 100;
  return record;
}

TEST(Eye, UnprojectsWhatItProjects)
{
  for (const char* model : { "pinhole", "orthographic" })
  {
    const Eye eye(makeRecord(model), nullptr);
    for (const double depth : { 0.5, 7.0 })
    {
      const Vector2d pixel(11.25, 40.5);
      const Vector3d x = eye.at(pixel, depth);
      EXPECT_EQ(x.z(), depth);
      Vector2d back;
      ASSERT_TRUE(eye.project(x, back));
      EXPECT_LT((back - pixel).norm(), 1e-12) << model;
      EXPECT_LT((eye.toCamera(eye.toWorld(x)) - x).norm(), 1e-14);
    }
    Vector2d none(-1, -1);
    EXPECT_FALSE(eye.project({ 0, 0, -1 }, none));
    EXPECT_EQ(none.x(), -1);
  }
}

TEST(Eye, SkewAndOffsetByHand)
{
  CameraRecord record = makeRecord("pinhole");
  record.K(0, 1) = 4;
  const Eye eye(record, nullptr);
  Vector2d pixel;
  ASSERT_TRUE(eye.project({ 1, -2, 4 }, pixel));
  EXPECT_DOUBLE_EQ(pixel.x(), 80 * 0.25 + 4 * -0.5 + 30);
  EXPECT_DOUBLE_EQ(pixel.y(), 70 * -0.5 + 25);
}

/// Two triangles that face a camera at the origin, the second one twice as far; either may move.
std::shared_ptr<SceneState> makeState(bool deformed)
{
  auto model = std::make_shared<Model>();
  auto rest = std::make_shared<Geometry>();
  rest->positions = { { -1, -1, 2 }, { 1, -1, 2 }, { 0, 2, 2 }, { -1, -1, 4 }, { 1, -1, 4 }, { 0, 2, 4 } };
  rest->normals.assign(6, Eigen::Vector3f(0, 0, -1));
  model->rest = rest;
  model->triangles = { { 0, 1, 2 }, { 3, 4, 5 } };
  model->materials.resize(1);
  model->parts = { { "p", 0, 0, 2 } };
  auto geometry = std::make_shared<Geometry>(*rest);
  if (deformed)
  {
    geometry->positions[2] = { 0, 4, 2 };
  }
  auto state = std::make_shared<SceneState>();
  Instance instance;
  instance.model = model;
  instance.geometry = deformed ? geometry : rest;
  instance.materials = std::make_shared<std::vector<Material>>(model->materials);
  state->instances.push_back(instance);
  return state;
}

Sight makeSight(const std::shared_ptr<SceneState>& state)
{
  CameraRecord record = makeRecord("pinhole");
  record.R.setIdentity();
  record.t.setZero();
  std::unique_ptr<OcclusionQuery> query = makeOcclusionQuery();
  query->setScene(state);
  return Sight(Eye(record, nullptr), state, std::move(query));
}

TEST(Sight, DepthsOfAllSurfaces)
{
  const Sight sight = makeSight(makeState(false));
  std::vector<Hit> hits;
  std::vector<double> depths;
  sight.surfaces({ 30, 25 }, hits, depths);
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_EQ(hits[0], (Hit{ 1, 0 }));
  EXPECT_DOUBLE_EQ(depths[0], 2);
  EXPECT_DOUBLE_EQ(depths[1], 4);
  EXPECT_TRUE(std::isinf(sight.depthOf({}, { 30, 25 })));
  EXPECT_LT((sight.weights({ 1, 0 }, { 0, 0, 2 }) - Vector3d(1, 1, 1) / 3).norm(), 1e-15);
}

// The plane of a triangle, z = 2 + 3 x, is met behind the camera by rays that turn away from it.
TEST(Sight, DepthsBehindTheCameraAreNone)
{
  const auto state = makeState(false);
  auto geometry = std::make_shared<Geometry>(*state->instances[0].geometry);
  for (Vector3d& position : geometry->positions)
  {
    position.z() += 3 * position.x();
  }
  state->instances[0].geometry = geometry;
  const Sight sight = makeSight(state);
  EXPECT_DOUBLE_EQ(sight.depthOf({ 1, 0 }, { 30, 25 }), 2);
  EXPECT_NEAR(sight.depthOf({ 1, 0 }, { 30 + 80 * 0.25, 25 }), 2 / 0.25, 1e-13);
  EXPECT_NEAR(sight.depthOf({ 1, 0 }, { 30 - 80, 25 }), 0.5, 1e-15);
  EXPECT_TRUE(std::isinf(sight.depthOf({ 1, 0 }, { 30 + 80 * 0.5, 25 })));
  const Vector3d expected = Vector3d(3, 0, -1).normalized();
  EXPECT_NEAR(std::abs(sight.normal({ 1, 1 }).normalized().dot(expected)), 1, 1e-15);
  EXPECT_LT((sight.weights({ 1, 0 }, { 0.5, 0.5, 3.5 }) - Vector3d(0, 0.5, 0.5)).norm(), 1e-15);
}

TEST(Carried, FollowsPlacementAndDeformation)
{
  const auto before = makeState(false);
  const Sight sight = makeSight(before);
  const Vector3d point(0.25, 0.5, 2);

  auto moved = std::make_shared<SceneState>(*before); // the same geometry, placed elsewhere
  moved->instances[0].world_from_object.linear = Vector3d(2, 3, -1).asDiagonal();
  moved->instances[0].world_from_object.translation = { 0, 0, 5 };
  const Carried rigid = carried(sight, moved->instances[0], { 1, 0 }, point);
  ASSERT_TRUE(rigid.ok);
  EXPECT_LT((rigid.x_in_world - Vector3d(0.5, 1.5, 3)).norm(), 1e-14);

  auto bent = makeState(true);
  bent->instances[0].model = before->instances[0].model;
  const Carried deformed = carried(sight, bent->instances[0], { 1, 0 }, point);
  ASSERT_TRUE(deformed.ok);
  // The top corner has weight 1/2 there and rises by 2.
  EXPECT_LT((deformed.x_in_world - Vector3d(0.25, 1.5, 2)).norm(), 1e-14);
}

TEST(Carried, EachObjectHasItsOwnWay)
{
  const auto before = makeState(false);
  before->instances.push_back(before->instances[0]);
  before->instances[1].world_from_object.translation = { 1, 0, 0 };
  before->instances.push_back(before->instances[0]);
  before->instances[2].world_from_object.linear.col(2).setZero();
  const Sight sight = makeSight(before);
  auto after = std::make_shared<SceneState>(*before);
  after->instances[0].world_from_object.translation = { 0, 0, 5 };
  after->instances[1].world_from_object.translation = { 1, 3, 0 };
  after->instances[2].world_from_object = {};
  const Carried first = carried(sight, after->instances[0], { 1, 0 }, { 0.25, 0.5, 2 });
  const Carried second = carried(sight, after->instances[1], { 2, 1 }, { 0.25, 0.5, 2 });
  ASSERT_TRUE(first.ok && second.ok);
  EXPECT_LT((first.x_in_world - Vector3d(0.25, 0.5, 7)).norm(), 1e-14);
  EXPECT_LT((second.x_in_world - Vector3d(0.25, 3.5, 2)).norm(), 1e-14);
  EXPECT_FALSE(carried(sight, after->instances[2], { 3, 0 }, { 0.25, 0.5, 0 }).ok) << "it was flat";
}

TEST(TimedSight, HasTheTimesOfItsRecord)
{
  using Direction = RollingShutter::Direction;
  const auto timeAt = [](Direction direction, double x, double y)
  {
    CameraRecord record;
    record.width = 40;
    record.height = 20;
    record.K << 30, 0, 20, 0, 30, 10, 0, 0, 1;
    record.near = 0.1;
    record.far = 100;
    record.rollingShutter = { 0.5, direction };
    const auto state = makeState(false);
    class Still final : public InstantSource
    {
      double frame() const override { return 7; }
      Instant at(double) const override { return {}; }
      Instance instanceAt(double, std::uint32_t) const override { return {}; }
      const std::vector<Motion>& motions() const override { return this->None; }
      bool isVisibleAt(double, std::uint32_t) const override { return true; }
      Rigid3 poseAt(double) const override { return {}; }
      Affine3 placeAt(double, std::uint32_t) const override { return {}; }
      Point pointAt(double, std::uint32_t, std::uint32_t, const Vector2d&) const override { return {}; }
      std::vector<Motion> None;
    };
    return TimedSight(std::make_shared<Sight>(Eye(record, nullptr), state, nullptr), std::make_shared<Still>(), nullptr)
      .timeAt({ x, y });
  };
  EXPECT_DOUBLE_EQ(timeAt(Direction::Down, 3, 5), -0.125);
  EXPECT_DOUBLE_EQ(timeAt(Direction::Up, 3, 5), 0.125);
  EXPECT_DOUBLE_EQ(timeAt(Direction::Right, 10, 2), -0.125);
  EXPECT_DOUBLE_EQ(timeAt(Direction::Left, 10, 2), 0.125);
  EXPECT_DOUBLE_EQ(timeAt(Direction::Down, 3, -5), -0.25) << "beside the image as its border";
  EXPECT_DOUBLE_EQ(timeAt(Direction::Left, 50, 5), -0.25);
}

/// Numbers of the world lose digits where the camera is far from its origin.
TEST(Eye, FarCameras)
{
  CameraRecord record;
  record.width = record.height = 4;
  record.t = Vector3d(0, 3e4, 4e4);
  const Eye eye(record, nullptr);
  EXPECT_EQ(eye.farness(50), 1);
  EXPECT_EQ(eye.farness(5), 10);
  EXPECT_EQ(eye.farness(-5), 10);
}

/// Pixels that a small angle is worth: of a parallel projection, that a part of the depth is.
TEST(Eye, ReachesOfCameras)
{
  CameraRecord record;
  record.width = 64;
  record.height = 48;
  record.K << 80, 0, 30, 0, 40, 25, 0, 0, 1;
  record.near = 1;
  record.far = 9;
  const Vector3d x(0, 0, 5);
  const auto reach = [&](const char* model)
  {
    record.model = model;
    return Eye(record, nullptr).reach(0.5, x);
  };
  EXPECT_EQ(reach("pinhole"), Vector2d(40, 20));
  EXPECT_EQ(reach("orthographic"), Vector2d(200, 100));
  EXPECT_EQ(reach("fisheye"), Vector2d(40, 24)) << "at least that of the picture's size";
}

TEST(Eye, SeesWhatIsInThePictureAndBetweenItsLimits)
{
  CameraRecord record = makeRecord("pinhole");
  record.near = 2;
  record.far = 8;
  const Eye eye(record, nullptr);
  const auto sees = [&](double u, double v, double depth) { return eye.sees({ u, v }, eye.at({ u, v }, depth)); };
  for (const double depth : { 2.0, 5.0, 8.0 })
  {
    EXPECT_TRUE(sees(0, 0, depth)) << depth;
    EXPECT_TRUE(sees(64, 48, depth)) << depth;
  }
  EXPECT_FALSE(sees(30, 25, 1.99));
  EXPECT_FALSE(sees(30, 25, 8.01));
  for (const auto& [u, v] : { std::pair(-0.01, 25.0), { 64.01, 25 }, { 30, -0.01 }, { 30, 48.01 } })
  {
    EXPECT_FALSE(sees(u, v, 5)) << u << ' ' << v;
  }
}

/// Either side of the seam of a picture of all directions is one place.
TEST(Eye, SeamsOfLenses)
{
  CameraRecord record;
  record.model = "equirectangular";
  record.hasK = false;
  record.width = 8;
  record.height = 4;
  const auto lens = EyeLens::of(record);
  ASSERT_TRUE(lens);
  for (const auto& [off, seam] : { std::pair(1e-10, 8.0), { 1e-8, 0.0 } })
  {
    EXPECT_EQ(lens->seam({ off, 1 }), seam);
    EXPECT_EQ(lens->seam({ 8 - off, 1 }), seam);
  }
  record.model = "pinhole";
  record.hasK = true;
  record.numbers["distortion"] = { 0.1, 0, 0, 0 };
  const auto plain = EyeLens::of(record);
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->seam({ 0, 1 }), 0);
}
} // namespace
