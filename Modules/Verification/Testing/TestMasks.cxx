// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkMasks.h"

#include "dgtkError.h"
#include "dgtkFile.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <unistd.h>

namespace
{
using namespace dgtk;

class MasksTest : public testing::Test
{
protected:
  std::string write(const std::string& masks)
  {
    writeFile(this->Path, R"({"width": 3, "height": 2, "masks": [)" + masks + "]}");
    return this->Path;
  }
  void TearDown() override { std::filesystem::remove(this->Path); }

private:
  std::string Path = testing::TempDir() + "dgtk-masks-" + std::to_string(::getpid()) + ".json";
};

TEST_F(MasksTest, RunsGoDownTheColumns)
{
  // Outside (0,0); inside (0,1), (1,0); outside (1,1), (2,0); inside (2,1).
  const Masks masks = readMasks(this->write(R"({"id": 7, "counts": [1, 2, 2, 1]})"), 3, 2);
  const bool expected[2][3] = { { false, true, false }, { true, false, true } };
  for (int y = 0; y < 2; ++y)
  {
    for (int x = 0; x < 3; ++x)
    {
      EXPECT_EQ(masks.inside(7, x, y), expected[y][x]) << x << ' ' << y;
      EXPECT_FALSE(masks.inside(8, x, y));
    }
  }
}

TEST_F(MasksTest, DamagedFilesAreRefused)
{
  for (const char* masks : { R"({"id": 7, "counts": [1, 2, 2]})", R"({"id": 7, "counts": [1, 2, 2, 2]})",
         R"({"id": 7, "counts": [18446744073709551615]})", R"({"id": 7, "counts": [-6]})", R"({"counts": [6]})",
         R"({"id": 7, "counts": "6"})" })
  {
    EXPECT_THROW(readMasks(this->write(masks), 3, 2), InputError) << masks;
  }
  EXPECT_THROW(readMasks(this->write(""), 2, 3), InputError);
  EXPECT_THROW(readMasks(this->write("{"), 3, 2), InputError);
}
} // namespace
