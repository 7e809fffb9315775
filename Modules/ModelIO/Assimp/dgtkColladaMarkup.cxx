// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkColladaMarkup.h"

#include <string_view>
#include <utility>

namespace dgtk::import
{

namespace
{
constexpr char afterName[] = " \t\r\n/>";

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
  const bool isType = xml.compare(at, 9, "<!DOCTYPE") == 0; // which may have markup in brackets
  int open = 0;
  char quote = 0; // of the attribute that is open
  for (; at < xml.size(); ++at)
  {
    const char c = xml[at];
    if (isType && quote == 0 && xml.compare(at, 4, "<!--") == 0)
    {
      at = std::min(xml.find("-->", at), xml.size() - 1);
      continue;
    }
    open += isType && quote == 0 ? int(c == '[') - int(c == ']') : 0;
    if (c == '>' && quote == 0 && open <= 0)
    {
      return at + 1;
    }
    const bool isQuote = c == '"' || c == '\'';
    quote = isQuote && quote == 0 ? c : c == quote ? char(0) : quote;
  }
  return at;
}
} // namespace

Markup::Markup(const std::string& xml, std::size_t begin)
  : Xml(xml)
  , Begin(begin)
  , End(endOfMarkup(xml, begin))
{
}

bool Markup::isOf(const std::string& element) const
{
  const std::size_t at = this->Begin + (this->isEnd() ? 2 : 1);
  return at < this->Xml.size() && this->Xml.compare(at, element.size(), element) == 0 &&
         this->Xml.find_first_of(afterName, at + element.size()) == at + element.size();
}

std::pair<std::size_t, std::size_t> Markup::find(const std::string& name) const
{
  constexpr std::size_t none = std::string::npos;
  const std::string_view tag = std::string_view(this->Xml).substr(this->Begin, this->End - this->Begin);
  const auto behind = [tag](std::size_t at) { return tag.find_first_not_of(" \t\r\n", at); };
  for (std::size_t at = behind(tag.find_first_of(afterName)); at != none;)
  {
    const std::size_t equals = tag.find('=', at);
    const std::size_t quote = equals == none ? none : behind(equals + 1);
    const std::size_t close = quote == none ? none : tag.find(tag[quote], quote + 1);
    if (close == none)
    {
      break;
    }
    if (tag.compare(at, name.size(), name) == 0 && behind(at + name.size()) == equals)
    {
      return { quote + 1, close };
    }
    at = behind(close + 1);
  }
  return { none, none };
}

std::string Markup::attribute(const std::string& name) const
{
  const auto [begin, end] = this->find(name);
  return begin == std::string::npos ? std::string() : this->Xml.substr(this->Begin + begin, end - begin);
}

std::string Markup::with(const std::string& element, const std::string& name, const std::string& value) const
{
  const auto [begin, end] = this->find(name);
  if (begin == std::string::npos)
  {
    return this->text().insert(1 + element.size(), ' ' + name + "=\"" + value + '"');
  }
  return this->text().replace(begin, end - begin, value);
}

} // namespace dgtk::import
