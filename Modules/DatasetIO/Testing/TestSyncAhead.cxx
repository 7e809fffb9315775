// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSyncAhead.h"

#include "dgtkError.h"

#include <gtest/gtest.h>

#include <atomic>
#include <future>

using namespace dgtk;

TEST(SyncAhead, waits_until_there_is_enough)
{
  std::atomic<int> synced{ 0 };
  SyncAhead ahead([&] { ++synced; }, 100);
  ahead.wrote(60);
  ahead.wrote(39);
  ahead.finish();
  EXPECT_EQ(synced, 0);
  ahead.wrote(1);
  ahead.finish();
  EXPECT_EQ(synced, 1);
  ahead.wrote(99);
  ahead.finish();
  EXPECT_EQ(synced, 1);
}

TEST(SyncAhead, writing_goes_on_meanwhile_and_none_begins_twice)
{
  std::promise<void> disk;
  std::atomic<int> began{ 0 };
  SyncAhead ahead(
    [&, written = disk.get_future().share()]
    {
      ++began;
      written.wait();
    },
    10);
  for (int i = 0; i < 50; ++i)
  {
    ahead.wrote(10);
  }
  disk.set_value();
  ahead.finish();
  EXPECT_EQ(began, 1);
  ahead.wrote(1); // what came meanwhile is not forgotten
  ahead.finish();
  EXPECT_EQ(began, 2);
}

TEST(SyncAhead, the_end_tells_what_was_lost)
{
  int call = 0;
  SyncAhead ahead(
    [&]
    {
      if (++call == 1)
      {
        throw MachineError("/data: cannot be written: Input/output error");
      }
    },
    10);
  // the second one succeeds: the system tells of a lost block once
  for (int i = 0; i < 2; ++i)
  {
    ahead.wrote(10);
    try
    {
      ahead.finish();
      ADD_FAILURE();
    }
    catch (const MachineError& error)
    {
      EXPECT_STREQ(error.what(), "/data: cannot be written: Input/output error");
    }
  }
  EXPECT_EQ(call, 2);
}
