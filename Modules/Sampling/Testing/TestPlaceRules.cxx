// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPlaceSamples.h"

#include "dgtkSampler.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>

#include <string>

namespace
{
using namespace dgtk;
using testing::HasSubstr;
} // namespace

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
