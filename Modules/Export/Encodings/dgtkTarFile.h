// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkTarFile_h
#define dgtkTarFile_h

#include "dgtkExporter.h"

#include <memory>
#include <string>

namespace dgtk
{

/// Writes a tar archive as POSIX.1-1988 has it (ustar). All that is not contents is fixed: mode 0644, owner and group
/// 0, time 0; so the same members give the same bytes.
class TarFile
{
public:
  /// Bytes of a name without a folder.
  static constexpr std::size_t longestName = 100;

  TarFile(ExportSink& sink, const std::string& name);
  /// A file of the archive. Throws UsageError for a name that is longer, and for 8 GiB and more.
  void add(const std::string& name, const std::string& bytes);
  DatasetFile finish();

private:
  std::unique_ptr<ExportFile> File;
};

} // namespace dgtk

#endif
