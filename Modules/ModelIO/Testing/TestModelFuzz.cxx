// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkModelChecks.h"
#include "dgtkModelSeeds.h"

#include <gtest/gtest.h>

using namespace dgtk::test;

namespace
{
std::vector<std::string> with(std::vector<std::string> seeds, const std::vector<std::string>& more)
{
  seeds.insert(seeds.end(), more.begin(), more.end());
  return seeds;
}
} // namespace

TEST(ModelFuzz, Ac3d) { fuzzReader("ac", { ac3dSeed() }); }
TEST(ModelFuzz, Md2) { fuzzReader("md2", { md2Seed().bytes() }); }
TEST(ModelFuzz, Studio3ds) { fuzzReader("3ds", { seed3ds() }); }

TEST(ModelFuzz, RealAc3d) { fuzzReader("ac", with({ ac3dSeed() }, extraSeeds("ac"))); }
TEST(ModelFuzz, RealMd2) { fuzzReader("md2", with({ md2Seed().bytes() }, extraSeeds("md2"))); }
TEST(ModelFuzz, Real3ds) { fuzzReader("3ds", with({ seed3ds() }, extraSeeds("3ds"))); }
