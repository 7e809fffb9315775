// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkBackgroundRun.h"

#include "dgtkInterpreterPause.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include <unistd.h>

namespace
{
constexpr std::chrono::milliseconds patience(20);
constexpr int longestWait = 1000000;
} // namespace

dgtkBackgroundRun::~dgtkBackgroundRun()
{
  if (this->Process != ::getpid() && this->Thread.joinable())
  {
    // in a process that was forked while it ran: the thread is not there; without memory the process ends
    static_cast<void>(new std::thread(std::move(this->Thread))); // NOLINT(bugprone-unhandled-exception-at-new)
    static_cast<void>(new std::shared_ptr<State>(this->Self));   // NOLINT(bugprone-unhandled-exception-at-new)
    return;
  }
  this->end();
}

/// Of a run that is over, or soon.
void dgtkBackgroundRun::end()
{
  this->Self->cancel = true;
  if (this->Thread.joinable())
  {
    const dgtk::InterpreterPause pause;
    this->Thread.join();
  }
}

void dgtkBackgroundRun::start(Work work)
{
  if (this->isRunning())
  {
    return;
  }
  this->end();
  State& self = *this->Self;
  self.cancel = false;
  self.over = false;
  self.reports.clear();
  self.failure.clear();
  this->Last = {};
  this->Process = ::getpid();
  try
  {
    this->Thread = std::thread([state = this->Self, work = std::move(work)] { state->run(work); });
  }
  catch (...) // too many threads
  {
    self.failure.take();
    self.over = true;
  }
}

void dgtkBackgroundRun::State::run(const Work& work)
{
  dgtk::Failure how;
  try
  {
    work(this->cancel, [this](Report one) { this->report(one); });
  }
  catch (...)
  {
    how.take();
  }
  const std::lock_guard<std::mutex> lock(this->mutex);
  this->failure = how;
  this->over = true;
  this->change.notify_all();
}

/// Whoever waits for it may cancel the run before the next one.
void dgtkBackgroundRun::State::report(Report one)
{
  std::unique_lock<std::mutex> lock(this->mutex);
  this->reports.push_back(one);
  this->change.notify_all();
  this->change.wait_for(lock, patience, [this] { return this->cancel || this->reports.empty(); });
}

bool dgtkBackgroundRun::isRunning() const
{
  const std::lock_guard<std::mutex> lock(this->Self->mutex);
  return !this->Self->over || !this->Self->reports.empty();
}

bool dgtkBackgroundRun::wait(int milliseconds)
{
  const dgtk::InterpreterPause pause;
  State& self = *this->Self;
  std::unique_lock<std::mutex> lock(self.mutex);
  self.change.wait_for(lock, std::chrono::milliseconds(std::clamp(milliseconds, 0, longestWait)),
    [&self] { return self.over || !self.reports.empty(); });
  if (self.reports.empty())
  {
    return false;
  }
  this->Last = self.reports.front();
  self.reports.pop_front();
  self.change.notify_all();
  return true;
}

void dgtkBackgroundRun::cancel() { this->Self->cancel = true; }

dgtk::Failure dgtkBackgroundRun::failure() const
{
  const std::lock_guard<std::mutex> lock(this->Self->mutex);
  return this->Self->failure;
}
