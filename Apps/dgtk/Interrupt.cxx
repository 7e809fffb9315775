// SPDX-License-Identifier: BSD-3-Clause
#include "Interrupt.h"

#include "Options.h"

#include "dgtkAgainError.h"
#include "dgtkError.h"

#include <algorithm>

#include <signal.h>

namespace dgtk::app
{

namespace
{
std::atomic<bool> interrupted{ false };

void onInterrupt(int signal)
{
  interrupted = true;
  ::signal(signal, SIG_DFL); // a second one ends the program at once
}
} // namespace

const std::atomic<bool>& catchInterrupts()
{
  struct sigaction action = {};
  action.sa_handler = &onInterrupt;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  struct sigaction hangUp = {};
  if (::sigaction(SIGHUP, nullptr, &hangUp) == 0 && hangUp.sa_handler != SIG_IGN) // not below nohup
  {
    ::sigaction(SIGHUP, &action, nullptr);
  }
  ::sigaction(SIGUSR1, &action, nullptr); // schedulers say so that time is nearly over
  return interrupted;
}

FrameSteps parseFrames(const std::string& text)
{
  constexpr int most = 1 << 30;
  std::vector<int> numbers;
  for (std::size_t begin = 0; begin <= text.size();)
  {
    const std::size_t colon = std::min(text.find(':', begin), text.size());
    numbers.push_back(parseInteger(text.substr(begin, colon - begin), "--frames", -most, most));
    begin = colon + 1;
  }
  if (numbers.size() > 3)
  {
    throw UsageError("--frames: expected A[:B[:STEP]], found " + quoted(text));
  }
  FrameSteps range;
  range.first = numbers[0];
  range.last = numbers.size() > 1 ? numbers[1] : numbers[0];
  range.step = numbers.size() > 2 ? numbers[2] : 1;
  if (range.last < range.first || range.step < 1)
  {
    throw UsageError("--frames: expected A <= B and STEP >= 1, found " + quoted(text));
  }
  return range;
}

std::string optionWord(const OptionRow& row)
{
  std::string word = "--" + row.name;
  std::replace(word.begin(), word.end(), '_', '-');
  return word;
}

std::string withOption(const std::string& line, const std::vector<const OptionRow*>& rows)
{
  const std::string name = line.substr(0, line.find(": "));
  const auto named = std::find_if(rows.begin(), rows.end(), [&](const OptionRow* row) { return row->name == name; });
  return named == rows.end() ? line : optionWord(**named) + line.substr(name.size());
}

void refuse(const FolderError& error, bool isShare)
{
  const std::string begin = error.what() + std::string(isShare ? "; without --shard, " : "; ");
  switch (error.contents())
  {
    case FolderContents::Running:
      throw AgainError(error.what());
    case FolderContents::Unfinished:
      throw UsageError(begin + "--resume completes it, --replace starts over");
    case FolderContents::FinishedOther:
    case FolderContents::UnfinishedOther:
      throw UsageError(begin + "--replace removes it, or name another folder");
    default:
      throw UsageError(error.what());
  }
}

} // namespace dgtk::app
