// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkWorkTime_h
#define dgtkWorkTime_h

#include "dgtkCoreModule.h"

#include <cstdint>
#include <string>
#include <vector>

namespace dgtk
{

/// What a run works at.
enum class WorkStage
{
  Load,   ///< reading scenes, models and pictures, and hashing them
  Build,  ///< trees of the ray tracer, buffers of OpenGL
  Draw,   ///< OpenGL's calls, and reading back what was drawn
  Trace,  ///< rays in single precision, and what is asked of them
  Settle, ///< pixels that need exact arithmetic
  Derive, ///< values of layers
  Encode, ///< files' bytes
  Write   ///< system calls for files
};

/// The processor time of this thread while it lives counts for a stage, but for what another one counts within. Costs
/// nothing unless times are kept.
class DGTKCORE_EXPORT WorkTime
{
public:
  explicit WorkTime(WorkStage stage);
  ~WorkTime();
  WorkTime(const WorkTime&) = delete;
  WorkTime& operator=(const WorkTime&) = delete;

private:
  void stop();
  WorkStage Stage;
  bool Kept;
  WorkTime* Around = nullptr;
  double Since = 0;
};

/// A line of the table of a run.
struct StageTime
{
  std::string name;            ///< "load", ..., "other"
  double seconds = 0;          ///< of processors, of all threads
  std::uint64_t peakBytes = 0; ///< resident memory of the process at most until the stage ended last; 0: it did not
};

/// Keeps times from now on, in all threads.
DGTKCORE_EXPORT void keepWorkTimes();

/// All stages in their order, and "other": what the process spent besides, with threads of libraries, since it started.
DGTKCORE_EXPORT std::vector<StageTime> workTimes();

} // namespace dgtk

#endif
