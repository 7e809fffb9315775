// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFile.h"

#include "dgtkError.h"
#include "dgtkWorkTime.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace dgtk
{

std::string readFile(const std::string& path, std::uint64_t limit)
{
  // O_NONBLOCK: opening a named pipe must not wait for its other end
  const FileDescriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  struct stat info = {};
  if (!file || ::fstat(file.number(), &info) != 0)
  {
    throw InputError(path, std::string("cannot be read: ") + std::strerror(errno));
  }
  if (!S_ISREG(info.st_mode))
  {
    throw InputError(path, "cannot be read", "a file", S_ISDIR(info.st_mode) ? "a directory" : "a pipe or device");
  }
  if (std::uint64_t(info.st_size) > limit)
  {
    throw InputError(
      path, "is too large", "at most " + std::to_string(limit) + " bytes", std::to_string(info.st_size) + " bytes");
  }
  std::string contents(static_cast<std::size_t>(info.st_size), '\0');
  std::size_t got = 0;
  while (got < contents.size())
  {
    const ssize_t n = ::read(file.number(), &contents[got], contents.size() - got);
    if (n < 0 && errno == EINTR)
    {
      continue;
    }
    if (n < 0)
    {
      throw InputError(path, std::string("cannot be read: ") + std::strerror(errno));
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

namespace
{
// Files whose descriptors are kept open; the rest of a process needs some, too.
std::atomic<int> keptFiles{ 0 };

int mostKeptFiles()
{
  struct rlimit limit = {};
  constexpr rlim_t most = 1 << 20;
  return ::getrlimit(RLIMIT_NOFILE, &limit) == 0 ? static_cast<int>(std::min(limit.rlim_cur, most) / 2) : 0;
}

bool writeAllAt(int descriptor, std::uint64_t offset, const void* data, std::size_t bytes)
{
  const char* from = static_cast<const char*>(data);
  while (bytes > 0)
  {
    const ssize_t n = ::pwrite(descriptor, from, bytes, static_cast<off_t>(offset));
    if (n < 0 && errno != EINTR)
    {
      return false;
    }
    const std::size_t done = n > 0 ? static_cast<std::size_t>(n) : 0;
    from += done;
    offset += done;
    bytes -= done;
  }
  return true;
}

std::string folderOf(const std::string& path)
{
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : slash == 0 ? "/" : path.substr(0, slash);
}
} // namespace

FilePlace::FilePlace(const std::string& path)
  : Path(path)
  , Holder(folderOf(path))
  , Name(path.substr(path.rfind('/') + 1))
{
}

FilePlace::FilePlace(const std::string& folder, const std::string& name)
  : Path(folder + '/' + name)
  , Holder(folder)
  , Name(name)
{
}

AtomicFile::AtomicFile(const FilePlace& place)
  : Place(place)
  , Temporary(partialName(place.path()))
{
  const std::string name = partialName(place.name());
  this->Descriptor = place.folder().open(name, O_RDWR | O_CREAT | O_EXCL);
  if (!this->Descriptor && errno == EEXIST)
  {
    place.folder().remove(name);
    this->Descriptor = place.folder().open(name, O_RDWR | O_CREAT | O_EXCL);
  }
  if (!this->Descriptor)
  {
    this->fail("cannot be written");
  }
  this->Created = this->identityOf(this->Descriptor);
  this->Kept = keptFiles.fetch_add(1) < mostKeptFiles();
  if (!this->Kept)
  {
    --keptFiles;
    this->Descriptor.close();
  }
}

AtomicFile::~AtomicFile()
{
  if (this->Open)
  {
    this->close();
    try
    {
      this->Place.folder().remove(partialName(this->Place.name()));
    }
    catch (const Error&)
    {
      // nothing that a destructor could do
    }
  }
}

void AtomicFile::fail(const char* what) const
{
  throw MachineError(this->path() + ": " + what + ": " + std::strerror(errno));
}

AtomicFile::Identity AtomicFile::identityOf(const FileDescriptor& file) const
{
  struct stat info = {};
  if (::fstat(file.number(), &info) != 0)
  {
    this->fail("cannot be written");
  }
  return { info.st_dev, info.st_ino };
}

FileDescriptor AtomicFile::reopened() const
{
  FileDescriptor file = this->Place.folder().open(partialName(this->Place.name()), O_RDWR);
  if (!file)
  {
    this->fail("cannot be written");
  }
  const Identity found = this->identityOf(file);
  if (found.device != this->Created.device || found.number != this->Created.number)
  {
    throw MachineError(this->path() + ": cannot be written: somebody else has replaced " + this->Temporary);
  }
  return file;
}

void AtomicFile::close()
{
  this->Open = false;
  keptFiles -= std::exchange(this->Kept, false) ? 1 : 0;
  this->Descriptor.close();
}

void AtomicFile::write(const void* data, std::size_t bytes)
{
  this->writeAt(this->Position, data, bytes);
  this->Position += bytes;
}

void AtomicFile::writeAt(std::uint64_t offset, const void* data, std::size_t bytes)
{
  const WorkTime write(WorkStage::Write);
  FileDescriptor again = this->Kept ? FileDescriptor() : this->reopened();
  const int number = this->Kept ? this->Descriptor.number() : again.number();
  if (!writeAllAt(number, offset, data, bytes) || !again.close())
  {
    this->fail("cannot be written");
  }
}

void AtomicFile::commit() { this->finish(false); }

void AtomicFile::commitDurably() { this->finish(true); }

void AtomicFile::finish(bool durably)
{
  const WorkTime write(WorkStage::Write);
  const std::string partial = partialName(this->Place.name());
  FileDescriptor file = this->Kept ? std::move(this->Descriptor) : durably ? this->reopened() : FileDescriptor();
  constexpr std::uint64_t large = std::uint64_t(1) << 18; ///< what is smaller costs more than it takes
  if (!durably && file && this->Position >= large)
  {
    ::sync_file_range(file.number(), 0, 0, SYNC_FILE_RANGE_WRITE); // on its way, for whoever waits for all files
  }
  const bool whole = (!durably || ::fdatasync(file.number()) == 0) && file.close();
  if (!whole)
  {
    this->fail("cannot be written");
  }
  this->Place.folder().rename(partial, this->Place.name());
  this->close();
  if (durably)
  {
    this->Place.folder().sync(this->Place.name());
  }
}

void writeFile(const FilePlace& place, const std::string& contents)
{
  AtomicFile file(place);
  file.write(contents);
  file.commit();
}

void writeFileDurably(const FilePlace& place, const std::string& contents)
{
  AtomicFile file(place);
  file.write(contents);
  file.commitDurably();
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
