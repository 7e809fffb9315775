// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSampleVerification.h"

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

/// A folder of one sample: a brick at a height over the table's top, turned a little about the vertical.
VerificationReport bricks(double above)
{
  const test::TemporaryFolder folder;
  const std::string scene =
    R"({ "objects": [ { "name": "table", "model": ")" + test::sourceFile("Data/Models/table.ac") +
    R"(" }, { "name": "brick", "model": ")" + test::sourceFile("Data/Models/brick.ac") +
    R"(", "orientation": [0.98, 0, 0.2, 0], "position": [0.1, )" + std::to_string(0.75 + above) + ", 0.1] } ] }";
  writeFile(folder.path("000000.json"), scene);
  writeFile(folder.path("samples.json"),
    R"({ "samples": [ { "sample": 0, "file": "000000.json", "sha256": ")" + hashOfFile(folder.path("000000.json")) +
      R"(", "notes": [ { "path": "objects/brick/place", "kept": true, "attempts": 1, "measured": { "penetration": 0, "gap": 0, "tolerance": 0.0005 } } ] } ] })");
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
