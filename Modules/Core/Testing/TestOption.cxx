// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkOption.h"

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
