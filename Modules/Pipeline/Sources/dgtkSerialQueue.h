// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSerialQueue_h
#define dgtkSerialQueue_h

#include "dgtkThreadPool.h"

#include <deque>
#include <exception>
#include <functional>
#include <future>
#include <memory>
#include <mutex>
#include <vector>

namespace dgtk
{

/// Jobs that run on a pool one after another, in the order in which they were submitted. After the first failure the
/// remaining jobs are dropped.
class SerialQueue
{
public:
  explicit SerialQueue(ThreadPool& pool);
  ~SerialQueue(); ///< waits
  SerialQueue(const SerialQueue&) = delete;
  SerialQueue& operator=(const SerialQueue&) = delete;

  /// From one thread at a time; wait() only when none does.
  void submit(std::function<void()> job);
  /// Whether wait() need not wait.
  bool isDone() const;
  /// Waits until all are done, working meanwhile; rethrows the first failure.
  void wait();

private:
  void drain();
  ThreadPool& Pool;
  mutable std::mutex Mutex;
  std::deque<std::function<void()>> Jobs;
  bool Running = false;
  std::future<void> Runner;
  std::exception_ptr Failure;
};

} // namespace dgtk

#endif
