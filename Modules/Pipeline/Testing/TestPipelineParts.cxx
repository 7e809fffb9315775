// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkGenerator.h"
#include "dgtkSerialQueue.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>

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
