// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkInterpreterPause.h"

// Of Python's interface: all there where the process is an interpreter, all null in other programs.
extern "C"
{
  [[gnu::weak]] int Py_IsInitialized();
  [[gnu::weak]] int PyGILState_Check();
  [[gnu::weak]] void* PyEval_SaveThread();
  [[gnu::weak]] void PyEval_RestoreThread(void* thread);
}

namespace dgtk
{

InterpreterPause::InterpreterPause()
  : Thread(nullptr)
{
  if (Py_IsInitialized && Py_IsInitialized() != 0 && PyGILState_Check() != 0)
  {
    this->Thread = PyEval_SaveThread();
  }
}

InterpreterPause::~InterpreterPause()
{
  if (this->Thread != nullptr)
  {
    PyEval_RestoreThread(this->Thread);
  }
}

} // namespace dgtk
