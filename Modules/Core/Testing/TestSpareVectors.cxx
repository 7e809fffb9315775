// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSpareVectors.h"

#include <gtest/gtest.h>

namespace
{
TEST(SpareVectors, KeepsTheSizeThatIsAskedForAndNoOther)
{
  dgtk::SpareVectors<int> spare;
  EXPECT_TRUE(spare.take(3).empty());
  spare.give({ 1, 2, 3 });
  spare.give({ 1, 2, 3, 4 });
  spare.give({});
  EXPECT_EQ(spare.take(3), (std::vector<int>{ 1, 2, 3 }));
  EXPECT_TRUE(spare.take(3).empty());
  EXPECT_TRUE(spare.take(4).empty()); // of whole bands beside their tiles, say, which would pile up
  spare.give({ 1, 2, 3, 4 });
  EXPECT_TRUE(spare.take(3).empty());
  EXPECT_TRUE(spare.take(4).empty());
}
} // namespace
