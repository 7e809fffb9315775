// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFile.h"
#include "dgtkSystem.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

using namespace dgtk;
using namespace dgtk::test;
namespace fs = std::filesystem;

TEST(System, ThreadsOfTheMachine)
{
  EXPECT_GE(machineThreads(), 1);
  EXPECT_EQ(machineThreads(1), 1);
  EXPECT_LE(machineThreads(2), 2);
}

TEST(System, ProgramsOnThePath)
{
  const TemporaryFolder folder;
  for (const char* name : { "a", "b", "b/tool" })
  {
    fs::create_directories(folder.path(name));
  }
  writeFile(folder.path("a/tool"), "not to be executed");
  const char* const path = std::getenv("PATH");
  const std::string before = path != nullptr ? path : "";
  ::setenv("PATH", (folder.path("nowhere") + ':' + folder.path("a") + ':' + folder.path("b")).c_str(), 1);
  EXPECT_EQ(programOnPath("tool"), "");
  EXPECT_FALSE(isProgram(folder.path("b/tool"))) << "a folder";
  fs::permissions(folder.path("a/tool"), fs::perms::owner_all);
  EXPECT_EQ(programOnPath("tool"), folder.path("a/tool"));
  EXPECT_TRUE(isProgram(folder.path("a/tool")));
  ::setenv("PATH", before.c_str(), 1);
}

TEST(System, AScratchFolderGoesWithItsOwner)
{
  std::string path;
  {
    ScratchFolder folder;
    path = folder.path();
    writeFile(folder.path("file"), "text");
    EXPECT_EQ(folder.path(), path);
    EXPECT_TRUE(fs::exists(path + "/file"));
  }
  EXPECT_FALSE(fs::exists(path));
}
