// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFile.h"

#include "dgtkAgainError.h"
#include "dgtkError.h"
#include "dgtkWorkTime.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
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
    if (errno == EMFILE || errno == ENFILE || errno == ENOMEM)
    {
      throw MachineError(path + ": cannot be read: " + std::strerror(errno));
    }
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

/// Whether another process, or another writer of this one, has the file. A file system without locks knows of nobody.
bool isLocked(const FileDescriptor& file)
{
  return ::flock(file.number(), LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
}

bool isUnder(const FileDescriptor& file, const Folder& folder, const std::string& name)
{
  const FileDescriptor found = folder.open(name, O_PATH);
  struct stat own = {};
  struct stat other = {};
  return found && ::fstat(file.number(), &own) == 0 && ::fstat(found.number(), &other) == 0 &&
         own.st_dev == other.st_dev && own.st_ino == other.st_ino;
}

/// One who found the file before it was locked may have removed it.
bool isGone(const FileDescriptor& file, const Folder& folder, const std::string& name)
{
  struct stat info = {};
  return ::fstat(file.number(), &info) == 0 && info.st_nlink == 0 && !isUnder(file, folder, name);
}

/// Removes what stands where a file is to be written, but not what somebody writes. False when somebody does.
bool removeLeft(const Folder& folder, const std::string& name)
{
  const bool file = folder.look(name) == EntryKind::File;
  const FileDescriptor left = file ? folder.open(name, O_RDWR | O_NONBLOCK) : FileDescriptor();
  if (left && (isLocked(left) || !isUnder(left, folder, name)))
  {
    return false;
  }
  folder.remove(name); // while it is locked
  return true;
}

/// A device, a pipe or a socket, or a link to a descriptor, as /dev/stdout is.
bool isNoFile(const FilePlace& place)
{
  namespace fs = std::filesystem;
  const EntryKind kind = place.folder().look(place.name());
  std::error_code code;
  return kind == EntryKind::Other ||
         (kind == EntryKind::Link && fs::read_symlink(place.path(), code).string().rfind("/proc/", 0) == 0);
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
  const Folder& folder = place.folder();
  const std::string name = partialName(place.name());
  const auto create = [&] { this->Descriptor = folder.open(name, O_RDWR | O_CREAT | O_EXCL); };
  create();
  bool ours = true;
  if (!this->Descriptor && errno == EEXIST)
  {
    ours = removeLeft(folder, name);
    if (ours)
    {
      create();
    }
  }
  if (!ours || (this->Descriptor && (isLocked(this->Descriptor) || isGone(this->Descriptor, folder, name))))
  {
    throw AgainError(this->path() + ": another process is writing it");
  }
  if (!this->Descriptor)
  {
    this->fail("cannot be written");
  }
  if (place.name().find('/') == std::string::npos && isNoFile(place)) // somebody's own word
  {
    folder.remove(name);
    throw MachineError(this->path() + ": cannot be written: is not a file");
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
    try
    {
      this->Place.folder().remove(partialName(this->Place.name()));
    }
    catch (const Error&)
    {
      // nothing that a destructor could do
    }
    this->close();
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
  // closing tells whether the file is whole; it stays locked until it has its name
  FileDescriptor file(this->Kept ? ::fcntl(this->Descriptor.number(), F_DUPFD_CLOEXEC, 0) : -1);
  if (!file)
  {
    file = this->Kept ? std::move(this->Descriptor) : this->reopened();
  }
  constexpr std::uint64_t large = std::uint64_t(1) << 18; ///< what is smaller costs more than it takes
  if (!durably && this->Position >= large)
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

bool leadsToOneOf(const std::string& path, const std::vector<std::string>& files)
{
  std::error_code code; // where one is not there
  return std::filesystem::exists(path, code) &&
         std::any_of(files.begin(), files.end(),
           [&](const std::string& file) { return std::filesystem::equivalent(path, file, code); });
}

void refuseInPlaceOf(const std::vector<std::string>& read, const std::string& path)
{
  if (leadsToOneOf(path, read))
  {
    throw UsageError(path + ": is one of the files that are read for it; name another file");
  }
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
