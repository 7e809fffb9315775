// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkOption.h"

#include "dgtkError.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

using namespace dgtk;

TEST(Option, NamesMayHoldCommasAndBackslashes)
{
  const std::vector<std::string> names{ "a,b", R"(c\)", R"(d\e)" };
  EXPECT_EQ(splitNames(R"(a\,b,c\\,d\e)", "names"), names);
  EXPECT_EQ(splitNames(joinedNames(names), "names"), names);
}

TEST(Option, RefusedNumbersNameTheirBounds)
{
  const auto refusal = [](double above, const std::string& text)
  {
    try
    {
      return NumbersOption("unit_metres", "X", 1, above, "").normal(text);
    }
    catch (const UsageError& error)
    {
      return std::string(error.what());
    }
  };
  for (const char* const wrong : { "0", "1e30", "1e300", "1e999" })
  {
    EXPECT_EQ(
      refusal(0, wrong), "unit_metres: expected X, all above 0 and below 1e30, found '" + std::string(wrong) + "'");
  }
  EXPECT_EQ(refusal(-1e30, "1e30"), "unit_metres: expected X, all below 1e30, found '1e30'");
  EXPECT_EQ(refusal(0, "9e29"), "9e+29");
}
