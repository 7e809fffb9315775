// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkInterpreterPause_h
#define dgtkInterpreterPause_h

#include "dgtkPipelineModule.h"

namespace dgtk
{

/// While it lives, the lock of the Python interpreter that calls is free, so that its other threads run. Elsewhere it
/// does nothing. VTK's objects are used under the lock: nothing that lives while it does may touch one that others see.
/// An interpreter that ends waits for those of its threads, which end nowhere then: they stop.
class DGTKPIPELINE_EXPORT InterpreterPause
{
public:
  InterpreterPause();
  ~InterpreterPause();
  InterpreterPause(const InterpreterPause&) = delete;
  InterpreterPause& operator=(const InterpreterPause&) = delete;

private:
  void* Thread; ///< what Python knows of the calling thread; null where there is no interpreter
};

} // namespace dgtk

#endif
