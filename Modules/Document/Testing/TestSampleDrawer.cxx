// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampleDrawer.h"

#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <string>

using namespace dgtk;

namespace
{
std::string balls(const std::string& camera = R"("lookAt": [0, 0, 0])")
{
  return R"({ "seed": 3, "parameters": { "n": { "integer": [1, 9] }, "sky": [0, 0, 1] }, "background": "$sky", "objects": [ { "name": "ball", "count": "$n",
    "materials": { "*": { "diffuse": { "inBox": [[0, 0, 0], [1, 1, 1]] } } }, "model": ")" +
         test::sourceFile("Data/Models/ball.ac") + R"(" } ],
    "cameras": [ { "name": "c", "eye": { "shell": { "center": "ball", "radius": 9 } } },
      { "name": "d", "eye": { "inBox": [[4, 4, 4], [5, 5, 5]] }, )" +
         camera + " } ] }";
}

void write(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

std::string valueOf(const DrawnSample& drawn, const std::string& path)
{
  const auto found = std::find_if(
    drawn.values.begin(), drawn.values.end(), [&](const SampleValue& value) { return value.path == path; });
  return found == drawn.values.end() ? "none" : found->value;
}
} // namespace

TEST(SampleDrawer, DrawsWhatTheSamplerDoes)
{
  const test::TemporaryFolder folder;
  const std::string file = folder.path("balls.json");
  std::string text = balls();
  text.replace(text.find("\"eye\": { \"shell\""), 5, "\"lookAt\": \"ball\", \"eye\"");
  write(file, text);
  EXPECT_TRUE(isRandomScene(file));
  SampleDrawer drawer(file);
  for (const int number : { 0, 7, 3 })
  {
    const std::optional<DrawnSample> drawn = drawer.draw(number);
    ASSERT_TRUE(drawn);
    ASSERT_TRUE(drawn->scene) << drawn->fault;
    const SceneSample sample = Sampler(RandomScene::read(file)).draw(std::uint64_t(number));
    EXPECT_EQ(toJson(drawn->scene->scene, "/x"), toJson(sample.scene, "/x"));
    EXPECT_EQ(drawn->seed, 3U);
    EXPECT_EQ(drawn->scene->path, "");
    for (const ObjectDescription& object : drawn->scene->scene.objects)
    {
      EXPECT_NE(drawn->scene->models.modelOf(drawn->scene->scene, object), nullptr);
    }
    EXPECT_EQ(valueOf(*drawn, "parameters/n"), std::to_string(sample.scene.objects.size()));
    EXPECT_EQ(valueOf(*drawn, "parameters/sky"), "[0, 0, 1]");
    EXPECT_EQ(valueOf(*drawn, "objects/ball#1/materials/*/diffuse").substr(0, 1), "[");
    EXPECT_EQ(valueOf(*drawn, "cameras/d/eye").substr(0, 1), "[");
    EXPECT_EQ(valueOf(*drawn, "cameras/c/eye"), "none") << "geometry decides it";
  }
  const std::string other = toJson(drawer.draw(3, 4)->scene->scene, "/x");
  EXPECT_NE(toJson(drawer.draw(3)->scene->scene, "/x"), other) << "its own seed again";
  text.replace(text.find("[1, 9]"), 6, "[9, 9]");
  write(file, text);
  EXPECT_EQ(drawer.draw(0)->scene->scene.objects.size(), 9U) << "of the file as it is now";
}

TEST(SampleDrawer, SaysWhyThereIsNone)
{
  const test::TemporaryFolder folder;
  const std::string file = folder.path("scene.json");
  EXPECT_FALSE(isRandomScene(file));
  SampleDrawer drawer(file);
  std::optional<DrawnSample> drawn = drawer.draw(0);
  EXPECT_FALSE(drawn->scene || drawn->seed || drawn->refused);
  EXPECT_NE(drawn->fault.find("scene.json"), std::string::npos);

  write(file, R"({ "objects": [] })");
  EXPECT_FALSE(isRandomScene(file));
  EXPECT_TRUE(drawer.draw(0)->scene) << "a plain scene is its own sample";

  const std::string never = R"("lookAt": [0, 99, 0], "require": { "visible": { "ball": 1 }, "attempts": )";
  std::string scene = balls(never + "3 }");
  scene.erase(scene.find("{ \"name\": \"c\""), scene.find("{ \"name\": \"d\"") - scene.find("{ \"name\": \"c\""));
  write(file, scene);
  drawn = drawer.draw(0);
  EXPECT_FALSE(drawn->scene);
  EXPECT_TRUE(drawn->refused);
  ASSERT_EQ(drawn->notes.size(), 1U);
  EXPECT_EQ(drawn->notes[0].path, "cameras/d/require");
  EXPECT_EQ(drawn->notes[0].attempts, 3);
  EXPECT_EQ(drawn->fault, drawn->notes[0].path + ": " + drawn->notes[0].why);
  EXPECT_NE(valueOf(*drawn, "parameters/n"), "none") << "what was drawn before";
  EXPECT_EQ(std::count_if(drawn->values.begin(), drawn->values.end(),
              [](const SampleValue& value) { return value.path == "cameras/d/eye"; }),
    1)
    << "of the last attempt alone";

  int asked = 0;
  EXPECT_FALSE(drawer.draw(0, {}, [&asked] { return ++asked > 2; }));
  EXPECT_EQ(asked, 3);
}

/// Each sample has colours of its own, and with them models of its own.
TEST(SampleDrawer, KeepsFewModels)
{
  const test::TemporaryFolder folder;
  const std::string file = folder.path("balls.json");
  std::string text = balls();
  text.erase(text.find("{ \"name\": \"c\""), text.find("{ \"name\": \"d\"") - text.find("{ \"name\": \"c\""));
  text.replace(text.find("[1, 9]"), 6, "[200, 200]");
  write(file, text);
  SampleDrawer drawer(file);
  std::size_t most = 0;
  for (int number = 0; number < 12; ++number)
  {
    const std::optional<DrawnSample> drawn = drawer.draw(number);
    ASSERT_TRUE(drawn->scene) << drawn->fault;
    most = std::max(most, drawn->scene->models.size());
  }
  EXPECT_GT(most, 400U) << "nothing was kept";
  EXPECT_LE(most, 1200U);
}
