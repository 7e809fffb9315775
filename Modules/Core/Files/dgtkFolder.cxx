// SPDX-License-Identifier: BSD-3-Clause
#include "dgtkFolder.h"

#include "dgtkError.h"

#include <atomic>
#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <linux/openat2.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace dgtk
{

namespace
{
std::string leafOf(const std::string& name) { return name.substr(name.rfind('/') + 1); }

/// Calls `visit(part)` for the folders that lead to a name, from the outermost; stops when it returns false.
template <class Visit>
void forEachParent(const std::string& name, Visit visit)
{
  std::size_t begin = 0;
  for (std::size_t slash; (slash = name.find('/', begin)) != std::string::npos; begin = slash + 1)
  {
    if (!visit(name.substr(begin, slash - begin)))
    {
      return;
    }
  }
}

constexpr int folderFlags = O_PATH | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;

/// The folder that leads to a name, in one step, by a system that can refuse links on all of the way. Empty, with
/// errno: ENOSYS where it cannot.
FileDescriptor holderAtOnce(const FileDescriptor& top, const std::string& name)
{
  static std::atomic<bool> unknown{ false };
  if (unknown)
  {
    errno = ENOSYS;
    return FileDescriptor();
  }
  struct open_how how = {};
  how.flags = folderFlags;
  how.resolve = RESOLVE_NO_SYMLINKS;
  const std::string way = name.substr(0, name.rfind('/'));
  const long found = ::syscall(SYS_openat2, top.number(), way.c_str(), &how, sizeof how);
  if (found < 0 && (errno == EPERM || errno == EINVAL || errno == E2BIG || errno == ENOSYS))
  {
    unknown = true; // an old system, or one that is fenced in
    errno = ENOSYS;
  }
  return FileDescriptor(static_cast<int>(found));
}
} // namespace

bool FileDescriptor::close()
{
  const int number = std::exchange(this->Number, -1);
  return number < 0 || ::close(number) == 0;
}

Folder::Folder(std::string path)
  : Path(std::move(path))
{
}

bool Folder::isPlain(const std::string& name)
{
  for (std::size_t begin = 0; begin <= name.size();)
  {
    const std::size_t end = std::min(name.find('/', begin), name.size());
    const std::string part = name.substr(begin, end - begin);
    if (part.empty() || part == "." || part == ".." || part.find('\0') != std::string::npos)
    {
      return false;
    }
    begin = end + 1;
  }
  return true;
}

std::string Folder::pathOf(const std::string& name) const { return this->Path + '/' + name; }

void Folder::fail(const std::string& name, const char* what) const
{
  // what openat() says of a link or a file where a folder has to be
  const bool blocked = errno == ELOOP || errno == ENOTDIR;
  throw MachineError(this->pathOf(name) + ": " + what + ": " +
                     (blocked ? "a link or a file stands where a folder has to be" : std::strerror(errno)));
}

// The system's own walk follows links, unless it is told not to, or goes step by step. Empty, with errno, when a step
// fails.
FileDescriptor Folder::holderOf(const std::string& name) const
{
  if (!isPlain(name))
  {
    throw UsageError(this->Path + ": " + quoted(name) + " does not name a file of this folder");
  }
  FileDescriptor at(::open(this->Path.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
  if (at && name.find('/') != std::string::npos)
  {
    FileDescriptor holder = holderAtOnce(at, name);
    const int reason = errno;
    if (holder || reason != ENOSYS)
    {
      at = std::move(holder); // closes the other one
      errno = reason;
      return at;
    }
  }
  forEachParent(name,
    [&at](const std::string& part)
    {
      FileDescriptor next(at ? ::openat(at.number(), part.c_str(), folderFlags) : -1);
      const int reason = errno;
      at = std::move(next); // closes the other one
      errno = reason;
      return bool(at);
    });
  return at;
}

EntryKind Folder::look(const std::string& name) const { return this->lookFrom(this->holderOf(name), name); }

void Folder::look(
  const std::set<std::string>& names, const std::function<void(const std::string&, EntryKind)>& visit) const
{
  FileDescriptor holder;
  std::string parent = "/"; // of none
  int reason = 0;
  for (const std::string& name : names)
  {
    std::string own = name.substr(0, name.size() - leafOf(name).size());
    if (own != parent)
    {
      holder = this->holderOf(name);
      reason = errno;
      parent = std::move(own);
    }
    errno = reason;
    visit(name, this->lookFrom(holder, name));
  }
}

// `holder` is empty, with errno, when there is none.
EntryKind Folder::lookFrom(const FileDescriptor& holder, const std::string& name) const
{
  struct stat info = {};
  if (!holder || ::fstatat(holder.number(), leafOf(name).c_str(), &info, AT_SYMLINK_NOFOLLOW) != 0)
  {
    if (errno == ENOENT)
    {
      return EntryKind::Nothing;
    }
    if (!holder && (errno == ENOTDIR || errno == ELOOP))
    {
      return EntryKind::Blocked;
    }
    this->fail(name, "cannot be looked at");
  }
  return S_ISREG(info.st_mode)   ? EntryKind::File
         : S_ISDIR(info.st_mode) ? EntryKind::Folder
         : S_ISLNK(info.st_mode) ? EntryKind::Link
                                 : EntryKind::Other;
}

void Folder::makeParents(const std::string& name) const
{
  if (this->holderOf(name))
  {
    return;
  }
  std::string made;
  forEachParent(name,
    [&](const std::string& part)
    {
      made += (made.empty() ? "" : "/") + part;
      const FileDescriptor holder = this->holderOf(made);
      if (!holder || (::mkdirat(holder.number(), part.c_str(), 0777) != 0 && errno != EEXIST))
      {
        this->fail(made, "the folder cannot be made");
      }
      if (this->look(made) != EntryKind::Folder)
      {
        errno = ENOTDIR;
        this->fail(made, "the folder cannot be made");
      }
      return true;
    });
}

FileDescriptor Folder::open(const std::string& name, int flags, unsigned mode) const
{
  const FileDescriptor holder = this->holderOf(name);
  if (!holder)
  {
    return FileDescriptor();
  }
  return FileDescriptor(::openat(holder.number(), leafOf(name).c_str(), flags | O_NOFOLLOW | O_CLOEXEC, mode));
}

bool Folder::remove(const std::string& name) const
{
  const EntryKind kind = this->look(name);
  if (kind == EntryKind::Nothing || kind == EntryKind::Folder)
  {
    return false;
  }
  const FileDescriptor holder = this->holderOf(name);
  if (!holder || ::unlinkat(holder.number(), leafOf(name).c_str(), 0) != 0)
  {
    this->fail(name, "cannot be removed");
  }
  return true;
}

void Folder::removeEmptyParents(const std::string& name) const
{
  std::string up = name;
  for (std::size_t slash; (slash = up.rfind('/')) != std::string::npos;)
  {
    up.erase(slash);
    const FileDescriptor holder = this->holderOf(up);
    if (!holder || ::unlinkat(holder.number(), leafOf(up).c_str(), AT_REMOVEDIR) != 0)
    {
      return; // it is not empty, or not there
    }
  }
}

void Folder::rename(const std::string& from, const std::string& to) const
{
  const FileDescriptor holder = this->holderOf(to);
  if (!holder || ::renameat(holder.number(), leafOf(from).c_str(), holder.number(), leafOf(to).c_str()) != 0)
  {
    this->fail(to, "cannot be written");
  }
}

void Folder::sync(const std::string& name) const
{
  const FileDescriptor holder = this->holderOf(name);
  const FileDescriptor names(holder ? ::openat(holder.number(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1);
  // EINVAL: a file system whose folders cannot be waited for
  if (!names || (::fsync(names.number()) != 0 && errno != EINVAL))
  {
    this->fail(name, "cannot be written");
  }
}

void Folder::syncAll() const
{
  const FileDescriptor folder(::open(this->Path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (!folder || ::syncfs(folder.number()) != 0)
  {
    throw MachineError(this->Path + ": cannot be written: " + std::strerror(errno));
  }
}

std::string Folder::fileAt(const std::string& name) const
{
  std::string path = this->pathOf(name);
  if (!isPlain(name))
  {
    throw InputError(this->Path, dgtk::quoted(name) + " leads out of the folder");
  }
  switch (this->look(name))
  {
    case EntryKind::File:
      return path;
    case EntryKind::Nothing:
      throw InputError(path, "no such file");
    case EntryKind::Link:
    case EntryKind::Blocked:
      throw InputError(path, "is not read through a link");
    default:
      throw InputError(path, "is not a file");
  }
}

} // namespace dgtk
