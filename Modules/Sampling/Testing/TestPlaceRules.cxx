// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPlaceSamples.h"

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
