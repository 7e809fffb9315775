// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSyncAhead.h"

#include <system_error>
#include <utility>

namespace dgtk
{

SyncAhead::SyncAhead(std::function<void()> sync, std::uint64_t step)
  : Sync(std::move(sync))
  , Step(step)
{
}

SyncAhead::~SyncAhead()
{
  if (this->Thread.joinable())
  {
    this->Thread.join();
  }
}

void SyncAhead::wrote(std::uint64_t bytes)
{
  const std::lock_guard<std::mutex> guard(this->Mutex);
  this->Waiting += bytes;
  if (this->Waiting < this->Step || this->Busy)
  {
    return;
  }
  this->Waiting = 0;
  if (this->Thread.joinable())
  {
    this->Thread.join(); // it has nothing left to do
  }
  try
  {
    this->Busy = true;
    this->Thread = std::thread([this] { this->run(); });
  }
  catch (const std::system_error&)
  {
    this->Busy = false; // no thread to be had: all the more is left for the end
  }
}

void SyncAhead::run()
{
  std::exception_ptr failure;
  try
  {
    this->Sync();
  }
  catch (...)
  {
    failure = std::current_exception();
  }
  const std::lock_guard<std::mutex> guard(this->Mutex);
  this->Failure = this->Failure ? this->Failure : failure;
  this->Busy = false;
}

void SyncAhead::finish()
{
  if (this->Thread.joinable())
  {
    this->Thread.join();
  }
  if (this->Failure)
  {
    std::rethrow_exception(this->Failure);
  }
}

} // namespace dgtk
