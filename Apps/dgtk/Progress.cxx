// SPDX-License-Identifier: BSD-3-Clause
#include "Progress.h"

#include "dgtkError.h"
#include "dgtkUtf8.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

#include <unistd.h>

namespace dgtk::app
{

namespace
{
constexpr std::chrono::milliseconds barInterval{ 100 };
constexpr std::chrono::seconds lineInterval{ 5 };

/// Time between lines where no terminal is: DGTK_PROGRESS of the environment, in seconds.
std::chrono::nanoseconds askedInterval()
{
  const char* const asked = std::getenv("DGTK_PROGRESS");
  if (asked == nullptr)
  {
    return lineInterval;
  }
  double seconds = 0;
  const char* const end = asked + std::strlen(asked);
  const auto [at, code] = std::from_chars(asked, end, seconds);
  if (code != std::errc() || at != end || !(seconds >= 0.01 && seconds <= 3600))
  {
    throw UsageError("DGTK_PROGRESS: expected seconds from 0.01 to 3600, found " + quoted(asked));
  }
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(seconds));
}

std::string duration(double seconds)
{
  const long s = static_cast<long>(seconds + 0.5);
  char text[32];
  if (s >= 3600)
  {
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
  }
  else
  {
    std::snprintf(text, sizeof text, "%ld:%02ld", s / 60, s % 60);
  }
  return text;
}
} // namespace

Progress::Progress(bool quiet, std::string unit)
  : Quiet(quiet)
  , Unit(std::move(unit))
  , Terminal(::isatty(STDERR_FILENO) == 1)
  , Interval(Terminal ? std::chrono::nanoseconds(barInterval) : askedInterval())
  , Start(std::chrono::steady_clock::now())
  , Last(std::getenv("DGTK_PROGRESS") == nullptr ? Start : Start - Interval)
{
}

Progress::~Progress()
{
  if (this->Drawn)
  {
    std::fputc('\n', stderr);
  }
}

double Progress::seconds() const
{
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - this->Start).count();
}

void Progress::clear()
{
  if (this->Drawn)
  {
    std::fputs("\r\033[K", stderr);
    this->Drawn = false;
  }
}

void Progress::message(const std::string& line)
{
  if (!this->Quiet)
  {
    this->clear();
    std::fprintf(stderr, "%s\n", printable(line).c_str());
  }
}

void Progress::update(std::size_t done, std::size_t total, std::size_t kept)
{
  const auto now = std::chrono::steady_clock::now();
  if (this->Quiet || total == 0 || (now - this->Last < this->Interval && (done < total || !this->Terminal)))
  {
    return;
  }
  this->Last = now;
  const double rate = (done - kept) / std::max(this->seconds(), 1e-9);
  const std::string state = std::to_string(done) + '/' + std::to_string(total) + ' ' + this->Unit + ", " +
                            std::to_string(rate).substr(0, 5) + "/s, " +
                            (done > kept      ? duration((total - done) / rate)
                              : done == total ? duration(0)
                                              : std::string("?")) +
                            " left";
  if (!this->Terminal)
  {
    std::fprintf(stderr, "%s\n", state.c_str());
    return;
  }
  constexpr std::size_t cells = 24;
  const std::size_t filled = cells * done / total;
  std::fprintf(stderr, "\r\033[K[%s%s] %s", std::string(filled, '#').c_str(), std::string(cells - filled, '.').c_str(),
    state.c_str());
  std::fflush(stderr);
  this->Drawn = true;
}

} // namespace dgtk::app
