// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkHash_h
#define dgtkHash_h

#include "dgtkCoreModule.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace dgtk
{

/// Incremental SHA-256 (FIPS 180-4).
class DGTKCORE_EXPORT Sha256
{
public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void update(const void* data, std::size_t bytes);
  /// 64 lower-case hexadecimal digits; the object cannot be updated afterwards.
  std::string hex();

  /// Hash of these bytes.
  static std::string of(const std::string& bytes);
  /// Hash of a whole file. Throws InputError when it cannot be read.
  static std::string ofFile(const std::string& path);

private:
  struct Impl;
  std::unique_ptr<Impl> Self;
};

/// When a file was last changed, as its file system counts.
class DGTKCORE_EXPORT FileAge
{
public:
  /// Of a regular file, links followed; of none when there is no such file.
  explicit FileAge(const std::string& path);

  bool isFile() const { return this->File; }
  std::uint64_t bytes() const { return this->Bytes; }
  /// Whether a change at a time (nanoseconds since 1970) or later would be seen in another age.
  bool isOlderThan(std::int64_t time) const;
  bool operator==(const FileAge& other) const;

private:
  bool File = false;
  std::uint64_t Device = 0;
  std::uint64_t Number = 0;
  std::uint64_t Bytes = 0;
  std::int64_t Contents = 0; ///< when they changed, nanoseconds since 1970
  std::int64_t State = 0;    ///< the same, of names and rights, too
};

/// Nanoseconds since 1970, as files' times are counted.
DGTKCORE_EXPORT std::int64_t timeOfFiles();

/// Sha256::ofFile(); a file of the same age as when it was last asked for is not read again. Thread-safe.
DGTKCORE_EXPORT std::string hashOfFile(const std::string& path);

} // namespace dgtk

#endif
