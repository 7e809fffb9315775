// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMd2Sequences.h"

#include "dgtkTextLines.h"

#include <algorithm>

namespace dgtk
{

namespace
{
constexpr double defaultRate = 10;

/// A frame's name, cut before the digits at its end.
struct FrameName
{
  std::string stem;
  std::string digits;

  explicit FrameName(const std::string& name)
  {
    const std::size_t last = name.find_last_not_of("0123456789");
    const std::size_t cut = last == std::string::npos ? 0 : last + 1;
    this->stem = name.substr(0, cut);
    this->digits = name.substr(cut);
  }
  /// Digits before the last two belong to the sequence's name.
  std::string shortPrefix() const
  {
    return this->stem + (this->digits.size() > 2 ? this->digits.substr(0, this->digits.size() - 2) : "");
  }
  std::string lastTwo() const { return this->digits.substr(this->digits.size() - 2); }
  bool startsWithZero() const { return !this->digits.empty() && this->digits[0] == '0'; }
};

bool followsBeyondHundred(const FrameName& a, const FrameName& b)
{
  return a.stem == b.stem && a.digits.size() > 2 && a.digits.size() == b.digits.size() && a.lastTwo() == "99" &&
         b.lastTwo() == "00";
}
} // namespace

std::vector<Animation> sequencesOf(const std::vector<std::string>& frameNames)
{
  std::vector<FrameName> names(frameNames.begin(), frameNames.end());
  std::vector<Animation> sequences;
  for (std::size_t begin = 0; begin < names.size();)
  {
    // frames of one stem; whether their numbers are long decides how they are cut further
    std::size_t end = begin + 1;
    bool longNumbers = names[begin].digits.size() > 2 && names[begin].startsWithZero();
    while (end < names.size() && names[end].stem == names[begin].stem)
    {
      longNumbers = longNumbers || followsBeyondHundred(names[end - 1], names[end]);
      ++end;
    }
    for (std::size_t i = begin; i < end; ++i)
    {
      const std::string prefix = longNumbers ? names[i].stem : names[i].shortPrefix();
      const std::string before =
        longNumbers ? names[i - (i > begin ? 1 : 0)].stem : names[i - (i > begin ? 1 : 0)].shortPrefix();
      if (i == begin || prefix != before)
      {
        sequences.push_back({ prefix, static_cast<int>(i), static_cast<int>(i), defaultRate });
      }
      sequences.back().last = static_cast<int>(i);
    }
    begin = end;
  }
  return sequences;
}

std::vector<Animation> parseAnm(
  const std::string& text, const std::string& path, int frames, std::vector<std::string>& warnings)
{
  std::vector<Animation> animations;
  TextLines lines(text);
  while (lines.next())
  {
    const std::vector<std::string_view>& words = lines.words();
    if (words.empty() || words[0].substr(0, 2) == "//" || words[0].substr(0, 1) == "#")
    {
      continue;
    }
    const long long first = words.size() > 2 ? parseInteger(words[1]).value_or(-1) : -1;
    const long long last = words.size() > 2 ? parseInteger(words[2]).value_or(-1) : -1;
    const bool hasRate = words.size() > 3 && words[3].substr(0, 2) != "//";
    const double rate = hasRate ? parseNumber(words[3]).value_or(-1) : defaultRate;
    if (first < 0 || last < first || first >= frames || !(rate >= 0 && rate < 1e6))
    {
      warnings.push_back(path + ":" + std::to_string(lines.lineNumber()) +
                         ": left out (expected: name, first and last of " + std::to_string(frames) +
                         " frames, frames a second)");
      continue;
    }
    animations.push_back({ std::string(words[0]), static_cast<int>(first),
      static_cast<int>(std::min<long long>(last, frames - 1)), rate });
  }
  return animations;
}

} // namespace dgtk
