// SPDX-License-Identifier: BSD-3-Clause
// What a request becomes: which layers, pairs of cameras and frames, and what is refused. Nothing is drawn.
#include "dgtkError.h"
#include "dgtkLayers.h"
#include "dgtkSceneDescription.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <string>
#include <vector>

using namespace dgtk;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace
{
/// A camera at a place of the x axis; all look the same way.
std::string cameraText(const std::string& name, double x, const std::string& more = {})
{
  return "{\"name\": \"" + name + "\", \"width\": 8, \"height\": 6, \"orientation\": [1, 0, 0, 0], \"position\": [" +
         std::to_string(x) + ", 0, 0]" + (more.empty() ? "" : ", ") + more + '}';
}

/// A scene of frames 1 to 4, of nothing but cameras unless it is given objects.
std::shared_ptr<const Stage> stageOf(const std::vector<std::string>& cameras, const std::string& objects = {})
{
  const test::TemporaryFolder folder;
  std::string text;
  for (const std::string& camera : cameras)
  {
    text += (text.empty() ? "" : ", ") + camera;
  }
  std::ofstream(folder.path("s.json")) << R"({"keyFrames": [1, 4], "objects": [)" << objects << R"(], "cameras": [)"
                                       << text << "]}";
  return Stage::load(readScene(folder.path("s.json")));
}

std::string crateText(const std::string& name)
{
  return "{\"name\": \"" + name + "\", \"model\": \"" + test::sourceFile("Data/Models/crate.ac") + "\"}";
}

LayerRequest requestOf(const std::vector<std::string>& names, const OptionValues& options = {})
{
  LayerRequest request;
  request.layers = names;
  request.options = options;
  return request;
}

/// What a request is refused with; "" where it is not.
std::string refusal(const LayerRequest& request, const Stage& stage)
{
  return test::thrownBy<UsageError>([&] { makeWorkPlan(request, stage); });
}

/// Folders of the pairs of each job, by the job's frame and camera.
std::map<std::pair<int, std::string>, std::vector<std::string>> foldersOf(const std::string& pairs, const Stage& stage)
{
  const WorkPlan plan = makeWorkPlan(requestOf({ "correspondence" }, { { "pairs", pairs } }), stage);
  std::map<std::pair<int, std::string>, std::vector<std::string>> folders;
  for (const Job& job : plan.jobs)
  {
    for (const LayerOutput& output : outputsOf(plan, stage, job))
    {
      if (output.layer == "correspondence")
      {
        folders[{ job.frame, stage.cameraNames()[job.camera] }].push_back(output.name);
      }
    }
  }
  return folders;
}
} // namespace

TEST(Plan, PairsAreOfCamerasWhoseNamesHoldSigns)
{
  const auto stage = stageOf(
    { cameraText("a", 0), cameraText("b", 2), cameraText("b+1", 3), cameraText("b1", 4), cameraText("b-2", 5) });
  using Folders = std::map<std::pair<int, std::string>, std::vector<std::string>>;
  const auto all = [](const std::string& camera, const std::vector<std::string>& names, int first = 1, int last = 4)
  {
    Folders folders;
    for (int frame = first; frame <= last; ++frame)
    {
      folders[{ frame, camera }] = names;
    }
    return folders;
  };
  EXPECT_EQ(foldersOf("a:b", *stage), all("a", { "correspondence_b" }));
  EXPECT_EQ(foldersOf("a:b+1", *stage), all("a", { "correspondence_b+1" })) << "a camera, though b is named before";
  EXPECT_EQ(foldersOf("a:b+2", *stage), all("a", { "correspondence_b+2" }, 1, 2)) << "b two frames later";
  EXPECT_EQ(foldersOf("a:b+1+2", *stage), all("a", { "correspondence_b+1+2" }, 1, 2));
  EXPECT_EQ(foldersOf("b+1:a-3", *stage), all("b+1", { "correspondence_a-3" }, 4, 4));
  EXPECT_EQ(foldersOf("a:a+1,a:a+1,a:a+000001", *stage), all("a", { "correspondence_a+1" }, 1, 3));
  EXPECT_EQ(foldersOf("a:b-0,a:b,a:b-002,a:b-2", *stage), all("a", { "correspondence_b", "correspondence_b-2" }));
  EXPECT_EQ(foldersOf("a:b-2", *stage), all("a", { "correspondence_b-2" }));
  EXPECT_EQ(foldersOf("a:b-1", *stage), all("a", { "correspondence_b-1" }, 2, 4));
  EXPECT_EQ(foldersOf("a:b+1+2,a:b", *stage).at({ 2, "a" }),
    (std::vector<std::string>{ "correspondence_b+1+2", "correspondence_b" }));
  EXPECT_EQ(foldersOf("all", *stage).at({ 1, "b" }),
    (std::vector<std::string>{ "correspondence_a", "correspondence_b+1", "correspondence_b1", "correspondence_b-2" }));
}

TEST(Plan, PairsThatAreNone)
{
  const auto stage = stageOf({ cameraText("a", 0), cameraText("b", 1) });
  const auto refused = [&](const std::string& pairs, const std::vector<std::string>& cameras = {})
  {
    LayerRequest request = requestOf({ "correspondence" }, { { "pairs", pairs } });
    request.cameras = cameras;
    return refusal(request, *stage);
  };
  for (const char* const pair : { "a", "b:", "a:c", "c:a", "ab", "a:b+", "a:b-", "a:b1", "a:b 1", "a:b+1x", "a:b++1",
         "a:b+0000001", "a:b+12345678901234567890" })
  {
    EXPECT_THAT(refused(pair), HasSubstr("expected FROM:TO")) << pair;
  }
  EXPECT_THAT(refused("a:c"), HasSubstr("found 'a:c', where 'c' is no camera"));
  EXPECT_THAT(refused("c:b"), HasSubstr("found 'c:b', where 'c' is no camera"));
  EXPECT_THAT(refused("a:c+1"), HasSubstr("found 'a:c+1', where 'c' is no camera"));
  EXPECT_THAT(refused("a:b+x"), testing::EndsWith("found 'a:b+x'"));
  EXPECT_THAT(refused("a:b,a:a"), HasSubstr("'a:a' is a camera with itself at the same frame"));
  EXPECT_THAT(refused("a:a+0"), HasSubstr("is a camera with itself at the same frame"));
  EXPECT_THAT(refused("a:a+1"), IsEmpty());
  EXPECT_THAT(refused("a:b,b:a", { "a" }), HasSubstr("camera 'b' is not among those of the run"));
  EXPECT_THAT(refused("a:b", { "a" }), IsEmpty()) << "only where it begins";
  EXPECT_THAT(refused("a:b+3"), IsEmpty());
  EXPECT_THAT(refused("b:a,a:b+4"), HasSubstr("pair 'a:b+4' leads from every frame"));
  EXPECT_THAT(refused("b:a-3"), IsEmpty());
  EXPECT_THAT(refused("b:a-4"), HasSubstr("leads from every frame"));
  LayerRequest later = requestOf({ "correspondence" }, { { "pairs", "a:b+1" } });
  later.frames = FrameRange{ 4, 4, 1 };
  EXPECT_THAT(refusal(later, *stage), HasSubstr("leads from every frame"));
}

/// Left and right from frame 2 on are what right and left were at frame 1.
TEST(Plan, CamerasThatChangeSidesAreNoPairFromOneFrameToTheOther)
{
  const auto camera = [](const std::string& name, int first, int later)
  {
    return R"({"name": ")" + name +
           R"(", "width": 8, "height": 6, "orientation": [1, 0, 0, 0], "position": {"keys": [[1, [)" +
           std::to_string(first) + ", 0, 0]], [2, [" + std::to_string(later) + ", 0, 0]]]}}";
  };
  const auto stage = stageOf({ camera("a", 0, 1), camera("b", 1, 0) });
  const WorkPlan plan = makeWorkPlan(requestOf({ "disparity", "disparity_forward", "disparity_backward" }), *stage);
  std::map<std::string, std::vector<int>> frames;
  for (const Job& job : plan.jobs)
  {
    for (const LayerOutput& output : outputsOf(plan, *stage, job))
    {
      if (job.camera == 0 && output.layer.find("class") == std::string::npos)
      {
        frames[output.layer].push_back(job.frame);
      }
    }
  }
  EXPECT_THAT(frames["disparity"], ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(frames["disparity_forward"], ElementsAre(2, 3));
  EXPECT_THAT(frames["disparity_backward"], ElementsAre(3, 4));
}

TEST(Plan, NeighbouringFramesThatTheRunLeavesOutDeserveAWord)
{
  const auto stage = stageOf({ cameraText("a", 0), cameraText("b", 1) });
  LayerRequest request = requestOf({ "all" });
  const auto notes = [&]
  {
    const WorkPlan plan = makeWorkPlan(request, *stage);
    std::map<std::string, std::string> words;
    for (const PlannedLayer& planned : plan.layers)
    {
      const std::vector<std::string> lines = planned.layer->notes(plan, *stage);
      if (lines.size() == 1 && lines[0].find(" leads to ") != std::string::npos)
      {
        words[planned.layer->info().layer] = lines[0];
      }
    }
    return words;
  };
  EXPECT_THAT(notes(), IsEmpty());
  request.frames = FrameRange{ 1, 4, 1 };
  EXPECT_THAT(notes(), IsEmpty());
  request.frames = FrameRange{ 1, 4, 3 };
  std::map<std::string, std::string> expected;
  for (const std::string layer :
    { "disparity_forward", "disparity_backward", "flow_forward", "flow_backward", "sceneflow" })
  {
    const bool earlier = layer.find("backward") != std::string::npos;
    expected[layer] = "layer " + layer + " leads to the scene's frame one " + (earlier ? "earlier" : "later") +
                      ", which this run of every 3 frames does not have";
    if (layer.find("disparity") == std::string::npos)
    {
      expected[layer] += " (correspondence of the pair NAME:NAME+3 leads on to its next one)";
    }
  }
  EXPECT_EQ(notes(), expected);
}

TEST(Plan, FramesAreThoseOfTheScene)
{
  const auto stage = stageOf({ cameraText("a", 0) });
  const auto framesOf = [&](int first, int last, int step)
  {
    LayerRequest request = requestOf({ "depth" });
    request.frames = FrameRange{ first, last, step };
    std::vector<int> frames;
    for (const Job& job : makeWorkPlan(request, *stage).jobs)
    {
      frames.push_back(job.frame);
    }
    return frames;
  };
  const auto refused = [&](int first, int last, int step)
  { return test::thrownBy<UsageError>([&] { framesOf(first, last, step); }); };
  EXPECT_THAT(framesOf(1, 4, 1), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(framesOf(1, 4, 2), ElementsAre(1, 3));
  EXPECT_THAT(framesOf(2, 4, 2), ElementsAre(2, 4));
  EXPECT_THAT(framesOf(3, 3, 9), ElementsAre(3));
  EXPECT_THAT(refused(0, 4, 1), HasSubstr("frames 1 to 4, found 0"));
  EXPECT_THAT(refused(1, 5, 1), HasSubstr("frames 1 to 4, found 5"));
  EXPECT_THAT(refused(3, 2, 1), HasSubstr("found 3 to 2 by 1"));
  EXPECT_THAT(refused(1, 2, 0), HasSubstr("found 1 to 2 by 0"));
}

TEST(Plan, NamesOfNothingAreRefused)
{
  const auto stage = stageOf({ cameraText("a", 0), cameraText("b", 1) });
  EXPECT_THAT(refusal(requestOf({ "all", "depth" }), *stage), HasSubstr("unknown layer 'all'"));
  EXPECT_THAT(
    refusal(requestOf({ "depth", "dept" }), *stage), HasSubstr("unknown layer 'dept' (expected some of color"));
  LayerRequest request = requestOf({ "depth" });
  request.cameras = { "a", "c" };
  EXPECT_THAT(refusal(request, *stage), HasSubstr("the scene has no camera 'c' (it has a,b)"));
  request.cameras = { "b" };
  EXPECT_EQ(makeWorkPlan(request, *stage).jobs.front().camera, 1u);
  EXPECT_THAT(test::thrownBy<InputError>([] { makeWorkPlan(requestOf({ "depth" }), *stageOf({})); }),
    HasSubstr("the scene has no camera"));
}

TEST(Plan, WhatThePicturesCannotHave)
{
  const auto plain = stageOf({ cameraText("a", 0) });
  const auto refused = [&](const std::string& layer, const OptionValues& options)
  { return refusal(requestOf({ layer }, options), *plain); };
  EXPECT_THAT(refused("color", { { "filter", "gaussian" } }), HasSubstr("gaussian needs several samples"));
  EXPECT_THAT(refused("color", { { "filter", "gaussian" }, { "samples", "2" } }), IsEmpty());
  EXPECT_THAT(refused("color", { { "filter", "gaussian" }, { "samples", "2" }, { "renderer", "povray" } }),
    HasSubstr("needs several samples"));
  EXPECT_THAT(refused("color", { { "filter", "box" } }), IsEmpty());
  for (const OptionValues& curve : { OptionValues{ { "exposure", "1" } }, OptionValues{ { "tone", "filmic" } } })
  {
    EXPECT_THAT(refused("depth", curve), HasSubstr("are for pictures"));
    EXPECT_THAT(refused("color", curve), IsEmpty());
  }
  EXPECT_THAT(refused("depth", { { "pov_shadows", "on" } }), HasSubstr("pov_shadows: is for pictures and scenes"));
  EXPECT_THAT(refused("pov", { { "pov_shadows", "on" } }), IsEmpty());
  EXPECT_THAT(refused("color", { { "pov_shadows", "on" }, { "renderer", "povray" } }), IsEmpty());

  const OptionValues povray{ { "renderer", "povray" } };
  const auto lens = stageOf({ cameraText("a", 0), cameraText("l", 1, R"("lens": {"aperture": 0.1, "focus": 2})") });
  EXPECT_THAT(refusal(requestOf({ "color" }, povray), *lens), HasSubstr("camera 'l' has a lens"));
  const auto shutter = stageOf({ cameraText("s", 1, R"("shutter": {"open": 0, "close": 0.5})") });
  EXPECT_THAT(refusal(requestOf({ "color" }, povray), *shutter), HasSubstr("camera 's' has a shutter"));
  EXPECT_THAT(refusal(requestOf({ "depth" }, povray), *lens), IsEmpty());
  EXPECT_THAT(refusal(requestOf({ "color" }), *lens), IsEmpty());
}

using Left = std::map<std::string, std::size_t>;

/// Pictures without the layers that need linear projections.
Left leftOut(const WorkPlan& plan)
{
  Left left;
  for (const EmptyRecord& one : plan.empty)
  {
    if (one.needs == "a camera with a linear projection and no rolling shutter")
    {
      EXPECT_TRUE(left.emplace(one.layer, one.pictures).second) << one.layer;
      EXPECT_EQ(one.of, plan.jobs.size());
    }
  }
  return left;
}

std::ptrdiff_t countOf(const WorkPlan& plan, const Stage& stage, const Job& job, const std::string& layer)
{
  const std::vector<LayerOutput> outputs = outputsOf(plan, stage, job);
  return std::count_if(
    outputs.begin(), outputs.end(), [&](const LayerOutput& output) { return output.layer == layer; });
}

TEST(Plan, WhatIsDrawnNeedsALinearProjection)
{
  const std::string round = R"("model": "equirectangular")";
  const auto stage =
    stageOf({ cameraText("a", 0), cameraText("f", 1, round), cameraText("g", 2, round) }, crateText("crate"));
  const OptionValues vtk{ { "renderer", "vtk" } };
  const OptionValues raster{ { "visibility", "raster" } };
  const auto refused = [&](const std::string& layer, const OptionValues& options = {})
  { return refusal(requestOf({ layer }, options), *stage); };
  EXPECT_EQ(
    refused("color", vtk), "layer color: camera 'f' (equirectangular) has no linear projection, and cannot be drawn");
  EXPECT_THAT(refused("color", { { "renderer", "povray" } }), HasSubstr("cannot be drawn"));
  EXPECT_THAT(refused("color", raster), IsEmpty());
  EXPECT_THAT(refused("depth", raster), HasSubstr("layer depth: camera 'f'"));
  EXPECT_THAT(refused("depth", vtk), IsEmpty());
  EXPECT_THAT(refused("ldi", vtk), HasSubstr("layer ldi: camera 'f'"));
  EXPECT_THAT(refused("ldi"), IsEmpty());
  EXPECT_THAT(
    refused("matting", { { "matte", "crate" }, { "renderer", "vtk" } }), HasSubstr("layer matting: camera 'f'"));
  EXPECT_THAT(refused("matting", { { "matte", "crate" } }), IsEmpty());
  EXPECT_THAT(refused("calibration"), IsEmpty());
  EXPECT_EQ(refused("depth", { { "depth_format", "npy,dgd" } }),
    "layer depth as dgd: camera 'f' (equirectangular) has no linear projection");
  LayerRequest straight = requestOf({ "calibration" });
  straight.cameras = { "a" };
  EXPECT_THAT(refusal(straight, *stage), IsEmpty());
  straight.cameras = { "f", "g" };
  EXPECT_EQ(refusal(straight, *stage), "layer calibration: camera 'f' (equirectangular) has no linear projection");

  // Cameras that have one keep what needs one, whether it was named or not.
  for (const std::vector<std::string>& layers : { std::vector<std::string>{ "all" }, { "calibration", "pov" } })
  {
    EXPECT_EQ(leftOut(makeWorkPlan(requestOf(layers), *stage)), (Left{ { "calibration", 8 }, { "pov", 8 } }));
    const WorkPlan plan = makeWorkPlan(requestOf(layers), *stage);
    for (const Job& job : plan.jobs)
    {
      EXPECT_EQ(countOf(plan, *stage, job, "pov"), job.camera == 0 ? 1 : 0);
      EXPECT_EQ(countOf(plan, *stage, job, "calibration"), job.camera == 0 ? 1 : 0);
    }
  }
  LayerRequest curved = requestOf({ "all" });
  curved.cameras = { "f", "g" };
  const WorkPlan all = makeWorkPlan(curved, *stage);
  EXPECT_EQ(leftOut(all), (Left{ { "calibration", 8 }, { "pov", 8 } }));
  for (const PlannedLayer& planned : all.layers)
  {
    EXPECT_FALSE(planned.linear) << planned.layer->info().layer;
  }
}

TEST(Plan, ARequestIsWrittenAsItWasMeant)
{
  const auto stage = stageOf({ cameraText("a", 0), cameraText("b", 1) });
  using Pairs = std::vector<std::pair<std::string, std::string>>;
  const auto described = [&](const LayerRequest& request)
  { return describeRequest(makeWorkPlan(request, *stage), *stage); };
  EXPECT_EQ(described(requestOf({ "depth" })),
    (Pairs{ { "layers", "depth" }, { "cameras", "all" }, { "frames", "all" }, { "size", "camera's own" },
      { "depth_format", "npy" }, { "visibility", "ray" }, { "seed", "0" } }));
  LayerRequest request = requestOf({ "alpha", "color", "correspondence", "tiles" },
    { { "samples", "03" }, { "filter", "triangle" }, { "exposure", "1.50" }, { "tone", "filmic" }, { "seed", "7" },
      { "visibility", "raster" }, { "pack", "on" }, { "color_bits", "16" }, { "pairs", "a:b" }, { "tile", "4x3" },
      { "color_format", "exr,png" } });
  request.cameras = { "b", "a" };
  request.frames = FrameRange{ 1, 3, 2 };
  request.width = 10;
  request.height = 7;
  EXPECT_EQ(described(request),
    (Pairs{ { "layers", "color,correspondence,alpha,tiles" }, { "cameras", "b,a" }, { "frames", "1:3:2" },
      { "size", "10x7" }, { "tile", "4x3" }, { "samples", "3" }, { "filter", "triangle" }, { "color_bits", "16" },
      { "exposure", "1.5" }, { "tone", "filmic" }, { "color_format", "png,exr" }, { "correspondence_format", "npy" },
      { "pairs", "a:b" }, { "alpha_format", "png" }, { "alpha_samples", "3" }, { "renderer", "ray" },
      { "visibility", "raster" }, { "seed", "7" }, { "pack", "yes" } }));
  EXPECT_EQ(described(requestOf({ "ldi", "pov" }, { { "pov_shadows", "on" }, { "models", "on" }, { "samples", "2" } })),
    (Pairs{ { "layers", "ldi,pov" }, { "cameras", "all" }, { "frames", "all" }, { "size", "camera's own" },
      { "ldi_format", "ldi" }, { "pov_format", "pov" }, { "renderer", "ray" }, { "pov_shadows", "on" },
      { "visibility", "ray" }, { "seed", "0" }, { "models", "yes" } }));
  const auto crate = stageOf({ cameraText("a", 0) }, crateText("crate"));
  const LayerRequest matting = requestOf({ "matting" }, { { "matte", "crate" }, { "samples", "2" } });
  EXPECT_EQ(describeRequest(makeWorkPlan(matting, *crate), *crate),
    (Pairs{ { "layers", "matting" }, { "cameras", "all" }, { "frames", "all" }, { "size", "camera's own" },
      { "matting_format", "png" }, { "matte", "crate" }, { "matting_samples", "2" }, { "renderer", "ray" },
      { "visibility", "ray" }, { "seed", "0" } }));
}

TEST(Plan, WhoMayStartOpenGL)
{
  const auto request = [](const char* renderer, const char* visibility) {
    return requestOf({}, { { "renderer", renderer }, { "visibility", visibility } });
  };
  EXPECT_FALSE(mayUseOpenGL(request("ray", "auto")) || mayUseOpenGL(request("povray", "ray")));
  EXPECT_TRUE(mayUseOpenGL(request("vtk", "ray")));
  EXPECT_TRUE(mayUseOpenGL(request("ray", "raster")));
  EXPECT_TRUE(drawsItself(request("ray", "ray")) && drawsItself(request("vtk", "ray")));
  EXPECT_FALSE(drawsItself(request("povray", "raster")));
}

TEST(Plan, NeedsAddUp)
{
  const std::vector<bool LayerNeeds::*> flags{ &LayerNeeds::hits, &LayerNeeds::color, &LayerNeeds::sharp,
    &LayerNeeds::peeled, &LayerNeeds::samples, &LayerNeeds::whole, &LayerNeeds::linear };
  for (const auto flag : flags)
  {
    LayerNeeds one;
    one.*flag = true;
    one.mattes = { 2 };
    LayerNeeds before = one; // what is needed already stays
    before.add({});
    LayerNeeds after;
    after.mattes = { 5 };
    after.add(one);
    for (const auto other : flags)
    {
      EXPECT_EQ(before.*other, other == flag);
      EXPECT_EQ(after.*other, other == flag);
    }
    EXPECT_THAT(after.mattes, ElementsAre(5u, 2u));
  }
}
