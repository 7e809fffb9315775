// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkExportShards_h
#define dgtkExportShards_h

#include "dgtkExportModule.h"

#include "dgtkExport.h"
#include "dgtkRunParts.h"

#include <string>

namespace dgtk
{

/// Makes a share of an export into its folder; any number of processes may do so at the same time, also the same share.
/// Its blocks are pieces of the export in their order (scenes, where each of them becomes an export of its own) and do
/// not depend on the number of processes; documents of the whole are made by mergeExport(). What is there of the same
/// export is kept. Throws what exportDataset() throws; AgainError when another process is busy with a block of this
/// share.
DGTKEXPORT_EXPORT ExportResult exportShard(
  const ExportRequest& request, const RunShard& shard, const ExportCallbacks& callbacks = {});

/// Makes of the parts in a folder the export that one process would have written, when all are there: every file is
/// compared with its SHA-256 first. The dataset has to stand where it stood. May be called again after it was
/// interrupted. Throws UsageError where no parts of an export are, and what reading and writing throw.
DGTKEXPORT_EXPORT MergeReport mergeExport(const std::string& folder);

} // namespace dgtk

#endif
