// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSceneSamples.h"

#include <gtest/gtest.h>

#include <charconv>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <string>
#include <system_error>

using namespace dgtk;
using namespace dgtk::test;

namespace
{
bool hasComma = false;
}

// In place of the system's, whose locales with a decimal comma need not be installed.

extern "C" double strtod(const char* text, char** end) noexcept
{
  std::string plain(text);
  const std::size_t at = plain.find(hasComma ? ',' : '.');
  if (at != std::string::npos)
  {
    plain[at] = '.';
  }
  double value = 0;
  const std::from_chars_result parsed = std::from_chars(plain.data(), plain.data() + plain.size(), value);
  if (parsed.ec == std::errc::result_out_of_range && plain.find_first_of("eE") != plain.find("e-"))
  {
    value = plain[0] == '-' ? -HUGE_VAL : HUGE_VAL;
  }
  if (end)
  {
    *end = const_cast<char*>(text) + (parsed.ptr - plain.data());
  }
  return value;
}

extern "C" lconv* localeconv() noexcept
{
  static char point[] = ".";
  static char comma[] = ",";
  static char none[] = "";
  static lconv made = {};
  made.decimal_point = hasComma ? comma : point;
  made.thousands_sep = made.grouping = none;
  return &made;
}

// The JSON library hands numbers over as the locale writes them.
TEST(SceneLocale, NumbersHaveAPointInEveryLocale)
{
  const TemporaryFolder folder;
  for (const bool comma : { false, true })
  {
    hasComma = comma;
    EXPECT_EQ(readText(folder, "a.json", R"({"fps": 12.5, "background": [0.25, 5e-1, 1]})").fps, 12.5) << comma;
    EXPECT_NE(refusalOf("a.json", R"({"fps": 12,5})"), "") << comma;
  }
  hasComma = false;
}
