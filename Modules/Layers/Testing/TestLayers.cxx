// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkLayers.h"
#include "dgtkSceneDescription.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

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
