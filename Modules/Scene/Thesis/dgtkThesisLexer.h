// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkThesisLexer_h
#define dgtkThesisLexer_h

#include "dgtkSceneRules.h"

#include <string>
#include <string_view>

namespace dgtk::scenefile
{

/// Words of a .scene file. Blanks, line ends and commas separate; brackets stand for themselves.
class ThesisLexer
{
public:
  ThesisLexer(const std::string& file, std::string_view text);

  long line(); ///< of the next word
  bool atEnd();
  /// Whether the next word is this one; it is not taken.
  bool next(std::string_view word);
  /// Takes the next word if it is this one.
  bool take(std::string_view word);
  /// Takes the next word. `what` names it in errors, here and below: "camera 3".
  std::string_view word();
  void expect(std::string_view word, const std::string& what);
  double number(const Range& range, const std::string& what);
  /// A whole number >= 0.
  long count(const std::string& what);
  Eigen::Vector3d vector(const Range& range, const std::string& what);
  /// The rest of the line up to `stop`, without blanks around it.
  std::string restOfLine(char stop = '\n');
  /// Throws InputError at the next word.
  [[noreturn]] void fail(const std::string& what, const std::string& expected);

private:
  void skipSeparators();
  std::string_view peek();

  const std::string* File;
  std::string_view Text;
  std::size_t At = 0;
  long Line = 1;
};

} // namespace dgtk::scenefile

#endif
