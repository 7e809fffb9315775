// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkAc3dLines_h
#define dgtkAc3dLines_h

#include "dgtkTextLines.h"

#include <Eigen/Core>

#include <string>
#include <string_view>
#include <vector>

namespace dgtk
{

using Words = std::vector<std::string_view>;

/// The lines of an AC3D file and the values in them; what does not fit throws an InputError with the line.
class Ac3dLines : public TextLines
{
public:
  Ac3dLines(const std::string& path, const std::string& text)
    : TextLines(text)
    , Path(path)
  {
  }
  [[noreturn]] void fail(
    const std::string& what, const std::string& expected = {}, const std::string& found = {}) const;
  double number(const Words& words, std::size_t index, const char* what) const;
  Eigen::Vector3d vector(const Words& words, std::size_t index, const char* what) const;
  /// The whole number from 0 behind the first word.
  long long count(const Words& words, const char* what) const;
  /// Goes to the next line of a list of `what`, of which `done` of `expected` are read; skips empty lines and the
  /// markers of a merge conflict. False, and the list is counted as short, when a statement begins instead.
  bool nextEntry(const char* what, long long done, long long expected);
  std::size_t shortLists() const { return this->ShortLists; }
  static bool isKeyword(std::string_view word);

private:
  const std::string& Path;
  std::size_t ShortLists = 0;
};

} // namespace dgtk

#endif
