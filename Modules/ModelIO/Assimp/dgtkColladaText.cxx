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
/// Names pictures of which the file says nothing, as it may: Assimp 5.2 refuses it for them.
class PictureNames
{
public:
  /// What to write before the markup [begin, end) of the file.
  std::string before(const std::string& xml, std::size_t begin, std::size_t end)
  {
    const bool isImage = isTagOf("image", xml, begin);
    if (isImage && xml[begin + 1] != '/')
    {
      const std::string tag = xml.substr(begin, end - begin);
      const std::size_t id = tag.find(" id=");
      const std::size_t name = std::min(id, tag.size() - 5) + 5;
      this->Name = id == std::string::npos ? "?" : tag.substr(name, tag.find(tag[name - 1], name) - name);
      this->IsMissing = true;
      return {};
    }
    this->IsMissing = this->IsMissing && !isTagOf("init_from", xml, begin) && !isTagOf("data", xml, begin);
    return isImage && std::exchange(this->IsMissing, false) ? "<init_from>" + this->Name + "</init_from>" : "";
  }

private:
  bool IsMissing = false;
  std::string Name;
};
} // namespace

std::string colladaText(const std::string& xml)
{
  std::string text;
  text.reserve(xml.size());
  PictureNames pictures;
  for (std::size_t at = 0; at < xml.size();)
  {
    const std::size_t markup = std::min(xml.find('<', at), xml.size());
    const std::size_t first = std::min(xml.find_first_not_of(space, at), markup);
    const std::size_t last = first < markup ? xml.find_last_not_of(space, markup - 1) + 1 : first;
    text.append(xml, first, last - first);
    at = endOfMarkup(xml, markup);
    text += pictures.before(xml, markup, at);
    if (!isTagOf("unit", xml, markup))
    {
      text.append(xml, markup, at - markup);
    }
  }
  return text;
}

} // namespace dgtk::import
