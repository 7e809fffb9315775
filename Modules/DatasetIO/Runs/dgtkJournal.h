// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkJournal_h
#define dgtkJournal_h

#include "dgtkDatasetIOModule.h"

#include "dgtkDatasetDocuments.h"
#include "dgtkFile.h"
#include "dgtkFolderContents.h"
#include "dgtkNameTable.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dgtk
{

/// Names in a dataset's folder.
constexpr const char* manifestName = "manifest.json";
constexpr const char* journalName = ".dgtk-journal";
constexpr const char* notesName = ".dgtk-journal-notes"; ///< what an export knows of its finished items

/// Whether a file is in its folder with its recorded size and hash.
DGTKDATASETIO_EXPORT bool isWhole(const Folder& folder, const DatasetFile& file);

/// Whether the folder holds the whole dataset of the request with this hash. What removeLeftJournal() removes is.
DGTKDATASETIO_EXPORT bool isFinished(const std::string& folder, const std::string& requestHash);
/// Removes the journal and notes, and merged parts, beside the document of a whole run that was killed between its last
/// steps.
DGTKDATASETIO_EXPORT void removeLeftJournal(const std::string& folder, const std::string& document = manifestName);

/// What becomes of a run that the folder holds.
enum class JournalStart
{
  Fresh,  ///< an interrupted run, or one of another request, is refused
  Resume, ///< the same request goes on, another one is refused
  Replace ///< it goes, whatever it is
};

/// What is wrong with a file as it is recorded; "": nothing.
using JudgeOfFiles = std::function<std::string(const DatasetFile& file)>;

/// The files of a dataset: those that are going to be written and those that are complete, recorded while it is
/// written, so that an interrupted run can be resumed or removed. One line a file, written at once; a line cut off by a
/// crash is ignored.
class DGTKDATASETIO_EXPORT Journal
{
public:
  /// Prepares `folder`, making it if need be, and starts or resumes the journal of the request with this hash (any
  /// text without line breaks).
  ///
  /// | folderContents() | Fresh | Resume | Replace |
  /// |---|---|---|---|
  /// | Nothing | a fresh start | a fresh start | a fresh start |
  /// | Finished | removed | kept | removed |
  /// | Unfinished | FolderError | kept | removed |
  /// | FinishedOther, UnfinishedOther | FolderError | FolderError | removed |
  /// | Running, Foreign | FolderError | FolderError; InputError of a damaged document | FolderError |
  ///
  /// Kept are files with the recorded size and hash; they are finished(). Removed are the files that manifest and
  /// journal list, half-written ones included, and the folders that they leave empty; nothing else. An old manifest is
  /// removed in either case: a folder with a manifest is a whole dataset.
  ///
  /// `names` are the files that the run is going to write, relative to the folder. A file in the way of one of them
  /// that neither manifest nor journal lists, or a link in place of a folder, is a UsageError before anything is
  /// changed. Throws MachineError when the folder cannot be made or written.
  /// `document`: the name of the one that a whole run ends with, manifestName or exportName.
  /// `judge` sees the finished files that Resume finds; what it says is an InputError before anything is changed, as is
  /// what else is damaged in the manifest then.
  /// Memory: 24 bytes a file that is listed.
  Journal(const std::string& folder, const std::string& requestHash, JournalStart start, const ForNames& names,
    const std::string& document = manifestName, const JudgeOfFiles& judge = {});
  Journal(const std::string& folder, const std::string& requestHash, JournalStart start,
    const std::vector<std::string>& names = {}, const JudgeOfFiles& judge = {});
  ~Journal(); ///< keeps the journal for a later resume
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// How many files are taken over from the interrupted run.
  std::size_t finished() const;
  /// A file taken over from the interrupted run; none for another one. `path` is relative to the folder. May be called
  /// from any thread. Throws MachineError.
  std::optional<DatasetFile> find(const std::string& path) const;

  /// Records files that are going to be written; to be called before they are. May be called from any thread. Throws
  /// MachineError.
  void plan(const std::vector<std::string>& names);
  /// The same for one that was not among `names` of the constructor. Throws UsageError when it is in the way of one.
  void planLate(const std::string& name);
  /// Records a finished file; many are sent to the disk meanwhile, of which close() tells what failed. May be called
  /// from any thread. Throws MachineError.
  void add(const DatasetFile& file);

  /// Writes manifest.json and removes the journal; the last step of a run. Throws MachineError.
  void close(const Manifest& manifest);
  /// The same with a document that `write` makes.
  void close(const std::function<void(AtomicFile& document)>& write);

private:
  struct Impl;
  std::unique_ptr<Impl> Self;
};

} // namespace dgtk

#endif
