// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkOnDemand.h"
#include "dgtkSystem.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

using namespace dgtk;
using namespace dgtk::test;
namespace fs = std::filesystem;

TEST(System, ThreadsOfTheMachine)
{
  EXPECT_GE(machineThreads(), 1);
  EXPECT_EQ(machineThreads(1), 1);
  EXPECT_LE(machineThreads(2), 2);
}

TEST(System, WhyALibraryIsNotThere)
{
  const std::string said = thrownBy<MachineError>([] { callsOnDemand("dgtkNone"); });
  EXPECT_EQ(said.rfind("the library libdgtkNone.so", 0), 0u) << said;
  EXPECT_NE(said.find(" cannot be loaded: "), std::string::npos) << said;
  EXPECT_NE(said.find("No such file or directory"), std::string::npos) << said;
}

namespace
{
/// Whether the system was asked for large pages around an address ("hg" of its area).
bool hasLargePages(const void* address)
{
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  std::ifstream areas("/proc/self/smaps");
  bool isHere = false;
  for (std::string line; std::getline(areas, line);)
  {
    unsigned long from = 0;
    unsigned long to = 0;
    if (std::sscanf(line.c_str(), "%lx-%lx ", &from, &to) == 2)
    {
      isHere = from <= at && at < to;
    }
    else if (isHere && line.rfind("VmFlags:", 0) == 0)
    {
      return (line + ' ').find(" hg ") != std::string::npos;
    }
  }
  return false;
}

/// Whether the system takes the request.
bool knowsLargePages()
{
  const std::size_t bytes = std::size_t(4) << 20;
  void* const area = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  const bool knows = ::madvise(area, bytes, MADV_HUGEPAGE) == 0 && hasLargePages(area);
  ::munmap(area, bytes);
  return knows;
}

/// 0 when blocks of a heap that was prepared are as it says, 1 when they are not, 2 when there are no large pages.
int prepareAndLook()
{
  const bool prepared = prepareHeap();
  const std::vector<char> block(std::size_t(16) << 20);
  return hasLargePages(block.data() + block.size() / 2) != prepared ? 1 : prepared ? 0 : 2;
}
}

TEST(System, ClosedStreamsAreNoFiles)
{
  const auto look = [](const fs::path& file)
  {
    for (const int stream : { STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO })
    {
      ::close(stream);
    }
    holdStandardStreams();
    char byte = 0;
    const bool isFree = ::open(file.c_str(), O_RDWR | O_CREAT, 0600) > STDERR_FILENO;
    return isFree && ::read(STDIN_FILENO, &byte, 1) < 0 && ::write(STDOUT_FILENO, &byte, 1) < 0 &&
           ::write(STDERR_FILENO, &byte, 1) < 0;
  };
  const TemporaryFolder folder;
  const fs::path file(folder.path("a"));
  GTEST_FLAG_SET(death_test_style, "fast"); // the folder is this process's
  EXPECT_EXIT(std::_Exit(look(file) ? 0 : 1), testing::ExitedWithCode(0), "");
}

TEST(System, TheHeapHasLargePages)
{
  struct rlimit addresses = {};
  struct rlimit data = {};
  ::getrlimit(RLIMIT_AS, &addresses);
  ::getrlimit(RLIMIT_DATA, &data);
  const bool isLimited = addresses.rlim_cur != RLIM_INFINITY || data.rlim_cur != RLIM_INFINITY;
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  const bool isOther = true; // another allocator
#else
  const bool isOther = false;
#endif
  const int expected = !isLimited && !isOther && knowsLargePages() ? 0 : 2;
  GTEST_FLAG_SET(death_test_style, "threadsafe"); // a process whose heap is new, and as users have it
  ::unsetenv("GLIBC_TUNABLES");
  EXPECT_EXIT(std::_Exit(prepareAndLook()), testing::ExitedWithCode(expected), "");
  for (const auto kind : { RLIMIT_AS, RLIMIT_DATA })
  {
    EXPECT_EXIT(
      {
        struct rlimit limit = kind == RLIMIT_AS ? addresses : data;
        limit.rlim_cur = std::min(limit.rlim_max, rlim_t(1) << (isOther ? 50 : 30));
        ::setrlimit(kind, &limit);
        std::_Exit(prepareAndLook());
      },
      testing::ExitedWithCode(2), "");
  }
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
  const fs::path here = fs::current_path();
  fs::current_path(folder.path("a"));
  for (const char* emptyOne : { ":/nowhere", "/nowhere::/nowhere", "/nowhere:" }) // the working folder
  {
    ::setenv("PATH", emptyOne, 1);
    EXPECT_EQ(fs::path(programOnPath("tool")).lexically_normal(), folder.path("a/tool")) << emptyOne;
  }
  fs::current_path(here);
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
