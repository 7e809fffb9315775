// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampler.h"

#include "dgtkFile.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

using namespace dgtk;

namespace
{
/// What is measured of a camera by a rule; its objects are `objects`. The note's `why` is in its place where it fails.
std::string measured(
  const std::string& objects, const std::string& camera, const std::string& require, const std::string& name)
{
  const test::TemporaryFolder folder;
  const std::string square = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";
  writeFile(folder.path("square.obj"), square);
  writeFile(folder.path("sheets.obj"), square + "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nf 5 6 7 8\n");
  const std::string json = R"({ "seed": 1, "objects": [ )" + objects + R"( ], "cameras": [ { "name": "c", )" + camera +
                           R"(, "require": { "otherwise": "omit", "attempts": 1, )" + require + " } } ] }";
  const SceneSample sample = Sampler(RandomScene::ofText(json, folder.path())).draw(0);
  EXPECT_EQ(sample.notes.size(), 1U);
  const SampleNote& note = sample.notes.at(0);
  EXPECT_EQ(note.kept, note.why.empty());
  for (const auto& [what, value] : note.measured)
  {
    if (what == name && note.kept)
    {
      std::ostringstream text;
      text << value;
      return text.str();
    }
  }
  return note.why;
}

std::string object(const std::string& name, const std::string& position, const std::string& scale)
{
  return R"({ "name": ")" + name + R"(", "model": "square.obj", "position": )" + position + R"(, "scale": )" + scale +
         " }";
}

const std::string wall = object("wall", "[0, 0, 0]", "[100, 100, 1]");

/// A view along -z of [-4, 4] x [-3, 3].
std::string view(const std::string& more)
{
  return R"("model": "orthographic", "eye": [0, 0, 10], "lookAt": [0, 0, 0])" + more;
}
} // namespace

TEST(CameraRequirement, CountsPixelsOfASmallPicture)
{
  // A pane hides the upper left corner: 3.2 of 8 units to the side, 2.2 of 6 down.
  const std::string pane = object("pane", "[-2.4, 1.9, 1]", "[1.6, 1.1, 1]");
  struct Row
  {
    const char* camera;
    int pixels;
    int all, hidden;
  };
  for (const Row& row : { Row{ R"(, "viewHeight": 6)", 8, 48, 3 * 2 }, { R"(, "viewHeight": 6)", 16, 192, 6 * 4 },
         { R"(, "viewHeight": 6, "width": 800, "height": 600)", 40, 1200, 16 * 11 },
         { R"(, "viewHeight": 6, "width": 4, "height": 3)", 8, 48, 3 * 2 },
         { R"(, "viewHeight": 6, "width": 300, "height": 600)", 20, 200, 2 * 7 },
         { R"(, "viewHeight": 6, "width": 1600, "height": 20)", 8, 8, 0 } })
  {
    const std::string require = R"("pixels": )" + std::to_string(row.pixels) + R"(, "visible": { "wall": 0.1 })";
    std::ostringstream share;
    share << double(row.all - row.hidden) / row.all;
    EXPECT_EQ(measured(wall + ", " + pane, view(row.camera), require, "visible wall"), share.str()) << row.camera;
  }
}

TEST(CameraRequirement, TheLeastOfAllThatFitThePatternCounts)
{
  const std::string both = wall + ", " + object("pane1", "[-2, 0, 1]", "[1, 1, 1]") + ", " +
                           object("pane2", "[-1, 0, 2]", "[1, 1, 1]") + ", " + object("off", "[0, 9, 1]", "[1, 1, 1]");
  const std::string camera = view(R"(, "viewHeight": 6)");
  EXPECT_EQ(measured(both, camera, R"("pixels": 80, "visible": { "pane*": 0.5 })", "visible pane*"), "0.5");
  EXPECT_EQ(measured(both, camera, R"("pixels": 80, "visible": { "pane2": 1 })", "visible pane2"), "1");
  EXPECT_EQ(measured(both, camera, R"("pixels": 80, "visible": { "pane*": 0.51 })", "visible pane*"),
    "pane* is visible by 0.5 of 0.51 at frame 0");
  EXPECT_EQ(measured(both, camera, R"("pixels": 80, "visible": { "off": 0.25 })", "visible off"),
    "off is visible by 0 of 0.25 at frame 0");
  EXPECT_THAT(test::thrownBy<InputError>(
                [&] { measured(both, camera, R"("pixels": 80, "visible": { "zz*": 0.25 })", "visible zz*"); }),
    testing::HasSubstr("require.visible names no object (expected the name of an object of the scene, found 'zz*')"));
}

TEST(CameraRequirement, APixelCountsOnceForAllSheetsOfAnObject)
{
  const std::string sheets = R"({ "name": "sheets", "model": "sheets.obj" })";
  const std::string camera = view(R"(, "viewHeight": 6)");
  const std::string require = R"("pixels": 80, "visible": { "sheets": 0.1 })";
  EXPECT_EQ(measured(sheets, camera, require, "visible sheets"), "1");
  EXPECT_EQ(
    measured(sheets + ", " + object("half", "[1, 0, 1]", "[1, 1, 1]"), camera, require, "visible sheets"), "0.5");
}

TEST(CameraRequirement, HoldsAtSomeKeyFrames)
{
  // A square comes near to the camera in one frame of many.
  const auto near = [](int frame, int frames)
  {
    std::string keys;
    for (int i = 0; i < frames; ++i)
    {
      keys += (i == 0 ? "[" : ", [") + std::to_string(i) + ", [0, 0, " + (i == frame ? "8" : "0") + "]]";
    }
    return object("it", R"({ "keys": [ )" + keys + " ] }", "[1, 1, 1]");
  };
  struct Row
  {
    int frame, frames;
    bool seen;
  };
  for (const Row& row : { Row{ 0, 1, true }, { 1, 32, true }, { 31, 32, true }, { 0, 64, true }, { 1, 64, false },
         { 2, 64, true }, { 61, 64, false }, { 60, 64, true }, { 63, 64, true }, { 32, 33, true }, { 31, 33, false } })
  {
    const std::string scene = near(row.frame, row.frames);
    const std::string camera = view(R"(, "viewHeight": 6)");
    EXPECT_EQ(measured(scene, camera, R"("clearance": 1)", "clearance"), row.seen ? "2" : "10") << row.frame;
    EXPECT_EQ(measured(scene, camera, R"("clearance": 2)", "clearance"), row.seen ? "2" : "10");
    EXPECT_EQ(measured(scene, camera, R"("clearance": 3)", "clearance"),
      row.seen ? "a surface is at 2, nearer than 3, at frame " + std::to_string(row.frame) : "10");
  }
}
