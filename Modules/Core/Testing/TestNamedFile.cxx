// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkNamedFile.h"
#include "dgtkTestSupport.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include <sys/stat.h>
#include <unistd.h>

using namespace dgtk;
using namespace dgtk::test;
namespace fs = std::filesystem;

namespace
{
/// Root may write everything: while it lives, one who is not.
class OrdinaryUser
{
public:
  OrdinaryUser()
  {
    constexpr uid_t nobody = 65534;
    EXPECT_TRUE(this->Before != 0 || ::seteuid(nobody) == 0);
  }
  ~OrdinaryUser() { EXPECT_EQ(::seteuid(this->Before), 0); }
  OrdinaryUser(const OrdinaryUser&) = delete;
  OrdinaryUser& operator=(const OrdinaryUser&) = delete;

private:
  uid_t Before = ::geteuid();
};

mode_t modeOf(const std::string& path)
{
  struct stat info = {};
  EXPECT_EQ(::stat(path.c_str(), &info), 0) << path;
  return info.st_mode & 07777;
}
} // namespace

TEST(NamedFile, LinksStayAndWhatTheyLeadToIsWritten)
{
  const TemporaryFolder folder;
  fs::create_directory(folder.path("in"));
  fs::create_symlink("in/real", folder.path("relative"));
  fs::create_symlink(folder.path("in/real"), folder.path("absolute"));
  fs::create_symlink("../relative", folder.path("in/second"));
  int count = 0;
  for (const char* name : { "relative", "absolute", "in/second" }) // the first one leads to nothing
  {
    const std::string text = std::to_string(++count);
    writeNamedFile(folder.path(name), text);
    EXPECT_TRUE(fs::is_symlink(folder.path(name))) << name;
    EXPECT_FALSE(fs::is_symlink(folder.path("in/real"))) << name;
    EXPECT_EQ(contentsOf(folder.path("in/real")), text) << name;
  }
  EXPECT_EQ(linkedPath(folder.path("in/real")), folder.path("in/real"));
  EXPECT_FALSE(fs::exists(folder.path("in/real.partial")));
}

TEST(NamedFile, LinksInACircleAreRefused)
{
  const TemporaryFolder folder;
  fs::create_symlink("b", folder.path("a"));
  fs::create_symlink("a", folder.path("b"));
  EXPECT_EQ(thrownBy<MachineError>([&] { writeNamedFile(folder.path("a"), "x"); }),
    folder.path("a") + ": cannot be written: Too many levels of symbolic links");
  EXPECT_TRUE(fs::is_symlink(folder.path("a")));
}

TEST(NamedFile, NoLinkLeadsToADevice)
{
  const TemporaryFolder folder;
  for (const char* device : { "/dev/stdout", "/dev/null" })
  {
    fs::create_symlink(device, folder.path("x"));
    EXPECT_THAT(thrownBy<MachineError>([&] { writeNamedFile(folder.path("x"), "x"); }),
      testing::HasSubstr("cannot be written: is not a file"));
    EXPECT_TRUE(fs::is_symlink(folder.path("x")));
    fs::remove(folder.path("x"));
  }
}

TEST(NamedFile, AFileKeepsItsMode)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("x");
  writeFile(path, "before");
  const mode_t usual = modeOf(path);
  for (const mode_t mode : { 0600, 0640, 0666, 0755 })
  {
    ASSERT_EQ(::chmod(path.c_str(), mode), 0);
    writeNamedFile(path, "after");
    EXPECT_EQ(modeOf(path), mode);
  }
  EXPECT_EQ(contentsOf(path), "after");
  writeNamedFile(folder.path("new"), "");
  EXPECT_EQ(modeOf(folder.path("new")), usual);
}

TEST(NamedFile, WhatIsReadOnlyIsRefused)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("x");
  ASSERT_EQ(::chmod(folder.path().c_str(), 0777), 0); // it is the file that refuses
  writeFile(path, "before");
  ASSERT_EQ(::chmod(path.c_str(), 0444), 0);
  fs::create_symlink("x", folder.path("link"));
  const OrdinaryUser user;
  for (const char* name : { "x", "link" })
  {
    EXPECT_EQ(thrownBy<MachineError>([&] { writeNamedFile(folder.path(name), "after"); }),
      folder.path(name) + ": cannot be written: is read-only");
  }
  EXPECT_EQ(contentsOf(path), "before");
  writeNamedFile(folder.path("other"), "after");
  EXPECT_EQ(contentsOf(folder.path("other")), "after");
}
