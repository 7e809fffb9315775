// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFolderRecords_h
#define dgtkFolderRecords_h

// Private to DatasetIO.

#include "dgtkDatasetDocuments.h"
#include "dgtkFolder.h"
#include "dgtkFolderContents.h"
#include "dgtkJournal.h"

#include <set>
#include <string>
#include <vector>

namespace dgtk
{

/// What a folder's manifest and journal say.
struct FolderRecords
{
  bool journal = false;              ///< an interrupted run's
  bool whole = false;                ///< a manifest is there, and no journal of another request
  std::string requestHash;           ///< of the journal, else of the manifest; empty without either
  std::vector<DatasetFile> finished; ///< whole files of the request, in the order in which they were recorded
  std::set<std::string> names;       ///< every file that they list, whole or only planned
  std::string foreign;               ///< not empty: why manifest or journal are not DGTk's
};

/// `document`: manifestName or exportName. Throws MachineError when the folder cannot be read.
FolderRecords readFolderRecords(const Folder& folder, const std::string& document = manifestName);

/// Whether nothing stands there but what is left of a run that was killed at its very beginning.
bool holdsNothing(const std::string& folder);

/// Whether another process is writing into it.
bool isRunning(const Folder& folder);

/// What they mean for a request; never Running.
FolderContents contentsOf(const Folder& folder, const FolderRecords& records, const std::string& requestHash);

/// One line of a journal, with its line feed.
std::string journalFirstLine(const std::string& requestHash);
std::string journalLine(const DatasetFile& file); ///< of a file that is whole
std::string journalPlan(const std::string& name); ///< of one that is going to be written

} // namespace dgtk

#endif
