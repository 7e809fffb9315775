// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSerialQueue.h"

namespace dgtk
{

SerialQueue::SerialQueue(ThreadPool& pool)
  : Pool(pool)
{
}

SerialQueue::~SerialQueue()
{
  try
  {
    this->wait();
  }
  catch (...) // whoever wanted to know has asked by wait()
  {
  }
}

void SerialQueue::submit(std::function<void()> job)
{
  {
    const std::lock_guard<std::mutex> lock(this->Mutex);
    this->Jobs.push_back(std::move(job));
    if (this->Running)
    {
      return;
    }
    this->Running = true;
  }
  // only who submits touches Runner, one thread at a time, and the runner before has ended
  this->Runner = this->Pool.submit([this] { this->drain(); });
}

void SerialQueue::drain()
{
  for (;;)
  {
    std::function<void()> job;
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      if (this->Failure)
      {
        this->Jobs.clear();
      }
      if (this->Jobs.empty())
      {
        this->Running = false;
        return;
      }
      job = std::move(this->Jobs.front());
      this->Jobs.pop_front();
    }
    try
    {
      job();
    }
    catch (...)
    {
      const std::lock_guard<std::mutex> lock(this->Mutex);
      this->Failure = std::current_exception();
    }
  }
}

bool SerialQueue::isDone() const
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  return !this->Running;
}

void SerialQueue::wait()
{
  if (this->Runner.valid())
  {
    this->Pool.wait(this->Runner);
  }
  const std::lock_guard<std::mutex> lock(this->Mutex);
  if (this->Failure)
  {
    std::rethrow_exception(this->Failure);
  }
}

} // namespace dgtk
