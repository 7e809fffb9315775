// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFile.h"

#include "dgtkError.h"

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
struct Descriptor
{
  int number;
  ~Descriptor()
  {
    if (this->number >= 0)
    {
      ::close(this->number);
    }
  }
};
} // namespace

std::string readFile(const std::string& path, std::uint64_t limit)
{
  // O_NONBLOCK: opening a named pipe must not wait for its other end
  const Descriptor file{ ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK) };
  struct stat info = {};
  if (file.number < 0 || ::fstat(file.number, &info) != 0)
  {
    throw InputError(path, 0, std::string("cannot be read: ") + std::strerror(errno));
  }
  if (!S_ISREG(info.st_mode))
  {
    throw InputError(path, 0, "cannot be read", "a file", S_ISDIR(info.st_mode) ? "a directory" : "a device");
  }
  if (std::uint64_t(info.st_size) > limit)
  {
    throw InputError(
      path, 0, "is too large", "at most " + std::to_string(limit) + " bytes", std::to_string(info.st_size) + " bytes");
  }
  std::string contents(static_cast<std::size_t>(info.st_size), '\0');
  std::size_t got = 0;
  while (got < contents.size())
  {
    const ssize_t n = ::read(file.number, &contents[got], contents.size() - got);
    if (n < 0 && errno == EINTR)
    {
      continue;
    }
    if (n < 0)
    {
      throw InputError(path, 0, std::string("cannot be read: ") + std::strerror(errno));
    }
    if (n == 0)
    {
      contents.resize(got);
    }
    got += static_cast<std::size_t>(n);
  }
  return contents;
}

bool writeAll(int descriptor, const void* data, std::size_t bytes)
{
  const char* from = static_cast<const char*>(data);
  while (bytes > 0)
  {
    const ssize_t n = ::write(descriptor, from, bytes);
    if (n < 0 && errno != EINTR)
    {
      return false;
    }
    const std::size_t done = n > 0 ? static_cast<std::size_t>(n) : 0;
    from += done;
    bytes -= done;
  }
  return true;
}

AtomicFile::AtomicFile(const std::string& path)
  : Path(path)
  , Temporary(partialName(path))
  , Descriptor(::open(Temporary.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666))
{
  if (this->Descriptor < 0)
  {
    this->fail("cannot be written");
  }
}

AtomicFile::~AtomicFile()
{
  if (this->Descriptor >= 0)
  {
    ::close(this->Descriptor);
    ::unlink(this->Temporary.c_str());
  }
}

void AtomicFile::fail(const char* what) const
{
  throw MachineError(this->Path + ": " + what + ": " + std::strerror(errno));
}

void AtomicFile::write(const void* data, std::size_t bytes)
{
  if (!writeAll(this->Descriptor, data, bytes))
  {
    this->fail("cannot be written");
  }
}

void AtomicFile::writeAt(std::uint64_t offset, const void* data, std::size_t bytes)
{
  const char* from = static_cast<const char*>(data);
  while (bytes > 0)
  {
    const ssize_t n = ::pwrite(this->Descriptor, from, bytes, static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR)
    {
      continue;
    }
    if (n < 0)
    {
      this->fail("cannot be written");
    }
    from += n;
    offset += static_cast<std::uint64_t>(n);
    bytes -= static_cast<std::size_t>(n);
  }
}

void AtomicFile::commit()
{
  const int number = this->Descriptor;
  this->Descriptor = -1;
  if (::close(number) != 0 || ::rename(this->Temporary.c_str(), this->Path.c_str()) != 0)
  {
    const int reason = errno;
    ::unlink(this->Temporary.c_str());
    errno = reason;
    this->fail("cannot be written");
  }
}

void writeFile(const std::string& path, const std::string& contents)
{
  AtomicFile file(path);
  file.write(contents);
  file.commit();
}

void makeFolders(const std::string& path)
{
  std::error_code code;
  std::filesystem::create_directories(path, code);
  if (code || !std::filesystem::is_directory(path))
  {
    throw MachineError(path + ": the folder cannot be made: " + (code ? code.message() : "a file is in the way"));
  }
}

} // namespace dgtk
