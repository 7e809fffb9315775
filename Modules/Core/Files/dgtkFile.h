// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFile_h
#define dgtkFile_h

#include "dgtkCoreModule.h"

#include "dgtkFolder.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace dgtk
{

/// Whole contents of a regular file. Throws InputError for a missing file, a directory, a device, or one larger
/// than `limit` bytes.
DGTKCORE_EXPORT std::string readFile(const std::string& path, std::uint64_t limit = std::uint64_t(1) << 32);

/// Where a file goes: a path, or a name in a folder beneath which no link is followed (see Folder). A path stands where
/// a place is expected.
class DGTKCORE_EXPORT FilePlace
{
public:
  FilePlace(const std::string& path);
  FilePlace(const char* path)
    : FilePlace(std::string(path))
  {
  }
  FilePlace(const std::string& folder, const std::string& name);

  const std::string& path() const { return this->Path; }
  const Folder& folder() const { return this->Holder; }
  const std::string& name() const { return this->Name; } ///< in folder()

private:
  std::string Path;
  Folder Holder;
  std::string Name;
};

/// A file that appears under its name only when it is whole: it is written to a temporary name in the same folder
/// and renamed by commit(). What stands under either name is replaced, never written through. Destroyed without
/// commit(), it leaves nothing behind and what stood under the name before is untouched. Every failure (permission,
/// full disk) is a MachineError that names the file, or an AgainError where another process writes it. Any number can
/// be written together: those beyond half of the descriptors that the process may have are opened for each write.
class DGTKCORE_EXPORT AtomicFile
{
public:
  explicit AtomicFile(const FilePlace& place);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends.
  void write(const void* data, std::size_t bytes);
  void write(const std::string& text) { this->write(text.data(), text.size()); }
  /// Overwrites bytes already inside or beyond the end of the file; does not move the append position.
  void writeAt(std::uint64_t offset, const void* data, std::size_t bytes);
  void commit();
  /// The same, and the file is on the disk before it gets its name, and the name before this returns.
  void commitDurably();

  const std::string& path() const { return this->Place.path(); }
  const std::string& temporaryPath() const { return this->Temporary; }

private:
  struct Identity
  {
    std::uint64_t device = 0;
    std::uint64_t number = 0;
  };
  Identity identityOf(const FileDescriptor& file) const;
  FileDescriptor reopened() const;
  void close();
  void finish(bool durably);
  [[noreturn]] void fail(const char* what) const;
  FilePlace Place;
  std::string Temporary;
  FileDescriptor Descriptor; ///< empty between writes unless it is kept
  Identity Created;
  std::uint64_t Position = 0;
  bool Kept = false;
  bool Open = true;
};

/// Name of a file while it is written.
inline std::string partialName(const std::string& path) { return path + ".partial"; }

/// Writes to a descriptor until everything is written. False, with errno, when the system refuses.
DGTKCORE_EXPORT bool writeAll(int descriptor, const void* data, std::size_t bytes);

/// Writes a whole small file through AtomicFile.
DGTKCORE_EXPORT void writeFile(const FilePlace& place, const std::string& contents);
/// The same with AtomicFile::commitDurably().
DGTKCORE_EXPORT void writeFileDurably(const FilePlace& place, const std::string& contents);

/// Whether a path leads to one of these files, which need not be there.
DGTKCORE_EXPORT bool leadsToOneOf(const std::string& path, const std::vector<std::string>& files);
/// Throws UsageError where what is to be written to a path would replace one of the files that it is made of.
DGTKCORE_EXPORT void refuseInPlaceOf(const std::vector<std::string>& read, const std::string& path);

/// Creates a folder and its parents. Throws MachineError.
DGTKCORE_EXPORT void makeFolders(const std::string& path);

} // namespace dgtk

#endif
