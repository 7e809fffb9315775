// SPDX-License-Identifier: BSD-3-Clause
#include "Measure.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace dgtk::bench
{

double milliseconds(Clock::time_point since)
{
  return std::chrono::duration<double, std::milli>(Clock::now() - since).count();
}

Measured inChild(const std::string& name, const std::function<double()>& run)
{
  int ends[2] = {};
  if (::pipe(ends) != 0)
  {
    std::perror("pipe");
    std::exit(1);
  }
  const pid_t child = ::fork();
  if (child == 0)
  {
    double time = -1;
    try
    {
      time = run();
    }
    catch (const std::exception& error)
    {
      std::fprintf(stderr, "%s: %s\n", name.c_str(), error.what());
    }
    ::_exit(::write(ends[1], &time, sizeof time) == sizeof time && time >= 0 ? 0 : 1);
  }
  ::close(ends[1]);
  Measured measured;
  const bool read = ::read(ends[0], &measured.milliseconds, sizeof(double)) == sizeof(double);
  ::close(ends[0]);
  int status = 0;
  struct rusage usage = {};
  ::wait4(child, &status, 0, &usage);
  measured.mebibytes = usage.ru_maxrss / 1024.0;
  measured.milliseconds = read && status == 0 ? measured.milliseconds : -1;
  return measured;
}

double median(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

} // namespace dgtk::bench
