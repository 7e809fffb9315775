// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkHelperProcess_h
#define dgtkHelperProcess_h

#include "dgtkHelperChannel.h"

#include <string>
#include <vector>

#include <sys/types.h>

namespace dgtk::helper
{

/// Path of a helper program: the value of the environment variable `variable`, else beside the library (bin/ and
/// libexec/dgtk/ of the folders above it). Throws MachineError when it is not there.
std::string findProgram(const char* name, const char* variable);

/// Path of a program of the machine: the value of the environment variable `variable`, else the first in PATH; "" when
/// there is none.
std::string installedProgram(const std::string& name, const std::string& variable);

/// A running helper. What it says on its standard error is dropped.
class Process
{
public:
  /// Starts the program; `output`, when not negative, becomes its standard output. Throws MachineError.
  Process(const std::vector<std::string>& command, int output);
  ~Process(); ///< ends it
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// Our end of the socket that is its standard input.
  int channel() const { return this->Channel.get(); }
  /// Whether this process started it, and not one that this process was forked from.
  bool isOurs() const;
  /// Hangs up and waits for its end; its status as of waitpid.
  int wait();

private:
  Descriptor Channel;
  pid_t Child = -1;
  pid_t Owner = -1;
};

/// Whether an end by this signal was meant for the program as a whole: interrupted from the terminal, or told to end.
bool isInterruption(int signal);

/// The signal that a status of waitpid tells of, 0 for none. Throws MachineError for an interruption: `path` was not
/// read to its end.
int signalOf(int status, const std::string& path);
/// Whether addresses are limited (`ulimit -v`) to fewer than a helper has: its end may have come from that, whatever it
/// looks like.
bool addressesAreFew();
/// "signal 6, Aborted"
std::string signalText(int signal);

} // namespace dgtk::helper

#endif
