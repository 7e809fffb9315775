// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneSamples.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace dgtk;
using namespace dgtk::test;
using testing::HasSubstr;

// A scene that is to be drawn first is told from one that is as it stands, and where.

namespace
{
constexpr const char* isRandom = " makes the scene random (expected a plain scene, as dgtk sample makes of it";

std::string objects(const std::string& first, const std::string& second = "\"name\": \"b\"")
{
  return refusalOf(
    "a.json", "{\"objects\": [\n{\"model\": \"a.ac\", " + first + "},\n{\"model\": \"b.ac\", " + second + "}]}");
}

std::string cameras(const std::string& members)
{
  return refusalOf("a.json", "{\"cameras\": [\n{\"eye\": [0, 0, 5], \"lookAt\": [0, 0, 0], " + members + "}]}");
}
} // namespace

TEST(SceneRandom, KeysOfRandomScenesAreFound)
{
  EXPECT_THAT(refusalOf("a.json", "{\"parameters\": {}}"), HasSubstr(std::string("a.json:1: parameters") + isRandom));
  EXPECT_THAT(refusalOf("a.json", "{\n\"stratify\": {}}"), HasSubstr(std::string("a.json:2: stratify") + isRandom));
  EXPECT_THAT(objects("\"count\": 2"), HasSubstr(std::string("a.json:2: objects[0].count") + isRandom));
  EXPECT_THAT(objects("\"count\": 2", "\"place\": {}"), HasSubstr(std::string("objects[0].count") + isRandom));
  EXPECT_THAT(
    objects("\"name\": \"a\"", "\"place\": {}"), HasSubstr(std::string("a.json:3: objects[1].place") + isRandom));
  for (const std::string key : { "path", "require", "rig" })
  {
    EXPECT_THAT(cameras('"' + key + "\": {}"), HasSubstr("cameras[0]." + key + isRandom));
  }
}

TEST(SceneRandom, DrawnValuesAreFoundAtAnyDepth)
{
  EXPECT_THAT(objects("\"position\": {\"inBox\": [[0, 0, 0], [1, 1, 1]]}"),
    HasSubstr(std::string("a.json:2: objects[0].position") + isRandom));
  EXPECT_THAT(objects("\"position\": [0, {\"uniform\": [0, 1]}, 0]"),
    HasSubstr(std::string("objects[0].position[1]") + isRandom));
  EXPECT_THAT(
    objects("\"orientation\": {\"rotation\": \"any\"}"), HasSubstr(std::string("objects[0].orientation") + isRandom));
  EXPECT_THAT(objects("\"position\": [0, {\"normal\": {\"mean\": 0, \"deviation\": 1}, \"stratify\": \"s\"}, 0]"),
    HasSubstr(std::string("objects[0].position[1]") + isRandom));
  EXPECT_THAT(cameras("\"fovY\": {\"integer\": [40, 60]}"), HasSubstr(std::string("cameras[0].fovY") + isRandom));
}

// Words that others use, and names of the user's, say nothing of that kind.
TEST(SceneRandom, OtherWordsAreNotTakenForDrawnValues)
{
  EXPECT_THAT(objects("\"rotation\": [1, 0, 0, 0]"), HasSubstr("objects[0].rotation is an unknown key"));
  EXPECT_THAT(objects("\"normal\": \"n.png\""), HasSubstr("objects[0].normal is an unknown key"));
  EXPECT_EQ(refusalOf("a.json", "{\"classes\": {\"choice\": 1, \"normal\": 2}}"), "");
  EXPECT_EQ(objects("\"keypoints\": {\"integer\": [0, 0, 0]}"), "");
  EXPECT_EQ(objects("\"materials\": {\"shell\": {\"diffuse\": [1, 0, 0]}}"), "");
}
