// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkThreadPool_h
#define dgtkThreadPool_h

#include "dgtkCoreModule.h"

#include <functional>
#include <future>
#include <memory>

namespace dgtk
{

/// A fixed number of threads, the calling one counted, and one queue, first in, first out. With one thread everything
/// runs in the caller. oneTBB promises neither this order, by which bands leave memory early, nor which failure is
/// told.
class DGTKCORE_EXPORT ThreadPool
{
public:
  /// `threads` >= 1; threads - 1 workers are started. Throws MachineError where one cannot be.
  explicit ThreadPool(int threads);
  /// Waits for every submitted job.
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  int threads() const;

  /// Runs `job` on a worker (at once, in the caller, when there is none); the future carries its exception.
  std::future<void> submit(std::function<void()> job);

  /// Waits for a submitted job, running queued jobs meanwhile; rethrows its exception.
  void wait(std::future<void>& job);

  /// Calls body(i) for i in [0, count) on the workers and the calling thread; returns when all are done and
  /// rethrows the exception of the lowest i that failed. May be called from a job: the caller works too, so it
  /// cannot dead-lock.
  void parallelFor(int count, const std::function<void(int)>& body);

private:
  struct Impl;
  std::unique_ptr<Impl> Self;
};

} // namespace dgtk

#endif
