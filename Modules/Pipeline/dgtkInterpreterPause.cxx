// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkInterpreterPause.h"

#include <atomic>
#include <chrono>
#include <thread>

#include <pthread.h>
#include <unistd.h>

// Of Python's interface: all there where the process is an interpreter, all null in other programs.
extern "C"
{
  [[gnu::weak]] int Py_IsInitialized();
  [[gnu::weak]] int PyGILState_Check();
  [[gnu::weak]] void* PyEval_SaveThread();
  [[gnu::weak]] void PyEval_RestoreThread(void* thread);
  [[gnu::weak]] int Py_AtExit(void (*work)());
}

namespace dgtk
{

namespace
{
std::atomic<int> threadsAtWork{ 0 };

/// When an interpreter has ended, but VTK has not yet taken down the objects that its threads use.
void awaitThreads()
{
  while (threadsAtWork > 0)
  {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

/// A forked process has none of the others.
void forgetThreads() { threadsAtWork = 0; }
} // namespace

InterpreterPause::InterpreterPause()
  : Thread(nullptr)
{
  if (Py_IsInitialized && Py_IsInitialized() != 0 && PyGILState_Check() != 0)
  {
    [[maybe_unused]] static const int registered =
      Py_AtExit(awaitThreads) + ::pthread_atfork(nullptr, nullptr, forgetThreads);
    ++threadsAtWork;
    this->Thread = PyEval_SaveThread();
  }
}

InterpreterPause::~InterpreterPause()
{
  if (this->Thread != nullptr)
  {
    --threadsAtWork;
    try
    {
      PyEval_RestoreThread(this->Thread);
    }
    catch (...)
    {
      // An interpreter that ends would end the thread, through objects that may not be left: it stops here instead.
      // What is caught is abi::__forced_unwind, but there is no object of it that could be named.
      for (;;)
      {
        ::pause();
      }
    }
  }
}

} // namespace dgtk
