// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFolder_h
#define dgtkFolder_h

#include "dgtkCoreModule.h"

#include <functional>
#include <set>
#include <string>
#include <utility>

namespace dgtk
{

/// A file descriptor that is closed when it goes.
class DGTKCORE_EXPORT FileDescriptor
{
public:
  explicit FileDescriptor(int number = -1)
    : Number(number)
  {
  }
  ~FileDescriptor() { this->close(); }
  FileDescriptor(FileDescriptor&& other) noexcept
    : Number(std::exchange(other.Number, -1))
  {
  }
  FileDescriptor& operator=(FileDescriptor&& other) noexcept
  {
    std::swap(this->Number, other.Number);
    return *this;
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  int number() const { return this->Number; }
  explicit operator bool() const { return this->Number >= 0; }
  /// False, with errno, when the system could not keep what was written.
  bool close();

private:
  int Number;
};

/// What stands under a name.
enum class EntryKind
{
  Nothing,
  File,
  Folder,
  Link,
  Other,  ///< a device, a pipe, a socket
  Blocked ///< one of the folders that lead there is a link, or no folder
};

/// A folder that is written in and read, by names relative to it with '/'. The folder itself may be a link: whoever
/// names it means what it leads to. Beneath it no link is ever followed, so that nothing outside is read, changed or
/// removed whatever stands in the folder. Holds a path, no descriptor. Names that are not plain are UsageErrors; what
/// the system refuses is a MachineError that names the file.
class DGTKCORE_EXPORT Folder
{
public:
  explicit Folder(std::string path);

  /// Whether a name stays beneath a folder, as far as words go: relative, no empty part, no "." and no "..".
  static bool isPlain(const std::string& name);

  const std::string& path() const { return this->Path; }
  /// For messages and for readers; does not look at the disk.
  std::string pathOf(const std::string& name) const;
  EntryKind look(const std::string& name) const;
  /// The same for many names, those in one folder together.
  void look(const std::set<std::string>& names,
    const std::function<void(const std::string& name, EntryKind kind)>& visit) const;
  /// Makes the folders that lead to a name.
  void makeParents(const std::string& name) const;
  /// Opens with these flags of open(2) and O_CLOEXEC. Empty, with errno, when the last step fails.
  FileDescriptor open(const std::string& name, int flags, unsigned mode = 0666) const;
  /// Removes what stands under a name, whatever it is but a folder; false when nothing or a folder stands there.
  bool remove(const std::string& name) const;
  /// Removes the folders that lead to a name as far as they are empty.
  void removeEmptyParents(const std::string& name) const;
  /// Replaces what stands under `to`; both in one folder.
  void rename(const std::string& from, const std::string& to) const;
  /// Waits until the names in the folder that holds `name` are on the disk.
  void sync(const std::string& name) const;
  /// Waits until everything in its file system is on the disk: all files of a dataset in one go.
  void syncAll() const;
  /// The path of a file, for those who read it. Throws InputError when no file is there or a link leads to it.
  std::string fileAt(const std::string& name) const;

private:
  FileDescriptor holderOf(const std::string& name) const;
  EntryKind lookFrom(const FileDescriptor& holder, const std::string& name) const;
  [[noreturn]] void fail(const std::string& name, const char* what) const;
  std::string Path;
};

} // namespace dgtk

#endif
