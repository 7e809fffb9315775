// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPlaceSamples.h"

#include "dgtkFile.h"
#include "dgtkSampler.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>

#include <string>

namespace
{
using namespace dgtk;
using testing::HasSubstr;

/// A folder with boxes whose bottom's middle is the origin, and a sheet of side 1 in the plane y = 0.
struct Boxes : test::TemporaryFolder
{
  Boxes()
  {
    this->write("floor", 20, -1, 0, 20);
    this->write("cube", 1, 0, 1, 1);
    this->write("middle", 1, -0.5, 0.5, 1);
    this->write("plate", 0.8, 0, 0.006, 0.6);
    writeFile(this->path("sheet.obj"), "v -0.5 0 -0.5\nv 0.5 0 -0.5\nv 0.5 0 0.5\nv -0.5 0 0.5\nf 4 3 2 1\n");
  }
  void write(const std::string& name, double x, double low, double high, double z) const
  {
    std::string text;
    for (int i = 0; i < 8; ++i)
    {
      text += "v " + std::to_string(i & 1 ? x / 2 : -x / 2) + ' ' + std::to_string(i & 2 ? high : low) + ' ' +
              std::to_string(i & 4 ? z / 2 : -z / 2) + '\n';
    }
    writeFile(this->path(name + ".obj"), text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n");
  }
  /// The objects are a floor and `objects`.
  SceneSample sample(const std::string& objects, const std::string& more = "") const
  {
    const std::string json =
      R"({ "objects": [ { "name": "floor", "model": "floor.obj" }, )" + objects + " ]" + more + " }";
    return Sampler(RandomScene::ofText(json, this->path(""))).draw(0);
  }
  std::vector<Eigen::Vector3d> positions(const std::string& object) const
  {
    std::vector<Eigen::Vector3d> found;
    const SceneDescription scene = this->sample(object).scene;
    for (std::size_t i = 1; i < scene.objects.size(); ++i)
    {
      found.push_back(scene.objects[i].position.value);
    }
    return found;
  }
};
} // namespace

TEST(Placement, FallsGoByTheUnitsOfTheScene)
{
  const Boxes boxes;
  for (const double metre : { 1, 100, 1000 })
  {
    const std::string unit = metre == 1 ? "m" : metre == 100 ? "cm" : "mm";
    const std::string cube = R"({ "name": "cube", "model": "cube.obj", "scale": )" + std::to_string(metre) +
                             R"(, "place": { "on": "floor", "region": [[0, 0], [0, 0]], "drop": { "bake": "keys",
      "height": )" + std::to_string(metre) +
                             " } } }";
    const SceneDescription scene = boxes.sample(cube, R"(, "fps": 100, "units": ")" + unit + '"').scene;
    ASSERT_EQ(scene.objects.size(), 2u) << unit;
    const auto& keys = scene.objects[1].position.keys;
    ASSERT_GT(keys.size(), 30u) << unit;
    const double way = (keys[0].value.y() - keys[20].value.y()) / metre;
    EXPECT_NEAR(way, 0.5 * 9.81 * 0.04, 0.05 * way) << unit; // in 0.2 s
  }
}

TEST(Placement, SidesInOnePlaneHideNoOverlap)
{
  const Boxes boxes;
  const auto named = [](const std::string& model, int count, const std::string& region)
  {
    return R"({ "name": "a", "model": ")" + model + R"(.obj", "count": )" + std::to_string(count) +
           R"(, "place": { "on": "floor", "region": )" + region + " } }";
  };
  EXPECT_EQ(boxes.positions(named("cube", 4, "[[0, 0], [0, 0]]")).size(), 1u);
  EXPECT_EQ(boxes.positions(named("sheet", 9, "[[0, 0], [0.9, 0.9]]")).size(), 1u);
  const std::vector<Eigen::Vector3d> row = boxes.positions(named("cube", 8, "[[-3, 0], [3, 0]]"));
  EXPECT_GE(row.size(), 3u);
  for (std::size_t i = 0; i < row.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      EXPECT_GE(std::abs(row[i].x() - row[j].x()), 1 - 1e-9);
    }
  }
  // What touches is not in one another.
  EXPECT_EQ(boxes
              .positions(named("cube", 1, "[[0, 0], [0, 0]]") + R"(, { "name": "b", "model": "cube.obj", "place": {
      "on": "floor", "region": [[1, 0], [1, 0]] } })")
              .size(),
    2u);
}

TEST(Placement, WhatFallsFlatNeitherSinksInNorTurns)
{
  for (const double restitution : { 0.0, 0.9 })
  {
    PlaceScene made;
    made.scene.fps = 200;
    made.add("table", "table.ac");
    made.add("brick", "brick.ac",
      R"({ "on": "table", "region": [[0, 0], [0, 0]], "drop": { "height": 0.5, "bake": "keys", "restitution": )" +
        std::to_string(restitution) + " } }");
    const std::vector<PlaceOutcome> placed = made.place();
    ASSERT_TRUE(placed[0].note.kept) << placed[0].note.why;
    const ObjectDescription& brick = made.scene.objects[1];
    double lowest = 1;
    double rebound = 0;
    for (const auto& key : brick.position.keys)
    {
      const double height = key.value.y() - 0.75;
      rebound = lowest < 0.01 && key.frame < 120 ? std::max(rebound, height) : rebound;
      lowest = std::min(lowest, height);
    }
    EXPECT_GT(lowest, -0.003) << restitution;
    if (restitution == 0)
    {
      EXPECT_LT(std::hypot(brick.position.value.x(), brick.position.value.z()), 0.001);
      EXPECT_GT(std::abs(brick.orientation.value.w), 0.9999);
      EXPECT_LT(rebound, 0.005);
    }
    else
    {
      EXPECT_NEAR(rebound, 0.81 * 0.5, 0.03);
    }
  }
}

TEST(Placement, SetsThePositionAloneOfWhatIsPut)
{
  const Boxes boxes;
  const std::string cube = R"({ "name": "a", "model": "middle.obj", "orientation": { "keys":
    [[0, [0, 0, 1, 0]], [9, [1, 0, 0, 0]]] }, "place": { "in": [[-0.5, 2.5, -0.5], [0.5, 3.5, 0.5]] } })";
  SceneDescription scene = boxes.sample(cube).scene;
  EXPECT_EQ(scene.objects[1].position.value, Eigen::Vector3d(0, 3, 0));
  ASSERT_EQ(scene.objects[1].orientation.keys.size(), 2u);
  EXPECT_EQ(scene.objects[1].orientation.at(0).y, 1);
  scene = boxes
            .sample(R"({ "name": "a", "model": "cube.obj",
    "place": { "in": [[-0.5, 0, -0.5], [0.5, 1, 0.5]] } }, { "name": "below", "model": "cube.obj",
    "position": [9, 0, 0] })")
            .scene;
  ASSERT_EQ(scene.objects.size(), 3u);
  EXPECT_EQ(scene.objects[1].position.value, Eigen::Vector3d(0, 0, 0)) << "that of what says nothing";
}

TEST(Placement, IsNotSaidTwice)
{
  const Boxes boxes;
  const auto refusal = [&boxes](const std::string& pose, const std::string& place)
  {
    return test::thrownBy<InputError>(
      [&] { boxes.sample(R"({ "name": "a", "model": "cube.obj", )" + pose + R"(, "place": )" + place + " }"); });
  };
  const std::string put = R"({ "in": [[-0.5, 0, -0.5], [0.5, 1, 0.5]] })";
  const std::string dropped = R"({ "on": "floor", "drop": {} })";
  const std::string turns = R"("orientation": { "keys": [[0, [0, 0, 1, 0]], [9, [1, 0, 0, 0]]] })";
  EXPECT_THAT(
    refusal(R"("position": [5, 5, 5])", put), testing::HasSubstr("objects[1].position stands beside a place"));
  EXPECT_THAT(refusal(R"("position": { "uniform": [0, 1] })", dropped), testing::HasSubstr("stands beside a place"));
  EXPECT_THAT(refusal(turns, dropped), testing::HasSubstr("objects[1].orientation has key frames beside a place"));
  EXPECT_EQ(refusal(turns, put), "");
}

TEST(Placement, AThinModelMayBeScaledToAThickOne)
{
  const Boxes boxes;
  const std::vector<Eigen::Vector3d> plate = boxes.positions(R"({ "name": "a", "model": "plate.obj",
    "scale": [1, 20, 1], "place": { "on": "floor", "drop": { "height": 0.1 } } })");
  ASSERT_EQ(plate.size(), 1u);
  EXPECT_NEAR(plate[0].y(), 0, 1e-4) << "flat on the floor";
}

TEST(Placement, AFallEndsBeforeTheLastFrame)
{
  const auto with = [](const std::string& from)
  {
    PlaceScene made;
    made.add("table", "table.ac");
    made.add("a", "brick.ac", R"({ "on": "table", "drop": { "height": 0.1, "bake": "keys", "from": )" + from + " } }");
    return failure(made);
  };
  EXPECT_EQ(with("999000"), "");
  EXPECT_THAT(with("999999"), HasSubstr("drop.from leaves too few frames for the fall (expected at most 9999"));
}

TEST(Placement, WhatItIsPutOnMayHaveNoInstance)
{
  const Boxes boxes;
  const std::string ball = R"({ "name": "ball", "model": "cube.obj", "count": { "integer": [0, 0] } }, )";
  const auto on = [&](const std::string& more)
  { return ball + R"({ "name": "a", "model": "cube.obj", "place": { )" + more + " } }"; };
  const auto refusal = [&](const std::string& more)
  { return test::thrownBy<SampleRefused>([&] { boxes.sample(on(more)); }); };
  for (const char* more : { R"("on": "ball#1")", R"("in": "ball#2")", R"("on": "ball#1", "drop": {})" })
  {
    const SceneSample sample = boxes.sample(on(more));
    EXPECT_EQ(sample.scene.objects.size(), 1u) << more;
    ASSERT_EQ(sample.notes.size(), 1u);
    EXPECT_FALSE(sample.notes[0].kept);
    EXPECT_THAT(sample.notes[0].why, HasSubstr("has no instance in this sample"));
  }
  EXPECT_EQ(
    refusal(R"("on": "ball#1", "otherwise": "refuse")"), "objects/a/place: 'ball#1' has no instance in this sample");
  EXPECT_THAT(test::thrownBy<InputError>([&] { boxes.sample(on(R"("on": "bull#1")")); }),
    HasSubstr("is not another object's name"));
}

TEST(Placement, SaysWhatIsWrongWithARule)
{
  const auto with = [](const std::string& rule)
  {
    PlaceScene made;
    made.add("table", "table.ac");
    made.add("a", "brick.ac", rule);
    return failure(made);
  };
  EXPECT_THAT(with(R"({ "on": "chair" })"), HasSubstr("'chair'"));
  EXPECT_THAT(with(R"({ "on": "a" })"), HasSubstr("is not another object's name"));
  EXPECT_THAT(with(R"({ "on": "table", "in": "table" })"), HasSubstr("one of the keys 'on' and 'in'"));
  EXPECT_THAT(with(R"({ "on": "table", "hight": 1 })"), HasSubstr("'hight' that is not known"));
  EXPECT_THAT(with(R"({ "on": "table", "attempts": 0 })"), HasSubstr("attempts"));
  EXPECT_THAT(with(R"({ "in": [[0, 0, 1], [1, 1, 0]] })"), HasSubstr("beyond its largest"));
}

TEST(Placement, StandsOnWhatIsPlacedBefore)
{
  const std::string table = R"({ "on": "table" })";
  const std::string tableLater = R"({ "on": "table", "drop": { "height": 0.01 } })";
  const auto placed = [](const std::string& first, const std::string& second)
  {
    PlaceScene made;
    made.add("table", "table.ac");
    made.add("a", "crate.ac", first).scale = Eigen::Vector3d(0.1, 0.1, 0.1);
    made.add("b", "crate.ac", second).scale = Eigen::Vector3d(0.1, 0.1, 0.1);
    return failure(made);
  };
  EXPECT_EQ(placed(table, R"({ "on": "a" })"), "");
  EXPECT_EQ(placed(R"({ "on": "b", "drop": {} })", table), ""); // what falls comes last
  for (const char* const where : { "on", "in" })
  {
    const auto at = [&](const std::string& name, const std::string& more)
    { return std::string("{ \"") + where + "\": \"" + name + "\"" + more + " }"; };
    const auto later = HasSubstr(where + std::string(" names an object that is placed later"));
    EXPECT_THAT(placed(at("b", ""), table), later);
    EXPECT_THAT(placed(tableLater, at("a", "")), later);
    EXPECT_THAT(placed(tableLater, at("a", R"(, "drop": {})")), later);
  }
}

// Bricks of 0.1 x 0.05 x 0.06, whose middle along z is their origin's.
TEST(Placement, PutsOnWhatIsUpInTheScene)
{
  PlaceScene made;
  made.scene.upAxis = UpAxis::Z;
  made.add("below", "brick.ac");
  made.add("a", "brick.ac", R"({ "on": "below", "region": [[0.01, 0.02], [0.01, 0.02]] })");
  const std::vector<PlaceOutcome> placed = made.place();
  ASSERT_TRUE(placed.at(0).note.kept) << placed[0].note.why;
  EXPECT_LT((made.scene.objects[1].position.value - Eigen::Vector3d(0.01, 0.02 - 0.025, 0.06)).norm(), 1e-6);
}

TEST(Placement, WhatIsLeftOutIsInNoOrder)
{
  const auto brick = [](const std::string& name, const std::string& more) {
    return R"({ "name": ")" + name + R"(", "model": ")" + test::sourceFile("Data/Models/brick.ac") + '"' + more + " }";
  };
  const std::string large =
    brick("large", R"(, "place": { "in": [[1, 1, 1], [1.01, 1.01, 1.01]], "otherwise": "omit" })");
  const std::string json = R"({ "seed": 2, "objects": [)" + brick("first", "") + ", " + large + ", " +
                           brick("last", "") + R"(], "lights": [ { "position": [0, 0, 9] } ],
    "order": ["object", "object", "light", "object"] })";
  const SceneDescription scene = Sampler(RandomScene::ofText(json, ".")).draw(0).scene;
  ASSERT_EQ(scene.objects.size(), 2U);
  EXPECT_EQ(scene.objects[1].name, "last");
  using Kind = SceneItem::Kind;
  EXPECT_EQ(scene.items(), (std::vector<SceneItem>{ { Kind::Object, 0 }, { Kind::Light, 0 }, { Kind::Object, 1 } }));
}
