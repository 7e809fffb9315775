// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFbxReaders.h"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <limits>
#include <string_view>

namespace dgtk::import
{

namespace
{
class TextReader
{
public:
  TextReader(const std::string& text, std::uint64_t budget)
    : At(text.data())
    , End(text.data() + text.size())
    , Memory(budget)
  {
  }

  FbxElement run()
  {
    FbxElement all;
    this->children(all, 0);
    if (this->At != this->End)
    {
      this->failHere("expected an element");
    }
    return all;
  }

private:
  [[noreturn]] void failHere(const char* what)
  {
    throw std::runtime_error(what + (", on line " + std::to_string(this->Line)));
  }

  /// To what is no white space and no comment.
  void skip()
  {
    for (; this->At != this->End; ++this->At)
    {
      if (*this->At == ';')
      {
        this->At = std::find(this->At, this->End, '\n');
        if (this->At == this->End)
        {
          return;
        }
      }
      if (*this->At == '\n')
      {
        ++this->Line;
      }
      else if (*this->At != ' ' && *this->At != '\t' && *this->At != '\r')
      {
        return;
      }
    }
  }
  bool follows(char c)
  {
    this->skip();
    if (this->At == this->End || *this->At != c)
    {
      return false;
    }
    ++this->At;
    return true;
  }

  static bool isOfWord(char c) { return c > ' ' && std::strchr(",:{};\"", c) == nullptr; }
  std::string_view word()
  {
    this->skip();
    const char* const begin = this->At;
    this->At = std::find_if_not(this->At, this->End, isOfWord);
    return { begin, std::size_t(this->At - begin) };
  }

  std::string quoted()
  {
    const char* const end = std::find(this->At, this->End, '"');
    if (end == this->End)
    {
      this->failHere("a text does not end");
    }
    this->Line += std::size_t(std::count(this->At, end, '\n'));
    std::string text(this->At, end);
    this->At = end + 1;
    this->Memory.take(text.size());
    constexpr std::pair<std::string_view, char> escapes[] = { { "&quot;", '"' }, { "&cr;", '\r' }, { "&lf;", '\n' } };
    std::string plain;
    for (std::size_t at = 0; at < text.size();)
    {
      const auto begins = [&](const auto& escape) { return text.compare(at, escape.first.size(), escape.first) == 0; };
      const auto found = std::find_if(std::begin(escapes), std::end(escapes), begins);
      plain += found == std::end(escapes) ? text[at] : found->second;
      at += found == std::end(escapes) ? 1 : found->first.size();
    }
    return plain;
  }

  static FbxValue asNumber(std::string_view word)
  {
    std::int64_t whole = 0;
    const auto integer = std::from_chars(word.data(), word.data() + word.size(), whole);
    if (integer.ec == std::errc() && integer.ptr == word.data() + word.size())
    {
      return whole;
    }
    double real = 0;
    const auto parsed = std::from_chars(word.data(), word.data() + word.size(), real);
    if (parsed.ptr == word.data() + word.size() && parsed.ec == std::errc())
    {
      return real;
    }
    return std::string(word); // T, Y, W: a letter
  }

  void values(FbxElement& to)
  {
    do
    {
      this->Memory.take(sizeof(FbxValue));
      if (this->follows('"'))
      {
        to.values.emplace_back(this->quoted());
      }
      else if (this->follows('*'))
      {
        to.values.push_back(this->list());
        return;
      }
      else
      {
        const std::string_view word = this->word();
        if (!word.empty())
        {
          to.values.push_back(asNumber(word));
        }
      }
    } while (this->follows(','));
  }

  /// `*count { a: 1,2,3 }`
  FbxValue list()
  {
    this->word();
    std::vector<std::int64_t> whole;
    std::vector<double> real;
    bool isWhole = true;
    if (!this->follows('{') || this->word() != "a" || !this->follows(':'))
    {
      this->failHere("expected the numbers of a list");
    }
    do
    {
      const std::string_view word = this->word();
      if (word.empty())
      {
        break;
      }
      this->Memory.take(16);
      const FbxValue value = asNumber(word);
      if (const auto* integer = std::get_if<std::int64_t>(&value); integer != nullptr && isWhole)
      {
        whole.push_back(*integer);
        continue;
      }
      if (isWhole)
      {
        real.assign(whole.begin(), whole.end());
        isWhole = false;
      }
      const auto* integer = std::get_if<std::int64_t>(&value);
      const auto* number = std::get_if<double>(&value);
      real.push_back(integer != nullptr  ? double(*integer)
                     : number != nullptr ? *number
                                         : std::numeric_limits<double>::quiet_NaN());
    } while (this->follows(','));
    if (!this->follows('}'))
    {
      this->failHere("a list of numbers does not end");
    }
    return isWhole ? FbxValue(std::move(whole)) : FbxValue(std::move(real));
  }

  void children(FbxElement& to, int depth)
  {
    if (depth > deepestFbxElement)
    {
      this->failHere("elements are nested too deeply");
    }
    for (;;)
    {
      const std::string_view name = this->word();
      if (name.empty())
      {
        return;
      }
      this->Memory.take(sizeof(FbxElement) + name.size());
      FbxElement& child = to.children.emplace_back();
      child.name = name;
      if (!this->follows(':'))
      {
        this->failHere("expected a colon");
      }
      this->valuesOfLine(child);
      if (this->follows('{'))
      {
        this->children(child, depth + 1);
        if (!this->follows('}'))
        {
          this->failHere("an element does not end");
        }
      }
    }
  }

  /// The values behind a colon, which may be none: then what follows is a brace or the next element.
  void valuesOfLine(FbxElement& to)
  {
    const char* const begin = this->At;
    const std::size_t line = this->Line;
    const std::string_view first = this->word();
    this->skip();
    const bool isNextElement = !first.empty() && this->At != this->End && *this->At == ':';
    this->At = begin;
    this->Line = line;
    if (!isNextElement)
    {
      this->values(to);
    }
  }

  const char* At;
  const char* End;
  FbxBudget Memory;
  std::size_t Line = 1;
};
} // namespace

FbxElement readFbxText(const std::string& text, std::uint64_t budget) { return TextReader(text, budget).run(); }

} // namespace dgtk::import
