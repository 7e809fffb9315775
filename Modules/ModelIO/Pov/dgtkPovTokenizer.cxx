// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkPovTokenizer.h"

#include "dgtkError.h"
#include "dgtkFile.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace dgtk
{

namespace
{
constexpr std::size_t deepestInclusion = 20;
constexpr std::size_t mostInclusions = 10000;
constexpr std::uint64_t mostBytes = std::uint64_t(1) << 30;
constexpr std::size_t longestWord = 256;

bool isLetter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool isDigit(char c) { return c >= '0' && c <= '9'; }
bool isSpace(char c) { return c == ' ' || (c >= '\t' && c <= '\r') || c == '\0'; }
} // namespace

PovTokenizer::PovTokenizer(const std::string& path) { this->open(path); }

void PovTokenizer::open(const std::string& path)
{
  auto source = std::make_unique<Source>();
  source->text = readFile(path, mostBytes);
  this->Bytes += source->text.size();
  if (source->text.compare(0, 3, "\xef\xbb\xbf") == 0)
  {
    source->at = 3;
  }
  const auto known = std::find(this->Paths.begin(), this->Paths.end(), path);
  source->place = { static_cast<std::size_t>(known - this->Paths.begin()), 1 };
  if (known == this->Paths.end())
  {
    this->Paths.push_back(path);
  }
  this->Stack.push_back(std::move(source));
}

void PovTokenizer::include(const std::string& path, const PovPlace& from)
{
  if (this->Stack.size() > deepestInclusion)
  {
    this->fail(from, "#include nests too deeply", "at most " + std::to_string(deepestInclusion) + " levels",
      "one more (a file that includes itself?)");
  }
  if (++this->Inclusions > mostInclusions || this->Bytes > mostBytes)
  {
    this->fail(from, "too many #include");
  }
  this->open(path);
}

void PovTokenizer::fail(
  const PovPlace& place, const std::string& what, const std::string& expected, const std::string& found) const
{
  throw InputError(this->Paths[place.file], place.line, what, expected, found);
}

void PovTokenizer::skipComment(Source& source)
{
  const PovPlace begin = source.place;
  int depth = 0;
  do
  {
    if (source.at + 1 >= source.text.size())
    {
      this->fail(begin, "comment is not closed", "*/", "end of file");
    }
    const bool opens = source.begins("/*");
    const bool closes = source.begins("*/");
    depth += opens ? 1 : closes ? -1 : 0;
    source.place.line += source.text[source.at] == '\n' ? 1 : 0;
    source.at += opens || closes ? 2 : 1;
  } while (depth > 0);
}

/// False at the end of the file.
bool PovTokenizer::skipSpace(Source& source)
{
  for (; source.at < source.text.size(); ++source.at)
  {
    while (source.begins("/*"))
    {
      this->skipComment(source);
    }
    if (source.begins("//"))
    {
      source.at = std::min(source.text.find('\n', source.at), source.text.size());
    }
    if (!isSpace(source.ahead()))
    {
      return true;
    }
    source.place.line += source.ahead() == '\n' ? 1 : 0;
  }
  return false;
}

PovToken PovTokenizer::number(Source& source)
{
  PovToken token;
  token.kind = PovToken::Kind::Number;
  const char* begin = source.text.data() + source.at;
  const auto parsed = std::from_chars(begin, source.text.data() + source.text.size(), token.number);
  token.text.assign(begin, std::min<std::size_t>(static_cast<std::size_t>(parsed.ptr - begin), longestWord));
  if (parsed.ec == std::errc::result_out_of_range)
  {
    const bool small = token.text.find("e-") != std::string::npos || token.text.find("E-") != std::string::npos;
    token.number = small ? 0 : std::numeric_limits<double>::infinity();
  }
  source.at += static_cast<std::size_t>(std::max<std::ptrdiff_t>(parsed.ptr - begin, 1));
  return token;
}

PovToken PovTokenizer::string(Source& source)
{
  PovToken token;
  token.kind = PovToken::Kind::String;
  const PovPlace begin = source.place;
  for (++source.at; source.at < source.text.size() && source.text[source.at] != '"'; ++source.at)
  {
    source.at += source.begins("\\\"") || source.begins("\\\\") ? 1 : 0;
    source.place.line += source.text[source.at] == '\n' ? 1 : 0;
    token.text += source.text[source.at];
  }
  if (source.at >= source.text.size())
  {
    this->fail(begin, "text is not closed", "\"", "end of file");
  }
  ++source.at;
  return token;
}

PovToken PovTokenizer::word(Source& source)
{
  PovToken token;
  token.kind = PovToken::Kind::Word;
  if (source.ahead() == '#')
  {
    token.kind = PovToken::Kind::Directive;
    source.at = std::min(source.text.find_first_not_of(" \t", source.at + 1), source.text.size());
  }
  for (; isLetter(source.ahead()) || isDigit(source.ahead()); ++source.at)
  {
    token.text += source.ahead();
  }
  if (token.text.size() > longestWord)
  {
    this->fail(source.place, "name is too long", "at most " + std::to_string(longestWord) + " characters");
  }
  return token;
}

PovToken PovTokenizer::next()
{
  while (!this->skipSpace(*this->Stack.back()) && this->Stack.size() > 1)
  {
    this->Stack.pop_back();
  }
  Source& source = *this->Stack.back();
  const PovPlace place = source.place;
  const char c = source.ahead();
  PovToken token;
  if (isDigit(c) || (c == '.' && isDigit(source.ahead(1))))
  {
    token = this->number(source);
  }
  else if (c == '"')
  {
    token = this->string(source);
  }
  else if (isLetter(c) || c == '#')
  {
    token = this->word(source);
  }
  else if (source.at < source.text.size())
  {
    token.kind = PovToken::Kind::Symbol;
    token.text = c;
    ++source.at;
  }
  token.place = place;
  return token;
}

} // namespace dgtk
