// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkMeasure_h
#define dgtkMeasure_h

#include <chrono>
#include <functional>
#include <string>
#include <vector>

namespace dgtk::bench
{

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::time_point since);

struct Measured
{
  double milliseconds = -1; ///< what `run` returned; -1 when it failed
  double mebibytes = 0;     ///< peak memory
};

/// Calls run() in a process of its own: its peak memory is its own, and no two OpenGL contexts meet.
Measured inChild(const std::string& name, const std::function<double()>& run);

/// Middle of some values; of an even number the upper one.
double median(std::vector<double> values);

} // namespace dgtk::bench

#endif
