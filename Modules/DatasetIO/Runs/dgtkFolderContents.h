// SPDX-License-Identifier: BSD-3-Clause
#ifndef dgtkFolderContents_h
#define dgtkFolderContents_h

#include "dgtkDatasetIOModule.h"

#include "dgtkError.h"

#include <string>

namespace dgtk
{

/// What stands in a folder that a run is to be written into.
enum class FolderContents
{
  Nothing,         ///< there is no such folder, or it is empty
  Finished,        ///< the whole dataset of the same request
  FinishedOther,   ///< the whole dataset of another request
  Unfinished,      ///< an interrupted run of the same request, which can be resumed
  UnfinishedOther, ///< an interrupted run of another request
  Running,         ///< another process is writing into it
  Foreign          ///< somebody's files: neither manifest nor journal are there, or they are not DGTk's
};

/// What stands in `folder` for the request with this hash, as in the manifest's `request_hash`. With an empty hash,
/// which no request has, datasets and interrupted runs are all "Other". Changes nothing. Throws MachineError when the
/// folder cannot be read or `folder` is a file.
DGTKDATASETIO_EXPORT FolderContents folderContents(const std::string& folder, const std::string& requestHash);

/// The end of a sentence that begins with a folder's name: "holds an unfinished run of the same request".
DGTKDATASETIO_EXPORT std::string describe(FolderContents contents);

/// Throws InputError, which says what completes it, where a folder holds a run that is not finished, or in
/// parts that are not merged.
DGTKDATASETIO_EXPORT void requireFinished(const std::string& folder);

/// As requireFinished(), and for a folder without a manifest.
DGTKDATASETIO_EXPORT void requireDataset(const std::string& folder);

/// Throws UsageError where a file or folder to be written is below the folder of a dataset, which is no sound one with
/// a file that its manifest does not list, and where it is the manifest of a folder of datasets. The path need not be
/// there.
DGTKDATASETIO_EXPORT void requireOutsideDatasets(const std::string& path);

/// A run is not begun because of what stands in its folder. The text names the folder.
class FolderError : public UsageError
{
public:
  FolderError(const std::string& folder, FolderContents contents, const std::string& more = {})
    : UsageError(folder + ": " + describe(contents) + more)
    , Contents(contents)
  {
  }
  FolderContents contents() const noexcept { return this->Contents; }

private:
  FolderContents Contents;
};

} // namespace dgtk

#endif
