// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFile_h
#define dgtkFile_h

#include "dgtkCoreModule.h"

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>

namespace dgtk
{

/// Whole contents of a regular file. Throws InputError for a missing file, a directory, a device, or one larger
/// than `limit` bytes.
DGTKCORE_EXPORT std::string readFile(const std::string& path, std::uint64_t limit = std::uint64_t(1) << 32);

/// A file that appears under its name only when it is whole: it is written to a temporary name in the same folder
/// and renamed by commit(). Destroyed without commit(), it leaves nothing behind and what stood under the name before
/// is untouched. Every failure (permission, full disk) is a MachineError that names the file.
class DGTKCORE_EXPORT AtomicFile
{
public:
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Appends.
  void write(const void* data, std::size_t bytes);
  void write(const std::string& text) { this->write(text.data(), text.size()); }
  /// Overwrites bytes already inside or beyond the end of the file; does not move the append position.
  void writeAt(std::uint64_t offset, const void* data, std::size_t bytes);
  void commit();

  const std::string& path() const { return this->Path; }
  const std::string& temporaryPath() const { return this->Temporary; }

private:
  [[noreturn]] void fail(const char* what) const;
  std::string Path;
  std::string Temporary;
  int Descriptor = -1;
};

/// Name of a file while it is written.
inline std::string partialName(const std::string& path) { return path + ".partial"; }

/// Writes to a descriptor until everything is written. False, with errno, when the system refuses.
DGTKCORE_EXPORT bool writeAll(int descriptor, const void* data, std::size_t bytes);

/// Writes a whole small file through AtomicFile.
DGTKCORE_EXPORT void writeFile(const std::string& path, const std::string& contents);

/// Creates a folder and its parents. Throws MachineError.
DGTKCORE_EXPORT void makeFolders(const std::string& path);

} // namespace dgtk

#endif
