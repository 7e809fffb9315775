// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSparseText.h"

#include "dgtkError.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace dgtk;

SparseSet exampleSet()
{
  SparseSet set;
  set.from = { "left @ door", 3, 640, 480 };
  set.to = { "right", 4, 320, 240 };
  SparseMatch seen;
  seen.from = { 0.1, 20.5 };
  seen.to.pixel = { 1.0 / 3, 7 };
  seen.to.visibility = VisibilityClass::OccludedByOwn;
  seen.hit.object = 12;
  SparseMatch nothing;
  nothing.from = { 640, 480 };
  set.matches = { seen, nothing };
  return set;
}

TEST(SparseText, IsReadBackAsItWas)
{
  SparseSet other = exampleSet();
  std::swap(other.from, other.to);
  const std::vector<SparseSet> read = parseSparseText(sparseText(exampleSet()) + sparseText(other), "list.txt");
  ASSERT_EQ(read.size(), 2u);
  for (const SparseSet& set : read)
  {
    ASSERT_EQ(set.matches.size(), 2u);
    EXPECT_EQ(set.matches[0].from, exampleSet().matches[0].from);
    EXPECT_EQ(set.matches[0].to.pixel, exampleSet().matches[0].to.pixel);
    EXPECT_EQ(set.matches[0].to.visibility, VisibilityClass::OccludedByOwn);
    EXPECT_EQ(set.matches[0].hit.object, 12u);
    EXPECT_TRUE(std::isnan(set.matches[1].to.pixel.x()));
    EXPECT_EQ(set.matches[1].to.visibility, VisibilityClass::NoSurface);
  }
  EXPECT_TRUE(read[0].from == exampleSet().from);
  EXPECT_TRUE(read[0].to == exampleSet().to);
  EXPECT_TRUE(read[1].from == exampleSet().to);
  EXPECT_EQ(sparseText(read[0]), sparseText(exampleSet()));
  const std::vector<SparseSet> bare = parseSparseText("1 2 3 4 1 1\n# from here to there\n5 6 nan nan 0 0\r\n", "x");
  ASSERT_EQ(bare.size(), 1u);
  EXPECT_TRUE(bare[0].from.camera.empty());
  EXPECT_EQ(bare[0].matches.size(), 2u);
}

TEST(SparseText, OtherCommentsAreNoViews)
{
  const auto viewOf = [](const std::string& line) { return parseSparseText(line + "\n1 2 3 4 1 1\n", "x").at(0).from; };
  for (const char* line : { "# from @3 640x480", "# from left 640x480", "# from left@3", "# from left@-1 640x480",
         "# from left@3 0x480", "# from left@3 640x0", "# from left@3 640x480px", "# from left@3 1048577x1",
         "# from left@3 1x1048577", "# to left@3 640x480", "# left@3 640x480" })
  {
    const SparseView view = viewOf(line);
    EXPECT_TRUE(view == SparseView()) << line << ": " << view.camera << ' ' << view.frame;
  }
  EXPECT_TRUE((viewOf("# from a@0 1048576x1\r") == SparseView{ "a", 0, 1048576, 1 })) << "the largest image";
  EXPECT_TRUE((viewOf("# from a@b@12 1x1048576") == SparseView{ "a@b", 12, 1, 1048576 }));
}

TEST(SparseText, PointsAreThoseOfListsAndOfMatches)
{
  const std::vector<Eigen::Vector2d> points =
    parsePoints("# x y\n1, 2\n\n" + sparseText(exampleSet()), "x", exampleSet().from);
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points[0], Eigen::Vector2d(1, 2));
  EXPECT_EQ(points[1], exampleSet().matches[0].from);
}

TEST(SparseText, RefusalsNameFileAndLine)
{
  const auto message = [](const std::string& text)
  {
    try
    {
      parseSparseText(text, "list.txt");
    }
    catch (const InputError& error)
    {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  for (const char* bad : { "1 2 3 4 6 1", "1 2 3 4 1.5 1", "1 2 3 4 -1 1", "1 2 3 4 1 -1", "1 2 3 4 1 1e12",
         "nan 2 3 4 1 1", "1 2 3 4 1", "1 2 3 4 1 1 1", "1 2 3 4 x 1", "1 2 inf 4 1 1" })
  {
    EXPECT_NE(message(std::string("# a list\n") + bad).find("list.txt:2"), std::string::npos) << bad;
  }
  EXPECT_EQ(message("1 2 3 4 5 0"), "accepted");
  EXPECT_THROW(parsePoints("1 2 3", "x", exampleSet().from), InputError);
  EXPECT_THROW(parsePoints("nan 2", "x", exampleSet().from), InputError);
}

TEST(SparseText, APointBesideTheImageIsRefusedAsItIsWritten)
{
  for (const char* point : { "640.0000001 3", "-1e-07 3", "3 480.0000001", "3 -1e-07" })
  {
    try
    {
      parsePoints(std::string("0 0\n640 480\n") + point, "list.txt", exampleSet().from);
      ADD_FAILURE() << point;
    }
    catch (const InputError& error)
    {
      std::string expected = std::string("list.txt:3: point (") + point;
      expected.replace(expected.rfind(' '), 1, ", ");
      EXPECT_EQ(
        error.what(), expected + ") is outside the image of camera 'left @ door' (expected 0 to 640, 0 to 480)");
    }
  }
}

TEST(SparseText, AByteOrderMarkIsSkipped)
{
  const std::string mark = "\xef\xbb\xbf";
  EXPECT_EQ(parsePoints(mark + "1 2", "x", exampleSet().from).at(0), Eigen::Vector2d(1, 2));
  const std::vector<SparseSet> sets = parseSparseText(mark + sparseText(exampleSet()), "x");
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_TRUE(sets[0].from == exampleSet().from);
}
} // namespace
