// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkGenerator.h"
#include "dgtkLayers.h"
#include "dgtkPacking.h"
#include "dgtkRenderer.h"
#include "dgtkScene.h"
#include "dgtkTestSupport.h"

#include "dgtkFile.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <vtkDataArray.h>
#include <vtkSmartPointer.h>

#include <cmath>
#include <map>

using namespace dgtk;

// A wall in the plane z = 0 before cameras that look along -z from z = 5: all values have closed forms.

namespace
{
constexpr int wallWidth = 32;
constexpr int wallHeight = 24;
constexpr double focal = 40;
constexpr double depth = 5;

class Wall : public testing::Test
{
protected:
  void SetUp() override
  {
    writeFile(this->path("wall.ac"),
      "AC3Db\nMATERIAL \"\" rgb 1 0.4 0.2 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans 0\nOBJECT poly\nnumvert 4\n"
      "-20 -20 0\n20 -20 0\n20 20 0\n-20 20 0\nnumsurf 1\nSURF 0x00\nmat 0\nrefs 4\n0 0 0\n1 0 0\n2 0 0\n3 0 0\nkids "
      "0\n");
    writeFile(this->path("scene.json"), R"({"version": 1, "objects": [{"model": "wall.ac", "name": "wall",
      "position": {"keys": [[0, [0, 0, 0]], [4, [2, 1, -4]]]}}, {"model": "wall.ac", "name": "far",
      "position": [0, 0, -3]}], "cameras": [)" +
                                          camera("b", 0.5) + ", " + camera("c", 3) + ", " + camera("a", 0) + "]}");
  }
  static std::string camera(const std::string& name, double x)
  {
    return "{\"name\": \"" + name + "\", \"width\": 32, \"height\": 24, \"near\": 1, \"far\": 100, " +
           "\"K\": [[40, 0, 16], [0, 40, 12], [0, 0, 1]], \"orientation\": [0, 1, 0, 0], \"position\": [" +
           std::to_string(x) + ", 0, 5]}";
  }
  std::string path(const std::string& name) const { return this->Folder.path(name); }
  std::shared_ptr<const Stage> stage() const { return Stage::load(readScene(this->path("scene.json"))); }

  /// What a renderer gives for layers of a camera, by name and part.
  std::map<std::string, vtkSmartPointer<vtkDataArray>> render(
    const std::string& layers, const std::string& camera, const std::string& pairs = "", int step = 8)
  {
    const auto scene = vtkSmartPointer<dgtkScene>::New();
    EXPECT_TRUE(scene->Load(this->path("scene.json"))) << scene->GetErrorMessage();
    const auto renderer = vtkSmartPointer<dgtkRenderer>::New();
    renderer->SetScene(scene);
    renderer->SetVisibility("ray");
    renderer->SetCamera(camera);
    renderer->SetOption("points_step", std::to_string(step));
    if (!pairs.empty())
    {
      renderer->SetOption("pairs", pairs);
    }
    EXPECT_TRUE(renderer->RenderLayers(layers)) << renderer->GetErrorMessage();
    std::map<std::string, vtkSmartPointer<vtkDataArray>> found;
    for (int i = 0; i < renderer->GetNumberOfOutputs(); ++i)
    {
      found[renderer->GetOutput(i)->GetName() + renderer->GetOutputPart(i) + renderer->GetOutputFormat(i)] =
        renderer->GetOutput(i);
    }
    return found;
  }

  test::TemporaryFolder Folder;
};

/// Component `c` of all pixels is `expected` of the column and the row.
template <typename Expected>
void expectPixels(vtkDataArray* array, int c, const Expected& expected)
{
  ASSERT_TRUE(array);
  ASSERT_EQ(array->GetNumberOfTuples(), wallWidth * wallHeight);
  for (int y = 0; y < wallHeight; ++y)
  {
    for (int x = 0; x < wallWidth; ++x)
    {
      const double found = array->GetComponent(y * wallWidth + x, c);
      const double right = expected(x + 0.5, y + 0.5);
      ASSERT_TRUE(std::isnan(right) ? std::isnan(found) : std::abs(found - right) <= 1e-12 * (1 + std::abs(right)))
        << array->GetName() << ' ' << x << ' ' << y << ": " << found << ", not " << right;
    }
  }
}
} // namespace

TEST_F(Wall, Disparities)
{
  // c's nearest neighbour is b, though a is farther to the left
  for (const auto& [name, baseline] : { std::pair("a", 0.5), std::pair("b", 0.5), std::pair("c", 2.5) })
  {
    const double expected = focal * baseline / depth;
    expectPixels(this->render("disparity", name)["disparity"], 0, [&](double, double) { return expected; });
  }
}

TEST_F(Wall, DisparitiesOfTheNextFrame)
{
  // the wall goes away by 1 a frame, the far one, 3 behind, stays: hidden now, seen from frame 4
  for (const auto& [name, baseline] : { std::pair("a", 0.5), std::pair("b", 0.5), std::pair("c", 2.5) })
  {
    auto found = this->render("disparity_forward", name);
    const double expected = focal * baseline / (depth + 1);
    expectPixels(found["disparity_forward"], 0, [&](double, double) { return expected; });
    // of the left camera of a pair x' = x at the next frame - disparity, of the right one +
    const double side = name == std::string("a") ? -1 : 1;
    const auto place = [&](double x)
    { return 16 + focal * ((x - 16) / focal * depth + 0.5) / (depth + 1) + side * expected; };
    expectPixels(found["disparity_forward_class"], 0,
      [&](double x, double y)
      {
        const double down = 12 - focal * ((12 - y) / focal * depth + 0.25) / (depth + 1);
        return place(x) >= 0 && place(x) <= wallWidth && down >= 0 && down <= wallHeight ? 1 : 4;
      });
  }
}

TEST_F(Wall, CorrespondencesAndFlows)
{
  auto found = this->render("correspondence,flow_forward,sceneflow,depth", "a", "a:b,a:b+2,a:a+1,c:a");
  EXPECT_EQ(found.count("correspondence_a"), 0u);
  // b stands 0.5 to the right; at frame 2 the wall has gone by (1, 0.5, -2)
  expectPixels(found["correspondence_b"], 0, [](double x, double) { return x - focal * 0.5 / depth; });
  expectPixels(found["correspondence_b"], 1, [](double, double y) { return y; });
  const auto later = [](double x, double y, double frames, double baseline, int c)
  {
    const Eigen::Vector2d at(
      (x - 16) / focal * depth + 0.5 * frames - baseline, (12 - y) / focal * depth + 0.25 * frames);
    return c == 0 ? 16 + focal * at.x() / (depth + frames) : 12 - focal * at.y() / (depth + frames);
  };
  for (int c = 0; c < 2; ++c)
  {
    expectPixels(found["correspondence_b+2"], c, [&](double x, double y) { return later(x, y, 2, 0.5, c); });
    expectPixels(found["correspondence_a+1"], c, [&](double x, double y) { return later(x, y, 1, 0, c); });
    expectPixels(found["flow_forward"], c, [&](double x, double y) { return later(x, y, 1, 0, c) - (c == 0 ? x : y); });
  }
  const double motion[] = { 0.5, -0.25, 1 }; // in the camera's axes
  for (int c = 0; c < 3; ++c)
  {
    expectPixels(found["sceneflow"], c, [&](double, double) { return motion[c]; });
  }
  expectPixels(found["depth"], 0, [](double, double) { return depth; });
  expectPixels(
    found["correspondence_b_class"], 0, [](double x, double) { return x - 4 < 0 ? 4 : 1; }); // outside on the left
}

TEST_F(Wall, FramesAreThoseOfTheScene)
{
  GeneratorRequest request;
  request.layers = { "depth" };
  for (const auto& [range, good] : { std::pair(FrameRange{ 0, 4, 1 }, true), std::pair(FrameRange{ 4, 4, 9 }, true),
         std::pair(FrameRange{ -1, 4, 1 }, false), std::pair(FrameRange{ 0, 5, 1 }, false) })
  {
    request.frames = range;
    if (good)
    {
      EXPECT_EQ(
        int(makeWorkPlan(request, *this->stage()).jobs.size()), 3 * ((range.last - range.first) / range.step + 1));
    }
    else
    {
      EXPECT_THROW(makeWorkPlan(request, *this->stage()), UsageError) << range.first << ' ' << range.last;
    }
  }
}

TEST_F(Wall, PairsThatAreRefused)
{
  GeneratorRequest request;
  request.layers = { "correspondence" };
  request.cameras = { "a", "b" };
  const auto refusal = [&](const std::string& pair) -> std::string
  {
    request.options["pairs"] = pair;
    try
    {
      makeWorkPlan(request, *this->stage());
    }
    catch (const UsageError& error)
    {
      return error.what();
    }
    return {};
  };
  for (const char* pair : { "a:b", "b:a", "a:c", "a:a+1", "a:a-1", "a:b+0", "b:c-4", "a:a+4" })
  {
    EXPECT_EQ(refusal(pair), "") << pair;
  }
  for (const char* pair :
    { "a:a", "a:a+0", "a:d", "d:a", "c:a", "a", "a:", ":b", "a:b+", "a:b+x", "a:b1", "a:b+5", "a:a-5", "a:b+12345678" })
  {
    EXPECT_NE(refusal(pair), "") << pair;
  }
}

// Every 8th pixel from 4.5 on, of b, then what only c sees, then what only a sees.
TEST_F(Wall, PointsAreSeenOnce)
{
  const auto found = this->render("points", "b");
  std::string text;
  vtkDataArray* bytes = found.at("pointsjson");
  for (vtkIdType i = 0; i < bytes->GetNumberOfTuples(); ++i)
  {
    text += static_cast<char>(bytes->GetComponent(i, 0));
  }
  const nlohmann::json document = nlohmann::json::parse(text);
  EXPECT_EQ(document["cameras"], (nlohmann::json{ "b", "c", "a" }));
  const double places[] = { 0.5, 3, 0 };
  std::vector<std::vector<double>> expected; // x, y, then camera and column of each sight
  for (int own = 0; own < 3; ++own)
  {
    for (int j = 4; j < wallHeight; j += 8)
    {
      for (int i = 4; i < wallWidth; i += 8)
      {
        const double u = i + 0.5;
        const double v = j + 0.5;
        const double x = (u - 16) / focal * depth + places[own];
        std::vector<double> point{ x, (12 - v) / focal * depth, double(own), u };
        bool earlier = false;
        for (int other = 0; other < 3; ++other)
        {
          const double column = 16 + focal * (x - places[other]) / depth;
          const bool seen = other != own && column > 0 && column < wallWidth;
          earlier = earlier || (seen && other < own);
          if (seen)
          {
            point.insert(point.end(), { double(other), column });
          }
        }
        if (!earlier)
        {
          expected.push_back(point);
        }
      }
    }
  }
  ASSERT_EQ(document["points"].size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    const nlohmann::json& point = document["points"][i];
    EXPECT_NEAR(point["x"][0].get<double>(), expected[i][0], 1e-12);
    EXPECT_NEAR(point["x"][1].get<double>(), expected[i][1], 1e-12);
    EXPECT_EQ(point["x"][2].get<double>(), 0);
    EXPECT_EQ(point["object"], 1);
    std::map<int, double> sights;
    for (const nlohmann::json& sight : point["track"])
    {
      sights[sight[0].get<int>()] = sight[1].get<double>();
      EXPECT_NEAR(sight[2].get<double>(), 12 - focal * expected[i][1] / depth, 1e-12);
    }
    ASSERT_EQ(sights.size(), (expected[i].size() - 2) / 2) << i;
    for (std::size_t k = 2; k < expected[i].size(); k += 2)
    {
      EXPECT_NEAR(sights[int(expected[i][k])], expected[i][k + 1], 1e-12) << i;
    }
  }
}

TEST_F(Wall, PlansNeedWhatAnyOfTheirLayersNeeds)
{
  GeneratorRequest request;
  request.options["matte"] = "far,wall";
  const auto needs = [&](const std::vector<std::string>& layers)
  {
    request.layers = layers;
    return makeWorkPlan(request, *this->stage()).needs;
  };
  EXPECT_THAT(needs({ "matting" }).mattes, testing::UnorderedElementsAre(1u, 2u));
  EXPECT_THAT(needs({ "all" }).mattes, testing::UnorderedElementsAre(1u, 2u));
  EXPECT_TRUE(needs({ "all" }).hits && needs({ "all" }).color && needs({ "all" }).peeled);
  EXPECT_TRUE(needs({ "depth" }).hits);
  EXPECT_FALSE(needs({ "depth" }).color || needs({ "depth" }).peeled);
  EXPECT_TRUE(needs({ "color", "depth" }).hits && needs({ "depth", "color" }).color);
  EXPECT_FALSE(needs({ "color" }).hits);
}

TEST_F(Wall, WhatARequestNamesIsInTheOrderOfTheSceneOnce)
{
  GeneratorRequest request;
  request.layers = { "normal", "depth", "depth" };
  request.options["depth_format"] = "pfm,npy,pfm";
  request.cameras = { "a", "b", "a" };
  request.frames = FrameRange{ 1, 4, 2 };
  const WorkPlan plan = makeWorkPlan(request, *this->stage());
  ASSERT_EQ(plan.layers.size(), 2u);
  EXPECT_EQ(plan.layers[0].layer->info().layer, "depth");
  EXPECT_THAT(plan.formatsOf("depth"), testing::ElementsAre("npy", "pfm"));
  EXPECT_THAT(plan.formatsOf("normal"), testing::ElementsAre("npy"));
  EXPECT_THAT(plan.formatsOf("color"), testing::IsEmpty());
  std::vector<std::pair<std::size_t, int>> jobs;
  for (const Job& job : plan.jobs)
  {
    jobs.emplace_back(job.camera, job.frame);
  }
  EXPECT_THAT(jobs, testing::ElementsAre(std::pair(0u, 1), std::pair(2u, 1), std::pair(0u, 3), std::pair(2u, 3)));
  EXPECT_EQ(WorkPlan::stem("cam", "depth", 42), "cam/depth/000042");
  EXPECT_EQ(WorkPlan::stem("cam", "depth", 1234567), "cam/depth/1234567");
}

TEST_F(Wall, ADatasetIsNotPackedIntoTheFolderThatItIsLoadedFrom)
{
  for (const char* folder : { "d", "a/inputs", "z/inputs" })
  {
    makeFolders(this->path(folder));
  }
  const std::string wall = readFile(this->path("wall.ac"));
  for (const auto& [home, refused] : { std::pair("a", true), std::pair("z", false), std::pair(".", false) })
  {
    writeFile(this->path(std::string(home) + "/inputs.ac"), wall);
    const std::string model = refused ? "inputs/wall.ac" : "inputs.ac";
    writeFile(this->path(std::string(home) + '/' + model), wall);
    writeFile(this->path(std::string(home) + "/s.json"), "{\"objects\": [{\"model\": \"" + model + "\"}]}");
    const auto stage = Stage::load(readScene(this->path(std::string(home) + "/s.json")));
    const auto pack = [&, folder = this->path(home)] { refuseOwnInputs(*stage, folder); };
    if (refused)
    {
      EXPECT_THROW(pack(), UsageError);
      EXPECT_NO_THROW(refuseOwnInputs(*stage, this->path("d")));
    }
    else
    {
      EXPECT_NO_THROW(pack());
    }
  }
}
