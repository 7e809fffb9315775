// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkColorRows.h"
#include "dgtkError.h"
#include "dgtkGenerator.h"
#include "dgtkLayers.h"
#include "dgtkSceneDescription.h"
#include "dgtkSerialQueue.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

using namespace dgtk;

TEST(Generator, RefusesFramesThatAreNone)
{
  const test::TemporaryFolder folder;
  GeneratorRequest request;
  request.scene = test::sourceFile("Data/Scenes/demo.json");
  request.folder = folder.path("d");
  request.layers = { "depth" };
  for (const FrameRange& frames : { FrameRange{ 2, 1, 1 }, FrameRange{ 0, 2, 0 }, FrameRange{ 0, 2, -1 } })
  {
    request.frames = frames;
    EXPECT_THROW(generate(request), UsageError);
    EXPECT_THROW(requestHash(request), UsageError);
  }
  EXPECT_FALSE(std::filesystem::exists(request.folder));
}

/// What a dataset says of a layer without naming its meaning is enough to tell it, so that manifests need not name it.
TEST(Layers, MeanWhatTheirUnitsAndFramesImply)
{
  GeneratorRequest request;
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

TEST(Options, AreReadAsTheyAreWritten)
{
  std::set<std::string> names;
  for (const auto* rows : { &requestOptions(), &runOptions() })
  {
    for (const OptionRow* row : *rows)
    {
      EXPECT_TRUE(names.insert(row->name).second) << row->name;
      EXPECT_EQ(row->name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string::npos) << row->name;
      EXPECT_FALSE(row->help.empty()) << row->name;
      EXPECT_EQ(row->value.empty(), row->kind == OptionRow::Kind::Switch) << row->name;
      EXPECT_EQ(&requestOption(row->name), row);
      EXPECT_TRUE(row->isDefault({})) << row->name;
      if (!row->fallback.empty())
      {
        EXPECT_EQ(row->normal(row->fallback), row->fallback) << row->name;
      }
      for (const std::string& choice : row->choices)
      {
        EXPECT_EQ(row->normal(choice), choice);
      }
      if (row->kind != OptionRow::Kind::Names || !row->choices.empty())
      {
        EXPECT_THROW(row->normal("?"), UsageError) << row->name;
        EXPECT_THROW(row->text({ { row->name, "?" } }), UsageError) << row->name;
      }
    }
  }
  EXPECT_THROW(requestOption("sample"), UsageError);
}

TEST(Options, OfEveryKind)
{
  const IntegerOption& samples = option::samples();
  EXPECT_EQ(samples.of({}), 1);
  EXPECT_EQ(samples.of({ { "samples", "016" } }), 16);
  EXPECT_EQ(samples.normal("016"), "16");
  for (const char* const wrong : { "0", "17", "", "4 ", "4.0", "-1", "99999999999" })
  {
    EXPECT_THROW(samples.normal(wrong), UsageError) << wrong;
  }
  const SwitchOption& pack = option::pack();
  EXPECT_FALSE(pack.of({}));
  EXPECT_FALSE(pack.of({ { "pack", "off" } }));
  EXPECT_TRUE(pack.of({ { "pack", "on" } }));
  EXPECT_TRUE(pack.of({ { "pack", "" } })) << "as a switch of the command line";
  const SizeOption size("tile", 640, 480, 1000, "");
  EXPECT_EQ(size.width({}), 640);
  EXPECT_EQ(size.height({ { "tile", "7x1000" } }), 1000);
  EXPECT_EQ(size.normal("007X5"), "7x5");
  for (const char* const wrong : { "7", "7x", "x7", "0x5", "5x0", "1001x5", "5x1001", "5x5x5" })
  {
    EXPECT_THROW(size.normal(wrong), UsageError) << wrong;
  }
  const NumbersOption lens("lens", "A,B", 2, 0, "");
  EXPECT_TRUE(lens.of({}).empty());
  EXPECT_EQ(lens.of({ { "lens", "0.5,1e3" } }), (std::vector<double>{ 0.5, 1000 }));
  EXPECT_EQ(lens.normal("0.50,1000.0"), "0.5,1000");
  for (const char* const wrong : { "1", "1,2,3", "0,1", "1,-1", "1,x", "1,nan", "1,inf", "1,1e30" })
  {
    EXPECT_THROW(lens.normal(wrong), UsageError) << wrong;
  }
  const NamesOption names("names", "NAMES", "");
  EXPECT_TRUE(names.of({}).empty());
  const std::vector<std::string> odd{ "a,b", "c\\", "\\,", "d e" };
  EXPECT_EQ(names.of({ { "names", joinedNames(odd) } }), odd);
  EXPECT_EQ(names.normal(joinedNames(odd)), joinedNames(odd));
  EXPECT_EQ(names.of({ { "names", "a\\b" } }), (std::vector<std::string>{ "a\\b" })) << "a path of Windows";
  for (const char* const wrong : { ",", "a,", ",a", "a,,b" })
  {
    EXPECT_THROW(names.normal(wrong), UsageError) << wrong;
  }
}

TEST(SerialQueue, KeepsTheOrderOfEachQueueOnAnyNumberOfThreads)
{
  for (const int threads : { 1, 2, 4 })
  {
    ThreadPool pool(threads);
    std::vector<int> first;
    std::vector<int> second;
    {
      SerialQueue a(pool);
      SerialQueue b(pool);
      for (int i = 0; i < 500; ++i)
      {
        a.submit([&first, i] { first.push_back(i); });
        b.submit([&second, i] { second.push_back(i); });
      }
      a.wait();
      b.wait();
    }
    ASSERT_EQ(first.size(), 500u);
    ASSERT_EQ(second.size(), 500u);
    EXPECT_TRUE(std::is_sorted(first.begin(), first.end()));
    EXPECT_TRUE(std::is_sorted(second.begin(), second.end()));
  }
}

TEST(SerialQueue, StopsAtTheFirstFailureAndReportsIt)
{
  ThreadPool pool(2);
  SerialQueue queue(pool);
  std::atomic<int> ran{ 0 };
  queue.submit([] { throw MachineError("disk"); });
  for (int i = 0; i < 20; ++i)
  {
    queue.submit([&ran] { ++ran; });
  }
  EXPECT_THROW(queue.wait(), MachineError);
  EXPECT_EQ(ran, 0);
}

namespace
{
Band bandOf(const std::vector<float>& values)
{
  Band band;
  band.rect = { 0, 5, static_cast<int>(values.size() / 3), 1 };
  band.rgb = values;
  return band;
}

LayerSpec colorOf(PixelType type)
{
  LayerSpec spec;
  spec.type = type;
  spec.channels = 3;
  return spec;
}
} // namespace

TEST(Quantise, RoundsToTheNearestStepAndClamps)
{
  const Band band = bandOf({ 0.0f, 1.0f, 0.5f, -0.25f, 1.5f, 127.49f / 255 });
  const Rows bytes = quantise(band, colorOf(PixelType::UInt8), 5, 1);
  const std::uint8_t* b = bytes.row<std::uint8_t>(5);
  EXPECT_EQ(std::vector<int>(b, b + 6), (std::vector<int>{ 0, 255, 128, 0, 255, 127 }));
  const Rows words = quantise(band, colorOf(PixelType::UInt16), 5, 1);
  const std::uint16_t* w = words.row<std::uint16_t>(5);
  EXPECT_EQ(std::vector<int>(w, w + 5), (std::vector<int>{ 0, 65535, 32768, 0, 65535 }));
}

TEST(Quantise, FloatIsLinearLight)
{
  // IEC 61966-2-1: encoded 0.5 is 0.21404, encoded 0.04 is 0.04 / 12.92
  const Rows rows = quantise(bandOf({ 0.0f, 1.0f, 0.5f, 0.04f, 1.0f, 0.0f }), colorOf(PixelType::Float32), 5, 1);
  const float* v = rows.row<float>(5);
  EXPECT_EQ(v[0], 0.0f);
  EXPECT_FLOAT_EQ(v[1], 1.0f);
  EXPECT_NEAR(v[2], 0.2140411, 1e-6);
  EXPECT_NEAR(v[3], 0.04 / 12.92, 1e-8);
}

TEST(Quantise, EightBitsAreTheRoundingOfSixteen)
{
  std::vector<float> ramp(3000);
  for (int i = 0; i < 3000; ++i)
  {
    ramp[std::size_t(i)] = static_cast<float>(i) / 2999.0f;
  }
  const Rows bytes = quantise(bandOf(ramp), colorOf(PixelType::UInt8), 5, 1);
  const Rows words = quantise(bandOf(ramp), colorOf(PixelType::UInt16), 5, 1);
  for (int i = 0; i < 3000; ++i)
  {
    EXPECT_LE(std::abs(bytes.row<std::uint8_t>(5)[i] * 257 - words.row<std::uint16_t>(5)[i]), 129) << i;
  }
}
