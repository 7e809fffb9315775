// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTextLines_h
#define dgtkTextLines_h

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace dgtk
{

/// Text in UTF-8 without byte order mark, from UTF-8 or UTF-16 of either byte order.
std::string toUtf8(std::string bytes);

/// A short text as it is when it is valid UTF-8, otherwise taken as Latin-1.
std::string validUtf8(const std::string& text);

/// The number that a whole token spells, in any locale; not-a-number and infinities as C libraries print them ("nan",
/// "-nan(ind)", "1.#QNAN", "inf") and numbers beyond a double are returned as NaN or infinity. Nothing for other text.
std::optional<double> parseNumber(std::string_view token);

/// A whole number, decimal or with 0x. Nothing for other text or beyond 64 bits.
std::optional<long long> parseInteger(std::string_view token);

/// Walks through the lines of a text; lines end with LF, CR LF or CR. The text must outlive it.
class TextLines
{
public:
  explicit TextLines(const std::string& text)
    : Text(text)
  {
  }
  /// Goes to the next line; false at the end of the text.
  bool next();
  /// Makes next() deliver the current line again.
  void again() { this->Again = true; }

  std::string_view line() const { return this->Line; }
  long lineNumber() const { return this->Number; } ///< of the current line, from 1
  std::size_t remaining() const { return this->Text.size() - this->At; }

  /// Words of the current line: separated by blanks; a word in double quotes may contain blanks and loses the quotes.
  const std::vector<std::string_view>& words();

private:
  std::string_view Text;
  std::string_view Line;
  std::vector<std::string_view> Found;
  std::size_t At = 0;
  long Number = 0;
  bool Again = false;
};

} // namespace dgtk

#endif
