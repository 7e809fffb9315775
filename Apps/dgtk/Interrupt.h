// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAppInterrupt_h
#define dgtkAppInterrupt_h

#include "dgtkJournal.h"
#include "dgtkOption.h"

#include <atomic>
#include <string>
#include <vector>

// What the commands that write many files share.

namespace dgtk::app
{

/// From now on Ctrl-C, SIGTERM and SIGHUP set the flag; a second one ends the program at once.
const std::atomic<bool>& catchInterrupts();

struct FrameSteps
{
  int first = 0;
  int last = 0;
  int step = 1;
};
/// "A[:B[:STEP]]"; UsageError otherwise.
FrameSteps parseFrames(const std::string& text);

/// "--points-step" of the option points_step.
std::string optionWord(const OptionRow& row);
/// A refusal that begins with the name of an option ("points_step: ..."), as the command line has it.
std::string withOption(const std::string& line, const std::vector<const OptionRow*>& rows);

/// Throws what the user is told of a folder that is refused to a whole run or to a share of one, with what may be done;
/// AgainError where another process is at work.
[[noreturn]] void refuse(const FolderError& error, bool isShare);

} // namespace dgtk::app

#endif
