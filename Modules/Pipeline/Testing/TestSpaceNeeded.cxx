// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkDatasetDocuments.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkGenerator.h"
#include "dgtkSpaceNeeded.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

using namespace dgtk;

TEST(SpaceNeeded, IsNeverMoreThanTheFilesAre)
{
  const test::TemporaryFolder folder;
  GeneratorRequest request;
  request.scene = test::sourceFile("Data/Scenes/fig_4_7_stereo.json");
  request.folder = folder.path("d");
  request.layers = { "depth", "objects", "normal", "correspondence", "disparity", "edges" };
  request.options["depth_format"] = "npy,dgd,exr,pfm,png";
  request.width = 64;
  request.height = 48;
  request.options["visibility"] = "ray";
  generate(request);
  std::uint64_t files = 0;
  std::uint64_t raw = 0;
  for (const DatasetFile& file : readManifestIn(request.folder).files)
  {
    files += file.bytes;
    const std::string extension = file.path.substr(file.path.rfind('.') + 1);
    raw += extension == "png" || extension == "exr" || file.layer.empty() ? 0 : file.bytes;
  }
  const std::shared_ptr<const Stage> stage = Stage::load(readScene(request.scene));
  const SpaceNeeded needed = spaceOf(makeWorkPlan(request, *stage), *stage);
  EXPECT_LE(needed.least, files);
  EXPECT_GE(needed.least, raw * 97 / 100); // all but headers
  EXPECT_GE(needed.likely, needed.least);
}

TEST(SpaceNeeded, OfEachFormat)
{
  struct Row
  {
    PixelType type;
    int channels;
    const char* format;
    std::uint64_t least, likely; ///< of 129 x 64 pixels
  };
  constexpr std::uint64_t pixels = 129 * 64; // 8 times 1032
  const Row table[] = { { PixelType::Float64, 3, "npy", 24 * pixels, 24 * pixels },
    { PixelType::UInt8, 1, "npy", pixels, pixels }, { PixelType::Float64, 1, "pfm", 4 * pixels, 4 * pixels },
    { PixelType::Float64, 2, "flo", 8 * pixels, 8 * pixels }, { PixelType::Float64, 1, "dgd", 8 * pixels, 8 * pixels },
    { PixelType::UInt32, 1, "ppm", 3 * pixels, 3 * pixels }, { PixelType::UInt8, 3, "ppm", 3 * pixels, 3 * pixels },
    { PixelType::UInt8, 4, "png", 32, pixels }, { PixelType::Float32, 1, "exr", 8, pixels },
    { PixelType::UInt8, 1, "json", 0, 0 } };
  for (const Row& row : table)
  {
    LayerSpec spec;
    spec.type = row.type;
    spec.channels = row.channels;
    const SpaceNeeded needed = spaceOf(spec, row.format, 129, 64);
    EXPECT_EQ(needed.least, row.least) << row.format;
    EXPECT_EQ(needed.likely, row.likely) << row.format;
  }
}

TEST(SpaceNeeded, IsRefusedOnlyWhenItCannotFit)
{
  const SpaceNeeded needed{ 1000, 5000000000 };
  EXPECT_THROW(checkSpace("d", needed, { 999, true }), MachineError);
  EXPECT_EQ(checkSpace("d", needed, { 999, false }), "d: the dataset needs some 5 GB, and there are 999 bytes");
  EXPECT_EQ(checkSpace("d", needed, { 1000, true }), "d: the dataset needs some 5 GB, and there are 1 KB");
  EXPECT_EQ(checkSpace("d", needed, { 999499, true }), "d: the dataset needs some 5 GB, and there are 999 KB");
  EXPECT_EQ(checkSpace("d", needed, { 999500, true }), "d: the dataset needs some 5 GB, and there are 1 MB");
  EXPECT_EQ(checkSpace("d", needed, { 5000000000, true }), "");
}

TEST(SpaceNeeded, CountsWhatIsReplaced)
{
  constexpr std::uint64_t large = std::uint64_t(1) << 40; // with a hole in place of its contents
  constexpr std::uint64_t all = std::numeric_limits<std::uint64_t>::max();
  const test::TemporaryFolder folder;
  const test::TemporaryFolder other;
  for (const test::TemporaryFolder* in : { &folder, &other })
  {
    writeFile(in->path("x"), "");
    std::filesystem::resize_file(in->path("x"), large);
  }
  std::filesystem::create_symlink(other.path("x"), folder.path("link"));
  const std::uint64_t there = spaceIn(folder.path(), all).bytes;
  const std::uint64_t beneath = spaceIn(folder.path("not/yet/there"), all).bytes;
  EXPECT_GT(beneath, 0u);
  EXPECT_LT(there - beneath, large + large / 2);
  EXPECT_GT(there - beneath, large / 2);
}
