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

/// A folder of one sample: a brick at a height over the table's top, turned a little about the vertical. A word of its
/// record is replaced.
VerificationReport bricks(double above, const std::string& word = "", const std::string& instead = "")
{
  const test::TemporaryFolder folder;
  const std::string scene =
    R"({ "seed": 7, "objects": [ { "name": "table", "model": ")" + test::sourceFile("Data/Models/table.ac") +
    R"(" }, { "name": "brick", "model": ")" + test::sourceFile("Data/Models/brick.ac") +
    R"(", "orientation": [0.98, 0, 0.2, 0], "position": [0.1, )" + std::to_string(0.75 + above) + ", 0.1] } ] }";
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
  EXPECT_TRUE(surfacesCross(box({ -0.2, 0.5001, -0.3 }, { 0.8, 1.4, 0.7 }), cube, { 0, -0.001, 0 }));
}

TEST(SampleVerification, SeesWhatHoversAndWhatSinks)
{
  EXPECT_TRUE(bricks(0.0003).passed());
  EXPECT_LE(residual(bricks(0.0003), "gap").largest, 0.75);
  EXPECT_GE(residual(bricks(0.0003), "gap").largest, 0.5);
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
  EXPECT_TRUE(
    bricks(0, R"("complete": true, "first": 0, "last": 0)", R"("complete": false, "first": 0, "last": 3)").passed());
  EXPECT_FALSE(
    bricks(0, R"("complete": true, "first": 0, "last": 0)", R"("complete": false, "first": 0, "last": -1)").passed());
  EXPECT_TRUE(bricks(0, R"("file": "000000.json")", R"("refused": { "why": "it fell" })").passed());
}

TEST(SampleVerification, NothingOutsideOfTheFolderIsOpened)
{
  for (const char* file : { "../000000.json", "/dev/null", "000001.json" })
  {
    EXPECT_THROW(bricks(0, "000000.json", file), InputError) << file;
  }
}
