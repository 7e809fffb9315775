// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkColladaMarkup_h
#define dgtkColladaMarkup_h

#include <algorithm>
#include <string>
#include <utility>

namespace dgtk::import
{

/// A piece of markup of an XML text: a tag, or a comment, a section or an instruction as a whole.
class Markup
{
public:
  /// That which begins at `begin` with `<`.
  Markup(const std::string& xml, std::size_t begin);

  std::string text() const { return this->Xml.substr(this->Begin, this->End - this->Begin); }
  bool isEnd() const { return this->Xml.compare(this->Begin, 2, "</") == 0; }
  /// A tag that ends its element, too.
  bool isEmpty() const { return this->End >= 2 && this->Xml.compare(this->End - 2, 2, "/>") == 0; }
  /// A tag of such an element.
  bool isOf(const std::string& element) const;
  /// Such an element begins.
  bool begins(const std::string& element) const { return !this->isEnd() && this->isOf(element); }
  /// An attribute's value as it is written, "" when there is none.
  std::string attribute(const std::string& name) const;
  /// The tag with another value of an attribute, which it may lack; of a tag that begins such an element.
  std::string with(const std::string& element, const std::string& name, const std::string& value) const;

  const std::string& Xml;
  std::size_t Begin;
  std::size_t End; ///< behind it

private:
  /// Where in the tag the value begins and ends; npos twice when there is none.
  std::pair<std::size_t, std::size_t> find(const std::string& name) const;
};

/// Calls visit(begin and end of a text without the white space around it, the markup behind it) for all of `xml`.
template <class Visit>
void forEachMarkup(const std::string& xml, Visit visit)
{
  constexpr char space[] = " \t\r\n";
  for (std::size_t at = 0; at < xml.size();)
  {
    const std::size_t begin = std::min(xml.find('<', at), xml.size());
    const std::size_t first = std::min(xml.find_first_not_of(space, at), begin);
    const std::size_t last = first < begin ? xml.find_last_not_of(space, begin - 1) + 1 : first;
    const Markup markup(xml, begin);
    visit(first, last, markup);
    at = markup.End;
  }
}

} // namespace dgtk::import

#endif
