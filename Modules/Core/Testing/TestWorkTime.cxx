// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkWorkTime.h"

#include <gtest/gtest.h>

#include <ctime>
#include <thread>

using namespace dgtk;

namespace
{
/// Spends processor time, seconds.
void work(double seconds)
{
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  const double end = double(now.tv_sec) + 1e-9 * double(now.tv_nsec) + seconds;
  while (double(now.tv_sec) + 1e-9 * double(now.tv_nsec) < end)
  {
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  }
}

double secondsOf(const char* name)
{
  for (const StageTime& stage : workTimes())
  {
    if (stage.name == name)
    {
      return stage.seconds;
    }
  }
  return -1;
}
} // namespace

TEST(WorkTime, CountsForTheInnermostStageOfEachThread)
{
  {
    const WorkTime before(WorkStage::Load);
    work(0.02);
  }
  EXPECT_EQ(secondsOf("load"), 0) << "times are not kept unless somebody wants them";
  keepWorkTimes();
  const auto job = []
  {
    const WorkTime outer(WorkStage::Derive);
    work(0.02);
    {
      const WorkTime inner(WorkStage::Write);
      work(0.04);
    }
    work(0.02);
  };
  std::thread other(job);
  job();
  other.join();
  constexpr double slack = 0.01; // of processor time, whatever else the machine does
  EXPECT_NEAR(secondsOf("derive"), 0.08, slack);
  EXPECT_NEAR(secondsOf("write"), 0.08, slack);
  EXPECT_EQ(secondsOf("trace"), 0);
  EXPECT_GE(secondsOf("other"), 0.015) << "what was not kept";
  const std::vector<StageTime> all = workTimes();
  ASSERT_EQ(all.size(), 9U);
  EXPECT_EQ(all.front().name, "load");
  EXPECT_EQ(all[0].peakBytes, 0U);
  EXPECT_GT(all[7].peakBytes, std::uint64_t(1) << 20);
  EXPECT_GE(all.back().peakBytes, all[7].peakBytes);
}
