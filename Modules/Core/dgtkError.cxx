// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"

#include "dgtkPathNames.h"
#include "dgtkUtf8.h"

#include <algorithm>

namespace dgtk
{

Error::Error(ExitCode code, const std::string& message)
  : std::runtime_error(printable(message))
  , Code(code)
{
}

namespace
{
std::string inputMessage(
  const std::string& file, long line, const std::string& what, const std::string& expected, const std::string& found)
{
  std::string message = tidied(file);
  if (line >= 1)
  {
    message += ':' + std::to_string(line);
  }
  message += (message.empty() ? "" : ": ") + what;
  if (!expected.empty() || !found.empty())
  {
    message += " (";
    message += expected.empty() ? "" : "expected " + expected;
    message += expected.empty() || found.empty() ? "" : ", ";
    message += found.empty() ? "" : "found " + found;
    message += ')';
  }
  return message;
}
} // namespace

InputError::InputError(
  const std::string& file, long line, const std::string& what, const std::string& expected, const std::string& found)
  : Error(ExitCode::Input, inputMessage(file, line, what, expected, found))
  , File(file)
  , Line(line)
{
}

std::string quoted(const std::string& text)
{
  constexpr std::size_t longest = 40;
  std::size_t end = std::min(text.size(), longest);
  while (end < text.size() && end > longest - 3 && (text[end] & '\xc0') == '\x80') // within a character
  {
    --end;
  }
  return "'" + printable(text.substr(0, end)) + (end < text.size() ? "...'" : "'");
}

} // namespace dgtk
