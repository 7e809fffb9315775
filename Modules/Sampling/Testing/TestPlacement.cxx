// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPlaceSamples.h"

#include "dgtkPlaceBody.h"
#include "dgtkPlaceWorld.h"
#include "dgtkSampleGeometry.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>

namespace
{
using namespace dgtk;
using testing::HasSubstr;

/// A box about the origin.
SolidMesh boxMesh(double x, double y, double z)
{
  std::vector<Eigen::Vector3d> points;
  points.reserve(8);
  for (int i = 0; i < 8; ++i)
  {
    points.emplace_back((i & 1 ? 0.5 : -0.5) * x, (i & 2 ? 0.5 : -0.5) * y, (i & 4 ? 0.5 : -0.5) * z);
  }
  return solidMesh(points, { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 }, { 0, 5, 4 }, { 2, 6, 7 },
                             { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } });
}

PlaceBody bodyOf(
  const SolidMesh& mesh, const Eigen::Vector3d& at, const Eigen::Matrix3d& rotation = Eigen::Matrix3d::Identity())
{
  PlaceBody::Parameters made;
  made.name = "box";
  made.mesh = std::make_shared<const SolidMesh>(mesh);
  made.world_from_body = { rotation, at };
  return PlaceBody(std::move(made));
}

const Eigen::Vector3d down(0, -1, 0);

const ObjectDescription& object(const PlaceScene& made, const std::string& name)
{
  return *std::find_if(made.scene.objects.begin(), made.scene.objects.end(),
    [&](const ObjectDescription& one) { return one.name == name; });
}

Eigen::Matrix3d about(const Eigen::Vector3d& axis, double degrees)
{
  return Eigen::AngleAxisd(degrees * 3.14159265358979323846 / 180, axis).matrix();
}
} // namespace

TEST(PlaceBody, DepthsAreThoseOfOverlappingBoxes)
{
  const SolidMesh cube = boxMesh(1, 1, 1);
  const PlaceBody still = bodyOf(cube, { 0, 0, 0 });
  // Vertices of one are in the other.
  EXPECT_NEAR(penetration(bodyOf(cube, { 0.3, 0.9, 0.2 }), still).depth, 0.1, 1e-12);
  EXPECT_NEAR(penetration(still, bodyOf(cube, { 0.3, 0.9, 0.2 })).depth, 0.1, 1e-12);
  const Penetration over = penetration(bodyOf(cube, { 0.3, 0.9, 0.2 }), still);
  EXPECT_LT((over.out - Eigen::Vector3d(0, 1, 0)).norm(), 1e-9);
  // Edges alone cross: two bars.
  const SolidMesh bar = boxMesh(4, 0.2, 0.2);
  const PlaceBody across = bodyOf(bar, { 0.1, 0.15, 0.03 }, about({ 0, 1, 0 }, 90));
  EXPECT_NEAR(penetration(across, bodyOf(bar, { 0, 0, 0 })).depth, 0.05, 1e-12);
  // One wholly within the other, whose surfaces do not meet.
  EXPECT_NEAR(penetration(bodyOf(boxMesh(0.2, 0.2, 0.2), { 0.3, 0, 0 }), still).depth, 0.3, 1e-12);
  EXPECT_EQ(penetration(bodyOf(cube, { 0, 1.0001, 0 }), still).depth, 0);
  // A corner that points down: by how much it is below the surface.
  const Eigen::Matrix3d corner =
    about({ 1, 0, 0 }, std::atan(std::sqrt(0.5)) * 180 / 3.14159265358979323846) * about({ 0, 0, 1 }, 45);
  EXPECT_NEAR(penetration(bodyOf(cube, { 0.1, 0.5 + std::sqrt(0.75) - 0.02, 0.07 }, corner), still).depth, 0.02, 1e-9);
}

TEST(PlaceBody, WaysDownAreThoseOfBoxes)
{
  const SolidMesh cube = boxMesh(1, 1, 1);
  const PlaceBody still = bodyOf(cube, { 0, 0, 0 });
  EXPECT_NEAR(wayDown(bodyOf(cube, { 0.3, 1.25, 0.2 }), still, down, 10, 0), 0.25, 1e-12);
  EXPECT_EQ(wayDown(bodyOf(cube, { 1.01, 1.25, 0 }), still, down, 10, 0), 10); // beside it
  // An edge comes down across an edge.
  const PlaceBody roof = bodyOf(boxMesh(1, 1, 4), { 0, 0, 0 }, about({ 0, 0, 1 }, 45));
  const PlaceBody across = bodyOf(boxMesh(4, 1, 1), { 0.2, 2, 0.1 }, about({ 1, 0, 0 }, 45));
  EXPECT_NEAR(wayDown(across, roof, down, 10, 0), 2 - 2 * std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(distance(across, roof, 10), 2 - 2 * std::sqrt(0.5), 1e-9);
  // What is above it does not hold it.
  EXPECT_EQ(wayDown(bodyOf(cube, { 0, -1.0001, 0 }), still, down, 10, 1e-6), 10);
}

TEST(PlaceBody, LiesOnWhatHoldsIt)
{
  const SolidMesh cube = boxMesh(1, 1, 1);
  const PlaceBody floor = bodyOf(boxMesh(10, 1, 10), { 0, -0.5, 0 });
  for (const double height : { 0.48, 0.52 })
  {
    PlaceBody body = bodyOf(cube, { 0.3, height, 0.2 }, about({ 0, 1, 0 }, 20));
    layDown(body, { &floor }, down, 0.05);
    EXPECT_NEAR(body.pose().translation.y(), 0.5, 5e-6);
    const PlaceMeasure measure = measurePlace(body, { &floor }, down, 1);
    EXPECT_EQ(measure.penetration, 0);
    EXPECT_LT(measure.gap, 5e-6);
  }
  // What it touches from below does not hold it.
  const PlaceBody ceiling = bodyOf(boxMesh(10, 1, 10), { 0, 1.5203, 0 });
  PlaceBody under = bodyOf(cube, { 0.3, 0.5203 - 1e-6, 0.2 });
  EXPECT_GT(measurePlace(under, { &floor, &ceiling }, down, 1).gap, 0.02);
  layDown(under, { &floor, &ceiling }, down, 0.05);
  EXPECT_NEAR(under.pose().translation.y(), 0.5, 5e-6);
  EXPECT_TRUE(stands(bodyOf(cube, { 0, 0.5, 0 }), floor, down, 0.005));
  EXPECT_TRUE(stands(bodyOf(cube, { 5.49, 0.5, 0 }, about({ 0, 1, 0 }, 10)), floor, down, 0.005) == false);
  EXPECT_FALSE(stands(bodyOf(cube, { 0, std::sqrt(0.5), 0 }, about({ 0, 0, 1 }, 45)), floor, down, 0.005));
}

TEST(ConvexPieces, AreTrueToTheSurface)
{
  for (const char* name : { "bowl.ac", "bottle.ac", "torus.ac", "brick.ac" })
  {
    const std::shared_ptr<const SolidMesh> mesh =
      solidOf(PlaceScene::models(), test::sourceFile(std::string("Data/Models/") + name));
    const std::shared_ptr<const std::vector<ConvexHull>> pieces =
      piecesOf(PlaceScene::models(), test::sourceFile(std::string("Data/Models/") + name));
    EXPECT_EQ(pieces->size() == 1, std::string(name) == "brick.ac");
    double volume = 0; // of the mesh, by the divergence theorem
    for (const auto& t : mesh->triangles)
    {
      volume += mesh->points[t[0]].dot(mesh->points[t[1]].cross(mesh->points[t[2]])) / 6;
    }
    double sum = 0;
    std::size_t corners = 0;
    for (const ConvexHull& piece : *pieces)
    {
      sum += piece.volume;
      corners += piece.points.size();
    }
    const double whole = convexHull(mesh->points).volume;
    EXPECT_GT(sum, 0.98 * volume) << name;
    EXPECT_LT(sum - volume, 0.13 * (whole - volume) + 1e-4 * whole) << name;
    EXPECT_LE(pieces->size(), 24u) << name;
    EXPECT_LE(corners, 350u) << name;
    // Nothing is lost but for the corners that were left out.
    for (const Eigen::Vector3d& p : mesh->points)
    {
      const auto holds = [&p](const ConvexHull& piece)
      {
        return std::all_of(piece.faces.begin(), piece.faces.end(),
          [&](const HalfSpace& face)
          { return face.above(p) <= piece.left + 2e-5; }); // Bullet counts in ten thousandths of a hull
      };
      EXPECT_TRUE(std::any_of(pieces->begin(), pieces->end(), holds)) << name << p.transpose();
    }
  }
}

TEST(Placement, PutsOnASurface)
{
  PlaceScene made;
  made.add("table", "table.ac");
  for (int i = 0; i < 6; ++i)
  {
    made.add("bowl#" + std::to_string(i + 1), "bowl.ac",
      R"({ "on": "table", "clearance": 0.03, "region": [[-0.3, -0.2], [0.3, 0.2]] })");
  }
  const std::vector<PlaceOutcome> placed = made.place();
  ASSERT_EQ(placed.size(), 6u);
  for (const PlaceOutcome& one : placed)
  {
    ASSERT_TRUE(one.note.kept) << one.note.why;
    const Eigen::Vector3d at = made.scene.objects[one.index].position.value;
    EXPECT_NEAR(at.y(), 0.75, 1e-6);
    EXPECT_LE(std::abs(at.x()), 0.3);
    EXPECT_LE(std::abs(at.z()), 0.2);
    EXPECT_LT(measured(one, "gap"), 1e-6);
    EXPECT_EQ(measured(one, "penetration"), 0);
    for (const PlaceOutcome& other : placed)
    {
      const Eigen::Vector3d there = made.scene.objects[other.index].position.value;
      EXPECT_TRUE(&one == &other || (at - there).norm() > 0.138 * 0.99 + 0.03); // two rims and the clearance
    }
  }
}

TEST(Placement, LeavesOutOrRefusesWhatHasNoPlace)
{
  const auto crowded = [](const std::string& otherwise)
  {
    PlaceScene made;
    made.add("brick", "brick.ac");
    for (const char* name : { "a", "b" })
    {
      made.add(name, "brick.ac",
        R"({ "on": "brick", "clearance": 0.01, "attempts": 7, "region": [[-0.001, -0.001], [0.001, 0.001]], "otherwise": ")" +
          otherwise + "\" }");
    }
    return made;
  };
  PlaceScene omits = crowded("omit");
  const std::vector<PlaceOutcome> placed = omits.place();
  EXPECT_TRUE(placed[0].note.kept);
  EXPECT_FALSE(placed[1].note.kept);
  EXPECT_EQ(placed[1].note.attempts, 7);
  EXPECT_EQ(placed[1].note.why, "it is too near to 'a'");
  EXPECT_THAT(failure(crowded("refuse")), HasSubstr("objects/b/place: it is too near to 'a'"));
  PlaceScene tilted;
  tilted.add("brick", "brick.ac");
  tilted.add("a", "brick.ac", R"({ "on": "brick", "region": [[-0.01, -0.01], [0.01, 0.01]] })").orientation =
    Quaternion{ 0.9, 0.1, 0.3, 0 };
  tilted.add("b", "brick.ac", R"({ "on": "a" })");
  const std::vector<PlaceOutcome> both = tilted.place();
  EXPECT_EQ(both.at(0).note.why, "it does not stand on 'brick' as it is turned");
  EXPECT_EQ(both.at(1).note.why, "'a' is left out");
}

TEST(Placement, FillsAVolumeWithoutOverlap)
{
  PlaceScene made;
  for (int i = 0; i < 9; ++i)
  {
    made
      .add("torus#" + std::to_string(i), "torus.ac",
        R"({ "in": [[0, 0, 0], [0.3, 0.3, 0.3]], "clearance": 0.005, "attempts": 500 })")
      .orientation = anyRotation(0.1 * (i % 10), 0.3 * i - int(0.3 * i), 0.7 * i - int(0.7 * i));
  }
  const std::vector<PlaceOutcome> placed = made.place();
  std::vector<PlaceBody> bodies;
  for (const PlaceOutcome& one : placed)
  {
    const ObjectDescription& it = made.scene.objects[one.index];
    EXPECT_TRUE(one.note.kept) << one.note.why;
    bodies.push_back(
      bodyOf(*solidOf(PlaceScene::models(), it.model), it.position.value, it.orientation.value.matrix()));
    EXPECT_TRUE(Eigen::AlignedBox3d(Eigen::Vector3d(-1e-9, -1e-9, -1e-9), Eigen::Vector3d(0.3, 0.3, 0.3) * (1 + 1e-9))
                  .contains(bodies.back().box()));
  }
  for (std::size_t i = 0; i < bodies.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      EXPECT_GE(distance(bodies[i], bodies[j], 1), 0.005 - 1e-12);
    }
  }
}

TEST(Placement, WhatFallsLiesAsClosedFormsSay)
{
  // A brick on a table: on one of its faces, its middle by a half of a side above 0.75.
  PlaceScene made;
  made.add("table", "table.ac");
  made.add("brick", "brick.ac", R"({ "on": "table", "drop": { "height": 0.1 }, "region": [[-0.1, -0.1], [0.1, 0.1]] })")
    .orientation = Quaternion{ 0.8, 0.3, 0.4, 0.1 };
  // A ball in a bowl: at the bottom, whose radius within is 66 mm; it is a polyhedron within 1 %.
  made.add("bowl", "bowl.ac").position = Eigen::Vector3d(2, 0, 0);
  made.add("ball", "ball.ac", R"({ "in": "bowl", "drop": { "height": 0.05, "seconds": 30 } })").scale =
    Eigen::Vector3d(0.04, 0.04, 0.04);
  const std::vector<PlaceOutcome> placed = made.place();
  for (const PlaceOutcome& one : placed)
  {
    ASSERT_TRUE(one.note.kept) << one.note.path << one.note.why;
    EXPECT_LT(measured(one, "gap"), 1e-6);
    EXPECT_LT(measured(one, "penetration"), 1e-6);
  }
  const ObjectDescription& brick = object(made, "brick");
  const Eigen::Vector3d middle = brick.position.value + brick.orientation.value.matrix() * Eigen::Vector3d(0, 0.025, 0);
  const Eigen::Vector3d side = brick.orientation.value.matrix().row(1).cwiseAbs();
  int up = 0;
  EXPECT_GT(side.maxCoeff(&up), 0.9999) << "it lies on a face";
  EXPECT_NEAR(middle.y(), 0.75 + 0.5 * Eigen::Vector3d(0.1, 0.05, 0.06)[up], 2e-4);
  const std::shared_ptr<const SolidMesh> mesh = solidOf(PlaceScene::models(), object(made, "ball").model);
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : mesh->points)
  {
    box.extend(p);
  }
  const double radius = 0.02 * box.sizes().x();
  const ObjectDescription& ball = object(made, "ball");
  const Eigen::Vector3d centre = ball.position.value + ball.orientation.value.matrix() * (0.04 * box.center());
  EXPECT_LT(std::hypot(centre.x() - 2, centre.z()), 0.012);
  EXPECT_NEAR(centre.y(), 0.004 + radius, 0.0025);
}

TEST(Placement, ABrickSlidesOffWhatIsTooSteep)
{
  // tan 20 degrees = 0.364.
  const auto onSlope = [](double friction)
  {
    PlaceScene made;
    const double half = 10 * 3.14159265358979323846 / 180;
    ObjectDescription& slope = made.add("slope", "brick.ac");
    slope.scale = Eigen::Vector3d(10, 1, 10);
    const Quaternion turn{ std::cos(half), 0, 0, std::sin(half) };
    slope.orientation = turn;
    made
      .add("brick", "brick.ac",
        R"({ "on": "slope", "drop": { "height": 0, "friction": )" + std::to_string(friction) +
          R"( }, "region": [[-0.01, -0.01], [0.01, 0.01]] })")
      .orientation = turn;
    const std::vector<PlaceOutcome> placed = made.place();
    return placed[0].note.why;
  };
  EXPECT_EQ(onSlope(0.5), "");
  EXPECT_EQ(onSlope(0.2), "it fell off");
}

TEST(Placement, WhatFallsKeepsItsClearance)
{
  const auto nearest = [](const std::string& clearance)
  {
    PlaceScene made;
    made.add("table", "table.ac");
    for (int i = 0; i < 8; ++i)
    {
      made
        .add("brick#" + std::to_string(i), "brick.ac",
          R"({ "on": "table", "region": [[-0.12, -0.12], [0.12, 0.12]], "drop": {} )" + clearance + "}")
        .orientation = anyRotation(0.11 * i, 0.3 * i - int(0.3 * i), 0.7 * i - int(0.7 * i));
    }
    std::vector<PlaceBody> bodies;
    double least = 1;
    for (const PlaceOutcome& one : made.place())
    {
      const ObjectDescription& it = made.scene.objects[one.index];
      EXPECT_TRUE(one.note.kept || one.note.why.find("it is too near to 'brick#") == 0) << one.note.why;
      if (one.note.kept)
      {
        bodies.push_back(
          bodyOf(*solidOf(PlaceScene::models(), it.model), it.position.value, it.orientation.value.matrix()));
        for (std::size_t i = 0; i + 1 < bodies.size(); ++i)
        {
          least = std::min(least, distance(bodies[i], bodies.back(), 1));
        }
      }
    }
    EXPECT_GE(bodies.size(), 2u);
    EXPECT_EQ(bodies.size() == 8, clearance.empty()); // there is no room for all
    return least;
  };
  EXPECT_LT(nearest(""), 0.02);
  EXPECT_GE(nearest(R"(, "clearance": 0.02)"), 0.02);
}

TEST(Placement, AProxyStandsInForTheFall)
{
  // A cube in place of a ball does not roll.
  const test::TemporaryFolder folder;
  const std::shared_ptr<const SolidMesh> ball = solidOf(PlaceScene::models(), test::sourceFile("Data/Models/ball.ac"));
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : ball->points)
  {
    box.extend(p);
  }
  const auto cube = [&](const std::string& name, double scale)
  {
    std::ofstream file(folder.path(name));
    for (int i = 0; i < 8; ++i)
    {
      const Eigen::Vector3d p = scale * box.corner(Eigen::AlignedBox3d::CornerType(i));
      file << "v " << p.x() << " " << p.y() << " " << p.z() << "\n";
    }
    file << "f 1 2 4 3\nf 5 7 8 6\nf 1 5 6 2\nf 3 4 8 7\nf 1 3 7 5\nf 2 6 8 4\n";
    return folder.path(name);
  };
  const auto fallen = [&](const std::string& proxy, const std::string& drop)
  {
    PlaceScene made;
    const double half = 10 * 3.14159265358979323846 / 180;
    ObjectDescription& slope = made.add("slope", "brick.ac");
    slope.scale = Eigen::Vector3d(10, 1, 10);
    const Quaternion turn{ std::cos(half), 0, 0, std::sin(half) };
    slope.orientation = turn;
    ObjectDescription& it = made.add("ball", "ball.ac",
      R"({ "on": "slope", "region": [[-0.01, -0.01], [0.01, 0.01]])" + drop + R"(, "proxy": ")" + proxy + "\" }");
    it.scale = Eigen::Vector3d(0.1, 0.1, 0.1);
    it.orientation = turn;
    return made;
  };
  const std::string drop = R"(, "drop": { "height": 0 })";
  PlaceScene stays = fallen(cube("cube.obj", 1), drop);
  const PlaceOutcome placed = stays.place()[0];
  EXPECT_TRUE(placed.note.kept) << placed.note.why;
  EXPECT_LT(measured(placed, "gap"), 1e-5);
  PlaceScene rolls = fallen(test::sourceFile("Data/Models/ball.ac"), drop);
  EXPECT_EQ(rolls.place()[0].note.why, "it fell off");
  EXPECT_THAT(failure(fallen(cube("large.obj", 1.5), drop)), HasSubstr("proxy names a model that is not where"));
  EXPECT_THAT(failure(fallen(folder.path("none.obj"), drop)), HasSubstr("proxy names a model that cannot be read"));
  EXPECT_THAT(failure(fallen(cube("cube.obj", 1), "")), HasSubstr("proxy is of what falls"));
}

TEST(Placement, TheOrderInTheFileAndCamerasChangeNothing)
{
  const std::string rule = R"({ "in": "support", "drop": { "height": 0.05 } })";
  const auto made = []() { return twentyThings("bin.ac", R"({ "in": "support", "drop": { "height": 0.05 } })", 3); };
  PlaceScene first = made();
  first.place();
  PlaceScene second = made();
  second.scene.cameras.emplace_back();
  std::reverse(second.scene.objects.begin(), second.scene.objects.end());
  std::reverse(second.rules.begin(), second.rules.end());
  for (SampleRule& one : second.rules)
  {
    one.index = second.scene.objects.size() - 1 - one.index;
  }
  second.place();
  for (const ObjectDescription& one : first.scene.objects)
  {
    const ObjectDescription& other = object(second, one.name);
    EXPECT_EQ(one.position.value, other.position.value) << one.name;
    EXPECT_EQ(one.orientation.value, other.orientation.value) << one.name;
  }
}

TEST(Placement, AFallBecomesKeyFrames)
{
  for (const double metre : { 1, 100 }) // of the scene's units
  {
    PlaceScene made;
    made.scene.fps = 100;
    made.scene.units = metre == 1 ? "" : "cm";
    made.add("table", "table.ac").scale = Eigen::Vector3d(Eigen::Vector3d::Constant(metre));
    made
      .add("brick", "brick.ac",
        R"({ "on": "table", "drop": { "height": )" + std::to_string(0.2 * metre) +
          R"(, "bake": "keys", "from": 10 } })")
      .scale = Eigen::Vector3d(Eigen::Vector3d::Constant(metre));
    const std::vector<PlaceOutcome> placed = made.place();
    ASSERT_TRUE(placed[0].note.kept) << placed[0].note.why;
    const Track<Eigen::Vector3d>& track = object(made, "brick").position;
    ASSERT_GT(track.keys.size(), 30u);
    EXPECT_EQ(double(track.keys.size()), measured(placed[0], "frames"));
    EXPECT_EQ(track.keys.front().frame, 10);
    // Free fall for the first 0.19 s; the air of the damping takes less than 3 %.
    for (std::size_t i = 5; i < 19; ++i)
    {
      const double way = (track.keys[0].value.y() - track.keys[i].value.y()) / metre;
      EXPECT_NEAR(way, 0.5 * 9.81 * 1e-4 * double(i * i), 0.15 * way) << i;
    }
    EXPECT_EQ(track.keys.back().value, track.value);
    EXPECT_NEAR(track.value.y() / metre, 0.75, 2e-4);
  }
}

TEST(PointOnSurface, IsUniformOverTheArea)
{
  PlaceScene made;
  ObjectDescription& brick = made.add("brick", "brick.ac");
  brick.scale = Eigen::Vector3d(1, 2, 1); // 0.1 x 0.1 x 0.06
  brick.position = Eigen::Vector3d(3, 0, 0);
  constexpr int side = 40;
  std::array<int, 3> count = {};
  const SampleGeometry geometry(made.scene, PlaceScene::models());
  for (int i = 0; i < side * side * side; ++i)
  {
    const auto at = [&](int k) { return (k % side + 0.5) / side; };
    const DrawnSurfacePoint point = geometry.onSurface(0, { at(i), at(i / side), at(i / side / side) });
    const Eigen::Vector3d off =
      (point.x_in_world - Eigen::Vector3d(3, 0.05, 0)).cwiseQuotient(Eigen::Vector3d(0.05, 0.05, 0.03));
    int axis = 0;
    ASSERT_NEAR(off.cwiseAbs().maxCoeff(&axis), 1, 1e-9);
    ASSERT_NEAR(point.normal_in_world[axis] * off[axis], 1, 1e-9); // outside
    count[std::size_t(axis)]++;
  }
  const double total = 6 + 6 + 10;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    EXPECT_NEAR(count[axis] / double(side * side * side), (axis == 2 ? 10 : 6) / total, 0.03);
  }
}

// The whole of what is asked for is JudgePlacement's; a small part of it here.
TEST(Placement, NothingHoversOrSinks)
{
  for (const bool bin : { true, false })
  {
    PlaceScene made =
      bin ? twentyThings("bin.ac", R"({ "in": "support", "drop": { "height": 0.05 } })", 0)
          : twentyThings("table.ac",
              R"({ "on": "support", "region": [[-0.5, -0.3], [0.5, 0.3]], "drop": { "height": 0.05 } })", 0);
    const std::vector<PlaceOutcome> placed = made.place();
    int kept = 0;
    for (const PlaceOutcome& one : placed)
    {
      kept += one.note.kept;
      EXPECT_LE(measured(one, "penetration"), 5e-4);
      EXPECT_LE(measured(one, "gap"), 5e-4);
      EXPECT_NE(one.note.kept, !one.note.why.empty());
    }
    EXPECT_GE(kept, 18);
  }
}
