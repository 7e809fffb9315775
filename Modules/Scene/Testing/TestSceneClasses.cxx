// SPDX-License-Identifier: BSD-3-Clause
// What "classes" may say, in the scene, in a file of its own, and in a scene made by program.
#include "dgtkSceneSamples.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace dgtk;
using namespace dgtk::test;
using testing::HasSubstr;

TEST(SceneRefusals, Classes)
{
  const auto of = [](const std::string& classes, const std::string& object = "\"class\": \"tree\"")
  {
    return refusalOf("a.json", "{\"classes\": " + classes + ",\n\"objects\": [{\"model\": \"a.ac\", " + object + "}]}");
  };
  EXPECT_EQ(of("{\"tree\": 1}"), "");
  EXPECT_EQ(of("{\"tree\": {\"id\": 65535}}"), "");
  EXPECT_EQ(of("{\"car\": 1, \"house\": 2}"),
    "a.json:2: objects[0].class has no number in the given classes (expected one of 'car', 'house', found 'tree')");
  EXPECT_EQ(
    of("{\"tree\": 0}"), "a.json:1: classes.tree is out of range (expected a whole number from 1 to 65535, found 0)");
  EXPECT_THAT(of("{\"tree\": 65536}"), HasSubstr("classes.tree is out of range"));
  EXPECT_THAT(of("{\"tree\": 1.5}"), HasSubstr("classes.tree is not a whole number"));
  EXPECT_THAT(of("{\"tree\": \"1\"}"), HasSubstr("classes.tree has the wrong type"));
  EXPECT_THAT(of("{\"tree\": {}}"), HasSubstr("classes.tree has no number"));
  EXPECT_THAT(of("{\"tree\": {\"id\": 1, \"colour\": 2}}"), HasSubstr("classes.tree.colour is an unknown key"));
  EXPECT_THAT(of("{\"tree\": {\"id\": 1, \"color\": 2}}"), HasSubstr("classes.tree.color has the wrong type"));
  EXPECT_THAT(of("{\"tree\": {\"id\": 1, \"color\": [0, 1]}}"), HasSubstr("classes.tree.color"));
  EXPECT_THAT(of("{\"tree\": {\"id\": 1, \"color\": [0, -1, 1]}}"), HasSubstr("color[1] is out of range"));
  EXPECT_THAT(of("{\"tree\": {\"id\": 1, \"skeleton\": [[1, 2]], \"keypoints\": [\"a\"]}}"), HasSubstr("[1, 2]"));
  EXPECT_EQ(of("{\"tree\": {\"id\": 1, \"skeleton\": [[1, 2]], \"keypoints\": [\"a\", \"b\"]}}"), "");
  EXPECT_THAT(
    of("{\"tree\": {\"id\": 1, \"skeleton\": [[2, 2]], \"keypoints\": [\"a\", \"b\"]}}"), HasSubstr("[2, 2]"));
  EXPECT_THAT(of("{\"tree\": {\"id\": 1, \"keypoints\": [\"a\", \"a\"]}}"), HasSubstr("keypoints[1] is named twice"));
  EXPECT_THAT(
    of("{\"tree\": {\"id\": 1, \"keypoints\": [\"nose\"]}}", "\"class\": \"tree\", \"keypoints\": {\"nase\": 1}"),
    HasSubstr("objects[0].keypoints names what is none of class 'tree' (expected perhaps 'nose', found 'nase')"));
  EXPECT_THAT(of("{\"tree\": 3, \"car\": 3}"), HasSubstr("a.json:1: classes.car is taken"));
  EXPECT_THAT(of("{\"tree\": 3, \"tree\": 4}"), HasSubstr("tree"));
  EXPECT_THAT(of("{}"), HasSubstr("classes names no class"));
  EXPECT_THAT(of("[]"), HasSubstr("classes has the wrong type"));
  EXPECT_THAT(of("\"\""), HasSubstr("a.json:1: classes cannot be used"));
  EXPECT_THAT(of("\"none.json\""), HasSubstr("none.json: cannot be read"));
  // what is there needs a number, what is not there and has no class does not
  EXPECT_THAT(of("{\"tree\": 1}", "\"visible\": true"), HasSubstr("objects[0].class has no number"));
  EXPECT_EQ(of("{\"tree\": 1}", "\"visible\": false"), "");
  EXPECT_EQ(of("{\"tree\": 1, \"\": 9}", "\"visible\": true"), "");
  EXPECT_THAT(of("{\"tree\": 1}", "\"visible\": false, \"class\": \"tee\""), HasSubstr("found 'tee'"));
}

TEST(SceneRefusals, TwentyClassesAreNamedAtMost)
{
  const auto expected = [](int count)
  {
    std::string classes;
    std::string names;
    for (int i = 1; i <= count; ++i)
    {
      classes += (i > 1 ? ", \"c" : "\"c") + std::to_string(i) + "\": " + std::to_string(i);
      names += i <= 20 ? (i > 1 ? ", 'c" : "'c") + std::to_string(i) + '\'' : "";
    }
    EXPECT_THAT(refusalOf("a.json", "{\"classes\": {" + classes + "}, \"objects\": [{\"model\": \"a.ac\"}]}"),
      HasSubstr("(expected one of " + names + (count > 20 ? ", ..." : "") + ", found ''"));
  };
  expected(20);
  expected(21);
  expected(25);
}

TEST(SceneRefusals, AFileOfClasses)
{
  const TemporaryFolder folder;
  const auto of = [&](const std::string& classes)
  {
    writeFile(folder.path("c.json"), classes);
    return refusalIn(folder, "a.json", R"({"classes": "c.json", "objects": [{"model": "a.ac", "class": "tree"}]})");
  };
  EXPECT_EQ(of("{\"tree\": 3 /* and no other */}"), "");
  EXPECT_EQ(
    of("{\n\"tree\": -1}"), "c.json:2: tree is out of range (expected a whole number from 1 to 65535, found -1)");
  EXPECT_EQ(
    of("{\"car\": 1}"), "a.json:1: objects[0].class has no number in c.json (expected one of 'car', found 'tree')");
  EXPECT_THAT(of("{"), HasSubstr("c.json:1: "));
  EXPECT_THAT(of("3"), HasSubstr("c.json:1: has the wrong type (expected an object"));
}

TEST(SceneRefusals, ClassesOfAProgram)
{
  SceneDescription scene;
  scene.classes = { { "a", 1 }, { "b", 2 } };
  EXPECT_NO_THROW(toJson(scene, ""));
  scene.classes[1].id = 1;
  EXPECT_THROW(toJson(scene, ""), InputError);
  scene.classes[1] = { "a", 2 };
  EXPECT_THROW(toJson(scene, ""), InputError);
  scene.classes[1] = { "b", 65536 };
  EXPECT_THROW(toJson(scene, ""), InputError);
}
