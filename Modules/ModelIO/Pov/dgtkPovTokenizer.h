// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkPovTokenizer_h
#define dgtkPovTokenizer_h

#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace dgtk
{

/// Where something stands: a file of PovTokenizer::path() and a line.
struct PovPlace
{
  std::size_t file = 0;
  long line = 0;
};

struct PovToken
{
  enum class Kind : std::uint8_t
  {
    End,
    Word,      ///< identifier or keyword
    Directive, ///< word after '#'
    Number,
    String,
    Symbol ///< one character
  };
  Kind kind = Kind::End;
  std::string text;
  double number = 0;
  PovPlace place;

  bool is(char symbol) const { return this->kind == Kind::Symbol && this->text[0] == symbol; }
  bool is(const char* word) const { return this->kind == Kind::Word && this->text == word; }
  bool isOneOf(const std::set<std::string>& words) const
  {
    return this->kind == Kind::Word && words.count(this->text) > 0;
  }
};

/// Splits a scene file and what it includes into tokens. Comments nest, as POV-Ray's do.
class PovTokenizer
{
public:
  explicit PovTokenizer(const std::string& path);

  /// Goes on with the file; it is read when its turn comes, and after its end the including file continues. Throws
  /// InputError: recursion deeper than 20, more than 10,000 inclusions or 1 GiB, unreadable.
  void include(const std::string& path, const PovPlace& from);
  PovToken next();

  const std::string& path(std::size_t file) const { return this->Paths[file]; }
  const std::vector<std::string>& paths() const { return this->Paths; }
  std::uint64_t bytesRead() const { return this->Bytes; }
  [[noreturn]] void fail(const PovPlace& place, const std::string& what, const std::string& expected = {},
    const std::string& found = {}) const;

private:
  struct Source
  {
    std::string text;
    std::size_t at = 0;
    PovPlace place;

    /// The character that comes, or one of those behind it; 0 behind the end.
    char ahead(std::size_t more = 0) const
    {
      return this->at + more < this->text.size() ? this->text[this->at + more] : '\0';
    }
    bool begins(const char* two) const { return this->ahead() == two[0] && this->ahead(1) == two[1]; }
  };
  void open(const std::string& path);
  bool skipSpace(Source& source);
  void skipComment(Source& source);
  PovToken number(Source& source);
  PovToken string(Source& source);
  PovToken word(Source& source);

  std::vector<std::string> Paths;
  std::vector<std::unique_ptr<Source>> Stack;
  std::uint64_t Bytes = 0;
  std::size_t Inclusions = 0;
};

} // namespace dgtk

#endif
