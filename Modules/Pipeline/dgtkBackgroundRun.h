// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkBackgroundRun_h
#define dgtkBackgroundRun_h

// Private to Pipeline.

#include "dgtkFailure.h"

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include <sys/types.h>

/// Work with a thread of its own, which reports how far it is to whoever waits, and can be cancelled. Waiting lets
/// other threads of Python run.
class dgtkBackgroundRun
{
public:
  struct Report
  {
    std::size_t done = 0;
    std::size_t total = 0;
  };
  /// Gives reports through the function; looks at the flag between them.
  using Work = std::function<void(const std::atomic<bool>& cancel, const std::function<void(Report)>& report)>;

  ~dgtkBackgroundRun();
  /// Nothing happens while another one is running.
  void start(Work work);
  /// Whether it goes on, or has reports that nobody has waited for.
  bool isRunning() const;
  /// The next report; false when there is none by then.
  bool wait(int milliseconds);
  Report last() const { return this->Last; }
  void cancel();
  /// How the last one ended.
  dgtk::Failure failure() const;

private:
  struct State
  {
    std::atomic<bool> cancel{ false };
    mutable std::mutex mutex; ///< of the following
    std::condition_variable change;
    std::deque<Report> reports;
    bool over = true;
    dgtk::Failure failure;
    void report(Report one);
    void run(const Work& work);
  };
  void end();
  std::shared_ptr<State> Self = std::make_shared<State>();
  std::thread Thread;
  pid_t Process = 0; ///< that has the thread
  Report Last;
};

#endif
