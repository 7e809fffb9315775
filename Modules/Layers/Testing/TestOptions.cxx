// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkRequestOptions.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

using namespace dgtk;

TEST(Options, AreReadAsTheyAreWritten)
{
  std::set<std::string> names;
  for (const OptionRow* row : allOptions())
  {
    EXPECT_TRUE(names.insert(row->name).second) << row->name;
    EXPECT_EQ(row->name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string::npos) << row->name;
    EXPECT_FALSE(row->help.empty()) << row->name;
    EXPECT_EQ(row->value.empty(), row->kind == OptionRow::Kind::Switch) << row->name;
    EXPECT_EQ(&requestOption(row->name), row);
    EXPECT_TRUE(row->isDefault({})) << row->name;
    if (!row->fallback.empty())
    {
      EXPECT_EQ(row->normal(row->fallback), row->fallback) << row->name;
    }
    for (const std::string& choice : row->choices)
    {
      EXPECT_EQ(row->normal(choice), choice);
    }
    if (row->kind != OptionRow::Kind::Names || !row->choices.empty())
    {
      EXPECT_THROW(row->normal("?"), UsageError) << row->name;
      EXPECT_THROW(row->text({ { row->name, "?" } }), UsageError) << row->name;
    }
  }
  EXPECT_THROW(requestOption("sample"), UsageError);
}

TEST(Options, OfEveryKind)
{
  const IntegerOption& samples = option::samples();
  EXPECT_EQ(samples.of({}), 1);
  EXPECT_EQ(samples.of({ { "samples", "016" } }), 16);
  EXPECT_EQ(samples.normal("016"), "16");
  for (const char* const wrong : { "0", "17", "", "4 ", "4.0", "-1", "99999999999" })
  {
    EXPECT_THROW(samples.normal(wrong), UsageError) << wrong;
  }
  const SwitchOption& pack = option::pack();
  EXPECT_FALSE(pack.of({}));
  EXPECT_FALSE(pack.of({ { "pack", "off" } }));
  EXPECT_TRUE(pack.of({ { "pack", "on" } }));
  EXPECT_TRUE(pack.of({ { "pack", "" } })) << "as a switch of the command line";
  const SizeOption size("tile", 640, 480, 1000, "");
  EXPECT_EQ(size.width({}), 640);
  EXPECT_EQ(size.height({ { "tile", "7x1000" } }), 1000);
  EXPECT_EQ(size.normal("007X5"), "7x5");
  for (const char* const wrong : { "7", "7x", "x7", "0x5", "5x0", "1001x5", "5x1001", "5x5x5" })
  {
    EXPECT_THROW(size.normal(wrong), UsageError) << wrong;
  }
  const NumbersOption lens("lens", "A,B", 2, 0, "");
  EXPECT_TRUE(lens.of({}).empty());
  EXPECT_EQ(lens.of({ { "lens", "0.5,1e3" } }), (std::vector<double>{ 0.5, 1000 }));
  EXPECT_EQ(lens.normal("0.50,1000.0"), "0.5,1000");
  for (const char* const wrong : { "1", "1,2,3", "0,1", "1,-1", "1,x", "1,nan", "1,inf", "1,1e30" })
  {
    EXPECT_THROW(lens.normal(wrong), UsageError) << wrong;
  }
  const NamesOption names("names", "NAMES", "");
  EXPECT_TRUE(names.of({}).empty());
  const std::vector<std::string> odd{ "a,b", "c\\", "\\,", "d e" };
  EXPECT_EQ(names.of({ { "names", joinedNames(odd) } }), odd);
  EXPECT_EQ(names.normal(joinedNames(odd)), joinedNames(odd));
  EXPECT_EQ(names.of({ { "names", "a\\b" } }), (std::vector<std::string>{ "a\\b" })) << "a path of Windows";
  for (const char* const wrong : { ",", "a,", ",a", "a,,b" })
  {
    EXPECT_THROW(names.normal(wrong), UsageError) << wrong;
  }
}
