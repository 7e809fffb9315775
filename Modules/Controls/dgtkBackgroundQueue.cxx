// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkBackgroundQueue.h"

#include <QMetaObject>

#include <algorithm>

namespace dgtk
{

BackgroundQueue::BackgroundQueue(int threads, QObject* parent)
  : QObject(parent)
{
  for (int i = 0; i < std::max(1, threads); ++i)
  {
    this->Threads.emplace_back([this] { this->run(); });
  }
}

BackgroundQueue::~BackgroundQueue()
{
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Stopping = true;
  }
  this->Wake.notify_all();
  for (std::thread& thread : this->Threads)
  {
    thread.join();
  }
}

void BackgroundQueue::post(int slot, int priority, Work work)
{
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Waiting.remove_if([slot](const Piece& piece) { return piece.slot == slot; });
    this->Newest[slot] = ++this->Tickets;
    this->Waiting.push_back({ slot, priority, this->Tickets, std::move(work) });
  }
  this->Wake.notify_one();
}

void BackgroundQueue::drop(int slot)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->Waiting.remove_if([slot](const Piece& piece) { return piece.slot == slot; });
  this->Newest[slot] = ++this->Tickets;
}

bool BackgroundQueue::isNewest(int slot, std::uint64_t ticket)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return !this->Stopping && this->Newest[slot] == ticket;
}

void BackgroundQueue::run()
{
  for (;;)
  {
    Piece piece;
    {
      std::unique_lock<std::mutex> lock(this->Mutex);
      this->Wake.wait(lock, [this] { return this->Stopping || !this->Waiting.empty(); });
      if (this->Stopping)
      {
        return;
      }
      const auto next = std::min_element(this->Waiting.begin(), this->Waiting.end(),
        [](const Piece& a, const Piece& b) { return a.priority < b.priority; });
      piece = std::move(*next);
      this->Waiting.erase(next);
    }
    const int slot = piece.slot;
    const std::uint64_t ticket = piece.ticket;
    const Done done = piece.work([=] { return this->isNewest(slot, ticket); });
    QMetaObject::invokeMethod(
      this,
      [=]
      {
        if (done && this->isNewest(slot, ticket))
        {
          done();
        }
      },
      Qt::QueuedConnection);
  }
}

} // namespace dgtk
