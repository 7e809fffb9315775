// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelChecks.h"
#include "dgtkModelSeeds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

using namespace dgtk::test;
using testing::ElementsAre;
using testing::IsEmpty;

namespace
{
std::string facet(const std::vector<std::string>& vertices)
{
  std::string text = "facet normal 0 0 0\nouter loop\n";
  for (const std::string& vertex : vertices)
  {
    text += "vertex " + vertex + '\n';
  }
  return text + "endloop\nendfacet\n";
}

/// A cube of side 2 about the origin, two triangles a side.
std::string cube()
{
  const char* const corners[6][4] = { { "-1 -1 1", "1 -1 1", "1 1 1", "-1 1 1" },
    { "-1 1 -1", "1 1 -1", "1 -1 -1", "-1 -1 -1" }, { "1 -1 -1", "1 1 -1", "1 1 1", "1 -1 1" },
    { "-1 -1 1", "-1 1 1", "-1 1 -1", "-1 -1 -1" }, { "-1 1 -1", "-1 1 1", "1 1 1", "1 1 -1" },
    { "1 -1 -1", "1 -1 1", "-1 -1 1", "-1 -1 -1" } };
  std::string text = "solid cube\n";
  for (const auto& side : corners)
  {
    text += facet({ side[0], side[1], side[2] }) + facet({ side[0], side[2], side[3] });
  }
  return text + "endsolid cube\n";
}

/// One triangle, with a header and the two bytes behind it.
std::string binary(std::string header = {}, unsigned attribute = 0, unsigned long count = 1)
{
  header.resize(80, ' ');
  std::string text = header + u32(count);
  for (const float value : { 0.f, 0.f, 1.f, 0.f, 0.f, 5.f, 2.f, 0.f, 5.f, 0.f, 3.f, 5.f })
  {
    text += f32(value);
  }
  return text + u16(attribute);
}

std::vector<Eigen::Vector3d> positionsOf(const dgtk::Model& model)
{
  std::vector<Eigen::Vector3d> all;
  for (const auto& t : model.triangles)
  {
    for (const std::uint32_t v : t)
    {
      all.push_back(model.rest->positions[v]);
    }
  }
  return all;
}
} // namespace

TEST(Stl, Text)
{
  const auto model = readBytes("stl", cube());
  EXPECT_EQ(brokenPromise(*model), "");
  EXPECT_EQ(model->format, "stl");
  EXPECT_EQ(model->triangles.size(), 12u);
  EXPECT_EQ(model->sourceVertices, 8u);
  EXPECT_FALSE(model->isNumbered);
  EXPECT_EQ(model->rest->positions.size(), 24u); // flat: four corners a side
  EXPECT_EQ(model->boundsMin, Eigen::Vector3d(-1, -1, -1));
  EXPECT_EQ(model->boundsMax, Eigen::Vector3d(1, 1, 1));
  ASSERT_EQ(model->parts.size(), 1u);
  EXPECT_EQ(model->parts[0].name, "cube");
  EXPECT_TRUE(model->uvs.empty());
  EXPECT_EQ(model->declaredMaterials, 0u);
  EXPECT_THAT(model->warnings, IsEmpty());
  for (const auto& t : model->triangles)
  {
    EXPECT_GT(model->rest->normals[t[0]].cast<double>().dot(model->rest->positions[t[0]]), 0.99); // outside is outside
  }
}

TEST(Stl, TextInAllItsShapes)
{
  const auto model =
    readBytes("stl", "  solid\r\n" + facet({ "500000.1 0 0", "1 0 0", "0 1e-3 0" }) + "endsolid\n" +
                       "solid  two words \n" + facet({ "0 0 1", "1 0 1", "1 1 1", "0 1 1" }) + "endsolid two words\n");
  ASSERT_EQ(model->parts.size(), 2u);
  EXPECT_EQ(model->parts[0].name, "");
  EXPECT_EQ(model->parts[1].name, "two words");
  EXPECT_THAT(positionsOf(*model),
    ElementsAre(Eigen::Vector3d(500000.1, 0, 0), Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 0.001, 0),
      Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(1, 0, 1), Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(0, 0, 1),
      Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(0, 1, 1)));
  EXPECT_EQ(model->sourceVertices, 7u);
  std::string loud;
  std::string mac;
  for (const char c : cube())
  {
    loud += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    mac += c == '\n' ? '\r' : c;
  }
  for (const std::string& text : { loud, mac })
  {
    const auto other = readBytes("stl", text);
    EXPECT_EQ(other->triangles.size(), 12u);
    EXPECT_EQ(other->parts.at(0).name, text == mac ? "cube" : "CUBE");
  }
  EXPECT_EQ(readBytes("stl", "\xef\xbb\xbf" + cube())->triangles.size(), 12u) << "a byte order mark";
  std::string line = facet({ "0 0 0", "1 0 0", "0 1 0" }) + facet({ "0 0 1", "1 0 1", "0 1 1" });
  std::replace(line.begin(), line.end(), '\n', ' ');
  EXPECT_EQ(readBytes("stl", "solid a\n" + line + "\nendsolid\n")->triangles.size(), 2u);
  for (const std::string normal : { "", "0 0 1 of its maker", "0 0 1\nnot seen" })
  {
    const std::string text = "solid a\nfacet normal " + normal + facet({ "0 0 0", "1 0 0", "0 1 0" }).substr(18);
    EXPECT_EQ(readBytes("stl", text + "endsolid")->triangles.size(), 1u) << normal;
  }
}

TEST(Stl, Binary)
{
  for (const char* header : { "", "solid by its header only" })
  {
    const auto model = readBytes("stl", binary(header));
    EXPECT_EQ(brokenPromise(*model), "");
    EXPECT_THAT(
      positionsOf(*model), ElementsAre(Eigen::Vector3d(0, 0, 5), Eigen::Vector3d(2, 0, 5), Eigen::Vector3d(0, 3, 5)))
      << header;
    EXPECT_THAT(model->warnings, IsEmpty());
  }
  EXPECT_EQ(readBytes("stl", binary() + "more")->triangles.size(), 1u);
  EXPECT_EQ(readBytes("stl", binary("solid by its header only") + "more")->triangles.size(), 1u);
  EXPECT_EQ(readBytes("stl", binary("\xef\xbb\xbf"
                                    "solid"))
              ->triangles.size(),
    1u);
  EXPECT_EQ(readBytes("stl", binary("", 0, 0))->triangles.size(), 0u);
}

TEST(Stl, ColoursAreWarnedOf)
{
  const auto warnings = [](const std::string& bytes) { return readBytes("stl", bytes)->warnings; };
  EXPECT_THAT(warnings(binary("", 0x8000)), ElementsAre("colours of triangles are not drawn"));
  EXPECT_THAT(warnings(binary("COLOR=abcd")), ElementsAre("colours of triangles are not drawn"));
  EXPECT_THAT(warnings(binary("", 0x7fff)), IsEmpty());
}

TEST(Stl, Refusals)
{
  EXPECT_EQ(
    refusal("stl", "x"), "model.stl: the header at byte 0 run past the end of the file (expected 84 bytes, found 1)");
  EXPECT_EQ(refusal("stl", binary("", 0, 2)),
    "model.stl: triangles at byte 84 run past the end of the file (expected 100 bytes, found 50)");
  EXPECT_EQ(refusal("stl", binary("solid by its header only", 0, 2)), refusal("stl", binary("", 0, 2)));
  EXPECT_EQ(refusal("stl", "solid a\nfacet\nouter loop\nvertex 0 0\n"),
    "model.stl:5: ends too soon (expected a number, found end of file)");
  EXPECT_EQ(refusal("stl", "solid a\nfacet\nouter loop\nvertex 0 0 z\n"),
    "model.stl:4: is no STL file (expected a number, found 'z')");
  EXPECT_EQ(refusal("stl", "solid a\rfacet normal 0 0 0\router loop\r\nvertex 0 0 z\r"),
    "model.stl:4: is no STL file (expected a number, found 'z')");
  EXPECT_EQ(refusal("stl", "solid a\nfacet\nwater loop\n"),
    "model.stl:3: is no STL file (expected vertex or endfacet, found 'water')");
  EXPECT_EQ(refusal("stl", "solid a\nfacet normal 0 0 1\n"),
    "model.stl:3: ends too soon (expected vertex or endfacet, found end of file)");
  EXPECT_EQ(
    refusal("stl", "solid a\nfaset\n"), "model.stl:2: is no STL file (expected facet or endsolid, found 'faset')");
  EXPECT_EQ(refusal("stl", "solid a\n" + facet({ "0 0 0", "1 0 0", "0 1 0" })),
    "model.stl:9: ends too soon (expected facet or endsolid, found end of file)");
  EXPECT_EQ(refusal("stl", "solidarity\n"), "model.stl:1: is no STL file (expected solid, found 'solidarity')");
}

TEST(Stl, LimitsOfWorkAndMemory)
{
  std::string text = "solid a\n";
  std::string bytes = std::string(80, ' ') + u32(100'000);
  for (int i = 0; i < 100'000; ++i)
  {
    text += i < 30'000 ? "facet vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endfacet\n" : "";
    bytes += binary().substr(84);
  }
  ASSERT_TRUE(readWithinLimits("stl", text + "endsolid"));
  ASSERT_TRUE(readWithinLimits("stl", bytes));
}

TEST(Stl, Fuzz) { fuzzReader("stl", { cube(), binary() }); }
