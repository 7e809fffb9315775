// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkSystem.h"

#include "dgtkError.h"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <thread>

#include <fcntl.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

namespace dgtk
{

namespace fs = std::filesystem;

int machineThreads(int most) { return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, most); }

void holdStandardStreams()
{
  for (const int stream : { STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO })
  {
    if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF)
    {
      // The lowest number that is free is this one. Opened for the other direction, its use is an error as it was.
      static_cast<void>(::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
    }
  }
}

bool prepareHeap()
{
  constexpr int mebibyte = 1 << 20;
  constexpr std::uintptr_t largePage = 2 * mebibyte;
  ::mallopt(M_MMAP_THRESHOLD, 32 * mebibyte);
  ::mallopt(M_TRIM_THRESHOLD, 256 * mebibyte);
  for (const auto kind : { RLIMIT_AS, RLIMIT_DATA })
  {
    struct rlimit limit = {};
    if (::getrlimit(kind, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY)
    {
      return false; // what is reserved here would be missed elsewhere
    }
  }
  ::mallopt(M_TOP_PAD, 192 * mebibyte);
  const auto heapEnd = [] { return static_cast<char*>(::sbrk(0)); };
  char* const before = heapEnd();
  char* const begin = before + (largePage - reinterpret_cast<std::uintptr_t>(before) % largePage) % largePage;
  void* volatile grown = std::malloc(mebibyte); // more than a heap begins with
  std::free(grown);
  ::mallopt(M_TOP_PAD, 32 * mebibyte); // threads' arenas keep as much, too
  char* const end = heapEnd();
  return end > begin && ::madvise(begin, std::size_t(end - begin), MADV_HUGEPAGE) == 0;
}

bool isProgram(const std::string& path)
{
  std::error_code code;
  return fs::is_regular_file(path, code) && ::access(path.c_str(), X_OK) == 0;
}

std::string programOnPath(const std::string& name)
{
  const char* const path = std::getenv("PATH");
  const std::string folders = path ? path : "";
  for (std::size_t begin = 0; begin <= folders.size();)
  {
    const std::size_t colon = std::min(folders.find(':', begin), folders.size());
    const std::string folder = folders.substr(begin, colon - begin);
    const std::string program = (folder.empty() ? "." : folder) + '/' + name;
    if (isProgram(program))
    {
      return fs::absolute(program).string();
    }
    begin = colon + 1;
  }
  return {};
}

ScratchFolder::~ScratchFolder()
{
  std::error_code ignored;
  if (!this->Path.empty())
  {
    fs::remove_all(this->Path, ignored);
  }
}

const std::string& ScratchFolder::path()
{
  if (this->Path.empty())
  {
    std::string name = (fs::temp_directory_path() / "dgtk-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr)
    {
      throw MachineError(name + ": cannot be made: " + std::strerror(errno));
    }
    this->Path = name;
  }
  return this->Path;
}

} // namespace dgtk
