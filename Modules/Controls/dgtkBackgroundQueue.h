// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkBackgroundQueue_h
#define dgtkBackgroundQueue_h

#include "dgtkControlsModule.h"

#include <QObject>

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

namespace dgtk
{

/// Work off the window's thread. Each piece belongs to a slot; a newer piece for a slot takes the place of an older
/// one, whose result never arrives. The destructor waits for what is running.
class DGTKCONTROLS_EXPORT BackgroundQueue : public QObject
{
  Q_OBJECT

public:
  using GoOn = std::function<bool()>;
  using Done = std::function<void()>; ///< called on the thread of this object
  using Work = std::function<Done(const GoOn&)>;

  BackgroundQueue(int threads, QObject* parent);
  ~BackgroundQueue() override;

  /// Lower `priority` first. `work` must not throw; where its GoOn says false it may return early.
  void post(int slot, int priority, Work work);
  /// Forgets what a slot waits for.
  void drop(int slot);

private:
  struct Piece
  {
    int slot;
    int priority;
    std::uint64_t ticket;
    Work work;
  };
  void run();
  bool isNewest(int slot, std::uint64_t ticket);

  std::mutex Mutex;
  std::condition_variable Wake;
  std::list<Piece> Waiting;
  std::map<int, std::uint64_t> Newest; ///< tickets of slots
  std::uint64_t Tickets = 0;
  bool Stopping = false;
  std::vector<std::thread> Threads;
};

} // namespace dgtk

#endif
