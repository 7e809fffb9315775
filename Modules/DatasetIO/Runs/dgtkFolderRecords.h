// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFolderRecords_h
#define dgtkFolderRecords_h

#include "dgtkDatasetDocuments.h"
#include "dgtkError.h"
#include "dgtkFolder.h"
#include "dgtkFolderContents.h"
#include "dgtkJournal.h"

#include <functional>
#include <optional>
#include <string>

namespace dgtk
{

/// What a folder's manifest and journal say.
struct FolderRecords
{
  bool journal = false;             ///< an interrupted run's
  bool whole = false;               ///< a manifest is there, and no journal of another request
  bool names = false;               ///< they list files
  std::string requestHash;          ///< of the journal, else of the manifest; empty without either
  std::string foreign;              ///< not empty: why manifest or journal are not DGTk's
  std::optional<InputError> damage; ///< that they are foreign since one of them is not what it is read as
};

/// Where a file is listed.
enum class ListedIn
{
  Journal,
  Document
};

/// Is handed every file that they list, those of the journal first: as recorded, or, with no hash, as planned only.
/// Files of the document count as finished where the records are `whole`.
using ForListed = std::function<void(DatasetFile&& file, ListedIn where)>;

/// `document`: manifestName or exportName. Memory does not grow with the files. Throws MachineError when the folder
/// cannot be read; what is found foreign may have handed on files before.
FolderRecords readFolderRecords(
  const Folder& folder, const std::string& document = manifestName, const ForListed& visit = {});

/// Throws InputError for the first finished file that a judge, if there is one, has a word about.
void judgeFiles(const Folder& folder, const std::string& document, const JudgeOfFiles& judge);

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
/// What one of them says, without its line feed and not the first one; none for a torn line.
std::optional<DatasetFile> readJournalLine(const std::string& line);

} // namespace dgtk

#endif
