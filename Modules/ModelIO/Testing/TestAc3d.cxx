// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelChecks.h"
#include "dgtkModelSeeds.h"

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

using dgtk::Model;
using dgtk::test::ac3dSeed;
using dgtk::test::expectNear;
using dgtk::test::readBytes;
using dgtk::test::refusal;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

namespace
{
using ModelPointer = std::shared_ptr<const Model>;

ModelPointer read(const std::string& text) { return readBytes("ac", text); }

const std::string grey = "MATERIAL \"grey\" rgb 0.5 0.5 0.5 amb 0 0 0 emis 0 0 0 spec 0 0 0 shi 0 trans 0\n";

/// A file of one object: its statements between OBJECT and kids.
std::string object(const std::string& statements)
{
  return "AC3Db\n" + grey + "OBJECT world\nkids 1\nOBJECT poly\n" + statements + "kids 0\n";
}

const std::string square = "numvert 4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\nnumsurf 1\n";
const std::string squareRefs = "mat 0\nrefs 4\n0 0 0\n1 1 0\n2 1 1\n3 0 1\n";

Eigen::Vector3d areaVector(const Model& model, std::size_t triangle)
{
  const auto& t = model.triangles[triangle];
  const auto& p = model.rest->positions;
  return 0.5 * (p[t[1]] - p[t[0]]).cross(p[t[2]] - p[t[0]]);
}

Eigen::Vector3d totalArea(const Model& model)
{
  Eigen::Vector3d sum(0, 0, 0);
  for (std::size_t t = 0; t < model.triangles.size(); ++t)
  {
    sum += areaVector(model, t);
  }
  return sum;
}

double summedArea(const Model& model)
{
  double sum = 0;
  for (std::size_t t = 0; t < model.triangles.size(); ++t)
  {
    sum += areaVector(model, t).norm();
  }
  return sum;
}
} // namespace

TEST(Ac3d, SeedHasEverything)
{
  const ModelPointer model = read(ac3dSeed());
  EXPECT_EQ(model->format, "ac3d");
  EXPECT_EQ(model->triangles.size(), 2u + 1u + 2u);
  EXPECT_EQ(model->lines, 4u);
  EXPECT_EQ(model->declaredMaterials, 2u);
  EXPECT_EQ(model->twoSidedSurfaces, 3u);  // one of them lines
  EXPECT_EQ(model->twoSidedTriangles, 4u); // the quad and the strip
  ASSERT_EQ(model->parts.size(), 3u);      // roof in two materials, the strip
  EXPECT_EQ(model->parts[0].name, "roof");
  EXPECT_EQ(model->parts[1].name, "roof");
  EXPECT_EQ(model->textures.size(), 1u); // the base, not the shadow
  EXPECT_EQ(model->textures[0].name, "tiles.png");
  const dgtk::Material& red = model->materials[static_cast<std::size_t>(model->parts[0].material)];
  EXPECT_EQ(red.name, "red paint");
  EXPECT_DOUBLE_EQ(red.opacity, 0.75);
  EXPECT_DOUBLE_EQ(red.shininess, 64);
  EXPECT_DOUBLE_EQ(red.diffuse[1], 0.25);
  EXPECT_DOUBLE_EQ(red.emission[1], 0.1);
  EXPECT_EQ(red.texture, 0);
  EXPECT_EQ(model->materials[static_cast<std::size_t>(model->parts[2].material)].texture, -1);
  EXPECT_THAT(model->warnings, ElementsAre(HasSubstr("texture 'tiles.png' not found (tried as written")));
}

TEST(Ac3d, TextureCoordinatesAreRepeatedAndMoved)
{
  const ModelPointer model = read(object("texrep 2 3\ntexoff 0.5 0.25\n" + square + "SURF 0x00\n" + squareRefs));
  ASSERT_EQ(model->uvs.size(), 4u);
  EXPECT_EQ(model->uvs[0], Eigen::Vector2d(0.5, 0.25));
  EXPECT_EQ(model->uvs[2], Eigen::Vector2d(2.5, 3.25));
}

TEST(Ac3d, CornersThatDifferInOneTextureCoordinateAreNotShared)
{
  // a vertex of so many surfaces that some of its corners have hashes that meet
  constexpr int surfaces = 200;
  for (const bool along : { false, true })
  {
    std::string text = "numvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf " + std::to_string(surfaces) + '\n';
    for (int i = 0; i < surfaces; ++i)
    {
      const std::string value = std::to_string(i / 64.0);
      text += "SURF 0x00\nmat 0\nrefs 3\n0 " + (along ? value + " 0" : "0 " + value) + "\n1 1 0\n2 0 1\n";
    }
    const ModelPointer model = read(object(text));
    ASSERT_EQ(model->uvs.size(), std::size_t(surfaces) + 2);
    for (std::size_t i = 0; i < surfaces; ++i)
    {
      EXPECT_EQ(model->uvs[model->triangles[i][0]][along ? 0 : 1], double(i) / 64);
    }
  }
}

TEST(Ac3d, TransformsAreInherited)
{
  // a turn by 90 degrees about z: x -> y, y -> -x
  const std::string turn = "rot 0 -1 0 1 0 0 0 0 1\n";
  const ModelPointer model =
    read("AC3Db\n" + grey + "OBJECT world\nkids 1\nOBJECT group\nloc 10 0 0\n" + turn +
         "kids 1\nOBJECT poly\nloc 1 0 0\n" + turn + square + "SURF 0x00\n" + squareRefs + "kids 0\n");
  // p' = rot * (rot * p + (1, 0, 0)) + (10, 0, 0)
  expectNear(model->rest->positions[0], { 10, 1, 0 });
  expectNear(model->rest->positions[1], { 9, 1, 0 });
  expectNear(model->boundsMin, { 9, 0, 0 });
  expectNear(model->boundsMax, { 10, 1, 0 });
}

TEST(Ac3d, KidsDoNotShiftTheirSiblings)
{
  const std::string one = "OBJECT poly\n" + square + "SURF 0x00\n" + squareRefs;
  const ModelPointer model = read("AC3Db\n" + grey + "OBJECT world\nkids 2\n" + "OBJECT group\nloc 5 0 0\nkids 1\n" +
                                  one + "kids 0\n" + one + "kids 0\n");
  EXPECT_THAT(model->warnings, IsEmpty());
  ASSERT_EQ(model->parts.size(), 2u);
  expectNear(model->rest->positions[0], { 5, 0, 0 });
  expectNear(model->rest->positions[4], { 0, 0, 0 });
}

TEST(Ac3d, AKidWithoutKidsIsComplete)
{
  const std::string one = "OBJECT poly\n" + square + "SURF 0x00\n" + squareRefs;
  const ModelPointer model =
    read("AC3Db\n" + grey + "OBJECT world\nkids 2\n" + "OBJECT group\nloc 100 0 0\nkids 1\n" + one + one + "kids 0\n");
  expectNear(model->boundsMin, { 0, 0, 0 });
  expectNear(model->boundsMax, { 101, 1, 0 });
  EXPECT_THAT(model->warnings, ElementsAre("1 object(s) end without 'kids'"));
}

TEST(Ac3d, LinesMoveWithTheirObject)
{
  const ModelPointer model =
    read(object("loc 0 0 7\n" + square + "SURF 0x01\nmat 0\nrefs 4\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n"));
  EXPECT_EQ(model->lines, 4u);
  EXPECT_TRUE(model->triangles.empty());
  expectNear(model->boundsMin, { 0, 0, 7 });
  expectNear(model->boundsMax, { 1, 1, 7 });
}

TEST(Ac3d, ConcavePolygonsKeepTheirArea)
{
  // a comb of four teeth, counter-clockwise; its area is known
  std::string vertices;
  std::string refs;
  int n = 0;
  const auto add = [&](double x, double y)
  {
    vertices += std::to_string(x) + " 3 " + std::to_string(-y) + "\n";
    refs += std::to_string(n++) + " 0 0\n";
  };
  add(0, 0);
  add(8, 0);
  for (int tooth = 3; tooth >= 0; --tooth)
  {
    add(2 * tooth + 2, 5);
    add(2 * tooth + 1, 5);
    add(2 * tooth + 1, 1);
    add(2 * tooth, 1);
  }
  const ModelPointer model = read(object("numvert " + std::to_string(n) + "\n" + vertices +
                                         "numsurf 1\nSURF 0x00\nmat 0\nrefs " + std::to_string(n) + "\n" + refs));
  EXPECT_EQ(model->triangles.size(), static_cast<std::size_t>(n - 2));
  const double area = 8 * 1 + 4 * 1 * 4;
  EXPECT_NEAR(summedArea(*model), area, 1e-12);  // no overlap
  expectNear(totalArea(*model), { 0, area, 0 }); // none turned over
}

TEST(Ac3d, CornersOnADiagonalAreInItsWay)
{
  // a square with a notch down to its middle, which lies on both diagonals
  const ModelPointer model =
    read(object("numvert 5\n0 0 0\n2 0 0\n2 2 0\n1 1 0\n0 2 0\nnumsurf 1\nSURF 0x00\nmat 0\nrefs 5\n"
                "0 0 0\n1 0 0\n2 0 0\n3 0 0\n4 0 0\n"));
  EXPECT_EQ(model->triangles.size(), 3u);
  EXPECT_NEAR(summedArea(*model), 3, 1e-12);
  const ModelPointer turned =
    read(object("numvert 5\n0 0 0\n2 0 0\n2 2 0\n1 1 0\n0 2 0\nnumsurf 1\nSURF 0x00\nmat 0\nrefs 5\n"
                "4 0 0\n3 0 0\n2 0 0\n1 0 0\n0 0 0\n"));
  EXPECT_NEAR(summedArea(*turned), 3, 1e-12);
  expectNear(totalArea(*turned), { 0, 0, -3 });
}

TEST(Ac3d, PolygonWithAHoleThroughABridge)
{
  // outer square 4 x 4, hole 2 x 2, joined by a seam that is walked twice
  const ModelPointer model = read(
    object("numvert 8\n0 0 0\n4 0 0\n4 4 0\n0 4 0\n1 1 0\n3 1 0\n3 3 0\n1 3 0\nnumsurf 1\nSURF 0x00\nmat 0\nrefs 10\n"
           "0 0 0\n1 0 0\n2 0 0\n3 0 0\n0 0 0\n4 0 0\n7 0 0\n6 0 0\n5 0 0\n4 0 0\n"));
  EXPECT_EQ(model->triangles.size(), 8u);
  EXPECT_NEAR(summedArea(*model), 12, 1e-12);
}

TEST(Ac3d, StripsAlternateAndDropDegenerates)
{
  const ModelPointer model =
    read(object(square + "SURF 0x04\nmat 0\nrefs 6\n0 0 0\n1 0 0\n3 0 0\n3 0 0\n2 0 0\n1 0 0\n"));
  // 0 1 3 | 1 3 3 and 3 3 2 dropped | 3 2 1 turned by its place in the strip
  ASSERT_EQ(model->triangles.size(), 2u);
  expectNear(areaVector(*model, 0), { 0, 0, 0.5 });
  EXPECT_NEAR(areaVector(*model, 1).norm(), 0.5, 1e-12);
}

TEST(Ac3d, FlatAndSmoothSurfaces)
{
  // two squares that meet at a right angle along the edge 1-2
  const std::string roof = "numvert 6\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n1 0 -1\n1 1 -1\nnumsurf 2\n";
  const auto file = [&](const std::string& crease, const std::string& flags)
  {
    return read(object(crease + roof + "SURF " + flags + "\nmat 0\nrefs 4\n0 0 0\n1 0 0\n2 0 0\n3 0 0\n" + "SURF " +
                       flags + "\nmat 0\nrefs 4\n1 0 0\n4 0 0\n5 0 0\n2 0 0\n"));
  };
  EXPECT_EQ(file("", "0x00")->rest->normals.size(), 8u);
  EXPECT_EQ(file("", "0x10")->rest->normals.size(), 8u); // 90 degrees are more than 61
  EXPECT_EQ(file("crease 89.0\n", "0x10")->rest->normals.size(), 8u);
  EXPECT_EQ(file("crease 90\n", "0x10")->rest->normals.size(), 6u);
  const ModelPointer smooth = file("crease 91\n", "0x10");
  ASSERT_EQ(smooth->rest->normals.size(), 6u);
  const float h = std::sqrt(0.5f);
  EXPECT_LT((smooth->rest->normals[1] - Eigen::Vector3f(h, 0, h)).norm(), 1e-6f);
  EXPECT_LT((smooth->rest->normals[0] - Eigen::Vector3f(0, 0, 1)).norm(), 1e-6f);
}

TEST(Ac3d, NormalsOfTheFileAreUsedAndTurned)
{
  const ModelPointer model = read(object("rot 0 -1 0 1 0 0 0 0 1\nnumvert 3\n0 0 0 3 0 0\n1 0 0 1 0 0\n0 1 0 1 0 0\n"
                                         "numsurf 1\nSURF 0x10\nmat 0\nrefs 3\n0 0 0 1 1 1 1 1 1\n1 1 0\n2 0 1\n"));
  EXPECT_LT((model->rest->normals[0] - Eigen::Vector3f(0, 1, 0)).norm(), 1e-6f);
  EXPECT_EQ(model->uvs[0], Eigen::Vector2d(0, 0)); // the first pair, not the last
}

TEST(Ac3d, NormalsStayAcrossSurfacesThatAreStretched)
{
  const ModelPointer model = read(object("rot 2 0 0 0 1 0 0 0 1\nnumvert 3\n0 0 0 1 1 0\n1 0 0 1 1 0\n0 1 0 1 1 0\n"
                                         "numsurf 1\nSURF 0x10\nmat 0\nrefs 3\n0 0 0\n1 1 0\n2 0 1\n"));
  EXPECT_LT((model->rest->normals[0] - Eigen::Vector3f(1, 2, 0).normalized()).norm(), 1e-6f);
}

TEST(Ac3d, LayersForOtherPurposesAreNotTheTexture)
{
  for (const std::string layer : { "tiled", "skids", "shad" })
  {
    const ModelPointer model =
      read(object("texture \"a.png\" base\ntexture \"b.png\" " + layer + "\n" + square + "SURF 0x00\n" + squareRefs));
    ASSERT_EQ(model->textures.size(), 1u) << layer;
    EXPECT_EQ(model->textures[0].name, "a.png") << layer;
  }
}

TEST(Ac3d, ANameThatMeansNoTexture)
{
  const ModelPointer model =
    read(object("texture \"empty_texture_no_mapping\"\n" + square + "SURF 0x00\n" + squareRefs));
  EXPECT_TRUE(model->textures.empty());
  EXPECT_THAT(model->warnings, IsEmpty());
}

TEST(Ac3d, ALineOfTwoPointsIsOneEvenClosed)
{
  const ModelPointer line = read(object(square + "SURF 0x01\nmat 0\nrefs 2\n0 0 0\n2 0 0\n"));
  EXPECT_EQ(line->lines, 1u);
  expectNear(line->boundsMax, { 1, 1, 0 });
  EXPECT_EQ(read(object(square + "SURF 0x01\nmat 0\nrefs 3\n0 0 0\n1 0 0\n2 0 0\n"))->lines, 3u);
  EXPECT_EQ(read(object(square + "SURF 0x02\nmat 0\nrefs 3\n0 0 0\n1 0 0\n2 0 0\n"))->lines, 2u);
}

TEST(Ac3d, ASurfaceThatMeetsAVertexTwiceIsSmoothedInOnce)
{
  // two triangles of one polygon that touch at vertex 0, and a third triangle, upright, beside vertex 0
  const ModelPointer model = read(
    object("crease 120\nnumvert 6\n0 0 0\n1 0 0\n1 1 0\n-1 0 0\n-1 -1 0\n0 1 -1\nnumsurf 2\nSURF 0x10\nmat 0\nrefs 6\n"
           "0 0 0\n1 0 0\n2 0 0\n0 0 0\n3 0 0\n4 0 0\nSURF 0x10\nmat 0\nrefs 3\n0 0 0\n1 0 0\n5 0 0\n"));
  const Eigen::Vector3f upright = Eigen::Vector3f(0, 1, 1).normalized(); // (1, 0, 0) x (0, 1, -1)
  EXPECT_LT((model->rest->normals[0] - (Eigen::Vector3f(0, 0, 1) + upright).normalized()).norm(), 1e-6f);
}

TEST(Ac3d, NormalsBelongToTheVerticesThatHaveThem)
{
  const ModelPointer model = read(object("numvert 3\n0 0 0\n1 0 0 1 0 1\n0 1 0\nnumsurf 1\nSURF 0x10\nmat 0\nrefs 3\n"
                                         "0 0 0\n1 1 0\n2 0 1\n"));
  EXPECT_EQ(model->rest->normals[0], Eigen::Vector3f(0, 0, 1));
  EXPECT_LT((model->rest->normals[1] - Eigen::Vector3f(1, 0, 1).normalized()).norm(), 1e-6f);
  EXPECT_EQ(model->rest->normals[2], Eigen::Vector3f(0, 0, 1));
}

TEST(Ac3d, NormalsAreThoseOfTheirObject)
{
  const std::string rest = "numsurf 1\nSURF 0x00\nmat 0\nrefs 3\n0 0 0\n1 0 0\n2 0 0\nkids 0\n";
  const ModelPointer model = read("AC3Db\n" + grey + "OBJECT world\nkids 2\n" +
                                  "OBJECT poly\nnumvert 3\n0 0 0 1 0 0\n1 0 0 1 0 0\n0 1 0 1 0 0\n" + rest +
                                  "OBJECT poly\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\n" + rest);
  ASSERT_EQ(model->triangles.size(), 2u);
  EXPECT_EQ(model->rest->normals[model->triangles[0][0]], Eigen::Vector3f(1, 0, 0));
  EXPECT_EQ(model->rest->normals[model->triangles[1][0]], Eigen::Vector3f(0, 0, 1));
}

TEST(Ac3d, EncodingsAndLineEndsDoNotMatter)
{
  const std::string plain = object("name \"caf\xc3\xa9\"\n" + square + "SURF 0x00\n" + squareRefs);
  std::string dos;
  std::string mac;
  std::string little = "\xff\xfe";
  std::string big = "\xfe\xff";
  for (std::size_t i = 0; i < plain.size(); ++i)
  {
    const char c = plain[i];
    dos += c == '\n' ? "\r\n\r\n" : std::string(1, c);
    mac += c == '\n' ? '\r' : c;
    if (c != '\xa9')
    {
      const char unit = c == '\xc3' ? '\xe9' : c;
      little += { unit, '\0' };
      big += { '\0', unit };
    }
  }
  for (const std::string& text : { plain, "\xef\xbb\xbf" + plain, dos, mac, little, big })
  {
    const ModelPointer model = read(text);
    ASSERT_EQ(model->parts.size(), 1u);
    EXPECT_EQ(model->parts[0].name, "caf\xc3\xa9");
    EXPECT_EQ(model->triangles.size(), 2u);
    EXPECT_THAT(model->warnings, IsEmpty());
  }
}

TEST(Ac3d, DamageThatRealFilesHave)
{
  const std::string surface = "SURF 0x00\n" + squareRefs;
  // markers of a merge conflict, unknown statements, a blank line in a list
  EXPECT_EQ(
    read(object("<<<<<<< HEAD:a\nsomething else\n=======\n>>>>>>> b\nnumvert 4\n0 0 0\n\n<<<<<<< x\n1 0 0\n1 1 0\n0 1 "
                "0\nnumsurf 1\n" +
                surface))
      ->triangles.size(),
    2u);
  // a count of kids larger than what follows
  const ModelPointer kids =
    read("AC3Db\n" + grey + "OBJECT world\nkids 5\nOBJECT poly\n" + square + surface + "kids 0\n");
  EXPECT_EQ(kids->triangles.size(), 2u);
  EXPECT_THAT(kids->warnings, ElementsAre(HasSubstr("promise more kids")));
  // surfaces of one or two corners, of vertices or materials that do not exist
  const ModelPointer bad = read(
    object(square + "SURF 0x00\nmat 0\nrefs 2\n0 0 0\n1 0 0\n" + surface +
           "SURF 0x00\nmat 0\nrefs 3\n0 0 0\n1 0 0\n-4 0 0\n" + "SURF 0x00\nmat 9\nrefs 3\n0 0 0\n1 0 0\n2 0 0\n"));
  EXPECT_EQ(bad->triangles.size(), 3u);
  EXPECT_THAT(bad->warnings,
    testing::UnorderedElementsAre(HasSubstr("1 surface left out: fewer than three corners"),
      HasSubstr("1 surface left out: a vertex that does not exist"), HasSubstr("a material that does not exist")));
  // nothing but a header and an empty object
  const ModelPointer empty = read("AC3Db\nOBJECT poly\nkids 0\n");
  EXPECT_TRUE(empty->triangles.empty());
  EXPECT_GT(empty->boundsMin[0], empty->boundsMax[0]);
  EXPECT_THAT(empty->warnings, IsEmpty());
}

TEST(Ac3d, CoordinatesThatAreNoNumbersAreLeftOut)
{
  for (const std::string bad : { "nan", "-inf", "1e999", "-1.#IND", "1e300" })
  {
    const ModelPointer model = read(object("numvert 4\n0 0 0\n1 0 0\n1 1 0\n0 " + bad + " 0\nnumsurf 2\nSURF 0x00\n" +
                                           squareRefs + "SURF 0x00\nmat 0\nrefs 3\n0 0 0\n1 nan 0\n2 0 0\n"));
    EXPECT_EQ(model->triangles.size(), 1u) << bad;
    EXPECT_EQ(dgtk::test::brokenPromise(*model), "") << bad;
    EXPECT_THAT(
      model->warnings, ElementsAre(HasSubstr("1 surface left out: a coordinate that is not a finite number")));
  }
}

TEST(Ac3d, NumbersOfMaterialsAndTextureCoordinatesAreBounded)
{
  std::string text = object(square + "SURF 0x00\nmat 0\nrefs 3\n0 0 nan\n1 1e999 0\n2 0.5 0.25\n");
  text.replace(text.find("shi 0 trans 0"), 13, "shi 200 trans -1");
  const ModelPointer model = read(text);
  EXPECT_EQ(model->materials[static_cast<std::size_t>(model->parts[0].material)].shininess, 128);
  EXPECT_EQ(model->materials[static_cast<std::size_t>(model->parts[0].material)].opacity, 1);
  ASSERT_EQ(model->uvs.size(), 3u);
  EXPECT_EQ(model->uvs[model->triangles[0][0]], Eigen::Vector2d(0, 0));
  EXPECT_EQ(model->uvs[model->triangles[0][1]], Eigen::Vector2d(0, 0));
  EXPECT_EQ(model->uvs[model->triangles[0][2]], Eigen::Vector2d(0.5, 0.25));
}

TEST(Ac3d, DataMayLookLikeStatements)
{
  const ModelPointer model = read(object("data 13\nkids 4\nSURF x\n" + square + "SURF 0x00\n" + squareRefs));
  EXPECT_EQ(model->triangles.size(), 2u);
  EXPECT_THAT(model->warnings, IsEmpty());
  // counted with up to three characters a line end, and one at the end
  for (const char* count : { "7", "8", "9", "12" })
  {
    const ModelPointer counted =
      read(object(std::string("data ") + count + "\nab\ncde\n" + square + "SURF 0x00\n" + squareRefs));
    EXPECT_EQ(counted->triangles.size(), 2u) << count;
    EXPECT_THAT(counted->warnings, IsEmpty()) << count;
  }
}

TEST(Ac3d, Refusals)
{
  EXPECT_EQ(refusal("ac", "\n"), "model.ac:1: is not an AC3D file (expected 'AC3D' and a version digit, found '')");
  for (const char* header : { "v 1 2 3", "AC3D", "AC3Dx", "AC3Db.", "AC3F1", " AC3Db" })
  {
    const bool known = std::string(header) == "AC3Db.";
    EXPECT_EQ(refusal("ac", std::string(header) + "\nOBJECT world\nkids 0\n"),
      known
        ? ""
        : "model.ac:1: is not an AC3D file (expected 'AC3D' and a version digit, found '" + std::string(header) + "')");
  }
  EXPECT_EQ(
    refusal("ac", object("numvert 2\n0 0 0\n0 zero 0\n")), "model.ac:8: bad vertex (expected a number, found 'zero')");
  EXPECT_EQ(refusal("ac", "AC3Db\nOBJECT poly\nnumvert 3\n0 0 0\n"),
    "model.ac:4: ends within the vertices of an object (expected 3, found 1)");
  EXPECT_THAT(refusal("ac", object("numvert -3\n")), HasSubstr("model.ac:6: bad number of vertices"));
  EXPECT_THAT(
    refusal("ac", "AC3Db\nMATERIAL \"x\" rgb 1 0\n"), HasSubstr("model.ac:2: incomplete colour of a material"));
  EXPECT_THAT(refusal("ac", "AC3Db\nSURF 0x00\n"), HasSubstr("model.ac:2: geometry outside of an object"));
  std::string deep = "AC3Db\n";
  for (int i = 0; i < 1100; ++i)
  {
    deep += "OBJECT group\nkids 1\n";
  }
  EXPECT_THAT(refusal("ac", deep), HasSubstr("objects are nested too deeply (expected at most 1000 levels)"));
}

TEST(Ac3d, FilesThatWereCutShort)
{
  const std::string whole =
    "AC3Db\n" + grey + "OBJECT world\nkids 9\nOBJECT poly\n" + square + "SURF 0x00\n" + squareRefs + "kids 0\n";
  EXPECT_EQ(read(whole)->triangles.size(), 2u) << "promises more kids than follow, as real files do";
  EXPECT_EQ(refusal("ac", whole.substr(0, whole.find("OBJECT poly"))),
    "model.ac:4: ends before the kids of an object (expected 9 objects, found the end of the file)");
  EXPECT_EQ(refusal("ac", whole.substr(0, whole.find("SURF"))),
    "model.ac:11: ends within the surfaces of an object (expected 1 more, found the end of the file)");
  EXPECT_EQ(refusal("ac", whole.substr(0, whole.find("kids 0"))),
    "model.ac:18: ends within an object (expected 'kids', found the end of the file)");
}

TEST(Ac3d, AVersionThatSpreadsMaterialsOverLines)
{
  const ModelPointer model = read("AC3Dc\nMAT \"m\"\nrgb 1 0.5 0\ntrans 0.5\nENDMAT\nOBJECT poly\n" + square +
                                  "SURF 0x00\n" + squareRefs + "kids 0\n");
  ASSERT_EQ(model->declaredMaterials, 1u);
  EXPECT_EQ(model->materials[0].diffuse, Eigen::Vector3d(1, 0.5, 0));
  EXPECT_EQ(model->materials[0].opacity, 0.5);
}
