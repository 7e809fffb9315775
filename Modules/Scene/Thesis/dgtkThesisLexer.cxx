// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkThesisLexer.h"

#include "dgtkError.h"
#include "dgtkSceneText.h"

#include <algorithm>
#include <charconv>

namespace dgtk::scenefile
{

namespace
{
constexpr std::string_view brackets = "<>{}()[]:";

bool separates(char c)
{
  // A backslash stands before the braces where a scene was copied from typeset text.
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v' || c == ',' || c == '\\';
}
} // namespace

ThesisLexer::ThesisLexer(const std::string& file, std::string_view text)
  : File(&file)
  , Text(text)
{
  if (text.substr(0, 3) == "\xef\xbb\xbf")
  {
    this->At = 3;
  }
}

void ThesisLexer::skipSeparators()
{
  while (this->At < this->Text.size() && separates(this->Text[this->At]))
  {
    const char c = this->Text[this->At++];
    this->Line += c == '\n' || (c == '\r' && this->Text.substr(this->At, 1) != "\n");
  }
}

std::string_view ThesisLexer::peek()
{
  this->skipSeparators();
  if (this->At == this->Text.size() || brackets.find(this->Text[this->At]) != std::string_view::npos)
  {
    return this->Text.substr(this->At, 1);
  }
  std::size_t end = this->At;
  while (
    end < this->Text.size() && !separates(this->Text[end]) && brackets.find(this->Text[end]) == std::string_view::npos)
  {
    ++end;
  }
  return this->Text.substr(this->At, end - this->At);
}

long ThesisLexer::line()
{
  this->skipSeparators();
  return this->Line;
}

bool ThesisLexer::atEnd() { return this->peek().empty(); }

bool ThesisLexer::next(std::string_view wanted) { return this->peek() == wanted; }

bool ThesisLexer::take(std::string_view wanted)
{
  const bool found = this->next(wanted);
  this->At += found ? wanted.size() : 0;
  return found;
}

std::string_view ThesisLexer::word()
{
  const std::string_view found = this->peek();
  this->At += found.size();
  return found;
}

void ThesisLexer::fail(const std::string& what, const std::string& expected)
{
  const std::string found(this->peek());
  throw InputError(*this->File, this->Line, what, expected, found.empty() ? "the end of the file" : quoted(found));
}

void ThesisLexer::expect(std::string_view wanted, const std::string& what)
{
  if (!this->take(wanted))
  {
    this->fail(what, quoted(std::string(wanted)));
  }
}

double ThesisLexer::number(const Range& range, const std::string& what)
{
  const std::string_view text = this->peek();
  double value = 0;
  const std::string fault = parseNumber(text, value);
  if (!fault.empty())
  {
    this->fail(what, fault);
  }
  if (!range.holds(value))
  {
    this->fail(what + " is out of range", range.text);
  }
  this->At += text.size();
  return value;
}

long ThesisLexer::count(const std::string& what)
{
  const std::string_view text = this->peek();
  long value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || result.ec != std::errc() || result.ptr != text.data() + text.size() || value < 0)
  {
    this->fail(what, "a whole number from 0");
  }
  this->At += text.size();
  return value;
}

Eigen::Vector3d ThesisLexer::vector(const Range& range, const std::string& what)
{
  const double x = this->number(range, what);
  const double y = this->number(range, what);
  return { x, y, this->number(range, what) };
}

std::string ThesisLexer::restOfLine(char stop)
{
  const std::size_t line = std::min(this->Text.find_first_of("\r\n", this->At), this->Text.size());
  std::string_view rest = this->Text.substr(this->At, line - this->At);
  rest = rest.substr(0, rest.find(stop));
  this->At += rest.size();
  while (!rest.empty() && (rest.front() == ' ' || rest.front() == '\t'))
  {
    rest.remove_prefix(1);
  }
  while (!rest.empty() && (rest.back() == ' ' || rest.back() == '\t'))
  {
    rest.remove_suffix(1);
  }
  return std::string(rest);
}

} // namespace dgtk::scenefile
