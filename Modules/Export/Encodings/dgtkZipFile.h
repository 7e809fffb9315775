// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkZipFile_h
#define dgtkZipFile_h

#include "dgtkExporter.h"

#include <cstdint>
#include <memory>
#include <string>

namespace dgtk
{

/// Writes a ZIP archive whose members are stored as they are (APPNOTE 6.3.4, without ZIP64), as numpy.savez does. All
/// that is not contents is fixed: the time is 1980-01-01; so the same members give the same bytes.
class ZipFile
{
public:
  ZipFile(ExportSink& sink, const std::string& name);
  /// A member whose `bytes` are what put() gets until end(). Throws UsageError where the archive would have 4 GiB or
  /// more.
  void begin(const std::string& name, std::uint64_t bytes);
  void put(const void* data, std::size_t bytes);
  void end();
  void finish();

private:
  std::string described() const;
  std::unique_ptr<ExportFile> File;
  std::string Member; ///< its name
  std::uint64_t Size = 0;
  std::uint32_t Sum = 0;
  std::uint64_t Start = 0; ///< of the member's header
  std::string Directory;
  std::uint64_t At = 0;
  std::uint16_t Members = 0;
};

} // namespace dgtk

#endif
