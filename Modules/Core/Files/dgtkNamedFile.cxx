// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkNamedFile.h"

#include "dgtkError.h"
#include "dgtkFile.h"

#include <cerrno>
#include <cstring>
#include <filesystem>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace dgtk
{

namespace
{
constexpr mode_t modeBits = 0777;

[[noreturn]] void fail(const std::string& path, const char* why)
{
  throw MachineError(path + ": cannot be written: " + why);
}

/// Before anything is written, so that nobody reads what the mode keeps from him.
void setMode(const std::string& path, const AtomicFile& file, mode_t mode)
{
  const FilePlace place(file.temporaryPath());
  const FileDescriptor opened = place.folder().open(place.name(), O_RDWR);
  struct stat info = {};
  if (!opened || ::fstat(opened.number(), &info) != 0 ||
      ((info.st_mode & modeBits) != mode && ::fchmod(opened.number(), mode) != 0))
  {
    fail(path, std::strerror(errno));
  }
}
} // namespace

std::string linkedPath(const std::string& path)
{
  namespace fs = std::filesystem;
  constexpr int mostLinks = 40; // as the system
  fs::path at = path;
  for (int links = 0; links <= mostLinks; ++links)
  {
    std::error_code code;
    const fs::path next = fs::read_symlink(at, code);
    if (code || next.string().rfind("/proc/", 0) == 0) // of a descriptor, as /dev/stdout is: no file's name
    {
      return at.string();
    }
    at = at.parent_path() / next;
  }
  fail(path, std::strerror(ELOOP));
}

void writeNamedFile(const std::string& path, const std::string& contents)
{
  const std::string target = linkedPath(path);
  struct stat info = {};
  const bool there = ::stat(target.c_str(), &info) == 0 && S_ISREG(info.st_mode);
  if (there && ::faccessat(AT_FDCWD, target.c_str(), W_OK, AT_EACCESS) != 0)
  {
    fail(path, "is read-only");
  }
  AtomicFile file(target);
  if (there)
  {
    setMode(path, file, info.st_mode & modeBits);
  }
  file.write(contents);
  file.commitDurably();
}

} // namespace dgtk
