// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAc3dLines.h"

#include "dgtkError.h"

#include <algorithm>
#include <iterator>

namespace dgtk
{

namespace
{
const char* const keywords[] = { "MATERIAL", "MAT", "ENDMAT", "OBJECT", "kids", "name", "data", "texture", "texrep",
  "texoff", "loc", "rot", "url", "crease", "subdiv", "numvert", "numsurf", "SURF", "mat", "refs", "hidden", "locked",
  "folded" };

/// What a version control system leaves in a file that was merged badly.
bool isConflictMarker(std::string_view word)
{
  return word.substr(0, 7) == "<<<<<<<" || word.substr(0, 7) == "=======" || word.substr(0, 7) == ">>>>>>>";
}
} // namespace

bool Ac3dLines::isKeyword(std::string_view word)
{
  return std::find(std::begin(keywords), std::end(keywords), word) != std::end(keywords);
}

void Ac3dLines::fail(const std::string& what, const std::string& expected, const std::string& found) const
{
  throw InputError(this->Path, this->lineNumber(), what, expected, found);
}

double Ac3dLines::number(const Words& words, std::size_t index, const char* what) const
{
  if (index >= words.size())
  {
    this->fail(std::string("incomplete ") + what, "a number", "the end of the line");
  }
  const std::optional<double> value = parseNumber(words[index]);
  if (!value)
  {
    this->fail(std::string("bad ") + what, "a number", quoted(std::string(words[index])));
  }
  return *value;
}

Eigen::Vector3d Ac3dLines::vector(const Words& words, std::size_t index, const char* what) const
{
  return { this->number(words, index, what), this->number(words, index + 1, what),
    this->number(words, index + 2, what) };
}

long long Ac3dLines::count(const Words& words, const char* what) const
{
  const std::optional<long long> value = words.size() > 1 ? parseInteger(words[1]) : std::nullopt;
  if (!value || *value < 0)
  {
    this->fail(std::string("bad number of ") + what, "a whole number from 0",
      words.size() > 1 ? quoted(std::string(words[1])) : "the end of the line");
  }
  return *value;
}

bool Ac3dLines::nextEntry(const char* what, long long done, long long expected)
{
  while (this->next())
  {
    const Words& entry = this->words();
    if (entry.empty() || isConflictMarker(entry[0]))
    {
      continue;
    }
    if (isKeyword(entry[0]))
    {
      this->again();
      ++this->ShortLists;
      return false;
    }
    return true;
  }
  this->fail(std::string("ends within the ") + what + " of an object", std::to_string(expected), std::to_string(done));
}

} // namespace dgtk
