// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkObjStatements.h"

#include "dgtkError.h"
#include "dgtkTextLines.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace dgtk
{

namespace
{
bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
} // namespace

/// The next line, with those that it continues in.
std::string_view ObjStatements::logicalLine()
{
  this->Joined.clear();
  for (bool continues = false;; continues = true)
  {
    const std::size_t newline = this->Text.find('\n', this->Next);
    const std::size_t stop = std::min(newline, this->Text.size());
    std::string_view line = this->Text.substr(this->Next, stop - this->Next);
    this->Next = stop + 1;
    ++this->Line;
    this->First = continues ? this->First : this->Line;
    if (!line.empty() && line.back() == '\r')
    {
      line.remove_suffix(1);
    }
    const bool open = !line.empty() && line.back() == '\\' && this->Next < this->Text.size();
    if (!open && !continues)
    {
      return line;
    }
    this->Joined.append(line.substr(0, line.size() - (open ? 1 : 0)));
    if (!open)
    {
      return this->Joined;
    }
  }
}

void ObjStatements::skipBlanks()
{
  while (this->At < this->End && isBlank(*this->At))
  {
    ++this->At;
  }
}

/// Whether words of the statement are left, a comment apart.
bool ObjStatements::hasMore()
{
  this->skipBlanks();
  return this->At < this->End && *this->At != '#';
}

bool ObjStatements::next()
{
  while (this->Next < this->Text.size())
  {
    const std::string_view line = this->logicalLine();
    this->At = line.data();
    this->End = line.data() + line.size();
    this->Keyword = this->word();
    if (!this->Keyword.empty() && this->Keyword.front() != '#')
    {
      return true;
    }
  }
  return false;
}

std::string_view ObjStatements::word()
{
  this->skipBlanks();
  const char* const begin = this->At;
  while (this->At < this->End && !isBlank(*this->At))
  {
    ++this->At;
  }
  return { begin, static_cast<std::size_t>(this->At - begin) };
}

std::string_view ObjStatements::rest()
{
  this->skipBlanks();
  const char* end = this->End;
  while (end > this->At && isBlank(end[-1]))
  {
    --end;
  }
  return { this->At, static_cast<std::size_t>(end - this->At) };
}

void ObjStatements::refuseWord(const char* what, const char* expected)
{
  const std::string_view word = this->word();
  throw InputError(this->Path, this->First, std::string(this->Keyword) + ": " + what, expected,
    quoted(std::string(word.substr(0, 60))));
}

bool ObjStatements::number(double& value)
{
  if (!this->hasMore())
  {
    return false;
  }
  const std::from_chars_result parsed = std::from_chars(this->At, this->End, value);
  if (parsed.ec == std::errc() && (parsed.ptr == this->End || isBlank(*parsed.ptr)))
  {
    this->At = parsed.ptr;
    return true;
  }
  const char* const begin = this->At;
  const std::optional<double> unusual = parseNumber(this->word());
  if (!unusual)
  {
    this->At = begin;
    this->refuseWord("is no number", "a number");
  }
  value = *unusual;
  return true;
}

std::size_t ObjStatements::numbers(double* to, std::size_t most)
{
  std::size_t count = 0;
  while (count < most && this->number(to[count]))
  {
    ++count;
  }
  return count;
}

bool ObjStatements::corner(std::array<long long, 3>& indices)
{
  if (!this->hasMore())
  {
    return false;
  }
  const char* at = this->At;
  indices = { 0, 0, 0 };
  for (std::size_t i = 0; i < 3; ++i)
  {
    const std::from_chars_result parsed = std::from_chars(at, this->End, indices[i]);
    if (parsed.ec == std::errc::result_out_of_range)
    {
      indices[i] = std::numeric_limits<long long>::max(); // of nothing
    }
    else if (parsed.ec != std::errc() && i == 0)
    {
      break;
    }
    at = parsed.ptr;
    if (at == this->End || isBlank(*at))
    {
      this->At = at;
      return true;
    }
    if (*at != '/')
    {
      break;
    }
    ++at;
    if (i < 2 && (at == this->End || isBlank(*at)))
    {
      this->At = at; // "7/"
      return true;
    }
  }
  this->refuseWord("is no corner", "vertex/texture/normal");
}

} // namespace dgtk
