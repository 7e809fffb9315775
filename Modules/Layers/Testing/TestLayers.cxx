// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayers.h"
#include "dgtkSceneDescription.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

using namespace dgtk;

/// What a dataset says of a layer without naming its meaning is enough to tell it, so that manifests need not name it.
TEST(Layers, MeanWhatTheirUnitsAndFramesImply)
{
  LayerRequest request;
  request.layers = { "all" };
  request.options["matte"] = "vase";
  SceneDescription scene = readScene(test::sourceFile("Data/Scenes/noise_color.json"));
  const auto stage = Stage::load(scene);
  std::set<Meaning> seen;
  for (const PlannedLayer& planned : makeWorkPlan(request, *stage).layers)
  {
    for (const std::string& format : planned.layer->info().formats)
    {
      for (const LayerRecord& record : planned.layer->records(makeWorkPlan(request, *stage), format))
      {
        EXPECT_NE(record.spec.meaning, Meaning::Unknown) << record.spec.name;
        EXPECT_EQ(nameOf(record.spec.meaning), std::string(nameOf(impliedMeaning(record.spec)))) << record.spec.name;
        seen.insert(record.spec.meaning);
      }
    }
  }
  EXPECT_EQ(seen.size(), std::size_t(Meaning::Record)) << "every meaning but Unknown has a layer";
}

/// Layers that some pictures do not have, and how many; of the others nothing is said.
TEST(Layers, WhatPicturesLackIsCounted)
{
  const auto stage = Stage::load(readScene(test::sourceFile("Data/Scenes/demo.json")));
  const SceneDescription still; // without a motion there is no flow, whoever asks
  for (const LayerInfo& info : generatorLayers())
  {
    const bool follows = info.layer.rfind("flow_", 0) == 0 || info.layer == "sceneflow";
    if (follows || info.layer.rfind("disparity_", 0) == 0)
    {
      ASSERT_NE(info.appliesTo, nullptr) << info.layer;
      EXPECT_EQ(info.appliesTo(stage->description()), true) << info.layer;
      EXPECT_EQ(info.appliesTo(still), false) << info.layer;
    }
  }
  for (const bool single : { false, true })
  {
    LayerRequest request;
    request.layers = { "all" };
    request.options["matte"] = "house";
    if (single)
    {
      request.cameras = { stage->description().cameras.front().name };
      request.frames = FrameRange{ 0, 0, 1 };
    }
    const WorkPlan plan = makeWorkPlan(request, *stage);
    std::map<std::string, std::size_t> expected;
    for (const PlannedLayer& planned : plan.layers)
    {
      for (const Job& job : plan.jobs)
      {
        // Others, such as one cloud of all cameras of a frame, are not of each picture.
        if (!planned.layer->requirement().empty() && outputsOf(plan, *stage, job, planned).empty())
        {
          ++expected[planned.layer->info().layer];
        }
      }
    }
    std::map<std::string, std::size_t> found;
    for (const EmptyRecord& one : plan.empty)
    {
      EXPECT_TRUE(found.emplace(one.layer, one.pictures).second) << one.layer;
      EXPECT_EQ(one.of, plan.jobs.size());
      EXPECT_FALSE(one.needs.empty()) << one.layer;
    }
    EXPECT_EQ(found, expected);
    EXPECT_EQ(expected.count("correspondence"), single ? 1u : 0u);
    EXPECT_EQ(expected.count("flow_forward"), single ? 0u : 1u) << "of the last frame";
    EXPECT_EQ(expected.count("flow_backward"), 1u) << "of the first frame";
    EXPECT_EQ(expected.count("depth"), 0u);
  }
}
