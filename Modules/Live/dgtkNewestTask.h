// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkNewestTask_h
#define dgtkNewestTask_h

#include "dgtkLiveModule.h"

#include <functional>
#include <memory>

namespace dgtk
{

/// A thread that works on the newest task only: one that waits is replaced by the next, which never starts then.
class DGTKLIVE_EXPORT NewestTask
{
public:
  /// True when a newer task waits or the owner is being destroyed.
  using Outdated = std::function<bool()>;

  NewestTask();
  /// Waits for the running task, which sees that it is outdated.
  ~NewestTask();
  NewestTask(const NewestTask&) = delete;
  NewestTask& operator=(const NewestTask&) = delete;

  /// Returns at once. A task must not throw.
  void start(std::function<void(const Outdated&)> task);
  /// Until nothing runs or waits.
  void wait();

private:
  struct Impl;
  std::unique_ptr<Impl> Self;
};

} // namespace dgtk

#endif
