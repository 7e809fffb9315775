// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSyncAhead_h
#define dgtkSyncAhead_h

#include "dgtkDatasetIOModule.h"

#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace dgtk
{

/// Sends what was written to the disk while more is being made, so that little is left to wait for at the end: one
/// thread at a time, after each `step` bytes.
class DGTKDATASETIO_EXPORT SyncAhead
{
public:
  /// `sync` waits for all that was written before, or throws; it is called from other threads, never twice at once.
  SyncAhead(std::function<void()> sync, std::uint64_t step);
  ~SyncAhead(); ///< waits for the one that is under way
  SyncAhead(const SyncAhead&) = delete;
  SyncAhead& operator=(const SyncAhead&) = delete;

  /// So many bytes more. May be called from any thread.
  void wrote(std::uint64_t bytes);
  /// Waits for the one that is under way, and throws what the first failed with: the system tells of a lost block once.
  void finish();

private:
  void run();

  std::function<void()> Sync;
  std::uint64_t Step;
  std::mutex Mutex; ///< of what follows
  std::uint64_t Waiting = 0;
  bool Busy = false;
  std::exception_ptr Failure;
  std::thread Thread;
};

} // namespace dgtk

#endif
