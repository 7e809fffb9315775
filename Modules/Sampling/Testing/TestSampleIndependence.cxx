// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampler.h"

#include "dgtkTestSupport.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <string>

using namespace dgtk;
using Json = nlohmann::ordered_json;

namespace
{
Json scene()
{
  const auto model = [](const char* name) { return test::sourceFile(std::string("Data/Models/") + name); };
  return Json::parse(
    R"({ "seed": 9, "parameters": { "n": { "integer": [2, 4] }, "far": { "uniform": [4, 6] } },
    "background": { "inBox": [[0, 0, 0], [1, 1, 1]] },
    "objects": [
      { "name": "floor", "model": ")" +
    model("floor.ac") + R"(", "materials": { "*": { "diffuse": { "inBox": [[0, 0, 0], [1, 1, 1]] } } } },
      { "name": "cup", "count": "$n", "class": { "permutation": ["a", "b", "c", "d"] }, "model": ")" +
    model("cup.ac") + R"(",
        "place": { "on": "floor", "clearance": 0.05, "otherwise": "omit" } },
      { "name": "ball", "model": ")" +
    model("ball.ac") + R"(", "scale": { "normal": { "mean": 0.3, "deviation": 0.1, "min": 0.1, "max": 0.5 } },
        "position": { "onSurface": { "object": "floor", "above": 1 } }, "orientation": { "rotation": "any" } } ],
    "lights": [ { "name": "sun", "kind": "point", "position": { "shell": { "center": "ball", "radius": ["$far", 9] } }, "intensity": { "logUniform": [0.5, 2] } } ],
    "cameras": [
      { "name": "seen", "eye": { "shell": { "center": "floor", "radius": "$far", "elevation": [20, 60] } }, "lookAt": { "inBox": [[-1, 0, -1], [1, 1, 1]] },
        "require": { "visible": { "floor": 0.5 }, "pixels": 40 } },
      { "name": "mounted", "rig": { "camera": "seen", "position": [0.1, 0, 0] } },
      { "name": "tour", "fovY": { "uniform": [30, 60] }, "path": { "orbit": { "center": "ball", "radius": [5, "$far"], "frames": [0, 4] } } } ] })");
}

std::string written(const Json& random, int number)
{
  return toJson(Sampler(RandomScene::ofText(random.dump(), ".")).draw(std::uint64_t(number)).scene, ".");
}

/// Each object, light and camera as it is written, by its name.
std::map<std::string, std::string> itemsOf(const std::string& text)
{
  std::map<std::string, std::string> items;
  const Json plain = Json::parse(text);
  for (const char* list : { "objects", "lights", "cameras" })
  {
    for (const Json& item : plain[list])
    {
      items[std::string(list) + '/' + item["name"].get<std::string>()] = item.dump();
    }
  }
  items["background"] = plain["background"].dump();
  return items;
}

Json reversed(const Json& value)
{
  if (value.is_array())
  {
    Json list = Json::array();
    for (const Json& one : value)
    {
      list.push_back(reversed(one));
    }
    return list;
  }
  if (!value.is_object())
  {
    return value;
  }
  Json object = Json::object();
  for (auto at = value.rbegin(); at != value.rend(); ++at)
  {
    object[at.key()] = reversed(at.value());
  }
  return object;
}

void expectAllOf(const std::map<std::string, std::string>& before, const std::map<std::string, std::string>& after)
{
  for (const auto& [name, text] : before)
  {
    const auto found = after.find(name);
    ASSERT_NE(found, after.end()) << name;
    EXPECT_EQ(found->second, text) << name;
  }
}
} // namespace

TEST(SampleIndependence, AnotherItemChangesNoDraw)
{
  const Json far = Json::parse(R"({ "name": "another", "scale": { "uniform": [0.1, 0.2] }, "model": ")" +
                               test::sourceFile("Data/Models/ball.ac") +
                               R"(", "position": { "inBox": [[300, 300, 300], [301, 301, 301]] } })");
  const Json more =
    Json::parse(R"({ "name": "further", "eye": { "inBox": [[0, 9, 0], [1, 10, 1]] }, "lookAt": [0, 0, 0.5],
    "require": { "clearance": 0.1 } })");
  const Json lamp =
    Json::parse(R"({ "name": "lamp", "kind": "point", "position": { "inBox": [[0, 9, 0], [1, 10, 1]] } })");
  for (const int number : { 0, 700 })
  {
    const std::map<std::string, std::string> before = itemsOf(written(scene(), number));
    ASSERT_GE(before.size(), 9U);
    for (const auto& [list, item] :
      { std::pair<const char*, Json>("objects", far), { "cameras", more }, { "lights", lamp } })
    {
      for (const bool first : { true, false })
      {
        Json with = scene();
        with[list].insert(first ? with[list].begin() : with[list].end(), item);
        const std::map<std::string, std::string> after = itemsOf(written(with, number));
        EXPECT_EQ(after.size(), before.size() + 1);
        expectAllOf(before, after);
      }
    }
  }
}

TEST(SampleIndependence, TheOrderOfKeysAndItemsDoesNotMatter)
{
  for (const int number : { 0, 700 })
  {
    const std::string before = written(scene(), number);
    EXPECT_EQ(written(reversed(scene()), number), before);
    EXPECT_NE(reversed(scene()).dump(), scene().dump());
    Json turned = scene();
    for (const char* list : { "objects", "cameras" })
    {
      std::reverse(turned[list].begin(), turned[list].end());
    }
    expectAllOf(itemsOf(before), itemsOf(written(turned, number)));
  }
}
