// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkModelReader.h"
#include "dgtkModelSeeds.h"
#include "dgtkTestSupport.h"
#include "dgtkTextLines.h"
#include "dgtkTriangulate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <set>

using dgtk::InputError;
using dgtk::readModel;
using testing::HasSubstr;

namespace
{
std::string message(const std::string& path)
{
  return dgtk::test::thrownBy<InputError>([&] { readModel(path); });
}
} // namespace

TEST(ModelReader, RowsAreUniqueAndComplete)
{
  std::set<std::string> extensions;
  for (const dgtk::ReaderInfo& info : dgtk::modelReaders())
  {
    EXPECT_FALSE(info.name.empty());
    EXPECT_FALSE(info.format.empty());
    EXPECT_FALSE(info.description.empty());
    for (const std::string& extension : info.extensions)
    {
      EXPECT_TRUE(extensions.insert(extension).second) << extension;
    }
  }
  for (const char* own : { "ac", "acc", "md2", "3ds" })
  {
    EXPECT_EQ(extensions.count(own), 1u) << own;
  }
}

TEST(ModelReader, ExtensionsInAnyCase)
{
  const dgtk::test::TemporaryFolder folder;
  for (const char* name : { "a.ac", "a.AC", "a.acc", "a.b.Acc" })
  {
    dgtk::writeFile(folder.path(name), dgtk::test::ac3dSeed());
    EXPECT_EQ(readModel(folder.path(name))->format, "ac3d") << name;
    EXPECT_EQ(readModel(folder.path(name))->path, folder.path(name));
  }
}

TEST(ModelReader, Refusals)
{
  EXPECT_THAT(
    message("/x/tree.lwo"), HasSubstr("/x/tree.lwo: is not a model file that can be read (expected one of .ac .acc"));
  EXPECT_THAT(message("/x/tree.lwo"), HasSubstr("found '.lwo')"));
  EXPECT_THAT(message("/x.ac/tree"), HasSubstr("found no extension)"));
  for (const dgtk::ReaderInfo& info : dgtk::modelReaders())
  {
    const dgtk::test::TemporaryFolder folder;
    const std::string missing = folder.path("missing." + info.extensions[0]);
    EXPECT_THAT(message(missing), HasSubstr(missing)) << info.name;
    const std::string directory = folder.path("folder." + info.extensions[0]);
    dgtk::makeFolders(directory);
    EXPECT_THAT(message(directory), HasSubstr(directory)) << info.name;
    const std::string empty = folder.path("empty." + info.extensions[0]);
    dgtk::writeFile(empty, "");
    EXPECT_EQ(message(empty), empty + ": is empty (expected a model, found 0 bytes)") << info.name;
  }
}

TEST(TextLines, Numbers)
{
  EXPECT_EQ(dgtk::parseNumber("1.5"), 1.5);
  EXPECT_EQ(dgtk::parseNumber("+2e-3"), 2e-3);
  EXPECT_EQ(dgtk::parseNumber("1e-999"), 0.0);
  EXPECT_EQ(dgtk::parseNumber("-1e999"), -HUGE_VAL);
  EXPECT_TRUE(std::isnan(*dgtk::parseNumber("-nan(ind)")));
  EXPECT_TRUE(std::isnan(*dgtk::parseNumber("1.#QNAN0")));
  for (const char* bad : { "", "x", "1,5", "1.5f", "--1", "+" })
  {
    EXPECT_FALSE(dgtk::parseNumber(bad)) << bad;
  }
  EXPECT_EQ(dgtk::parseInteger("0x21"), 33);
  EXPECT_EQ(dgtk::parseInteger("-7"), -7);
  for (const char* bad : { "", "0x", "1.0", "99999999999999999999" })
  {
    EXPECT_FALSE(dgtk::parseInteger(bad)) << bad;
  }
}

TEST(TextLines, TextsBecomeValidUtf8)
{
  for (const char* valid : { "", "plain", "caf\xc3\xa9", "\xe4\xb8\xad", "\xf0\x9f\x8c\xb3" })
  {
    EXPECT_EQ(dgtk::validUtf8(valid), valid);
  }
  EXPECT_EQ(dgtk::validUtf8("caf\xe9"), "caf\xc3\xa9");
  EXPECT_EQ(dgtk::validUtf8("\xc0\xaf"), "\xc3\x80\xc2\xaf");             // overlong
  EXPECT_EQ(dgtk::validUtf8("\xed\xa0\x80"), "\xc3\xad\xc2\xa0\xc2\x80"); // a surrogate
  EXPECT_EQ(dgtk::validUtf8("\xe4\xb8"), "\xc3\xa4\xc2\xb8");             // cut short
}

TEST(TextLines, TextsOfTwoByteCharacters)
{
  // a, Ae, euro, and a face beyond 16 bits
  const std::string expected = "a\xc3\x84\xe2\x82\xac\xf0\x9f\x98\x80";
  const std::string little("a\0\xc4\0\xac\x20\x3d\xd8\x00\xde", 10);
  std::string big = little;
  for (std::size_t i = 0; i < big.size(); i += 2)
  {
    std::swap(big[i], big[i + 1]);
  }
  EXPECT_EQ(dgtk::toUtf8("\xff\xfe" + little), expected);
  EXPECT_EQ(dgtk::toUtf8("\xfe\xff" + big), expected);
  EXPECT_EQ(dgtk::toUtf8(little), expected) << "without a mark";
  EXPECT_EQ(dgtk::toUtf8(big), expected);
  EXPECT_EQ(dgtk::toUtf8("\xef\xbb\xbf" + expected), expected);
  EXPECT_EQ(dgtk::toUtf8(expected), expected);
  EXPECT_EQ(dgtk::toUtf8(little.substr(0, 9)), expected.substr(0, 6) + "\xed\xa0\xbd") << "cut within the last one";
}

TEST(TextLines, WordsAndLines)
{
  const std::string text = "a  \"b c\"\td\r\n\r\n\"open\rlast";
  dgtk::TextLines lines(text);
  ASSERT_TRUE(lines.next());
  EXPECT_THAT(lines.words(), testing::ElementsAre("a", "b c", "d"));
  ASSERT_TRUE(lines.next());
  EXPECT_TRUE(lines.words().empty());
  ASSERT_TRUE(lines.next());
  EXPECT_THAT(lines.words(), testing::ElementsAre("open"));
  EXPECT_EQ(lines.lineNumber(), 3);
  lines.again();
  ASSERT_TRUE(lines.next());
  EXPECT_EQ(lines.lineNumber(), 3);
  ASSERT_TRUE(lines.next());
  EXPECT_EQ(lines.line(), "last");
  EXPECT_FALSE(lines.next());
}

/// Triangles of one direction whose areas add up to the polygon's tile it.
TEST(Triangulate, ConcavePolygonsAreTiledFromEveryCornerOnEverySide)
{
  const std::vector<std::vector<Eigen::Vector2d>> polygons{
    { { 0, 0 }, { 2, 0 }, { 3, 2 }, { 0, 1 } },                                                   // convex
    { { 0, 0 }, { 2, 0 }, { 2, 0 }, { 3, 2 }, { 0, 1 }, { 0, 1 } },                               // convex, twice there
    { { 0, 0 }, { 4, 0 }, { 1, 1 }, { 0, 4 } },                                                   // an arrow
    { { 0, 0 }, { 3, 0 }, { 3, 1 }, { 1, 1 }, { 1, 3 }, { 0, 3 } },                               // an L
    { { 0, 0 }, { 5, 0 }, { 5, 3 }, { 4, 1 }, { 3, 3 }, { 2, 1 }, { 1, 3 }, { 0, 1 } },           // a comb
    { { 0, 0 }, { 4, 0 }, { 4, 4 }, { 0, 4 }, { 0, 0 }, { 1, 1 }, { 1, 3 }, { 3, 2 }, { 1, 1 } }, // with a hole
    { { 0, 0 }, { 2, 0 }, { 2, 1 }, { 1, 1 }, { 1, 1 }, { 1, 2 }, { 0, 2 } },                     // an L, turning twice
  };
  const std::vector<double> areas{ 3.5, 3.5, 4, 5, 10, 14, 3 };
  for (std::size_t k = 0; k < polygons.size(); ++k)
  {
    const std::size_t n = polygons[k].size();
    for (std::size_t way = 0; way < 6 * n; ++way)
    {
      const int axis = int(way % 3);
      const double sign = way / 3 % 2 == 0 ? 1 : -1;
      std::vector<Eigen::Vector3d> points;
      for (std::size_t i = 0; i < n; ++i)
      {
        const Eigen::Vector2d& p = polygons[k][(i + way / 6) % n];
        Eigen::Vector3d x;
        x[axis] = 0.25 * p.x() + 0.125 * p.y();
        x[(axis + 1) % 3] = sign * p.x();
        x[(axis + 2) % 3] = p.y();
        points.push_back(x);
      }
      std::vector<std::array<std::uint32_t, 3>> triangles;
      std::uint64_t work = 0;
      EXPECT_TRUE(dgtk::triangulate(points, triangles, work, 1000));
      ASSERT_EQ(triangles.size(), n - 2);
      double sum = 0;
      for (const auto& t : triangles)
      {
        const double area = 0.5 * sign * (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]])[axis];
        EXPECT_GE(area, 0) << "polygon " << k << " way " << way;
        sum += area;
      }
      EXPECT_NEAR(sum, areas[k], 1e-12) << "polygon " << k << " way " << way;
      EXPECT_EQ(dgtk::triangulate(points, triangles, work = 0, 0), k < 2) << "above the limit of work";
      EXPECT_EQ(triangles.size(), n - 2);
    }
  }
}
