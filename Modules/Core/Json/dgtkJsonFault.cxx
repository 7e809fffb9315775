// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkJsonFault.h"

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

namespace dgtk
{

namespace
{
/// Words that nlohmann's message begins with, and what we say for them.
struct Words
{
  std::string theirs;
  std::string ours;
};
using Table = std::vector<Words>;

/// What stood where something else was expected.
const Table& foundNames()
{
  static const Table names{ { "end of input", "the end of the file" }, { "number literal", "a number" },
    { "string literal", "a text" }, { "true literal", "true" }, { "false literal", "false" },
    { "null literal", "null" } };
  return names;
}

/// Where an object or a list may end, it may go on.
const Table& expectedNames()
{
  static const Table names{ { "'[', '{', or a literal", "a value" }, { "end of input", "the end of the file" },
    { "string literal", "a key in quotes" }, { "']'", "',' or ']'" }, { "'}'", "',' or '}'" } };
  return names;
}

/// What a token that cannot be read lacks; none where any other token would do.
const Table& lexicalNames()
{
  static const Table names{ { "invalid string: missing", "a quote at the text's end" },
    { "invalid string: control", "an escape for a control character" }, { "invalid string: ill-formed", "UTF-8" },
    { "invalid string", R"(an escape that JSON has: \" \\ \/ \b \f \n \r \t or \u and four hexadecimal digits)" },
    { "invalid number", "a digit" }, { "invalid comment", "a comment as // to the line's end or as /* to */" },
    { "invalid BOM", "UTF-8" } };
  return names;
}

std::string named(const Table& names, const std::string& theirs, const std::string& otherwise)
{
  for (const Words& words : names)
  {
    if (theirs.compare(0, words.theirs.size(), words.theirs) == 0)
    {
      return words.ours;
    }
  }
  return otherwise;
}

bool begins(const std::string& text, const std::string& start) { return text.compare(0, start.size(), start) == 0; }

/// What follows the last mark, and is removed from the text with it; "" without one.
std::string cut(std::string& text, const std::string& mark)
{
  const std::size_t at = text.rfind(mark);
  std::string after = at == std::string::npos ? "" : text.substr(at + mark.size());
  text.erase(std::min(at, text.size()));
  return after;
}

/// Of "unexpected <token>; expected <token>", or "<reason>; last read: '<text>'; expected <token>".
InputError syntaxFault(const std::string& file, long line, std::string said)
{
  std::string read = cut(said, "; last read: '");
  const std::string token = cut(read.empty() ? said : read, "; expected ");
  std::string expected = named(expectedNames(), token, token.empty() ? "a value" : token);
  std::string found;
  const std::string unexpected = "unexpected ";
  if (begins(said, unexpected))
  {
    said.erase(0, unexpected.size());
    found = named(foundNames(), said, said);
  }
  else
  {
    expected = named(lexicalNames(), said, expected);
    read.erase(read.empty() ? 0 : read.size() - 1);
    // What is no token is read with all since the last text or number; a line's end is written <U+000A>.
    const bool literal = said == "invalid literal" && read.size() > 1;
    found = quoted(read.substr(literal ? read.find_last_of(" ,:[{>", read.size() - 2) + 1 : 0));
  }
  return { file, line, "is not valid JSON", expected, found };
}
} // namespace

InputError jsonFault(const std::string& file, long line, const std::string& message)
{
  const std::size_t tag = message.front() == '[' ? message.find("] ") : std::string::npos;
  std::string said = tag == std::string::npos ? message : message.substr(tag + 2);
  const std::string place = "parse error at line ";
  if (begins(said, place))
  {
    line = line > 0 ? line : std::atol(said.c_str() + place.size());
    said.erase(0, said.find(": ") + 2);
  }
  const std::string overflow = "number overflow parsing '";
  if (begins(said, overflow))
  {
    const std::string number = said.substr(overflow.size(), said.size() - overflow.size() - 1);
    return { file, line, "number cannot be used", "a number within the range of double precision", quoted(number) };
  }
  const std::string wrong = "type must be ";
  const std::string dash = " - ";
  if (begins(said, "syntax error") && said.find(dash) != std::string::npos)
  {
    return syntaxFault(file, line, said.substr(said.find(dash) + dash.size()));
  }
  if (begins(said, wrong))
  {
    const std::string found = cut(said, ", but is ");
    return { file, line, "a value has the wrong type", "the type " + said.substr(wrong.size()), found };
  }
  return { file, line, "cannot be used: " + said };
}

} // namespace dgtk
