// SPDX-License-Identifier: BSD-3-Clause
// Whether a file may have changed since its hash was taken.
#include "dgtkFile.h"
#include "dgtkHash.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>

#include <fcntl.h>
#include <sys/stat.h>

namespace
{
using dgtk::FileAge;
using dgtk::hashOfFile;
using dgtk::Sha256;
using dgtk::test::TemporaryFolder;

constexpr std::int64_t second = 1'000'000'000;

/// Sets when the contents changed; its state changes now.
void setTime(const std::string& path, std::int64_t seconds, long nanoseconds)
{
  const timespec times[2] = { { 0, UTIME_OMIT }, { seconds, nanoseconds } };
  ASSERT_EQ(::utimensat(AT_FDCWD, path.c_str(), times, 0), 0);
}
} // namespace

TEST(FileAge, IsOfRegularFilesOnly)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("x");
  EXPECT_FALSE(FileAge(path).isFile());
  EXPECT_FALSE(FileAge(folder.path()).isFile());
  dgtk::writeFile(path, "12345");
  EXPECT_TRUE(FileAge(path).isFile());
  EXPECT_EQ(FileAge(path).bytes(), 5);
  std::filesystem::create_symlink("x", folder.path("link"));
  EXPECT_TRUE(FileAge(folder.path("link")) == FileAge(path));
}

TEST(FileAge, ChangesWithWhatIsWrittenAndWithItsPlace)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("x");
  dgtk::writeFile(path, "12345");
  const FileAge first(path);
  EXPECT_TRUE(first == FileAge(path));
  setTime(path, 1000, 7);
  const FileAge older(path);
  EXPECT_FALSE(older == first);
  setTime(path, 1000, 8);
  EXPECT_FALSE(older == FileAge(path));
  dgtk::writeFile(folder.path("other"), "12345");
  EXPECT_FALSE(FileAge(folder.path("other")) == FileAge(path));
}

TEST(FileAge, IsOlderOnlyByMoreThanAStepOfTheFileSystemsClock)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("x");
  dgtk::writeFile(path, "1");
  const std::int64_t beyond = dgtk::timeOfFiles() / second + 86400; // later than any change of the file's state
  setTime(path, beyond, 500'000'000);
  const std::int64_t half = beyond * second + second / 2;
  EXPECT_FALSE(FileAge(path).isOlderThan(half));
  EXPECT_FALSE(FileAge(path).isOlderThan(half + second / 100));
  EXPECT_FALSE(FileAge(path).isOlderThan(half + second / 80)); // to the step itself
  EXPECT_TRUE(FileAge(path).isOlderThan(half + second / 80 + 1));
  setTime(path, beyond, 0); // as a file system that counts seconds has it
  EXPECT_FALSE(FileAge(path).isOlderThan(beyond * second + second));
  EXPECT_FALSE(FileAge(path).isOlderThan(beyond * second + 2 * second));
  EXPECT_TRUE(FileAge(path).isOlderThan(beyond * second + 2 * second + 1));
}

/// A state that changed counts as well: contents may be younger than their own time says.
TEST(FileAge, IsAsYoungAsItsState)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("x");
  dgtk::writeFile(path, "1");
  const std::int64_t before = dgtk::timeOfFiles();
  setTime(path, 1000, 7);
  EXPECT_FALSE(FileAge(path).isOlderThan(before));
  EXPECT_TRUE(FileAge(path).isOlderThan(before + 60 * second));
}

TEST(HashOfFile, FollowsWhatIsWrittenAtOnceAndLeavesTheTimeAsItWas)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("x");
  for (const std::string text : { "one", "two", "six", "ten" })
  {
    dgtk::writeFile(path, text);
    setTime(path, 1000, 7);
    EXPECT_EQ(hashOfFile(path), Sha256::of(text));
    EXPECT_EQ(hashOfFile(path), Sha256::ofFile(path));
  }
}
