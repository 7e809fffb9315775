// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkError_h
#define dgtkError_h

#include "dgtkCoreModule.h"

#include <stdexcept>
#include <string>

namespace dgtk
{

/// Process exit status that an error leads to; the numbers are those of the command line.
enum class ExitCode
{
  Done = 0,       ///< everything asked for was done
  Difference = 1, ///< a check found a difference
  Usage = 2,      ///< wrong usage
  Input = 3,      ///< input that cannot be used
  Machine = 4     ///< the machine cannot do it (no OpenGL, no space, no permission)
};

/// Base of every exception that DGTk throws. what() is one complete line of UTF-8 without a trailing newline: control
/// characters and bytes that are not UTF-8, as in names of files, are shown as \xE4.
class DGTKCORE_EXPORT Error : public std::runtime_error
{
public:
  Error(ExitCode code, const std::string& message);
  ExitCode code() const noexcept { return this->Code; }

private:
  ExitCode Code;
};

/// Wrong arguments given to a function or a command.
class DGTKCORE_EXPORT UsageError : public Error
{
public:
  explicit UsageError(const std::string& message)
    : Error(ExitCode::Usage, message)
  {
  }
};

/// The machine cannot do what was asked.
class DGTKCORE_EXPORT MachineError : public Error
{
public:
  explicit MachineError(const std::string& message)
    : Error(ExitCode::Machine, message)
  {
  }
};

/// Input that cannot be used. The text is `FILE:LINE: what (expected E, found F)`; LINE is left out when there is none,
/// or `line` < 1, the parenthesis when both `expected` and `found` are empty; FILE is tidied().
class DGTKCORE_EXPORT InputError : public Error
{
public:
  InputError(const std::string& file, long line, const std::string& what, const std::string& expected = {},
    const std::string& found = {});
  InputError(
    const std::string& file, const std::string& what, const std::string& expected = {}, const std::string& found = {})
    : InputError(file, 0L, what, expected, found)
  {
  }
  const std::string& file() const noexcept { return this->File; }
  long line() const noexcept { return this->Line; }

private:
  std::string File;
  long Line;
};

/// Quotes and shortens text found in a file for use in a message: escaped as in Error, at most 40 bytes.
DGTKCORE_EXPORT std::string quoted(const std::string& text);
/// For texts that may change, which the standard library's template of this name would take.
inline std::string quoted(std::string& text) { return quoted(static_cast<const std::string&>(text)); }

} // namespace dgtk

#endif
