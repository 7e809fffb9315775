// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkAgainError.h"
#include "dgtkError.h"
#include "dgtkFile.h"
#include "dgtkHash.h"
#include "dgtkTestSupport.h"
#include "dgtkThreadPool.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <deque>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>
#include <thread>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>

using dgtk::test::contentsOf;
using dgtk::test::TemporaryFolder;

namespace
{
/// How many descriptors the process may have while it lives.
class DescriptorLimit
{
public:
  explicit DescriptorLimit(rlim_t most)
  {
    EXPECT_EQ(::getrlimit(RLIMIT_NOFILE, &this->Before), 0);
    const struct rlimit limit = { most, this->Before.rlim_max };
    EXPECT_EQ(::setrlimit(RLIMIT_NOFILE, &limit), 0);
  }
  ~DescriptorLimit() { ::setrlimit(RLIMIT_NOFILE, &this->Before); }
  DescriptorLimit(const DescriptorLimit&) = delete;
  DescriptorLimit& operator=(const DescriptorLimit&) = delete;

private:
  struct rlimit Before = {};
};
} // namespace

TEST(Hash, PublishedVectors) // FIPS 180-4 examples
{
  dgtk::Sha256 empty;
  EXPECT_EQ(empty.hex(), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  dgtk::Sha256 abc;
  abc.update("a", 1);
  abc.update("bc", 2);
  EXPECT_EQ(abc.hex(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(AtomicFile, AppearsOnlyWhenWhole)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("x.txt");
  dgtk::writeFile(path, "before");
  {
    dgtk::AtomicFile file(path);
    file.write("half");
  }
  EXPECT_EQ(contentsOf(path), "before");
  dgtk::writeFile(path, "after");
  EXPECT_EQ(contentsOf(path), "after");
  EXPECT_EQ(
    std::distance(std::filesystem::directory_iterator(folder.path()), std::filesystem::directory_iterator()), 1);
}

TEST(AtomicFile, WritesAtOffsets)
{
  const TemporaryFolder folder;
  dgtk::AtomicFile file(folder.path("x"));
  file.write("abcdef");
  file.writeAt(2, "XY", 2);
  file.write("g");
  file.commit();
  EXPECT_EQ(contentsOf(folder.path("x")), "abXYefg");
}

TEST(AtomicFile, FailureNamesTheFile)
{
  EXPECT_THAT(dgtk::test::thrownBy<dgtk::MachineError>([&] { dgtk::writeFile("/proc/nowhere/x", ""); }),
    testing::HasSubstr("/proc/nowhere/x: cannot be written"));
}

TEST(AtomicFile, ReplacesLinksAndWritesThroughNone)
{
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path("theirs"), "theirs");
  for (const char* name : { "x", "x.partial" })
  {
    fs::create_symlink("theirs", folder.path(name));
    dgtk::writeFile(folder.path("x"), "ours");
    EXPECT_EQ(contentsOf(folder.path("theirs")), "theirs");
    EXPECT_FALSE(fs::is_symlink(folder.path("x")));
    fs::remove(folder.path("x"));
    fs::create_hard_link(folder.path("theirs"), folder.path(name));
    dgtk::writeFileDurably(folder.path("x"), "ours");
    EXPECT_EQ(contentsOf(folder.path("theirs")), "theirs");
    EXPECT_EQ(contentsOf(folder.path("x")), "ours");
    fs::remove(folder.path("x"));
  }
  fs::create_directory(folder.path("in"));
  fs::create_symlink("in", folder.path("link"));
  EXPECT_THROW(dgtk::writeFile({ folder.path(), "link/x" }, ""), dgtk::MachineError);
  EXPECT_TRUE(fs::is_empty(folder.path("in")));
  dgtk::writeFile(folder.path("link/x"), "the path is somebody's own"); // as the system walks
  EXPECT_TRUE(fs::exists(folder.path("in/x")));
}

TEST(AtomicFile, MoreTogetherThanDescriptors)
{
  constexpr rlim_t few = 64;
  const DescriptorLimit limit(few);
  const TemporaryFolder folder;
  std::deque<dgtk::AtomicFile> files;
  for (std::size_t i = 0; i < 3 * few; ++i)
  {
    files.emplace_back(folder.path(std::to_string(i)));
  }
  for (const char* text : { "one ", "two ", "three" })
  {
    for (dgtk::AtomicFile& file : files)
    {
      file.write(text);
    }
  }
  for (dgtk::AtomicFile& file : files)
  {
    file.writeAt(0, "O", 1);
    file.commit();
  }
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    EXPECT_EQ(contentsOf(folder.path(std::to_string(i))), "One two three");
  }
}

TEST(AtomicFile, IsWrittenByOneAtATime)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("x");
  {
    dgtk::AtomicFile first(path);
    first.write("first");
    EXPECT_EQ(dgtk::test::thrownBy<dgtk::AgainError>([&] { dgtk::writeFile(path, ""); }),
      path + ": another process is writing it");
    first.commit();
  }
  EXPECT_EQ(contentsOf(path), "first");
  dgtk::AtomicFile(path).write("given up");
  dgtk::writeFile(path, "second");
  EXPECT_EQ(contentsOf(path), "second");
}

TEST(AtomicFile, ReplacesWhatWasLeftButNotWhatIsLocked)
{
  const TemporaryFolder folder;
  const std::string partial = folder.path("x.partial");
  std::ofstream(partial) << "of one who was killed";
  {
    const dgtk::FileDescriptor other(::open(partial.c_str(), O_RDONLY | O_CLOEXEC));
    ASSERT_EQ(::flock(other.number(), LOCK_EX | LOCK_NB), 0);
    EXPECT_THROW(dgtk::writeFile(folder.path("x"), "x"), dgtk::AgainError);
    EXPECT_EQ(contentsOf(partial), "of one who was killed");
  }
  dgtk::writeFile(folder.path("x"), "x");
  EXPECT_EQ(contentsOf(folder.path("x")), "x");
  EXPECT_FALSE(std::filesystem::exists(partial));
}

TEST(AtomicFile, GivesItsNameToNothingElse)
{
  const TemporaryFolder folder;
  const std::string path = folder.path("x");
  const DescriptorLimit limit(64);
  std::deque<dgtk::AtomicFile> kept;
  for (int i = 0; i < 32; ++i)
  {
    kept.emplace_back(folder.path(std::to_string(i)));
  }
  dgtk::AtomicFile file(path); // closed between writes, and not locked then
  file.write("whole");
  dgtk::writeFile(path, "of another one");
  std::ofstream(folder.path("x.partial")) << "half";
  EXPECT_THROW(file.commit(), dgtk::MachineError);
  EXPECT_EQ(contentsOf(path), "of another one");
}

TEST(AtomicFile, ReplacesNoDeviceAndNoPipe)
{
  namespace fs = std::filesystem;
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo(folder.path("pipe").c_str(), 0600), 0);
  fs::create_symlink("/proc/self/fd/1", folder.path("stdout"));
  for (const char* name : { "pipe", "stdout" })
  {
    const fs::file_type before = fs::symlink_status(folder.path(name)).type();
    EXPECT_EQ(dgtk::test::thrownBy<dgtk::MachineError>([&] { dgtk::writeFile(folder.path(name), "x"); }),
      folder.path(name) + ": cannot be written: is not a file");
    EXPECT_EQ(fs::symlink_status(folder.path(name)).type(), before) << name;
    EXPECT_FALSE(fs::exists(folder.path(name + std::string(".partial"))));
  }
}

TEST(ReadFile, WithoutDescriptorsTheMachineIsToBlame)
{
  const TemporaryFolder folder;
  dgtk::writeFile(folder.path("x"), "x");
  const DescriptorLimit none(0);
  EXPECT_EQ(dgtk::test::thrownBy<dgtk::MachineError>([&] { dgtk::readFile(folder.path("x")); }),
    folder.path("x") + ": cannot be read: Too many open files");
}

TEST(ReadFile, RefusesFoldersAndMissingFiles)
{
  EXPECT_THROW(dgtk::readFile("/tmp"), dgtk::InputError);
  EXPECT_THROW(dgtk::readFile("/no/such/file"), dgtk::InputError);
}

TEST(InputError, SaysWhereAndWhat)
{
  EXPECT_STREQ(dgtk::InputError("a.ac", 3, "bad number", "a float", dgtk::quoted("x\n")).what(),
    "a.ac:3: bad number (expected a float, found 'x\\x0A')");
  EXPECT_STREQ(dgtk::InputError("a.ac", "is empty").what(), "a.ac: is empty");
  const dgtk::InputError outside("/usr/../etc/../x.ac", 1, "is bad");
  EXPECT_STREQ(outside.what(), "/x.ac:1: is bad");
  EXPECT_EQ(outside.file(), "/usr/../etc/../x.ac");
}

TEST(ThreadPool, RunsEveryIndexOnceAlsoFromAJob)
{
  dgtk::ThreadPool pool(2);
  std::atomic<int> sum{ 0 };
  pool.submit([&] { pool.parallelFor(1000, [&](int i) { sum += i; }); }).get();
  EXPECT_EQ(sum, 499500);
}

TEST(ThreadPool, HasAsManyThreadsAsAskedWithTheOneThatWaits)
{
  for (const int threads : { 1, 2, 3 })
  {
    dgtk::ThreadPool pool(threads);
    std::mutex mutex;
    std::set<std::thread::id> seen;
    for (int round = 0; round < 20; ++round)
    {
      pool.parallelFor(8,
        [&](int)
        {
          const std::lock_guard<std::mutex> lock(mutex);
          seen.insert(std::this_thread::get_id());
        });
    }
    EXPECT_LE(int(seen.size()), threads);
    EXPECT_EQ(pool.threads(), threads);
  }
}

TEST(ThreadPool, RethrowsTheFirstFailure)
{
  dgtk::ThreadPool pool(2);
  EXPECT_THROW(pool.parallelFor(10,
                 [](int i)
                 {
                   if (i % 2)
                     throw dgtk::UsageError("odd");
                 }),
    dgtk::UsageError);
}
