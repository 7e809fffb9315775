// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkObjStatements_h
#define dgtkObjStatements_h

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace dgtk
{

/// Walks through the statements of a Wavefront text (.obj, .mtl), one a line; a backslash at its end continues it. The
/// text must outlive it.
class ObjStatements
{
public:
  /// `path`: for messages.
  ObjStatements(const std::string& path, std::string_view text)
    : Path(path)
    , Text(text)
  {
  }

  /// Goes to the next statement; false at the end. Comments and empty lines are none.
  bool next();
  /// Its first word.
  std::string_view keyword() const { return this->Keyword; }
  /// What is left of it, without blanks at both ends.
  std::string_view rest();
  /// The next word of it; empty at its end.
  std::string_view word();

  /// The next number of it, if there is a word left before a comment. Throws InputError when that is no number.
  bool number(double& value);
  /// As many numbers as there are, at most `most`; what follows them does not count. Returns how many.
  std::size_t numbers(double* to, std::size_t most);
  /// The next corner of it: `vertex`, `vertex/texture`, `vertex//normal` or `vertex/texture/normal`; 0 for what is not
  /// named. False when no word is left. Throws InputError when it is none.
  bool corner(std::array<long long, 3>& indices);

  long line() const { return this->First; }

private:
  std::string_view logicalLine();
  void skipBlanks();
  bool hasMore();
  [[noreturn]] void refuseWord(const char* what, const char* expected);

  const std::string& Path;
  std::string_view Text;
  std::string Joined; ///< of lines that continue each other
  std::string_view Keyword;
  const char* At = nullptr;
  const char* End = nullptr;
  std::size_t Next = 0;
  long Line = 0;
  long First = 0;
};

} // namespace dgtk

#endif
