// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFile.h"
#include "dgtkSystem.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using namespace dgtk;
using namespace dgtk::test;
namespace fs = std::filesystem;

TEST(System, ThreadsOfTheMachine)
{
  EXPECT_GE(machineThreads(), 1);
  EXPECT_EQ(machineThreads(1), 1);
  EXPECT_LE(machineThreads(2), 2);
}

TEST(System, TheHeapHasLargePages)
{
  const bool prepared = prepareHeap();
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  EXPECT_EQ(prepared, fs::exists("/sys/kernel/mm/transparent_hugepage"));
#endif
  const std::vector<char> block(std::size_t(16) << 20);
  const auto at = reinterpret_cast<std::uintptr_t>(block.data() + block.size() / 2);
  std::ifstream areas("/proc/self/smaps");
  bool isHere = false;
  std::string flags;
  for (std::string line; flags.empty() && std::getline(areas, line);)
  {
    unsigned long from = 0;
    unsigned long to = 0;
    if (std::sscanf(line.c_str(), "%lx-%lx ", &from, &to) == 2)
    {
      isHere = from <= at && at < to;
    }
    flags = isHere && line.rfind("VmFlags:", 0) == 0 ? line + ' ' : flags;
  }
  ASSERT_NE(flags, "");
  EXPECT_EQ(flags.find(" hg ") != std::string::npos, prepared) << flags;
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
