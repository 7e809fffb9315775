// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelChecks.h"

#include <Eigen/Core>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

using namespace dgtk::test;
using testing::ElementsAre;
using testing::IsEmpty;

namespace
{
using Vector = Eigen::Vector3d;

/// Of a file with these vertices, and the triangles 0 1 2 and 1 3 2.
void expectTwoTriangles(const std::string& bytes, const std::vector<Vector>& p)
{
  std::shared_ptr<const dgtk::Model> model;
  ASSERT_NO_THROW(model = readBytes("off", bytes)) << bytes;
  EXPECT_EQ(brokenPromise(*model), "");
  ASSERT_EQ(model->triangles.size(), 2u) << bytes;
  std::vector<Vector> corners;
  for (const auto& t : model->triangles)
  {
    for (const std::uint32_t v : t)
    {
      corners.push_back(model->rest->positions[v]);
    }
  }
  EXPECT_THAT(corners, ElementsAre(p[0], p[1], p[2], p[1], p[3], p[2])) << bytes;
  EXPECT_EQ(model->sourceVertices, 4u);
}

const std::vector<Vector> offPoints{ { 500000.1, 0, 1 }, { 1, 0, 2 }, { 1, 1, 3 }, { 2, 1, 4 } };
const std::string offVertices = "500000.1 0 1\n1 0 2\n1 1 3\n2 1 4\n";
const std::string offFaces = "3 0 1 2\n3 1 3 2\n";

/// `text` with another text for each of one's places.
std::string offReplaced(std::string text, const std::string& from, const std::string& to)
{
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
  {
    text.replace(at, from.size(), to);
  }
  return text;
}

/// Vertices with more behind them.
std::string offLines(const std::string& more) { return offReplaced(offVertices, "\n", ' ' + more + '\n'); }
} // namespace

TEST(Off, OfTwoTriangles)
{
  const auto model = readBytes("off", "OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n");
  EXPECT_EQ(brokenPromise(*model), "");
  EXPECT_EQ(model->format, "off");
  EXPECT_TRUE(model->isNumbered);
  EXPECT_EQ(model->triangles.size(), 2u);
  EXPECT_EQ(model->sourceVertices, 4u);
  EXPECT_EQ(model->declaredMaterials, 0u);
  EXPECT_EQ(model->rest->normals[0], Eigen::Vector3f(0, 0, 1));
  EXPECT_TRUE(model->uvs.empty());
  EXPECT_THAT(model->warnings, IsEmpty());
}

TEST(Off, FacesHaveAnyNumberOfCorners)
{
  for (const int corners : { 9, 10, 12, 300 })
  {
    std::string text = "OFF\n" + std::to_string(corners) + " 2 0\n";
    std::string face = std::to_string(corners);
    for (int i = 0; i < corners; ++i)
    {
      const double angle = 6.283185307179586 * i / corners;
      text += std::to_string(std::cos(angle)) + ' ' + std::to_string(std::sin(angle)) + " 0\n";
      face += ' ' + std::to_string(i);
    }
    EXPECT_EQ(readBytes("off", text + face + "\n3 0 1 2\n")->triangles.size(), std::size_t(corners - 1)) << corners;
  }
}

TEST(Off, LinesAndCommentsAsGeomviewHasThem)
{
  const std::string counts = "4 2 5\n";
  const std::string whole = "OFF\n" + counts + offVertices + offFaces;
  const std::string all[] = { whole, "OFF " + counts + offVertices + offFaces, counts + offVertices + offFaces,
    "OFF\n4 2\n" + offVertices + offFaces, "OFF\n4\n2\n5\n" + offVertices + offFaces,
    "OFF 4 2\n5\n" + offVertices + offFaces, "OFF\n" + counts + offReplaced(offVertices, "\n", " ") + '\n' + offFaces,
    "OFF\n4 2\n" + offReplaced(offVertices, "\n", " ") + '\n' + offFaces,
    "OFF\n" + counts + offReplaced(offVertices, " ", "\n") + offFaces,
    "OFF\n" + counts + offReplaced(offReplaced(offVertices, "1\n", "1 "), "3\n", "3 ") + offFaces,
    "OFF\n" + counts + offVertices + "3\n0 1\n2\n3 1\n3 2",
    "# it\nOFF # is\n\n" + offReplaced(counts + offVertices + offFaces, "\n", "#a\n# comment 7\n \n"),
    offReplaced(whole, "\n", "\r\n"), offReplaced(whole, "\n", "\r"), offReplaced(whole, " ", "\t"),
    "\xef\xbb\xbf" + whole, whole + "and more\n", "OFF\n" + counts + offLines("0.5 0.5 1") + offFaces,
    "OFF\n" + counts + offLines("255 0 0 255") + offFaces };
  for (const std::string& text : all)
  {
    expectTwoTriangles(text, offPoints);
    EXPECT_THAT(readBytes("off", text)->warnings, IsEmpty()) << text;
  }
}

TEST(Off, VerticesAsTheFirstWordHasThem)
{
  const std::string counts = "\n4 2 0\n";
  expectTwoTriangles("nOFF\n3" + counts + offVertices + offFaces, offPoints);
  expectTwoTriangles("nOFF 3" + counts + offVertices + offFaces, offPoints);
  expectTwoTriangles("nOFF 2" + counts + "0 0\n1 0\n1 1\n2 1\n" + offFaces,
    { Vector(0, 0, 0), Vector(1, 0, 0), Vector(1, 1, 0), Vector(2, 1, 0) });
  const std::vector<Vector> halves{ { 250000.05, 0, 0.5 }, { 0.5, 0, 1 }, { 0.5, 0.5, 1.5 }, { 1, 0.5, 2 } };
  expectTwoTriangles("4OFF" + counts + offLines("2") + offFaces, halves);
  expectTwoTriangles("4nOFF 3" + counts + offLines("2") + offFaces, halves);
  // nothing is infinitely far: the house's choice
  expectTwoTriangles("4OFF" + counts + offLines("0") + offFaces, offPoints);
  for (const std::string& color : { std::string("0.5 0.25 1"), std::string("255 7 9 255") })
  {
    expectTwoTriangles("COFF" + counts + offLines(color) + offFaces, offPoints);
    EXPECT_THAT(readBytes("off", "COFF" + counts + offLines(color) + offFaces)->warnings,
      ElementsAre("colours of vertices are not drawn"));
    const auto model = readBytes("off", "STCNOFF" + counts + offLines("0 1 0 " + color + " 0.25 0.75") + offFaces);
    EXPECT_EQ(model->uvs.at(0), Eigen::Vector2d(0.25, 0.75));
    EXPECT_EQ(model->rest->normals.at(0), Eigen::Vector3f(0, 1, 0));
    EXPECT_EQ(model->rest->positions.at(0), offPoints[0]);
  }
  const auto plain = readBytes("off", "ST4OFF" + counts + offLines("2 0.25 0.75") + offFaces);
  EXPECT_EQ(plain->uvs.at(0), Eigen::Vector2d(0.25, 0.75));
  EXPECT_THAT(plain->warnings, IsEmpty());
}

TEST(Off, ColoursOfFacesHaveAWarning)
{
  const std::string points = "0 0 0\n1 0 0\n0 1 0\n";
  for (const std::string head : { "OFF\n3 1 0\n", "OFF 3 1 3 # c\n# comment\n\n", "3 1 0\n" })
  {
    EXPECT_TRUE(readBytes("off", head + points + "3 0 1 2 # 1 0 0\n")->warnings.empty()) << head;
    for (const std::string color : { " 255 0 0", " .5 .5 .5 1", " 7" })
    {
      EXPECT_THAT(readBytes("off", head + points + "3 0 1 2" + color + '\n')->warnings,
        ElementsAre("colours of faces are not drawn"))
        << head;
    }
  }
}

TEST(Off, PointsLinesAndWhatCannotBeDrawn)
{
  const auto model = readBytes("off", "OFF\n4 6 0\n" + offVertices + "2 0 1\n1 3\n1 2\n0\n3 0 1 4\n3 0 1 2\n");
  EXPECT_EQ(model->triangles.size(), 1u);
  EXPECT_EQ(model->lines, 1u);
  EXPECT_THAT(model->warnings, ElementsAre("2 points are not drawn", "1 surface left out: fewer than three corners",
                                 "1 surface left out: a vertex that does not exist"));
  EXPECT_TRUE(readBytes("off", "OFF\n0 0 0\n")->triangles.empty());
}

TEST(Off, Refusals)
{
  EXPECT_EQ(refusal("off", "\n"), "model.off:2: ends too soon (expected [ST][C][N][4][n]OFF, found end of file)");
  EXPECT_EQ(refusal("off", "NCOFF\n"), "model.off:1: is no OFF file (expected [ST][C][N][4][n]OFF, found 'NCOFF')");
  EXPECT_EQ(
    refusal("off", "OFF BINARY\n\1\2"), "model.off:1: is binary, which is not read (expected text, found 'BINARY')");
  EXPECT_EQ(
    refusal("off", "nOFF\n5\n1 0 0\n"), "model.off:2: has vertices of another dimension (expected 1 to 3, found '5')");
  EXPECT_EQ(refusal("off", "OFF\n4 -2 0\n"), "model.off:2: is no OFF file (expected a count, found '-2')");
  EXPECT_EQ(refusal("off", "OFF\n4 2 0\n0 0 0\n1 0 z\n"), "model.off:4: is no OFF file (expected a number, found 'z')");
  EXPECT_EQ(refusal("off", "OFF\n4 2 0\n" + offVertices + "3 0 1 2.5\n"),
    "model.off:7: is no OFF file (expected a count, found '2.5')");
  EXPECT_EQ(refusal("off", "OFF\n4 3 0\n" + offVertices + offFaces),
    "model.off:9: ends too soon (expected a count, found end of file)");
  EXPECT_EQ(refusal("off", "OFF\n4000000000 4000000000 0\n0 0 0\n"),
    "model.off:4: ends too soon (expected a number, found end of file)");
}

TEST(Off, Fuzz)
{
  fuzzReader(
    "off", { "OFF\n4 2 0\n" + offVertices + offFaces, "STCNOFF\n4 2\n" + offLines("0 0 1 .1 .2 .3 1 0 1") + offFaces });
}
