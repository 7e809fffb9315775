// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkSystem_h
#define dgtkSystem_h

#include "dgtkCoreModule.h"

#include <string>

namespace dgtk
{

/// Threads that the machine runs side by side, at least 1 and at most `most`.
DGTKCORE_EXPORT int machineThreads(int most = 1 << 20);

/// Whether a path names a regular file that may be executed.
DGTKCORE_EXPORT bool isProgram(const std::string& path);

/// Absolute path of the first program of that name in the folders of the environment variable PATH; "" when none has
/// it.
DGTKCORE_EXPORT std::string programOnPath(const std::string& name);

/// For programs, once at their start (a library must not decide it): memory that is freed is kept for what comes, and
/// the first 192 MiB of the heap are of large pages, because memory that comes and goes page by page costs a seventh of
/// a run's processor time and more on virtual machines. True when large pages were asked for: not where the system has
/// none, another allocator is in use, or memory is limited (`ulimit -v`, `-d`).
DGTKCORE_EXPORT bool prepareHeap();

/// For programs, once at their start: where standard input, output or error is closed, its number is taken, so that no
/// file that is opened later has it and gets what was meant for the user. Writing to it fails as before.
DGTKCORE_EXPORT void holdStandardStreams();

/// A folder among the system's temporary ones, made when it is first asked for and gone with its owner.
class DGTKCORE_EXPORT ScratchFolder
{
public:
  ScratchFolder() = default;
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  /// Throws MachineError when it cannot be made.
  const std::string& path();
  std::string path(const std::string& name) { return this->path() + '/' + name; }

private:
  std::string Path;
};

} // namespace dgtk

#endif
