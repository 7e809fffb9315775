// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkColladaText.h"

#include <algorithm>
#include <utility>

namespace dgtk::import
{

namespace
{
constexpr char space[] = " \t\r\n";

/// Behind what begins at `at` with `<`: a tag, or a comment, a section or an instruction as a whole.
std::size_t endOfMarkup(const std::string& xml, std::size_t at)
{
  for (const auto& [begin, end] : { std::pair{ "<!--", "-->" }, { "<![CDATA[", "]]>" }, { "<?", "?>" } })
  {
    if (xml.compare(at, std::char_traits<char>::length(begin), begin) == 0)
    {
      const std::size_t found = xml.find(end, at);
      return found == std::string::npos ? xml.size() : found + std::char_traits<char>::length(end);
    }
  }
  char quote = 0; // of the attribute that is open
  for (; at < xml.size(); ++at)
  {
    const char c = xml[at];
    if (c == '>' && quote == 0)
    {
      return at + 1;
    }
    const bool isQuote = c == '"' || c == '\'';
    quote = isQuote && quote == 0 ? c : c == quote ? char(0) : quote;
  }
  return at;
}

/// Whether a tag of such an element begins at `at`.
bool isTagOf(const std::string& name, const std::string& xml, std::size_t at)
{
  at += xml.compare(at, 2, "</") == 0 ? 2 : 1;
  return at < xml.size() && xml.compare(at, name.size(), name) == 0 &&
         xml.find_first_of(" \t\r\n/>", at + name.size()) == at + name.size();
}
} // namespace

std::string colladaText(const std::string& xml)
{
  std::string text;
  text.reserve(xml.size());
  for (std::size_t at = 0; at < xml.size();)
  {
    const std::size_t markup = std::min(xml.find('<', at), xml.size());
    const std::size_t first = std::min(xml.find_first_not_of(space, at), markup);
    const std::size_t last = first < markup ? xml.find_last_not_of(space, markup - 1) + 1 : first;
    text.append(xml, first, last - first);
    at = endOfMarkup(xml, markup);
    if (!isTagOf("unit", xml, markup))
    {
      text.append(xml, markup, at - markup);
    }
  }
  return text;
}

} // namespace dgtk::import
