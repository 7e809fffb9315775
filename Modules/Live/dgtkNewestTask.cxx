// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkNewestTask.h"

#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

namespace dgtk
{

struct NewestTask::Impl
{
  void run();

  std::mutex Mutex;
  std::condition_variable Changed;
  std::function<void(const Outdated&)> Next;
  bool Busy = false;
  bool Ending = false;
  std::atomic<bool> Waiting{ false }; ///< a newer task, or the end
  std::thread Thread;
};

void NewestTask::Impl::run()
{
  std::unique_lock<std::mutex> lock(this->Mutex);
  while (true)
  {
    this->Changed.wait(lock, [this] { return this->Ending || this->Next; });
    if (this->Ending)
    {
      return;
    }
    auto task = std::exchange(this->Next, nullptr);
    this->Waiting = false;
    this->Busy = true;
    lock.unlock();
    task([this] { return this->Waiting.load(); });
    task = nullptr; // what it holds may take a while to be destroyed
    lock.lock();
    this->Busy = false;
    this->Changed.notify_all();
  }
}

NewestTask::NewestTask()
  : Self(std::make_unique<Impl>())
{
  this->Self->Thread = std::thread([self = this->Self.get()] { self->run(); });
}

NewestTask::~NewestTask()
{
  {
    const std::lock_guard<std::mutex> lock(this->Self->Mutex);
    this->Self->Ending = true;
    this->Self->Waiting = true;
    this->Self->Next = nullptr;
  }
  this->Self->Changed.notify_all();
  this->Self->Thread.join();
}

void NewestTask::start(std::function<void(const Outdated&)> task)
{
  {
    const std::lock_guard<std::mutex> lock(this->Self->Mutex);
    this->Self->Next.swap(task); // what waited is destroyed outside the lock
    this->Self->Waiting = true;
  }
  this->Self->Changed.notify_all();
}

void NewestTask::wait()
{
  std::unique_lock<std::mutex> lock(this->Self->Mutex);
  this->Self->Changed.wait(lock, [this] { return !this->Self->Busy && !this->Self->Next; });
}

} // namespace dgtk
