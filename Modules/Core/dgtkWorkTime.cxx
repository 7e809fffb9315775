// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkWorkTime.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <ctime>

#include <sys/resource.h>

namespace dgtk
{

namespace
{
constexpr std::array<const char*, 8> names{ "load", "build", "draw", "trace", "settle", "derive", "encode", "write" };

struct Total
{
  std::atomic<std::int64_t> nanoseconds{ 0 };
  std::atomic<std::uint64_t> peakBytes{ 0 };
};

std::atomic<bool> kept{ false };
std::array<Total, names.size()> totals;
thread_local WorkTime* current = nullptr;

double secondsOf(clockid_t clock)
{
  timespec now{};
  ::clock_gettime(clock, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

std::uint64_t peakMemory()
{
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return std::uint64_t(usage.ru_maxrss) * 1024;
}
} // namespace

WorkTime::WorkTime(WorkStage stage)
  : Stage(stage)
  , Kept(kept)
{
  if (this->Kept)
  {
    this->Around = current;
    if (this->Around)
    {
      this->Around->stop();
    }
    current = this;
    this->Since = secondsOf(CLOCK_THREAD_CPUTIME_ID);
  }
}

WorkTime::~WorkTime()
{
  if (this->Kept)
  {
    this->stop();
    std::atomic<std::uint64_t>& peak = totals[static_cast<std::size_t>(this->Stage)].peakBytes;
    const std::uint64_t now = peakMemory();
    for (std::uint64_t before = peak; before < now && !peak.compare_exchange_weak(before, now);)
    {
    }
    current = this->Around;
    if (this->Around)
    {
      this->Around->Since = secondsOf(CLOCK_THREAD_CPUTIME_ID);
    }
  }
}

void WorkTime::stop()
{
  const double spent = secondsOf(CLOCK_THREAD_CPUTIME_ID) - this->Since;
  totals[static_cast<std::size_t>(this->Stage)].nanoseconds += static_cast<std::int64_t>(spent * 1e9);
}

void keepWorkTimes() { kept = true; }

std::vector<StageTime> workTimes()
{
  std::vector<StageTime> all;
  double sum = 0;
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    all.push_back({ names[i], 1e-9 * double(totals[i].nanoseconds.load()), totals[i].peakBytes });
    sum += all.back().seconds;
  }
  all.push_back({ "other", std::max(0.0, secondsOf(CLOCK_PROCESS_CPUTIME_ID) - sum), peakMemory() });
  return all;
}

} // namespace dgtk
