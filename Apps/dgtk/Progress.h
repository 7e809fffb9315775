// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAppProgress_h
#define dgtkAppProgress_h

#include <chrono>
#include <cstddef>
#include <string>

namespace dgtk::app
{

/// Progress of long work on standard error: a bar that is redrawn on a terminal, a plain line every 5 s otherwise, or
/// as often as DGTK_PROGRESS of the environment says (UsageError where it is no number of seconds).
class Progress
{
public:
  /// `unit`: what is counted, in the plural.
  explicit Progress(bool quiet, std::string unit = "pictures");
  ~Progress(); ///< ends the bar's line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `kept`: those of `done` that were there before; the rate is that of the others.
  void update(std::size_t done, std::size_t total, std::size_t kept = 0);
  /// A line that does not disturb the bar.
  void message(const std::string& line);
  double seconds() const;

private:
  void clear();
  bool Quiet;
  std::string Unit;
  bool Terminal;
  std::chrono::nanoseconds Interval;
  bool Drawn = false;
  std::chrono::steady_clock::time_point Start;
  std::chrono::steady_clock::time_point Last;
};

} // namespace dgtk::app

#endif
