// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"

#include <cstdio>

namespace dgtk
{

namespace
{
std::string inputMessage(
  const std::string& file, long line, const std::string& what, const std::string& expected, const std::string& found)
{
  std::string message = file;
  if (line >= 1)
  {
    message += ':' + std::to_string(line);
  }
  message += ": " + what;
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
  std::string out = "'";
  for (std::size_t i = 0; i < text.size() && i < longest; ++i)
  {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c < 0x20 || c == 0x7f)
    {
      char code[8];
      std::snprintf(code, sizeof code, "\\x%02x", c);
      out += code;
    }
    else
    {
      out += text[i];
    }
  }
  return out + (text.size() > longest ? "...'" : "'");
}

} // namespace dgtk
