// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkJournal_h
#define dgtkJournal_h

#include "dgtkDatasetIOModule.h"

#include "dgtkDatasetDocuments.h"

#include <memory>
#include <string>
#include <vector>

namespace dgtk
{

using JournalEntry = DatasetFile;

/// Names in a dataset's folder.
constexpr const char* manifestName = "manifest.json";
constexpr const char* journalName = ".dgtk-journal";

/// The files of a dataset that are complete, recorded while it is written, so that an interrupted run can be resumed.
/// One line a file, flushed at once; a line cut off by a crash is ignored.
class DGTKDATASETIO_EXPORT Journal
{
public:
  /// Prepares `folder`, making it if need be, and starts or resumes the journal of the request with this hash (any
  /// text without line breaks).
  ///
  /// | folder holds | resume | what happens |
  /// |---|---|---|
  /// | nothing | either | a fresh start |
  /// | a journal or manifest of the same request | yes | files that exist with the recorded size are finished() |
  /// | a journal or manifest of another request | yes | UsageError |
  /// | a journal or manifest of any request | no | the files that it lists are removed; a fresh start |
  /// | other files only | either | UsageError |
  ///
  /// Files left half-written by a crash (`*.partial`) are removed in every case but the errors. An old manifest is
  /// removed: a folder with a manifest is a whole dataset. Throws UsageError also when another process is writing into
  /// the folder, MachineError when the folder cannot be made or written.
  Journal(const std::string& folder, const std::string& requestHash, bool resume);
  ~Journal(); ///< keeps the journal for a later resume
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// Files taken over from the interrupted run, in the order in which they were finished.
  const std::vector<DatasetFile>& finished() const;
  /// The file taken over from the interrupted run, or null. `path` is relative to the folder.
  const DatasetFile* find(const std::string& path) const;

  /// Records a finished file. May be called from any thread. Throws MachineError.
  void add(const DatasetFile& file);

  /// Writes manifest.json and removes the journal; the last step of a run. Throws MachineError.
  void close(const Manifest& manifest);

private:
  struct Impl;
  std::unique_ptr<Impl> Self;
};

} // namespace dgtk

#endif
