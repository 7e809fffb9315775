// SPDX-License-Identifier: BSD-3-Clause
// What a helper program can still do behind its walls: nothing that it is not handed.
#include "dgtkFile.h"
#include "dgtkHelperWall.h"
#include "dgtkTestSupport.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <string>
#include <thread>

#include <fcntl.h>
#include <netinet/in.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

using dgtk::helper::Opening;

namespace
{
/// Exit status of `deed` in a process that is locked down.
template <class Deed>
int behindTheWall(Opening opening, Deed deed)
{
  const pid_t child = ::fork();
  if (child == 0)
  {
    dgtk::helper::lockDown(opening);
    ::_exit(deed());
  }
  int status = 0;
  EXPECT_EQ(::waitpid(child, &status, 0), child);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

constexpr int denied = 42;

int outcome(long result) { return result < 0 && (errno == EPERM || errno == EACCES) ? denied : 0; }
} // namespace

TEST(HelperFence, ReadsAndWritesWhereItMay)
{
  if (dgtk::helper::isSanitized)
  {
    GTEST_SKIP() << "sanitizers need what the fence forbids";
  }
  const dgtk::test::TemporaryFolder readable;
  const dgtk::test::TemporaryFolder writable;
  const dgtk::test::TemporaryFolder other;
  dgtk::writeFile(readable.path("a"), "a");
  dgtk::writeFile(other.path("a"), "a");
  const auto behindTheFence = [&](const auto& deed)
  {
    const pid_t child = ::fork();
    if (child == 0)
    {
      dgtk::helper::fenceIn({ readable.path() }, writable.path());
      ::_exit(outcome(deed()));
    }
    int status = 0;
    EXPECT_EQ(::waitpid(child, &status, 0), child);
    return WEXITSTATUS(status);
  };
  constexpr int creating = O_WRONLY | O_CREAT;
  EXPECT_EQ(behindTheFence([&] { return ::open(readable.path("a").c_str(), O_RDONLY); }), 0);
  EXPECT_EQ(behindTheFence([&] { return ::open(writable.path("b").c_str(), creating, 0600); }), 0);
  EXPECT_EQ(behindTheFence([&] { return ::open("/dev/null", O_WRONLY); }), 0);
  EXPECT_EQ(behindTheFence([&] { return ::socket(AF_UNIX, SOCK_STREAM, 0); }), 0);
  EXPECT_EQ(behindTheFence([&] { return ::socket(AF_INET, SOCK_STREAM, 0); }), denied);
  EXPECT_EQ(behindTheFence([&] { return ::kill(::getppid(), 0); }), denied);
  if (::syscall(444, nullptr, 0, 1) >= 1) // Landlock
  {
    EXPECT_EQ(behindTheFence([&] { return ::open(other.path("a").c_str(), O_RDONLY); }), denied);
    EXPECT_EQ(behindTheFence([&] { return ::open(readable.path("a").c_str(), O_WRONLY); }), denied);
    EXPECT_EQ(behindTheFence([&] { return ::open(readable.path("b").c_str(), creating, 0600); }), denied);
    EXPECT_EQ(behindTheFence([&] { return ::unlink(readable.path("a").c_str()); }), denied);
  }
}

class HelperWall : public testing::TestWithParam<Opening>
{
protected:
  void SetUp() override
  {
    if (dgtk::helper::isSanitized)
    {
      GTEST_SKIP() << "sanitizers need what the wall forbids";
    }
  }
};

TEST_P(HelperWall, OpensNoFile)
{
  EXPECT_EQ(behindTheWall(GetParam(), [] { return outcome(::open("/etc/passwd", O_RDONLY)); }), denied);
  EXPECT_EQ(behindTheWall(GetParam(), [] { return outcome(::open("/", O_RDONLY | O_DIRECTORY)); }), denied);
  EXPECT_EQ(behindTheWall(GetParam(), [] { return outcome(::open("/proc/self/mem", O_RDWR)); }), denied);
  EXPECT_EQ(
    behindTheWall(GetParam(), [] { return outcome(::syscall(SYS_openat2, AT_FDCWD, "/", nullptr, 0)); }), denied);
}

TEST_P(HelperWall, WritesNoFile)
{
  EXPECT_EQ(behindTheWall(GetParam(), [] { return outcome(::open("wall.txt", O_WRONLY | O_CREAT, 0600)); }), denied);
  EXPECT_EQ(behindTheWall(GetParam(), [] { return outcome(::unlink("wall.txt")); }), denied);
  EXPECT_EQ(behindTheWall(GetParam(), [] { return outcome(::rename("wall.txt", "fall.txt")); }), denied);
  EXPECT_EQ(behindTheWall(GetParam(), [] { return outcome(::mkdir("wall", 0700)); }), denied);
  EXPECT_EQ(behindTheWall(GetParam(), [] { return outcome(::symlink("/", "wall.txt")); }), denied);
}

TEST_P(HelperWall, HasNoNetwork)
{
  for (const int family : { AF_INET, AF_INET6, AF_UNIX, AF_NETLINK })
  {
    EXPECT_EQ(behindTheWall(GetParam(), [family] { return outcome(::socket(family, SOCK_DGRAM, 0)); }), denied);
  }
}

TEST_P(HelperWall, StartsAndSignalsNobody)
{
  EXPECT_EQ(behindTheWall(GetParam(), [] { return outcome(::fork()); }), denied);
  char name[] = "/bin/true";
  char* arguments[] = { name, nullptr };
  EXPECT_EQ(behindTheWall(GetParam(), [&] { return outcome(::execv(name, arguments)); }), denied);
  EXPECT_EQ(behindTheWall(GetParam(), [] { return outcome(::kill(::getppid(), 0)); }), denied);
  EXPECT_EQ(
    behindTheWall(GetParam(), [] { return outcome(::syscall(SYS_tgkill, ::getppid(), ::getppid(), 0)); }), denied);
}

TEST_P(HelperWall, WorksOn)
{
  EXPECT_EQ(behindTheWall(GetParam(),
              []
              {
                int sum = 0;
                std::thread([&sum] { sum = 3; }).join();
                return sum;
              }),
    3);
  EXPECT_EQ(behindTheWall(GetParam(), []() -> int { std::abort(); }), 1000 + SIGABRT);
  const bool opens = GetParam() == Opening::Memory;
  EXPECT_EQ(behindTheWall(GetParam(),
              []
              {
                const int memory = ::memfd_create("wall", MFD_CLOEXEC);
                const std::string path = "/proc/self/fd/" + std::to_string(memory);
                return outcome(::open(path.c_str(), O_RDONLY));
              }),
    opens ? 0 : denied);
}

INSTANTIATE_TEST_SUITE_P(Both, HelperWall, testing::Values(Opening::Nothing, Opening::Memory),
  [](const auto& row) { return row.param == Opening::Nothing ? "Import" : "Picture"; });
