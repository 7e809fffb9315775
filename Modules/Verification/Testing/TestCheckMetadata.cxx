// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkHandMade.h"

#include <gtest/gtest.h>

#include <string>

namespace
{
using namespace dgtk;

/// What is said of an object that never moves, beside one that does between the first and the last of so many frames.
Residual flagsOf(int frames, bool isStatic)
{
  const std::string moves =
    R"(, "position": {"keys": [[0, [0, 0, 0]], [)" + std::to_string(frames - 1) + ", [1, 0, 0]]]}";
  test::HandMade made({ test::wallModel(2), test::wallModel(3) }, { "", moves });
  made.object(0).isStatic = isStatic;
  made.object(0).geometry = std::string(64, 'a');
  made.object(1).geometry = std::string(64, 'b');
  return made.verify("metadata", "flags");
}

TEST(CheckMetadata, EveryFrameIsLookedAtUpToAThousand)
{
  for (const int frames : { 20, 1000 })
  {
    EXPECT_EQ(flagsOf(frames, true).bad, 0u) << frames;
    const Residual found = flagsOf(frames, false);
    EXPECT_EQ(found.bad, 1u) << frames;
    EXPECT_EQ(found.skipped, 0u) << frames;
    EXPECT_EQ(found.worst.value, "object 1 static false") << frames;
  }
  // It may move at a frame between.
  const Residual found = flagsOf(1001, false);
  EXPECT_EQ(found.bad, 0u);
  EXPECT_EQ(found.skipped, 1u);
}
} // namespace
