// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelChecks.h"
#include "dgtkModelSeeds.h"

#include <gtest/gtest.h>

using namespace dgtk::test;

namespace
{
/// Small real files; without them there is nothing that the made ones do not try.
void fuzzReal(const std::string& extension)
{
  const std::vector<std::string> seeds = extraSeeds(extension);
  if (seeds.empty())
  {
    GTEST_SKIP() << withoutExtraModels;
  }
  fuzzReader(extension, seeds);
}
} // namespace

TEST(ModelFuzz, Ac3d) { fuzzReader("ac", { ac3dSeed() }); }
TEST(ModelFuzz, Md2) { fuzzReader("md2", { md2Seed().bytes() }); }
TEST(ModelFuzz, Studio3ds) { fuzzReader("3ds", { seed3ds() }); }

TEST(ModelFuzz, RealAc3d) { fuzzReal("ac"); }
TEST(ModelFuzz, RealMd2) { fuzzReal("md2"); }
TEST(ModelFuzz, Real3ds) { fuzzReal("3ds"); }
