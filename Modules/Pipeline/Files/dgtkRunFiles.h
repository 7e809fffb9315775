// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkRunFiles_h
#define dgtkRunFiles_h

// Private to Pipeline.

#include "dgtkFileSink.h"

#include "dgtkDatasetDocuments.h"
#include "dgtkJournal.h"

#include <set>
#include <string>
#include <vector>

namespace dgtk
{

/// The finished files of a run: in its journal, and for its manifest.
class RunFiles
{
public:
  /// Throws what Journal throws.
  RunFiles(const std::string& folder, const std::string& requestHash, JournalStart start,
    const std::vector<std::string>& names, const JudgeOfFiles& judge)
    : Log(folder, requestHash, start, names, judge)
  {
  }

  /// Files that are going to be written now.
  void plan(const std::vector<std::string>& names) { this->Log.plan(names); }
  /// One that was not among the names of the constructor.
  void planLate(const std::string& name) { this->Log.planLate(name); }
  /// A file that was finished now.
  void add(const DatasetFile& file);
  /// Files of a lane; shared ones are recorded once and belong to no job.
  void add(const std::vector<FinishedFile>& files, const std::string& camera, int frame);
  /// Whether an interrupted run finished all of these.
  bool has(const std::vector<std::string>& names) const;
  /// Takes over files of an interrupted run if it finished all of them, own and shared. False and unchanged otherwise.
  bool keep(const std::vector<std::string>& own, const std::vector<std::string>& shared);
  /// All files but documents.
  const std::vector<DatasetFile>& files() const { return this->Files; }
  /// Ends the run.
  void close(const Manifest& manifest) { this->Log.close(manifest); }

private:
  bool addOnce(const DatasetFile& file);
  Journal Log;
  std::vector<DatasetFile> Files;
  std::set<std::string> Shared; // paths of the shared ones
};

} // namespace dgtk

#endif
