// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkHash_h
#define dgtkHash_h

#include "dgtkCoreModule.h"

#include <cstddef>
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

  /// Hash of a whole file. Throws InputError when it cannot be read.
  static std::string ofFile(const std::string& path);

private:
  struct Impl;
  std::unique_ptr<Impl> Self;
};

} // namespace dgtk

#endif
