// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkThreadPool.h"

#include "dgtkError.h"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace dgtk
{

struct ThreadPool::Impl
{
  std::mutex mutex;
  std::condition_variable wake;
  std::deque<std::packaged_task<void()>> queue;
  bool closing = false;
  std::vector<std::thread> workers;

  // Takes the oldest job; false when there is none.
  bool take(std::packaged_task<void()>& task)
  {
    if (this->queue.empty())
    {
      return false;
    }
    task = std::move(this->queue.front());
    this->queue.pop_front();
    return true;
  }

  /// Runs a job; whoever waits for it looks again.
  void run(std::packaged_task<void()>& task)
  {
    task();
    {
      const std::lock_guard<std::mutex> lock(this->mutex); // between another's look and its sleep nothing happens
    }
    this->wake.notify_all();
  }

  void close()
  {
    {
      const std::lock_guard<std::mutex> lock(this->mutex);
      this->closing = true;
    }
    this->wake.notify_all();
    for (std::thread& worker : this->workers)
    {
      worker.join();
    }
  }

  void work()
  {
    for (;;)
    {
      std::packaged_task<void()> task;
      {
        std::unique_lock<std::mutex> lock(this->mutex);
        this->wake.wait(lock, [this] { return this->closing || !this->queue.empty(); });
        if (!this->take(task))
        {
          return;
        }
      }
      this->run(task);
    }
  }
};

ThreadPool::ThreadPool(int threads)
  : Self(new Impl)
{
  try
  {
    for (int i = 1; i < threads; ++i)
    {
      this->Self->workers.emplace_back([this] { this->Self->work(); });
    }
  }
  catch (const std::system_error& error)
  {
    this->Self->close();
    throw MachineError("a thread cannot be started: " + error.code().message());
  }
}

ThreadPool::~ThreadPool() { this->Self->close(); }

int ThreadPool::threads() const { return static_cast<int>(this->Self->workers.size()) + 1; }

std::future<void> ThreadPool::submit(std::function<void()> job)
{
  std::packaged_task<void()> task(std::move(job));
  std::future<void> future = task.get_future();
  if (this->Self->workers.empty())
  {
    task();
    return future;
  }
  {
    const std::lock_guard<std::mutex> lock(this->Self->mutex);
    this->Self->queue.push_back(std::move(task));
  }
  this->Self->wake.notify_all(); // one that is woken may find its own job done, and not take this one
  return future;
}

void ThreadPool::wait(std::future<void>& job)
{
  using namespace std::chrono_literals;
  const auto isDone = [&job] { return job.wait_for(0s) == std::future_status::ready; };
  while (!isDone())
  {
    std::packaged_task<void()> task;
    bool taken = false;
    {
      // jobs may come while the last ones are running, from these foremost
      std::unique_lock<std::mutex> lock(this->Self->mutex);
      this->Self->wake.wait(lock, [&] { return isDone() || !this->Self->queue.empty(); });
      taken = !isDone() && this->Self->take(task);
    }
    if (taken)
    {
      this->Self->run(task);
    }
  }
  job.get();
}

namespace
{
// Shared by the caller and its helpers; helpers that wake after the last index find nothing to do.
struct LoopState
{
  std::atomic<int> next{ 0 };
  int count = 0;
  std::function<void(int)> body;
  std::mutex mutex;
  std::condition_variable done;
  int finished = 0;
  int failedIndex = -1;
  std::exception_ptr failure;

  void run()
  {
    for (int i = this->next++; i < this->count; i = this->next++)
    {
      std::exception_ptr caught;
      try
      {
        this->body(i);
      }
      catch (...)
      {
        caught = std::current_exception();
      }
      const std::lock_guard<std::mutex> lock(this->mutex);
      if (caught && (this->failedIndex < 0 || i < this->failedIndex))
      {
        this->failedIndex = i;
        this->failure = caught;
      }
      if (++this->finished == this->count)
      {
        this->done.notify_all();
      }
    }
  }
};
} // namespace

void ThreadPool::parallelFor(int count, const std::function<void(int)>& body)
{
  if (count <= 0)
  {
    return;
  }
  const auto state = std::make_shared<LoopState>();
  state->count = count;
  state->body = body;
  for (int i = 1; i < count && i < this->threads(); ++i)
  {
    this->submit([state] { state->run(); });
  }
  state->run();
  std::unique_lock<std::mutex> lock(state->mutex);
  state->done.wait(lock, [&] { return state->finished == state->count; });
  if (state->failure)
  {
    std::rethrow_exception(state->failure);
  }
}

} // namespace dgtk
