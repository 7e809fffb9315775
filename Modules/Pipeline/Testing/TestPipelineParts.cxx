// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetExporter.h"
#include "dgtkDatasetGenerator.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkGenerator.h"
#include "dgtkRunShards.h"
#include "dgtkSerialQueue.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>
#include <vtkNew.h>

#include <atomic>
#include <filesystem>
#include <string>

using namespace dgtk;

namespace
{
/// A request of the depths of a folder of two scenes, which it writes; `more` is of each scene.
GeneratorRequest twoScenes(const test::TemporaryFolder& folder, const std::string& more = {})
{
  writeFile(folder.path("quad.obj"), "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n");
  std::filesystem::create_directory(folder.path("scenes"));
  for (const char* const name : { "scenes/a.json", "scenes/b.json" })
  {
    writeFile(
      folder.path(name), R"({ "version": 1, )" + more + R"("objects": [{ "name": "quad", "model": "../quad.obj" }],
      "cameras": [{ "name": "c", "eye": [0, 0, 5], "lookAt": [0, 0, 0] }] })");
  }
  GeneratorRequest request;
  request.scene = folder.path("scenes");
  request.layers = { "depth" };
  request.width = 16;
  request.height = 12;
  return request;
}
} // namespace

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

TEST(Generator, WhoeverCancelsAFolderOfScenesStopsTheSceneThatIsRendered)
{
  const test::TemporaryFolder folder;
  std::atomic<bool> cancel{ true };
  GeneratorCallbacks callbacks;
  callbacks.cancel = &cancel;
  GeneratorRequest request = twoScenes(folder);
  const auto made = [&](const char* name) { return std::filesystem::exists(request.folder + "/" + name); };
  for (const bool share : { false, true })
  {
    request.folder = folder.path(share ? "share" : "all");
    const auto run = [&] {
      return share ? generateShard(request, { 0, 1 }, callbacks) : generateScenes(request, callbacks);
    };
    cancel = true;
    const GeneratorResult stopped = run();
    EXPECT_TRUE(stopped.interrupted);
    EXPECT_EQ(stopped.pictures, 0u);
    EXPECT_FALSE(made("a/manifest.json") || made("b/manifest.json") || made("manifest.json"));
    cancel = false;
    request.resume = !share;
    const GeneratorResult done = run();
    EXPECT_FALSE(done.interrupted);
    EXPECT_EQ(done.pictures, 2u);
    EXPECT_TRUE(made("a/manifest.json") && made("b/manifest.json"));
    EXPECT_EQ(made("manifest.json"), !share) << "shares are merged by whoever made them";
    request.resume = false;
  }
}

TEST(Generator, PicturesOfABegunSceneOfManyAreKept)
{
  const test::TemporaryFolder folder;
  std::atomic<bool> cancel{ true };
  GeneratorCallbacks callbacks;
  callbacks.cancel = &cancel;
  GeneratorRequest request = twoScenes(folder, R"("keyFrames": [0, 39], )");
  request.folder = folder.path("all");
  request.options["threads"] = "1";
  EXPECT_TRUE(generateScenes(request, callbacks).interrupted);
  // some pictures of the first scene, which another process might have made
  GeneratorRequest one = request;
  one.scene = folder.path("scenes/a.json");
  one.folder = folder.path("all/a");
  one.resume = true;
  cancel = false;
  GeneratorCallbacks stopping = callbacks;
  stopping.progress = [&](const GeneratorProgress& state) { cancel = state.done > 0; };
  const GeneratorResult begun = generate(one, stopping);
  ASSERT_TRUE(begun.interrupted);
  ASSERT_GT(begun.pictures, 0u);
  cancel = false;
  request.resume = true;
  const GeneratorResult done = generateScenes(request, callbacks);
  EXPECT_FALSE(done.interrupted);
  EXPECT_EQ(done.kept, begun.pictures);
  EXPECT_EQ(done.pictures, 80u);
  EXPECT_EQ(done.files, 80u + 2 * 4 + 1) << "pictures, four documents of each dataset and the list of datasets";
}

TEST(Generator, ProgressOfASharePutsWhatIsKeptApart)
{
  const test::TemporaryFolder folder;
  GeneratorRequest request = twoScenes(folder, R"("keyFrames": [0, 1], )");
  GeneratorProgress last;
  GeneratorCallbacks callbacks;
  callbacks.progress = [&](const GeneratorProgress& state) { last = state; };
  for (const bool scenes : { true, false })
  {
    request.scene = folder.path(scenes ? "scenes" : "scenes/a.json");
    request.folder = folder.path(scenes ? "many" : "one");
    for (const std::size_t kept : { 0, 1 })
    {
      std::filesystem::remove_all(request.folder + (scenes ? "/b" : "/.dgtk-parts/000001"));
      generateShard(request, { 0, 1 }, callbacks);
      EXPECT_EQ(last.done, 2u);
      EXPECT_EQ(last.total, 2u);
      EXPECT_EQ(last.kept, kept);
    }
  }
}

namespace
{
constexpr int longEnough = 1000; ///< milliseconds, and again

/// How a run ends that is given this file once, and another while it runs.
template <class Run>
std::string failureOf(Run& run, void (Run::*set)(const std::string&), const std::string& file)
{
  (run.*set)(file);
  run.Start();
  (run.*set)("/nowhere/later");
  while (run.IsRunning())
  {
    run.Wait(longEnough);
  }
  return run.GetErrorMessage();
}
} // namespace

TEST(BackgroundRuns, HaveTheSettingsOfTheirStart)
{
  const test::TemporaryFolder folder;
  vtkNew<dgtkDatasetGenerator> generator;
  generator->SetFolder(folder.path("out"));
  vtkNew<dgtkDatasetExporter> exporter;
  exporter->SetFolder(folder.path("out"));
  exporter->SetFormat("coco");
  for (int i = 0; i < 20; ++i)
  {
    const std::string file = "/nowhere/" + std::to_string(i);
    const std::string generated = failureOf(*generator.Get(), &dgtkDatasetGenerator::SetSceneFile, file);
    EXPECT_NE(generated.find(file), std::string::npos) << generated;
    const std::string exported = failureOf(*exporter.Get(), &dgtkDatasetExporter::SetDataset, file);
    EXPECT_NE(exported.find(file), std::string::npos) << exported;
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
