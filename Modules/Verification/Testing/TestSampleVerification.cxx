// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampleVerification.h"

#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkHash.h"
#include "dgtkMeshOverlap.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <string>

namespace
{
using namespace dgtk;

WorldMesh box(const Eigen::Vector3d& low, const Eigen::Vector3d& high)
{
  const auto corner = [&](int i)
  { return Eigen::Vector3d(i & 1 ? high.x() : low.x(), i & 2 ? high.y() : low.y(), i & 4 ? high.z() : low.z()); };
  WorldMesh mesh;
  const int sides[12][3] = { { 0, 2, 3 }, { 0, 3, 1 }, { 4, 5, 7 }, { 4, 7, 6 }, { 0, 1, 5 }, { 0, 5, 4 }, { 2, 6, 7 },
    { 2, 7, 3 }, { 0, 4, 6 }, { 0, 6, 2 }, { 1, 3, 7 }, { 1, 7, 5 } };
  for (const auto& side : sides)
  {
    mesh.add({ corner(side[0]), corner(side[1]), corner(side[2]) });
  }
  return mesh;
}

WorldMesh together(WorldMesh a, const WorldMesh& b)
{
  for (const WorldTriangle& t : b.triangles)
  {
    a.add(t);
  }
  return a;
}

/// A closed bar along z, of an L: what is left of a square of side 2 without its last quarter.
WorldMesh angleBar()
{
  const double outline[6][2] = { { 1, 1 }, { 1, 2 }, { 0, 2 }, { 0, 0 }, { 2, 0 }, { 2, 1 } };
  const auto corner = [&](int i, double z) { return Eigen::Vector3d(outline[i % 6][0], outline[i % 6][1], z); };
  WorldMesh mesh;
  for (int i = 0; i < 6; ++i)
  {
    mesh.add({ corner(i, -5), corner(i + 1, -5), corner(i + 1, 5) });
    mesh.add({ corner(i, -5), corner(i + 1, 5), corner(i, 5) });
  }
  for (int i = 1; i < 5; ++i) // all of it is seen from the inner edge
  {
    mesh.add({ corner(0, -5), corner(i + 1, -5), corner(i, -5) });
    mesh.add({ corner(0, 5), corner(i, 5), corner(i + 1, 5) });
  }
  return mesh;
}

/// An object of a scene, by its model's name and what more is said of it.
std::string object(const std::string& name, const std::string& model, const std::string& more)
{
  return R"({ "name": ")" + name + R"(", "model": ")" + test::sourceFile("Data/Models/" + model + ".ac") + '"' + more +
         " }";
}

/// A folder of one sample, whose brick was placed. A word of its record is replaced.
VerificationReport samples(const std::string& scene, const std::string& word = "", const std::string& instead = "")
{
  const test::TemporaryFolder folder;
  writeFile(folder.path("000000.json"), scene);
  std::string record =
    R"({ "complete": true, "first": 0, "last": 0, "samples": [ { "sample": 0, "file": "000000.json", "seed": 7, "sha256": ")" +
    hashOfFile(folder.path("000000.json")) +
    R"(", "notes": [ { "path": "objects/brick/place", "kept": true, "attempts": 1, "measured": { "penetration": 0, "gap": 0, "tolerance": 0.0005 } } ] } ] })";
  const std::size_t place = record.find(word);
  EXPECT_NE(place, std::string::npos) << word;
  writeFile(folder.path("samples.json"), record.replace(place, word.size(), instead));
  EXPECT_TRUE(isSampleFolder(folder.path("")));
  return verifySamples(folder.path(""));
}

/// A brick at a height over the table's top, turned a little about the vertical.
VerificationReport bricks(double above, const std::string& word = "", const std::string& instead = "")
{
  const std::string place =
    R"(, "orientation": [0.98, 0, 0.2, 0], "position": [0.1, )" + std::to_string(0.75 + above) + ", 0.1]";
  return samples(
    R"({ "seed": 7, "objects": [ )" + object("table", "table", "") + ", " + object("brick", "brick", place) + " ] }",
    word, instead);
}

const Residual& residual(const VerificationReport& report, const std::string& check)
{
  for (const Residual& one : report.residuals)
  {
    if (one.check == check)
    {
      return one;
    }
  }
  throw std::runtime_error("no check " + check);
}
} // namespace

TEST(MeshOverlap, DepthsAreThoseOfBoxes)
{
  const WorldMesh cube = box({ -0.5, -0.5, -0.5 }, { 0.5, 0.5, 0.5 });
  EXPECT_NEAR(overlapDepth(box({ -0.2, 0.4, -0.3 }, { 0.8, 1.4, 0.7 }), cube), 0.1, 1e-12);
  EXPECT_NEAR(overlapDepth(box({ -2, 0.45, -0.03 }, { 2, 0.65, 0.17 }), cube), 0.05, 1e-9); // edges alone
  EXPECT_NEAR(overlapDepth(box({ 0.2, -0.1, -0.1 }, { 0.4, 0.1, 0.1 }), cube), 0.3, 1e-12); // within
  EXPECT_EQ(overlapDepth(box({ -0.2, 0.5001, -0.3 }, { 0.8, 1.4, 0.7 }), cube), 0);
}

TEST(MeshOverlap, TheFreeWayEndsWhereSurfacesTouch)
{
  const WorldMesh cube = box({ -0.5, -0.5, -0.5 }, { 0.5, 0.5, 0.5 });
  const Eigen::Vector3d way(0, -0.5, 0);
  const auto triangle = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
  {
    WorldMesh mesh;
    mesh.add({ a, b, c });
    return mesh;
  };
  EXPECT_NEAR(freeWay(box({ -0.2, 0.6, -0.3 }, { 0.8, 1.4, 0.7 }), cube, way), 0.2, 1e-12);
  EXPECT_NEAR(freeWay(box({ -2, 0.6, -2 }, { 2, 1.4, 2 }), cube, way), 0.2, 1e-12) << "corners of the other alone";
  EXPECT_NEAR(freeWay(box({ -2, 0.6, -0.1 }, { 2, 1.4, 0.1 }), cube, way), 0.2, 1e-12) << "edges alone";
  EXPECT_NEAR(freeWay(triangle({ 0, 0.51, 0 }, { 0.1, 0.51, 0 }, { 0, 0.51, 0.1 }), cube, way), 0.02, 1e-12)
    << "a sheet, which the surface lets through between two steps";
  EXPECT_NEAR(freeWay(triangle({ 0.5, 0.6, 0 }, { 0.5, 0.8, 0 }, { 0.5, 0.6, 0.1 }), cube, way), 0.2, 1e-9)
    << "along the border";
  EXPECT_EQ(freeWay(box({ -0.2, 0.5, -0.3 }, { 0.8, 1.4, 0.7 }), cube, way), 0) << "touches already";
  EXPECT_EQ(freeWay(box({ -0.2, 1.1, -0.3 }, { 0.8, 1.4, 0.7 }), cube, way), 1) << "not within the way";
  EXPECT_EQ(freeWay(box({ 0.51, 0.6, -0.3 }, { 0.8, 1.4, 0.7 }), cube, way), 1) << "beside it";
  EXPECT_EQ(freeWay(box({ -0.2, -1.4, -0.3 }, { 0.8, -0.6, 0.7 }), cube, way), 1) << "below it";
  EXPECT_NEAR(freeWay(box({ -0.2, -1.4, -0.3 }, { 0.8, -0.6, 0.7 }), cube, -way), 0.2, 1e-12);
}

TEST(MeshOverlap, SidesInOnePlaneHideNone)
{
  const WorldMesh cube = box({ -0.5, -0.5, -0.5 }, { 0.5, 0.5, 0.5 });
  const auto aside = [&](double way) {
    return overlapDepth(box({ way - 0.5, -0.5, -0.5 }, { way + 0.5, 0.5, 0.5 }), cube);
  };
  for (const double way : { 0.0, 0.02, 0.3, 0.9 })
  {
    EXPECT_GE(aside(way), 0.3 * (1 - way)) << way;
    EXPECT_LE(aside(way), 1 - way + 1e-12) << way;
  }
  EXPECT_EQ(aside(1), 0) << "they touch";
}

TEST(MeshOverlap, OnlyClosedPartsHaveAnInside)
{
  const WorldMesh cube = box({ -0.5, -0.5, -0.5 }, { 0.5, 0.5, 0.5 });
  const WorldMesh small = box({ -0.1, -0.1, -0.1 }, { 0.1, 0.1, 0.1 });
  EXPECT_NEAR(overlapDepth(small, cube), 0.4, 1e-12);
  EXPECT_NEAR(overlapDepth(cube, small), 0.4, 1e-12);
  WorldMesh lidless;
  for (std::size_t i = 1; i < cube.triangles.size(); ++i)
  {
    lidless.add(cube.triangles[i]);
  }
  EXPECT_EQ(overlapDepth(small, lidless), 0);
  // A sheet beside the cube takes nothing from it; a second cube, whose planes go by nearer than the first one's sides,
  // and what lies between the two is in neither.
  WorldMesh sheet;
  sheet.add({ Eigen::Vector3d(5, 0, 0), Eigen::Vector3d(6, 0, 0), Eigen::Vector3d(5, 1, 0) });
  EXPECT_NEAR(overlapDepth(small, together(cube, sheet)), 0.4, 1e-12);
  const WorldMesh two = together(cube, box({ 2, 0.12, 0.12 }, { 3, 1.12, 1.12 }));
  EXPECT_NEAR(overlapDepth(small, two), 0.4, 1e-12);
  EXPECT_EQ(overlapDepth(box({ 1, 0.2, 0.2 }, { 1.2, 0.4, 0.4 }), two), 0);
}

TEST(MeshOverlap, TheNearestPlaceMayBeAnEdgeOrACorner)
{
  const auto at = [](const Eigen::Vector3d& x)
  {
    WorldMesh mesh;
    mesh.add({ x, x, x });
    return mesh;
  };
  EXPECT_NEAR(overlapDepth(at({ 0.7, 0.6, 1 }), angleBar()), 0.5, 1e-12) << "of the inner edge";
  EXPECT_NEAR(overlapDepth(at({ 0.7, 1.2, 1 }), angleBar()), 0.3, 1e-12) << "of a side";
  EXPECT_NEAR(overlapDepth(at({ 0.5, 0.5, 4.9 }), angleBar()), 0.1, 1e-12) << "of an end";
  EXPECT_EQ(overlapDepth(at({ 1.1, 1.1, 1 }), angleBar()), 0) << "in the corner that is left out";
}

TEST(SampleVerification, SeesWhatHoversAndWhatSinks)
{
  EXPECT_TRUE(bricks(0.0003).passed());
  EXPECT_NEAR(residual(bricks(0.0003), "gap").largest, 0.6, 1e-9);
  const VerificationReport hovers = bricks(0.0007);
  EXPECT_FALSE(hovers.passed());
  EXPECT_EQ(hovers.firstBreach()->check, "gap");
  EXPECT_EQ(hovers.firstBreach()->worst.file, "000000.json");
  EXPECT_EQ(hovers.firstBreach()->worst.value.rfind("brick: ", 0), 0u);
  EXPECT_NEAR(residual(bricks(-0.0004), "penetration").largest, 0.8, 0.01);
  EXPECT_TRUE(bricks(-0.0004).passed());
  const VerificationReport sinks = bricks(-0.0006);
  EXPECT_FALSE(sinks.passed());
  EXPECT_EQ(sinks.firstBreach()->check, "penetration");
}

TEST(SampleVerification, NamesMayHaveWhatPathsEscape)
{
  const auto passes = [](const std::string& name, const std::string& escaped)
  {
    const std::string scene = R"({ "seed": 7, "objects": [ )" + object("table", "table", "") + ", " +
                              object(name, "brick", R"(, "position": [0.1, 0.75, 0.1])") + " ] }";
    return samples(scene, "brick", escaped).passed();
  };
  EXPECT_TRUE(passes("a/b~c#1", "a~1b~0c#1"));
  EXPECT_TRUE(passes("a~1", "a~01"));
  EXPECT_FALSE(passes("a~1", "a~1"));
}

TEST(SampleVerification, DownIsWhereTheSceneSaysSo)
{
  const std::string lying = R"(, "orientation": [0.7071067811865476, 0.7071067811865476, 0, 0])";
  const auto above = [&](double height)
  {
    return samples(
      R"({ "seed": 7, "upAxis": "z", "objects": [ )" + object("table", "table", lying) + ", " +
      object("brick", "brick", lying + R"(, "position": [0.1, -0.1, )" + std::to_string(0.75 + height) + "]") + " ] }");
  };
  EXPECT_TRUE(above(0.0003).passed());
  EXPECT_NEAR(residual(above(0.0003), "gap").largest, 0.6, 1e-9);
  EXPECT_FALSE(above(0.0007).passed());
}

TEST(SampleVerification, WhatAnObjectCarriesIsOneWithIt)
{
  const auto with = [](const std::string& parent)
  {
    const std::string second = R"(, "position": [0.01, 0.01, 0])" + parent;
    return samples(R"({ "seed": 7, "objects": [ )" + object("table", "table", "") + ", " +
                   object("brick", "brick", R"(, "position": [0.1, 0.7503, 0.1])") + ", " +
                   object("second", "brick", second) + " ] }");
  };
  EXPECT_TRUE(with(R"(, "parent": "brick")").passed()) << "within the first one";
  EXPECT_TRUE(with("").passed()) << "far below, at the table's foot";
  const VerificationReport there = samples(R"({ "seed": 7, "objects": [ )" + object("brick", "brick", "") + ", " +
                                           object("second", "brick", R"(, "position": [0.01, 0.01, 0])") + " ] }");
  EXPECT_FALSE(there.passed());
  EXPECT_EQ(there.firstBreach()->check, "penetration");
}

TEST(SampleVerification, OthersStandWhereTheyAreAtFirstAndWhatFellLiesWhereItIsAtLast)
{
  const auto moving = [](const std::string& first, const std::string& last)
  { return R"(, "position": { "keys": [[2, [)" + first + "]], [5, [" + last + "]]] }"; };
  const auto passes = [&](const std::string& brick, const std::string& other, const std::string& frames)
  {
    return samples(R"({ "seed": 7, "objects": [ )" + object("table", "table", "") + ", " +
                     object("brick", "brick", brick) + ", " + object("other", "brick", other) + " ] }",
      R"("gap": 0)", R"("gap": 0)" + frames)
      .passed();
  };
  const std::string fell = R"(, "frames": 4)";
  const std::string rest = "0.1, 0.7503, 0.1";
  const std::string away = "3, 0, 3";
  const std::string lying = R"(, "position": [)" + rest + "]";
  const std::string within = "0.11, 0.7603, 0.1";
  EXPECT_TRUE(passes(lying, moving(away, within), fell));
  EXPECT_FALSE(passes(lying, moving(within, away), fell));
  EXPECT_TRUE(passes(moving("0.1, 2, 0.1", rest), moving(away, "0, 0.76, 0.1"), fell));
  EXPECT_FALSE(passes(moving(rest, "0.1, 2, 0.1"), "", fell));
  const std::string turning = lying + R"(, "orientation": { "keys": [[2, [1, 0, 0, 0]], [5, [0.6, 0.8, 0, 0]]] })";
  EXPECT_TRUE(passes(turning, moving(away, away), "")) << "what was put";
  EXPECT_FALSE(passes(turning, moving(away, away), fell));
}

TEST(SampleVerification, TheRecordAgreesWithItselfAndItsFiles)
{
  const char* const words[][2] = { { R"("first": 0)", R"("first": 1)" }, { R"("last": 0)", R"("last": 1)" },
    { R"("last": 0)", R"("last": -1)" }, { R"("sample": 0)", R"("sample": 1)" }, { R"("seed": 7)", R"("seed": 8)" },

    { R"("file": "000000.json")", R"("refused": { "why": "" })" },
    { R"("seed": 7)", R"("seed": 7, "refused": { "why": "it fell" })" },
    { R"("penetration": 0)", R"("penetration": 0.0006)" }, { R"("penetration": 0)", R"("penetration": -0.0001)" },
    { R"("gap": 0)", R"("gap": 0.0006)" } };
  for (const auto& [word, instead] : words)
  {
    const VerificationReport report = bricks(0, word, instead);
    ASSERT_FALSE(report.passed()) << instead;
    EXPECT_EQ(report.firstBreach()->check, "record") << instead;
    EXPECT_EQ(report.firstBreach()->worst.file, "samples.json") << instead;
  }
  EXPECT_THROW(bricks(0, R"("complete": true)", R"("complete": false)"), InputError);
  EXPECT_TRUE(bricks(0, R"("file": "000000.json")", R"("refused": { "why": "it fell" })").passed());
}

TEST(SampleVerification, NothingOutsideOfTheFolderIsOpened)
{
  for (const char* file : { "../000000.json", "/dev/null", "000001.json" })
  {
    EXPECT_THROW(bricks(0, "000000.json", file), InputError) << file;
  }
}

TEST(SampleVerification, ARecordThatCannotBeReadIsNamedInPlainWords)
{
  const std::string first = R"("first": 0)";
  const std::pair<std::string, const char*> words[] = {
    { R"("first": "0")", ": a value has the wrong type (expected the type number, found string)" },
    { R"("first": tru)", ":1: is not valid JSON (expected a value, found 'tru,')" },
    { R"("first": 1e400)",
      ": number cannot be used (expected a number within the range of double precision, found '1e400')" },
    { R"("one": 0)", ": cannot be used: key 'first' not found" },
    { first + std::string(1, '\0'), ": cannot be used: it has a character 0" },
  };
  for (const auto& [instead, why] : words)
  {
    const std::string said = test::thrownBy<InputError>([&, &word = instead] { bricks(0, first, word); });
    EXPECT_NE(said.find(std::string("samples.json") + why), std::string::npos) << said;
    EXPECT_EQ(said.find("exception"), std::string::npos) << said;
  }
}
